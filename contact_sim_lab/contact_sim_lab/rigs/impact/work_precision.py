"""Work-precision study of the sphere's impact: restitution, duration, depth and peak force from the
loss tangent, by inexpensive and expensive methods.

Closed forms (Goloshchapov eqs 66, 68, 71), equivalent constant parameters (eqs 56-60), a table, and
the integrated motion with its own frequency, all against a slow integration in time by scipy. Both
end rules of contact; a form that has no answer at a loss tangent has no row there.
"""

from __future__ import annotations

import functools
from collections.abc import Callable

from contact_sim_lab.records.work_precision import FidelityLevel, Row, WorkPrecision, milliseconds, relative, row
from contact_sim_lab.rigs.impact.twins import goloshchapov
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.closed_form.force import elastic_coefficient, elastic_force
from contact_sim_pkg.rigs.impact.theory.closed_form.scalings import (
    closed_duration,
    closed_restitution,
    damped_sine,
    depth_of_restitution,
)
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.geometry import SMALL_SHAPE_FACTOR
from contact_sim_pkg.rigs.impact.theory.motion import solve_impact
from contact_sim_pkg.rigs.impact.theory.table import look_up

__all__ = ["LOSS_TANGENTS", "PART", "QUANTITIES", "WORK_PRECISION", "reference", "rows"]

PART = "impact of a sphere"
REFERENCE = "the equation of motion with its own frequency, by scipy's DOP853 at 1e-13"
QUANTITIES = ("restitution", "duration", "depth", "peak force")
LOSS_TANGENTS = {
    "force": (0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0),
    "gap": (0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4),
}
SPHERE, MODULUS, SPEED = Sphere(0.02, 0.01), 8.0e6, 1.0
COEFFICIENT = elastic_coefficient(MODULUS, SPHERE.radius, SMALL_SHAPE_FACTOR)
LENGTH = (SPHERE.mass * SPEED**2 / COEFFICIENT) ** 0.4

Answer = tuple[float, float, float, float]


def rows() -> list[Row]:
    """Each end rule, each loss tangent, each way, each quantity."""
    found = []
    for end, loss_tangents in LOSS_TANGENTS.items():
        for loss_tangent in loss_tangents:
            expected = reference(loss_tangent, end)
            for name, way in _ways(end).items():
                try:
                    answer = way(loss_tangent)
                except ImpactError:
                    continue
                fidelity = FidelityLevel(name, milliseconds(functools.partial(way, loss_tangent)))
                found += [
                    row(PART, f"tan β = {loss_tangent:g}, end {end}", quantity, fidelity, REFERENCE, relative(value, true),
                        value=value, expected=true)
                    for quantity, value, true in zip(QUANTITIES, answer, expected, strict=True)
                ]  # fmt: skip
    return found


@functools.lru_cache(maxsize=32)
def reference(loss_tangent: float, end: str) -> Answer:
    """Restitution, duration [s], depth [m], peak force [N]."""
    scaled = goloshchapov.impact(goloshchapov.severity(loss_tangent, end), end)
    force = SPHERE.mass * SPEED**2 / LENGTH
    return scaled.restitution, scaled.duration * LENGTH / SPEED, scaled.depth * LENGTH, scaled.peak_force * force


def _ways(end: str) -> dict[str, Callable[[float], Answer]]:
    return {
        "closed forms, printed": lambda t: _closed(t, "printed"),
        "closed forms, corrected": lambda t: _closed(t, "corrected"),
        "equivalent constants, printed": lambda t: _constants(t, "printed"),
        "equivalent constants, corrected": lambda t: _constants(t, "corrected"),
        "table": lambda t: _table(t, end),
        "integrated": lambda t: _integrated(t, end),
    }


def _closed(loss_tangent: float, form: str) -> Answer:
    """Eqs 66, 68, 71; the peak force is the elastic one at the depth."""
    k = closed_restitution(loss_tangent)
    depth = depth_of_restitution(SPHERE, MODULUS, SPEED, k)
    return k, closed_duration(SPHERE, MODULUS, SPEED, k, form), depth, elastic_force(COEFFICIENT, depth)


def _constants(loss_tangent: float, form: str) -> Answer:
    found = damped_sine(SPHERE, Material(MODULUS, loss_tangent), SPEED, form)
    return found.restitution, found.duration, found.depth, found.peak_force


def _table(loss_tangent: float, end: str) -> Answer:
    found = look_up(loss_tangent, end)
    force = SPHERE.mass * SPEED**2 / LENGTH
    return found.restitution, found.duration * LENGTH / SPEED, found.depth * LENGTH, found.peak_force * force


def _integrated(loss_tangent: float, end: str) -> Answer:
    found = solve_impact(SPHERE, Material(MODULUS, loss_tangent), SPEED, end)
    return found.restitution, found.duration, found.depth, found.peak_force


WORK_PRECISION = (WorkPrecision(PART, rows),)
