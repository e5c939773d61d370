"""Hard cases of the general normal law: no indentation, first contact, both ends of contact, powers
of the rate below one.
"""

from __future__ import annotations

import math

import numpy

from contact_sim_lab.laws.one_mass.impact_works import ImpactWorks
from contact_sim_lab.laws.one_mass.runs import integrate
from contact_sim_lab.laws.work_precision_restitution import SPHERE, delivered
from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, close_to, exactly
from contact_sim_lab.twins import general_law, impact
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.laws.normal_force import normal_force
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.parameters import GeneralDissipative, NormalElastic
from contact_sim_pkg.laws.restitution_law import NEVER_PULLS, PULLS, severity_of_restitution

MODEL = "general law"
MASS, SPEED = 20.0, 0.5
SPRING = NormalElastic(1.0e5, 1.0)
POWERS = ((0.0, 1.0), (0.5, 1.0), (1.5, 1.0), (1.5, 2.0), (2.5, 0.5), (0.0, 0.0))


def _dissipative(coefficient: float, p: float, q: float, lowest: float = NEVER_PULLS) -> GeneralDissipative:
    return GeneralDissipative(coefficient, p, q, 1e-6 * SPEED if q < 1.0 else 0.0, lowest)


def without_indentation() -> Finding:
    """Largest force for x <= 0, whatever the powers, the rate and the end rule."""
    places, rates = (0.0, -0.0, -5e-324, -1.0, -math.inf), (-1e3, -1.0, 0.0, 1.0, 1e3)
    values = [
        normal_force(SPHERE, _dissipative(1e3, p, q, lowest), x, v, 1.0)
        for p, q in POWERS
        for lowest in (NEVER_PULLS, PULLS)
        for x in places
        for v in rates
    ]
    return exactly(float(numpy.max(numpy.abs(values))), 0.0, hard=max(places))


def never_pulls() -> Finding:
    """Smallest force with the end rule force, at depths down to 1e-300 m and parting speeds up to
    1e6 m/s.
    """
    forces = {
        lowest: [
            normal_force(SPHERE, _dissipative(1e5, p, q, lowest), x, -v, 1.0)
            for p, q in POWERS
            for x in (1e-300, 1e-100, 1e-12, 1e-3, 1.0)
            for v in (1e-300, 1e-9, 1.0, 1e6)
        ]
        for lowest in (NEVER_PULLS, PULLS)
    }
    return exactly(min(forces[NEVER_PULLS]), 0.0, hard=min(forces[PULLS]))


def _end_of(
    elastic: NormalElastic, dissipative: GeneralDissipative, gravity: float = 0.0, duration: float = 3.0
) -> Vector:
    depth = impact.elastic_impact(MASS, SPEED, elastic.coefficient, elastic.exponent)[1]
    rig = ImpactWorks(PointContact(MASS, gravity, 0.0, 0.0, elastic, dissipative))
    energy = 0.5 * MASS * SPEED**2
    scale = numpy.array([depth, SPEED, energy, energy]) * 1e-12
    course = integrate(rig, numpy.array([1e-3, -SPEED, 0.0, 0.0]), scale, numpy.array([0.0, duration]))
    return numpy.asarray(course.states[-1])


def _damper(ratio: float, lowest: float) -> GeneralDissipative:
    return _dissipative(2.0 * ratio * math.sqrt(SPRING.coefficient * MASS), 0.0, 1.0, lowest)


def _ratio(damper: GeneralDissipative) -> float:
    return damper.coefficient / (2.0 * math.sqrt(SPRING.coefficient * MASS))


def force_jump() -> Finding:
    """A damper's force jumps at first contact: e at damping ratio 0.7, which parts where F = 0."""
    damper = _damper(0.7, NEVER_PULLS)
    end = _end_of(SPRING, damper)
    jump = normal_force(SPRING, damper, 1e-300, SPEED, 1.0) / (SPEED * math.sqrt(SPRING.coefficient * MASS))
    return close_to(float(end[1] / SPEED), general_law.kelvin_voigt_at_force(0.7), 1e-10, hard=jump)


def tensile_end() -> Finding:
    """The same with a contact that pulls until x = 0."""
    damper = _damper(0.7, PULLS)
    end = _end_of(SPRING, damper)
    return close_to(
        float(end[1] / SPEED),
        general_law.kelvin_voigt_at_gap(0.7),
        1e-10,
        hard=normal_force(SPRING, damper, 1e-300, -float(end[1]), 1.0),
    )


def critical_damper() -> Finding:
    """Damping ratio 1, parting where F = 0: e = exp(-2)."""
    damper = _damper(1.0, NEVER_PULLS)
    return close_to(float(_end_of(SPRING, damper)[1] / SPEED), math.exp(-2.0), 1e-10, hard=_ratio(damper))


def overdamped_stays() -> Finding:
    """Damping ratio 3, pulling until x = 0: the mass never leaves; its approach is above 0 (and the
    tolerance) after 1.5 s.
    """
    damper = _damper(3.0, PULLS)
    end = _end_of(SPRING, damper, duration=1.5)
    return Finding(-float(end[0]), "> 0", 1.0 if end[0] < 0.0 else -math.inf, _ratio(damper))


def below_linear() -> Finding:
    """q = 0.5: e with the slope smoothed over 1e-6 v0, against the unsmoothed law."""
    severity = 0.5
    length = (MASS * SPEED**2 / SPHERE.coefficient) ** 0.4
    dissipative = _dissipative(severity * SPHERE.coefficient * length / SPEED**0.5, 0.5, 0.5)
    at_rest, slow, fast = (normal_force(SPHERE, dissipative, length, v, 1.0) for v in (0.0, 1e-9 * SPEED, SPEED))
    slope = (slow - at_rest) / (fast - at_rest) / 1e-9
    found = delivered(SPHERE, dissipative, MASS, SPEED)
    return close_to(found, general_law.restitution(severity, 1.5, 0.5, 0.5, "force"), 1e-6, hard=slope)


def requested_of_every_law() -> Finding:
    """Largest error of the delivered restitution over 0.05 to 0.98, nine pairs of powers and both
    ends.
    """
    worst, severities = 0.0, []
    pairs = ((0.0, 1.0), (0.5, 1.0), (1.5, 1.0), (2.5, 1.0), (1.5, 2.0), (0.5, 2.0), (0.7, 1.3), (1.0, 1.0), (3.0, 3.0))
    for p, q in pairs:
        for lowest in (NEVER_PULLS, PULLS):
            for requested in (0.05, 0.3, 0.7, 0.98):
                severity = severity_of_restitution(requested, 1.5, p, q, lowest)
                severities.append(severity)
                length = (MASS * SPEED**2 / SPHERE.coefficient) ** 0.4
                coefficient = severity * SPHERE.coefficient * length ** (1.5 - p) / SPEED**q
                worst = max(worst, abs(delivered(SPHERE, _dissipative(coefficient, p, q, lowest)) - requested))
    return at_most(worst, 1e-9, hard=max(severities) / min(severities))


def works_and_speeds() -> Finding:
    """Energetic and kinematic restitution of free impacts: largest difference."""
    worst, lost = 0.0, 0.0
    for p, q, coefficient in ((0.0, 1.0, 400.0), (0.5, 1.0, 3000.0), (1.5, 2.0, 2e5), (0.5, 0.5, 300.0)):
        end = _end_of(SPHERE, _dissipative(coefficient, p, q))
        lost = max(lost, 1.0 - float(end[1] / SPEED) ** 2)
        worst = max(worst, abs(math.sqrt(end[3] / -end[2]) - end[1] / SPEED))
    return at_most(worst, 1e-9, hard=lost)


def works_under_weight() -> Finding:
    """A heavy slow impact: the works' sum against kinetic and potential energy, relative to the
    impact's energy.
    """
    end = _end_of(SPHERE, _dissipative(3000.0, 0.5, 1.0), gravity=9.81, duration=0.4)
    resting = (MASS * 9.81 / SPHERE.coefficient) ** (1.0 / SPHERE.exponent)
    depth = impact.elastic_impact(MASS, SPEED, SPHERE.coefficient, SPHERE.exponent)[1]
    energy = 0.5 * MASS * SPEED**2
    change = 0.5 * MASS * (end[1] ** 2 - SPEED**2) + MASS * 9.81 * (end[0] - 1e-3)
    return at_most(abs(float(end[2] + end[3] - change)) / energy, 1e-9, hard=resting / depth)


CASES = (
    HardCase(MODEL, "x ≤ 0: largest force over powers, rates, ends", without_indentation,
        guard.at_most("largest indentation [m]", 0.0)),
    HardCase(MODEL, "end rule force never pulls: smallest force", never_pulls,
        guard.below("least force without the end rule [N]", 0.0)),
    HardCase(MODEL, "damper, ζ = 0.7, force jump at touch, F = 0: e", force_jump,
        guard.at_least("force at touch over the largest elastic one", 1.0)),
    HardCase(MODEL, "damper, ζ = 0.7, tensile end at x = 0: e", tensile_end,
        guard.below("force where it parts [N]", 0.0)),
    HardCase(MODEL, "damper, ζ = 1: e = exp(-2)", critical_damper, guard.at_least("damping ratio", 1.0)),
    HardCase(MODEL, "damper, ζ = 3, tensile: approach after 1.5 s [m]", overdamped_stays,
        guard.above("damping ratio", 1.0)),
    HardCase(MODEL, "q = 0.5, infinite slope smoothed: e", below_linear,
        guard.scales("slope of the force at no rate over its mean", 100.0)),
    HardCase(MODEL, "requested e 0.05 to 0.98, 9 powers, 2 ends: largest error", requested_of_every_law,
        guard.scales("severities, mild and strong", 100.0)),
    HardCase(MODEL, "e from works and from speeds: largest difference", works_and_speeds,
        guard.at_least("largest share of the energy that is lost", 0.5)),
    HardCase(MODEL, "under weight: works against energies", works_under_weight,
        guard.at_least("approach at rest over that of the impact", 0.5)),
)  # fmt: skip
