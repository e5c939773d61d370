"""Two contacts of one body in the plane: Lemke's method at its fixed order 8, and the least-norm
split in closed form.

Unknowns ``c_n, c_t+, c_t-, lambda`` of each contact. The dictionary ``basic = q + T nonbasic``
holds the columns that are not in the basis alone (8 by 10 with z0), so a pivot is 80 products. Ties
are not broken here: they, and residuals above rounding, are left to `rigid/contact/lemke.py`, for
which `numpy.inf` is returned. Impulses with the same wrench differ by one vector, the squeeze of
the two points: the split of least norm is a projection along it, cut off at the cones. Source:
Cottle, Pang, Stone, The Linear Complementarity Problem, 4.4.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
import numpy.typing

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel

ORDER, ARTIFICIAL, RIGHT, COLUMNS = 8, 8, 9, 10
PIVOTS = 60
SMALL = 1.0e-10  # pivots below it are rounding; the tableau has entries of order 1
TIE = 1.0e-12
# column of z0: positive, uneven against ties
COVER = (1.0, 1.13, 1.29, 0.83, 1.07, 1.21, 1.37, 0.91)
UNCOVER = tuple(1.0 / part for part in COVER)
STICKS = 1.0e-9  # of the velocity scale: slip below it is none


class PairWorkspace(NamedTuple):
    """Arrays of the method."""

    A: Vector  # [4, 4]
    tableau: Vector  # [ORDER, COLUMNS]
    basic: numpy.typing.NDArray[numpy.int64]  # [ORDER], w_i: i, z_i: ORDER + i, z0: 2 ORDER
    other: numpy.typing.NDArray[numpy.int64]  # [ORDER + 1]
    c: Vector  # [4]
    q: Vector  # [4]


def make_pair_workspace() -> PairWorkspace:
    """Work space of one solve."""
    zeros = numpy.zeros
    return PairWorkspace(
        zeros((4, 4)),
        zeros((ORDER, COLUMNS)),
        zeros(ORDER, numpy.int64),
        zeros(ORDER + 1, numpy.int64),
        zeros(4),
        zeros(4),
    )


@borrowing_kernel
def _assemble(J, W, q, first, second, work):
    """``A = J W J'`` of the rows of the two contacts, and their ``q``."""
    rows = (2 * first, 2 * first + 1, 2 * second, 2 * second + 1)
    A = work.A
    for i in range(4):
        row = rows[i]
        work.q[i] = q[row]
        x, y, z = J[row, 0], J[row, 1], J[row, 2]
        a = W[0, 0] * x + W[0, 1] * y + W[0, 2] * z
        b = W[0, 1] * x + W[1, 1] * y + W[1, 2] * z
        d = W[0, 2] * x + W[1, 2] * y + W[2, 2] * z
        for k in range(4):
            A[i, k] = a * J[rows[k], 0] + b * J[rows[k], 1] + d * J[rows[k], 2]


@borrowing_kernel
def _set_up(A, q, mu_first, mu_second, speed, work):
    """The dictionary of the start, in units of the first normal inverse mass and of ``speed``;
    returns the unit of impulse.
    """
    T, unit = work.tableau, 1.0 / A[0, 0]
    part = 1.0 / speed
    for i in range(ORDER):
        work.basic[i], work.other[i] = i, ORDER + i
        for j in range(COLUMNS):
            T[i, j] = 0.0
        T[i, ARTIFICIAL] = COVER[i]
    work.other[ARTIFICIAL] = 2 * ORDER
    # blocks of A: normal, friction along either direction
    for a in range(2):
        for b in range(2):
            nn, nt = unit * A[2 * a, 2 * b], unit * A[2 * a, 2 * b + 1]
            tn, tt = unit * A[2 * a + 1, 2 * b], unit * A[2 * a + 1, 2 * b + 1]
            i, j = 4 * a, 4 * b
            T[i, j], T[i, j + 1], T[i, j + 2] = nn, nt, -nt
            T[i + 1, j], T[i + 1, j + 1], T[i + 1, j + 2] = tn, tt, -tt
            T[i + 2, j], T[i + 2, j + 1], T[i + 2, j + 2] = -tn, -tt, tt
        # friction bound of the contact, and the right sides
        i = 4 * a
        T[i + 1, i + 3], T[i + 2, i + 3] = 1.0, 1.0
        T[i + 3, i], T[i + 3, i + 1], T[i + 3, i + 2] = mu_first if a == 0 else mu_second, -1.0, -1.0
        T[i, RIGHT], T[i + 1, RIGHT], T[i + 2, RIGHT] = part * q[2 * a], part * q[2 * a + 1], -part * q[2 * a + 1]
    return speed * unit


@borrowing_kernel
def _exchange(T, row, column):
    """Exchange the basic variable of ``row`` and the other one of ``column``."""
    inverse = 1.0 / T[row, column]
    for j in range(COLUMNS):
        T[row, j] *= -inverse
    T[row, column] = inverse
    for i in range(ORDER):
        if i != row:
            factor = T[i, column]
            T[i, column] = 0.0
            for j in range(COLUMNS):
                T[i, j] += factor * T[row, j]


@borrowing_kernel
def _leaving(T, column, row_of_z0):
    """Row of the basic variable that meets 0 first as the other one of ``column`` grows, z0 in a
    tie; -1: none or another tie.
    """
    best, least, tied = -1, numpy.inf, False
    for i in range(ORDER):
        if T[i, column] < -SMALL:
            ratio = -T[i, RIGHT] / T[i, column]
            if ratio < least:
                tied = least - ratio <= TIE
                best, least = i, ratio
            elif ratio - least <= TIE:
                tied = True
    slope = T[row_of_z0, column]
    if tied and slope < -SMALL and -T[row_of_z0, RIGHT] / slope - least <= TIE:
        return row_of_z0
    return -1 if tied else best


@borrowing_kernel
def _pivot_to_the_end(work):
    """Lemke's path; whether z0 left the basis."""
    T, basic, other = work.tableau, work.basic, work.other
    # z0 enters at the row that needs most of it
    low, row = numpy.inf, 0
    for i in range(ORDER):
        deepest = T[i, RIGHT] * UNCOVER[i]
        if deepest < low:
            low, row = deepest, i
    if low >= 0.0:
        return True
    column, row_of_z0 = ARTIFICIAL, row
    for _ in range(PIVOTS):
        _exchange(T, row, column)
        leaving = basic[row]
        basic[row], other[column] = other[column], leaving
        if leaving == 2 * ORDER:
            return True
        # the complement of what left enters next
        wanted = leaving + ORDER if leaving < ORDER else leaving - ORDER
        for j in range(ORDER + 1):
            if other[j] == wanted:
                column = j
        row = _leaving(T, column, row_of_z0)
        if row < 0:
            return False
    return False


@borrowing_kernel
def _read(work, impulse):
    c, T = work.c, work.tableau
    for i in range(4):
        c[i] = 0.0
    for i in range(ORDER):
        z = work.basic[i] - ORDER
        if 0 <= z < ORDER:
            kind, a, value = z % 4, 2 * (z // 4), impulse * max(0.0, T[i, RIGHT])
            if kind == 0:
                c[a] = value
            elif kind == 1:
                c[a + 1] += value
            elif kind == 2:
                c[a + 1] -= value


@borrowing_kernel
def _range(n, t, z_n, z_t, mu, low, high):
    """Part of ``low..high`` in which ``(n, t) + x (z_n, z_t)`` lies in the friction cone."""
    for side in (-1.0, 1.0):
        slack, change = mu * n + side * t, mu * z_n + side * z_t
        if change > 0.0:
            low = max(low, -slack / change)
        elif change < 0.0:
            high = min(high, -slack / change)
    return min(low, 0.0), max(high, 0.0)


@borrowing_kernel
def _share(J, first, second, mu_first, mu_second, c):
    """Split of least norm where both contacts stick: along the vector of impulses without a wrench,
    as far as the cones allow.
    """
    rows = (2 * first, 2 * first + 1, 2 * second, 2 * second + 1)
    x = (J[rows[0], 0], J[rows[1], 0], J[rows[2], 0], J[rows[3], 0])
    y = (J[rows[0], 1], J[rows[1], 1], J[rows[2], 1], J[rows[3], 1])
    m = (J[rows[0], 2], J[rows[1], 2], J[rows[2], 2], J[rows[3], 2])
    # the vector without a wrench: minors of the 3 by 4 matrix J' of both contacts
    p_01, p_02, p_03 = y[0] * m[1] - y[1] * m[0], y[0] * m[2] - y[2] * m[0], y[0] * m[3] - y[3] * m[0]
    p_12, p_13, p_23 = y[1] * m[2] - y[2] * m[1], y[1] * m[3] - y[3] * m[1], y[2] * m[3] - y[3] * m[2]
    z_0 = x[1] * p_23 - x[2] * p_13 + x[3] * p_12
    z_1 = -(x[0] * p_23 - x[2] * p_03 + x[3] * p_02)
    z_2 = x[0] * p_13 - x[1] * p_03 + x[3] * p_01
    z_3 = -(x[0] * p_12 - x[1] * p_02 + x[2] * p_01)
    square = z_0 * z_0 + z_1 * z_1 + z_2 * z_2 + z_3 * z_3
    if square <= 0.0:
        return
    # how far both contacts stay in their cones
    low, high = _range(c[0], c[1], z_0, z_1, mu_first, -numpy.inf, numpy.inf)
    low, high = _range(c[2], c[3], z_2, z_3, mu_second, low, high)
    # least norm along it
    length = -(z_0 * c[0] + z_1 * c[1] + z_2 * c[2] + z_3 * c[3]) / square
    length = min(max(length, low), high)
    c[0], c[1], c[2], c[3] = c[0] + length * z_0, c[1] + length * z_1, c[2] + length * z_2, c[3] + length * z_3


@borrowing_kernel
def _velocity(A, q, c, i):
    return q[i] + A[i, 0] * c[0] + A[i, 1] * c[1] + A[i, 2] * c[2] + A[i, 3] * c[3]


@borrowing_kernel
def _broken(A, q, mu, c, i):
    """Break of the conditions of the contact whose normal row is ``i``, in [m/s]."""
    u_n, u_t, weight = _velocity(A, q, c, i), _velocity(A, q, c, i + 1), A[i, i]
    x, radius = weight * c[i + 1] - u_t, mu * max(0.0, weight * c[i])
    return max(abs(min(weight * c[i], u_n)), abs(weight * c[i + 1] - min(max(x, -radius), radius)))


@kernel
def pair_impulses(J, W, q, friction, first, second, work, c):
    """Impulses ``c`` [rows] of the contacts ``first`` and ``second`` of one body in the plane, of
    least norm; returns the residual.

    ``J`` [rows, 3], ``W`` [3, 3], ``q`` [rows] required by the rows, ``friction`` [contacts] above
    0. inf: no answer here.
    """
    _assemble(J, W, q, first, second, work)
    A, own, mu_first, mu_second = work.A, work.q, friction[first], friction[second]
    # frictionless contacts and no velocity are left to the general solver
    speed = max(abs(own[0]), abs(own[1]), abs(own[2]), abs(own[3]))
    if not 0.0 < speed < numpy.inf or mu_first <= 0.0 or mu_second <= 0.0:
        return numpy.inf
    impulse = _set_up(A, own, mu_first, mu_second, speed, work)
    if not _pivot_to_the_end(work):
        return numpy.inf
    _read(work, impulse)
    x = work.c
    limit = STICKS * speed
    # both press and stick: the load can be shared in more than one way
    if x[0] > 0.0 and x[2] > 0.0 and abs(_velocity(A, own, x, 1)) <= limit and abs(_velocity(A, own, x, 3)) <= limit:
        _share(J, first, second, mu_first, mu_second, x)
    c[2 * first], c[2 * first + 1], c[2 * second], c[2 * second + 1] = x[0], x[1], x[2], x[3]
    # residual in the velocities, of the greatest
    scale = max(speed, A[0, 0] * x[0], A[2, 2] * x[2])
    return max(_broken(A, own, mu_first, x, 0), _broken(A, own, mu_second, x, 2)) / scale
