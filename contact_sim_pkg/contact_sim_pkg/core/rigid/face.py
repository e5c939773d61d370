"""A body on a flat face, all of whose points stick or all of whose points slide: closed form instead of pivoting.

Axes (normal, tangents) of the one plane, arms r about the centre of mass, rho about their mean. Sticking: the impulses of least
norm with the wrench ``(F, T)`` that stops the body are ``f_i = F/k + y x rho_i``, ``sum (|rho|^2 - rho rho') y = T - rbar x F``:
three unknowns. Sliding: the body keeps to the plane and its load is linear over the face, ``N_i = a + b rho_t + g rho_s``, which
is the split of least norm where the points slide alike; the directions of slip are those after the step, found by iteration.
Either answer is taken only if it meets Signorini's and Coulomb's conditions; ``numpy.inf`` sends the caller to a solver that
pivots. Source: SEEDS 7.2 (M4.6, load split); sliding on a face: Goyal, Ruina and Papadopoulos 1991.
"""

from __future__ import annotations

import math

import numpy

from ..jit import kernel, piece
from .problem import INACTIVE, SPACE

FLAT = 1.0e-9  # of the greatest arm: points this much out of the plane are no face
NARROW = 1.0e-9  # of the size of the face, to the power 3: points this near to a line are no face
TURNS = 15  # of the directions of slip
SETTLED = 1.0e-15  # change of a direction at which they are taken
STOPS = 1.0e-7  # of the speed before: slip below it is left to the solvers
R_N, R_T, R_S, A, B, ROW, D_T, D_S, FACE = (
    0,
    1,
    2,
    3,
    4,
    5,
    6,
    7,
    8,
)  # columns of a face: arm, arm about the mean, row, direction of slip
WIDE = 3


@piece
def _arm_of(J, row):
    """Arm of a contact in its own axes (normal, tangent, tangent) from its rows of the Jacobian."""
    r_n, r_t, r_s = 0.0, 0.0, 0.0
    for k in range(3):
        r_s += J[row, 3 + k] * J[row + 1, k]
        r_t -= J[row, 3 + k] * J[row + 2, k]
        r_n += J[row + 1, 3 + k] * J[row + 2, k]
    return r_n, r_t, r_s


@piece
def _read_face(J, friction, face):
    """Arms and rows of the active contacts, one a row of ``face``; their number, 0 where axes or friction differ."""
    first, count = -1, 0
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


@piece
def _turned(J, row, x, y, z):
    """A vector in the axes of a contact."""
    return (
        J[row, 0] * x + J[row, 1] * y + J[row, 2] * z,
        J[row + 1, 0] * x + J[row + 1, 1] * y + J[row + 1, 2] * z,
        J[row + 2, 0] * x + J[row + 2, 1] * y + J[row + 2, 2] * z,
    )


@piece
def _turned_tensor(J, row, W):
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


@piece
def _image(W, x, y, z):
    return (
        W[3, 3] * x + W[3, 4] * y + W[3, 5] * z,
        W[3, 4] * x + W[4, 4] * y + W[4, 5] * z,
        W[3, 5] * x + W[4, 5] * y + W[5, 5] * z,
    )


@piece
def _inverse(m):
    """Inverse of a symmetric 3 by 3 tensor (aa, ab, ac, bb, bc, cc)."""
    aa, ab, ac, bb, bc, cc = m
    i_aa, i_ab, i_ac = bb * cc - bc * bc, ac * bc - ab * cc, ab * bc - ac * bb
    determinant = aa * i_aa + ab * i_ab + ac * i_ac
    d = 1.0 / determinant
    return i_aa * d, i_ab * d, i_ac * d, (aa * cc - ac * ac) * d, (ab * ac - aa * bc) * d, (aa * bb - ab * ab) * d


@piece
def _times(m, x):
    """Symmetric tensor times vector."""
    return (
        m[0] * x[0] + m[1] * x[1] + m[2] * x[2],
        m[1] * x[0] + m[3] * x[1] + m[4] * x[2],
        m[2] * x[0] + m[4] * x[1] + m[5] * x[2],
    )


@piece
def _cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@piece
def _centre(face, count):
    """Arms about their mean into ``face``; the mean arm, sums of their products (tt, ts, ss), and whether the points are a face."""
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


@piece
def _stick(mu, face, count, mean, spread, F, T, c):
    """Impulses of least norm that stop the body; whether all lie in their cones."""
    tt, ts, ss = spread
    moved, share = _cross(mean, F), 1.0 / count
    x_n, x_t, x_s = T[0] - moved[0], T[1] - moved[1], T[2] - moved[2]
    part, whole = 1.0 / (tt * ss - ts * ts), 1.0 / (tt + ss)
    y_n, y_t, y_s = x_n * whole, (tt * x_t + ts * x_s) * part, (ts * x_t + ss * x_s) * part
    F_n, F_t, F_s = share * F[0], share * F[1], share * F[2]
    holds = True
    for j in range(count):
        a, b, row = face[j, A], face[j, B], int(face[j, ROW])
        f_n, f_t, f_s = F_n + y_t * b - y_s * a, F_t - y_n * b, F_s + y_n * a
        holds = holds and f_n >= 0.0 and f_t * f_t + f_s * f_s <= mu * mu * f_n * f_n
        c[row], c[row + 1], c[row + 2] = f_n, f_t, f_s
    return holds


@piece
def _slip_sums(face, count, v_t, v_s, w_n):
    """Directions of slip into ``face``, their sums and moments, the greatest change and the least slip."""
    d_t, d_s, tt, st, ts, ss, change, least = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, math.inf
    for j in range(count):
        u_t, u_s = v_t - w_n * face[j, R_S], v_s + w_n * face[j, R_T]
        square = u_t * u_t + u_s * u_s
        least = min(least, square)
        part = 1.0 / math.sqrt(square)
        e_t, e_s, a, b = u_t * part, u_s * part, face[j, A], face[j, B]
        change = max(change, abs(e_t - face[j, D_T]), abs(e_s - face[j, D_S]))
        face[j, D_T], face[j, D_S] = e_t, e_s
        d_t, d_s = d_t + e_t, d_s + e_s
        tt, st, ts, ss = tt + a * e_t, st + b * e_t, ts + a * e_s, ss + b * e_s
    return (d_t, d_s, tt, st, ts, ss), change, least


@piece
def _slid(mu, face, count, mean, spread, F, v, w, w_n, light, inertia, d):
    """Slopes of the load over the face for given directions of slip, and the motion in the plane that they leave."""
    tt, ts, ss = spread
    a, r, gain = F / count, mean[0] * mu, w_n - w[0]
    ask_t = inertia[1] * gain - inertia[3] * w[1] - inertia[4] * w[2] - mean[2] * F - r * a * d[1]
    ask_s = inertia[2] * gain - inertia[4] * w[1] - inertia[5] * w[2] + mean[1] * F + r * a * d[0]
    m_11, m_12, m_21, m_22 = ts + r * d[4], ss + r * d[5], -tt - r * d[2], -ts - r * d[3]
    part = 1.0 / (m_11 * m_22 - m_12 * m_21)
    b, g = (m_22 * ask_t - m_12 * ask_s) * part, (m_11 * ask_s - m_21 * ask_t) * part
    f_t, f_s = -mu * (a * d[0] + b * d[2] + g * d[3]), -mu * (a * d[1] + b * d[4] + g * d[5])
    turn = 0.0
    for j in range(count):
        load = a + b * face[j, A] + g * face[j, B]
        turn -= mu * load * (face[j, R_T] * face[j, D_S] - face[j, R_S] * face[j, D_T])
    w_n = w[0] + (turn + inertia[1] * w[1] + inertia[2] * w[2]) / inertia[0]
    return b, g, v[1] + f_t * light, v[2] + f_s * light, w_n


@piece
def _write_slide(mu, face, count, a, b, g, c):
    """Impulses of the sliding face; whether all press."""
    presses = True
    for j in range(count):
        load, row = a + b * face[j, A] + g * face[j, B], int(face[j, ROW])
        presses = presses and load >= 0.0
        c[row], c[row + 1], c[row + 2] = load, -mu * load * face[j, D_T], -mu * load * face[j, D_S]
    return presses


@piece
def _broyden(H, top, r, last, step):
    """Broyden's update of the inverse derivative, from row ``top`` of H on, from the change of the residual along ``step``."""
    y = (r[0] - last[0], r[1] - last[1], r[2] - last[2])
    image = _rows_times(H, top, y)
    along = step[0] * image[0] + step[1] * image[1] + step[2] * image[2]
    if along == 0.0:
        return
    for k in range(3):
        left = (step[0] * H[top, k] + step[1] * H[top + 1, k] + step[2] * H[top + 2, k]) / along
        for i in range(3):
            H[top + i, WIDE + k] = (step[i] - image[i]) * left
    for i in range(3):
        for k in range(3):
            H[top + i, k] += H[top + i, WIDE + k]


@piece
def _rows_times(H, top, x):
    return (
        H[top, 0] * x[0] + H[top, 1] * x[1] + H[top, 2] * x[2],
        H[top + 1, 0] * x[0] + H[top + 1, 1] * x[1] + H[top + 1, 2] * x[2],
        H[top + 2, 0] * x[0] + H[top + 2, 1] * x[1] + H[top + 2, 2] * x[2],
    )


@piece
def _slide(mu, face, count, mean, spread, F, v, w, light, inertia, c):
    """Impulses of a face that slides on; whether they were found and all press. The motion in the plane by Broyden's method."""
    top, size = face.shape[0] - 3, math.sqrt(spread[0] + spread[2])
    speed = abs(v[1]) + abs(v[2]) + size * abs(w[0])
    v_t, v_s, w_n = v[1], v[2], w[0]
    last, step, b, g = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 0.0, 0.0
    for turn in range(TURNS):
        d, change, least = _slip_sums(face, count, v_t, v_s, w_n)
        if not least > (STOPS * speed) ** 2:
            return False
        if turn == 1 and change <= SETTLED:  # the directions of the motion that they leave
            return _write_slide(mu, face, count, F / count, b, g, c)
        b, g, to_t, to_s, to_n = _slid(mu, face, count, mean, spread, F, v, w, w_n, light, inertia, d)
        r = (to_t - v_t, to_s - v_s, size * (to_n - w_n))
        if turn > 1 and change <= SETTLED and abs(r[0]) + abs(r[1]) + abs(r[2]) <= SETTLED * speed:
            return _write_slide(mu, face, count, F / count, b, g, c)
        if turn == 0:
            step = r
            for i in range(3):
                for k in range(3):
                    face[top + i, k] = -1.0 if i == k else 0.0
        else:
            _broyden(face, top, r, last, step)
            image = _rows_times(face, top, r)
            step = (-image[0], -image[1], -image[2])
        v_t, v_s, w_n, last = v_t + step[0], v_s + step[1], w_n + step[2] / size, r
    return False


@piece
def _worst_break(mu, face, count, v, w, light, inverse, c):
    """Residual of `problem.residual`, from the wrench of the impulses."""
    f, m = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    for j in range(count):
        row = int(face[j, ROW])
        p = (c[row], c[row + 1], c[row + 2])
        q = _cross((face[j, R_N], face[j, R_T], face[j, R_S]), p)
        f, m = (f[0] + p[0], f[1] + p[1], f[2] + p[2]), (m[0] + q[0], m[1] + q[1], m[2] + q[2])
    g = _times(inverse, m)
    v_after = (v[0] + f[0] * light, v[1] + f[1] * light, v[2] + f[2] * light)
    w_after = (w[0] + g[0], w[1] + g[1], w[2] + g[2])
    scale, worst = 0.0, 0.0
    for j in range(count):
        r, row = (face[j, R_N], face[j, R_T], face[j, R_S]), int(face[j, ROW])
        turned, before = _cross(w_after, r), _cross(w, r)
        u_n, u_t, u_s = v_after[0] + turned[0], v_after[1] + turned[1], v_after[2] + turned[2]
        weight = light + inverse[3] * r[2] * r[2] - 2.0 * inverse[4] * r[1] * r[2] + inverse[5] * r[1] * r[1]
        pressed = weight * c[row]
        scale = max(scale, abs(v[0] + before[0]), abs(v[1] + before[1]), abs(v[2] + before[2]), pressed)
        t, s = weight * c[row + 1], weight * c[row + 2]
        x, y, radius = t - u_t, s - u_s, mu * max(0.0, pressed)
        square, part = x * x + y * y, 1.0
        if square > radius * radius:
            part = radius / math.sqrt(square)
        broken = max(abs(min(pressed, u_n)), abs(t - part * x) + abs(s - part * y))
        if not broken <= worst:  # also true for NaN
            worst = broken
    return worst / scale if scale > 0.0 else 0.0


@kernel
def face_impulses(J, W, velocity, friction, face, c):
    """Impulses ``c`` [rows] of one body on a flat face, of least norm; returns the residual, inf where none is found.

    ``J`` [rows, 6] and ``W`` [6, 6] of one body in space, ``velocity`` [6] without the contacts, ``friction`` [contacts], INACTIVE
    for those that take no part; three or more must, in one plane. ``face`` [contacts + 3, FACE] is work space.
    Rows of ``c`` that take no part are left alone.
    """
    count = _read_face(J, friction, face)
    if count < 3:
        return numpy.inf
    mean, spread, is_face = _centre(face, count)
    if not is_face:
        return numpy.inf
    first = int(face[0, ROW])
    mu, light = friction[first // SPACE], W[0, 0]
    v = _turned(J, first, velocity[0], velocity[1], velocity[2])
    w = _turned(J, first, velocity[3], velocity[4], velocity[5])
    inverse = _turned_tensor(J, first, W)
    inertia = _inverse(inverse)
    stop, mass = _times(inertia, w), 1.0 / light
    F, T = (-mass * v[0], -mass * v[1], -mass * v[2]), (-stop[0], -stop[1], -stop[2])
    found = _stick(mu, face, count, mean, spread, F, T, c)
    if not found and mu > 0.0:
        found = _slide(mu, face, count, mean, spread, F[0], v, w, light, inertia, c)
    if not found:
        return numpy.inf
    return _worst_break(mu, face, count, v, w, light, inverse, c)
