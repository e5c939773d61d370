"""The contact problem as a linear complementarity problem: normal impulses, friction along each
facet's direction, slip bound.

Per contact ``c_n, c_t (one a direction), lambda``: ``0 <= c_t _|_ lambda + D'u >= 0``, ``0 <=
lambda _|_ mu c_n - sum c_t >= 0``. A contact without friction has its normal row only. Contact i is
scaled by sqrt(A_nn,i), so that masses of any ratio meet rows of order 1. Source: Identifiability eq
9.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
import numpy.typing

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.rigid.contact.lemke import (
    LemkeWorkspace,
    complementarity_residual,
    lemke,
    make_lemke_workspace,
    solve_in_basis,
)
from contact_sim_pkg.rigid.problem import PLANE, SPACE
from contact_sim_pkg.rigid.results import RAY, SOLVED

NORMAL, TANGENT, BOUND = 0, 1, 2  # kinds of rows
GOOD = 1.0e-13  # residual of a solution, in rows of order 1
ROUNDING = 1.0e-11  # normal velocity of a scaled row that can count as none
PROXIMAL_SHIFT = 1.0e-3  # of the scaled rows, whose diagonal is 1
PROXIMAL_PASSES = 40
PROXIMAL_END = 1.0e-16  # change of velocity at which the passes end
WAYS = 6  # covering vectors that are tried
GOLDEN = 0.6180339887498949
PROXIMAL_LIMIT = 1.0e9  # impulse beyond which there is no solution


class ContactLemke(NamedTuple):
    """Work space of Lemke's method for contacts, and the direction of each of its rows."""

    lemke: LemkeWorkspace
    contact: numpy.typing.NDArray[numpy.int64]  # [size]
    kind: numpy.typing.NDArray[numpy.int64]  # [size]
    direction: Vector  # [size, 3], parts of normal and tangents
    turn: Vector  # [contacts], angle of the first direction
    center: Vector  # [size], of the proximal point iteration


def make_contact_lemke(contacts: int, width: int, facets: int) -> ContactLemke:
    """Work space for up to ``contacts`` contacts; in the plane ``facets`` is 2 whatever is
    given.
    """
    size = contacts * (2 + (2 if width == PLANE else facets))
    integers = numpy.zeros(size, numpy.int64)
    return ContactLemke(
        make_lemke_workspace(size), integers, integers.copy(), numpy.zeros((size, 3)), numpy.zeros(contacts),
        numpy.zeros(size),
    )  # fmt: skip


@kernel
def _lay_out(problem, work, facets):
    """Contact, kind and direction (normal, tangents) of each row; returns the number of rows."""
    contact, kind, direction = work.contact, work.kind, work.direction
    n, half = 0, facets // 2
    for i in range(problem.friction.shape[0]):
        count = facets + 2 if problem.friction[i] > 0.0 else 1
        for k in range(count):
            contact[n], kind[n] = i, NORMAL if k == 0 else (TANGENT if k <= facets else BOUND)
            angle = work.turn[i] + 2.0 * math.pi * ((k - 1) % half) / facets
            sign = (1.0 if k <= half else -1.0) if kind[n] == TANGENT else 0.0
            direction[n, 0] = 1.0 if k == 0 else 0.0
            direction[n, 1] = sign if problem.width == PLANE else sign * math.cos(angle)
            direction[n, 2] = 0.0 if problem.width == PLANE else sign * math.sin(angle)
            n += 1
    return n


@kernel
def _fill_velocities(problem, work, n, scale, M, q):
    """Rows of contact velocities: ``E A E'`` and ``E (q + A floor)``, E the directions, in scaled
    contacts.
    """
    A, direction, contact, width = problem.A, work.direction, work.contact, problem.width
    for i in range(n):
        row = contact[i] * width
        own, right = math.sqrt(A[row, row]), 0.0
        # right side: velocity of the row with the contacts at their floors
        for a in range(width):
            right += direction[i, a] * problem.q[row + a]
            for j in range(problem.floor.shape[0]):
                right += direction[i, a] * A[row + a, j * width] * problem.floor[j]
        q[i] = right / (own * scale)
        # matrix: velocity of row i by a unit impulse along the direction of row j
        for j in range(n):
            column = contact[j] * width
            total = 0.0
            for a in range(width):
                for b in range(width):
                    total += direction[i, a] * A[row + a, column + b] * direction[j, b]
            M[i, j] = total / (own * math.sqrt(A[column, column]))


@kernel
def _fill_bounds(problem, work, n, scale, M, q):
    """Rows and columns of the bounds ``mu c_n - sum c_t >= 0``, whose multiplier is the slip."""
    kind, contact = work.kind, work.contact
    for i in range(n):
        if kind[i] != BOUND:
            continue
        friction, row = problem.friction[contact[i]], contact[i] * problem.width
        q[i] = friction * problem.floor[contact[i]] * math.sqrt(problem.A[row, row]) / scale
        for j in range(n):
            if contact[j] == contact[i] and j != i:
                M[i, j] = friction if kind[j] == NORMAL else -1.0
                M[j, i] = 0.0 if kind[j] == NORMAL else 1.0


@kernel
def _scale(problem):
    """Greatest of the scaled right sides, so that Lemke sees numbers of order 1."""
    scale = 0.0
    for i in range(problem.friction.shape[0]):
        row = i * problem.width
        own = math.sqrt(problem.A[row, row])
        for k in range(problem.width):
            scale = max(scale, abs(problem.q[row + k]) / own)
        scale = max(scale, problem.floor[i] * own)
    return scale


@kernel
def _read(problem, work, n, scale, c):
    """Impulses of the contacts from the unknowns of Lemke's method."""
    for i in range(c.shape[0]):
        c[i] = 0.0
    z = work.lemke.z
    for i in range(n):
        row = work.contact[i] * problem.width
        impulse = z[i] * scale / math.sqrt(problem.A[row, row])
        if work.kind[i] == NORMAL:
            c[row] = problem.floor[work.contact[i]] + impulse
        elif work.kind[i] == TANGENT:
            c[row + 1] += work.direction[i, 1] * impulse
            if problem.width == SPACE:
                c[row + 2] += work.direction[i, 2] * impulse


@kernel
def _shift(work, n, shift):
    kind, M = work.kind, work.lemke.M
    for i in range(n):
        if kind[i] != BOUND:
            M[i, i] += shift


@kernel
def _move_center(work, n, shift):
    """Center of the next pass: the last answer; returns the change of velocity, and the greatest
    impulse.
    """
    kind, center, q, z = work.kind, work.center, work.lemke.q, work.lemke.z
    change, greatest = 0.0, 0.0
    for i in range(n):
        if kind[i] != BOUND:
            step = z[i] - center[i]
            change, greatest = max(change, shift * abs(step)), max(greatest, abs(z[i]))
            q[i] -= shift * step
            center[i] = z[i]
    return change, greatest


@kernel
def _close(work, n, shift):
    """Take the shift out of ``M`` and ``q`` again."""
    _shift(work, n, -shift)
    kind, center, q = work.kind, work.center, work.lemke.q
    for i in range(n):
        if kind[i] != BOUND:
            q[i] += shift * center[i]


@kernel
def _solve(work, n):
    """Lemke's method; where many redundant contacts leave it only pivots that are rounding,
    proximal point iteration.

    Each pass solves a problem that is not degenerate, ``M + s I`` on the contact rows, about the
    last answer, and so ends on an answer of the problem itself. Without end (impulses grow): RAY.
    """
    shift, holds, status = 0.0, False, SOLVED
    for i in range(n):
        work.center[i] = 0.0
    for attempt in range(PROXIMAL_PASSES):
        # the pivots are repeated only where the last basis no longer holds the answer
        if not holds:
            status = lemke(work.lemke, n)
        # the first try is the problem itself; then the proximal term makes each pass regular
        if attempt == 0:
            if status == SOLVED and complementarity_residual(work.lemke, n) <= GOOD:
                return SOLVED
            shift = PROXIMAL_SHIFT
            _shift(work, n, shift)
            continue
        if status != SOLVED:
            break
        # ended: the velocity no longer changes, or the impulses grow without end
        change, greatest = _move_center(work, n, shift)
        if change <= PROXIMAL_END or greatest > PROXIMAL_LIMIT:
            break
        holds = solve_in_basis(work.lemke, n)
    _close(work, n, shift)
    return SOLVED if status == SOLVED and complementarity_residual(work.lemke, n) <= GOOD else RAY


@kernel
def _cover(work, n, attempt):
    """Covering vector of an attempt: ones, then other ways to the solution, between 1 and 2 by the
    golden ratio.
    """
    for i in range(n):
        part = GOLDEN * (i + 1) * attempt
        work.lemke.cover[i] = 1.0 + part - math.floor(part)


@kernel
def _solve_by_ways(work, n):
    """`_solve`, by another way where rounding ends one on a ray."""
    status = RAY
    for attempt in range(WAYS):
        _cover(work, n, attempt)
        status = _solve(work, n)
        if status == SOLVED:
            break
    return status


@kernel
def _zero_rounding_normals(work, n):
    """Set normal velocities that are rounding to 0; whether there are any."""
    q, found = work.lemke.q, False
    for i in range(n):
        if work.kind[i] == NORMAL and q[i] != 0.0 and abs(q[i]) <= ROUNDING:
            q[i], found = 0.0, True
    return found


@kernel
def solve_by_lemke(problem, work, facets, c):
    """Impulses ``c`` [rows] of the problem with ``facets`` friction directions a contact (plane:
    2); returns a status.

    A contact in a Painleve state answers an approach of any size, rounding as well, with a jam:
    where the pivots cannot distinguish it from 0, it is 0.
    """
    scale = _scale(problem)
    # nothing moves and no impulse is required
    if scale == 0.0:
        for i in range(c.shape[0]):
            c[i] = 0.0
        return SOLVED
    # rows of normals, friction directions and bounds, scaled to order 1
    n = _lay_out(problem, work, facets)
    _fill_velocities(problem, work, n, scale, work.lemke.M, work.lemke.q)
    _fill_bounds(problem, work, n, scale, work.lemke.M, work.lemke.q)
    # an approach that is rounding may lead onto a ray: once more without it
    status = _solve_by_ways(work, n)
    if status == RAY and _zero_rounding_normals(work, n):
        status = _solve_by_ways(work, n)
    if status == SOLVED:
        _read(problem, work, n, scale, c)
    return status
