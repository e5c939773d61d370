"""Slip of held points, where it stops, and whether a piece of time goes straight: neither rows of
contacts nor slips turn in it.

What goes straight is solved in one piece of any length (`rigid/motion/time_loop.py`,
`rigid/motion/straight_slide.py`); what turns is integrated (`rigid/motion/turning.py`). Source:
Identifiability eqs 12-18.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.rigid.body import Ground, Motion, RigidBody
from contact_sim_pkg.rigid.motion.active_contacts import drop_spin, path_acceleration
from contact_sim_pkg.rigid.motion.motion import HELD, MotionWorkspace, apply_impulse, turns_alike
from contact_sim_pkg.rigid.problem import PLANE

SWERVE = 1.0e-9  # [rad]: a turn of the slip that a piece, which takes one direction of friction, does not make
ROUNDING = 10.0  # times what counts as rounding: slip without a direction
SLOW = 1.0e-9  # of the slip before, squared: slip that ends there has stopped


@kernel
def slip_of(body, work, velocity, i):
    """Slip of point ``i`` at a velocity of the body: its two tangential parts."""
    row, first, second = i * body.width, 0.0, 0.0
    for k in range(velocity.shape[0]):
        first += work.J[row + 1, k] * velocity[k]
        if body.width == 3:
            second += work.J[row + 2, k] * velocity[k]
    return first, second


@entry
def slip_turns(body: RigidBody, motion: Motion, work: MotionWorkspace, still: float) -> bool:
    """Whether a held contact in space slides at the start of a piece and in another direction at
    its end, ``work.free``.

    ``still`` [m/s]: what counts as rounding.
    """
    if body.width == PLANE:
        return False
    for i in range(work.flags.shape[0]):
        if work.flags[i] >= HELD:
            a, b = slip_of(body, work, motion.velocity, i)
            c, d = slip_of(body, work, work.free, i)
            before, after = math.hypot(a, b), math.hypot(c, d)
            if min(before, after) > ROUNDING * still and abs(a * d - b * c) > SWERVE * before * after:
                return True
    return False


@entry
def stop_of_slip(
    body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace, time: float, size: float, still: float
) -> tuple[float, float]:
    """Velocity at the end of the piece in ``work.free``; part of it after which slip first stops,
    and how many pieces it lasts.
    """
    apply_impulse(work.J, work.W, work.impulse, work.free)
    for k in range(body.width):
        if abs(work.free[k]) <= still:
            work.free[k] = 0.0
    drop_spin(body, work.free, size, still)
    part, stretch = 1.0, math.inf
    for i in range(work.flags.shape[0]):
        if work.flags[i] != HELD:
            continue
        a, b = slip_of(body, work, motion.velocity, i)
        c, d = slip_of(body, work, work.free, i)
        gain = path_acceleration(body, ground, motion, work.J, i)
        c, d = c + time * gain[1], d + time * gain[2]
        before, along = a * a + b * b, a * c + b * d
        if before <= still * still:
            continue
        if along <= SLOW * before:
            part = min(part, before / (before - along) if along < 0.0 else 0.999999)
        if before > along:
            stretch = min(stretch, before / (before - along))
    return part, stretch


@entry
def turns(
    body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace, velocity: Vector, size: float
) -> bool:
    """Whether rows of held contacts turn or bend at ``velocity``: a body with an extent spins, or a
    contact's path is curved.

    A ball of unequal moments of inertia turns too.
    """
    if size > body.radius or not turns_alike(body):
        for k in range(body.width, velocity.shape[0]):
            if velocity[k] != 0.0:
                return True
    for i in range(work.flags.shape[0]):
        if work.flags[i] >= HELD and path_acceleration(body, ground, motion, work.J, i)[0] != 0.0:
            return True
    return False
