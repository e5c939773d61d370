"""The contacts of a body that lie on one plane: arms in the axes of the plane, their mean, and
small tensors in these axes.

Axes (normal, tangents) of the contacts, which all have the same; arms r about the centre of mass,
rho about their mean.

Source: Identifiability eqs 10, 11, 41 and 42.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.rigid.problem import INACTIVE, SPACE

FLAT = 1.0e-9  # of the greatest arm: points this much out of the plane are no face
NARROW = 1.0e-9  # of the size of the face, to the power 3: points this near to a line are no face
# columns of a face: arm, arm about the mean, row, direction of slip
R_N, R_T, R_S, A, B, ROW, D_T, D_S, FACE = 0, 1, 2, 3, 4, 5, 6, 7, 8


class FaceContact(NamedTuple):
    """Contacts of a body on one plane, in the axes of the plane."""

    friction: float  # Coulomb's ratio mu
    points: Vector  # [contacts + work rows, FACE]
    contacts: int  # number of them
    mean: tuple[float, float, float]  # [m] mean arm
    # [m^2] sums of products of the arms about their mean: tt, ts, ss
    spread: tuple[float, float, float]


class FaceMotion(NamedTuple):
    """Motion and inertia of the body before the impulses, in the axes of the plane."""

    velocity: tuple[float, float, float]  # [m/s] of the centre of mass
    spin: tuple[float, float, float]  # [rad/s]
    inverse_mass: float  # [1/kg]
    # [1/(kg m^2)] nn, nt, ns, tt, ts, ss
    inverse_inertia: tuple[float, float, float, float, float, float]
    inertia: tuple[float, float, float, float, float, float]  # [kg m^2]


@borrowing_kernel
def _arm_of(J, row):
    """Arm of a contact in its own axes (normal, tangent, tangent) from its rows of the Jacobian."""
    r_n, r_t, r_s = 0.0, 0.0, 0.0
    for k in range(3):
        r_s += J[row, 3 + k] * J[row + 1, k]
        r_t -= J[row, 3 + k] * J[row + 2, k]
        r_n += J[row + 1, 3 + k] * J[row + 2, k]
    return r_n, r_t, r_s


@borrowing_kernel
def read_face(J, friction, face):
    """Arms and rows of the active contacts, one a row of ``face``; their number, 0 where axes or
    friction differ.
    """
    # a literal 0 would compile what takes the count once more, for that number
    first, count = -1, numpy.int64(0)
    for i in range(friction.shape[0]):
        if friction[i] == INACTIVE:
            continue
        row = SPACE * i
        if first < 0:
            first = row
        same = friction[i] == friction[first // SPACE]
        for a in range(2):
            for k in range(3):
                same = same and J[row + a, k] == J[first + a, k]
        if not same:
            return 0
        face[count, R_N], face[count, R_T], face[count, R_S] = _arm_of(J, row)
        face[count, ROW] = row
        count += 1
    return count


@borrowing_kernel
def in_axes(J, row, x, y, z):
    """A vector in the axes of a contact."""
    return (
        J[row, 0] * x + J[row, 1] * y + J[row, 2] * z,
        J[row + 1, 0] * x + J[row + 1, 1] * y + J[row + 1, 2] * z,
        J[row + 2, 0] * x + J[row + 2, 1] * y + J[row + 2, 2] * z,
    )


@borrowing_kernel
def tensor_in_axes(J, row, W):
    """Inverse inertia in the axes of a contact: nn, nt, ns, tt, ts, ss."""
    a = (J[row, 0], J[row, 1], J[row, 2])
    b = (J[row + 1, 0], J[row + 1, 1], J[row + 1, 2])
    c = (J[row + 2, 0], J[row + 2, 1], J[row + 2, 2])
    p = _image(W, a[0], a[1], a[2])
    q = _image(W, b[0], b[1], b[2])
    r = _image(W, c[0], c[1], c[2])
    return (
        a[0] * p[0] + a[1] * p[1] + a[2] * p[2],
        a[0] * q[0] + a[1] * q[1] + a[2] * q[2],
        a[0] * r[0] + a[1] * r[1] + a[2] * r[2],
        b[0] * q[0] + b[1] * q[1] + b[2] * q[2],
        b[0] * r[0] + b[1] * r[1] + b[2] * r[2],
        c[0] * r[0] + c[1] * r[1] + c[2] * r[2],
    )


@borrowing_kernel
def _image(W, x, y, z):
    return (
        W[3, 3] * x + W[3, 4] * y + W[3, 5] * z,
        W[3, 4] * x + W[4, 4] * y + W[4, 5] * z,
        W[3, 5] * x + W[4, 5] * y + W[5, 5] * z,
    )


@borrowing_kernel
def inverse(m):
    """Inverse of a symmetric 3 by 3 tensor (aa, ab, ac, bb, bc, cc)."""
    aa, ab, ac, bb, bc, cc = m
    i_aa, i_ab, i_ac = bb * cc - bc * bc, ac * bc - ab * cc, ab * bc - ac * bb
    determinant = aa * i_aa + ab * i_ab + ac * i_ac
    d = 1.0 / determinant
    return i_aa * d, i_ab * d, i_ac * d, (aa * cc - ac * ac) * d, (ab * ac - aa * bc) * d, (aa * bb - ab * ab) * d


@borrowing_kernel
def times(m, x):
    """Symmetric tensor times vector."""
    return (
        m[0] * x[0] + m[1] * x[1] + m[2] * x[2],
        m[1] * x[0] + m[3] * x[1] + m[4] * x[2],
        m[2] * x[0] + m[4] * x[1] + m[5] * x[2],
    )


@borrowing_kernel
def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@borrowing_kernel
def centre(face, count):
    """Arms about their mean into ``face``; the mean arm, sums of their products (tt, ts, ss), and
    whether the points are a face.
    """
    n, t, s = 0.0, 0.0, 0.0
    for j in range(count):
        n, t, s = n + face[j, R_N], t + face[j, R_T], s + face[j, R_S]
    n, t, s = n / count, t / count, s / count
    tt, ts, ss, flat = 0.0, 0.0, 0.0, 0.0
    for j in range(count):
        x, y = face[j, R_T] - t, face[j, R_S] - s
        face[j, A], face[j, B] = x, y
        tt, ts, ss = tt + x * x, ts + x * y, ss + y * y
        flat = max(flat, abs(face[j, R_N] - n))
    size = tt + ss
    is_face = tt * ss - ts * ts > NARROW * size * size and flat * flat <= FLAT * FLAT * size
    return (n, t, s), (tt, ts, ss), is_face
