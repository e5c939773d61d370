"""Which solver does how much of which problem. Slow ones do less; the output says how much each did."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

from comparisons.field.problems import Problem, hertz, rough, tire
from comparisons.field.solver import OURS

__all__ = ["FULL", "QUICK", "Share", "Task"]


class Share(NamedTuple):
    """What one solver does of a task."""

    tolerances: tuple[float, ...]  # in its own sense, from loose to tight
    seeds: int
    solves: int  # of each seed and tolerance: the same field again and again, or steps of a sequence


class Task(NamedTuple):
    """One problem on one grid."""

    name: str
    problem: Callable[[int], Problem]  # of a seed
    sequence: bool
    asked: tuple[float, ...]  # errors that times are read at
    shares: dict[str, Share]


def _hertz(cells: int, solves: int, slow: int) -> Task:
    shares = {
        OURS: Share((1e-2, 1e-3, 1e-4, 1e-6, 1e-8), 1, solves),
        "ASPHER": Share((1e-4, 1e-5, 1e-6, 1e-8), 1, slow),
        "tamaas": Share((1e-3, 1e-5, 1e-7), 1, slow),
    }
    return Task(f"(a) Hertz, {cells}²", lambda _seed: hertz(cells), False, (1e-3, 1e-5), shares)


def _rough(cells: int, mean_pressure: float, solves: int, slow: int) -> Task:
    shares = {
        OURS: Share((1e-2, 1e-3, 1e-4, 1e-6), 1, solves),
        "ASPHER": Share((1e-3, 1e-4, 1e-5, 1e-6), 1, slow),
        "tamaas": Share((1e-2, 1e-3, 1e-4), 1, slow),
    }
    name = f"(b) rough, periodic, {cells}², {mean_pressure:g} E*"
    return Task(name, partial(rough, cells, mean_pressure), False, (1e-3,), shares)


def _cold(grid: str, asked: tuple[float, ...], ours: Share, aspher: Share, tamaas: Share) -> Task:
    shares = {OURS: ours, "ASPHER": aspher, "tamaas": tamaas}
    return Task(f"(c) tire, cold, {grid}", partial(tire, grid), False, asked, shares)


def _sequence(grid: str, cells: int, asked: tuple[float, ...], shares: dict[str, Share]) -> Task:
    name = f"(d) tire, sequence, {grid}" + (f", {cells} cells a step" if cells > 1 else "")
    return Task(name, partial(_tire, grid, cells), True, asked, shares)


def _tire(grid: str, cells: int, seed: int) -> Problem:
    return tire(grid, seed, cells)


OURS_COLD = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
OURS_ROLLING = (3e-2, 1e-2, 3e-3, 1e-3, 1e-4, 1e-5, 1e-6)
ASPHER_COLD = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
ASPHER_ROLLING = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
TAMAAS_COLD = (1e-3, 1e-4, 1e-5, 1e-6)
TAMAAS_ROLLING = (1e-2, 1e-3, 1e-4, 1e-5)

SHIPPED = 31
"""Cells that the road moves from one field of the shipped scenes to the next: 25 to 37, a quarter of the
patch. Of the field before little is left under the tire.
"""

FULL = (
    _hertz(128, 9, 9),
    _hertz(512, 9, 3),
    _rough(512, 0.0027, 9, 3),
    _rough(512, 0.018, 9, 3),
    _cold("128x96", (1e-3, 1e-5), Share(OURS_COLD, 5, 9), Share(ASPHER_COLD, 5, 9), Share(TAMAAS_COLD, 5, 3)),
    _cold("256x192", (1e-3, 1e-5), Share(OURS_COLD, 5, 9), Share(ASPHER_COLD, 5, 9), Share(TAMAAS_COLD, 2, 3)),
    _sequence(
        "128x96",
        1,
        (1e-2, 1.5e-3, 1e-4),
        {
            OURS: Share(OURS_ROLLING, 5, 200),
            "ASPHER": Share(ASPHER_ROLLING, 3, 200),
            "tamaas": Share(TAMAAS_ROLLING, 2, 40),
        },
    ),
    _sequence("128x96", 2, (1e-2, 1.5e-3, 1e-4), {OURS: Share(OURS_ROLLING, 2, 200)}),
    _sequence(
        "128x96",
        SHIPPED,
        (1e-2, 1.5e-3, 1e-4),
        {
            OURS: Share(OURS_ROLLING, 3, 200),
            "ASPHER": Share(ASPHER_ROLLING, 2, 60),
            "tamaas": Share(TAMAAS_ROLLING, 1, 20),
        },
    ),
    _sequence("256x192", 1, (1e-2, 1.5e-3, 3e-4), {OURS: Share(OURS_ROLLING, 2, 200)}),
)

QUICK = (
    _hertz(128, 3, 1),
    _rough(128, 0.018, 3, 1),
    _cold("128x96", (1e-3, 1e-5), Share(OURS_COLD, 1, 3), Share(ASPHER_COLD, 1, 3), Share(TAMAAS_COLD, 1, 1)),
    _sequence(
        "128x96",
        1,
        (1e-2, 1.5e-3, 1e-4),
        {
            OURS: Share(OURS_ROLLING, 1, 20),
            "ASPHER": Share(ASPHER_ROLLING, 1, 20),
            "tamaas": Share(TAMAAS_ROLLING, 1, 6),
        },
    ),
    _sequence(
        "128x96",
        SHIPPED,
        (1e-2, 1.5e-3, 1e-4),
        {
            OURS: Share(OURS_ROLLING, 1, 20),
            "ASPHER": Share(ASPHER_ROLLING, 1, 10),
            "tamaas": Share(TAMAAS_ROLLING, 1, 4),
        },
    ),
)
