"""A face that sticks with points at the edge of their cones: closed form, scipy's SLSQP, Dykstra's
alternating projections.
"""

import math

import numpy
import pytest
from scipy.optimize import minimize
from tests.rigid.contact.contact_case import SPACE, contact_rows
from tests.rigid.contact.test_closed_forms import closed

from contact_sim_lab.twins.rigid_contact import coulomb_residual
from contact_sim_pkg.rigid.bodies.body import box, placed, slope
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.results import SOLVED

W = numpy.diag([1.0, 1.0, 1.0, 600.0, 600.0, 600.0])
# moments in units near those of the forces
LENGTHS = numpy.array([1.0, 1.0, 1.0, 20.0, 20.0, 20.0])
CORNERS = numpy.array([[x, y, -0.05] for x in (-0.05, 0.05) for y in (-0.05, 0.05)])


def random_case(generator, corners=None):
    """Points of a face, friction, and impulses within the cones: the body stops where it is asked
    for their wrench.
    """
    contacts = int(generator.integers(3, 8))
    points = numpy.column_stack([generator.uniform(-0.1, 0.1, (contacts, 2)), numpy.full(contacts, -0.05)])
    points = points if corners is None else corners
    friction, impulse = generator.uniform(0.1, 1.2), numpy.zeros((len(points), 3))
    impulse[:, 0] = generator.uniform(0.1, 1.0, len(points))
    angle = generator.uniform(0.0, 2.0 * math.pi, len(points))
    tangential = friction * impulse[:, 0] * generator.uniform(0.7, 0.99, len(points))
    impulse[:, 1], impulse[:, 2] = tangential * numpy.cos(angle), tangential * numpy.sin(angle)
    return contact_rows(points, SPACE), friction, impulse.ravel()


def onto_cones(c, friction):
    """Nearest point of each contact's friction cone, from its definition."""
    near = c.reshape(-1, 3).copy()
    for i, (n, t, s) in enumerate(near):
        length = math.hypot(t, s)
        if length > friction * n:
            along = max(0.0, (n + friction * length) / (1.0 + friction**2))
            near[i] = along, along * friction * t / length, along * friction * s / length
    return near.ravel()


def least_by_projections(J, wrench, friction, rounds=20_000):
    """The nearest point to 0 of all impulses with the wrench and in their cones, by Dykstra's
    method from 0.
    """
    A, b = LENGTHS[:, None] * J.T, LENGTHS * wrench
    back = numpy.linalg.pinv(A)
    x, kept, last = numpy.zeros(len(J)), numpy.zeros(len(J)), math.inf
    for _ in range(rounds):
        on_wrench = x - back @ (A @ x - b)
        x, before = onto_cones(on_wrench + kept, friction), x
        kept += on_wrench - x
        if max(last, numpy.abs(x - before).max()) <= 1e-15:
            break
        last = numpy.abs(x - before).max()
    return x


def least_by_slsqp(J, wrench, friction, start):
    A, b, contacts = LENGTHS[:, None] * J.T, LENGTHS * wrench, len(J) // 3
    sign = numpy.array([2.0 * friction**2, -2.0, -2.0])

    def slack(c):
        return (0.5 * sign * c.reshape(-1, 3) ** 2).sum(axis=1)

    def slope_of_slack(c):
        rows = numpy.zeros((contacts, len(c)))
        for i in range(contacts):
            rows[i, 3 * i : 3 * i + 3] = sign * c[3 * i : 3 * i + 3]
        return rows

    presses = numpy.kron(numpy.eye(contacts), [[1.0, 0.0, 0.0]])
    found = minimize(
        lambda c: 0.5 * c @ c, start, jac=lambda c: c, method="SLSQP", options={"ftol": 1e-16, "maxiter": 500},
        constraints=[
            {"type": "eq", "fun": lambda c: A @ c - b, "jac": lambda c: A},
            {"type": "ineq", "fun": slack, "jac": slope_of_slack},
            {"type": "ineq", "fun": lambda c: presses @ c, "jac": lambda c: presses},
        ],
    )  # fmt: skip
    return found.x


def fits_without_bounds(J, impulse, friction):
    least = J @ numpy.linalg.solve(J.T @ J, J.T @ impulse)
    return numpy.abs(onto_cones(least, friction) - least).max() <= 1e-15


@pytest.mark.parametrize("corners", [None, CORNERS], ids=["any points", "four corners"])
def test_the_split_of_a_sticking_face_is_the_nearest_to_no_impulse_within_the_cones(corners):
    generator, bounded = numpy.random.default_rng(11), 0
    for _ in range(60):
        J, friction, impulse = random_case(generator, corners)
        c, residual = closed(0, J, W, -W @ J.T @ impulse, numpy.full(len(J) // 3, friction))
        assert residual <= 1e-12
        assert coulomb_residual(J @ W @ J.T, -J @ W @ J.T @ impulse, c, friction, SPACE, 0) <= 1e-12
        expected = least_by_projections(J, J.T @ impulse, friction)
        assert c == pytest.approx(expected, abs=1e-11 * numpy.abs(c).max())
        bounded += not fits_without_bounds(J, impulse, friction)
    assert bounded >= 10


def test_the_split_of_a_sticking_face_is_that_of_sequential_quadratic_programming():
    generator, bounded = numpy.random.default_rng(12), 0
    while bounded < 8:
        J, friction, impulse = random_case(generator, CORNERS)
        if fits_without_bounds(J, impulse, friction):
            continue
        bounded += 1
        c, _residual = closed(0, J, W, -W @ J.T @ impulse, numpy.full(4, friction))
        expected = least_by_slsqp(J, J.T @ impulse, friction, impulse)
        assert c == pytest.approx(expected, abs=1e-9 * numpy.abs(c).max())


@pytest.mark.parametrize("degrees", [15.0, 16.0, 16.6])
def test_upper_corners_on_a_slope_hold_what_their_cones_let_them_and_lower_ones_the_rest(degrees):
    """Loads ``W/4 (cos a -+ sin a)`` from the moment (a cube), friction ``mu N`` above and the rest
    of ``W sin a`` below.
    """
    lean, friction, weight, tick = math.radians(degrees), 0.3, 9.81, 1e-3
    body = box((0.1, 0.1, 0.1), 1.0, friction, 0.0)
    body = body._replace(load=numpy.array([-weight * math.sin(lean), 0.0, -weight * math.cos(lean), 0.0, 0.0, 0.0]))
    located = LocatedBody(body, slope(3), placed(body, [0.0, 0.0, 0.05], numpy.zeros(6)))
    status, track = located.advance_over(tick, 20)
    assert status == SOLVED
    force = track.impulse[-1].reshape(-1, 3) / tick
    lower = body.points[:, 0] < 0.0
    active = body.points[:, 2] < 0.0
    upper_load = 0.25 * weight * (math.cos(lean) - math.sin(lean))
    lower_load = 0.25 * weight * (math.cos(lean) + math.sin(lean))
    lower_hold = 0.5 * weight * math.sin(lean) - friction * upper_load
    assert force[active & ~lower] == pytest.approx(
        numpy.array([[upper_load, friction * upper_load, 0.0]] * 2), abs=1e-11
    )
    assert force[active & lower] == pytest.approx(numpy.array([[lower_load, lower_hold, 0.0]] * 2), abs=1e-11)
    assert not force[~active].any()
    assert numpy.array_equal(located.motion.position, [0.0, 0.0, 0.05])


def test_a_wrench_that_the_cones_cannot_hold_together_is_no_sticking_face():
    J = contact_rows(CORNERS, SPACE)
    for wrench in ([0.31, 0.0, 1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0, 0.0, 0.1], [0.0, 0.0, 1.0, 0.06, 0.0, 0.0]):
        v = -W @ numpy.array(wrench)
        c, residual = closed(0, J, W, v, numpy.full(4, 0.3))
        assert residual == math.inf or numpy.abs(J @ (v + W @ J.T @ c)).max() > 1e-3
