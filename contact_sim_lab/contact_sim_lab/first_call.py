"""How long a scene takes to its first answer in a fresh process: `python -m
contact_sim_lab.first_call SCENE [--no-field]`.
"""

from __future__ import annotations

import json
import sys
import time
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene


def main(scene_name: str, *, field: bool = True) -> None:
    """Write one JSON object: seconds from the start of the imports to a block done, seconds of the
    first field solve (null without ``field`` and where there is none).
    """
    began = time.perf_counter()
    from contact_sim_pkg.run.compilation import reported_compilation
    from contact_sim_pkg.run.rigs import make_simulation
    from contact_sim_pkg.scene.resolve import load_resolved

    scene = load_resolved(scene_name)
    solved = _first_solve(scene) if field else None
    with reported_compilation(scene, lambda _sentence: None):
        make_simulation(scene).prepare()
    facts = {"simulation": time.perf_counter() - began, "field": solved}
    sys.stdout.write(json.dumps(facts))


def _first_solve(scene: ResolvedScene) -> Any:
    from contact_sim_lab.cases import objects, rig_studies

    studies = objects(rig_studies()[scene.data["rig"]].accuracy, "ACCURACY")
    first_calls = [each.first_call for each in studies if each.first_call is not None]
    return next((call(scene) for call in first_calls), None)


if __name__ == "__main__":
    try:
        main(sys.argv[1], field="--no-field" not in sys.argv)
    except KeyboardInterrupt:
        sys.exit(130)
