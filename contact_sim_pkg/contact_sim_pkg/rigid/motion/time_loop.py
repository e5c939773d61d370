"""The located steps of a body between impacts, over any number of output samples in one compiled
call.

Flight, and held points that a closed form solves (a face, an edge in the plane, a point:
`rigid/geometry/face.py`, `rigid/impact/planar_pair.py`, `rigid/contact/single.py`) with no event in
the piece. For everything else, an impact or a piece that takes the general solvers or holds an
event, the call returns and says what it asks for; `rigid/motion/located.py` does that step and
calls again. So the general solvers are compiled once, apart.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
import numpy.typing

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry, inline_kernel
from contact_sim_pkg.rigid.body import Ground, Motion, RigidBody
from contact_sim_pkg.rigid.contact.single import single_impulses
from contact_sim_pkg.rigid.geometry.face import face_impulses, make_face_workspace
from contact_sim_pkg.rigid.geometry.track import (
    BRIEF,
    CLOCKS,
    COLLIDED,
    COUNTS,
    EVENTS,
    INTERVAL,
    LOST,
    PIECE,
    RESIDUAL,
    RESTED,
    RESTS,
    SAMPLE,
    SAMPLES,
    SHORT,
    SOLVES,
    STILL,
    STOPS,
    TIME,
    add_impulse,
    record_sample,
    repeat_to_the_end,
)
from contact_sim_pkg.rigid.impact.planar_impact import contact_modes
from contact_sim_pkg.rigid.impact.planar_pair import PairWorkspace, make_pair_workspace, pair_impulses
from contact_sim_pkg.rigid.motion.active_contacts import (
    landing_part,
    path_acceleration,
    settle_points,
    survey_points,
    time_to_peak,
)
from contact_sim_pkg.rigid.motion.flight import fly_to_touch, is_clear
from contact_sim_pkg.rigid.motion.motion import HELD, MotionWorkspace, contact_velocities, free_velocity
from contact_sim_pkg.rigid.motion.slip import slip_turns, stop_of_slip, turns
from contact_sim_pkg.rigid.motion.straight_slide import NO_FACE, rests, slide_straight, straight_face
from contact_sim_pkg.rigid.motion.substep_end import take_piece
from contact_sim_pkg.rigid.parameters import PlanarContact
from contact_sim_pkg.rigid.problem import DISC, INACTIVE, PLANE

DONE, COLLIDE, SUPPORT, PAUSE = 0, 1, 2, 3  # what a call ends with
LARGEST_TURN = 0.02  # [rad] of a piece of free flight in space, where the spin is of order 6
LARGEST_PLANAR_TURN = 0.2  # [rad] of a piece of free flight in the plane, which is exact: it only has to find the touch
CELL_PART = 0.1  # of a cell of the ground that a body passes in a piece
MOST_SHORT = 100_000  # such pieces in one sample: there is no end
PAUSE_AFTER = 10_000  # pieces, so that a run can be broken off
GOOD = 1.0e-12  # residual of a closed form that is taken


class MarchWorkspace(NamedTuple):
    """Where a march stands, and its arrays."""

    clock: Vector  # [CLOCKS]: time in the interval, interval, time of rest from the start, energy lost, residual, ...
    counts: numpy.typing.NDArray[numpy.int64]  # [COUNTS]
    face: Vector  # `make_face_workspace`
    pair: PairWorkspace
    before: Vector  # [points]
    after: Vector  # [points]


def make_march_workspace(points: int) -> MarchWorkspace:
    """Work space of a body of ``points`` contacts."""
    zeros = numpy.zeros
    return MarchWorkspace(
        zeros(CLOCKS), zeros(COUNTS, numpy.int64), make_face_workspace(points), make_pair_workspace(), zeros(points),
        zeros(points),
    )  # fmt: skip


@inline_kernel
def _spin(body, motion):
    spin = 0.0
    for k in range(body.width, motion.velocity.shape[0]):
        spin += abs(motion.velocity[k])
    return spin


@inline_kernel
def _longest(body, ground, motion, turn, size):
    """Longest piece in [s] over which the body turns by at most ``turn`` [rad] and stays near one
    cell of the ground.
    """
    spin, speed = _spin(body, motion), 0.0
    longest = turn / spin if spin > 0.0 else math.inf
    if ground.profile.nodes.shape[0] > 0:
        for k in range(body.width):
            speed = max(speed, abs(motion.velocity[k]))
        speed += spin * size
        longest = min(longest, CELL_PART * ground.profile.cell / speed) if speed > 0.0 else longest
    return longest


@inline_kernel
def _longest_flight(body, ground, motion, size, left):
    """Longest piece in [s] of the flight of the next ``left`` [s]."""
    turn = LARGEST_PLANAR_TURN if body.width == PLANE else LARGEST_TURN
    longest = _longest(body, ground, motion, turn, size)
    if longest < left and ground.profile.nodes.shape[0] > 0:
        spin = _spin(body, motion)
        free = turn / spin if spin > 0.0 else math.inf
        return free if is_clear(body, ground, motion, min(left, free)) else longest
    return longest


@inline_kernel
def _one_in_the_plane(work, i):
    """Impulse of the one held point of a planar body by its closed modes."""
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


@inline_kernel
def _free_contacts(body, ground, motion, work, time, still):
    """Velocities ``q`` of the contacts after ``time`` without impulses, and who takes part.

    Returns the first two held contacts, how many are held, and whether the path of one bends.
    """
    free_velocity(body, motion, work, time)
    contact_velocities(work.J, work.free, work.problem.q)
    held, bent = 0, False
    none = numpy.int64(-1)  # a literal -1 would compile the closed forms once more, for that number
    first, second = none, none
    for i in range(work.flags.shape[0]):
        work.problem.friction[i] = INACTIVE
        if work.flags[i] >= HELD:
            work.problem.friction[i] = body.friction
            place = numpy.int64(i)
            first, second, held = (place if held == 0 else first), (place if held == 1 else second), held + 1
            gain, row = path_acceleration(body, ground, motion, work.J, i), i * body.width
            work.problem.q[row] += time * gain[0]
            work.problem.q[row + 1] += time * gain[1]
            if body.width != PLANE:
                work.problem.q[row + 2] += time * gain[2]
            bent = bent or time * abs(gain[0]) > still
    return first, second, held, bent


@inline_kernel
def _attempt(body, ground, motion, work, march, time, still):
    """Closed form of the held contacts over ``time`` into ``work.impulse``; its residual, inf where
    there is none.
    """
    first, second, held, bent = _free_contacts(body, ground, motion, work, time, still)
    for row in range(work.impulse.shape[0]):
        work.impulse[row] = 0.0
    q, friction = work.problem.q, work.problem.friction
    if body.width == PLANE:
        if held == 1:
            return _one_in_the_plane(work, first)
        return (
            pair_impulses(work.J, work.W, q, friction, first, second=second, work=march.pair, c=work.impulse)
            if held == 2
            else numpy.inf
        )
    if work.problem.facets != DISC:
        return numpy.inf  # the closed forms in space are those of the true cone
    if held == 1:
        return single_impulses(work.J, work.W, q, body.friction, first, work.impulse)
    return numpy.inf if bent else face_impulses(work.J, work.W, work.free, friction, march.face, work.impulse)


@inline_kernel
def _support(body, ground, motion, work, march, time, size, still):
    """Hold the points over ``time`` in closed form; False where it turns, and for general solvers
    or an event.
    """
    if turns(body, ground, motion, work, motion.velocity, size):
        return False
    residual = _attempt(body, ground, motion, work, march, time, still)
    if not residual <= GOOD:
        return False
    part, _stretch = stop_of_slip(body, ground, motion, work, time, size, still)
    if turns(body, ground, motion, work, work.free, size) or slip_turns(body, motion, work, still):
        return False
    if part < 1.0 or landing_part(body, ground, motion, work, time, size)[1] >= 0:
        return False
    clock = march.clock
    clock[RESIDUAL] = max(clock[RESIDUAL], residual)
    return True


@entry
def advance_samples(
    body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace, march: MarchWorkspace, size: float,
    gravity: float, rest_speed: float, impulse_column: int, track: Vector,
) -> int:  # fmt: skip
    """Go on from where ``march`` stands, up to the end of its samples (DONE) or to what it cannot
    do: COLLIDE, SUPPORT.

    PAUSE: so many pieces are done, or too many short ones, that the caller should look.

    ``track`` [samples, columns]: the impulses of each sample are added up in it, the states written
    at its end.
    """
    clock, count, pieces = march.clock, march.counts, 0
    points = NO_FACE
    while count[SAMPLE] < count[SAMPLES]:
        while clock[TIME] < clock[INTERVAL]:
            left = clock[INTERVAL] - clock[TIME]
            if points.held > 0:
                lost = slide_straight(body, motion, work, march.face, points, left, clock[STILL])
                if lost >= 0.0:
                    clock[LOST] += lost
                    clock[TIME] = clock[INTERVAL]
                    count[SOLVES] += 1
                    add_impulse(work, track[count[SAMPLE]], impulse_column)
                    continue
                points = NO_FACE
            still, approaches = survey_points(body, ground, motion, work, size, gravity)
            clock[STILL] = still
            if approaches and count[COLLIDED] == 0:
                return COLLIDE
            count[COLLIDED] = 0
            wait, holds = settle_points(body, ground, motion, work, rest_speed, size, still)
            if wait > 0.0:
                clock[RESTED] = count[SAMPLE] * clock[INTERVAL] + clock[TIME] + wait
            if holds:
                add_impulse(work, track[count[SAMPLE]], impulse_column)
                resting = rests(motion, work, size)
                if resting and count[RESTS] > 0 and count[RESTS] == count[SAMPLE]:
                    repeat_to_the_end(count, track)
                    return DONE
                longest = min(left, _longest(body, ground, motion, math.inf, size))
                passed = longest
                if ground.profile.nodes.shape[0] > 0:
                    passed = min(longest, time_to_peak(body, ground, motion, work))
                clock[PIECE] = passed
                count[RESTS] = count[SAMPLE] + 1 if resting and passed >= clock[INTERVAL] else 0
                count[SOLVES] += 1
                if not _support(body, ground, motion, work, march, time=passed, size=size, still=still):
                    return SUPPORT
                add_impulse(work, track[count[SAMPLE]], impulse_column)
                clock[LOST] += take_piece(body, ground, motion, work, passed, size, still)
                points = straight_face(body, ground, motion, work, march.face)
            else:
                longest = min(left, _longest_flight(body, ground, motion, size, left))
                passed, point = fly_to_touch(body, ground, motion, work, longest, march.before, march.after)
                count[EVENTS] += 1 if point >= 0 else 0
            count[SHORT] += 1 if passed < BRIEF * longest else 0
            clock[TIME] = clock[INTERVAL] if passed >= left else clock[TIME] + passed
            pieces += 1
            if pieces > PAUSE_AFTER or count[SHORT] > MOST_SHORT:
                return PAUSE
        record_sample(body, motion, work, track[count[SAMPLE]])
        count[SAMPLE] += 1
        clock[TIME] = 0.0
        count[STOPS], count[SHORT] = 0, 0
    return DONE
