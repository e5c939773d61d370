"""Packages of definitions that are built on first use, where ROS 2 comes without them."""

from __future__ import annotations

import ctypes
import subprocess
import sys
from collections.abc import Callable
from importlib import invalidate_caches
from importlib.util import find_spec
from pathlib import Path

WORKSPACE = Path(__file__).resolve().parents[4] / "ros2_ws"


def provide(name: str, workspace: Path = WORKSPACE, building: Callable[[], None] = lambda: None) -> str:
    """Make a package importable: an installed one, or else that of the workspace, which is built where it is not there.

    ``building`` is called before what may take most of a minute. Returns why it is not; empty where it is.
    """
    if find_spec(name) is not None:
        return ""
    set_up = workspace / "set_up.sh"
    if not set_up.is_file():
        return f"{name} is not installed; its package is ros-jazzy-{name.replace('_', '-')}"
    building()
    ended = subprocess.run(["/bin/sh", str(set_up), name], capture_output=True, text=True, check=False)
    prefix = workspace / "on_use" / name / "install" / name
    if ended.returncode or not prefix.is_dir():
        last = ended.stderr.strip().rpartition("\n")[2]
        return f"{name} could not be built: {last or f'status {ended.returncode}'}"
    sys.path += [str(path) for path in prefix.glob("lib/python3*/*-packages")]
    _load(sorted(prefix.glob("lib/*.so")))
    invalidate_caches()
    return ""


def _load(libraries: list[Path]) -> None:
    """Load libraries that name each other: a process looks for them where it did at its start only."""
    while libraries:
        left = [library for library in libraries if not _is_loaded(library)]
        if len(left) == len(libraries):
            return  # what cannot be loaded says so where it is imported
        libraries = left


def _is_loaded(library: Path) -> bool:
    try:
        ctypes.CDLL(str(library), mode=ctypes.RTLD_GLOBAL)
    except OSError:
        return False
    return True
