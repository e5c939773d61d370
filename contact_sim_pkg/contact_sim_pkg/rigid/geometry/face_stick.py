"""A body on a flat face all of whose points stick: the impulses of least norm that stop it, each
within its friction cone.

Without bounds ``c_i = p + y x rho_i`` with ``sum c_i = F``, ``sum rho_i x c_i = X``, which is
closed form. Where that leaves a cone they are the projections ``c_i = P(p + y x rho_i)`` on the
cones, with six multipliers (p, y) again: the conditions of Karush, Kuhn and Tucker for the least
norm. Newton's method on the two sums, whose derivative is symmetric, with steps halved until the
dual function ``1/2 sum |c_i|^2 - F p - X y`` falls. Source: the least-norm choice is ours.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel
from contact_sim_pkg.rigid.geometry.face_points import ROW, A, B, cross

STEPS = 25
HALVINGS = 12
EXACT = 1.0e-15  # of the load: a wrench missed by no more is met
NEAR = 1.0e-13  # of the load: met as well where it gets no better
DESCENT = 1.0e-4  # part of the slope by which the dual function must fall
LIFT = 1.0e-14  # of the trace, on the diagonal, for contacts whose loads no wrench distinguishes
ORDER = 6


@borrowing_kernel
def stick_on_face(contact, F, T, c):
    """Impulses of least norm that stop the body; whether all lie in their cones.

    ``F``, ``T``: the wrench about the centre of mass that stops it. The last ``ORDER`` rows of
    ``face`` are work space.
    """
    mu, face, count, mean = contact.friction, contact.points, contact.contacts, contact.mean
    if F[1] * F[1] + F[2] * F[2] > mu * mu * F[0] * F[0]:
        return False  # more than friction on the whole can hold
    tt, ts, ss = contact.spread
    moved, share = cross(mean, F), 1.0 / count
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
    if holds or not (F[0] > 0.0 and mu > 0.0):
        return holds
    size = math.sqrt((tt + ss) * share)
    wrench = (F[0], F[1], F[2], x_n / size, x_t / size, x_s / size)
    return _within_cones(contact, size, wrench, (F_n, F_t, F_s, size * y_n, size * y_t, size * y_s), c)


@kernel
def _within_cones(contact, size, wrench, z, c):
    """Newton's method from the multipliers ``z`` (moments over ``size`` [m]); whether the wrench is
    met.
    """
    face, load = contact.points, wrench[0]
    dual, miss = _evaluate(contact, size, wrench, z, c)
    missed = _greatest(miss)
    for _ in range(STEPS):
        if missed <= EXACT * load:
            return True
        # Newton step on the wrench that is missed
        _fill_derivative(contact, size, z)
        step = _solved(face, miss)
        slope, length, fell = _dot(miss, step), 1.0, False
        before, tries = missed, 0
        start, first = z, dual
        # halved until the dual function falls, or the miss halves
        while not fell and tries < HALVINGS:
            z = _moved(start, length, step)
            dual, miss = _evaluate(contact, size, wrench, z, c)
            missed = _greatest(miss)
            fell = dual <= first + DESCENT * length * slope or missed < 0.5 * before
            length, tries = 0.5 * length, tries + 1
        # rounding: it gets no better
        if not fell or (missed <= NEAR * load and missed > 0.1 * before):
            break
    return missed <= NEAR * load


@borrowing_kernel
def _evaluate(contact, size, wrench, z, c):
    """Impulses ``c`` of the multipliers, the dual function, and by how much their wrench misses."""
    mu, face, count = contact.friction, contact.points, contact.contacts
    dual = -_dot(wrench, z)
    m_0, m_1, m_2, m_3, m_4, m_5 = -wrench[0], -wrench[1], -wrench[2], -wrench[3], -wrench[4], -wrench[5]
    for j in range(count):
        a, b, row = face[j, A] / size, face[j, B] / size, int(face[j, ROW])
        n, t, s = z[0] + z[4] * b - z[5] * a, z[1] - z[3] * b, z[2] + z[3] * a
        square = t * t + s * s
        if n < 0.0 or square > mu * mu * n * n:
            length = math.sqrt(square)
            n = max(0.0, (n + mu * length) / (1.0 + mu * mu))
            part = mu * n / length if length > 0.0 else 0.0
            t, s = part * t, part * s
        c[row], c[row + 1], c[row + 2] = n, t, s
        dual += 0.5 * (n * n + t * t + s * s)
        m_0, m_1, m_2 = m_0 + n, m_1 + t, m_2 + s
        m_3, m_4, m_5 = m_3 + a * s - b * t, m_4 + b * n, m_5 - a * n
    return dual, (m_0, m_1, m_2, m_3, m_4, m_5)


@borrowing_kernel
def _fill_derivative(contact, size, z):
    """Derivative of the wrench by the multipliers, lower half, into the last rows of ``face``."""
    mu, face, count = contact.friction, contact.points, contact.contacts
    top = face.shape[0] - ORDER
    for i in range(ORDER):
        for k in range(ORDER):
            face[top + i, k] = 0.0
    for j in range(count):
        a, b = face[j, A] / size, face[j, B] / size
        n, t, s = z[0] + z[4] * b - z[5] * a, z[1] - z[3] * b, z[2] + z[3] * a
        length = math.sqrt(t * t + s * s)
        if n >= 0.0 and length <= mu * n:
            _add_direction(face, top, 1.0, (1.0, 0.0, 0.0), (a, b))
            _add_direction(face, top, 1.0, (0.0, 1.0, 0.0), (a, b))
            _add_direction(face, top, 1.0, (0.0, 0.0, 1.0), (a, b))
        elif n + mu * length > 0.0:  # along the ray, and round the cone
            e_t, e_s, ray = t / length, s / length, 1.0 / (1.0 + mu * mu)
            _add_direction(face, top, ray, (1.0, mu * e_t, mu * e_s), (a, b))
            _add_direction(face, top, mu * ray * (n + mu * length) / length, (0.0, -e_s, e_t), (a, b))
    trace = 0.0
    for i in range(ORDER):
        trace += face[top + i, i]
    for i in range(ORDER):
        face[top + i, i] += LIFT * trace


@kernel
def _add_direction(face, top, weight, impulse, place):
    """Add ``weight g g'``, g the wrench of a unit impulse (n, t, s) at (a, b)."""
    (n, t, s), (a, b) = impulse, place
    g = (n, t, s, a * s - b * t, b * n, -a * n)
    for i in range(ORDER):
        for k in range(i + 1):
            face[top + i, k] += weight * g[i] * g[k]


@borrowing_kernel
def _solved(face, miss):
    """Newton's step, ``-derivative^-1 miss``, by Cholesky's factors in the last rows of
    ``face``.
    """
    top, right = face.shape[0] - ORDER, ORDER
    for i in range(ORDER):
        for k in range(i + 1):
            total = face[top + i, k]
            for m in range(k):
                total -= face[top + i, m] * face[top + k, m]
            face[top + i, k] = math.sqrt(max(total, 0.0)) if k == i else total / face[top + k, k]
        total = -miss[i]
        for m in range(i):
            total -= face[top + i, m] * face[top + m, right]
        face[top + i, right] = total / face[top + i, i]
    for i in range(ORDER - 1, -1, -1):
        total = face[top + i, right]
        for m in range(i + 1, ORDER):
            total -= face[top + m, i] * face[top + m, right]
        face[top + i, right] = total / face[top + i, i]
    return (
        face[top, right], face[top + 1, right], face[top + 2, right],
        face[top + 3, right], face[top + 4, right], face[top + 5, right],
    )  # fmt: skip


@borrowing_kernel
def _dot(x, y):
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2] + x[3] * y[3] + x[4] * y[4] + x[5] * y[5]


@borrowing_kernel
def _moved(z, length, step):
    return (
        z[0] + length * step[0], z[1] + length * step[1], z[2] + length * step[2],
        z[3] + length * step[3], z[4] + length * step[4], z[5] + length * step[5],
    )  # fmt: skip


@borrowing_kernel
def _greatest(x):
    return max(abs(x[0]), abs(x[1]), abs(x[2]), abs(x[3]), abs(x[4]), abs(x[5]))
