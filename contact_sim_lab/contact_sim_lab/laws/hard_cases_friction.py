"""Hard cases of friction: stick-slip, stick without creep, sliding to rest, contact that is lost
while it slips.
"""

from __future__ import annotations

import math

import numpy

from contact_sim_lab.laws.one_mass.belt_slider import BeltSlider
from contact_sim_lab.laws.one_mass.runs import integrate
from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, close_to, exactly
from contact_sim_lab.twins.belt_slider import StickSlip, period_of_rigid_law, slip_starts, state_at
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.results import DONE
from contact_sim_pkg.integrate.dormand_prince import make_workspace
from contact_sim_pkg.laws.parameters import Contact, Friction, NormalDissipative, NormalElastic
from contact_sim_pkg.rigs.vehicle.motion import columns, entries
from contact_sim_pkg.rigs.vehicle.motion.parameters import Seated, Vehicle, rigid_occupant
from contact_sim_pkg.rigs.vehicle.motion.vehicle import event_count

MASS, SPRING, BELT_SPEED, LOAD = 1.0, 100.0, 0.1, 9.81
STATIC, KINETIC = 0.4, 0.3
AT_REST_ON_BELT = numpy.array([0.0, BELT_SPEED, 0.0])


def stick_slip(stiffness: float, damping: float) -> tuple[BeltSlider, StickSlip]:
    """Stick-slip oscillator of the goals with a friction spring, and the same case for the
    reference; stiffness: [N/m], damping: [N s/m]."""
    rig = BeltSlider(MASS, SPRING, BELT_SPEED, LOAD, Friction(stiffness, damping, STATIC, KINETIC))
    return rig, StickSlip(MASS, SPRING, BELT_SPEED, LOAD, stiffness, damping, STATIC, KINETIC)


def scale_of(stiffness: float) -> Vector:
    """Scales [states] of the motion: position [m], speed [m/s], and the deflection [m] that the
    friction spring reaches."""
    return numpy.array([0.05, 0.3, STATIC * LOAD / stiffness])


def stick_slip_error(stiffness: float, damping: float, tolerance: float) -> float:
    """Largest error [1] of position and speed, over those of the motion, once in stick (3 s) and
    once in slip (3.3 s).

    stiffness: [N/m]; damping: [N s/m]; tolerance: relative [1].
    """
    rig, case = stick_slip(stiffness, damping)
    scale, ends = scale_of(stiffness), (3.0, 3.3)
    found = [integrate(rig, AT_REST_ON_BELT, scale * tolerance, numpy.array([0.0, end])).states[-1] for end in ends]
    return max(
        float(numpy.max(numpy.abs(state - state_at(case, end))[:2] / scale[:2]))
        for state, end in zip(found, ends, strict=True)
    )


def error_follows_the_tolerance() -> Finding:
    """Largest error over requested tolerance, 1e-3 to 1e-11, friction springs of 1e4, 1e5 and 1e6
    N/m.
    """
    springs = ((1.0e4, 140.0), (1.0e5, 400.0), (1.0e6, 1.0e3))
    tolerances = [10.0**-p for p in range(3, 12)]
    return at_most(
        max(stick_slip_error(*spring, each) / each for spring in springs for each in tolerances),
        10.0,
        hard=max(tolerances) / min(tolerances),
    )


def stick_slip_period(stiffness: float, damping: float, tolerance: float) -> float:
    """Period [s]: the state in stick one period of the rigid law later, set right by the speed in
    stick.
    """
    rig, case = stick_slip(stiffness, damping)
    period = period_of_rigid_law(case)
    sticking = (
        5.0 * period
    )  # the first slip comes after 0.4 s, the stick that starts 4 periods later holds this instant
    states = integrate(
        rig, AT_REST_ON_BELT, scale_of(stiffness) * tolerance, numpy.array([0.0, sticking, sticking + period])
    ).states
    return float(period - (states[2, 0] - states[1, 0]) / states[1, 1])


def _slip_changes(rig: BeltSlider, scale: Vector, end: float) -> int:
    return integrate(rig, AT_REST_ON_BELT, scale, numpy.array([0.0, end])).events


def period_of_the_spring_law() -> Finding:
    """Stick-slip period of the spring-damper law against its twin."""
    rig, case = stick_slip(1.0e6, 1.0e3)
    starts = slip_starts(case, 6)
    return close_to(
        stick_slip_period(1.0e6, 1.0e3, 1e-11),
        starts[5] - starts[4],
        1e-9,
        hard=_slip_changes(rig, scale_of(1.0e6) * 1e-11, 4.0),
    )


def period_of_the_rigid_law() -> Finding:
    """Stick-slip period extrapolated to an endless friction stiffness, against the closed form."""
    stiffness = numpy.array([1.0e4, 4.0e4, 1.6e5, 6.4e5]) * 16.0
    periods = numpy.array([stick_slip_period(c, 1.4 * math.sqrt(c * MASS), 1e-12) for c in stiffness])
    weights = numpy.vander(stiffness**-0.5, len(stiffness), increasing=True)
    limit = float(numpy.linalg.solve(weights, periods)[0])
    return close_to(limit, period_of_rigid_law(stick_slip(1.0, 0.0)[1]), 1e-9, hard=float(stiffness.max()) / SPRING)


def no_creep() -> Finding:
    """Creep [m/s] of a mass held by friction against a spring at 80 % of the limit, after its
    ringing has died out.
    """
    rig = BeltSlider(MASS, SPRING, 0.0, LOAD, Friction(1.0e5, 500.0, STATIC, KINETIC))
    held = 0.8 * STATIC * LOAD / SPRING
    scale = numpy.array([1e-3, 1e-2, 1e-3]) * 1e-10
    states = integrate(rig, numpy.array([held, 0.0, 0.0]), scale, numpy.array([0.0, 5.0, 15.0])).states
    return at_most(
        abs(float(states[2, 0] - states[1, 0])) / 10.0, 1e-15, hard=SPRING * float(states[2, 0]) / (STATIC * LOAD)
    )


def slide_to_rest() -> Finding:
    """Distance [m] from 2 m/s to rest: v0^2/(2 mu g), less the release of the friction spring in
    closed form.
    """
    friction = Friction(1.0e6, 1.4e3, KINETIC, KINETIC)
    rig = BeltSlider(MASS, 0.0, 0.0, LOAD, friction)
    scale = numpy.array([1.0, 1.0, 1e-3]) * 1e-12
    course = integrate(rig, numpy.array([0.0, 2.0, 0.0]), scale, numpy.array([0.0, 3.0]), mode=-1)
    deceleration = KINETIC * LOAD / MASS
    last_speed = friction.damping * deceleration / friction.stiffness  # slip ends where v equals the spring's rate
    slid = (4.0 - last_speed**2) / (2.0 * deceleration)
    released = (KINETIC * LOAD - friction.damping * last_speed) / friction.stiffness
    return close_to(float(course.states[-1, 0]), slid - released, 1e-10, hard=course.events)


def equal_ratios() -> Finding:
    """Status after 170 starts and stops of slip with mu_s = mu_k, where slip ends exactly on the limit of
    stick.
    """
    rig = BeltSlider(MASS, 1.0e4, 0.0, LOAD, Friction(1.0e6, 0.0, KINETIC, KINETIC))
    course = integrate(
        rig,
        numpy.array([0.05, 0.0, 0.0]),
        numpy.array([0.05, 5.0, 1e-3]) * 1e-9,
        numpy.array([0.0, 10.0]),
        strict=False,
    )
    return exactly(course.status, DONE, hard=course.events)


def slide_with_lift_off() -> tuple[Vector, Vector, float]:
    """Seat rig shaken in x and z until it leaves the cushion.

    Returns the forces [samples, forces], the states [samples, states] and the residual of the
    ledger over its dissipation [1].
    """
    mass, gravity = 50.0, 9.81
    friction = Friction(2.0e4, 200.0, 0.4, 0.35)
    contact = Contact(NormalElastic(2.73e5, 1.5), NormalDissipative(1.0), friction)
    rig = Vehicle(gravity, (), (Seated(rigid_occupant(mass), contact),))
    count = 4000
    times = numpy.arange(count + 1) * 1e-3
    a_x, a_z = 6.0 * numpy.sin(2 * math.pi * 3.1 * times), 14.0 * numpy.sin(2 * math.pi * 4.0 * times)
    # Start at rest under its own weight
    zeros = numpy.zeros(count + 1)
    state = numpy.zeros(7)
    state[0] = -((mass * gravity / 2.73e5) ** (2.0 / 3.0))
    work = make_workspace(7, event_count(rig))
    mode = numpy.zeros(1, dtype=numpy.int64)
    samples = (numpy.zeros((count, 7)), numpy.zeros((count, 7)), numpy.zeros((count, columns.FORCES)))
    scale = numpy.array([1e-2, 0.5, 1e-2, 0.5, 1e-2, numpy.inf, numpy.inf]) * 1e-9
    before = numpy.array(entries.energies(rig, mode, state, 0.0, 0.0))
    entries.start(rig, mode, state, work, 1e-3, zeros[:2], zeros[:2], a_x[:2], a_z[:2], None, (None, None))
    status = entries.advance(
        rig, mode, state, scale, work, 0.0, 1e-3, zeros, zeros, a_x, a_z, None, (None, None), 1, 0, *samples
    )
    if status != DONE:
        raise ArithmeticError(f"status {status}")
    kinetic, potential, stored, supplied, dissipated = (
        numpy.array(entries.energies(rig, mode, state, 0.0, 0.0)) - before
    )
    return samples[2], samples[0], abs(supplied - kinetic - potential - stored - dissipated) / dissipated


def _separated(forces: Vector) -> int:
    return int((forces[:, columns.SEAT_APPROACH] < 0.0).sum())


def separated_without_friction() -> Finding:
    """Largest friction force and spring deflection while the occupant is off the cushion (which
    happens).
    """
    forces, states, _residual = slide_with_lift_off()
    separated = forces[:, columns.SEAT_APPROACH] < 0.0
    held = numpy.abs(forces[separated, columns.SEAT_TANGENTIAL]).max() + numpy.abs(states[separated, 4]).max()
    return exactly(float(held), 0.0, hard=separated.sum())


def within_the_limit() -> Finding:
    """Largest friction force over its static limit, over all samples in contact, slip while the
    load vanishes included.
    """
    forces, _states, _residual = slide_with_lift_off()
    limit = STATIC * forces[:, columns.SEAT_NORMAL]
    return at_most(float((numpy.abs(forces[:, columns.SEAT_TANGENTIAL]) - limit).max()), 1e-6, hard=_separated(forces))


def ledger_with_friction() -> Finding:
    """Energy residual over dissipated energy with sticking, slipping and lift-off."""
    forces, _states, residual = slide_with_lift_off()
    return at_most(residual, 1e-7, hard=_separated(forces))


CASES = (
    HardCase("stick-slip", "period of the spring-damper law [s]", period_of_the_spring_law, guard.slip_changes(10)),
    HardCase("stick-slip", "period, friction stiffness → ∞ [s]", period_of_the_rigid_law,
        guard.scales("friction spring and spring", 1e4)),
    HardCase("stick-slip", "error over requested tolerance, 1e-3 to 1e-11", error_follows_the_tolerance,
        guard.scales("tolerances", 1e8)),
    HardCase("stick-slip", "no creep in stick at 80 % of the limit [m/s]", no_creep,
        guard.at_least("force over the limit of stick", 0.79)),
    HardCase("stick-slip", "2 m/s to rest: distance [m]", slide_to_rest, guard.slip_changes(1)),
    HardCase("stick-slip", "μs = μk, slip ends on the limit of stick: status", equal_ratios, guard.slip_changes(150)),
    HardCase("stick-slip", "normal force jumps to 0: friction and deflection separated", separated_without_friction,
        guard.contact_lost(100)),
    HardCase("stick-slip", "μF → 0 while slipping: force beyond μs·N [N]", within_the_limit, guard.contact_lost(100)),
    HardCase("stick-slip", "energy ledger over dissipated, with lift-off", ledger_with_friction,
        guard.contact_lost(100)),
)  # fmt: skip
