"""What a sweep costs, said before it runs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from contact_sim_pkg.run.work import estimated_work
from contact_sim_pkg.sweep.case import FINISHED, kept_row, scene_of
from contact_sim_pkg.sweep.kept import Kept
from contact_sim_pkg.sweep.variation import Values

__all__ = ["Cost", "cost_of"]

MOST_READ = 200
"""Finished cases whose cost is read."""


class Cost(NamedTuple):
    """Of all cases of a sweep, as if none had run."""

    cases: int
    cpu: float
    """[s] of one core"""
    disk: float
    """[byte] of rows and bags that stay; nan where no case says"""
    measured: int
    """finished cases that this is taken from; 0: the estimate of the first scene, which is the least that is sure"""


def cost_of(scene: str, values: Sequence[Values], texts: tuple[str, ...], kept: Kept, folder: Path | None) -> Cost:
    """From the mean of the cases that a folder holds; without one, from the work of the first case's scene.

    Args:
        scene: a name or path.
        values: of each case.
        texts: what the first case sets.
        kept: bags that stay; those of the folder say how large one is.
        folder: of the sweep; None or without finished cases: nothing was measured.

    Raises SceneError: the first case is refused.
    """
    paths = [] if folder is None else sorted((folder / "cases").glob("*.json"))[:MOST_READ]
    rows = [(path, row) for path in paths if (row := kept_row(path)) is not None and row["outcome"] == FINISHED]
    if folder is None or not rows:
        seconds = sum(part.seconds for part in estimated_work(scene_of(scene, texts)))
        return Cost(len(values), len(values) * seconds, math.nan, 0)
    count = len(values)
    disk = count * _mean([path.stat().st_size for path, _ in rows])
    bags = [bag for bag in (folder / "bags").glob("*") if bag.is_dir()]
    size = _mean([sum(file.stat().st_size for file in bag.rglob("*") if file.is_file()) for bag in bags])
    staying = count if kept.all else min(kept.number, count)
    if staying:
        disk += staying * size
    # The worst run once more, with their bags
    runs = count + (0 if kept.all else staying)
    return Cost(count, runs * _mean([row["cpu"] for _, row in rows]), disk, len(rows))


def _mean(numbers: Sequence[float]) -> float:
    return sum(numbers) / len(numbers) if numbers else math.nan
