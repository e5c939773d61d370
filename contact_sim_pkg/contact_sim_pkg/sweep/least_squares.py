"""The place of least squares of a residual that costs a run: Levenberg's and Marquardt's steps within bounds, on slopes that
follow from the steps themselves.

Slopes are differences of `STEP` where they must be, and else Broyden's: the least change that explains what the last step
gave (Mathematics of Computation 19 (1965) 577). The end is where the next step would gain less than chance can tell.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from scipy import optimize

__all__ = ["ROUGH", "STEP", "At", "Minimum", "minimum", "slopes"]

Field = NDArray[numpy.float64]
At = Callable[[Sequence[Field]], list[Field]]
"""Residuals of places in [0, 1]; those known do not cost a run."""

STEP = 3e-3
"""Of a parameter's range: of the differences."""
GAIN, ROUGH = 0.05, 0.5
"""Standard deviations of the parameters, together, that the next step would move less than: at the end, and on the way."""
MOST_STEPS = 30
POOR, GOOD = 0.25, 0.75
"""Of the gain that a step promised."""


class Minimum(NamedTuple):
    """Where a residual is least."""

    place: Field
    left: Field
    """the residual there"""
    slope: Field
    """by differences there [residuals, parameters]"""

    @property
    def square(self) -> float:
        """Sum of squares."""
        return float(self.left @ self.left)

    @property
    def freedom(self) -> int:
        """Residuals beyond the parameters."""
        return self.left.size - self.place.size


def minimum(at: At, start: Field, gain: float = GAIN, least: float = 0.0) -> Minimum:
    """The least squares near ``start``, until a step would move the parameters by less than ``gain`` of their standard
    deviations; these are of a residual's own scatter, or of ``least`` where that is less.
    """
    place, (left,) = start, at([start])
    slope, is_fresh, damping = slopes(at, place), True, 1e-4
    for _ in range(MOST_STEPS):
        step = _step(place, left, slope, damping)
        promised = float(left @ left) - float(numpy.sum((left + slope @ step) ** 2))
        freedom = max(left.size - place.size, 1)
        if promised <= gain**2 * max(float(left @ left) / freedom, least**2):
            if is_fresh:
                break
            slope, is_fresh = slopes(at, place), True
            continue
        tried = place + step
        (there,) = at([tried])
        kept = (float(left @ left) - float(there @ there)) / promised
        # What the step gave says how the slopes are along it
        slope = slope + numpy.outer(there - left - slope @ step, step) / float(step @ step)
        was_fresh, is_fresh = is_fresh, False
        if kept > 0.0:
            place, left = tried, there
        if kept > GOOD:
            damping *= 0.1
        elif kept < POOR:
            if was_fresh:
                damping = max(10.0 * damping, 1e-3)
            slope, is_fresh = slopes(at, place), True
    if not is_fresh:
        slope = slopes(at, place)
    return Minimum(place, left, slope)


def slopes(at: At, place: Field, step: float = STEP) -> Field:
    """Differences of a residual [residuals, parameters], towards the inside where an end of the range is near."""
    ways = numpy.where(place + step <= 1.0, step, -step)
    here, *there = at([place, *(place + way * line for way, line in zip(ways, numpy.eye(place.size), strict=True))])
    return numpy.array([(each - here) / way for each, way in zip(there, ways, strict=True)]).T


def _step(place: Field, left: Field, slope: Field, damping: float) -> Field:
    """The step of least squares within the bounds, each parameter held back in the measure of its own slope."""
    size = numpy.maximum(numpy.linalg.norm(slope, axis=0), 1e-12 * math.sqrt(float(numpy.sum(slope**2))) + 1e-300)
    held = numpy.diag(math.sqrt(damping) * size)
    # By the normal equations' root: as many rows as parameters, however many residuals there are
    orthogonal, root = numpy.linalg.qr(numpy.vstack([slope, held]))
    target = -(orthogonal[: left.size].T @ left)
    found = optimize.lsq_linear(root, target, (numpy.minimum(-place, -1e-15), numpy.maximum(1.0 - place, 1e-15)))
    return numpy.asarray(numpy.clip(place + found.x, 0.0, 1.0) - place)
