"""The one way to start a module of Python as a process of its own, with nothing of the current folder on its path.

A folder that a stranger's scene or bag was unpacked into may hold a `numpy.py`; `python -m` would import it.
"""

from __future__ import annotations

import os
import sys

__all__ = ["drop_empty_entries", "python_command"]

_RUN_MODULE = """\
import sys
del sys.path[0]
import runpy
runpy.run_module(sys.argv.pop(1), run_name="__main__", alter_sys=True)
"""


def python_command(module: str, *arguments: str, version: tuple[int, ...] = sys.version_info[:2]) -> list[str]:
    """Command that runs a module with this interpreter, the current folder not being searched.

    Args:
        module: full name of the module.
        arguments: arguments of the module.
        version: version of the interpreter; before 3.11 it has no option `-P`.
    """
    start = ["-P", "-m"] if version >= (3, 11) else ["-c", _RUN_MODULE]
    return [sys.executable, *start, module, *arguments]


def drop_empty_entries(name: str = "PYTHONPATH") -> None:
    """Remove empty entries of a search path in the environment: Python takes one for the current folder.

    `export PYTHONPATH=$PYTHONPATH:/opt/mine` leaves one behind where the variable was empty before.
    """
    if name in os.environ:
        os.environ[name] = os.pathsep.join(filter(None, os.environ[name].split(os.pathsep)))
