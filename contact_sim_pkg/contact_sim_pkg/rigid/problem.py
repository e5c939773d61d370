"""The contact problem in impulses and contact velocities, and how well an answer meets it.

For contacts i with impulse ``c_i = (c_n, c_t)`` and velocity ``u = q + A c`` (rows: normal, then
one tangent in the plane, two in space): ``0 <= c_n - floor  _|_  u_n >= 0`` and Coulomb's law,
``c_t`` in the disc (or polygon) of radius ``mu c_n`` and of greatest dissipation against ``u_t``.
Source: Identifiability eqs 5-9, corrected.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.rigid.cone import project_on_base

PLANE, SPACE = 2, 3  # rows of a contact
# friction of a contact that takes no part: its rows of A are 1 on the diagonal and 0 beside it
INACTIVE = -1.0
DISC = 0  # number of facets that stands for the true cone


class ContactProblem(NamedTuple):
    """One problem. Its ``q`` holds the requirement of the normal rows: free velocity, bounce, gap
    over step.
    """

    A: Vector  # [rows, rows] in [1/kg], J W J'
    q: Vector  # [rows] in [m/s]
    friction: Vector  # [contacts]
    # [contacts], least normal impulse in [N s]; 0 but for the second phase of an impact
    floor: Vector
    width: int  # rows of a contact: PLANE or SPACE
    facets: int  # of the friction cone in space, even; DISC: the second-order cone


def make_problem(contacts: int, width: int, facets: int = DISC) -> ContactProblem:
    """A problem of ``contacts`` contacts with zeros, to be filled in."""
    rows = contacts * width
    zeros = numpy.zeros
    return ContactProblem(zeros((rows, rows)), zeros(rows), zeros(contacts), zeros(contacts), width, facets)


@kernel
def fill_delassus(J, W, A):
    """``A = J W J'``: ``J`` [rows, coordinates], ``W`` [coordinates, coordinates] the inverse
    inertia.
    """
    rows, coordinates = J.shape
    for i in range(rows):
        for k in range(coordinates):
            weighted = 0.0
            for m in range(coordinates):
                weighted += J[i, m] * W[m, k]
            for j in range(i + 1):
                A[j, i] = weighted * J[j, k] if k == 0 else A[j, i] + weighted * J[j, k]
    for i in range(rows):
        for j in range(i):
            A[i, j] = A[j, i]


@kernel
def multiply_add(A, c, q, u):
    """``u = q + A c``."""
    for i in range(q.shape[0]):
        total = q[i]
        for j in range(q.shape[0]):
            total += A[i, j] * c[j]
        u[i] = total


@kernel
def velocity_scale(problem, c):
    """Greatest velocity of the problem in [m/s]: of ``q`` and of ``A_ii c_n,i``."""
    scale = 0.0
    for i in range(problem.q.shape[0]):
        scale = max(scale, abs(problem.q[i]))
        if i % problem.width == 0:
            scale = max(scale, problem.A[i, i] * c[i])
    return scale


@kernel
def residual(problem, c, u):
    """Greatest break of Signorini's and Coulomb's conditions over the velocity scale; ``u`` is
    overwritten with q + A c.
    """
    multiply_add(problem.A, c, problem.q, u)
    scale = velocity_scale(problem, c)
    if scale == 0.0:
        return 0.0
    worst = 0.0
    for i in range(problem.friction.shape[0]):
        row = i * problem.width
        weight = problem.A[row, row]
        signorini = abs(min(weight * (c[row] - problem.floor[i]), u[row]))
        t_1, t_2 = c[row + 1], c[row + 2] if problem.width == SPACE else 0.0
        s_1, s_2 = u[row + 1], u[row + 2] if problem.width == SPACE else 0.0
        p_1, p_2 = project_on_base(t_1 - s_1 / weight, t_2 - s_2 / weight, problem.friction[i] * c[row], problem.facets)
        coulomb = weight * numpy.hypot(t_1 - p_1, t_2 - p_2)
        broken = max(signorini, coulomb) / scale
        if not broken <= worst:  # also true for NaN
            worst = broken
    return worst
