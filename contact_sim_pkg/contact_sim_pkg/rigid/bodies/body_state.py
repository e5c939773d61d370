"""How the integrator sees a rigid body: place and turn, then v and omega.

Plane: x, z, angle; v_x, v_z, omega. Space: x, y, z, a quaternion (w, x, y, z) of any length; v in
world axes, omega in body axes.

Source: Identifiability eq 4.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.rigid.problem import PLANE
from contact_sim_pkg.rigid.rotation import gyroscopic_rate


class IntegrationSpan(NamedTuple):
    """Interval of integration of a body that nothing drives: the drive of its rig."""

    start: float  # [s]
    length: float  # [s]


def places_of(width: int) -> int:
    """Number of state variables for place and turn."""
    return 3 if width == PLANE else 7


@borrowing_kernel
def fill_turn(R, state):
    """Rotation matrix ``R`` of the angle (plane) or the quaternion (space) in the state."""
    if R.shape[0] == PLANE:
        cosine, sine = math.cos(state[2]), math.sin(state[2])
        R[0, 0], R[0, 1], R[1, 0], R[1, 1] = cosine, -sine, sine, cosine
        return
    w, x, y, z = state[3], state[4], state[5], state[6]
    scale = 2.0 / (w * w + x * x + y * y + z * z)
    R[0, 0], R[0, 1], R[0, 2] = 1.0 - scale * (y * y + z * z), scale * (x * y - w * z), scale * (x * z + w * y)
    R[1, 0], R[1, 1], R[1, 2] = scale * (x * y + w * z), 1.0 - scale * (x * x + z * z), scale * (y * z - w * x)
    R[2, 0], R[2, 1], R[2, 2] = scale * (x * z - w * y), scale * (y * z + w * x), 1.0 - scale * (x * x + y * y)


@borrowing_kernel
def fill_motion(motion, state):
    """Position, angle and velocities of the state into ``motion``, whose rotation must be there:
    velocities in world axes.
    """
    R, width = motion.rotation, motion.position.shape[0]
    for k in range(width):
        motion.position[k] = state[k]
    if width == PLANE:
        motion.angle[0] = state[2]
        for k in range(3):
            motion.velocity[k] = state[3 + k]
        return
    for k in range(3):
        motion.velocity[k] = state[7 + k]
        motion.velocity[3 + k] = R[k, 0] * state[10] + R[k, 1] * state[11] + R[k, 2] * state[12]


@borrowing_kernel
def fill_rates(body, R, push, state, out):
    """Rates of place, turn and velocities under ``push`` [coordinates], force and torque in world
    axes; ``R``: body to world.
    """
    if body.width == PLANE:
        for k in range(3):
            out[k] = state[3 + k]
            out[3 + k] = push[k] / (body.mass if k < 2 else body.inertia[0])
        return
    # the quaternion changes by half its product with the spin in body axes
    w, x, y, z = state[3], state[4], state[5], state[6]
    a, b, c = state[10], state[11], state[12]
    out[3] = -0.5 * (x * a + y * b + z * c)
    out[4] = 0.5 * (w * a + y * c - z * b)
    out[5] = 0.5 * (w * b + z * a - x * c)
    out[6] = 0.5 * (w * c + x * b - y * a)
    # Euler: gyroscopic torque, and the torque turned into body axes
    inertia = body.inertia
    gain = gyroscopic_rate(inertia, a, b, c)
    for k in range(3):
        out[k] = state[7 + k]
        out[7 + k] = push[k] / body.mass
        out[10 + k] = gain[k] + (R[0, k] * push[3] + R[1, k] * push[4] + R[2, k] * push[5]) / inertia[k]
