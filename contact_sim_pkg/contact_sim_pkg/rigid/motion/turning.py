"""A sub-step with active contacts in which the body turns: the path of
`rigid/forces/constrained_body.py`, integrated with error control.

Which contacts stick, slide or separate follows from the contact problem over an instant; the
sub-step ends where one of these modes does. Source: Hairer and Wanner, Solving Ordinary
Differential Equations II, VII.2 (index reduction, projection).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Modes, Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel, entry, kernel
from contact_sim_pkg.compiled.results import DONE, NOT_FINITE
from contact_sim_pkg.integrate.dormand_prince import DormandPrinceWorkspace, integrate, make_workspace
from contact_sim_pkg.integrate.interface import rate
from contact_sim_pkg.rigid.bodies.active_contacts import LANDED, path_acceleration
from contact_sim_pkg.rigid.bodies.body import Ground, Motion, RigidBody, contact_count
from contact_sim_pkg.rigid.bodies.body_state import IntegrationSpan, places_of
from contact_sim_pkg.rigid.bodies.motion import ACTIVE, STICKING, TOUCHING, MotionWorkspace, contact_velocities
from contact_sim_pkg.rigid.forces.constrained_body import EVENTS_PER_CONTACT, GOING, constrained_states, first_of_time
from contact_sim_pkg.rigid.forces.constraint_forces import (
    DEEP,
    FIRST,
    FREE,
    PLACE,
    SECOND,
    SECONDS,
    SLIDES,
    SPEED,
    STICKS,
    VELOCITY,
    ConstrainedBody,
    make_constrained_body,
    stop_rows,
)
from contact_sim_pkg.rigid.motion.slip import slip_of
from contact_sim_pkg.rigid.motion.track import BRIEF, RunState, add_impulse, record_sample
from contact_sim_pkg.rigid.problem import PLANE
from contact_sim_pkg.rigid.rotation import orthonormalize, spin_in_body

# of the time in which a body falls by its size: over it the contact problem gives the modes
INSTANT = 1.0e-6
FULL = 1.0e-9  # of a force or a speed: nearer than that to its limit counts as at it
SLIPS = 1.0e-9  # of the unit of speed, after the instant: less slip is rounding
BEYOND = 1.0e-6  # of the unit of force: so far beyond its limit a mode may start
STOPPED = 1.0e-5  # of the unit of speed: slip of a contact that shall stick at the start
MOST_SAMPLES = 1000  # of one call, so that a run can be broken off
PROGRESS = 1.0e-9  # of the sub-step: less is no progress to the end of a mode
PART = 0.1  # of the sub-step: less is not worth a start
MOST_STEPS = 500.0  # of a sub-step, and again for every time in which a body falls by its size
SHORTENED = 0.01  # of the sub-step: a step as short as that was cut by an event


class RotatingWorkspace(NamedTuple):
    """The rig, its state and the work space of the integrator."""

    rig: ConstrainedBody
    mode: Modes  # [contacts + 1]
    state: Vector  # [states]
    scale: Vector  # [states]
    integrator: DormandPrinceWorkspace


def make_rotating_workspace(
    body: RigidBody, ground: Ground, size: float, gravity: float, tolerance: float
) -> RotatingWorkspace:
    """Work space; ``tolerance``: the error a step may make, relative to the body's ``size`` [m] and
    the speed of a fall from it under ``gravity`` [m/s^2].
    """
    contacts, rig = contact_count(body, ground), make_constrained_body(body, ground)
    size = size if size > 0.0 else 1.0  # a point does not turn
    states, places, speed = constrained_states(body, contacts), places_of(body.width), math.sqrt(gravity * size)
    width, contacts_turn = body.width, places_of(body.width) - body.width
    scale = numpy.full(states, math.inf)
    scale[:places] = [size] * width + [1.0] * contacts_turn
    scale[places : places + len(body.load)] = [speed] * width + [speed / size] * (len(body.load) - width)
    rig.unit[:] = speed, body.mass * gravity, LANDED * size, math.sqrt(size / gravity)
    workspace = make_workspace(states, EVENTS_PER_CONTACT * contacts)
    return RotatingWorkspace(
        rig, numpy.zeros(contacts + 1, numpy.int64), numpy.zeros(states), tolerance * scale, workspace
    )


@kernel
def _set_modes(body, motion, work, rotating, gives_way):
    """Modes from the impulses of an instant; ``work.free`` is the velocity at its end. Slip counts
    the turn of arms over it.

    ``gives_way``: a contact that has used up its friction starts to slide against it. Returns
    whether there is one.
    """
    rig, mode = rotating.rig, rotating.mode
    contacts, instant, found = mode.shape[0] - 1, INSTANT * rig.unit[SECONDS], False
    mode[contacts] = GOING
    for i in range(contacts):
        row = i * body.width
        normal, mode[i] = work.impulse[row], FREE
        if work.flags[i] < ACTIVE or normal <= 0.0:
            continue
        # slip at the end of the instant, with the curved paths of the contact
        across = work.impulse[row + 2] if body.width != PLANE else 0.0
        first, second = slip_of(body, work, work.free, i)
        _normal, along_path, across_path = path_acceleration(body, rig.ground, motion, work.J, i)
        first, second = first + instant * along_path, second + instant * across_path
        slip = math.hypot(first, second)
        # at the edge of its cone it slides, if there is slip
        push = math.hypot(work.impulse[row + 1], across)
        full = push >= body.friction * normal * (1.0 - FULL)
        slides = full and slip > SLIPS * rig.unit[SPEED]
        # sticking at its limit: it starts to slide against its friction
        if gives_way and full and not slides and push > 0.0:
            first, second, slip = -work.impulse[row + 1], -across, push
            slides, found = True, True
        mode[i] = SLIDES if slides else STICKS
        if slides:
            rig.contacts[FIRST, i], rig.contacts[SECOND, i] = first / slip, second / slip
    return found


@borrowing_kernel
def _set_flags(work, rotating):
    """Which active contacts stick, which slide, and which are active no longer."""
    for i in range(work.flags.shape[0]):
        if work.flags[i] >= ACTIVE:
            mode = rotating.mode[i]
            work.flags[i] = STICKING if mode == STICKS else (ACTIVE if mode == SLIDES else TOUCHING)


@borrowing_kernel
def _set_start(body, motion, work, rotating):
    """The motion as the state of the rig."""
    rig, state = rotating.rig, rotating.state
    for i in range(state.shape[0]):
        state[i] = 0.0
    for i in range(work.gap.shape[0]):
        rig.contacts[DEEP, i], rig.contacts[PLACE, i] = min(work.gap[i], 0.0), work.feature[i]
    for k in range(body.width):
        state[k] = motion.position[k]
        for m in range(body.width):
            rig.start[k, m] = motion.rotation[k, m]
    if body.width == PLANE:
        state[2] = motion.angle[0]
    else:
        state[3] = 1.0
    _put_velocity(motion, state)


@borrowing_kernel
def _put_velocity(motion, state):
    """The velocities of a motion into the state."""
    v = motion.velocity
    if motion.position.shape[0] == PLANE:
        for k in range(3):
            state[3 + k] = v[k]
        return
    w = spin_in_body(motion.rotation, v)
    for k in range(3):
        state[7 + k], state[10 + k] = v[k], w[k]


@borrowing_kernel
def _starts_well(body, drive, rotating):
    """Whether the modes hold at the start: what shall stick does not slip, forces are within their
    limits.
    """
    rig, mode, integrator = rotating.rig, rotating.mode, rotating.integrator
    values = integrator.inside_rate
    rate(rig, drive, mode, 0.0, rotating.state, values)
    good = True
    for event in range(values.shape[0] - integrator.event_value.shape[0], values.shape[0]):
        good = good and values[event] > -BEYOND
    for i in range(mode.shape[0] - 1):
        row, u = i * body.width, rig.rows[VELOCITY]
        if mode[i] == STICKS:
            across = u[row + 2] if body.width != PLANE else 0.0
            good = good and math.hypot(u[row + 1], across) <= STOPPED * rig.unit[SPEED]
    return good


@borrowing_kernel
def _stop_at_the_start(rotating):
    """Remove what the modes forbid from the velocities of the state, which was looked at; its
    impulses and their work are left there.
    """
    rig, state, u = rotating.rig, rotating.state, rotating.rig.rows[VELOCITY]
    first = first_of_time(rig) + 2
    impulse, done = state[first : first + u.shape[0]], 0.0
    stop_rows(rig, rotating.mode, impulse)
    for row in range(u.shape[0]):
        done += 0.5 * impulse[row] * u[row]
    contact_velocities(rig.J, rig.motion.velocity, u)
    for row in range(u.shape[0]):
        done += 0.5 * impulse[row] * u[row]
    state[first - 1] = done
    _put_velocity(rig.motion, state)


@borrowing_kernel
def _accept_end(body, motion, work, rotating, drive, rounding):
    """The end of the path as the motion; its impulses into ``work.impulse``. Velocities that the
    modes forbid are taken out.
    """
    rig, state = rotating.rig, rotating.state
    place = first_of_time(rig) + 2
    rotating.mode[rotating.mode.shape[0] - 1] = GOING
    # forces and rows of the end state
    rate(rig, drive, rotating.mode, 0.0, state, rotating.integrator.inside_rate)
    for row in range(work.impulse.shape[0]):
        work.impulse[row] = state[place + row]
    if body.width != PLANE:
        orthonormalize(rig.motion.rotation)
    # drift of the constraints is taken out of the velocities
    stop_rows(rig, rotating.mode, work.impulse)
    # the motion of the rig becomes that of the body
    for k in range(body.width):
        motion.position[k] = rig.motion.position[k]
        for m in range(body.width):
            motion.rotation[k, m] = rig.motion.rotation[k, m]
    motion.angle[0] = rig.motion.angle[0]
    for k in range(motion.velocity.shape[0]):
        motion.velocity[k] = rig.motion.velocity[k] if abs(rig.motion.velocity[k]) > rounding else 0.0


@borrowing_kernel
def _move(body, motion, work, rotating, left, rounding):
    """Integrate over ``left`` [s] or to the end of a mode: the time, 0 where nothing was changed,
    and whether a mode ended.

    Where slip comes near 0 without stopping, its direction whirls ever faster: the path ends
    before, if it has come that far.
    """
    rig, integrator, last = rotating.rig, rotating.integrator, rotating.mode.shape[0] - 1
    drive = IntegrationSpan(0.0, left)
    _set_start(body, motion, work, rotating)
    # modes that contradict the state at once: the caller tries others
    if not _starts_well(body, drive, rotating):
        return 0.0, False
    _stop_at_the_start(rotating)
    for event in range(integrator.event_direction.shape[0]):
        integrator.event_direction[event] = 1.0
    # a fresh integration; the step size of the last one is kept
    integrator.last_event[0] = -math.inf
    integrator.step[1] = MOST_STEPS * (1.0 + left / rig.unit[SECONDS])
    if integrator.step[0] < SHORTENED * left:
        integrator.step[0] = left
    status = integrate(rig, drive, rotating.mode, left, rotating.state, rotating.scale, integrator)
    time, ended = rotating.state[first_of_time(rig)], rotating.mode[last] != GOING
    # an integration without progress changes nothing
    least = PROGRESS if status == DONE else PART
    if status == NOT_FINITE or not time > least * left:
        return 0.0, ended
    _accept_end(body, motion, work, rotating, drive, rounding)
    return (left if status == DONE and not ended else time), ended


@entry
def advance_rotating(
    body: RigidBody, motion: Motion, work: MotionWorkspace, rotating: RotatingWorkspace, run_state: RunState,
    track: Vector, rounding: float,
) -> bool:  # fmt: skip
    """Advance a body whose active contacts turn to the end of a mode or of the sub-step, on a plane
    through all samples up to there.

    ``work.impulse`` and ``work.free`` are those of an instant with the contacts as they are; what
    each then does is left in ``work.flags``. ``run_state`` [1] and ``track`` [samples, columns] go
    on as in `rigid/motion/time_loop.py`; ``rounding`` [m/s]. False: the modes do not fit, nothing
    was changed.
    """
    run = run_state[0]
    column, moved, going, samples = track.shape[1] - work.impulse.shape[0] - work.flags.shape[0], False, True, 0
    again = True
    _set_modes(body, motion, work, rotating, False)
    while going:
        left = run.interval - run.time
        left = left if moved else min(left, run.substep)
        time, ended = _move(body, motion, work, rotating, left, rounding)
        # a stick or a slip had just come to its end: on with what follows it
        if time == 0.0 and again and not moved:
            again = False
            if ended or _set_modes(body, motion, work, rotating, True):
                rotating.mode[rotating.mode.shape[0] - 1] = GOING
                continue
        if time == 0.0:
            break
        moved = True
        _set_flags(work, rotating)
        add_impulse(work, track[run.sample], column)
        run.dissipated -= rotating.state[first_of_time(rotating.rig) + 1]
        run.solves += 1
        run.events += 1 if ended else 0
        run.stops += 1 if ended else 0
        run.short += 1 if time < BRIEF * left else 0
        whole = time == left and run.time + left >= run.interval
        run.time = run.interval if whole else run.time + time
        samples += 1
        flat = rotating.rig.ground.profile.nodes.shape[0] == 0
        going = whole and flat and run.sample + 1 < run.samples and samples < MOST_SAMPLES
        if going:
            record_sample(body, motion, work, track[run.sample])
            run.sample += 1
            run.time = 0.0
            run.stops, run.short = 0, 0
    return moved
