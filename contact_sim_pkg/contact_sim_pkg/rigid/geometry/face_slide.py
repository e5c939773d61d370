"""A body on a flat face all of whose points slide.

The body keeps to the plane and its load is linear over the face, ``N_i = a + b rho_t + g rho_s``,
which is the split of least norm where the points slide alike. The directions of slip are those
after the step: in closed form where the body does not turn (`rigid/motion/straight_slide.py`), else
by Broyden's method on the motion in the plane. Source: Goyal, Ruina and Papadopoulos 1991.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel
from contact_sim_pkg.rigid.geometry.face_points import D_S, D_T, R_S, R_T, ROW, A, B

TURNS = 15  # of the directions of slip
SETTLED = 1.0e-15  # change of a direction at which they are accepted
STOPS = 1.0e-7  # of the speed before: slip below it is left to the solvers
WIDE = 3


@borrowing_kernel
def _slip_sums(face, count, v_t, v_s, w_n):
    """Directions of slip into ``face``, their sums and moments, the greatest change and the least
    slip.
    """
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


@borrowing_kernel
def _motion_of_slide(contact, motion, F, w_n, d):
    """Slopes of the load over the face for given directions of slip, and the resulting motion in
    the plane.
    """
    mu, face, count, mean = contact.friction, contact.points, contact.contacts, contact.mean
    v, w, light, inertia = motion.velocity, motion.spin, motion.inverse_mass, motion.inertia
    tt, ts, ss = contact.spread
    a, r, gain = F / count, mean[0] * mu, w_n - w[0]
    # moments about the tangents that keep the body to the plane
    required_t = inertia[1] * gain - inertia[3] * w[1] - inertia[4] * w[2] - mean[2] * F - r * a * d[1]
    required_s = inertia[2] * gain - inertia[4] * w[1] - inertia[5] * w[2] + mean[1] * F + r * a * d[0]
    # two equations for the slopes of the load
    m_11, m_12, m_21, m_22 = ts + r * d[4], ss + r * d[5], -tt - r * d[2], -ts - r * d[3]
    part = 1.0 / (m_11 * m_22 - m_12 * m_21)
    b, g = (m_22 * required_t - m_12 * required_s) * part, (m_11 * required_s - m_21 * required_t) * part
    f_t, f_s = -mu * (a * d[0] + b * d[2] + g * d[3]), -mu * (a * d[1] + b * d[4] + g * d[5])
    # moment of friction about the normal
    turn = 0.0
    for j in range(count):
        load = a + b * face[j, A] + g * face[j, B]
        turn -= mu * load * (face[j, R_T] * face[j, D_S] - face[j, R_S] * face[j, D_T])
    w_n = w[0] + (turn + inertia[1] * w[1] + inertia[2] * w[2]) / inertia[0]
    return b, g, v[1] + f_t * light, v[2] + f_s * light, w_n


@borrowing_kernel
def _write_slide(contact, a, b, g, c):
    """Impulses of the sliding face; whether all press."""
    mu, face, count = contact.friction, contact.points, contact.contacts
    presses = True
    for j in range(count):
        load, row = a + b * face[j, A] + g * face[j, B], int(face[j, ROW])
        presses = presses and load >= 0.0
        c[row], c[row + 1], c[row + 2] = load, -mu * load * face[j, D_T], -mu * load * face[j, D_S]
    return presses


@borrowing_kernel
def _broyden(H, top, r, last, step):
    """Broyden's update of the inverse derivative, from row ``top`` of H on, from the change of the
    residual along ``step``.
    """
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


@borrowing_kernel
def _rows_times(H, top, x):
    return (
        H[top, 0] * x[0] + H[top, 1] * x[1] + H[top, 2] * x[2],
        H[top + 1, 0] * x[0] + H[top + 1, 1] * x[1] + H[top + 1, 2] * x[2],
        H[top + 2, 0] * x[0] + H[top + 2, 1] * x[1] + H[top + 2, 2] * x[2],
    )


@borrowing_kernel
def _slide_straight(contact, motion, F, c):
    """Impulses of a face that does not turn: one slip, along the velocity before, for all
    points.
    """
    mu, face, count, mean = contact.friction, contact.points, contact.contacts, contact.mean
    v, light = motion.velocity, motion.inverse_mass
    tt, ts, ss = contact.spread
    speed = math.sqrt(v[1] * v[1] + v[2] * v[2])
    if not speed - mu * F * light > STOPS * speed:
        return False
    d_t, d_s, rise, part = v[1] / speed, v[2] / speed, mu * mean[0], -F / (tt * ss - ts * ts)
    t, s = rise * d_t + mean[1], rise * d_s + mean[2]
    for j in range(count):
        face[j, D_T], face[j, D_S] = d_t, d_s
    return _write_slide(contact, F / count, part * (ss * t - ts * s), part * (tt * s - ts * t), c)


@borrowing_kernel
def slide_on_face(contact, motion, F, c):
    """Impulses ``c`` [rows] of a face that slides on; whether they were found and all press.

    ``F``: normal impulse in [N s] of the whole face.
    """
    w = motion.spin
    if w[0] == 0.0 and w[1] == 0.0 and w[2] == 0.0 and _slide_straight(contact, motion, F, c):
        return True
    return _slide_and_turn(contact, motion, F, c)


@kernel
def _slide_and_turn(contact, motion, F, c):
    """The motion in the plane by Broyden's method, and its impulses."""
    face, count, v, w = contact.points, contact.contacts, motion.velocity, motion.spin
    top, size = face.shape[0] - 3, math.sqrt(contact.spread[0] + contact.spread[2])
    speed = abs(v[1]) + abs(v[2]) + size * abs(w[0])
    v_t, v_s, w_n = v[1], v[2], w[0]
    last, step, b, g = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 0.0, 0.0
    for turn in range(TURNS):
        d, change, least = _slip_sums(face, count, v_t, v_s, w_n)
        if not least > (STOPS * speed) ** 2:
            return False
        if turn == 1 and change <= SETTLED:  # the directions of the motion that they leave
            return _write_slide(contact, F / count, b, g, c)
        b, g, to_t, to_s, to_n = _motion_of_slide(contact, motion, F, w_n, d)
        r = (to_t - v_t, to_s - v_s, size * (to_n - w_n))
        if turn > 1 and change <= SETTLED and abs(r[0]) + abs(r[1]) + abs(r[2]) <= SETTLED * speed:
            return _write_slide(contact, F / count, b, g, c)
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
