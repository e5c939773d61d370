"""How long a scene takes to its first answer in a fresh process: `python -m contact_sim_pkg.studies.first_call SCENE`."""

from __future__ import annotations

import json
import sys
import time


def main(scene_name: str) -> None:
    """Write one JSON object: seconds from the start of the imports to a block done, and of the first field solve (or null)."""
    began = time.perf_counter()
    from contact_sim_pkg.rigs.vehicle.studies.accuracy_field import first_solve
    from contact_sim_pkg.rigs.vehicle.studies.scene_drive import load_resolved
    from contact_sim_pkg.run.rigs import make_simulation

    scene = load_resolved(scene_name)
    field = first_solve(scene)
    make_simulation(scene).prepare()
    sys.stdout.write(json.dumps({"simulation": time.perf_counter() - began, "field": field}))


if __name__ == "__main__":
    main(sys.argv[1])
