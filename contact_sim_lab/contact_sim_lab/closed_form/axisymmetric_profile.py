"""Profiles of rigid axisymmetric bodies: a power law, a slope, or a table, for
`closed_form/axisymmetric.py`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require, require_count, require_values

__all__ = ["AxisymmetricError", "PowerProfile", "Profile", "SlopeProfile", "refuse_profile", "tabulated_profile"]

Field = NDArray[numpy.float64]


class AxisymmetricError(ValueError):
    """The profile, or the requested contact, has no disc-shaped contact; the text says why."""


class PowerProfile(NamedTuple):
    """`f(r) = C r^k`: cone k = 1, paraboloid k = 2 (C = 1/(2R)), flatter tips above."""

    coefficient: float  # [m^(1-k)] C > 0
    exponent: float  # [1] k >= 1


class SlopeProfile(NamedTuple):
    """A profile by its slope."""

    slope: Callable[[Field], Field]  # f'(r) [1] of an array of radii [m]
    breaks: tuple[float, ...] = ()  # [m] rising radii > 0 where f' or a derivative of it jumps
    reach: float = math.inf  # [m] largest radius the slope is known for
    nodes: int = 48  # Gauss points between two breaks


Profile = PowerProfile | SlopeProfile


def tabulated_profile(radius: Field, height: Field) -> SlopeProfile:
    """Profile through points: monotone cubic polynomials (Fritsch and Carlson 1980), level at the
    tip.

    radius: [m] rising from 0; height: [m] not falling, both float64 [points], at least 3 points.
    Raises `AxisymmetricError` for other tables.
    """
    radius, height = numpy.array(radius, dtype=float), numpy.array(height, dtype=float)
    _refuse_table(radius, height)
    step = numpy.diff(radius)
    secant = numpy.diff(height) / step
    # Slopes at the points: weighted harmonic means of the secants.
    knot_slope = numpy.zeros(radius.size)
    knot_slope[-1] = secant[-1]
    left, right = secant[:-1], secant[1:]
    with numpy.errstate(divide="ignore", invalid="ignore"):
        weight_left, weight_right = 2.0 * step[1:] + step[:-1], step[1:] + 2.0 * step[:-1]
        harmonic = (weight_left + weight_right) / (weight_left / left + weight_right / right)
    knot_slope[1:-1] = numpy.where(left * right > 0.0, harmonic, 0.0)

    def slope(r: Field) -> Field:
        # Quadratic slope between two points.
        i = numpy.clip(numpy.searchsorted(radius, r, side="right") - 1, 0, step.size - 1)
        z = (r - radius[i]) / step[i]
        start, end = knot_slope[i], knot_slope[i + 1]
        return numpy.asarray(
            start + z * (6.0 * secant[i] - 4.0 * start - 2.0 * end) * (1.0 - z) + z * z * (end - start)
        )

    return SlopeProfile(slope, tuple(float(r) for r in radius[1:-1]), float(radius[-1]), 12)


def refuse_profile(profile: Profile) -> None:
    """Raise `AxisymmetricError` for a power law without a contact of one disc, and for breaks,
    reach or nodes that are none.
    """
    if isinstance(profile, SlopeProfile):
        require_values("profile: breaks", profile.breaks, "m", above=0.0, rising=True, error=AxisymmetricError)
        require("profile: reach", profile.reach, "m", above=0.0, infinite=True, error=AxisymmetricError)
        require_count("profile: nodes", profile.nodes, error=AxisymmetricError)
        return
    if not (0.0 < profile.coefficient < math.inf and 1.0 <= profile.exponent < math.inf):
        raise AxisymmetricError(
            f"axisymmetric contact: C = {profile.coefficient}, k = {profile.exponent}; allowed are C > 0 and k >= 1"
        )


def _refuse_table(radius: Field, height: Field) -> None:
    if radius.ndim != 1 or radius.shape != height.shape or radius.size < 3:
        raise AxisymmetricError(
            f"profile table: shapes {radius.shape} and {height.shape}, wanted are two rows of 3 or more"
        )
    if not (numpy.all(numpy.isfinite(radius)) and numpy.all(numpy.isfinite(height))):
        raise AxisymmetricError("profile table: a radius or a height is not a finite number")
    if radius[0] != 0.0 or not numpy.all(numpy.diff(radius) > 0.0):
        raise AxisymmetricError(f"profile table: radii must rise from 0, they start at {radius[0]} m")
    if not (numpy.all(numpy.diff(height) >= 0.0) and height[-1] > height[0]):
        raise AxisymmetricError("profile table: heights must rise from the tip outwards")
