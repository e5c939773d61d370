"""Single obstacles on a flat road: raised-cosine bump, cleat, step, pothole, once or again and
again.
"""

from math import isfinite, pi
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError

SHAPES = ("bump", "cleat", "step", "pothole")
TALLEST = 2.0  # [m] plausibility bound; catches millimetres written for metres


class FlatRoad:
    """Height 0 everywhere."""

    def heights(self, x: NDArray[numpy.float64], y: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Zeros, [len(x), len(y)]."""
        return numpy.zeros((len(x), len(y)))

    def describe(self) -> dict[str, Any]:
        """See blocks.Surface."""
        return {"kind": "flat", "notes": []}


class Obstacle:
    """One obstacle across the whole track, its middle at `position`; with s = x - position the
    shapes are

    bump:     height/2 (1 + cos(2 pi s / length))          for |s| < length / 2
    cleat:    height, with straight flanks of `flank` length inside the length (0: rectangular, sharp edges)
    step:     0 before, height after; a straight ramp of `length` (0: sharp edge); never ends
    pothole:  the cleat downwards: -height
    """

    def __init__(
        self, shape: str, position: float, height: float, length: float, flank: float = 0.0, period: float | None = None
    ) -> None:
        """Place the obstacle.

        Args:
            shape: bump, cleat, step or pothole. position: of the middle along the road, [m].
            height: of a bump, cleat or step (negative: downwards), depth of a pothole, [m], within
            +-2. length: along the road, [m], 0 only for a step. flank: length of each straight
            flank of a cleat or pothole, [m], 0 to length / 2. period: distance to the next equal
            obstacle, [m], at least the length; None: there is one. Not for a step.

        Raises:
            ExcitationError: an unknown shape or a value out of range.
        """
        self.shape, self.position, self.height = shape, position, height
        self.length, self.flank, self.period = length, flank, period
        self._check()

    def _check(self) -> None:
        if self.shape not in SHAPES:
            raise ExcitationError(f"obstacle '{self.shape}' is unknown; allowed: {', '.join(SHAPES)}")
        step = self.shape == "step"
        shortest = self.length >= 0.0 if step else self.length > 0.0
        rules = (
            ("position", self.position, isfinite(self.position), "a finite number of metres"),
            ("height", self.height, abs(self.height) <= TALLEST, f"within +-{TALLEST:g} m"),
            ("length", self.length, shortest and isfinite(self.length), "above 0 m (a step: from 0 m)"),
            ("flank", self.flank, 0.0 <= self.flank <= 0.5 * self.length or self.flank == 0.0, "0 to half the length"),
            ("period", self.period, self.period is None or (not step and self.length <= self.period < float("inf")),
             "at least the length, and none for a step"),
        )  # fmt: skip
        for name, value, fine, allowed in rules:
            if not fine:
                raise ExcitationError(f"{name} of the {self.shape} is {value}; allowed: {allowed}")

    def heights(self, x: NDArray[numpy.float64], y: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Heights in [m], [len(x), len(y)]; the same across the track. See blocks.Surface."""
        s = x - self.position
        if self.period is not None:
            s = s - self.period * numpy.round(s / self.period)
        return numpy.repeat(self._profile(s)[:, None], len(y), axis=1)

    def _profile(self, s: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        inside = numpy.abs(s) < 0.5 * self.length
        if self.shape == "bump":
            return numpy.where(inside, 0.5 * self.height * (1.0 + numpy.cos(2.0 * pi * s / self.length)), 0.0)
        if self.shape == "step":
            return self.height * _ramp(s + 0.5 * self.length, self.length)
        sign = -1.0 if self.shape == "pothole" else 1.0
        return sign * self.height * inside * _ramp(0.5 * self.length - numpy.abs(s), self.flank)

    def describe(self) -> dict[str, Any]:
        """See blocks.Surface."""
        return {
            "kind": self.shape, "position_m": self.position, "height_m": self.height, "length_m": self.length,
            "flank_m": self.flank, "period_m": self.period, "notes": [],
        }  # fmt: skip


def _ramp(s: NDArray[numpy.float64], length: float) -> NDArray[numpy.float64]:
    """0 below s = 0, 1 from s = length, straight in between; a sharp edge where length is 0."""
    if length == 0.0:
        return numpy.where(s >= 0.0, 1.0, 0.0)
    return numpy.clip(s / length, 0.0, 1.0)
