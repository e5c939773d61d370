"""`bench goals --start`: how long each scene takes to its first block, with nothing compiled and
with all kernels on disk.
"""

from __future__ import annotations

import os
import resource
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, NamedTuple

from contact_sim_pkg.python_process import python_command
from contact_sim_pkg.records.registry import shipped_scenes
from contact_sim_pkg.records.table import Section

__all__ = ["sections", "study"]

GOAL, GOAL_IN_SPACE, GOAL_WARM = 15.0, 25.0, 1.0  # [s]
IN_SPACE = "3d"  # part of the names of scenes with a rigid body in space


class _Start(NamedTuple):
    wall: float  # [s] of the whole process
    cpu: float  # [s] of the process and those that it started
    kernels: int  # on disk behind it


def study(progress: Callable[[str], None] | None = None, names: Iterable[str] | None = None) -> list[dict[str, Any]]:
    """A row a scene: seconds of wall and CPU time of a process that imports, prepares the scene and
    ends, from an empty cache (cold) and again (warm); number of its kernels; the goal of the
    cold start [s] and whether it was reached.

    ``names``: scenes; all that are shipped where None. Takes about ten minutes for all.
    """
    chosen = list(shipped_scenes() if names is None else names)
    rows = []
    for number, name in enumerate(chosen, 1):
        if progress is not None:
            progress(f"{name}: scene {number} of {len(chosen)}")
        with tempfile.TemporaryDirectory() as cache:
            cold, warm = _start(name, cache), _start(name, cache)
        goal = GOAL_IN_SPACE if IN_SPACE in name else GOAL
        rows.append({
            "scene": name, "kernels": cold.kernels, "cold [s]": cold.wall, "cold CPU [s]": cold.cpu, "goal [s]": goal,
            "warm [s]": warm.wall, "warm CPU [s]": warm.cpu, "reached": cold.wall <= goal and warm.wall <= GOAL_WARM,
        })  # fmt: skip
    return rows


def sections(rows: list[dict[str, Any]]) -> list[Section]:
    """The same rows as a person reads them, the dearest first."""
    shown = [{**row, "reached": "yes" if row["reached"] else "NO"} for row in rows]
    shown.sort(key=lambda row: -row["cold CPU [s]"])
    reached = sum(row["reached"] for row in rows)
    return [Section("first starts", shown, f"{reached} of {len(rows)} scenes; a warm start is to take {GOAL_WARM:g} s")]


def _start(name: str, cache: str) -> _Start:
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(
        python_command("contact_sim_lab.first_call", name, "--no-field"),
        env={**os.environ, "CONTACT_BENCH_CACHE": cache},
        stdout=subprocess.DEVNULL,
        check=True,
    )
    wall, after = time.perf_counter() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return _Start(wall, cpu, sum(path.is_file() for path in Path(cache).rglob("*")))
