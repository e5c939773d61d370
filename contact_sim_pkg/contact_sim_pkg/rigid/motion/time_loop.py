"""The located steps of a body between impacts, over any number of output samples in one compiled
call.

Flight, and active points that a closed form solves (a face, an edge in the plane, a point:
`rigid/geometry/face.py`, `rigid/impact/planar_pair.py`, `rigid/contact/single.py`) with no event in
the sub-step. For everything else, an impact or a sub-step that needs the general solvers or holds
an event, the call returns with a request; `rigid/motion/located.py` does that step and calls again.
So the general solvers are compiled once, on their own.

Source: Identifiability eqs 3, 4 and 8.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel, entry
from contact_sim_pkg.rigid.bodies.active_contacts import (
    landing_part,
    path_acceleration,
    settle_points,
    survey_points,
    time_to_peak,
)
from contact_sim_pkg.rigid.bodies.body import Ground, Motion, RigidBody
from contact_sim_pkg.rigid.bodies.flight import fly_to_touch, is_clear
from contact_sim_pkg.rigid.bodies.motion import ACTIVE, MotionWorkspace, contact_velocities, free_velocity
from contact_sim_pkg.rigid.contact.planar_impact import contact_modes
from contact_sim_pkg.rigid.contact.single import single_impulses
from contact_sim_pkg.rigid.geometry.face import face_impulses, make_face_workspace
from contact_sim_pkg.rigid.impact.planar_pair import PairWorkspace, make_pair_workspace, pair_impulses
from contact_sim_pkg.rigid.motion.slip import contacts_turn, slip_turns, stop_of_slip
from contact_sim_pkg.rigid.motion.straight_slide import NO_FACE, is_at_rest, slide_straight, straight_face
from contact_sim_pkg.rigid.motion.substep_end import accept_substep
from contact_sim_pkg.rigid.motion.track import (
    BRIEF,
    RunState,
    add_impulse,
    make_run_state,
    record_sample,
    repeat_to_the_end,
)
from contact_sim_pkg.rigid.parameters import PlanarContact
from contact_sim_pkg.rigid.problem import DISC, INACTIVE, PLANE

# how a call ends: at the end of its samples, or with a request
DONE, COLLIDE, SOLVE, PAUSE = 0, 1, 2, 3
LARGEST_TURN = 0.02  # [rad] of a sub-step of free flight in space, where the spin is of order 6
LARGEST_PLANAR_TURN = (
    # [rad] of a sub-step of free flight in the plane, which is exact: it only has to find the touch
    0.2
)
CELL_PART = 0.1  # of a cell of the ground that a body passes in a sub-step
MOST_SHORT = 100_000  # such sub-steps in one sample: there is no end
PAUSE_AFTER = 10_000  # sub-steps, so that a run can be broken off
GOOD = 1.0e-12  # residual of a closed form that is accepted


class TimeLoopWorkspace(NamedTuple):
    """State of the run, and arrays of the loop."""

    run: RunState  # [1]
    face: Vector  # `make_face_workspace`
    pair: PairWorkspace
    before: Vector  # [points]
    after: Vector  # [points]


def make_time_loop_workspace(points: int) -> TimeLoopWorkspace:
    """Work space of a body of ``points`` contacts."""
    zeros = numpy.zeros
    return TimeLoopWorkspace(
        make_run_state(), make_face_workspace(points), make_pair_workspace(), zeros(points), zeros(points)
    )  # fmt: skip


@borrowing_kernel
def _spin(body, motion):
    spin = 0.0
    for k in range(body.width, motion.velocity.shape[0]):
        spin += abs(motion.velocity[k])
    return spin


@borrowing_kernel
def _longest(body, ground, motion, turn, size):
    """Longest sub-step in [s] over which the body turns by at most ``turn`` [rad] and stays near
    one cell of the ground.
    """
    spin, speed = _spin(body, motion), 0.0
    longest = turn / spin if spin > 0.0 else math.inf
    if ground.profile.nodes.shape[0] > 0:
        for k in range(body.width):
            speed = max(speed, abs(motion.velocity[k]))
        speed += spin * size
        longest = min(longest, CELL_PART * ground.profile.cell / speed) if speed > 0.0 else longest
    return longest


@borrowing_kernel
def _longest_flight(body, ground, motion, size, left):
    """Longest sub-step in [s] of the flight of the next ``left`` [s]."""
    turn = LARGEST_PLANAR_TURN if body.width == PLANE else LARGEST_TURN
    longest = _longest(body, ground, motion, turn, size)
    if longest < left and ground.profile.nodes.shape[0] > 0:
        spin = _spin(body, motion)
        free = turn / spin if spin > 0.0 else math.inf
        return free if is_clear(body, ground, motion, min(left, free)) else longest
    return longest


@borrowing_kernel
def _one_in_the_plane(work, i):
    """Impulse of the one active point of a planar body by its closed modes."""
    J, W, row = work.J, work.W, 2 * i
    nn, nt, tt = 0.0, 0.0, 0.0
    for k in range(3):
        nn += W[k, k] * J[row, k] * J[row, k]
        nt += W[k, k] * J[row, k] * J[row + 1, k]
        tt += W[k, k] * J[row + 1, k] * J[row + 1, k]
    contact = PlanarContact(nn, nt, tt, work.problem.friction[i], 0.0)
    found = contact_modes(contact, work.problem.q[row], work.problem.q[row + 1], 0.0)
    work.impulse[row], work.impulse[row + 1] = found.normal, found.tangential
    return 0.0


@borrowing_kernel
def _free_contacts(body, ground, motion, work, time, rounding):
    """Velocities ``q`` of the contacts after ``time`` without impulses, and which are active.

    Returns the first two active contacts, how many are active, and whether the path of one bends.
    """
    free_velocity(body, motion, work, time)
    contact_velocities(work.J, work.free, work.problem.q)
    active, curved = 0, False
    none = numpy.int64(-1)  # a literal -1 would compile the closed forms once more, for that number
    first, second = none, none
    for i in range(work.flags.shape[0]):
        work.problem.friction[i] = INACTIVE
        if work.flags[i] >= ACTIVE:
            work.problem.friction[i] = body.friction
            place = numpy.int64(i)
            first, second, active = (place if active == 0 else first), (place if active == 1 else second), active + 1
            gain, row = path_acceleration(body, ground, motion, work.J, i), i * body.width
            work.problem.q[row] += time * gain[0]
            work.problem.q[row + 1] += time * gain[1]
            if body.width != PLANE:
                work.problem.q[row + 2] += time * gain[2]
            curved = curved or time * abs(gain[0]) > rounding
    return first, second, active, curved


@borrowing_kernel
def _attempt(body, ground, motion, work, loop, time, rounding):
    """Closed form of the active contacts over ``time`` into ``work.impulse``; its residual, inf
    where there is none.
    """
    first, second, active, curved = _free_contacts(body, ground, motion, work, time, rounding)
    for row in range(work.impulse.shape[0]):
        work.impulse[row] = 0.0
    q, friction = work.problem.q, work.problem.friction
    if body.width == PLANE:
        if active == 1:
            return _one_in_the_plane(work, first)
        return (
            pair_impulses(work.J, work.W, q, friction, first, second=second, work=loop.pair, c=work.impulse)
            if active == 2
            else numpy.inf
        )
    if work.problem.facets != DISC:
        return numpy.inf  # the closed forms in space are those of the true cone
    if active == 1:
        return single_impulses(work.J, work.W, q, body.friction, first, work.impulse)
    return numpy.inf if curved else face_impulses(work.J, work.W, work.free, friction, loop.face, work.impulse)


@borrowing_kernel
def _solve_closed_form(body, ground, motion, work, loop, time, size, rounding):
    """The sub-step of ``time`` in closed form; False where the body turns, and for general solvers
    or an event.
    """
    if contacts_turn(body, ground, motion, work, motion.velocity, size):
        return False
    residual = _attempt(body, ground, motion, work, loop, time, rounding)
    if not residual <= GOOD:
        return False
    part, _duration = stop_of_slip(body, ground, motion, work, time, size, rounding)
    if contacts_turn(body, ground, motion, work, work.free, size) or slip_turns(body, motion, work, rounding):
        return False
    if part < 1.0 or landing_part(body, ground, motion, work, time, size)[1] >= 0:
        return False
    run = loop.run[0]
    run.residual = max(run.residual, residual)
    return True


@entry
def advance_samples(
    body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace, loop: TimeLoopWorkspace, size: float,
    gravity: float, rest_speed: float, impulse_column: int, track: Vector,
) -> int:  # fmt: skip
    """Go on from the state ``loop.run``, up to the end of its samples (DONE) or to what needs the
    general solvers: an impact (COLLIDE), a sub-step with active contacts (SOLVE).

    PAUSE: so many sub-steps are done, or too many short ones, that the caller should check.
    ``size`` [m] of the body, ``gravity`` [m/s^2], ``rest_speed`` [m/s].

    ``track`` [samples, columns]: the impulses of each sample are added up in it, the states written
    at its end.
    """
    run, substeps = loop.run[0], 0
    points = NO_FACE
    while run.sample < run.samples:
        while run.time < run.interval:
            left = run.interval - run.time
            # a straight slide goes on without survey and solver
            if points.active > 0:
                lost = slide_straight(body, motion, work, loop.face, points, left, run.rounding)
                if lost >= 0.0:
                    run.dissipated += lost
                    run.time = run.interval
                    run.solves += 1
                    add_impulse(work, track[run.sample], impulse_column)
                    continue
                points = NO_FACE
            # survey: an approach is an impact, which the caller solves
            rounding, approaches = survey_points(body, ground, motion, work, size, gravity)
            run.rounding = rounding
            if approaches and run.collided == 0:
                return COLLIDE
            run.collided = 0
            # slow rebounds end: their contacts become active
            wait, holds = settle_points(body, ground, motion, work, rest_speed, size, rounding)
            if wait > 0.0:
                run.rest_time = run.sample * run.interval + run.time + wait
            if holds:
                add_impulse(work, track[run.sample], impulse_column)
                resting = is_at_rest(motion, work, size)
                # nothing moved over a whole sample: all further ones are the same
                if resting and run.resting > 0 and run.resting == run.sample:
                    repeat_to_the_end(run, track)
                    return DONE
                # active contacts: a closed form over the sub-step, or a solve request
                longest = min(left, _longest(body, ground, motion, math.inf, size))
                passed = longest
                if ground.profile.nodes.shape[0] > 0:
                    passed = min(longest, time_to_peak(body, ground, motion, work))
                run.substep = passed
                run.resting = run.sample + 1 if resting and passed >= run.interval else 0
                run.solves += 1
                if not _solve_closed_form(body, ground, motion, work, loop, time=passed, size=size, rounding=rounding):
                    return SOLVE
                add_impulse(work, track[run.sample], impulse_column)
                run.dissipated += accept_substep(body, ground, motion, work, passed, size, rounding)
                points = straight_face(body, ground, motion, work, loop.face)
            else:
                # flight to the first contact
                longest = min(left, _longest_flight(body, ground, motion, size, left))
                passed, point = fly_to_touch(body, ground, motion, work, longest, loop.before, loop.after)
                run.events += 1 if point >= 0 else 0
            # progress; the caller looks at long runs and at sub-steps that events cut short
            run.short += 1 if passed < BRIEF * longest else 0
            run.time = run.interval if passed >= left else run.time + passed
            substeps += 1
            if substeps > PAUSE_AFTER or run.short > MOST_SHORT:
                return PAUSE
        # the end of a sample
        record_sample(body, motion, work, track[run.sample])
        run.sample += 1
        run.time = 0.0
        run.stops, run.short = 0, 0
    return DONE
