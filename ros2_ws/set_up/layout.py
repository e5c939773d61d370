"""Where things lie: the project folder, the environment in it, the workspace."""

from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
WORKSPACE = PROJECT / "ros2_ws"
ENVIRONMENT = PROJECT / ".ros2"
PACKAGES = ("contact_msgs_defs", "contact_sim_pkg", "contact_sim_lab")
ABSENT = WORKSPACE / "absent"
"""Packages of ROS 2 that PyPI lacks, each built where the underlay has it not."""
ON_USE = ("simulation_interfaces",)
"""Those of `ABSENT` that are built on first use, each into a folder of its own: a set-up does not pay for them."""
ON_USE_FOLDER = WORKSPACE / "on_use"
"""What stands there comes last on every path: a package of the same name that is installed later hides it."""

LOCK = WORKSPACE / "requirements.txt"
BUILD_TOOLS_LOCK = WORKSPACE / "requirements-build-tools.txt"
COLCON_DEFAULTS = WORKSPACE / "colcon_defaults.yaml"


def environment_python() -> Path:
    """The environment's own interpreter."""
    return ENVIRONMENT / "bin" / "python"
