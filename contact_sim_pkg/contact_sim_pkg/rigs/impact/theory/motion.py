"""A free impact of a sphere, solved: contact time, restitution, depth, forces, and its course in
time.

The equation of motion (Goloshchapov eq 54) is integrated with the frequency that it results in
(`rigs/impact/theory/closed_form/severity.py`, `rigs/impact/theory/closed_form/scaled_motion.py`),
then put into units: with ``c = 4/3 k_p E' sqrt(R)``, ``L = (m V0^2/c)^(2/5)``: ``tau = T_c L/V0``,
``x_m = X_m L``. So k does not depend on V0, ``x_m ~ V0^(4/5)``, ``tau ~ V0^(-1/5)``, and E' doubled
at the same loss tangent scales tau by ``2^(-2/5)``. No weight: m g is to be small against the
contact force (in a drop tower it is; else run the rig with the `normal_law`).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.laws.parameters import GeneralDissipative, NormalElastic
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.checks import check_fields, check_not_negative, check_positive, check_values
from contact_sim_pkg.rigs.impact.theory.closed_form.force import elastic_coefficient, normal_law, viscous_coefficient
from contact_sim_pkg.rigs.impact.theory.closed_form.scaled_motion import (
    LEEWAY,
    ScaledImpact,
    scaled_course,
    scaled_impact,
)
from contact_sim_pkg.rigs.impact.theory.closed_form.severity import severity_of_loss_tangent
from contact_sim_pkg.rigs.impact.theory.geometry import SMALL_SHAPE_FACTOR, depth_note, shape_factor

__all__ = ["SHAPE_RULES", "FreeImpact", "ImpactCourse", "course", "solve_impact"]

SHAPE_RULES = ("small", "iterate")
ROUNDS = 100


class FreeImpact(NamedTuple):
    """One free impact. SI units; times from first touch."""

    sphere: Sphere
    material: Material
    speed: float  # V0 [m/s]
    end: str  # end rule, "force" or "gap"
    shape: float  # k_p of this impact
    severity: float  # zeta
    length: float  # L [m]
    restitution: float  # k
    duration: float  # tau [s]
    compression_time: float  # tau_1 [s], to the turning point
    depth: float  # x_m [m]
    peak_force: float  # largest total force [N]
    peak_time: float  # [s]
    elastic: float  # A [N/m^1.5] of F_c = A x^1.5
    viscous: float  # B [N s/m^1.5] of F_b = B x^0.5 x'
    note: str | None  # what to mind, or None

    @property
    def frequency(self) -> float:
        """``w = pi/tau`` in [rad/s]."""
        return math.pi / self.duration

    @property
    def damping(self) -> float:
        """``delta = -ln k/tau`` in [1/s] (eq 69): the decay of the damped sine with this
        restitution and time.
        """
        return -math.log(self.restitution) / self.duration

    @property
    def normal_law(self) -> tuple[NormalElastic, GeneralDissipative]:
        """The same contact as parameters of the rig in `laws/one_mass`."""
        return normal_law(self.elastic, self.viscous, self.end)


class ImpactCourse(NamedTuple):
    """An impact at given times; arrays [times]."""

    time: Vector  # [s]
    depth: Vector  # x [m]
    speed: Vector  # x' [m/s], closing positive
    elastic_force: Vector  # F_c [N]
    viscous_force: Vector  # F_b [N]

    @property
    def force(self) -> Vector:
        """``F_c + F_b`` in [N]."""
        return self.elastic_force + self.viscous_force


def solve_impact(
    sphere: Sphere, material: Material, speed: float, end: str = "force", shape: str = "small"
) -> FreeImpact:
    """The free impact of ``sphere`` at ``speed`` V0 > 0 [m/s] on a half-space; ``material``: that
    of both bodies in series.

    ``end``: contact ends where the force is zero (`force`) or where the gap opens (`gap`).
    ``shape``: k_p = sqrt(2) (`small`) or ``sqrt(2 - x_m/R)`` (`iterate`), one constant an impact.
    Relative errors below 1e-13. Raises FoldError with `gap` above tan(beta) = 0.40373, ImpactError
    for x_m > R and for numbers outside their range.
    """
    _check(sphere, material, speed, shape)
    severity = severity_of_loss_tangent(material.loss_tangent, end)
    scaled = scaled_impact(severity, end)
    # The shape factor depends on the depth, the depth on the factor.
    factor = SMALL_SHAPE_FACTOR
    impact = _in_units(sphere, material, speed, end, factor, severity, scaled)
    for _ in range(ROUNDS if shape == "iterate" else 0):
        factor = shape_factor(impact.depth, sphere.radius)
        if abs(factor - impact.shape) <= 2.0e-16 * factor:
            break
        impact = _in_units(sphere, material, speed, end, factor, severity, scaled)
    return impact._replace(note=depth_note(impact.depth, sphere.radius))


def course(impact: FreeImpact, times: Vector) -> ImpactCourse:
    """Depth, speed and forces at rising ``times`` [s], 0 to ``impact.duration``, each [times].

    Raises ImpactError for other times.
    """
    most = impact.duration * (1.0 + LEEWAY)
    times = check_values("times", times, "s", shape=(None,), least=0.0, most=most, rising=True)
    time_unit = impact.length / impact.speed
    last = impact.duration / time_unit
    depth, speed = scaled_course(impact.severity, numpy.minimum(times / time_unit, last))
    x, v = depth * impact.length, speed * impact.speed
    root = numpy.sqrt(x)
    return ImpactCourse(times, x, v, impact.elastic * x * root, impact.viscous * root * v)


def _check(sphere: Sphere, material: Material, speed: float, shape: str) -> None:
    check_fields("sphere", sphere, positive="mass radius")
    check_positive("storage modulus", material.storage_modulus, "Pa")
    check_not_negative("loss tangent", material.loss_tangent)
    check_positive("impact speed", speed, "m/s")
    if shape not in SHAPE_RULES:
        raise ValueError(f"shape factor '{shape}': small or iterate is needed")


def _in_units(
    sphere: Sphere, material: Material, speed: float, end: str, factor: float, severity: float, scaled: ScaledImpact
) -> FreeImpact:
    coefficient = elastic_coefficient(material.storage_modulus, sphere.radius, factor)
    # Units of length, time and force.
    length = float((sphere.mass * speed**2 / coefficient) ** 0.4)
    time_unit, force_unit = length / speed, sphere.mass * speed**2 / length
    duration = scaled.duration * time_unit
    # Viscous coefficient at the frequency of this impact.
    viscous = viscous_coefficient(material.loss_modulus, sphere.radius, factor, math.pi / duration)
    return FreeImpact(
        sphere=sphere,
        material=material,
        speed=speed,
        end=end,
        shape=factor,
        severity=severity,
        length=length,
        restitution=scaled.restitution,
        duration=duration,
        compression_time=scaled.turning_time * time_unit,
        depth=scaled.depth * length,
        peak_force=scaled.peak_force * force_unit,
        peak_time=scaled.peak_time * time_unit,
        elastic=coefficient,
        viscous=viscous,
        note=None,
    )
