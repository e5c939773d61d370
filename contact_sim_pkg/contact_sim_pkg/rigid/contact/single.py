"""One contact in space that stays on the ground: it sticks, or it slides on; closed form but for
the direction of slip.

The impulse that stops all slip is taken where it lies in the cone. Sliding, ``c_n`` follows from
the normal row for a given direction, and the direction is that of the slip which is left, found by
iteration; for a sphere it is the one before. Source: Identifiability eqs 12-18 and 32-38,
corrected.
"""

from __future__ import annotations

import math

import numpy

from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel
from contact_sim_pkg.rigid.problem import SPACE

TURNS = 20
SETTLED = 1.0e-15
STOPS = 1.0e-7  # of the greatest velocity: slip below it is left to the solvers


@borrowing_kernel
def _delassus(J, W, row, a, b):
    """Element (a, b) of ``J W J'`` of one contact of one body."""
    total = W[0, 0] if a == b else 0.0
    for k in range(3, 6):
        weighted = W[k, 3] * J[row + b, 3] + W[k, 4] * J[row + b, 4] + W[k, 5] * J[row + b, 5]
        total += J[row + a, k] * weighted
    return total


@borrowing_kernel
def _stop_all(delassus, velocity):
    """Impulse after which the contact point is at rest, by Cramer's rule.

    ``delassus``: elements nn, n1, n2, 11, 12, 22 of ``J W J'`` in [1/kg]; ``velocity``: its rows in
    [m/s].
    """
    (nn, n1, n2, t11, t12, t22), (q_n, q_1, q_2) = delassus, velocity
    i_nn, i_n1, i_n2 = t11 * t22 - t12 * t12, n2 * t12 - n1 * t22, n1 * t12 - n2 * t11
    part = -1.0 / (nn * i_nn + n1 * i_n1 + n2 * i_n2)
    i_11, i_12, i_22 = nn * t22 - n2 * n2, n1 * n2 - nn * t12, nn * t11 - n1 * n1
    return (
        part * (i_nn * q_n + i_n1 * q_1 + i_n2 * q_2),
        part * (i_n1 * q_n + i_11 * q_1 + i_12 * q_2),
        part * (i_n2 * q_n + i_12 * q_1 + i_22 * q_2),
    )


@kernel
def single_impulses(J, W, q, friction, i, c):
    """Impulse of contact ``i`` into its rows of ``c``; returns the residual, inf where it is left
    to the solvers.

    ``J`` [rows, 6], ``W`` [6, 6] of one body in space, ``q`` [rows] required by the rows,
    ``friction`` its ratio.
    """
    row = SPACE * i
    # A = J W J' of the contact
    nn, n1, n2 = _delassus(J, W, row, 0, 0), _delassus(J, W, row, 0, 1), _delassus(J, W, row, 0, 2)
    t11, t12, t22 = _delassus(J, W, row, 1, 1), _delassus(J, W, row, 1, 2), _delassus(J, W, row, 2, 2)
    q_n, q_1, q_2 = q[row], q[row + 1], q[row + 2]
    scale = max(abs(q_n), abs(q_1), abs(q_2))
    # stick, if the impulse that stops all slip is within the cone
    c_n, c_1, c_2 = _stop_all((nn, n1, n2, t11, t12, t22), (q_n, q_1, q_2))
    found = c_n >= 0.0 and c_1 * c_1 + c_2 * c_2 <= friction * friction * c_n * c_n
    u_1, u_2, turn, slides = q_1, q_2, 0, False
    d_1, d_2 = 0.0, 0.0
    # slip: fixed-point iteration on its direction
    while not found and turn < TURNS:
        slip = math.sqrt(u_1 * u_1 + u_2 * u_2)
        if not slip > STOPS * scale:
            return numpy.inf
        change = max(abs(u_1 / slip - d_1), abs(u_2 / slip - d_2))
        d_1, d_2 = u_1 / slip, u_2 / slip
        if turn > 0 and change <= SETTLED:
            found, slides = True, True
        else:
            # normal velocity by a unit of normal impulse that slides; 0 or less: Painleve
            slope = nn - friction * (n1 * d_1 + n2 * d_2)
            if not slope > 0.0:
                return numpy.inf
            c_n = -q_n / slope
            c_1, c_2 = -friction * c_n * d_1, -friction * c_n * d_2
            u_1, u_2 = q_1 + n1 * c_n + t11 * c_1 + t12 * c_2, q_2 + n2 * c_n + t12 * c_1 + t22 * c_2
        turn += 1
    if not (found and c_n >= 0.0):
        return numpy.inf
    c[row], c[row + 1], c[row + 2] = c_n, c_1, c_2
    # residual of the rows that must be 0
    scale = max(scale, nn * c_n)
    broken = abs(q_n + nn * c_n + n1 * c_1 + n2 * c_2)
    if not slides:
        broken += abs(q_1 + n1 * c_n + t11 * c_1 + t12 * c_2) + abs(q_2 + n2 * c_n + t12 * c_1 + t22 * c_2)
    return broken / scale if scale > 0.0 else 0.0
