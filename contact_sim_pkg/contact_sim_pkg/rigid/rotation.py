"""Rotation of a rigid body: exponential map, and the gyroscopic step that keeps energy and angular
momentum.

Torque-free or driven rotation in body axes by the implicit midpoint rule, ``I0 (w+ - w) + h wm x I0
wm = h tau``, ``wm = (w + w+)/2``: free motion keeps ``w' I0 w`` and ``|I0 w|`` to rounding at any
step; nine such steps of lengths that add up to one make a step of order 6. Source: Kahan and Li
1997 (order 6, nine stages).
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import kernel

NEWTON_STEPS = 8
_OUTER = (
    0.39216144400731413927925056,
    0.33259913678935943859974864,
    -0.70624617255763935980996482,
    0.08221359629355080023149045,
)
STAGES = (*_OUTER, 1.0 - 2.0 * sum(_OUTER), *_OUTER[::-1])  # of a step of order 6, in parts of it


@kernel
def rotate_by(R, w_1, w_2, w_3, h):
    """``R <- R exp(h w x)``, w [3] the spin in body axes in [rad/s] (Rodrigues); ``R`` [3, 3] maps
    body to world.
    """
    angle = abs(h) * math.sqrt(w_1 * w_1 + w_2 * w_2 + w_3 * w_3)
    half = math.sin(0.5 * angle)
    a = h * (math.sin(angle) / angle if angle > 1.0e-8 else 1.0)
    b = 0.5 * h * h * ((2.0 * half / angle) ** 2 if angle > 1.0e-8 else 1.0)
    k = ((0.0, -w_3, w_2), (w_3, 0.0, -w_1), (-w_2, w_1, 0.0))
    for i in range(3):
        row = (R[i, 0], R[i, 1], R[i, 2])
        first = (
            row[0] * k[0][0] + row[1] * k[1][0] + row[2] * k[2][0],
            row[0] * k[0][1] + row[1] * k[1][1] + row[2] * k[2][1],
            row[0] * k[0][2] + row[1] * k[1][2] + row[2] * k[2][2],
        )
        for j in range(3):
            second = first[0] * k[0][j] + first[1] * k[1][j] + first[2] * k[2][j]
            R[i, j] = row[j] + a * first[j] + b * second


@kernel
def _solve_3(m, r):
    """Solve a 3 by 3 system by Cramer's rule."""
    (a, b, c), (d, e, f), (g, p, q) = m
    determinant = a * (e * q - f * p) - b * (d * q - f * g) + c * (d * p - e * g)
    x = (r[0] * (e * q - f * p) - b * (r[1] * q - f * r[2]) + c * (r[1] * p - e * r[2])) / determinant
    y = (a * (r[1] * q - f * r[2]) - r[0] * (d * q - f * g) + c * (d * r[2] - r[1] * g)) / determinant
    z = (a * (e * r[2] - r[1] * p) - b * (d * r[2] - r[1] * g) + r[0] * (d * p - e * g)) / determinant
    return x, y, z


@kernel
def gyroscopic_step(inertia_1, inertia_2, inertia_3, w_1, w_2, w_3, h):
    """Spin in body axes after ``h`` [s] of free rotation, by implicit midpoint; principal inertias
    in [kg m^2].
    """
    x, y, z = w_1, w_2, w_3
    p_1, p_2, p_3 = inertia_3 - inertia_2, inertia_1 - inertia_3, inertia_2 - inertia_1
    for _ in range(NEWTON_STEPS):
        m_1, m_2, m_3 = 0.5 * (w_1 + x), 0.5 * (w_2 + y), 0.5 * (w_3 + z)
        # Newton's method on the midpoint rule
        right = (
            -(inertia_1 * (x - w_1) + h * p_1 * m_2 * m_3),
            -(inertia_2 * (y - w_2) + h * p_2 * m_3 * m_1),
            -(inertia_3 * (z - w_3) + h * p_3 * m_1 * m_2),
        )
        matrix = (
            (inertia_1, 0.5 * h * p_1 * m_3, 0.5 * h * p_1 * m_2),
            (0.5 * h * p_2 * m_3, inertia_2, 0.5 * h * p_2 * m_1),
            (0.5 * h * p_3 * m_2, 0.5 * h * p_3 * m_1, inertia_3),
        )
        d_1, d_2, d_3 = _solve_3(matrix, right)
        x, y, z = x + d_1, y + d_2, z + d_3
        if abs(d_1) + abs(d_2) + abs(d_3) <= 4.0e-16 * (abs(x) + abs(y) + abs(z)):
            break
    return x, y, z


@kernel
def spin_in_body(R, w):
    """Spin ``R' w`` in body axes of a velocity [6] = (v, omega) in world axes."""
    return (
        R[0, 0] * w[3] + R[1, 0] * w[4] + R[2, 0] * w[5],
        R[0, 1] * w[3] + R[1, 1] * w[4] + R[2, 1] * w[5],
        R[0, 2] * w[3] + R[1, 2] * w[4] + R[2, 2] * w[5],
    )


@kernel
def gyroscopic_rate(inertia, w_1, w_2, w_3):
    """Rate of the spin of a free body in body axes in [rad/s^2], ``I0 dw/dt = -w x I0 w``;
    ``inertia`` [3] in [kg m^2].
    """
    return (
        (inertia[1] - inertia[2]) * w_2 * w_3 / inertia[0],
        (inertia[2] - inertia[0]) * w_3 * w_1 / inertia[1],
        (inertia[0] - inertia[1]) * w_1 * w_2 / inertia[2],
    )


@kernel
def orthonormalize(R):
    """Take rounding out of a rotation matrix: one step to rows of unit length and at right
    angles.
    """
    for i in range(3):
        a, b, c = R[i, 0], R[i, 1], R[i, 2]
        length = a * a + b * b + c * c
        half = 0.5 * (3.0 - length)
        R[i, 0], R[i, 1], R[i, 2] = half * a, half * b, half * c
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        mixed = R[j, 0] * R[k, 0] + R[j, 1] * R[k, 1] + R[j, 2] * R[k, 2]
        for m in range(3):
            first = R[j, m]
            R[j, m] -= 0.5 * mixed * R[k, m]
            R[k, m] -= 0.5 * mixed * first


@kernel
def _kick(R, inertia, load, h, w_1, w_2, w_3):
    """Spin after the torque of ``load`` [6], world axes, has acted for ``h`` [s] on a body that
    does not turn.
    """
    return (
        w_1 + h * (R[0, 0] * load[3] + R[1, 0] * load[4] + R[2, 0] * load[5]) / inertia[0],
        w_2 + h * (R[0, 1] * load[3] + R[1, 1] * load[4] + R[2, 1] * load[5]) / inertia[1],
        w_3 + h * (R[0, 2] * load[3] + R[1, 2] * load[4] + R[2, 2] * load[5]) / inertia[2],
    )


@kernel
def free_rotation(R, inertia, load, w_1, w_2, w_3, time):
    """Turn ``R`` in place by ``time`` [s] of free motion, order 6; returns the spin in body axes at
    its end.

    ``inertia`` [3] principal in [kg m^2], ``load`` [6] with the torque in world axes in its last
    three, in [N m].
    """
    for part in STAGES:
        h = part * time
        x, y, z = _kick(R, inertia, load, 0.5 * h, w_1, w_2, w_3)
        a, b, c = gyroscopic_step(inertia[0], inertia[1], inertia[2], x, y, z, h)
        rotate_by(R, 0.5 * (x + a), 0.5 * (y + b), 0.5 * (z + c), h)
        w_1, w_2, w_3 = _kick(R, inertia, load, 0.5 * h, a, b, c)
    return w_1, w_2, w_3
