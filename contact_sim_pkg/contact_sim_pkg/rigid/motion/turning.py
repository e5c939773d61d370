"""A piece of time with held contacts in which the body turns: the path of
`rigid/forces/constrained_body.py`, integrated with error control.

Which contacts stick, slide or part is what the contact problem over an instant says; the piece ends
where one of these modes does. Source: Hairer and Wanner, Solving Ordinary Differential Equations
II, VII.2 (index reduction, projection).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Modes, Vector
from contact_sim_pkg.compiled.jit import entry, inline_kernel, kernel
from contact_sim_pkg.compiled.results import DONE, NOT_FINITE
from contact_sim_pkg.integrate.dormand_prince import DormandPrinceWorkspace, integrate, make_workspace
from contact_sim_pkg.integrate.interface import rate
from contact_sim_pkg.rigid.body import Ground, Motion, RigidBody, contact_count
from contact_sim_pkg.rigid.body_state import IntegrationSpan, places_of
from contact_sim_pkg.rigid.forces.constrained_body import EVENTS_A_CONTACT, GOING, first_of_time, held_states
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
    HeldBody,
    make_held_body,
    stop_rows,
)
from contact_sim_pkg.rigid.geometry.track import (
    BRIEF,
    EVENTS,
    INTERVAL,
    LOST,
    PIECE,
    SAMPLE,
    SAMPLES,
    SHORT,
    SOLVES,
    STOPS,
    TIME,
    add_impulse,
    record_sample,
)
from contact_sim_pkg.rigid.motion.active_contacts import LANDED, path_acceleration
from contact_sim_pkg.rigid.motion.motion import HELD, STUCK, TOUCHING, MotionWorkspace, contact_velocities
from contact_sim_pkg.rigid.motion.slip import slip_of
from contact_sim_pkg.rigid.problem import PLANE
from contact_sim_pkg.rigid.rotation import spin_in_body, straighten

INSTANT = 1.0e-6  # of the time in which a body falls by its size: over it the contact problem tells the modes
FULL = 1.0e-9  # of a force or a speed: nearer than that to its limit counts as at it
SLIPS = 1.0e-9  # of the unit of speed, after the instant: less slip is rounding
BEYOND = 1.0e-6  # of the unit of force: so far beyond its limit a mode may start
STOPPED = 1.0e-5  # of the unit of speed: slip of a contact that shall stick at the start
MOST_SAMPLES = 1000  # of one call, so that a run can be broken off
PROGRESS = 1.0e-9  # of the piece: less is no progress to the end of a mode
PART = 0.1  # of the piece: less is not worth a start
MOST_STEPS = 500.0  # of a piece, and again for every time in which a body falls by its size
SHORTENED = 0.01  # of the piece: a step as short as that was cut by an event


class TurnWorkspace(NamedTuple):
    """The rig, and where the integrator keeps its state."""

    rig: HeldBody
    mode: Modes  # [contacts + 1]
    state: Vector  # [states]
    scale: Vector  # [states]
    integrator: DormandPrinceWorkspace


def make_turn_workspace(
    body: RigidBody, ground: Ground, size: float, gravity: float, tolerance: float
) -> TurnWorkspace:
    """Work space; ``tolerance``: the error a step may make, relative to the body's size and the
    speed of a fall from it.
    """
    contacts, rig = contact_count(body, ground), make_held_body(body, ground)
    size = size if size > 0.0 else 1.0  # a point does not turn
    states, places, speed = held_states(body, contacts), places_of(body.width), math.sqrt(gravity * size)
    width, turns = body.width, places_of(body.width) - body.width
    scale = numpy.full(states, math.inf)
    scale[:places] = [size] * width + [1.0] * turns
    scale[places : places + len(body.load)] = [speed] * width + [speed / size] * (len(body.load) - width)
    rig.unit[:] = speed, body.mass * gravity, LANDED * size, math.sqrt(size / gravity)
    workspace = make_workspace(states, EVENTS_A_CONTACT * contacts)
    return TurnWorkspace(rig, numpy.zeros(contacts + 1, numpy.int64), numpy.zeros(states), tolerance * scale, workspace)


@kernel
def _set_modes(body, motion, work, turn, gives_way):
    """Modes from the impulses of an instant; ``work.free`` is the velocity at its end. Slip counts
    the turn of arms over it.

    ``gives_way``: a contact that has used up its friction starts to slide against it. Returns
    whether there is one.
    """
    rig, mode = turn.rig, turn.mode
    contacts, instant, found = mode.shape[0] - 1, INSTANT * rig.unit[SECONDS], False
    mode[contacts] = GOING
    for i in range(contacts):
        row = i * body.width
        normal, mode[i] = work.impulse[row], FREE
        if work.flags[i] < HELD or normal <= 0.0:
            continue
        across = work.impulse[row + 2] if body.width != PLANE else 0.0
        first, second = slip_of(body, work, work.free, i)
        _normal, bend, across_bend = path_acceleration(body, rig.ground, motion, work.J, i)
        first, second = first + instant * bend, second + instant * across_bend
        slip = math.hypot(first, second)
        push = math.hypot(work.impulse[row + 1], across)
        full = push >= body.friction * normal * (1.0 - FULL)
        slides = full and slip > SLIPS * rig.unit[SPEED]
        if gives_way and full and not slides and push > 0.0:
            first, second, slip = -work.impulse[row + 1], -across, push
            slides, found = True, True
        mode[i] = SLIDES if slides else STICKS
        if slides:
            rig.contacts[FIRST, i], rig.contacts[SECOND, i] = first / slip, second / slip
    return found


@inline_kernel
def _set_flags(work, turn):
    """Which held contacts stick, which slide, and which are held no longer."""
    for i in range(work.flags.shape[0]):
        if work.flags[i] >= HELD:
            mode = turn.mode[i]
            work.flags[i] = STUCK if mode == STICKS else (HELD if mode == SLIDES else TOUCHING)


@inline_kernel
def _set_start(body, motion, work, turn):
    """The motion as the state of the rig."""
    rig, state = turn.rig, turn.state
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


@inline_kernel
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


@inline_kernel
def _starts_well(body, drive, turn):
    """Whether the modes hold at the start: what shall stick does not slip, forces are within their
    limits.
    """
    rig, mode, integrator = turn.rig, turn.mode, turn.integrator
    values = integrator.inside_rate
    rate(rig, drive, mode, 0.0, turn.state, values)
    good = True
    for margin in range(values.shape[0] - integrator.event_value.shape[0], values.shape[0]):
        good = good and values[margin] > -BEYOND
    for i in range(mode.shape[0] - 1):
        row, u = i * body.width, rig.rows[VELOCITY]
        if mode[i] == STICKS:
            across = u[row + 2] if body.width != PLANE else 0.0
            good = good and math.hypot(u[row + 1], across) <= STOPPED * rig.unit[SPEED]
    return good


@inline_kernel
def _stop_at_the_start(turn):
    """Take what the modes forbid from the velocities of the state, which was looked at; its
    impulses and their work stand there.
    """
    rig, state, u = turn.rig, turn.state, turn.rig.rows[VELOCITY]
    first = first_of_time(rig) + 2
    impulse, done = state[first : first + u.shape[0]], 0.0
    stop_rows(rig, turn.mode, impulse)
    for row in range(u.shape[0]):
        done += 0.5 * impulse[row] * u[row]
    contact_velocities(rig.J, rig.motion.velocity, u)
    for row in range(u.shape[0]):
        done += 0.5 * impulse[row] * u[row]
    state[first - 1] = done
    _put_velocity(rig.motion, state)


@inline_kernel
def _take_end(body, motion, work, turn, drive, still):
    """The end of the path as the motion; its impulses into ``work.impulse``. Velocities that the
    modes forbid are taken out.
    """
    rig, state = turn.rig, turn.state
    place = first_of_time(rig) + 2
    turn.mode[turn.mode.shape[0] - 1] = GOING
    rate(rig, drive, turn.mode, 0.0, state, turn.integrator.inside_rate)
    for row in range(work.impulse.shape[0]):
        work.impulse[row] = state[place + row]
    if body.width != PLANE:
        straighten(rig.motion.rotation)
    stop_rows(rig, turn.mode, work.impulse)
    for k in range(body.width):
        motion.position[k] = rig.motion.position[k]
        for m in range(body.width):
            motion.rotation[k, m] = rig.motion.rotation[k, m]
    motion.angle[0] = rig.motion.angle[0]
    for k in range(motion.velocity.shape[0]):
        motion.velocity[k] = rig.motion.velocity[k] if abs(rig.motion.velocity[k]) > still else 0.0


@inline_kernel
def _move(body, motion, work, turn, left, still):
    """Integrate over ``left`` [s] or to the end of a mode: the time, 0 where nothing was changed,
    and whether a mode ended.

    Where slip comes near 0 without stopping, its direction whirls ever faster: the path ends
    before, if it has come that far.
    """
    rig, integrator, last = turn.rig, turn.integrator, turn.mode.shape[0] - 1
    drive = IntegrationSpan(0.0, left)
    _set_start(body, motion, work, turn)
    if not _starts_well(body, drive, turn):
        return 0.0, False
    _stop_at_the_start(turn)
    for margin in range(integrator.event_direction.shape[0]):
        integrator.event_direction[margin] = 1.0
    integrator.last_event[0] = -math.inf
    integrator.step[1] = MOST_STEPS * (1.0 + left / rig.unit[SECONDS])
    if integrator.step[0] < SHORTENED * left:
        integrator.step[0] = left
    status = integrate(rig, drive, turn.mode, left, turn.state, turn.scale, integrator)
    time, ended = turn.state[first_of_time(rig)], turn.mode[last] != GOING
    least = PROGRESS if status == DONE else PART
    if status == NOT_FINITE or not time > least * left:
        return 0.0, ended
    _take_end(body, motion, work, turn, drive, still)
    return (left if status == DONE and not ended else time), ended


@entry
def turn_held(
    body: RigidBody, motion: Motion, work: MotionWorkspace, turn: TurnWorkspace, clock: Vector, count: Modes, track: Vector,
    still: float,
) -> bool:  # fmt: skip
    """Bring a body whose held contacts turn on to the end of a mode or of the piece, on a plane
    through all samples up to there.

    ``work.impulse`` and ``work.free`` are those of an instant with the contacts as they are; what
    each then does is left in ``work.flags``. Clock, counts and track go on as in
    `rigid/motion/time_loop.py`. False: the modes do not fit, nothing was changed.
    """
    column, moved, going, samples = track.shape[1] - work.impulse.shape[0] - work.flags.shape[0], False, True, 0
    again = True
    _set_modes(body, motion, work, turn, False)
    while going:
        left = clock[INTERVAL] - clock[TIME]
        left = left if moved else min(left, clock[PIECE])
        time, ended = _move(body, motion, work, turn, left, still)
        if time == 0.0 and again and not moved:  # a stick or a slip had just come to its end: on with what follows it
            again = False
            if ended or _set_modes(body, motion, work, turn, True):
                turn.mode[turn.mode.shape[0] - 1] = GOING
                continue
        if time == 0.0:
            break
        moved = True
        _set_flags(work, turn)
        add_impulse(work, track[count[SAMPLE]], column)
        clock[LOST] -= turn.state[first_of_time(turn.rig) + 1]
        count[SOLVES] += 1
        count[EVENTS] += 1 if ended else 0
        count[STOPS] += 1 if ended else 0
        count[SHORT] += 1 if time < BRIEF * left else 0
        whole = time == left and clock[TIME] + left >= clock[INTERVAL]
        clock[TIME] = clock[INTERVAL] if whole else clock[TIME] + time
        samples += 1
        flat = turn.rig.ground.profile.nodes.shape[0] == 0
        going = whole and flat and count[SAMPLE] + 1 < count[SAMPLES] and samples < MOST_SAMPLES
        if going:
            record_sample(body, motion, work, track[count[SAMPLE]])
            count[SAMPLE] += 1
            clock[TIME] = 0.0
            count[STOPS], count[SHORT] = 0, 0
    return moved
