"""A body on a flat face, all of whose points stick or all of whose points slide: the impulses of
least norm without pivoting.

`rigid/geometry/face_stick.py` shares the wrench that stops the body among the points, within their
friction cones; `rigid/geometry/face_slide.py`: all slide. Either answer is taken only if it meets
Signorini's and Coulomb's conditions; ``numpy.inf`` sends the caller to a solver that pivots.
Source: Identifiability eqs 5-9, corrected, with the split of least norm.
"""

from __future__ import annotations

import math

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel
from contact_sim_pkg.rigid.geometry.face_points import (
    FACE,
    R_N,
    R_S,
    R_T,
    ROW,
    FaceContact,
    FaceMotion,
    centre,
    cross,
    in_axes,
    inverse,
    read_face,
    tensor_in_axes,
    times,
)
from contact_sim_pkg.rigid.geometry.face_slide import slide_on_face
from contact_sim_pkg.rigid.geometry.face_stick import ORDER, stick_on_face
from contact_sim_pkg.rigid.problem import SPACE


def make_face_workspace(contacts: int) -> Vector:
    """Work space [contacts + 6, 8] for a body of ``contacts`` contacts."""
    return numpy.zeros((contacts + ORDER, FACE))


@borrowing_kernel
def _worst_break(contact, motion, c):
    """Residual of `problem.residual`, from the wrench of the impulses."""
    mu, face, count = contact.friction, contact.points, contact.contacts
    v, w, light, lever = motion.velocity, motion.spin, motion.inverse_mass, motion.inverse_inertia
    f, m = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    for j in range(count):
        row = int(face[j, ROW])
        p = (c[row], c[row + 1], c[row + 2])
        q = cross((face[j, R_N], face[j, R_T], face[j, R_S]), p)
        f, m = (f[0] + p[0], f[1] + p[1], f[2] + p[2]), (m[0] + q[0], m[1] + q[1], m[2] + q[2])
    g = times(lever, m)
    v_after = (v[0] + f[0] * light, v[1] + f[1] * light, v[2] + f[2] * light)
    w_after = (w[0] + g[0], w[1] + g[1], w[2] + g[2])
    scale, worst = 0.0, 0.0
    for j in range(count):
        r, row = (face[j, R_N], face[j, R_T], face[j, R_S]), int(face[j, ROW])
        turned, before = cross(w_after, r), cross(w, r)
        u_n, u_t, u_s = v_after[0] + turned[0], v_after[1] + turned[1], v_after[2] + turned[2]
        weight = light + lever[3] * r[2] * r[2] - 2.0 * lever[4] * r[1] * r[2] + lever[5] * r[1] * r[1]
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
    """Impulses ``c`` [rows] of one body on a flat face, of least norm; returns the residual, inf
    where none is found.

    ``J`` [rows, 6] and ``W`` [6, 6] of one body in space, ``velocity`` [6] without the contacts,
    ``friction`` [contacts], INACTIVE for those that take no part; three or more must, in one plane.
    ``face``: `make_face_workspace`. Rows of ``c`` that take no part are left alone.
    """
    count = read_face(J, friction, face)
    if count < 3:
        return numpy.inf
    # arms about their mean; points near to a line have no face
    mean, spread, is_face = centre(face, count)
    if not is_face:
        return numpy.inf
    first = int(face[0, ROW])
    mu, light = friction[first // SPACE], W[0, 0]
    # everything in the axes of the plane: normal, tangents
    v = in_axes(J, first, velocity[0], velocity[1], velocity[2])
    w = in_axes(J, first, velocity[3], velocity[4], velocity[5])
    lever = tensor_in_axes(J, first, W)
    inertia = inverse(lever)
    stop, mass = times(inertia, w), 1.0 / light
    # wrench that stops the body; shared within the cones, or all points slide
    F, T = (-mass * v[0], -mass * v[1], -mass * v[2]), (-stop[0], -stop[1], -stop[2])
    contact, motion = FaceContact(mu, face, count, mean, spread), FaceMotion(v, w, light, lever, inertia)
    found = stick_on_face(contact, F, T, c)
    if not found and mu > 0.0:
        found = slide_on_face(contact, motion, F[0], c)
    if not found:
        return numpy.inf
    return _worst_break(contact, motion, c)
