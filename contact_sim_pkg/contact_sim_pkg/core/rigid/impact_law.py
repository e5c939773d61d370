"""Impact of any number of contacts at once by the rules of Newton, Poisson and the energetic one.

Energetic, several contacts: compression without bounce, then each contact gives back ``s e_i`` of its compression impulse, with
the greatest s in [0, 1] for which the normal works give back at most ``e_i^2`` of what they took and no kinetic energy is gained.
Source: SEEDS 7.3. Planar and one contact: `planar_impact.py`; one contact in space: `impact_path.py`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from ..jit import entry, kernel
from ..parameters import Vector
from ..vectors import copy_row
from .contact_solver import Solution, Solver, make_solver, solve_and_split
from .impact_path import FIRST, IMPULSE, SECOND, PathWorkspace, energetic_path, make_path_workspace
from .parameters import ENERGETIC, NEWTON, ImpactPath, PlanarContact
from .planar_impact import impact_impulse
from .problem import DISC, PLANE, SPACE, ContactProblem, multiply_add
from .results import SOLVED, UNIQUE

BISECTIONS = 40
SLACK = 1.0e-12


class ImpactWorkspace(NamedTuple):
    """The solver of an impact and its arrays."""

    solver: Solver
    path: PathWorkspace
    compression: Vector  # [rows]
    restitution: Vector  # [rows]
    compressed: Vector  # [rows], velocities at the end of compression
    after: Vector  # [rows]


def make_impact_workspace(contacts: int, coordinates: int, width: int, facets: int = DISC) -> ImpactWorkspace:
    """Work space for exactly ``contacts`` contacts on bodies with ``coordinates`` coordinates."""
    rows = contacts * width
    zeros = numpy.zeros
    solver = make_solver(contacts, coordinates, width, facets)
    return ImpactWorkspace(solver, make_path_workspace(), zeros(rows), zeros(rows), zeros(rows), zeros(rows))


@kernel
def _ask(problem, u, restitution, rule, work):
    """First solve: without bounce, or with Newton's."""
    copy_row(u, problem.q)
    for i in range(restitution.shape[0]):
        problem.floor[i] = 0.0
        if rule == NEWTON:
            problem.q[i * problem.width] += restitution[i] * min(0.0, u[i * problem.width])
    for i in range(u.shape[0]):
        work.compression[i] = 0.0


@kernel
def _give_back(problem, J, W, restitution, share, work):
    """Second phase: at least ``share e_i`` of each compression impulse; velocities afterwards in ``work.after``."""
    copy_row(work.compressed, problem.q)
    for i in range(restitution.shape[0]):
        problem.floor[i] = share * restitution[i] * work.compression[i * problem.width]
    for i in range(work.restitution.shape[0]):
        work.restitution[i] = 0.0
    found = solve_and_split(problem, J, W, work.solver, work.restitution)
    multiply_add(problem.A, work.restitution, work.compressed, work.after)
    return found


@kernel
def _is_within(problem, u, restitution, work):
    """Whether the works given back stay below ``e^2`` of those taken, and the kinetic energy below that before."""
    returned, allowed, gained, size = 0.0, 0.0, 0.0, 0.0
    for i in range(restitution.shape[0]):
        row = i * problem.width
        returned += 0.5 * work.restitution[row] * (work.compressed[row] + work.after[row])
        taken = 0.5 * work.compression[row] * (u[row] + work.compressed[row])
        allowed += restitution[i] ** 2 * max(0.0, -taken)
        for k in range(row, row + problem.width):
            work_done = 0.5 * (work.compression[k] + work.restitution[k]) * (u[k] + work.after[k])
            gained += work_done
            size += abs(work_done)
    return returned <= allowed * (1.0 + SLACK) and gained <= SLACK * size


@kernel
def _any_bounce(restitution, work, width):
    bounce = False
    for i in range(restitution.shape[0]):
        bounce = bounce or restitution[i] * work.compression[i * width] > 0.0
    return bounce


@kernel
def _restore(problem, J, W, u, restitution, rule, work):
    """Restitution phase: share 1; where that gives back too much, the greatest share that does not, by bisection."""
    low, high, share = 0.0, 1.0, 1.0
    found = Solution(SOLVED, UNIQUE, 0.0, 0)
    for attempt in range(BISECTIONS + 2):
        found = _give_back(problem, J, W, restitution, share, work)
        if rule != ENERGETIC or attempt > BISECTIONS:
            break
        if found.status == SOLVED and _is_within(problem, u, restitution, work):
            low = share
            if attempt == 0:
                break
        else:
            high = share
        share = 0.5 * (low + high) if attempt + 1 < BISECTIONS + 1 else low
    return found


@kernel
def _several(problem, J, W, u, restitution, rule, work, c):
    _ask(problem, u, restitution, rule, work)
    found = solve_and_split(problem, J, W, work.solver, work.compression)
    copy_row(work.compression, c)
    if found.status != SOLVED or rule == NEWTON or not _any_bounce(restitution, work, problem.width):
        return found
    multiply_add(problem.A, work.compression, u, work.compressed)
    found = _restore(problem, J, W, u, restitution, rule, work)
    for i in range(c.shape[0]):
        c[i] = c[i] + work.restitution[i] if found.status == SOLVED else 0.0
    return found


@kernel
def _one_in_the_plane(problem, i, u, restitution, rule, c):
    A, row = problem.A, i * PLANE
    contact = PlanarContact(A[row, row], A[row, row + 1], A[row + 1, row + 1], problem.friction[i], restitution[i])
    impulse = impact_impulse(contact, rule, u[row], u[row + 1])
    c[row], c[row + 1] = impulse.normal, impulse.tangential
    return Solution(SOLVED, UNIQUE, 0.0, 0)


@kernel
def _one_in_space(problem, i, u, restitution, work, c):
    A, n, s, t = problem.A, i * SPACE, i * SPACE + 1, i * SPACE + 2
    contact = ImpactPath(A[n, n], A[n, s], A[n, t], A[s, s], A[s, t], A[t, t], problem.friction[i], restitution[i])
    status = energetic_path(contact, u[n], u[s], u[t], work.path)
    if status == SOLVED:
        c[n], c[s], c[t] = work.path.state[IMPULSE], work.path.state[FIRST], work.path.state[SECOND]
    return Solution(status, UNIQUE, 0.0, 0)


@kernel
def _touching(problem):
    """Number of contacts that are not INACTIVE, and the last of them."""
    count, last = 0, 0
    for i in range(problem.friction.shape[0]):
        if problem.friction[i] >= 0.0:
            count, last = count + 1, i
    return count, last


@kernel
def resolve_impact(
    problem: ContactProblem,
    J: Vector,
    W: Vector,
    u: Vector,
    restitution: Vector,
    rule: int,
    work: ImpactWorkspace,
    c: Vector,
) -> Solution:
    """Impulses ``c`` [rows] of the impact from the contact velocities ``u`` [rows].

    ``problem.A`` must be ``J W J'`` and hold the friction; its ``q`` and ``floor`` are overwritten. ``restitution`` [contacts].
    Contacts that touch without approaching take part, else they would be driven in. The residual of an energetic impulse of one
    contact is 0: it obeys Coulomb's law along its path, not in the sum.
    """
    contacts = restitution.shape[0]
    approaching = False
    for i in range(contacts):
        approaching = approaching or (problem.friction[i] >= 0.0 and u[i * problem.width] < 0.0)
    for i in range(c.shape[0]):
        c[i] = 0.0
    if not approaching:
        return Solution(SOLVED, UNIQUE, 0.0, 0)
    touching, only = _touching(problem)
    if touching == 1 and problem.width == PLANE:
        return _one_in_the_plane(problem, only, u, restitution, rule, c)
    if touching == 1 and rule == ENERGETIC:
        return _one_in_space(problem, only, u, restitution, work, c)
    return _several(problem, J, W, u, restitution, rule, work, c)


@entry
def impact_impulses(
    problem: ContactProblem,
    J: Vector,
    W: Vector,
    u: Vector,
    restitution: Vector,
    rule: int,
    work: ImpactWorkspace,
    c: Vector,
) -> Solution:
    """`resolve_impact` for callers from Python."""
    return resolve_impact(problem, J, W, u, restitution, rule, work, c)
