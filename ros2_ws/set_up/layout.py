"""Where things lie: the project folder, the environment in it, the workspace."""

from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
WORKSPACE = PROJECT / "ros2_ws"
ENVIRONMENT = PROJECT / ".ros2"
PACKAGES = ("contact_msgs_defs", "contact_sim_pkg", "contact_sim_lab")
ABSENT = WORKSPACE / "absent"
"""Packages of ROS 2 that PyPI lacks, each built where the underlay has it not."""

LOCK = WORKSPACE / "requirements.txt"
BUILD_TOOLS_LOCK = WORKSPACE / "requirements-build-tools.txt"
COLCON_DEFAULTS = WORKSPACE / "colcon_defaults.yaml"


def environment_python() -> Path:
    """The environment's own interpreter."""
    return ENVIRONMENT / "bin" / "python"
