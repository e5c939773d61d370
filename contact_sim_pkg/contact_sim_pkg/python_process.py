"""What a process of Python owes to the folder it is started in: nothing. A module is started without that folder on its path,
and no library takes settings from there.

A folder that a stranger's scene or bag was unpacked into may hold a `numpy.py`, which `python -m` would import, and the files of
`READ_THERE`, which libraries read unasked.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any

__all__ = ["SETTINGS", "disregard_current_folder", "drop_empty_entries", "python_command"]

READ_THERE = {
    "DEFAULT_FASTRTPS_PROFILES.xml": "Fast DDS, in each process that opens ROS; SKIP_DEFAULT_XML_FILE=1",
    ".numba_config.yaml": "numba, on import and at each compilation; imported from elsewhere, then named elsewhere",
    "matplotlibrc": "matplotlib, on import, before the user's own; imported from elsewhere",
    "*.py": "Python, for `-m` and for an empty entry of PYTHONPATH; `-P`, and no empty entries",
    "*.so": "the loader of programs, for an empty entry of LD_LIBRARY_PATH; no empty entries",
    "share/ament_index": "ROS, for an empty entry of AMENT_PREFIX_PATH; no empty entries",
}
"""All that the bench's own dependencies would read from the current folder: who, and what keeps them from it."""

SETTINGS = {"SKIP_DEFAULT_XML_FILE": "1", "PYDANTIC_DISABLE_PLUGINS": "__all__"}
"""For the environment of each process, where the caller has not set them. The second: pydantic would read the descriptions of all
installed packages, and end at the first broken one.
"""

SEARCH_PATHS = ("PYTHONPATH", "LD_LIBRARY_PATH", "AMENT_PREFIX_PATH")


def python_command(module: str, *arguments: str) -> list[str]:
    """Command that runs a module, by its full name, with this interpreter, the current folder not being searched."""
    return [sys.executable, "-P", "-m", module, *arguments]


def drop_empty_entries() -> None:
    """Remove empty entries of search paths in the environment: they stand for the current folder.

    `export PYTHONPATH=$PYTHONPATH:/opt/mine` leaves one behind where the variable was empty before.
    """
    for name in SEARCH_PATHS:
        if name in os.environ:
            os.environ[name] = os.pathsep.join(filter(None, os.environ[name].split(os.pathsep)))


def disregard_current_folder() -> None:
    """Keep this process, and those that it starts, from the files of `READ_THERE`. To be called before the libraries are
    imported, by programs of the bench alone: a script of the user's has a folder of its own.
    """
    drop_empty_entries()
    for name, value in SETTINGS.items():
        os.environ.setdefault(name, value)
    if not any(isinstance(finder, _ImportedElsewhere) for finder in sys.meta_path):
        sys.meta_path.insert(0, _ImportedElsewhere())


class _ImportedElsewhere:
    """Imports the libraries that read the current folder while the process stands in the root of the file system."""

    LIBRARIES = ("numba", "matplotlib")

    def find_spec(self, name: str, path: Sequence[str] | None, target: ModuleType | None = None) -> ModuleSpec | None:
        """What the other finders find, to be executed elsewhere; None for every other module."""
        if name not in self.LIBRARIES:
            return None
        others = (finder for finder in sys.meta_path if finder is not self)
        spec = next(filter(None, (finder.find_spec(name, path, target) for finder in others)), None)
        if spec is not None and spec.loader is not None:
            loader: Any = spec.loader
            execute = loader.exec_module

            def exec_module(module: ModuleType) -> None:
                with _elsewhere():
                    execute(module)
                if name == "numba":  # which looks again at each compilation
                    sys.modules["numba.core.config"]._config_fname = os.devnull  # type: ignore[attr-defined]

            loader.exec_module = exec_module
        return spec


@contextmanager
def _elsewhere() -> Iterator[None]:
    """Meanwhile the current folder is the root. A folder that cannot be opened to come back to is not left."""
    try:
        here = os.open(".", os.O_PATH | os.O_DIRECTORY)
    except OSError:
        yield
        return
    os.chdir("/")
    try:
        yield
    finally:
        with suppress(OSError):
            os.fchdir(here)
        os.close(here)
