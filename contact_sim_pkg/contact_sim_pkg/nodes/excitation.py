"""Both excitation nodes in one process, as `bench run` starts them: one set of threads of the
middleware, and one wake-up for the answers to both.
"""

from __future__ import annotations

import sys

from contact_sim_pkg.nodes.processes.process import run
from contact_sim_pkg.nodes.road_profile import RoadProfileNode
from contact_sim_pkg.nodes.vibration import VibrationNode


def main() -> int:
    """Run both nodes; returns the exit status."""
    return run(RoadProfileNode, VibrationNode)


if __name__ == "__main__":
    sys.exit(main())
