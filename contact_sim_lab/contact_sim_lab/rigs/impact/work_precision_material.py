"""Work-precision studies of what is read from an impact: the material from contact time and
restitution, and the end of the supersonic front.
"""

from __future__ import annotations

import functools

from contact_sim_lab.records.work_precision import FidelityLevel, Row, WorkPrecision, milliseconds, relative, row
from contact_sim_lab.rigs.impact.twins import goloshchapov
from contact_sim_lab.rigs.impact.work_precision import MODULUS, SPEED, SPHERE, reference
from contact_sim_pkg.rigs.impact.theory import micro_front
from contact_sim_pkg.rigs.impact.theory.bodies import Material
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.inverse import FORMS, material_of_impact
from contact_sim_pkg.rigs.impact.theory.motion import FreeImpact, solve_impact

__all__ = ["FRONT_PART", "PART", "WORK_PRECISION", "front_rows", "rows"]

PART = "material from an impact"
REFERENCE = "the material of the impact, which scipy's DOP853 integrated"
LOSS_TANGENTS = (0.01, 0.05, 0.1, 0.2, 0.4, 1.0)
FRONT_PART = "end of the supersonic front"
FRONT_REFERENCE = "event of scipy's DOP853 on the motion"
SPEEDS = (0.01, 0.1, 1.0, 3.0)
SHEAR_SPEED = 49.2  # [m/s]: G' = E'/3, 1100 kg/m^3
FRONT_TANGENT = 0.2


def rows() -> list[Row]:
    """Each loss tangent, each form: E' and tan(beta)."""
    found = []
    for loss_tangent in LOSS_TANGENTS:
        restitution, duration, _depth, _force = reference(loss_tangent, "force")
        for form in FORMS:
            read = functools.partial(material_of_impact, SPHERE, SPEED, duration, restitution, "force", form)
            fidelity, material = FidelityLevel(form, milliseconds(read)), read()
            for name, value, true in (
                ("E'", material.storage_modulus, MODULUS),
                ("tan β", material.loss_tangent, loss_tangent),
            ):
                error = relative(value, true)
                found.append(
                    row(PART, f"tan β = {loss_tangent:g}", name, fidelity, REFERENCE, error, value=value, expected=true)
                )
    return found


def front_rows() -> list[Row]:
    """Each impact speed: t_s by the formula for small times, by the damped sine, on the integrated
    motion.
    """
    found = []
    for speed in SPEEDS:
        impact = solve_impact(SPHERE, Material(MODULUS, FRONT_TANGENT), speed)
        expected = goloshchapov.front_time(
            SPHERE.mass, SPHERE.radius, impact.elastic, impact.viscous, speed, impact.shape, SHEAR_SPEED
        )
        for name, way in (("small times", _small), ("damped sine (eq 80)", _sine), ("integrated", _integrated)):
            # The formulas have limits; a way that does not reach this speed has no row.
            try:
                value = way(impact)
            except (ImpactError, ArithmeticError):
                continue
            fidelity = FidelityLevel(name, milliseconds(functools.partial(way, impact)))
            error = relative(value, expected)
            found.append(
                row(
                    FRONT_PART,
                    f"V0 = {speed:g} m/s",
                    "t_s",
                    fidelity,
                    FRONT_REFERENCE,
                    error,
                    value=value,
                    expected=expected,
                )
            )
    return found


def _small(impact: FreeImpact) -> float:
    return micro_front.front_of_small_times(impact, SHEAR_SPEED).time


def _sine(impact: FreeImpact) -> float:
    return micro_front.front_of_damped_sine(impact, SHEAR_SPEED)


def _integrated(impact: FreeImpact) -> float:
    return micro_front.front_time(impact, SHEAR_SPEED).time


WORK_PRECISION = (
    WorkPrecision(PART, rows),
    WorkPrecision(FRONT_PART, front_rows),
)
