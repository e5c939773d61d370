"""Projected Gauss-Seidel: sweep over the contacts, each normal impulse cut off at its floor, each
friction impulse at the cone.

Source: Jourdan, Alart and Jean, Comput. Methods Appl. Mech. Eng. 155 (1998) 31.
"""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.rigid.cone import project_on_base
from contact_sim_pkg.rigid.problem import SPACE


@kernel
def _row_velocity(problem, c, row):
    total = problem.q[row]
    for j in range(c.shape[0]):
        total += problem.A[row, j] * c[j]
    return total


@kernel
def _tangential_bound(problem, row):
    """Bound of the tangential block of ``A`` from above, which makes the projected step a
    contraction.
    """
    if problem.width != SPACE:
        return problem.A[row + 1, row + 1]
    return max(problem.A[row + 1, row + 1], problem.A[row + 2, row + 2]) + abs(problem.A[row + 1, row + 2])


@kernel
def sweep(problem, c):
    """One sweep over all contacts, ``c`` [rows] in place; returns the greatest change of a
    velocity, A_ii dc.
    """
    change = 0.0
    for i in range(problem.friction.shape[0]):
        row = i * problem.width
        weight = problem.A[row, row]
        # normal impulse that brings its row to rest, cut off at the floor
        before = c[row]
        c[row] = max(problem.floor[i], before - _row_velocity(problem, c, row) / weight)
        change = max(change, weight * abs(c[row] - before))
        # friction: a projected step, with the impulses found so far
        bound = _tangential_bound(problem, row)
        t_1, t_2, s_2 = c[row + 1], 0.0, 0.0
        s_1 = _row_velocity(problem, c, row + 1)
        if problem.width == SPACE:
            t_2, s_2 = c[row + 2], _row_velocity(problem, c, row + 2)
        p_1, p_2 = project_on_base(t_1 - s_1 / bound, t_2 - s_2 / bound, problem.friction[i] * c[row], problem.facets)
        change = max(change, bound * abs(p_1 - t_1), bound * abs(p_2 - t_2))
        c[row + 1] = p_1
        if problem.width == SPACE:
            c[row + 2] = p_2
    return change


@kernel
def gauss_seidel(problem, c, sweeps, tolerance):
    """At most ``sweeps`` sweeps from the ``c`` that is given, until velocities change by less than
    ``tolerance`` [m/s].

    Returns the number of sweeps; `problem.residual` is the measure of the answer.
    """
    for count in range(sweeps):
        if sweep(problem, c) <= tolerance:
            return count + 1
    return sweeps
