"""Free flight of a rigid body to its first touch of the ground.

The centre of mass moves exactly under a uniform load, the spin in space by a step of order 6; the
touch is the root of a point's gap, whose change is summed free of cancellation, so that its time is
as exact as the state. Source: Identifiability eqs 10, 11.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.rigid.bodies.body import Ground, Motion, RigidBody, on_profile
from contact_sim_pkg.rigid.bodies.motion import (
    SEPARATED,
    TOUCHING,
    MotionWorkspace,
    commit,
    free_motion,
    update_contacts,
)
from contact_sim_pkg.rigid.problem import PLANE

ROOT_STEPS = 100
PARTS = 4  # of a sub-step that are looked at, so that a point that dips and rises is seen
TOUCH = 1.0e-9  # of the body's size: a second point this near takes part in the impact


@kernel
def body_size(body):
    """Greatest distance of the surface from the centre of mass in [m]."""
    size = body.radius
    for i in range(body.points.shape[0]):
        length = 0.0
        for k in range(body.width):
            length += body.points[i, k] ** 2
        size = max(size, math.sqrt(length) + body.radius)
    return size


@kernel
def _moved(body, motion, work, i, k):
    """Displacement of the point of contact ``i`` along axis ``k``."""
    points, R, turned = body.points, motion.rotation, work.turned
    if body.width == PLANE:
        half, sine = math.sin(0.5 * work.turn[0]), math.sin(work.turn[0])
        less = -2.0 * half * half
        x = R[0, 0] * points[i, 0] + R[0, 1] * points[i, 1]
        y = R[1, 0] * points[i, 0] + R[1, 1] * points[i, 1]
        return work.shift[k] + (less * x - sine * y if k == 0 else sine * x + less * y)
    total = work.shift[k]
    for m in range(3):
        total += (turned[k, m] - R[k, m]) * points[i, m]
    return total


@kernel
def gap_change(body, ground, motion, work, i):
    """Change of the gap of contact ``i`` over the displacement; against a plane free of
    cancellation.
    """
    if ground.profile.nodes.shape[0] > 0:
        x, z = motion.position[0] + work.shift[0], motion.position[body.width - 1] + work.shift[body.width - 1]
        return on_profile(body, ground, work.turned, x, z, i)[0] - work.gap[i]
    row, total = i * body.width, 0.0
    for k in range(body.width):
        total += work.J[row, k] * _moved(body, motion, work, i, k)
    return total


@kernel
def _clearance(body, ground, motion, work, i, time):
    """Gap of contact ``i`` after ``time``, of which the displacement is known; over ``time`` where
    it starts on the ground.
    """
    change = gap_change(body, ground, motion, work, i)
    if work.flags[i] != SEPARATED:
        return change / time
    return max(work.gap[i], 0.0) + change


@kernel
def _root(body, ground, motion, work, i, times, gaps):
    """Time in [s] of the touch of point ``i`` between two ``times`` by regula falsi (Illinois).

    ``gaps``: of the point at both, the first above 0 and the second below.
    """
    (low, high), (above, below), side = times, gaps, 0
    for _ in range(ROOT_STEPS):
        if high - low <= 2.0e-16 * high:
            break
        # a chord that rounding throws out of the bracket is replaced by the middle
        time = low + (high - low) * above / (above - below)
        if not low < time < high:
            time = 0.5 * (low + high)
        free_motion(body, motion, work, time)
        value = _clearance(body, ground, motion, work, i, time)
        # Illinois: the end that stays twice counts half
        if value > 0.0:
            low, above = time, value
            below = 0.5 * below if side == 1 else below
            side = 1
        elif value < 0.0:
            high, below = time, value
            above = 0.5 * above if side == -1 else above
            side = -1
        else:
            return time
    return high


@kernel
def travel_bound(body, motion, time):
    """How far in [m] a point of the body can move in ``time`` [s] of flight, at most."""
    v, load, width = motion.velocity, body.load, body.width
    size, speed, push, spin, moment = body_size(body), 0.0, 0.0, 0.0, 0.0
    for k in range(width):
        speed, push = speed + abs(v[k]), push + abs(load[k])
    for k in range(width, v.shape[0]):
        spin, moment = spin + abs(v[k]), moment + abs(load[k])
    lightest = body.inertia[0]
    for k in range(body.inertia.shape[0]):
        lightest = min(lightest, body.inertia[k])
    reach = time * (speed + 0.5 * time * push / body.mass)
    # free spin keeps its energy: it grows at most by the root of the ratio of the inertias
    if spin + moment > 0.0:
        grown = spin * math.sqrt(_greatest_inertia(body.inertia) / lightest) + time * moment / lightest
        reach += time * size * grown
    return reach


@kernel
def is_clear(body, ground, motion, time):
    """Whether a body in the air stays above the greatest height in ``time`` [s], and within the
    heights.
    """
    profile, reach = ground.profile, travel_bound(body, motion, time) + body_size(body)
    x, last = motion.position[0], profile.nodes.shape[0] - 1
    inside = x - reach > profile.origin and x + reach < profile.origin + last * profile.cell
    return inside and motion.position[body.width - 1] - reach > profile.top


@kernel
def _stays_away(body, ground, motion, work, time):
    """Whether every point starts in the air, farther from the ground than the body can move in
    ``time`` [s].
    """
    away, reach = True, travel_bound(body, motion, time)
    for i in range(work.gap.shape[0]):
        away = away and work.flags[i] == SEPARATED and work.gap[i] > reach
    return away if ground.profile.nodes.shape[0] == 0 else away and is_clear(body, ground, motion, time)


@kernel
def _greatest_inertia(inertia):
    """Greatest of the principal inertias."""
    greatest = 0.0
    for k in range(inertia.shape[0]):
        greatest = max(greatest, inertia[k])
    return greatest


@kernel
def _first_touch(body, ground, motion, work, substep, before, after):
    """Time of the first touch within ``substep`` and its point, -1 where there is none."""
    points = work.gap.shape[0]
    # a contact that starts on the ground is known by its velocity
    for i in range(points):
        before[i] = work.u[i * body.width] if work.flags[i] != SEPARATED else max(work.gap[i], 0.0)
    low, first, point = 0.0, substep, -1
    if _stays_away(body, ground, motion, work, substep):
        return first, point
    # gaps at the ends of a few parts: a point that dips and rises is seen
    for part in range(1, PARTS + 1):
        time = part * substep / PARTS
        free_motion(body, motion, work, time)
        for i in range(points):
            after[i] = _clearance(body, ground, motion, work, i, time)
        for i in range(points):
            # the first root of all points that came down
            if after[i] < 0.0:
                touch = low
                if before[i] > 0.0:
                    touch = _root(body, ground, motion, work, i, (low, time), (before[i], after[i]))
                if touch < first or point < 0:
                    first, point = touch, i
            before[i] = after[i]
        if point >= 0:
            break
        low = time
    return first, point


@kernel
def fly_to_touch(
    body: RigidBody,
    ground: Ground,
    motion: Motion,
    work: MotionWorkspace,
    substep: float,
    before: Vector,
    after: Vector,
) -> tuple[float, int]:
    """Free flight to the first touch or the end of ``substep`` [s]; returns the time flown and the
    point, -1: none.

    ``before``, ``after`` [points] are work space.
    """
    size = body_size(body)
    time, point = _first_touch(body, ground, motion, work, substep, before, after)
    free_motion(body, motion, work, time)
    commit(body, motion, work.free, work)
    update_contacts(body, ground, motion, work)
    # points that come down together take part in one impact
    for i in range(work.flags.shape[0]):
        touches = i == point or work.gap[i] <= TOUCH * size
        work.flags[i] = TOUCHING if touches else SEPARATED
    return time, point
