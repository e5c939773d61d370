"""Times of relaxation and retardation, and how they hang together (Goloshchapov eqs 114-118)."""

from __future__ import annotations

import math

from contact_sim_pkg.rigs.impact.theory.checks import check_not_negative, check_positive
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError

__all__ = ["decay_time", "maxwell_time", "retardation_time", "retardation_time_of_decay", "retardation_time_of_impact"]


def maxwell_time(frequency: float, loss_tangent: float) -> float:
    """``tau_ME = 1/(w tan(beta))`` in [s] (eq 114); infinite without loss."""
    check_positive("frequency", frequency, "rad/s")
    return math.inf if check_not_negative("loss tangent", loss_tangent) == 0.0 else 1.0 / (frequency * loss_tangent)


def retardation_time(frequency: float, loss_tangent: float) -> float:
    """``tau_KE = tan(beta)/w`` in [s] (eq 115)."""
    return check_not_negative("loss tangent", loss_tangent) / check_positive("frequency", frequency, "rad/s")


def retardation_time_of_impact(duration: float, loss_tangent: float) -> float:
    """``tau_KE = tau tan(beta)/pi`` in [s] (eq 116)."""
    return check_positive("duration", duration, "s") * check_not_negative("loss tangent", loss_tangent) / math.pi


def decay_time(damping: float) -> float:
    """``tau_w = 1/delta`` in [s] (eq 117): an oscillation falls to 1/e of its amplitude."""
    return 1.0 / check_positive("damping", damping, "1/s")


def retardation_time_of_decay(
    decay: float, loss_tangent: float, natural_frequency: float, form: str = "corrected"
) -> float:
    """``tau_KE = tau_w tan(beta)/sqrt((w0 tau_w)^2 - 1)`` in [s] (eq 118 corrected), w0 the
    undamped frequency [rad/s].

    As printed ``tau_w tan(beta)/sqrt(1 + w0^2)``, whose w0 has a unit. Raises ImpactError where
    nothing oscillates, w0 tau_w <= 1.
    """
    check_positive("decay time", decay, "s")
    check_positive("natural frequency", natural_frequency, "rad/s")
    check_not_negative("loss tangent", loss_tangent)
    if form == "printed":
        return decay * loss_tangent / math.sqrt(1.0 + natural_frequency**2)
    if form != "corrected":
        raise ValueError(f"form '{form}': corrected or printed is needed")
    # Below 1 nothing oscillates.
    product = natural_frequency * decay
    if product <= 1.0:
        raise ImpactError(
            f"natural frequency times decay time {product:.4g}: above 1 is needed, below nothing oscillates"
        )
    return decay * loss_tangent / math.sqrt((product - 1.0) * (product + 1.0))
