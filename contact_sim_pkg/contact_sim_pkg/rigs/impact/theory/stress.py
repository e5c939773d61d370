"""Stress over the contact area: shape, centre values of the elastic and the viscous part
(Goloshchapov eqs 41, 42, 81-89).

Pressure positive. ``sigma(r_i) = sigma_c f(rho)``, ``rho = r_i/r``, ``sigma_c = s F/(pi r^2)``;
shapes that carry the whole force: `parabola` ``1 - rho^2`` with s = 2 (default) and `hertz`
``sqrt(1 - rho^2)`` with s = 3/2. `printed` is the parabola with s = 3/2 (eq 84, a mean over a line
instead of an area): it carries 3/4 of the force.

The viscous stress ``F_b/(pi r^2) ~ x'/sqrt(x)`` grows without bound towards first touch, while its
force goes to 0. It is evaluated at a depth not below x_s, where the wave front has come down to the
shear wave speed (`rigs/impact/theory/micro_front.py`), and flagged above that.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigs.impact.theory.checks import check_number, check_positive, check_values
from contact_sim_pkg.rigs.impact.theory.closed_form.force import elastic_force, viscous_force
from contact_sim_pkg.rigs.impact.theory.motion import FreeImpact

__all__ = [
    "SHAPES",
    "CentreStress",
    "centre_stress",
    "distribution",
    "normal_velocity",
    "radial_velocity",
    "retarded_motion",
    "retarded_viscous_stress",
]

SHAPES = {"parabola": 2.0, "hertz": 1.5, "printed": 1.5}
"""Shape -> s, centre over mean stress."""


class CentreStress(NamedTuple):
    """Stress in the centre of the contact in [Pa], compression positive."""

    elastic: float
    viscous: float
    # The viscous part is that of the limiting depth: the true one has no bound towards first touch
    limited: bool

    @property
    def total(self) -> float:
        """Instantaneous sum [Pa], as the forces add up in eq 54."""
        return self.elastic + self.viscous

    @property
    def amplitude(self) -> float:
        """``sqrt(elastic^2 + viscous^2)`` (eq 103): the amplitude of steady harmonic motion, not a
        stress at an instant.

        In [Pa].
        """
        return math.hypot(self.elastic, self.viscous)


def centre_stress(
    impact: FreeImpact, depth: float, speed: float, limiting_depth: float, shape: str = "parabola"
) -> CentreStress:
    """Stress in the centre at ``depth`` x [m] and ``speed`` x' [m/s]; both parts 0 without contact.

    ``limiting_depth`` x_s > 0 [m]: the viscous part is not evaluated below it, and flagged. See
    `micro_front.front_time`. Raises ImpactError for values that are not finite and a limiting depth
    not above 0, ValueError for another shape.
    """
    factor = _factor(shape)
    check_number("depth", depth, "m")
    check_number("speed", speed, "m/s")
    check_positive("limiting depth", limiting_depth, "m")
    if depth <= 0.0:
        return CentreStress(0.0, 0.0, speed != 0.0)
    # Contact area over depth; the viscous part is not evaluated below the limiting depth.
    area = math.pi * impact.shape**2 * impact.sphere.radius
    evaluated = max(depth, limiting_depth)
    viscous = viscous_force(impact.viscous, evaluated, speed) / (area * evaluated)
    return CentreStress(
        factor * elastic_force(impact.elastic, depth) / (area * depth), factor * viscous, depth < limiting_depth
    )


def distribution(centre: float, places: Vector, shape: str = "parabola") -> Vector:
    """Stress [places] [Pa] at ``places`` r_i/r from ``centre`` [Pa] outwards; 0 outside the
    contact.

    Raises ImpactError for values that are not finite, ValueError for another shape.
    """
    _factor(shape)
    check_number("stress of the centre", centre, "Pa")
    inside = numpy.clip(1.0 - check_values("places", places) ** 2, 0.0, None)
    return centre * (numpy.sqrt(inside) if shape == "hertz" else inside)


def normal_velocity(speed: float, places: Vector) -> Vector:
    """Velocity [places] [m/s] of the surface along the normal, ``x'(1 - r_i^2/r^2)`` (eq 41).

    places: r_i/r, 0..1; 0 from the border on. Raises ImpactError for values that are not finite.
    """
    return check_number("speed", speed, "m/s") * numpy.clip(1.0 - check_values("places", places) ** 2, 0.0, None)


def radial_velocity(border_speed: float, places: Vector) -> Vector:
    """Velocity [places] [m/s] of the surface along its radius, ``r' r_i^2/r^2`` (eq 42).

    places: r_i/r, 0..1; 0 in the centre and outside the contact. Raises ImpactError for places
    below 0 and values that are not finite.
    """
    check_number("speed of the border", border_speed, "m/s")
    places = check_values("places", places, least=0.0)
    return numpy.where(places <= 1.0, border_speed * places**2, 0.0)


def retarded_motion(impact: FreeImpact, time: float, form: str = "corrected") -> tuple[float, float, bool]:
    """``x_s = V0/w e^(-delta t) sin(w t (1 - tau_KE/tau))`` (eq 88a), its derivative, and whether
    both are defined.

    tau_KE = tan(beta)/w. (0, 0, False) outside 0 < t <= tau and where the sine is not positive.
    ``printed`` leaves the factor 1 - tau_KE/tau out of the derivative (eq 88b). Raises ImpactError
    for a time that is not finite.
    time: [s]; the results: [m], [m/s].
    """
    check_number("time", time, "s")
    if form not in ("corrected", "printed"):
        raise ValueError(f"form '{form}': corrected or printed is needed")
    slower = 1.0 - impact.material.loss_tangent / math.pi
    if not 0.0 < time <= impact.duration or slower <= 0.0:
        return 0.0, 0.0, False
    # A damped sine, slower by tau_KE.
    frequency, damping = impact.frequency, impact.damping
    angle = frequency * time * slower
    envelope = impact.speed / frequency * math.exp(-damping * time)
    if math.sin(angle) <= 0.0:
        return 0.0, 0.0, False
    cosine = (slower if form == "corrected" else 1.0) * frequency * math.cos(angle)
    return envelope * math.sin(angle), envelope * (cosine - damping * math.sin(angle)), True


def retarded_viscous_stress(
    impact: FreeImpact, time: float, limiting_depth: float, shape: str = "parabola", form: str = "corrected"
) -> tuple[float, bool]:
    """Viscous stress in the centre from the retarded motion (eq 89) in [Pa], and whether it is
    defined and not limited.

    ``s 4 E'' x_s'/(pi w k_p sqrt(R) sqrt(x_s))``; 0 where the motion is undefined; below
    ``limiting_depth`` that depth's. Errors as `centre_stress` and `retarded_motion`.
    """
    _factor(shape)
    check_positive("limiting depth", limiting_depth, "m")
    depth, speed, defined = retarded_motion(impact, time, form)
    if not defined:
        return 0.0, False
    found = centre_stress(impact, depth, speed, limiting_depth, shape)
    return found.viscous, not found.limited


def _factor(shape: str) -> float:
    if shape not in SHAPES:
        raise ValueError(f"shape '{shape}': {', '.join(SHAPES)} are the shapes of the stress")
    return SHAPES[shape]
