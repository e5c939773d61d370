"""Closed forms for the impact: constant parameters of equal work, restitution, depth and time
(Goloshchapov eqs 56-71).

``m x'' + B x' + C x = 0`` with B and C constant, so that their works over the compression are those
of the variable ones:

    C = 16/15 k_p E' sqrt(R x_m),   B = beta k_p E'' sqrt(R x_m)/w,   beta = 4 I1/I2 = 8 B(3/4,
    3/2)/pi = 2.44079...

with I1, I2 the integrals of sqrt(s)sqrt(1 - s^2) and sqrt(1 - s^2) over 0..1 (speed of a damped
sine). `printed`: beta = 16/5, which supposes a speed in proportion to x, so none at first touch.
Inexpensive formulas beside `rigs/impact/theory/motion.py`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.checks import check_fields, check_not_negative, check_number, check_positive
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.geometry import SMALL_SHAPE_FACTOR

__all__ = [
    "LOSS_FACTORS",
    "ClosedImpact",
    "closed_duration",
    "closed_restitution",
    "damped_sine",
    "depth_of_restitution",
    "loss_factor_limit",
    "restitution_note",
]

FORMS = ("corrected", "printed")
BETA = {"printed": 16.0 / 5.0, "corrected": 8.0 * math.gamma(0.75) * math.gamma(1.5) / math.gamma(2.25) / math.pi}
LOSS_FACTORS = {"printed": 3.0, "mean_speed": 6.0, "sine": 0.75 * math.pi**2}
"""Factor of tan(beta) in eq 61: as printed; with the whole viscous work at the mean speed; at the
speed of a sine.
"""
DURATION_FACTORS = {"printed": 5.0 / 8.0, "corrected": 15.0 / 16.0}
NEAR_LIMIT = 0.9


class ClosedImpact(NamedTuple):
    """Impact by a closed form, in SI units."""

    restitution: float
    duration: float  # [s]
    compression_time: float  # [s]
    depth: float  # [m]
    peak_force: float  # [N]
    frequency: float  # w [rad/s]
    damping: float  # delta [1/s]


def damped_sine(
    sphere: Sphere, material: Material, speed: float, form: str = "corrected", shape_factor: float = SMALL_SHAPE_FACTOR
) -> ClosedImpact:
    """Eqs 56-60: ``x = V0/w exp(-delta t) sin(w t)``, ``tau = pi/w``, k = exp(-pi delta/w).

    s = delta/w solves ``s = c tan(beta)(1 + s^2)``, c = 15 beta/32, 1.5 as printed. Real up to
    tan(beta) = 1/(2c): 0.43701, printed 1/3. Raises ImpactError above, and for a mass, radius,
    modulus, speed or shape factor that is not above 0.
    speed: [m/s]; shape_factor: [1].
    """
    _check_case(sphere, material.storage_modulus, speed, shape_factor)
    s = damping_ratio(material.loss_tangent, form)
    angle = math.atan2(1.0, s)  # w t at the turning point
    fall = math.exp(-s * angle)
    stiffness = 16.0 / 15.0 * shape_factor * material.storage_modulus * math.sqrt(sphere.radius) / sphere.mass
    depth = float((speed**2 * fall**2 / stiffness) ** 0.4)
    natural = math.sqrt(stiffness * math.sqrt(depth))
    frequency = natural / math.sqrt(1.0 + s * s)
    # Behind it the damper's fall outweighs the spring's rise
    peak_angle = max(0.0, 3.0 * angle - math.pi)
    peak = sphere.mass * speed * natural**2 / frequency * math.exp(-s * peak_angle) * math.sin(2.0 * angle - peak_angle)
    return ClosedImpact(
        math.exp(-math.pi * s), math.pi / frequency, angle / frequency, depth, peak, frequency, s * frequency
    )


def damping_ratio(loss_tangent: float, form: str = "corrected") -> float:
    """``s = delta/w`` of eqs 56-58, the smaller root of ``s = c tan(beta)(1 + s^2)``. Raises
    ImpactError above 1/(2c).

    loss_tangent and the result: [1].
    """
    check_not_negative("loss tangent", loss_tangent)
    c = 15.0 / 32.0 * _of(BETA, form)
    product = c * loss_tangent
    if product > 0.5:
        raise ImpactError(
            f"loss tangent {loss_tangent:.6g}: eqs 56-58 ({form}) have a real root up to {0.5 / c:.6g} only; "
            "integrate the equation of motion (solve_impact)"
        )
    return 2.0 * product / (1.0 + math.sqrt(1.0 - 4.0 * product**2))


def closed_restitution(loss_tangent: float, form: str = "printed") -> float:
    """Eq 66: ``k = (pi - f tan(beta))/(pi + f tan(beta))``, f of `LOSS_FACTORS` (printed 3). Raises
    ImpactError from pi/f on.

    loss_tangent and the result: [1].
    """
    check_not_negative("loss tangent", loss_tangent)
    limit = loss_factor_limit(form)
    if loss_tangent >= limit:
        raise ImpactError(
            f"loss tangent {loss_tangent:.6g}: eq 66 ({form}) ends below {limit:.6g}, where k reaches 0; "
            "integrate the equation of motion (solve_impact)"
        )
    return (limit - loss_tangent) / (limit + loss_tangent)


def restitution_note(loss_tangent: float, form: str = "printed") -> str | None:
    """A sentence where the loss tangent [1], >= 0, is above 0.9 of the end of eq 66, else None."""
    check_not_negative("loss tangent", loss_tangent)
    limit = loss_factor_limit(form)
    if loss_tangent <= NEAR_LIMIT * limit:
        return None
    return f"loss tangent {loss_tangent:.4g} is above {NEAR_LIMIT} of {limit:.4g}, where eq 66 has no rebound left"


def loss_factor_limit(form: str = "printed") -> float:
    """Loss tangent [1] at which eq 66 gives k = 0: pi/3 as printed."""
    return math.pi / _of(LOSS_FACTORS, form)


def depth_of_restitution(
    sphere: Sphere, storage_modulus: float, speed: float, restitution: float, shape_factor: float = SMALL_SHAPE_FACTOR
) -> float:
    """Eq 67: ``x_m = (15 m V0^2 k/(16 k_p E' sqrt R))^(2/5)`` in [m]; with k of eq 66 it is eq 68.

    SI units; k from 0 to 1, the rest above 0; raises ImpactError otherwise.
    """
    _check_case(sphere, storage_modulus, speed, shape_factor)
    check_number("restitution", restitution, least=0.0, most=1.0)
    energy = 15.0 * sphere.mass * speed**2 * restitution / 16.0
    return float((energy / (shape_factor * storage_modulus * math.sqrt(sphere.radius))) ** 0.4)


def closed_duration(
    sphere: Sphere,
    storage_modulus: float,
    speed: float,
    restitution: float,
    form: str = "corrected",
    shape_factor: float = SMALL_SHAPE_FACTOR,
) -> float:
    """Eq 71: ``tau^2 = -2 (1 + k) ln k/((1 - k) V0^(2/5) k^(1/5)) (f m/(k_p E' sqrt R))^(4/5)``, f
    = 15/16, printed 5/8; in [s].

    For k -> 1 the logarithm is a series: -ln k (1 + k)/(1 - k) -> 2. Range 0 < k <= 1, the rest
    above 0; raises ImpactError otherwise.
    """
    _check_case(sphere, storage_modulus, speed, shape_factor)
    check_number("restitution", restitution, above=0.0, most=1.0)
    # -ln k/(1 - k), without cancellation near k = 1.
    loss = 1.0 - restitution
    ratio = 1.0 if loss == 0.0 else -math.log1p(-loss) / loss
    mass = _of(DURATION_FACTORS, form) * sphere.mass / (shape_factor * storage_modulus * math.sqrt(sphere.radius))
    return float(math.sqrt(2.0 * (1.0 + restitution) * ratio) / (speed * math.sqrt(restitution)) ** 0.2 * mass**0.4)


def _check_case(sphere: Sphere, storage_modulus: float, speed: float, shape_factor: float) -> None:
    check_fields("sphere", sphere, positive="mass radius")
    check_positive("storage modulus", storage_modulus, "Pa")
    check_positive("impact speed", speed, "m/s")
    check_positive("shape factor", shape_factor)


def _of(table: dict[str, float], form: str) -> float:
    if form not in table:
        raise ValueError(f"form '{form}': {' or '.join(table)} is needed")
    return table[form]
