"""Rotation of a rigid body: exponential map, and the gyroscopic step that keeps energy and angular momentum.

Torque-free or driven rotation in body axes by the implicit midpoint rule, ``I0 (w+ - w) + h wm x I0 wm = h tau``,
``wm = (w + w+)/2``: free motion keeps ``w' I0 w`` and ``|I0 w|`` to rounding at any step. Source: SEEDS 7.2 (gyroscopic term).
"""

from __future__ import annotations

import math

from ..jit import kernel

NEWTON_STEPS = 8


@kernel
def rotate_by(R, w_1, w_2, w_3, h):
    """``R <- R exp(h w x)``, w [3] the spin in body axes in [rad/s] (Rodrigues); ``R`` [3, 3] maps body to world."""
    angle = h * math.sqrt(w_1 * w_1 + w_2 * w_2 + w_3 * w_3)
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
    """Spin in body axes after ``h`` [s] of free rotation, by implicit midpoint; principal inertias in [kg m^2]."""
    x, y, z = w_1, w_2, w_3
    p_1, p_2, p_3 = inertia_3 - inertia_2, inertia_1 - inertia_3, inertia_2 - inertia_1
    for _ in range(NEWTON_STEPS):
        m_1, m_2, m_3 = 0.5 * (w_1 + x), 0.5 * (w_2 + y), 0.5 * (w_3 + z)
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
