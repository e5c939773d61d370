"""Solvers of the contact problem: residuals, agreement with enumeration and with each other,
redundancy, mass ratios, statuses.
"""

import math

import numpy
import pytest
from scipy.linalg import lstsq
from scipy.optimize import minimize
from tests.rigid.contact.contact_case import PLANE, SPACE, contact_rows, random_case, solve

from contact_sim_lab.twins.rigid_contact import (
    coulomb_residual,
    planar_velocity_by_enumeration,
    planar_wrench_cone_split,
)
from contact_sim_pkg.rigid.contact.solver import GAUSS_SEIDEL, LEMKE, MODES, NEWTON
from contact_sim_pkg.rigid.results import CONTACT_NOT_FINITE, RAY, SOLVED, SPLIT_NOT_UNIQUE, UNIQUE

RESIDUAL = 1e-12


def signorini_and_coulomb(J, W, q, c, friction, width, facets):
    return coulomb_residual(J @ W @ J.T, q, c, friction, width, facets)


@pytest.mark.parametrize("method", [LEMKE, NEWTON])
@pytest.mark.parametrize(("width", "facets"), [(PLANE, 0), (SPACE, 4), (SPACE, 10), (SPACE, 0)])
@pytest.mark.parametrize("contacts", [1, 2, 4])
def test_the_residual_of_signorini_and_coulomb_is_rounding(contacts, width, facets, method):
    generator = numpy.random.default_rng(contacts)
    for _ in range(40):
        J, W, v = random_case(generator, contacts, width)
        friction = generator.uniform(0.0, 1.0, contacts)
        c, solution = solve(J, W, J @ v, friction, width, facets, method)
        assert solution.status == SOLVED
        assert signorini_and_coulomb(J, W, J @ v, c, friction, width, facets) <= RESIDUAL
        assert solution.residual <= RESIDUAL


def test_one_contact_of_a_body_of_any_shape_is_solved():
    """Arms and inertias over four decades, friction up to 5; Newton's method alone turns round and
    round in 0.4 % of them.
    """
    generator = numpy.random.default_rng(7)
    for _ in range(1200):
        J = contact_rows(generator.normal(size=(1, 3)) * 10.0 ** generator.uniform(-1.0, 1.0), SPACE)
        W = numpy.diag([1.0, 1.0, 1.0, *10.0 ** generator.uniform(-2.0, 2.0, 3)])
        turned = numpy.linalg.qr(generator.normal(size=(3, 3)))[0]
        W[3:, 3:] = turned @ W[3:, 3:] @ turned.T
        q = J @ generator.normal(size=6)
        q[0] = -abs(q[0])
        friction = float(generator.choice([0.1, 0.3, 0.8, 2.0, 5.0]))
        c, solution = solve(J, W, q, friction, SPACE)
        assert solution.status == SOLVED
        assert signorini_and_coulomb(J, W, q, c, friction, SPACE, 0) <= 2.0 * RESIDUAL


def test_two_planar_contacts_give_the_velocity_of_the_index_sets():
    generator = numpy.random.default_rng(7)
    for _ in range(60):
        J, W, v = random_case(generator, 2, PLANE)
        friction = generator.uniform(0.0, 0.8, 2)
        c, _solution = solve(J, W, J @ v, friction, PLANE, method=LEMKE)
        expected = planar_velocity_by_enumeration(J, W, v, friction)
        assert numpy.abs(v + W @ J.T @ c - expected).max() <= 1e-11


def test_the_methods_agree_on_one_planar_contact():
    generator = numpy.random.default_rng(8)
    for _ in range(60):
        J, W, v = random_case(generator, 1, PLANE)
        by_method = [solve(J, W, J @ v, 0.6, PLANE, method=method)[0] for method in (MODES, LEMKE, NEWTON)]
        swept, _solution = solve(J, W, J @ v, 0.6, PLANE, method=GAUSS_SEIDEL, sweeps=2000)
        for c in (*by_method[1:], swept):
            assert numpy.abs(c - by_method[0]).max() <= 1e-10


@pytest.mark.parametrize("width", [PLANE, SPACE])
def test_sixteen_contacts_of_low_rank_are_solved_whatever_their_order(width):
    generator = numpy.random.default_rng(9)
    for _ in range(5):
        J, W, v = random_case(generator, 16, width)
        friction = generator.uniform(0.2, 0.8)
        c, solution = solve(J, W, J @ v, friction, width)
        order = generator.permutation(16)
        rows = (order[:, None] * width + numpy.arange(width)).ravel()
        shuffled, _solution = solve(J[rows], W, J[rows] @ v, friction, width)
        assert solution.status == SOLVED
        assert solution.flags == SPLIT_NOT_UNIQUE
        assert signorini_and_coulomb(J, W, J @ v, c, friction, width, 0) <= RESIDUAL
        assert numpy.abs(W @ J.T @ c - W @ J[rows].T @ shuffled).max() <= 1e-12 * numpy.abs(v).max()
        assert numpy.abs(c[rows] - shuffled).max() <= 1e-9 * numpy.abs(c).max()


@pytest.mark.parametrize("ratio", [1.0, 1e2, 1e4, 1e6])
@pytest.mark.parametrize("method", [LEMKE, NEWTON])
def test_a_light_body_under_a_heavy_one_is_solved_at_every_mass_ratio(ratio, method):
    """Two bodies of one coordinate each, stacked: weights m g under gravity over one second."""
    J = numpy.array([[1.0, 0.0], [0.0, 0.0], [-1.0, 1.0], [0.0, 0.0]])
    J = numpy.hstack([J, numpy.array([[0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [-1.0, 1.0]])])
    W = numpy.diag([1.0, 1.0 / ratio, 1.0, 1.0 / ratio])
    q = J @ numpy.array([-9.81, -9.81, 0.1, 0.3])
    c, solution = solve(J, W, q, 0.5, PLANE, method=method)
    assert solution.residual <= RESIDUAL
    assert c[2] == pytest.approx(9.81 * ratio, rel=1e-9)  # condition number 4 ratio
    assert c[0] == pytest.approx(9.81 * (1.0 + ratio), rel=1e-9)


def test_a_box_on_four_corners_shares_its_weight_in_quarters():
    corners = [[x, y, -0.1] for x in (-0.2, 0.2) for y in (-0.3, 0.3)]
    J, W = contact_rows(corners, SPACE), numpy.diag([0.5, 0.5, 0.5, 8.0, 9.0, 7.0])
    c, solution = solve(J, W, J @ numpy.array([0.0, 0.0, -9.81e-3, 0.0, 0.0, 0.0]), 0.3, SPACE)
    assert solution.flags == SPLIT_NOT_UNIQUE
    assert c.reshape(4, 3) == pytest.approx(numpy.tile([2.0 * 9.81e-3 / 4.0, 0.0, 0.0], (4, 1)), abs=1e-15)


@pytest.mark.parametrize("friction", [0.0, 0.4])
def test_the_split_is_the_one_of_least_norm_that_scipy_finds(friction):
    """Two corners of a block that rests, pulled sideways and turned: all splits of one wrench
    inside the cones.
    """
    J, W = contact_rows([[-0.1, -0.1], [0.2, -0.1], [0.05, -0.1]], PLANE), numpy.diag([1.0, 1.0, 30.0])
    v = numpy.array([0.2 * friction, -1.0, 0.5])
    c, _solution = solve(J, W, J @ v, friction, PLANE)
    expected = planar_wrench_cone_split(J, J.T @ c, friction)
    assert numpy.abs(c - expected).max() <= 1e-9 * numpy.abs(c).max()


def test_the_split_on_the_true_cone_is_not_longer_than_that_of_a_general_optimizer():
    corners = [[x, y, -0.1] for x in (-0.2, 0.3) for y in (-0.3, 0.2)]
    J, W = contact_rows(corners, SPACE), numpy.diag([1.0, 1.0, 1.0, 20.0, 25.0, 22.0])
    v = numpy.array([0.25, -0.1, -1.0, 0.1, 0.1, 0.02])
    c, _solution = solve(J, W, J @ v, 0.5, SPACE)
    wrench = J.T @ c
    found = minimize(
        lambda x: x @ x, c, jac=lambda x: 2.0 * x, method="SLSQP", options={"ftol": 1e-15, "maxiter": 500},
        constraints=[
            {"type": "eq", "fun": lambda x: J.T @ x - wrench},
            *({"type": "ineq", "fun": lambda x, i=i: 0.5 * x[3 * i] - math.hypot(x[3 * i + 1], x[3 * i + 2])} for i in range(4)),
        ],
    )  # fmt: skip
    assert c @ c <= found.fun * (1.0 + 1e-9)


def test_sticking_corners_pulled_along_both_tangents_share_the_load_with_the_least_norm():
    """Within the cones the impulses of least norm are those of least squares, which scipy finds."""
    J = contact_rows([[-0.2, -0.3, -0.1], [0.3, -0.25, -0.1], [0.35, 0.2, -0.1], [-0.15, 0.4, -0.1]], SPACE)
    W, v = numpy.diag([1.0, 1.0, 1.0, 20.0, 25.0, 22.0]), numpy.array([0.13, -0.19, -1.0, 0.2, -0.3, 0.5])
    expected = lstsq(J.T, -numpy.linalg.solve(W, v))[0].reshape(4, 3)
    pulled = numpy.hypot(expected[:, 1], expected[:, 2])
    assert (pulled < 0.8 * expected[:, 0]).all(), "all of them stick"
    assert abs(expected).min() > 5e-3
    c, _solution = solve(J, W, J @ v, 0.9, SPACE)
    assert c.reshape(4, 3) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("facets", [4, 6, 8, 16])
def test_a_polyhedral_cone_dissipates_at_least_its_inscribed_part_of_the_true_cone(facets):
    J, W = contact_rows([[0.0, 0.0, 0.0]], SPACE), numpy.diag([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])
    for angle in numpy.linspace(0.0, 2.0 * math.pi, 25):
        q = J @ numpy.array([3.0 * math.cos(angle), 3.0 * math.sin(angle), -1.0, 0.0, 0.0, 0.0])
        c, _solution = solve(J, W, q, 0.5, SPACE, facets)
        power = -(c[1] * q[1] + c[2] * q[2]) / (0.5 * c[0] * 3.0)
        assert math.cos(math.pi / facets) - 1e-12 <= power <= 1.0 + 1e-12


def test_without_friction_the_tangents_are_left_alone():
    generator = numpy.random.default_rng(12)
    J, W, v = random_case(generator, 2, SPACE)
    c, solution = solve(J, W, J @ v, 0.0, SPACE)
    assert (c.reshape(2, 3)[:, 1:] == 0.0).all()
    assert solution.flags == UNIQUE


@pytest.mark.parametrize(("width", "facets", "seed"), [(PLANE, 0, 1), (SPACE, 4, 2), (SPACE, 8, 3)])
def test_eight_contacts_at_any_height_are_solved_with_a_polyhedral_cone(width, facets, seed):
    """Normals alike, so that a solution exists; one way of pivoting ends on a ray by rounding in
    some of a thousand.
    """
    generator = numpy.random.default_rng(seed)
    coordinates = 3 if width == PLANE else 6
    for _ in range(400 if width == PLANE else 60):
        J = contact_rows(generator.uniform(-1.0, 1.0, (8, width)) * 10.0 ** generator.uniform(-1.0, 1.0), width)
        W = numpy.diag([1.0] * width + list(10.0 ** generator.uniform(-2.0, 2.0, coordinates - width)))
        q = J @ generator.normal(size=coordinates)
        friction = generator.choice([0.8, 5.0])
        c, solution = solve(J, W, q, friction, width, facets)
        assert solution.status == SOLVED
        assert signorini_and_coulomb(J, W, q, c, friction, width, facets) <= RESIDUAL


def test_a_body_wedged_between_two_walls_that_both_bounce_ends_with_a_named_status():
    """Two facing normals that both require separation: no impulse does that."""
    J, W = numpy.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, 1.0]]), numpy.eye(2)
    for method in (LEMKE, NEWTON):
        c, solution = solve(J, W, numpy.array([-1.0, 0.2, -1.0, 0.2]), 0.5, PLANE, method=method)
        assert solution.status == RAY
        assert (c == 0.0).all()


@pytest.mark.parametrize("approach", [1e-9, 1e-11, 1e-12, 3e-13, 1e-13, 0.0])
@pytest.mark.parametrize("friction", [3.0, 5.0])
def test_a_contact_that_jams_stands_or_slides_on_but_never_sinks_or_ends_without_answer(approach, friction):
    J = numpy.array([[-0.55706, 0.83047, 0.0042642], [0.83047, 0.55706, 0.0023716]])
    W = numpy.diag([92.132, 92.132, 1.1609549e7])
    A, q = J @ W @ J.T, numpy.array([-approach, 1.0])
    c, found = solve(J, W, q, numpy.full(1, friction), PLANE, 0, NEWTON)
    u = q + A @ c
    assert found.status == SOLVED
    assert u[0] >= -1e-11
    assert abs(u[1]) <= 1e-10 or abs(c).max() <= 1e-10 / A[0, 0], "it stands, or nothing holds it"


@pytest.mark.parametrize("bad", [math.nan, math.inf])
@pytest.mark.parametrize("method", [MODES, LEMKE, NEWTON])
def test_a_velocity_that_is_no_number_ends_with_a_named_status(bad, method):
    J, W = contact_rows([[0.1, -0.1]], PLANE), numpy.eye(3)
    c, solution = solve(J, W, numpy.array([bad, 0.0]), 0.5, PLANE, method=method)
    assert solution.status == CONTACT_NOT_FINITE
    assert (c == 0.0).all()


def test_gauss_seidel_reports_the_residual_that_it_left():
    J, W = contact_rows([[-0.5, -1.0], [0.7, -1.0]], PLANE), numpy.diag([1.0, 1.0, 50.0])
    v = numpy.array([0.1, -1.0, 0.4])
    residuals = [solve(J, W, J @ v, 0.5, PLANE, method=GAUSS_SEIDEL, sweeps=n)[1].residual for n in (2, 10, 40)]
    assert residuals[0] > residuals[1] > residuals[2]
