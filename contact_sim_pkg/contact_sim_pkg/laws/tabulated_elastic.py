"""Elastic law by a table: the force at evenly spaced approaches, between them the monotone piecewise
cubic of Fritsch and Carlson, beyond the last one a straight line.

In the piece of number i, with s the distance from its beginning: ``F = f + f' s + c s^2 + d s^3``,
stored energy ``u + f s + f' s^2/2 + c s^3/3 + d s^4/4``. Force and slope are continuous, the energy
is the integral of the force to the last digit. Beyond the last approach the slope stays; a run that
goes there leaves the range of the law.

Source: Fritsch and Carlson 1980; the slopes are those of Fritsch and Butland 1984 (PCHIP).
"""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require_positive, require_values
from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.laws.parameters import TabulatedElastic

ENERGY, FORCE, SLOPE, SECOND, THIRD, COLUMNS = 0, 1, 2, 3, 4, 5
BISECTIONS = 200


def tabulated_law(spacing: float, force: NDArray[numpy.float64]) -> TabulatedElastic:
    """The law through ``force`` [N] [nodes] at the approaches 0, ``spacing``, 2 ``spacing`` [m] ...

    Raises ValueError where the force does not begin at 0 or falls, or all of it is 0.
    """
    h = require_positive("spacing", spacing, "m")
    f = require_values("force", force, "N", shape=(None,), least=0.0)
    rise = numpy.diff(f)
    if len(f) < 3 or f[0] != 0.0 or (rise < 0.0).any() or f[-1] <= f[-2]:
        raise ValueError(
            "force: a table of at least 3 numbers that begins at 0 N, never falls and ends rising is needed"
        )
    slope = _slopes(rise / h)
    pieces = numpy.zeros((len(f), COLUMNS))
    pieces[:, FORCE], pieces[:, SLOPE] = f, slope
    secant, left, right = rise / h, slope[:-1], slope[1:]
    pieces[:-1, SECOND] = (3.0 * secant - 2.0 * left - right) / h
    pieces[:-1, THIRD] = (left + right - 2.0 * secant) / h**2
    stored = h * (f[:-1] + h * (left / 2.0 + h * (pieces[:-1, SECOND] / 3.0 + h * pieces[:-1, THIRD] / 4.0)))
    pieces[1:, ENERGY] = numpy.cumsum(stored)
    return TabulatedElastic(h, pieces)


def _slopes(secant: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
    """Slopes at the nodes [secants + 1]: harmonic means of neighbouring secants, 0 beside a level
    one; at the ends the three-point formula, within the bounds of monotony.
    """
    slope = numpy.zeros(len(secant) + 1)
    left, right = secant[:-1], secant[1:]
    total = left + right
    numpy.divide(2.0 * left * right, total, out=slope[1:-1], where=total > 0.0)
    for end, first, second in ((0, secant[0], secant[1]), (-1, secant[-1], secant[-2])):
        slope[end] = min(max(0.5 * (3.0 * first - second), 0.0), 3.0 * first)
    return slope


@borrowing_kernel
def _piece(law, approach):
    """Number of the piece that an approach above 0 lies in, and the distance from its beginning."""
    last = law.pieces.shape[0] - 1
    i = last if approach >= last * law.spacing else int(approach / law.spacing)
    return i, approach - i * law.spacing


@borrowing_kernel
def tabulated_force(law: TabulatedElastic, approach: float) -> float:
    """Force in [N] at ``approach`` in [m]; 0 for ``approach <= 0``."""
    if approach <= 0.0:
        return 0.0
    i, s = _piece(law, approach)
    p = law.pieces
    return p[i, FORCE] + s * (p[i, SLOPE] + s * (p[i, SECOND] + s * p[i, THIRD]))


@borrowing_kernel
def tabulated_order(law: TabulatedElastic) -> float:
    """Power [1] of the approach with which the force begins: 1, or 2 where the slope begins at 0."""
    return 1.0 if law.pieces[0, SLOPE] > 0.0 else 2.0


@borrowing_kernel
def tabulated_stiffness(law: TabulatedElastic, approach: float) -> float:
    """Slope dF/dx in [N/m] at ``approach`` in [m]; 0 for ``approach <= 0``."""
    if approach <= 0.0:
        return 0.0
    i, s = _piece(law, approach)
    p = law.pieces
    return p[i, SLOPE] + s * (2.0 * p[i, SECOND] + s * 3.0 * p[i, THIRD])


@borrowing_kernel
def tabulated_energy(law: TabulatedElastic, approach: float) -> float:
    """Energy stored at ``approach`` in [J]; 0 for ``approach <= 0``."""
    if approach <= 0.0:
        return 0.0
    i, s = _piece(law, approach)
    p = law.pieces
    cubic = p[i, FORCE] + s * (p[i, SLOPE] / 2.0 + s * (p[i, SECOND] / 3.0 + s * p[i, THIRD] / 4.0))
    return p[i, ENERGY] + s * cubic


@borrowing_kernel
def tabulated_approach_of_force(law: TabulatedElastic, force: float) -> float:
    """Approach in [m] at which the law gives ``force`` in [N], by bisection to the last digit; 0
    for ``force <= 0``.
    """
    if force <= 0.0:
        return 0.0
    last = law.pieces.shape[0] - 1
    if force >= law.pieces[last, FORCE]:
        return last * law.spacing + (force - law.pieces[last, FORCE]) / law.pieces[last, SLOPE]
    low, high = 0.0, last * law.spacing
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        if tabulated_force(law, middle) < force:
            low = middle
        else:
            high = middle
    return high
