"""Restitution, contact time, depth and peak force over the loss tangent, by look-up: Chebyshev
series in ``sqrt(tan(beta))``.

In that variable the results are smooth down to no loss: contact ends at ``u = sqrt(zeta k)``. Made
at first use from 41 solutions. Largest error seen over both tables: 1.6e-14 in k, T_c and X_m,
6.3e-12 in the peak force.

Source: Goloshchapov eqs 54 and 61 to 71.
"""

from __future__ import annotations

import functools
import math
from typing import NamedTuple

import numpy
from numpy.polynomial import chebyshev

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.rigs.impact.theory.checks import check_number
from contact_sim_pkg.rigs.impact.theory.closed_form.force import lowest_force
from contact_sim_pkg.rigs.impact.theory.closed_form.scaled_motion import scaled_impact
from contact_sim_pkg.rigs.impact.theory.closed_form.severity import severity_of_loss_tangent
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError

__all__ = ["LIMITS", "TableEntry", "look_up"]

LIMITS = {"force": 2.0, "gap": 0.3}
"""Largest loss tangent of each end rule; `gap` stays away from its fold, where the slope has no
bound.
"""
DEGREE = 40


class TableEntry(NamedTuple):
    """In units of L and V0, as `scaled_motion.ScaledImpact`."""

    restitution: float
    duration: float
    depth: float
    peak_force: float


def look_up(loss_tangent: float, end: str = "force") -> TableEntry:
    """The consistent impact at ``loss_tangent``, 0 to the limit of the end rule. Raises ImpactError
    outside.

    loss_tangent: [1].
    """
    lowest_force(end)
    limit, loss_tangent = LIMITS[end], check_number("loss tangent", loss_tangent)
    if not 0.0 <= loss_tangent <= limit:
        raise ImpactError(f"loss tangent {loss_tangent:g}: the table of the end rule {end} holds 0 to {limit:g}")
    place = 2.0 * math.sqrt(loss_tangent / limit) - 1.0
    return TableEntry(*_values(_series(end), place))


@entry
def _values(series: Vector, place: float) -> tuple[float, float, float, float]:
    """Clenshaw's recursion on the four series."""
    first, second = numpy.zeros(4), numpy.zeros(4)
    for order in range(series.shape[0] - 1, 0, -1):
        for quantity in range(4):
            value = series[order, quantity] + 2.0 * place * first[quantity] - second[quantity]
            second[quantity] = first[quantity]
            first[quantity] = value
    for quantity in range(4):
        first[quantity] = series[0, quantity] + place * first[quantity] - second[quantity]
    return first[0], first[1], first[2], first[3]


@functools.lru_cache(maxsize=2)
def _series(end: str) -> Vector:
    """Coefficients [order, quantity]."""
    places = chebyshev.chebpts1(DEGREE + 1)
    rows = []
    for place in places:
        loss_tangent = LIMITS[end] * (0.5 * (float(place) + 1.0)) ** 2
        found = scaled_impact(severity_of_loss_tangent(loss_tangent, end), end)
        rows.append((found.restitution, found.duration, found.depth, found.peak_force))
    return numpy.asarray(chebyshev.chebfit(places, numpy.array(rows), DEGREE))
