"""Contact problems of known answer, for work-precision studies and hard cases of rigid bodies."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_lab.records.work_precision import milliseconds
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigid import problem as contact_problem
from contact_sim_pkg.rigid.contact.answers import contact_impulses, solve_repeatedly
from contact_sim_pkg.rigid.contact.solver import NEWTON, ContactSolution, Solver, make_solver

__all__ = ["ContactCase", "block_corner", "contact_rows", "milliseconds_of_a_solve", "random_face", "solve", "stack"]

SOLVES = 200  # in a compiled loop, whose time is that of one so many times
SIDE = 0.1  # [m] of the block of Identifiability


class ContactCase(NamedTuple):
    """One solve: Jacobian, inverse inertia, velocities before, friction of every contact, rows of a
    contact.
    """

    J: Vector
    W: Vector
    v: Vector
    friction: Vector
    width: int


def block_corner(theta: float) -> tuple[Vector, Vector]:
    """J [2, 3] (normal, tangent) of the lowest corner of the 1 kg block at the angle ``theta``
    [rad], and its inverse masses [3] in [1/kg], [1/(kg m^2)].
    """
    radius = SIDE / math.sqrt(2.0)
    j_n = [0.0, 1.0, -radius * math.sin(math.pi / 4 - theta)]
    j_t = [1.0, 0.0, radius * math.cos(math.pi / 4 - theta)]
    return numpy.array([j_n, j_t]), numpy.array([1.0, 1.0, 6.0 / SIDE**2])


def contact_rows(points: Vector, width: int) -> Vector:
    """J [rows, coordinates] of contact ``points`` [contacts, width] in [m] from the centre of mass:
    normal up, then the tangents.
    """
    rows: list[list[float]] = []
    for point in points:
        if width == contact_problem.PLANE:
            rows += [[0.0, 1.0, point[0]], [1.0, 0.0, -point[1]]]
        else:
            rows += [[*axis, *numpy.cross(point, axis)] for axis in numpy.eye(3)[[2, 0, 1]]]
    return numpy.array(rows)


def random_face(seed: int, contacts: int, width: int) -> ContactCase:
    """A body that falls, sliding and turning, on ``contacts`` points of a flat face."""
    generator = numpy.random.default_rng(seed)
    points = generator.uniform(-1.0, 1.0, (contacts, width))
    points[:, -1] = -0.3
    W = numpy.diag([1.0, 1.0, 3.0] if width == contact_problem.PLANE else [1.0, 1.0, 1.0, 3.0, 4.0, 5.0])
    v = generator.uniform(-1.0, 1.0, len(W))
    v[width - 1] -= 1.0
    return ContactCase(contact_rows(points, width), W, v, generator.uniform(0.2, 0.8, contacts), width)


def stack(ratio: float) -> ContactCase:
    """1 kg on the ground under ``ratio`` [kg], both falling: coordinates are two heights and two
    shifts.
    """
    J = numpy.zeros((4, 4))
    J[0, 0], J[1, 2], J[2, :2], J[3, 2:] = 1.0, 1.0, (-1.0, 1.0), (-1.0, 1.0)
    W = numpy.diag([1.0, 1.0 / ratio, 1.0, 1.0 / ratio])
    v = numpy.array([-9.81, -9.81, 0.1, 0.3])
    return ContactCase(J, W, v, numpy.full(2, 0.5), contact_problem.PLANE)


def milliseconds_of_a_solve(case: ContactCase, method: int = NEWTON, facets: int = 0, sweeps: int = 20) -> float:
    """Of one solve in [ms], within a compiled loop: neither the call from Python nor the set-up of
    arrays counts.
    """
    problem, solver = _set_up(case, method, facets, sweeps)
    c = numpy.zeros(len(case.J))

    def repeated(times: int) -> float:
        return milliseconds(lambda: solve_repeatedly(problem, case.J, case.W, solver, c, times))

    return max(0.0, repeated(SOLVES + 1) - repeated(1)) / SOLVES


def solve(case: ContactCase, method: int = NEWTON, facets: int = 0, sweeps: int = 20) -> tuple[Vector, ContactSolution]:
    """Impulses [rows] in [N s] of a case without restitution, and how the solve ended."""
    problem, solver = _set_up(case, method, facets, sweeps)
    c = numpy.zeros(len(case.J))
    return c, contact_impulses(problem, case.J, case.W, solver, c)


def _set_up(case: ContactCase, method: int, facets: int, sweeps: int) -> tuple[contact_problem.ContactProblem, Solver]:
    contacts = len(case.friction)
    problem = contact_problem.make_problem(contacts, case.width, facets)
    problem.A[:] = case.J @ case.W @ case.J.T
    problem.q[:] = case.J @ case.v
    problem.friction[:] = case.friction
    return problem, make_solver(contacts, case.J.shape[1], case.width, facets, method, sweeps)
