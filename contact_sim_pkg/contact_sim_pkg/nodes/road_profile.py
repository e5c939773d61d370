"""The node of the road: sends the strip of heights that the tire can touch in each block on
`road/patch`.
"""

from __future__ import annotations

import sys

from contact_sim_pkg.nodes.excitation_node import ExcitationNode
from contact_sim_pkg.nodes.processes.process import run
from contact_sim_pkg.run.sources import make_road


class RoadProfileNode(ExcitationNode):
    """Publishes `road/patch`; follows `bench/progress` and `bench/recorded`."""

    def __init__(self) -> None:
        """Make the road of the scene."""
        super().__init__("road_profile", "road/patch", make_road)


def main() -> int:
    """Run the node; returns the exit status."""
    return run(RoadProfileNode)


if __name__ == "__main__":
    sys.exit(main())
