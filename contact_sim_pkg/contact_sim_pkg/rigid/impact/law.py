"""Impact of any number of contacts at once by the rules of Newton, Poisson and the energetic one.

Energetic, several contacts: compression without bounce, then each contact gives back ``s e_i`` of
its compression impulse, with the greatest s in [0, 1] for which the normal works give back at most
``e_i^2`` of what they took and no kinetic energy is gained. Several contacts are a row of contact
solves, each compiled, called from Python. Source: Brogliato, Nonsmooth Mechanics. Planar and one
contact: `rigid/contact/planar_impact.py`; one contact in space: `rigid/impact/path.py`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigid.contact.answers import contact_impulses
from contact_sim_pkg.rigid.contact.planar_impact import planar_impact
from contact_sim_pkg.rigid.contact.solver import ContactSolution, Solver, make_solver
from contact_sim_pkg.rigid.impact.path import FIRST, IMPULSE, SECOND, PathWorkspace, make_path_workspace, spatial_impact
from contact_sim_pkg.rigid.parameters import ENERGETIC, NEWTON, ImpactPath, PlanarContact
from contact_sim_pkg.rigid.problem import DISC, PLANE, SPACE, ContactProblem
from contact_sim_pkg.rigid.results import SOLVED, UNIQUE

TRIALS = 60
SLACK = 1.0e-12
SHARE_FOUND = 1.0e-12  # of 1: a share this near to the greatest is taken


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


def impact_impulses(
    problem: ContactProblem, J: Vector, W: Vector, u: Vector, restitution: Vector, rule: int, work: ImpactWorkspace,
    c: Vector,
) -> ContactSolution:  # fmt: skip
    """Impulses ``c`` [rows] of the impact from the contact velocities ``u`` [rows].

    ``problem.A`` must be ``J W J'`` and hold the friction; its ``q`` and ``floor`` are overwritten.
    ``restitution`` [contacts]. Contacts that touch without approaching are active too, else they
    would be driven in. The residual of an energetic impulse of one contact is 0: it obeys Coulomb's
    law along its path, not in the sum.
    """
    # nothing approaches: no impact
    touching = numpy.flatnonzero(problem.friction >= 0.0)
    c[:] = 0.0
    if not (u[touching * problem.width] < 0.0).any():
        return ContactSolution(SOLVED, UNIQUE, 0.0, 0)
    # one contact has closed forms or a path of its own
    only = int(touching[0])
    if len(touching) == 1 and problem.width == PLANE:
        return _one_in_the_plane(problem, only, u, float(restitution[only]), rule, c)
    if len(touching) == 1 and rule == ENERGETIC:
        return _one_in_space(problem, only, u, float(restitution[only]), work, c)
    return _several(problem, J, W, u, restitution, rule=rule, work=work, c=c)


def _one_in_the_plane(
    problem: ContactProblem, i: int, u: Vector, restitution: float, rule: int, c: Vector
) -> ContactSolution:
    A, row = problem.A, i * PLANE
    contact = PlanarContact(
        float(A[row, row]), float(A[row, row + 1]), float(A[row + 1, row + 1]), float(problem.friction[i]), restitution
    )
    impulse = planar_impact(contact, rule, float(u[row]), float(u[row + 1]))
    c[row], c[row + 1] = impulse.normal, impulse.tangential
    return ContactSolution(SOLVED, UNIQUE, 0.0, 0)


def _one_in_space(
    problem: ContactProblem, i: int, u: Vector, restitution: float, work: ImpactWorkspace, c: Vector
) -> ContactSolution:
    n, s, t = range(i * SPACE, (i + 1) * SPACE)
    A = problem.A
    parts = (A[n, n], A[n, s], A[n, t], A[s, s], A[s, t], A[t, t], problem.friction[i], restitution)
    contact = ImpactPath(*(float(part) for part in parts))
    status = spatial_impact(contact, float(u[n]), float(u[s]), float(u[t]), work.path)
    if status == SOLVED:
        c[n], c[s], c[t] = work.path.state[IMPULSE], work.path.state[FIRST], work.path.state[SECOND]
    return ContactSolution(status, UNIQUE, 0.0, 0)


def _several(
    problem: ContactProblem, J: Vector, W: Vector, u: Vector, restitution: Vector, rule: int, work: ImpactWorkspace,
    c: Vector,
) -> ContactSolution:  # fmt: skip
    problem.q[:], problem.floor[:], work.compression[:] = u, 0.0, 0.0
    if rule == NEWTON:
        problem.q[:: problem.width] += restitution * numpy.minimum(0.0, u[:: problem.width])
    found = contact_impulses(problem, J, W, work.solver, work.compression)
    c[:] = work.compression
    bounces = (restitution * work.compression[:: problem.width] > 0.0).any()
    if found.status != SOLVED or rule == NEWTON or not bounces:
        return found
    work.compressed[:] = u + problem.A @ work.compression
    found = _restore(problem, J, W, u, restitution, rule, work)
    c[:] = c + work.restitution if found.status == SOLVED else 0.0
    return found


def _give_back(
    problem: ContactProblem, J: Vector, W: Vector, restitution: Vector, share: float, work: ImpactWorkspace
) -> ContactSolution:
    """Second phase: at least ``share e_i`` of each compression impulse; velocities afterwards in
    ``work.after``.
    """
    problem.q[:] = work.compressed
    problem.floor[:] = share * restitution * work.compression[:: problem.width]
    work.restitution[:] = 0.0
    found = contact_impulses(problem, J, W, work.solver, work.restitution)
    work.after[:] = work.compressed + problem.A @ work.restitution
    return found


def _left(problem: ContactProblem, u: Vector, restitution: Vector, work: ImpactWorkspace) -> float:
    """Part left of the work that may be given back, or of the kinetic energy, whichever is smaller;
    below 0: too much came back.
    """
    normal = slice(None, None, problem.width)
    returned = 0.5 * float(work.restitution[normal] @ (work.compressed + work.after)[normal])
    taken = 0.5 * work.compression[normal] * (u + work.compressed)[normal]
    allowed = float(restitution**2 @ numpy.maximum(0.0, -taken))
    works = 0.5 * (work.compression + work.restitution) * (u + work.after)
    size = float(numpy.abs(works).sum())
    left = min(allowed * (1.0 + SLACK) - returned, SLACK * size - float(works.sum()))
    return left / size if size > 0.0 else 0.0


def _restore(
    problem: ContactProblem, J: Vector, W: Vector, u: Vector, restitution: Vector, rule: int, work: ImpactWorkspace
) -> ContactSolution:
    """Restitution phase: share 1; where that gives back too much, the greatest share that does not,
    by regula falsi and halving.
    """
    # full restitution, if the works allow it
    found = _give_back(problem, J, W, restitution, 1.0, work)
    if rule != ENERGETIC:
        return found
    left = _left(problem, u, restitution, work) if found.status == SOLVED else -math.inf
    if left >= 0.0:
        return found
    # bracket of the greatest admissible share: 0 always is
    low, high, at_low, at_high = 0.0, 1.0, math.nan, left
    for attempt in range(TRIALS):
        # bisection every third time, else regula falsi, a little to the safe side
        share = 0.5 * (low + high)
        if attempt % 3 and math.isfinite(at_low + at_high):
            share = low + (high - low) * at_low / (at_low - at_high) - 0.25 * SHARE_FOUND
            share = min(max(share, low), high)
        found = _give_back(problem, J, W, restitution, share, work)
        left = _left(problem, u, restitution, work) if found.status == SOLVED else -math.inf
        if left >= 0.0:
            low, at_low = share, left
        else:
            high, at_high = share, left
        if high - low <= SHARE_FOUND or (left >= 0.0 and left <= SLACK):
            break
    # the last share that was admissible
    return found if left >= 0.0 else _give_back(problem, J, W, restitution, low, work)
