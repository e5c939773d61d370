"""Hard cases of the general normal law: no indentation, first contact, both ends of contact, powers
of the rate below one.
"""

from __future__ import annotations

import math

import numpy

from contact_sim_lab.laws.work_precision_restitution import SPHERE, delivered
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, close_to, exactly
from contact_sim_lab.twins import general_law, impact
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.laws.normal_force import normal_force
from contact_sim_pkg.laws.one_mass.parameters import ImpactWorks, PointContact
from contact_sim_pkg.laws.one_mass.runs import integrate
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
    return exactly(float(numpy.max(numpy.abs(values))), 0.0)


def never_pulls() -> Finding:
    """Smallest force with the end rule force, at depths down to 1e-300 m and parting speeds up to
    1e6 m/s.
    """
    values = [
        normal_force(SPHERE, _dissipative(1e5, p, q), x, -v, 1.0)
        for p, q in POWERS
        for x in (1e-300, 1e-100, 1e-12, 1e-3, 1.0)
        for v in (1e-300, 1e-9, 1.0, 1e6)
    ]
    return exactly(min(values), 0.0)


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


def force_jump() -> Finding:
    """A damper's force jumps at first contact: e at damping ratio 0.7, which parts where F = 0."""
    end = _end_of(SPRING, _damper(0.7, NEVER_PULLS))
    return close_to(float(end[1] / SPEED), general_law.kelvin_voigt_at_force(0.7), 1e-10)


def tensile_end() -> Finding:
    """The same with a contact that pulls until x = 0."""
    end = _end_of(SPRING, _damper(0.7, PULLS))
    return close_to(float(end[1] / SPEED), general_law.kelvin_voigt_at_gap(0.7), 1e-10)


def critical_damper() -> Finding:
    """Damping ratio 1, parting where F = 0: e = exp(-2)."""
    return close_to(float(_end_of(SPRING, _damper(1.0, NEVER_PULLS))[1] / SPEED), math.exp(-2.0), 1e-10)


def overdamped_stays() -> Finding:
    """Damping ratio 3, pulling until x = 0: the mass never leaves; its approach is above 0 (and the
    tolerance) after 1.5 s.
    """
    end = _end_of(SPRING, _damper(3.0, PULLS), duration=1.5)
    return Finding(-float(end[0]), "> 0", 1.0 if end[0] < 0.0 else -math.inf)


def below_linear() -> Finding:
    """q = 0.5: e with the slope smoothed over 1e-6 v0, against the unsmoothed law."""
    severity = 0.5
    length = (MASS * SPEED**2 / SPHERE.coefficient) ** 0.4
    dissipative = _dissipative(severity * SPHERE.coefficient * length / SPEED**0.5, 0.5, 0.5)
    found = delivered(SPHERE, dissipative, MASS, SPEED)
    return close_to(found, general_law.restitution(severity, 1.5, 0.5, 0.5, "force"), 1e-6)


def requested_of_every_law() -> Finding:
    """Largest error of the delivered restitution over 0.05 to 0.98, nine pairs of powers and both
    ends.
    """
    worst = 0.0
    pairs = ((0.0, 1.0), (0.5, 1.0), (1.5, 1.0), (2.5, 1.0), (1.5, 2.0), (0.5, 2.0), (0.7, 1.3), (1.0, 1.0), (3.0, 3.0))
    for p, q in pairs:
        for lowest in (NEVER_PULLS, PULLS):
            for requested in (0.05, 0.3, 0.7, 0.98):
                severity = severity_of_restitution(requested, 1.5, p, q, lowest)
                length = (MASS * SPEED**2 / SPHERE.coefficient) ** 0.4
                coefficient = severity * SPHERE.coefficient * length ** (1.5 - p) / SPEED**q
                worst = max(worst, abs(delivered(SPHERE, _dissipative(coefficient, p, q, lowest)) - requested))
    return at_most(worst, 1e-9)


def works_and_speeds() -> Finding:
    """Energetic and kinematic restitution of free impacts: largest difference."""
    worst = 0.0
    for p, q, coefficient in ((0.0, 1.0, 400.0), (0.5, 1.0, 3000.0), (1.5, 2.0, 2e5), (0.5, 0.5, 300.0)):
        end = _end_of(SPHERE, _dissipative(coefficient, p, q))
        worst = max(worst, abs(math.sqrt(end[3] / -end[2]) - end[1] / SPEED))
    return at_most(worst, 1e-9)


def works_under_weight() -> Finding:
    """A heavy slow impact: the works' sum against kinetic and potential energy, relative to the
    impact's energy.
    """
    end = _end_of(SPHERE, _dissipative(3000.0, 0.5, 1.0), gravity=9.81, duration=0.4)
    energy = 0.5 * MASS * SPEED**2
    change = 0.5 * MASS * (end[1] ** 2 - SPEED**2) + MASS * 9.81 * (end[0] - 1e-3)
    return at_most(abs(float(end[2] + end[3] - change)) / energy, 1e-9)


CASES = (
    HardCase(MODEL, "x ≤ 0: largest force over powers, rates, ends", without_indentation),
    HardCase(MODEL, "end rule force never pulls: smallest force", never_pulls),
    HardCase(MODEL, "damper, ζ = 0.7, force jump at touch, F = 0: e", force_jump),
    HardCase(MODEL, "damper, ζ = 0.7, tensile end at x = 0: e", tensile_end),
    HardCase(MODEL, "damper, ζ = 1: e = exp(-2)", critical_damper),
    HardCase(MODEL, "damper, ζ = 3, tensile: approach after 1.5 s [m]", overdamped_stays),
    HardCase(MODEL, "q = 0.5, infinite slope smoothed: e", below_linear),
    HardCase(MODEL, "requested e 0.05 to 0.98, 9 powers, 2 ends: largest error", requested_of_every_law),
    HardCase(MODEL, "e from works and from speeds: largest difference", works_and_speeds),
    HardCase(MODEL, "under weight: works against energies", works_under_weight),
)
