"""Hard cases of contact dynamics: impacts, approach phases, stiff and short contacts, slapping,
bouncing to rest.
"""

from __future__ import annotations

import math

import numpy

from contact_sim_lab.laws.one_mass.runs import OneMassCourse, free_impact, impact_speeds, integrate, seat_slap
from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, close_to, exactly
from contact_sim_lab.twins import impact
from contact_sim_lab.twins.point_contact import Slap, final_state
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.results import NOT_FINITE, TOO_MANY_EVENTS
from contact_sim_pkg.laws.normal_elastic import elastic_energy, elastic_force
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.parameters import NormalDissipative, NormalElastic

MASS, LAW = 20.0, NormalElastic(1.0e5, 1.5)
SPEED = 0.5
PHASES = 20
STEEL_RADIUS, STEEL_DENSITY = 0.01, 7800.0  # [m], [kg/m^3]


def restitution_found(damping: float, tolerance: float, gap: float, law: NormalElastic = LAW) -> float:
    """Ratio of the speeds after and before a free impact with `damping` d = damping times v0,
    started `gap` [m] above.
    """
    return float(_free(damping, tolerance, gap, law).states[-1, 1] / SPEED)


def _free(damping: float, tolerance: float, gap: float, law: NormalElastic = LAW) -> OneMassCourse:
    rig = free_impact(MASS, law, damping / SPEED)
    depth = impact.deepest_approach(MASS, SPEED, law.coefficient, law.exponent, damping / SPEED)
    lasts = impact.elastic_impact(MASS, SPEED, law.coefficient, law.exponent)[0]
    end = gap / SPEED + lasts * (3.0 + 3.0 * damping)
    return impact_speeds(rig, SPEED, depth, tolerance, gap, end)


def requested_restitution() -> Finding:
    """Largest error of the delivered restitution over the requested 0.05 to 0.98."""
    ratios = (0.05, 0.1, 0.3, 0.5, 0.8, 0.98)
    dampings = [impact.damping_of_restitution(e, SPEED) * SPEED for e in ratios]
    errors = [abs(restitution_found(d, 1e-11, 0.01) - e) for d, e in zip(dampings, ratios, strict=True)]
    return at_most(max(errors), 1e-9, hard=max(dampings) / min(dampings))


def approach_phases() -> Finding:
    """Largest error of e over 20 approach phases at tolerance 1e-6: no step goes blindly into the
    contact.
    """
    return at_most(max(phase_errors(0.5, 1e-6)), 3e-6, hard=sum(_free(0.5, 1e-6, gap).events for gap in _gaps()))


def phase_errors(damping: float, tolerance: float, law: NormalElastic = LAW) -> list[float]:
    """Errors [1] of the coefficient of restitution, one for each phase of the first contact within
    a step.

    damping: damping times impact speed [1]; tolerance: relative [1].
    """
    exact = impact.restitution(damping)
    return [abs(restitution_found(damping, tolerance, gap, law) - exact) for gap in _gaps()]


def _gaps() -> list[float]:
    return [0.003 * (i + 0.37) / PHASES for i in range(PHASES)]


def tolerance_is_met() -> Finding:
    """Largest error over requested tolerance, 1e-3 to 1e-11, worst of five phases: at most 5."""
    exact = impact.restitution(0.5)
    worst = 0.0
    for power in range(3, 12):
        tolerance = 10.0**-power
        for phase in range(5):
            found = restitution_found(0.5, tolerance, 0.002 * (phase + 0.21))
            worst = max(worst, abs(found - exact) / tolerance)
    return at_most(worst, 5.0, hard=1e-3 / tolerance)


def order_of_error() -> Finding:
    """Slope of log error over log tolerance, 1e-3 to 1e-10, from the worst of eight approach
    phases; at least 0.8.
    """
    exact = impact.restitution(0.5)
    powers = range(3, 11)
    errors = [max(abs(restitution_found(0.5, 10.0**-p, 0.002 * (i + 0.21)) - exact) for i in range(8)) for p in powers]
    slope = -float(numpy.polyfit(list(powers), numpy.log10(errors), 1)[0])
    return Finding(slope, "≥ 0.8", slope - 0.8, 10.0 ** (max(powers) - min(powers)))


def no_energy_without_source() -> Finding:
    """Largest restitution of an elastic impact over 20 approach phases at the loosest tolerance,
    above 1.
    """
    found = [restitution_found(1e-12, 1e-3, gap) for gap in _gaps()]
    return at_most(max(0.0, max(found) - 1.0), 1e-2, hard=1.0 - impact.restitution(1e-12))


def very_stiff() -> Finding:
    """Restitution of an elastic contact with omega dt = 1e4 for the outer tick of 1 ms."""
    law = NormalElastic(1.0e19, 1.5)
    lasts = impact.elastic_impact(MASS, SPEED, law.coefficient, law.exponent)[0]
    return close_to(restitution_found(1e-12, 1e-11, 0.0123, law), 1.0, 1e-9, hard=math.pi / lasts * 1e-3)


def steel_ball() -> tuple[PointContact, tuple[float, float, float]]:
    """Steel ball on a steel flat at 1 m/s: the rig, and duration [s], depth [m] and force [N] in
    closed form.
    """
    mass = STEEL_DENSITY * 4.0 / 3.0 * math.pi * STEEL_RADIUS**3
    law = NormalElastic(impact.sphere_coefficient(STEEL_RADIUS, 210e9, 0.3), 1.5)
    return free_impact(mass, law, None), impact.elastic_impact(mass, 1.0, law.coefficient, law.exponent)


def steel_impact(tolerance: float, gap: float = 3.3e-4) -> tuple[float, float, float, int]:
    """Relative errors [1] of duration, depth and peak force with output every 1 ms, and the steps,
    rejected ones included.

    tolerance: relative [1]; gap: height of the fall at constant speed [m].
    """
    rig, (lasts, depth, force) = steel_ball()
    scale = numpy.array([depth, 1.0]) * tolerance
    whole = integrate(rig, numpy.array([gap, -1.0]), scale, numpy.array([0.0, 1e-3]))
    z, v = whole.states[-1]
    duration = (1e-3 - z / v) - gap
    half = integrate(rig, numpy.array([gap, -1.0]), scale, numpy.array([0.0, gap + 0.5 * lasts]))
    deepest = -float(half.states[-1, 0])
    steps = whole.accepted + whole.rejected
    peak = elastic_force(rig.elastic, deepest)
    return abs(duration / lasts - 1.0), abs(deepest / depth - 1.0), abs(peak / force - 1.0), steps


def microsecond_contact() -> Finding:
    """Largest relative error of duration, depth and force of a contact of 69 microseconds."""
    return at_most(max(steel_impact(1e-10)[:3]), 1e-8, hard=1e-3 / steel_ball()[1][0])


def slap_error(tolerance: float, phase: float = 0.0) -> float:
    """Error of the seat slap after 4 s, relative to the scales of the motion; the start is raised
    by `phase` [m].
    """
    rig, start, scales = seat_slap()
    begin = start + numpy.array([phase, 0.0])
    found = integrate(rig, begin, scales * tolerance, numpy.array([0.0, 4.0])).states[-1]
    return float(numpy.max(numpy.abs(found - slap_reference(rig, begin)) / scales))


def slap_reference(rig: PointContact, start: Vector, end: float = 4.0) -> Vector:
    """State [states] at `end` [s] of the same run, by the slow reference."""
    damping = rig.dissipative.damping if isinstance(rig.dissipative, NormalDissipative) else 0.0
    twin = Slap(
        rig.mass, rig.gravity, rig.support_amplitude, rig.support_frequency, rig.elastic.coefficient, rig.elastic.exponent,
        damping,
    )  # fmt: skip
    return final_state(twin, start, end)


def seat_slap_position() -> Finding:
    """Position after 4 s and 20 slaps, at tolerance 1e-8."""
    rig, start, scales = seat_slap()
    course = integrate(rig, start, scales * 1e-8, numpy.array([0.0, 4.0]))
    return close_to(float(course.states[-1, 0]), float(slap_reference(rig, start)[0]), 1e-8, hard=course.events // 2)


def flight_over_fast_support() -> Finding:
    """A long flight over a support at 200 Hz: the first contact is met, whatever the free flight
    would allow as a step.
    """
    rig = PointContact(1.0, 9.81, 2.0e-3, 2.0 * math.pi * 200.0, NormalElastic(1.0e6, 1.5), NormalDissipative(0.1))
    start = numpy.array([0.05, 0.0])
    falls = math.sqrt(2.0 * (start[0] - rig.support_amplitude) / rig.gravity)
    periods = falls * rig.support_frequency / (2.0 * math.pi)
    found = integrate(rig, start, numpy.array([1e-3, 1.0]) * 1e-11, numpy.array([0.0, 0.12])).states[-1]
    return close_to(float(found[0]), float(slap_reference(rig, start, 0.12)[0]), 1e-8, hard=periods)


def pull_out() -> Finding:
    """A support that jumps away at 20 m/s: state against the twin, the contact is lost without a
    pull.
    """
    rig = PointContact(1.0, 0.0, 0.5, 40.0, NormalElastic(1.0e5, 1.5), NormalDissipative(2.0))
    start = numpy.array([0.0, 0.0])
    found = integrate(rig, start, numpy.array([0.1, 10.0]) * 1e-10, numpy.array([0.0, 0.3])).states[-1]
    return close_to(
        float(found[1]),
        float(slap_reference(rig, start, 0.3)[1]),
        1e-7,
        hard=found[0] / rig.support_amplitude,
    )


def _dropped() -> tuple[PointContact, Vector]:
    return PointContact(1.0, 9.81, 0.0, 0.0, NormalElastic(1.0e5, 1.5), NormalDissipative(0.3)), numpy.array(
        [0.05, 0.0]
    )


def comes_to_rest() -> Finding:
    """Approach after a drop and all micro-bounces: the static one."""
    rig, start = _dropped()
    course = integrate(rig, start, numpy.array([1e-3, 1.0]) * 1e-10, numpy.array([0.0, 20.0]))
    static = (rig.mass * rig.gravity / rig.elastic.coefficient) ** (1.0 / rig.elastic.exponent)
    return close_to(-float(course.states[-1, 0]), static, 1e-12, hard=course.events // 2)


def micro_bounces_end() -> Finding:
    """Events from 20 s to 40 s after a drop: none, the contact does not open any more."""
    rig, start = _dropped()
    scale = numpy.array([1e-3, 1.0]) * 1e-10
    first = integrate(rig, start, scale, numpy.array([0.0, 20.0])).events
    return exactly(integrate(rig, start, scale, numpy.array([0.0, 40.0])).events - first, 0, hard=first // 2)


def thousand_bounces() -> Finding:
    """Relative change of the energy over 1000 elastic bounces."""
    law = NormalElastic(1.0e6, 1.5)
    rig = PointContact(1.0, 9.81, 0.0, 0.0, law, None)
    period = 2.0 * math.sqrt(2.0 * 0.05 / 9.81)
    end = 1070.0 * period  # a contact takes 7 % of a flight
    course = integrate(rig, numpy.array([0.05, 0.0]), numpy.array([1e-3, 1.0]) * 3e-14, numpy.array([0.0, end]))
    z, v = course.states[-1]
    energy = 9.81 * z + 0.5 * v * v + elastic_energy(law, -z)
    return at_most(abs(energy / (9.81 * 0.05) - 1.0), 1e-9, hard=course.events // 2)


def energy_never_rises() -> Finding:
    """Largest rise of the energy between samples with dissipation, relative to the start: at most
    10 tolerances.
    """
    rig, start = _dropped()
    times = numpy.linspace(0.0, 5.0, 5001, dtype=numpy.float64)
    course = integrate(rig, start, numpy.array([1e-3, 1.0]) * 1e-8, times)
    states = course.states
    stored = numpy.array([elastic_energy(rig.elastic, -z) for z in states[:, 0]])
    energy = rig.gravity * states[:, 0] + 0.5 * states[:, 1] ** 2 + stored
    return at_most(float(max(0.0, numpy.diff(energy).max() / energy[0])), 1e-7, hard=course.events // 2)


def guard_on_events() -> Finding:
    """Status of a run with 350 000 bounces in one interval: the guard ends it with a sentence."""
    rig, start = PointContact(1.0, 9.81, 0.0, 0.0, NormalElastic(1.0e17, 1.5), None), numpy.array([1e-9, 0.0])
    course = integrate(rig, start, numpy.array([1e-10, 1e-5]), numpy.array([0.0, 10.0]), strict=False)
    return exactly(course.status, TOO_MANY_EVENTS, hard=10.0 / (2.0 * math.sqrt(2.0 * start[0] / rig.gravity)))


def not_a_number() -> Finding:
    """Status of a run that starts at NaN."""
    rig, start = _dropped()
    start *= math.nan
    course = integrate(rig, start, numpy.ones(2), numpy.array([0.0, 1.0]), strict=False)
    return exactly(course.status, NOT_FINITE, hard=numpy.isnan(start).sum())


CASES = (
    HardCase("impact", "restitution requested 0.05 to 0.98, delivered: largest error", requested_restitution,
        guard.scales("dampings, mild and strong", 100.0)),
    HardCase("impact", "20 approach phases, no blind step: largest error of e", approach_phases,
        guard.at_least("steps that ended at a touch or a parting", 2 * PHASES)),
    HardCase("impact", "error over requested tolerance, 1e-3 to 1e-11", tolerance_is_met,
        guard.scales("tolerances", 1e8)),
    HardCase("impact", "slope of log error over log tolerance", order_of_error, guard.scales("tolerances", 1e7)),
    HardCase("impact", "elastic, loosest tolerance, 20 phases: gain over 1", no_energy_without_source,
        guard.at_most("loss that could hide a gain", 1e-9)),
    HardCase("impact", "very stiff, ω·dt = 1e4: restitution", very_stiff,
        guard.at_least("frequency of the contact times the tick", 1e4)),
    HardCase("impact", "contact of 69 µs in a tick of 1 ms: error of T, x, F", microsecond_contact,
        guard.scales("tick and contact", 10.0)),
    HardCase("point contact", "seat slap, 20 touches: z after 4 s [m]", seat_slap_position, guard.touches(20)),
    HardCase("point contact", "long flight over a support at 200 Hz: z [m]", flight_over_fast_support,
        guard.at_least("periods of the support in the first flight", 10.0)),
    HardCase("point contact", "driven, fast pull-out: v [m/s]", pull_out,
        guard.above("height over the support's highest place", 1.0)),
    HardCase("contact and gravity", "drop: approach at rest [m]", comes_to_rest, guard.touches(10)),
    HardCase("contact and gravity", "micro-bounces end: events after 20 s", micro_bounces_end, guard.touches(10)),
    HardCase("contact and gravity", "1000 elastic bounces: drift of the energy", thousand_bounces, guard.touches(1000)),
    HardCase("contact and gravity", "with dissipation the energy never rises: largest rise", energy_never_rises,
        guard.touches(5)),
    HardCase("integrator", "350 000 bounces in one interval: status", guard_on_events,
        guard.at_least("bounces in the interval, by their period", 1e5)),
    HardCase("integrator", "NaN in the state: status", not_a_number,
        guard.at_least("states at the start that are no number", 1)),
)  # fmt: skip
