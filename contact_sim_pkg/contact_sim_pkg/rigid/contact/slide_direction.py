"""One contact in space that slides: the direction of slip as the root of one equation, found
between brackets.

For a direction d of slip ``c_t = -mu c_n d``, and ``c_n = -q_n / s`` with ``s = A_nn - mu A_nt d``
keeps the normal velocity at zero. d is right where the slip that is left, ``u_t = q_t + A_tn c_n +
A_tt c_t``, points along it: ``u_t x d = 0``, ``u_t d >= 0``. Times s this is a trigonometric
polynomial of the angle of d. A floor of the normal impulse takes the place of ``-q_n / s`` where
that is below it. Newton's method finds the direction in most cases; this is for those in which it
turns round and round. Source: Identifiability eqs 32-38, with the direction of slip free.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import kernel

ANGLES = 128
HALVINGS = 60


@kernel
def _across(A, q, friction, floor, at_floor, angle):
    """``s u_t x d`` for one direction; with the impulse at its floor ``u_t x d``."""
    d_1, d_2 = math.cos(angle), math.sin(angle)
    slope = A[0, 0] - friction * (A[0, 1] * d_1 + A[0, 2] * d_2)
    part, weight = (floor, 1.0) if at_floor else (-q[0], slope)
    u_1 = weight * q[1] + part * (A[1, 0] - friction * (A[1, 1] * d_1 + A[1, 2] * d_2))
    u_2 = weight * q[2] + part * (A[2, 0] - friction * (A[2, 1] * d_1 + A[2, 2] * d_2))
    return d_1 * u_2 - d_2 * u_1


@kernel
def _slides(A, q, friction, floor, at_floor, angle, c):
    """Impulse for one direction into ``c``; whether it is admissible and the slip that it leaves
    points along the direction.
    """
    d_1, d_2 = math.cos(angle), math.sin(angle)
    slope = A[0, 0] - friction * (A[0, 1] * d_1 + A[0, 2] * d_2)
    if not (at_floor or slope > 0.0):
        return False
    c[0] = floor if at_floor else -q[0] / slope
    c[1], c[2] = -friction * c[0] * d_1, -friction * c[0] * d_2
    u_1 = q[1] + A[1, 0] * c[0] + A[1, 1] * c[1] + A[1, 2] * c[2]
    u_2 = q[2] + A[2, 0] * c[0] + A[2, 1] * c[1] + A[2, 2] * c[2]
    pushes = q[0] + slope * c[0] >= 0.0 if at_floor else c[0] >= floor
    return pushes and d_1 * u_1 + d_2 * u_2 >= 0.0


@kernel
def _root_between(A, q, friction, floor, at_floor, low, high):
    """The angle between ``low`` and ``high`` where the slip left crosses the direction."""
    sign = _across(A, q, friction, floor, at_floor, low) > 0.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if (_across(A, q, friction, floor, at_floor, middle) > 0.0) == sign:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


@kernel
def slide_in_one_direction(A, q, friction, floor, c):
    """Impulse of the only contact into ``c`` (3), in [N s]; whether there is one that slides.

    ``A`` (3, 3) in [1/kg], ``q`` (3) in [m/s]; ``floor`` the least normal impulse in [N s].
    """
    step = 2.0 * math.pi / ANGLES
    for at_floor in (False, True):
        before = _across(A, q, friction, floor, at_floor, 0.0)
        for k in range(ANGLES):
            after = _across(A, q, friction, floor, at_floor, (k + 1) * step)
            if (before > 0.0) != (after > 0.0):
                angle = _root_between(A, q, friction, floor, at_floor, k * step, (k + 1) * step)
                if _slides(A, q, friction, floor, at_floor, angle, c):
                    return True
            before = after
    return False
