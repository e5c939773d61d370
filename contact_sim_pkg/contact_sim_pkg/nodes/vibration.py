"""The node of the vibration: sends the accelerations of each block on `platform/vibration`."""

from __future__ import annotations

import sys

from contact_sim_pkg.nodes.excitation_node import ExcitationNode
from contact_sim_pkg.nodes.processes.process import run
from contact_sim_pkg.run.sources import make_vibration


class VibrationNode(ExcitationNode):
    """Publishes `platform/vibration`; follows `bench/progress` and `bench/recorded`."""

    def __init__(self) -> None:
        """Make the vibration of the scene."""
        super().__init__("vibration", "platform/vibration", make_vibration)


def main() -> int:
    """Run the node; returns the exit status."""
    return run(VibrationNode)


if __name__ == "__main__":
    sys.exit(main())
