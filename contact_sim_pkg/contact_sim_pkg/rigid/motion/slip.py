"""Slip of active points, where it stops, and whether a sub-step goes straight: neither rows of
contacts nor slips turn in it.

What goes straight is solved in one sub-step of any length (`rigid/motion/time_loop.py`,
`rigid/motion/straight_slide.py`); what turns is integrated (`rigid/motion/turning.py`). Source:
Identifiability eqs 12-18.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.rigid.bodies.active_contacts import drop_spin, path_acceleration
from contact_sim_pkg.rigid.bodies.body import Ground, Motion, RigidBody
from contact_sim_pkg.rigid.bodies.motion import ACTIVE, MotionWorkspace, apply_impulse, has_equal_inertias
from contact_sim_pkg.rigid.problem import PLANE

# [rad]: a turn of the slip that a sub-step, which takes one direction of friction, does not make
SWERVE = 1.0e-9
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
def slip_turns(body: RigidBody, motion: Motion, work: MotionWorkspace, rounding: float) -> bool:
    """Whether an active contact in space slides at the start of a sub-step and in another direction
    at its end, ``work.free``.

    ``rounding`` [m/s]: what counts as rounding.
    """
    if body.width == PLANE:
        return False
    for i in range(work.flags.shape[0]):
        if work.flags[i] >= ACTIVE:
            a, b = slip_of(body, work, motion.velocity, i)
            c, d = slip_of(body, work, work.free, i)
            before, after = math.hypot(a, b), math.hypot(c, d)
            if min(before, after) > ROUNDING * rounding and abs(a * d - b * c) > SWERVE * before * after:
                return True
    return False


@entry
def stop_of_slip(
    body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace, time: float, size: float, rounding: float
) -> tuple[float, float]:
    """Velocity at the end of the sub-step of ``time`` [s] in ``work.free``; part of it after which
    slip first stops, and how many such sub-steps slip lasts.
    """
    # velocity at the end of the sub-step; what is rounding counts as 0
    apply_impulse(work.J, work.W, work.impulse, work.free)
    for k in range(body.width):
        if abs(work.free[k]) <= rounding:
            work.free[k] = 0.0
    drop_spin(body, work.free, size, rounding)
    part, duration = 1.0, math.inf
    for i in range(work.flags.shape[0]):
        # a contact that sticks has no slip to stop
        if work.flags[i] != ACTIVE:
            continue
        a, b = slip_of(body, work, motion.velocity, i)
        c, d = slip_of(body, work, work.free, i)
        gain = path_acceleration(body, ground, motion, work.J, i)
        c, d = c + time * gain[1], d + time * gain[2]
        # slip before, and its part at the end along it: 0 or back means that it stopped
        before, along = a * a + b * b, a * c + b * d
        if before <= rounding * rounding:
            continue
        if along <= SLOW * before:
            part = min(part, before / (before - along) if along < 0.0 else 0.999999)
        if before > along:
            duration = min(duration, before / (before - along))
    return part, duration


@entry
def contacts_turn(
    body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace, velocity: Vector, size: float
) -> bool:
    """Whether rows of active contacts turn at ``velocity`` [coordinates] in [m/s] and [rad/s]: a
    body with an extent spins, or the path of a contact is curved.

    A ball of unequal moments of inertia turns too.
    """
    if size > body.radius or not has_equal_inertias(body):
        for k in range(body.width, velocity.shape[0]):
            if velocity[k] != 0.0:
                return True
    for i in range(work.flags.shape[0]):
        if work.flags[i] >= ACTIVE and path_acceleration(body, ground, motion, work.J, i)[0] != 0.0:
            return True
    return False
