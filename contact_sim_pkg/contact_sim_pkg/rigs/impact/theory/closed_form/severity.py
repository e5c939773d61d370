"""Which severity zeta belongs to a loss tangent: the frequency in the viscous force is the impact's
own, ``w = pi/tau``.

``zeta = 3 tan(beta) T_c(zeta)/pi``, or ``tan(beta) = pi zeta/(3 T_c(zeta))``. With the end rule
``force`` the right-hand side rises for all zeta (seen up to 1000), so every loss tangent has one
solution. With ``gap`` it has a largest value, 0.40373 at zeta = 2.2354: above it there is none
(`FoldError`), below it two, of which the smaller is taken: it begins at the elastic impact.

Source: Goloshchapov eqs 54, 55 and 60.
"""

from __future__ import annotations

import functools
import math

from contact_sim_pkg.rigs.impact.theory.checks import check_not_negative, check_number
from contact_sim_pkg.rigs.impact.theory.closed_form.force import lowest_force
from contact_sim_pkg.rigs.impact.theory.closed_form.scaled_motion import LARGEST_SEVERITY, scaled_impact
from contact_sim_pkg.rigs.impact.theory.errors import FoldError, ImpactError
from contact_sim_pkg.rigs.impact.theory.roots import bracketed_root

__all__ = [
    "LARGEST_LOSS_TANGENT",
    "fold",
    "loss_tangent_of_restitution",
    "loss_tangent_of_severity",
    "severity_of_loss_tangent",
]

LARGEST_LOSS_TANGENT = 100.0  # severity 72; what rebounds is far below
ELASTIC_DURATION = 3.21806545971904  # T_c without loss: 4/5 B(2/5, 1/2) (5/4)^(2/5)
NO_SEARCH_BELOW = 1.0e-8  # loss tangent: one round from the elastic impact is right to its square
SEVEREST = 100.0  # severity up to which a restitution is inverted


def loss_tangent_of_severity(severity: float, end: str) -> float:
    """``tan(beta) = pi zeta/(3 T_c)`` of a consistent impact at ``severity`` zeta. Errors as
    `scaled_impact`.

    severity and the result: [1].
    """
    lowest_force(end)
    if severity == 0.0:
        return 0.0
    return math.pi * severity / (3.0 * scaled_impact(severity, end).duration)


@functools.lru_cache(maxsize=1)
def fold() -> tuple[float, float]:
    """Severity and loss tangent, dimensionless, at the fold of the end rule ``gap``: (2.2354,
    0.40373).

    From the slope's change of sign. The slope is a central difference over 1e-4: the loss tangent
    is good to rounding, the severity to 1e-8.
    """

    def slope(severity: float) -> float:
        return loss_tangent_of_severity(severity + 1.0e-4, "gap") - loss_tangent_of_severity(severity - 1.0e-4, "gap")

    severity = bracketed_root(slope, 1.5, 3.0, 1.0e-12)
    return severity, loss_tangent_of_severity(severity, "gap")


def severity_of_loss_tangent(loss_tangent: float, end: str) -> float:
    """zeta of the consistent impact with ``loss_tangent``, 0 to 100; to a few units of rounding.

    Raises FoldError above the fold with the end rule ``gap``, ImpactError outside the range.
    loss_tangent and the result: [1].
    """
    check_not_negative("loss tangent", loss_tangent)
    lowest_force(end)
    if loss_tangent == 0.0:
        return 0.0
    high = LARGEST_SEVERITY
    if end == "gap":
        high, bound = fold()
        if loss_tangent > bound:
            raise FoldError(loss_tangent, bound)
    elif loss_tangent > LARGEST_LOSS_TANGENT:
        raise ImpactError(f"loss tangent {loss_tangent:g}: 0 to {LARGEST_LOSS_TANGENT:g} is the range of the model")
    # T_c is shorter with loss (force), longer (gap)
    elastic = 3.0 * ELASTIC_DURATION / math.pi * loss_tangent
    if loss_tangent < NO_SEARCH_BELOW:
        return 3.0 * loss_tangent / math.pi * scaled_impact(elastic, end).duration
    low, high = (0.0, min(high, elastic)) if end == "force" else (min(high, 0.9 * elastic), high)
    if end == "force":
        low = _bracket_below(loss_tangent, high)
    return bracketed_root(lambda severity: loss_tangent_of_severity(severity, end) / loss_tangent - 1.0, low, high)


def loss_tangent_of_restitution(restitution: float, end: str) -> float:
    """``tan(beta)`` whose consistent impact ends with ``restitution``, by inversion of k(zeta).

    Range: from 6.05e-4 (``force``, severity 100) or 0.0679 (``gap``, the fold), to 1. Raises
    ImpactError outside.
    restitution and the result: [1].
    """
    return loss_tangent_of_severity(severity_of_restitution(restitution, end), end)


def severity_of_restitution(restitution: float, end: str) -> float:
    """zeta with which the impact ends with ``restitution`` times its speed. Raises ImpactError
    outside the range.

    restitution and the result: [1].
    """
    check_number("restitution", restitution)
    high = fold()[0] if end == "gap" else SEVEREST
    lowest = scaled_impact(high, end).restitution
    if not lowest <= restitution <= 1.0:
        raise ImpactError(f"restitution {restitution:.6g}: {lowest:.4g} to 1 is the range with the end rule {end}")
    if restitution >= scaled_impact(0.0, end).restitution:  # 1 but for rounding
        return 0.0
    return bracketed_root(lambda severity: scaled_impact(severity, end).restitution - restitution, 0.0, high, 1.0e-15)


def _bracket_below(loss_tangent: float, high: float) -> float:
    """A severity with a smaller loss tangent than requested."""
    low = 0.5 * high
    while loss_tangent_of_severity(low, "force") > loss_tangent:
        low *= 0.5
    return low
