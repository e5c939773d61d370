"""A published figure, and what the bench has in its place."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

__all__ = ["Published"]


@dataclass(frozen=True, kw_only=True)
class Published:
    """A quantity that somebody measured or computed, with its band. All values in ``unit``.

    Attributes:
        machine: what it is a quantity of: the heading that it stands under.
        quantity: with its conditions (load, excitation, grid), so that it can be measured again.
        unit: as printed.
        value: as published, with its scatter.
        band: lowest and highest value that agree with it.
        source: author, title or standard, year; whether the figure is quoted from another source.
        ours: computes the bench's value; some seconds at most.
        fitted: whether a constant of the bench was chosen by it.
        note: reason, where the bench leaves the band, and other remarks.
    """

    machine: str
    quantity: str
    unit: str
    value: str
    band: tuple[float, float]
    source: str
    ours: Callable[[], float]
    fitted: bool = False
    note: str = ""
