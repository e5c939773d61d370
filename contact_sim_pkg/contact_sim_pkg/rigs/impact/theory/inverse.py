"""The material of a measured impact: E' and tan(beta) from contact time, restitution and speed
(Goloshchapov eqs 104, 105).

Every form is ``E' = q h(k)``, ``tan(beta) = g(k)`` with ``q = m/(sqrt(V0 R) tau^(5/2))``. `exact`
(default) inverts the integrated motion: zeta from k, ``L = V0 tau/T_c``, ``E' = 3 m V0^2/(4 k_p
sqrt(R) L^(5/2))``, so ``h = 3 T_c^(5/2)/(4 k_p)``, and ``g = pi zeta/(3 T_c)``. `corrected` and
`printed`: ``h = f (1 + k)^(5/2)/(k_p k^(3/2))``, f = 5.3033 and 5.03, ``g = pi/3 (1 - k)/(1 + k)``;
without loss they give 2.15 times the E' that the motion has.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.checks import check_fields, check_not_negative, check_number, check_positive
from contact_sim_pkg.rigs.impact.theory.closed_form.force import lowest_force
from contact_sim_pkg.rigs.impact.theory.closed_form.scaled_motion import ScaledImpact, scaled_impact
from contact_sim_pkg.rigs.impact.theory.closed_form.severity import loss_tangent_of_severity, severity_of_restitution
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.geometry import SMALL_SHAPE_FACTOR, depth_note
from contact_sim_pkg.rigs.impact.theory.motion import SHAPE_RULES
from contact_sim_pkg.rigs.impact.theory.roots import bracketed_root

__all__ = ["FORMS", "HEAVIEST", "RestitutionReading", "group_factor", "material_of_impact", "reading"]

FORMS = ("exact", "corrected", "printed")
HEAVIEST = 0.5  # g tau/V0 up to which an impact under weight is inverted
FACTORS = {"corrected": 15.0 / 16.0 * 2.0**2.5, "printed": 5.03}


class RestitutionReading(NamedTuple):
    """Material constants that a restitution alone determines."""

    modulus_factor: float  # h k_p: E' = q (h k_p)/k_p
    loss_tangent: float  # g
    depth_factor: float  # x_m/(V0 tau), x_m without weight


def material_of_impact(
    sphere: Sphere,
    speed: float,
    duration: float,
    restitution: float,
    end: str = "force",
    form: str = "exact",
    shape: str = "small",
    gravity: float = 0.0,
) -> Material:
    """E' and tan(beta) of an impact of ``sphere`` at ``speed`` [m/s] that lasts ``duration`` [s]
    and rebounds with ``restitution``.

    ``end`` and ``shape`` as in `solve_impact`. ``gravity`` [m/s^2] along the blow during the
    contact: that of a drop tower, 0 of a pendulum; only the exact form knows it. Raises ImpactError
    for a restitution that the form does not reach, for x_m > R, and for a mass, radius, speed or
    duration that is not above 0.
    """
    group = group_factor(sphere, speed, duration)
    check_not_negative("gravity", gravity, "m/s^2")
    found = reading(restitution, end, form, gravity * duration / speed)
    # The depth of the impact decides the shape factor k_p.
    factor = shape_of_depth(found.depth_factor * speed * duration, sphere.radius, shape)
    return Material(group * found.modulus_factor / factor, found.loss_tangent)


def group_factor(sphere: Sphere, speed: float, duration: float) -> float:
    """``q = m/(sqrt(V0 R) tau^(5/2))`` in [Pa]; all above 0, else ImpactError."""
    check_fields("sphere", sphere, positive="mass radius")
    check_positive("impact speed", speed, "m/s")
    check_positive("duration", duration, "s")
    return float(sphere.mass / (math.sqrt(speed * sphere.radius) * duration**2.5))


def reading(restitution: float, end: str = "force", form: str = "exact", weight: float = 0.0) -> RestitutionReading:
    """h, g and the depth of a restitution k; ``weight`` is ``g tau/V0``.

    Raises ImpactError outside the range of the form, ValueError for another form.
    restitution and weight: [1].
    """
    if not 0.0 <= weight <= HEAVIEST:
        raise ImpactError(
            f"weight: g tau/V0 is {weight:.3g}; 0 to {HEAVIEST:g} is the range, above it the sphere is pressed rather than struck"
        )
    if form == "exact":
        severity, scaled = _severity_under_weight(restitution, end, weight)
        factor = 0.75 * scaled.duration**2.5
        free = scaled_impact(severity, end)  # whose depth gives k_p, as in `solve_impact`
        return RestitutionReading(float(factor), loss_tangent_of_severity(severity, end), free.depth / scaled.duration)
    if form not in FACTORS:
        raise ValueError(f"form '{form}': {', '.join(FORMS)} are the forms")
    lowest_force(end)
    k = check_number("restitution", restitution, above=0.0, most=1.0)
    factor = FACTORS[form] * (1.0 + k) ** 2.5 / k**1.5
    return RestitutionReading(float(factor), math.pi / 3.0 * (1.0 - k) / (1.0 + k), 0.5 * k / (1.0 + k))


def _severity_under_weight(restitution: float, end: str, weight: float) -> tuple[float, ScaledImpact]:
    """zeta, and the impact at it under the weight; the frequency in its viscous force stays that of
    the impact without weight.

    Weight lowers the restitution, so zeta lies below that of the same restitution without it.
    """
    severity = severity_of_restitution(restitution, end)
    if weight == 0.0 or severity == 0.0:
        return severity, _under_weight(severity, end, weight)

    def excess(zeta: float) -> float:
        try:
            return _under_weight(zeta, end, weight).restitution - restitution
        except ImpactError:  # the weight keeps the sphere on the sample
            return -restitution

    severity = bracketed_root(excess, 0.0, severity, 1.0e-14)
    found = _under_weight(severity, end, weight)
    if abs(found.restitution - restitution) > 1.0e-9:
        raise ImpactError(
            f"restitution {restitution:.6g} under g tau/V0 {weight:.3g}: so heavy a sphere would not rebound so"
        )
    return severity, found


def _under_weight(severity: float, end: str, weight: float) -> ScaledImpact:
    """The impact at ``severity`` with ``g tau/V0 = weight``; the weight in its own units is
    ``weight/T_c``, T_c its own.

    That is a root between 0 and the value at the T_c without weight, for the product of both grows
    with the weight. Raises ImpactError where the weight keeps the sphere on the sample.
    """
    free = scaled_impact(severity, end)
    if weight == 0.0:
        return free

    def excess(own: float) -> float:
        try:
            return own * scaled_impact(severity, end, own).duration / weight - 1.0
        except ImpactError:  # it does not leave: longer than any contact
            return math.inf

    low, high = 0.0, weight / free.duration
    at_high = excess(high)
    while at_high == math.inf:  # halve down to where it leaves
        middle = 0.5 * (low + high)
        if high - low <= 1.0e-12 * high:
            raise ImpactError(f"weight: g tau/V0 {weight:.3g} keeps the sphere on the sample")
        at_middle = excess(middle)
        if at_middle < 0.0:
            low = middle
        else:
            high, at_high = middle, at_middle
    return scaled_impact(severity, end, bracketed_root(excess, low, high, 1.0e-15))


def shape_of_depth(depth: float, radius: float, shape: str) -> float:
    """k_p by the rule ``shape``; raises ImpactError for a depth above the radius.

    depth, radius: [m]; the result: [1].
    """
    if shape not in SHAPE_RULES:
        raise ValueError(f"shape factor '{shape}': small or iterate is needed")
    depth_note(depth, radius)
    return SMALL_SHAPE_FACTOR if shape == "small" else math.sqrt(2.0 - depth / radius)
