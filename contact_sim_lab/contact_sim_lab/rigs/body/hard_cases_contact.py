"""Hard cases of rigid contact: redundancy, mass ratio, Painleve, wedged bodies, energy of
impacts.
"""

from __future__ import annotations

import math
from functools import cache

import numpy

from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, close_to, exactly
from contact_sim_lab.rigs.body.rigid_problem import (
    SIDE,
    ContactCase,
    block_corner,
    contact_rows,
    random_face,
    solve,
    stack,
)
from contact_sim_lab.twins.rigid_contact import coulomb_residual
from contact_sim_lab.twins.rigid_impact import energetic_by_path, newton_by_enumeration
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigid.contact.answers import contact_impulses
from contact_sim_pkg.rigid.contact.planar_impact import planar_impact
from contact_sim_pkg.rigid.contact.solver import LEMKE, make_solver
from contact_sim_pkg.rigid.parameters import ENERGETIC, NEWTON, PlanarContact
from contact_sim_pkg.rigid.problem import PLANE, SPACE, make_problem
from contact_sim_pkg.rigid.results import RAY

ENERGY_IMPACTS, COMPARED_IMPACTS = 10_000, 300


def _random_impacts(count: int, seed: int) -> list[tuple[Vector, Vector, Vector, PlanarContact]]:
    """J, inverse masses, velocity and contact of approaching random impacts of the block."""
    generator = numpy.random.default_rng(seed)
    found: list[tuple[Vector, Vector, Vector, PlanarContact]] = []
    while len(found) < count:
        J, W = block_corner(generator.uniform(0.0, math.pi / 2))
        v = generator.uniform([-2.0, -3.0, -20.0], [2.0, 1.0, 20.0])
        A = J * W @ J.T
        contact = PlanarContact(
            float(A[0, 0]), float(A[0, 1]), float(A[1, 1]), generator.uniform(0.0, 2.0), generator.uniform()
        )
        if (J @ v)[0] < 0.0:
            found.append((J, W, v, contact))
    return found


@cache
def _growth(rule: int) -> float:
    """Greatest ratio of the kinetic energies after and before over random impacts, less 1."""
    worst = -math.inf
    for J, W, v, contact in _random_impacts(ENERGY_IMPACTS, 1):
        u = J @ v
        c = planar_impact(contact, rule, float(u[0]), float(u[1]))
        after = v + W * (J.T @ numpy.array(c[:2]))
        worst = max(worst, float(after @ (after / W)) / float(v @ (v / W)) - 1.0)
    return worst


def _deviation(rule: int) -> float:
    """Greatest error of the velocity after random impacts, over the greatest velocity before,
    rotation times the side.
    """
    worst, scale = 0.0, numpy.array([1.0, 1.0, SIDE])
    by_reference = newton_by_enumeration if rule == NEWTON else energetic_by_path
    for J, W, v, contact in _random_impacts(COMPARED_IMPACTS, 2):
        u = J @ v
        c = numpy.array(planar_impact(contact, rule, float(u[0]), float(u[1]))[:2])
        expected = by_reference(J * W @ J.T, contact.friction, contact.restitution, u)
        worst = max(worst, numpy.abs(scale * W * (J.T @ (c - expected))).max() / numpy.abs(scale * v).max())
    return float(worst)


def denominator(contact: PlanarContact) -> float:
    """Denominator of the sliding mode, ``A_nn - mu |A_nt|`` [1/kg], of the direction that wedges."""
    return contact.normal - contact.friction * abs(contact.coupling)


def _least_denominator(count: int, seed: int) -> float:
    return min(denominator(contact) for *_body, contact in _random_impacts(count, seed))


def _rank_lost(rows: Vector) -> int:
    return len(rows) - int(numpy.linalg.matrix_rank(rows))


def redundant_residual() -> Finding:
    """Signorini and Coulomb residual of 16 contacts whose normals have rank 3."""
    case = random_face(16, 16, SPACE)
    c, _solution = solve(case)
    A = case.J @ case.W @ case.J.T
    return at_most(
        coulomb_residual(A, case.J @ case.v, c, case.friction, SPACE, 0), 1e-12, hard=_rank_lost(case.J[::3])
    )


def redundant_order() -> Finding:
    """Difference of the velocities [m/s] when the 16 contacts are numbered the other way round."""
    case = random_face(16, 16, SPACE)._replace(friction=numpy.full(16, 0.5))
    rows = numpy.arange(48).reshape(16, 3)[::-1].ravel()
    first, _solution = solve(case)
    second, _solution = solve(case._replace(J=numpy.ascontiguousarray(case.J[rows])))
    return at_most(
        float(numpy.abs(case.W @ (case.J.T @ first - case.J[rows].T @ second)).max()),
        1e-12,
        hard=_rank_lost(case.J[::3]),
    )


def quarter_loads() -> Finding:
    """Load of a corner of a box that rests on four, over its weight."""
    corners = numpy.array([[x, y, -0.1] for x in (-0.2, 0.2) for y in (-0.3, 0.3)])
    W = numpy.diag([0.5, 0.5, 0.5, 8.0, 9.0, 7.0])
    v = numpy.array([0.0, 0.0, -9.81, 0.0, 0.0, 0.0])
    J = contact_rows(corners, SPACE)
    c, _solution = solve(ContactCase(J, W, v, numpy.full(4, 0.3), SPACE))
    return close_to(float(c[::3].max()) / (2.0 * 9.81), 0.25, 1e-9, hard=_rank_lost(J[::3]))


def heavy_on_light() -> Finding:
    """Residual of 1 kg under 1e6 kg."""
    case = stack(1e6)
    return at_most(solve(case)[1].residual, 1e-12, hard=numpy.linalg.cond(case.J @ case.W @ case.J.T))


def wedged() -> Finding:
    """Status of a body between two walls that both require it to leave faster, which no impulse
    can do.
    """
    J = numpy.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, 1.0]])
    problem = make_problem(2, PLANE)
    problem.A[:], problem.q[:], problem.friction[:] = J @ J.T, (-1.0, 0.2, -1.0, 0.2), 0.5
    solver = make_solver(2, 2, PLANE, 0, LEMKE)
    return exactly(
        contact_impulses(problem, J, numpy.eye(2), solver, numpy.zeros(4)).status,
        RAY,
        hard=problem.q[0] + problem.q[2] if J[0] @ J[2] == -1.0 else math.nan,
    )


def painleve() -> Finding:
    """Slip [m/s] after an impact in which sliding on has a negative denominator: the contact jams
    at once.
    """
    J, W = block_corner(math.pi / 4 - math.atan(0.5))
    A = J * W @ J.T
    contact = PlanarContact(float(A[0, 0]), float(A[0, 1]), float(A[1, 1]), 1.6, 0.2)
    u = J @ numpy.array([math.copysign(3.0, contact.coupling), -0.01, 0.0])
    c = planar_impact(contact, ENERGETIC, float(u[0]), float(u[1]))
    return at_most(abs(float((u + A @ numpy.array(c[:2]))[1])), 1e-13, hard=denominator(contact))


def against_enumeration() -> Finding:
    """Deviation of random impacts by Newton's rule from the enumeration of modes."""
    return at_most(_deviation(NEWTON), 1e-10, hard=_least_denominator(COMPARED_IMPACTS, 2))


def against_path() -> Finding:
    """Deviation of random impacts by the energetic rule from its path, integrated."""
    return at_most(_deviation(ENERGETIC), 1e-10, hard=_least_denominator(COMPARED_IMPACTS, 2))


def energy_gained() -> Finding:
    """Largest gain of energy of random impacts by the energetic rule, over the energy before."""
    return at_most(max(0.0, _growth(ENERGETIC)), 1e-12, hard=_least_denominator(ENERGY_IMPACTS, 1))


MODEL, WEDGES = "rigid contact", guard.denominator_below_0()
CASES = (
    HardCase(MODEL, "300 impacts, newton, against enumeration", against_enumeration, WEDGES),
    HardCase(MODEL, "300 impacts, energetic, against its path", against_path, WEDGES),
    HardCase(MODEL, "10 000 impacts, energetic: energy gained, of it", energy_gained, WEDGES),
    HardCase(MODEL, "16 contacts of rank 3: residual", redundant_residual, guard.rank_lost(13)),
    HardCase(MODEL, "16 contacts in another order: velocity [m/s]", redundant_order, guard.rank_lost(13)),
    HardCase(MODEL, "box on four corners: load of one over weight", quarter_loads, guard.rank_lost(1)),
    HardCase(MODEL, "1 kg under 1e6 kg: residual", heavy_on_light, guard.condition(1e6)),
    HardCase(MODEL, "wedged between two bouncing walls: status", wedged,
        guard.below("speed that opposite walls require, summed [m/s]", 0.0)),
    HardCase(MODEL, "Painlevé: slip after the jam [m/s]", painleve, WEDGES),
)  # fmt: skip
