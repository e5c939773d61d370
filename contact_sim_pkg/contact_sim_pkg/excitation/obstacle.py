"""A single obstacle across an otherwise even road, once or again and again: what bump, cleat, step and pothole
have in common.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Iterator
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.blocks import Surface
from contact_sim_pkg.excitation.kinds import Obstacle, RoadKind, Setting, Wave
from contact_sim_pkg.records.breach import Breach, show
from contact_sim_pkg.records.fields import number

__all__ = [
    "ObstacleRoad", "edge_key", "height_key", "length_key", "period_key", "position_key", "profile_with_flanks",
    "ramp",
]  # fmt: skip

LEAST_NODES = 3.0
"""Cells along an obstacle below which a note is due."""
Array = NDArray[numpy.float64]


class ObstacleRoad(RoadKind):
    """An even road with an obstacle: a kind says where that is, and its height over the distance from its middle."""

    @abstractmethod
    def obstacle(self) -> Obstacle:
        """The obstacle."""

    @abstractmethod
    def profile(self, s: Array) -> Array:
        """Heights [m] at distances ``s`` [m] from the middle of the obstacle, [n] each."""

    @property
    def curvature(self) -> float:
        """Largest curvature [1/m] of a smooth one."""
        return 0.0

    def surface(self, setting: Setting) -> Surface:
        """See RoadKind."""
        return _OnLattice(self, setting.cell)

    def heights(self, x: Array, y: Array) -> Array:
        """Heights in [m], [len(x), len(y)]; the same across the track. See blocks.Surface."""
        found = self.obstacle()
        s = x - found.position
        if found.period is not None:
            s = s - found.period * numpy.round(s / found.period)
        return numpy.repeat(self.profile(s)[:, None], len(y), axis=1)

    def shortest_wave(self, limit: float) -> Wave:
        """See RoadKind: an edge or flank, or the length of a smooth one."""
        found = self.obstacle()
        length = min(found.length, found.flank) if found.has_corners else found.length
        part = f"{'flanks' if found.has_corners else 'a length'} of {length:g} m" if length > 0.0 else "an edge"
        return Wave(length, abs(found.height), f"the {self.kind} has {part}, shorter than", self.curvature)

    def is_reached(self, first: float, last: float) -> bool:
        """See RoadKind; of a row, the last one that is not beyond."""
        found = self.obstacle()
        place, beside = found.position, 0.5 * found.length
        if found.period is not None:
            place += found.period * math.floor((last + beside - place) / found.period)
        return first - beside <= place <= last + beside

    def breaches(self, duration: float) -> Iterator[Breach]:
        """See Kind."""
        found = self.obstacle()
        if found.period is not None and found.period < found.length:
            sentence = f"{show(found.period)} m is shorter than the obstacle's length of {show(found.length)} m"
            yield Breach("road.period", sentence, ("road.length",))
        if found.has_corners and found.ends and 2.0 * found.flank > found.length:
            sentence = (
                f"two edges of {show(found.flank)} m are longer than the obstacle's length of {show(found.length)} m"
            )
            yield Breach(f"road.{found.flank_key}", sentence, ("road.length",))


class _OnLattice:
    """The surface of an obstacle, and what cells may miss of it."""

    def __init__(self, road: ObstacleRoad, cell: float) -> None:
        self._road, self._cell, self.heights = road, cell, road.heights

    def describe(self) -> dict[str, Any]:
        """See blocks.Surface."""
        found, notes = self._road.obstacle(), []
        if found.ends and found.length < LEAST_NODES * self._cell:
            notes.append(
                f"The {self._road.kind} of {found.length:g} m is shorter than {LEAST_NODES:g} cells of the road's lattice "
                f"({self._cell:.3g} m each): its size is seen coarsely, or not at all where it falls between two nodes."
            )
        return {
            "kind": self._road.kind, "position_m": found.position, "height_m": found.height, "length_m": found.length,
            "flank_m": found.flank, "period_m": found.period, "notes": notes,
        }  # fmt: skip


def ramp(s: Array, length: float) -> Array:
    """0 below s = 0, 1 from s = length, straight in between; a sharp edge where length is 0. s: [n] [m]."""
    if length == 0.0:
        return numpy.where(s >= 0.0, 1.0, 0.0)
    return numpy.clip(s / length, 0.0, 1.0)


def profile_with_flanks(s: Array, height: float, length: float, flank: float) -> Array:
    """`height` over `length`, with straight flanks of `flank` inside it (0: rectangular, sharp edges). s: [n] [m]."""
    return height * (numpy.abs(s) < 0.5 * length) * ramp(0.5 * length - numpy.abs(s), flank)


def position_key(meaning: str = "middle of the obstacle along the road") -> Any:
    """The key `position`."""
    return number(-1e6, 1e6, "m", meaning, example=3.0)


def height_key(meaning: str, example: float) -> Any:
    """The key `height`."""
    return number(-0.5, 0.5, "m", meaning, example=example)


def length_key(example: float) -> Any:
    """The key `length`."""
    return number(0.001, 100.0, "m", "length along the road, flanks included", example=example)


def edge_key() -> Any:
    """The key `edge`."""
    return number(0.0, 50.0, "m", "length of each straight flank; 0 is a sharp edge", default=0.0)


def period_key() -> Any:
    """The key `period`."""
    return number(0.001, 1e6, "m", "distance to the next equal obstacle; without it there is one", default=None)
