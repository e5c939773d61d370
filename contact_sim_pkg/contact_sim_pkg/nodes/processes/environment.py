"""Environment and ROS arguments of the processes of the bench. Without ROS."""

from __future__ import annotations

import os
from collections.abc import Mapping

from contact_sim_pkg.python_process import SETTINGS, disregard_current_folder
from contact_sim_pkg.records.plugins import OFF, VARIABLE
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

DEFAULT_ENVIRONMENT = {  # each only where the caller has not set it
    **SETTINGS,
    "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    "NUMBA_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "RCUTILS_CONSOLE_OUTPUT_FORMAT": "{severity} {name}: {message}",
}
LAUNCHED_ENVIRONMENT = {  # the same without the format of the log, which `ros2 launch` leaves to the user
    name: value for name, value in DEFAULT_ENVIRONMENT.items() if name != "RCUTILS_CONSOLE_OUTPUT_FORMAT"
}


def set_default_environment() -> None:
    """Set the environment of every process of the bench, where the caller has not; see also
    `disregard_current_folder`.
    """
    disregard_current_folder()
    for name, value in DEFAULT_ENVIRONMENT.items():
        os.environ.setdefault(name, value)


def node_arguments(parameters: Mapping[str, str | float | bool]) -> list[str]:
    """ROS arguments with the parameters of a node, each in its own unit ([s] for times).

    Nothing is logged into the user's home.
    """
    arguments = ["--ros-args", "--disable-external-lib-logs"]
    for name, value in parameters.items():
        arguments += ["-p", f"{name}:={_yaml(value)}"]
    return arguments


def _yaml(value: str | float | bool) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return "'" + value.replace("'", "''") + "'" if isinstance(value, str) else repr(value)


def plugin_environment(scene: ResolvedScene) -> dict[str, str]:
    """The plug-ins that a scene uses, for its nodes: one that uses none is started without a look at
    what is installed.
    """
    named = str(scene.data.get("plugins") or "")
    return {VARIABLE: ",".join(each.strip().partition(" ")[0] for each in named.split(",")) if named else OFF}
