"""Which contacts a step of `rigid/motion/stepping.py` takes: those that close within it, and those
that it would drive into the ground.

A decision about each contact by the sign of a number, such as its gap at the end of the step, falls
differently for two corners that tie up to rounding, and a box that lands flat would then be struck
at one alone and tumble. So contacts whose numbers differ from one inside by rounding, or by less
than a fixed step resolves, are inside as well: one decision for all that tie. Source: Stewart and
Trinkle 1996; own.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.rigid.body import Ground, Motion, RigidBody
from contact_sim_pkg.rigid.motion.flight import body_size
from contact_sim_pkg.rigid.motion.motion import (
    ACTIVE,
    SEPARATED,
    MotionWorkspace,
    apply_impulse,
    contact_velocities,
    fill_active_problem,
    free_velocity,
    update_contacts,
)

GAP_TOLERANCE = 1.0e-9  # [m]
ROUNDING = 1.0e-11  # of the lengths and velocities that a number is made of: closer ones tie
# of the way of a contact in a step, or of its speed: closer ones tie too, far below the error of a
# step
TIES = 1.0e-3


@kernel
def bound_with_ties(body, work, margin, part, rounding):
    """The bound up to which a ``margin`` counts as negative: the greatest negative one, and all
    that tie with it in a row.

    Margins tie within ``rounding`` and ``part`` of the contact's normal velocity. -inf where none
    is negative.
    """
    bound = -math.inf
    for i in range(margin.shape[0]):
        if margin[i] < 0.0:
            bound = max(bound, margin[i])
    grows = bound > -math.inf
    while grows:
        grows = False
        for i in range(margin.shape[0]):
            near = rounding + part * abs(work.u[i * body.width])
            if bound < margin[i] <= bound + near:
                bound, grows = margin[i], True
    return bound


@kernel
def _scales(body, motion, work, step):
    """Length in [m] and velocity in [m/s] that gaps and velocities of contacts are made of."""
    size, place, speed = body_size(body), 0.0, 0.0
    for k in range(work.free.shape[0]):
        part = max(abs(work.free[k]), abs(motion.velocity[k]))
        speed += part if k < body.width else part * size
        place += abs(motion.position[k]) if k < body.width else 0.0
    return size + place + step * speed, speed


@kernel
def _activate_within(body, work, margin, step, length):
    """Separated contacts whose ``margin`` [m] is negative, or ties with such a one, become active;
    how many.
    """
    bound, taken = bound_with_ties(body, work, margin, TIES * step, ROUNDING * length), 0
    for i in range(margin.shape[0]):
        if work.flags[i] == SEPARATED and margin[i] <= bound:
            work.flags[i] = ACTIVE
            taken += 1
    return taken


@kernel
def _fill_problem(body, work, margin, step, rest_speed, speed):
    """The problem of the contacts that are active; 1, or 2 where one of them bounces.

    Those bounce that approach faster than ``rest_speed``, with restitution; ``margin`` is
    overwritten.
    """
    found, width = 1, body.width
    # fast ones, and those that tie with one, bounce
    for i in range(margin.shape[0]):
        margin[i] = work.u[i * width] + rest_speed if work.flags[i] == ACTIVE else math.inf
    bound = bound_with_ties(body, work, margin, TIES, ROUNDING * speed)
    for i in range(margin.shape[0]):
        active, row = work.flags[i] == ACTIVE, i * width
        fast = margin[i] <= bound and body.restitution > 0.0
        found = 2 if fast else found
        work.restitution[i] = body.restitution if fast else 0.0
        work.problem.floor[i] = 0.0
        # the normal row closes the gap at the end of the step
        for k in range(row, row + width):
            work.problem.q[k] = work.u[k] if active else 0.0
        work.problem.q[row] += work.gap[i] / step if active else 0.0
    fill_active_problem(body, work, ACTIVE)
    return found


@entry
def begin_step(
    body: RigidBody,
    ground: Ground,
    motion: Motion,
    work: MotionWorkspace,
    margin: Vector,
    step: float,
    rest_speed: float,
) -> tuple[int, float]:
    """Velocity without contact in ``work.free``, the contacts within reach and their problem.

    Returns 0: none is in reach, 1: they are active, 2: one bounces; and the angle turned in [rad].
    ``margin`` [points]: room; ``step`` [s], ``rest_speed`` [m/s].
    """
    # the free motion over the step
    update_contacts(body, ground, motion, work)
    free_velocity(body, motion, work, step)
    contact_velocities(work.J, work.free, work.u)
    turn = 0.0
    for k in range(body.width, work.free.shape[0]):
        turn = max(turn, step * abs(work.free[k]))
    # contacts that are closed, or close within the step
    length, speed = _scales(body, motion, work, step)
    for i in range(margin.shape[0]):
        work.flags[i] = SEPARATED
        margin[i] = min(work.gap[i] - GAP_TOLERANCE, work.gap[i] + step * work.u[i * body.width])
    if _activate_within(body, work, margin, step, length) == 0:
        return 0, turn
    return _fill_problem(body, work, margin, step, rest_speed, speed), turn


@entry
def reach_further(
    body: RigidBody,
    motion: Motion,
    work: MotionWorkspace,
    margin: Vector,
    change: Vector,
    step: float,
    rest_speed: float,
) -> int:
    """Take the contacts too that ``work.impulse`` would drive into the ground by the end of the
    step, and make the problem anew.

    Returns 0 where there are none, else as `begin_step`. ``change`` [coordinates]: room; ``step``
    [s], ``rest_speed`` [m/s].
    """
    # change of velocity by the impulses found
    for k in range(change.shape[0]):
        change[k] = 0.0
    apply_impulse(work.J, work.W, work.impulse, change)
    # gaps at the end of the step of the contacts left out so far
    length, speed = _scales(body, motion, work, step)
    for i in range(margin.shape[0]):
        row, after = i * body.width, work.u[i * body.width]
        for k in range(change.shape[0]):
            after += work.J[row, k] * change[k]
        margin[i] = work.gap[i] + step * after + GAP_TOLERANCE if work.flags[i] == SEPARATED else math.inf
    if _activate_within(body, work, margin, step, length) == 0:
        return 0
    return _fill_problem(body, work, margin, step, rest_speed, speed)
