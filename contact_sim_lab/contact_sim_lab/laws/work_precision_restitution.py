"""Work-precision study of the restitution: what a free impact gives back when the dissipation is
set by each formula for a requested restitution.

Hunt-Crossley by five published formulas and by the exact relation; a linear spring and damper by
the formula that lets the contact pull and by the one that does not; the viscoelastic sphere
(Kuwabara and Kono) by Hunt-Crossley's dissipation at the depth of the elastic impact, and by the
root of e(Z). Every value is a free impact integrated by the bench's own kernels.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy

from contact_sim_lab.laws.one_mass.runs import integrate
from contact_sim_lab.laws.restitution_formulas import FORMULAS
from contact_sim_lab.records.work_precision import FidelityLevel, Row, WorkPrecision, milliseconds, relative, row
from contact_sim_lab.twins import impact
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.parameters import GeneralDissipative, NormalDissipation, NormalElastic
from contact_sim_pkg.laws.restitution import damping_of_restitution
from contact_sim_pkg.laws.restitution_law import NEVER_PULLS, PULLS, kelvin_voigt_ratio, severity_of_restitution

__all__ = ["PART", "REQUESTED", "WORK_PRECISION", "delivered", "rows"]

PART = "restitution from B"
REQUESTED = (0.05, 0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.98)
QUANTITY = "restitution"
REFERENCE = "the restitution that was requested; free impact integrated to 1e-12"
MASS, SPEED = 20.0, 0.5  # [kg], [m/s]
SPHERE, SPRING = NormalElastic(1.0e5, 1.5), NormalElastic(1.0e5, 1.0)
TOLERANCE = 1.0e-12

Ways = dict[str, Callable[[float], GeneralDissipative]]


def rows() -> list[Row]:
    """Each law, each requested restitution, each way to its dissipation."""
    found = []
    for law, elastic, ways in (
        ("Hunt-Crossley", SPHERE, _hunt_crossley()),
        ("spring and damper, no tension", SPRING, _spring_and_damper()),
        ("viscoelastic sphere", SPHERE, _sphere()),
    ):
        for requested in REQUESTED:
            for name, law_of in ways.items():
                level = FidelityLevel(name, milliseconds(lambda law_of=law_of, requested=requested: law_of(requested)))  # type: ignore[misc]
                value = delivered(elastic, law_of(requested))
                error = relative(value, requested)
                found.append(
                    row(
                        PART,
                        f"{law}, e = {requested:g}",
                        QUANTITY,
                        level,
                        REFERENCE,
                        error,
                        value=value,
                        expected=requested,
                    )
                )
    return found


def delivered(
    elastic: NormalElastic, dissipative: NormalDissipation | None, mass: float = MASS, speed: float = SPEED
) -> float:
    """Ratio [1] of the speeds after and before a free impact, integrated to 1e-12 of depth and
    speed; mass: [kg], speed: [m/s]."""
    depth = impact.elastic_impact(mass, speed, elastic.coefficient, elastic.exponent)[1]
    rig = PointContact(mass, 0.0, 0.0, 0.0, elastic, dissipative)
    scale = numpy.array([depth, speed]) * TOLERANCE
    end = integrate(rig, numpy.array([0.0, -speed]), scale, numpy.array([0.0, 2000.0 * depth / speed])).states[-1]
    return float(end[1] / speed)


def _hunt_crossley() -> Ways:
    def dissipative(d: float) -> GeneralDissipative:
        return GeneralDissipative(SPHERE.coefficient * d / SPEED, SPHERE.exponent, 1.0, 0.0, NEVER_PULLS)

    ways: Ways = {name: lambda e, of=of: dissipative(of(e)) for name, of in FORMULAS.items()}  # type: ignore[misc]
    ways["exact relation"] = lambda e: dissipative(damping_of_restitution(e, 1.0))
    return ways


def _spring_and_damper() -> Ways:
    def dissipative(ratio: float) -> GeneralDissipative:
        damper = 2.0 * ratio * math.sqrt(SPRING.coefficient * MASS)
        return GeneralDissipative(damper, 0.0, 1.0, 0.0, NEVER_PULLS)

    return {
        "half a period, exp(-πζ/√(1-ζ²))": lambda e: dissipative(kelvin_voigt_ratio(e, PULLS)),
        "closed form at F = 0": lambda e: dissipative(kelvin_voigt_ratio(e, NEVER_PULLS)),
    }


def _sphere() -> Ways:
    """B of the sphere from Hunt-Crossley's: the same force at the depth of the elastic impact; or
    exactly.
    """
    length = (MASS * SPEED**2 / SPHERE.coefficient) ** (1.0 / (SPHERE.exponent + 1.0))
    depth = impact.elastic_impact(MASS, SPEED, SPHERE.coefficient, SPHERE.exponent)[1]

    def dissipative(coefficient: float) -> GeneralDissipative:
        return GeneralDissipative(coefficient, 0.5, 1.0, 0.0, NEVER_PULLS)

    def exact(e: float) -> GeneralDissipative:
        severity_of_restitution.cache_clear()  # the time of a search, not of a look-up
        severity = severity_of_restitution(e, SPHERE.exponent, 0.5, 1.0, NEVER_PULLS)
        return dissipative(severity * SPHERE.coefficient * length / SPEED)

    return {
        "Hunt-Crossley's dissipation at the elastic depth": lambda e: dissipative(
            SPHERE.coefficient * damping_of_restitution(e, SPEED) * depth
        ),
        "root search of e(Z)": exact,
    }


WORK_PRECISION = (WorkPrecision(PART, rows),)
