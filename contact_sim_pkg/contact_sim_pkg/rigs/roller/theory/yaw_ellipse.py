"""What tilt and yaw need of the ellipse, as polynomials of the yaw: no elliptic root is solved for
in a step.

Under a load F the ellipse grows as F^(1/3) and the approach as F^(2/3), so three functions of the
yaw alone are left,

    a b / F^(2/3),        (a^2 - b^2) sin(2 phi) / F^(2/3),        approach / F^(2/3)

each a Chebyshev series of `TERMS` terms over a yaw interval, through the exact values at its nodes.
The interval is halved until the last two terms are below `ROUNDING` of the whole, and laid anew
about a yaw that leaves it. So the series are as exact as the root: 1e-14, where b/a is above 0.01;
for more slender ones what the root itself loses.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.rigs.roller.theory.ellipse import EXACT, rolling_contact
from contact_sim_pkg.rigs.roller.theory.parameters import Curvatures

__all__ = ["YawEllipse", "ellipse_at_yaw", "empty_fit", "exact_ellipse"]

Values = NDArray[numpy.float64]

TERMS = 12
WIDEST, NARROWEST = 0.1, 1e-3  # [rad] half an interval
ROUNDING = 1e-14


class YawEllipse(NamedTuple):
    """Of a contact under 1 N; under F [N] each is F^(2/3) times as large."""

    product: float  # a b [m^2/N^(2/3)]
    turned: float  # (a^2 - b^2) sin(2 phi) [m^2/N^(2/3)]
    approach: float  # [m/N^(2/3)]


@entry
def exact_ellipse(curvatures: Curvatures, modulus: float, yaw: float) -> YawEllipse:
    """At one yaw [rad] by the elliptic root; modulus: E* [Pa]. Not checked."""
    contact = rolling_contact(curvatures, yaw, modulus, 1.0, EXACT)
    a, b = contact.along_x, contact.along_y
    return YawEllipse(a * b, (a * a - b * b) * math.sin(2.0 * contact.angle), contact.approach)


@entry
def empty_fit() -> Values:
    """Room for the series, [4, TERMS], that holds none yet: middle and half width of the interval,
    then one row a function.

    Without arguments, so not checked.
    """
    fit = numpy.zeros((4, TERMS))
    fit[0, 1] = -1.0
    return fit


@entry
def ellipse_at_yaw(curvatures: Curvatures, modulus: float, yaw: float, fit: Values) -> YawEllipse:
    """From the series in `fit`, laid anew where the yaw [rad] is outside; curvatures and modulus as
    at the first call.

    Not checked.
    """
    if not abs(yaw - fit[0, 0]) <= fit[0, 1]:
        _lay(curvatures, modulus, yaw, fit)
    place = (yaw - fit[0, 0]) / fit[0, 1]
    last0, last1, last2, before0, before1, before2 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(TERMS - 1, 0, -1):  # Clenshaw
        last0, before0 = 2.0 * place * last0 - before0 + fit[1, k], last0
        last1, before1 = 2.0 * place * last1 - before1 + fit[2, k], last1
        last2, before2 = 2.0 * place * last2 - before2 + fit[3, k], last2
    return YawEllipse(
        place * last0 - before0 + fit[1, 0], place * last1 - before1 + fit[2, 0], place * last2 - before2 + fit[3, 0]
    )


@kernel
def _lay(curvatures: Curvatures, modulus: float, yaw: float, fit: Values) -> None:
    """Series about a yaw, over the widest interval that they hold on."""
    width, values = 2.0 * WIDEST, numpy.zeros((3, TERMS))
    fit[0, 0] = yaw
    while True:
        width *= 0.5
        fit[0, 1] = width
        for j in range(TERMS):
            node = math.cos(math.pi * (j + 0.5) / TERMS)
            here = exact_ellipse(curvatures, modulus, yaw + width * node)
            values[0, j], values[1, j], values[2, j] = here.product, here.turned, here.approach
        holds = True
        for row in range(3):
            holds = _series(values[row], fit[row + 1]) and holds
        if holds or width <= NARROWEST:
            return


@kernel
def _series(values: Values, terms: Values) -> bool:
    """Terms through values at the nodes; whether the last two are rounding."""
    largest = 0.0
    for k in range(TERMS):
        total = 0.0
        for j in range(TERMS):
            total += values[j] * math.cos(math.pi * k * (j + 0.5) / TERMS)
        terms[k] = (1.0 if k == 0 else 2.0) / TERMS * total
        largest = max(largest, abs(terms[k]))
    left = max(abs(terms[TERMS - 1]), abs(terms[TERMS - 2]))
    return bool(left <= ROUNDING * largest)
