"""Contacts whose velocities are no motion of the body by rounding: residuals by their
definition.
"""

import math

import numpy
import pytest
from tests.rigid.contact.contact_case import PLANE, solve

from contact_sim_lab.twins.rigid_contact import coulomb_residual
from contact_sim_pkg.rigid.contact.solver import LEMKE, NEWTON
from contact_sim_pkg.rigid.results import RAY, SOLVED

ROUNDING = 1e-16  # of the contact velocities, in [m/s]


def wedged(generator):
    """J and W of a body of 1 kg in the plane on two steep faces that face each other."""
    rows = []
    for angle in generator.uniform(0.7, 1.5, 2) * [-1.0, 1.0]:
        normal, arm = numpy.array([-math.sin(angle), math.cos(angle)]), 0.1 * generator.normal(size=2)
        for axis in (normal, numpy.array([normal[1], -normal[0]])):
            rows.append([*axis, arm[0] * axis[1] - arm[1] * axis[0]])
    return numpy.array(rows), numpy.diag([1.0, 1.0, 300.0])


@pytest.mark.parametrize("method", [LEMKE, NEWTON])
def test_a_wedged_body_that_hardly_moves_has_an_answer_in_spite_of_rounding(method):
    """Any motion has one; of 300 velocities with rounding some ten had none, or one whose
    conditions do not meet exactly.
    """
    generator = numpy.random.default_rng(1)
    for _ in range(300):
        J, W = wedged(generator)
        friction = generator.choice([0.7, 2.0])
        q = J @ (1e-10 * generator.normal(size=3) * [1.0, 1.0, 10.0]) + ROUNDING * generator.normal(size=4)
        c, solution = solve(J, W, q, friction, PLANE, method=method)
        assert solution.status == SOLVED
        assert coulomb_residual(J @ W @ J.T, q, c, friction, PLANE, 0) <= 10.0 * ROUNDING / numpy.abs(q).max() + 1e-12


def test_walls_that_ask_for_more_than_rounding_have_no_answer():
    """Two walls that both want to be left at once: no motion leaves both."""
    J = numpy.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    q = numpy.array([1e-10, 0.0, -1e-10 - 1e-15, 0.0])
    c, solution = solve(J, numpy.eye(3), q, 0.5, PLANE, method=LEMKE)
    assert (solution.status, c.any()) == (RAY, False)
