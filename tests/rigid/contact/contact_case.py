"""Random bodies on several contacts, and what their contact solves must meet."""

import numpy

from contact_sim_pkg.rigid import problem as contact_problem
from contact_sim_pkg.rigid.contact.answers import contact_impulses
from contact_sim_pkg.rigid.contact.solver import NEWTON, make_solver

PLANE, SPACE = contact_problem.PLANE, contact_problem.SPACE
COORDINATES = {PLANE: 3, SPACE: 6}


def contact_rows(points, width):
    """J [rows, coordinates] of contact points relative to the centre of mass: normal up, then the
    tangents.
    """
    rows = []
    for point in points:
        if width == PLANE:
            rows += [[0.0, 1.0, point[0]], [1.0, 0.0, -point[1]]]
        else:
            rows += [[*axis, *numpy.cross(point, axis)] for axis in numpy.eye(3)[[2, 0, 1]]]
    return numpy.array(rows)


def face_points(generator, contacts, width, height=0.3):
    """Points on a flat face below the centre of mass: normals of rank 2 in the plane, 3 in
    space.
    """
    points = generator.uniform(-1.0, 1.0, (contacts, width))
    points[:, -1] = -height
    return points


def random_case(generator, contacts, width):
    """J, W and velocities of a body that falls on a face."""
    J = contact_rows(face_points(generator, contacts, width), width)
    W = numpy.diag([1.0, 1.0, 3.0] if width == PLANE else [1.0, 1.0, 1.0, 3.0, 4.0, 5.0])
    v = generator.uniform(-1.0, 1.0, COORDINATES[width])
    v[width - 1] -= 1.0
    return J, W, v


def problem_of(J, W, q, friction, width, facets=0):
    """The contact problem of these rows."""
    contacts = len(J) // width
    problem = contact_problem.make_problem(contacts, width, facets)
    problem.A[:] = J @ W @ J.T
    problem.q[:] = q
    problem.friction[:] = friction
    return problem


def solve(J, W, q, friction, width, facets=0, method=NEWTON, sweeps=20):
    """Impulses and how the solve ended."""
    problem = problem_of(J, W, q, friction, width, facets)
    c = numpy.zeros(len(J))
    solver = make_solver(len(problem.friction), J.shape[1], width, facets, method, sweeps)
    return c, contact_impulses(problem, J, W, solver, c)
