"""How redundant contacts share their load: the split of least norm, which depends on nothing but
the wrench and the modes.

Least ``sum c_n^2 + |c_t|^2`` over all impulses with the same wrench ``J'c``, each in its own cone:
nothing where the contact separates, the ray against the slip where it slides, the friction cone
where it sticks. It is the projection ``c = P(J y)`` on these cones, with one multiplier y per
coordinate of the bodies: Newton's method on ``J' P(J y) = wrench``, whose dual is convex with one
derivative. Source: the least-norm choice is ours.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
import numpy.typing

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.rigid.cone import project_on_cone, project_on_ray
from contact_sim_pkg.rigid.contact.linear import solve_consistent
from contact_sim_pkg.rigid.problem import DISC, PLANE, SPACE

ITERATIONS = 60
HALVINGS = 30
# of the velocity scale: below it a contact touches, below it a contact point sticks
ZERO_VELOCITY = 1.0e-9
WRENCH_TOLERANCE = 1.0e-15
ACCEPTED = 1.0e-12  # a split that misses the wrench by more is not used


class SplitWorkspace(NamedTuple):
    """Arrays of the split."""

    y: Vector  # [coordinates]
    trial: Vector  # [coordinates]
    wrench: Vector  # [coordinates]
    miss: Vector  # [coordinates]
    right: Vector  # [coordinates]
    step: Vector  # [coordinates]
    scale: Vector  # [coordinates], sqrt of the inverse inertia: makes forces and moments alike
    hessian: Vector  # [coordinates, coordinates]
    order: numpy.typing.NDArray[numpy.int64]  # [coordinates]
    c: Vector  # [rows]


def make_split_workspace(rows: int, coordinates: int) -> SplitWorkspace:
    """Work space for ``rows`` contact rows on bodies with ``coordinates`` coordinates."""
    zeros, n = numpy.zeros, coordinates
    return SplitWorkspace(
        y=zeros(n),
        trial=zeros(n),
        wrench=zeros(n),
        miss=zeros(n),
        right=zeros(n),
        step=zeros(n),
        scale=zeros(n),
        hessian=zeros((n, n)),
        order=zeros(n, numpy.int64),
        c=zeros(rows),
    )


@kernel
def _project(problem, u, limit, i, a, facets):
    """Projection of the three numbers ``a`` (normal, two tangents) on the cone of contact ``i``
    with velocity ``u``.
    """
    row = i * problem.width
    if u[row] > limit:
        return 0.0, 0.0, 0.0
    friction = problem.friction[i]
    s_1, s_2 = u[row + 1], u[row + 2] if problem.width == SPACE else 0.0
    slip = math.hypot(s_1, s_2)
    if friction <= 0.0:
        return max(0.0, a[0]), 0.0, 0.0
    if slip <= limit:
        return project_on_cone(a[0], a[1], a[2], friction, facets)
    s_1, s_2 = -s_1 / slip, -s_2 / slip
    if facets != DISC:  # the vertex nearest to the direction against the slip
        step = 2.0 * math.pi / facets
        angle = step * math.floor(math.atan2(s_2, s_1) / step + 0.5)
        s_1, s_2 = math.cos(angle), math.sin(angle)
    normal = project_on_ray(a[0], s_1 * a[1] + s_2 * a[2], friction)
    return normal, friction * normal * s_1, friction * normal * s_2


@kernel
def _impulses(problem, J, work, u, limit, y, facets):
    """``work.c = P(J y)`` and ``work.miss = J'c - wrench``; returns the dual function."""
    coordinates = y.shape[0]
    dual = 0.0
    # dual: -wrench y + 1/2 |P(J y)|^2
    for k in range(coordinates):
        work.miss[k] = -work.wrench[k]
        dual -= work.wrench[k] * y[k]
    for i in range(problem.friction.shape[0]):
        row = i * problem.width
        # impulses of one contact, without its cone
        a = (
            _pull(J, work, y, row),
            _pull(J, work, y, row + 1),
            _pull(J, work, y, row + 2) if problem.width == SPACE else 0.0,
        )
        p = _project(problem, u, limit, i, a, facets)
        # each in its cone; what its wrench adds to the miss
        for b in range(problem.width):
            work.c[row + b] = p[b]
            dual += 0.5 * p[b] * p[b]
            for k in range(coordinates):
                work.miss[k] += J[row + b, k] * work.scale[k] * p[b]
    return dual


@kernel
def _pull(J, work, y, row):
    total = 0.0
    for k in range(y.shape[0]):
        total += J[row, k] * work.scale[k] * y[k]
    return total


@kernel
def _fill_hessian(problem, J, work, u, limit, y, facets):
    """``J' dP J`` by central differences of the projections along their own coordinates, which are
    linear in pieces.
    """
    n = y.shape[0]
    for k in range(n):
        for m in range(n):
            work.hessian[k, m] = 0.0
    for i in range(problem.friction.shape[0]):
        row = i * problem.width
        a = (
            _pull(J, work, y, row),
            _pull(J, work, y, row + 1),
            _pull(J, work, y, row + 2) if problem.width == SPACE else 0.0,
        )
        # step of the difference, in the impulse of the contact
        size = 1.0e-6 * (abs(a[0]) + abs(a[1]) + abs(a[2])) + 1.0e-300
        for b in range(problem.width):
            # along one coordinate of the impulse at a time
            shift = (size if b == 0 else 0.0, size if b == 1 else 0.0, size if b == 2 else 0.0)
            more = _project(problem, u, limit, i, (a[0] + shift[0], a[1] + shift[1], a[2] + shift[2]), facets)
            less = _project(problem, u, limit, i, (a[0] - shift[0], a[1] - shift[1], a[2] - shift[2]), facets)
            for d in range(problem.width):
                slope = 0.5 * (more[d] - less[d]) / size
                if slope != 0.0:
                    for k in range(n):
                        for m in range(n):
                            work.hessian[k, m] += J[row + d, k] * work.scale[k] * slope * J[row + b, m] * work.scale[m]


@kernel
def _greatest(vector):
    greatest = 0.0
    for k in range(vector.shape[0]):
        greatest = max(greatest, abs(vector[k]))
    return greatest


@kernel
def _first_multiplier(J, work):
    """Least squares on all rows, as if no cone had a bound: ``(J'J) y = wrench``."""
    n = work.y.shape[0]
    for k in range(n):
        work.right[k] = work.wrench[k]
        for m in range(n):
            total = 0.0
            for row in range(J.shape[0]):
                total += J[row, k] * work.scale[k] * J[row, m] * work.scale[m]
            work.hessian[k, m] = total
    solve_consistent(work.hessian, work.right, work.y, work.order, n)


@kernel
def _descend(problem, J, work, u, limit, dual, facets):
    """One Newton step on the dual, halved until it falls; returns the new value and whether it
    fell.
    """
    n = work.y.shape[0]
    slope = 0.0
    _fill_hessian(problem, J, work, u, limit, work.y, facets)
    # Newton step; a little on the diagonal for wrenches that no contact can give
    trace = 0.0
    for k in range(n):
        trace += work.hessian[k, k]
        work.right[k] = -work.miss[k]
    for k in range(n):
        work.hessian[k, k] += 1.0e-14 * trace
    for k in range(n):
        work.trial[k] = work.miss[k]
    solve_consistent(work.hessian, work.right, work.step, work.order, n)
    for k in range(n):
        slope += work.trial[k] * work.step[k]
    # line search: the dual falls by part of its slope, or the miss halves
    length, before = 1.0, _greatest(work.trial)
    for _ in range(HALVINGS):
        for k in range(n):
            work.trial[k] = work.y[k] + length * work.step[k]
        value = _impulses(problem, J, work, u, limit, work.trial, facets)
        if value <= dual + 1.0e-4 * length * slope or _greatest(work.miss) < 0.5 * before:
            for k in range(n):
                work.y[k] = work.trial[k]
            return value, True
        length *= 0.5
    _impulses(problem, J, work, u, limit, work.y, facets)
    return dual, False


@kernel
def split_load(problem, J, W, u, scale, facets, c, work):
    """Replace ``c`` [rows] by the split of least norm with the same wrench; False where it was not
    found and c is kept.

    ``J`` [rows, coordinates], ``W`` the inverse inertia, ``u`` = q + A c [rows] the velocities that
    stay as they are, ``scale`` their greatest. In the plane ``facets`` is not read.
    """
    n = work.y.shape[0]
    facets = DISC if problem.width == PLANE else facets
    for k in range(n):
        work.scale[k] = math.sqrt(W[k, k])
        work.wrench[k] = 0.0
        for row in range(c.shape[0]):
            work.wrench[k] += J[row, k] * work.scale[k] * c[row]
    size = _greatest(work.wrench)
    if size == 0.0:
        return True
    limit = ZERO_VELOCITY * scale
    _first_multiplier(J, work)
    dual = _impulses(problem, J, work, u, limit, work.y, facets)
    missed = _greatest(work.miss)
    for _ in range(ITERATIONS):
        if missed <= WRENCH_TOLERANCE * size:
            break
        dual, fell = _descend(problem, J, work, u, limit, dual, facets)
        before, missed = missed, _greatest(work.miss)
        if not fell or (missed <= ACCEPTED * size and missed > 0.1 * before):  # rounding
            break
    if not _greatest(work.miss) <= ACCEPTED * size:
        return False
    for row in range(c.shape[0]):
        c[row] = work.c[row]
    return True
