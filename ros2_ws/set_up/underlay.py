"""Which ROS 2 the workspace stands on: a sourced Jazzy of the system, or one made from PyPI."""

import os
import re
import shutil
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from .errors import MISSING, SetUpError
from .layout import ENVIRONMENT, PROJECT

DISTRIBUTION = "jazzy"

# Variables by which another environment would reach into this one.
FOREIGN_VARIABLES = (
    "AMENT_CURRENT_PREFIX",
    "AMENT_PREFIX_PATH",
    "CMAKE_PREFIX_PATH",
    "COLCON_CURRENT_PREFIX",
    "COLCON_PREFIX_PATH",
    "LD_LIBRARY_PATH",
    "PYTHONPATH",
)
PYTHON_VARIABLES = ("PYTHONHOME", "PYTHONSTARTUP", "PYTHONUSERBASE", "VIRTUAL_ENV", "__PYVENV_LAUNCHER__")
PIP_TARGET_VARIABLES = ("PIP_PREFIX", "PIP_REQUIRE_VIRTUALENV", "PIP_ROOT", "PIP_TARGET", "PIP_USER")


class Underlay(NamedTuple):
    """The ROS 2 below the workspace and the interpreter that the environment is made with."""

    prefix: Path | None
    """Folder of the sourced ROS 2; None: ROS 2 comes from PyPI."""
    python: Path

    @property
    def kind(self) -> str:
        """One word for stamps and messages: where ROS 2 comes from."""
        return "pip" if self.prefix is None else "system"


def find_underlay(environ: Mapping[str, str]) -> Underlay:
    """The sourced Jazzy of the system where there is one, else ROS 2 from PyPI on the running Python.

    Raises SetUpError where something else is sourced: it would leak into the build and into every node.
    """
    foreign = [prefix for prefix in _sourced_prefixes(environ) if not _inside_project(prefix)]
    if not foreign:
        return Underlay(None, base_python())
    roots = [prefix for prefix in foreign if _holds_rclpy(prefix) and not (prefix / "pyvenv.cfg").exists()]
    distribution = environ.get("ROS_DISTRO", "unknown")
    if not roots or distribution != DISTRIBUTION:
        raise SetUpError(
            f"this shell has ROS 2 '{distribution}' from {foreign[0]} sourced, which is not a Jazzy of the system: "
            "run make in a fresh shell, or source /opt/ros/jazzy/setup.bash first.",
            status=MISSING,
        )
    return Underlay(roots[-1], _python_of(roots[-1]))


def base_python() -> Path:
    """The interpreter that runs this program, outside of any virtual environment."""
    plain = Path(sys.base_prefix) / "bin" / f"python{sys.version_info[0]}.{sys.version_info[1]}"
    return plain if plain.exists() else Path(sys.executable)


def clean_environ(environ: Mapping[str, str], underlay: Underlay) -> dict[str, str]:
    """The caller's variables without those by which another Python or ROS 2 would be found."""
    dropped = set(PYTHON_VARIABLES) | set(PIP_TARGET_VARIABLES)
    if underlay.prefix is None:
        dropped |= set(FOREIGN_VARIABLES)
    kept = {name: value for name, value in environ.items() if name not in dropped}
    inner = str(ENVIRONMENT / "bin")
    kept["PATH"] = os.pathsep.join(p for p in environ.get("PATH", os.defpath).split(os.pathsep) if p != inner)
    # The wheels' start-up hook would restart every interpreter; local_setup.sh sets what the hook is there for.
    return kept | {"_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1", "PYTHONNOUSERSITE": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1"}


def _sourced_prefixes(environ: Mapping[str, str]) -> list[Path]:
    return [Path(entry) for entry in environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if entry]


def _inside_project(prefix: Path) -> bool:
    return PROJECT in (prefix, *prefix.parents)


def _holds_rclpy(prefix: Path) -> bool:
    return (prefix / "share" / "ament_index" / "resource_index" / "packages" / "rclpy").exists()


def _python_of(prefix: Path) -> Path:
    """The interpreter that the sourced ROS 2 was built for, by the folder that its rclpy lies in."""
    for folder in sorted(prefix.glob("lib/python3.*/*-packages/rclpy")):
        match = re.search(r"/lib/(python3\.\d+)/", str(folder))
        name = match.group(1) if match else "python3"
        for candidate in (prefix / "bin" / name, Path("/usr/bin") / name):
            if candidate.exists():
                return candidate
        found = shutil.which(name)
        if found:
            return Path(found)
    raise SetUpError(f"no interpreter found for the rclpy of {prefix}: install python3 of that system.", status=MISSING)
