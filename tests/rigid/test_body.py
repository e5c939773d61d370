"""Gaps and Jacobians of points over a ground, inverse inertia, and free rotation."""

import itertools
import math

import numpy
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from contact_sim_pkg.rigid.bodies.body import (
    box,
    contact_rows,
    fill_inverse_inertia,
    height_field,
    placed,
    regular_block,
    slope,
    sphere,
)
from contact_sim_pkg.rigid.rotation import free_rotation, gyroscopic_step, rotate_by


def rows_of(body, ground, motion):
    points, coordinates = len(body.points), len(body.load)
    gap, J = numpy.zeros(points), numpy.zeros((points * body.width, coordinates))
    contact_rows(body, ground, motion, gap, J)
    return gap, J


@pytest.mark.parametrize("theta", [0.0, 0.2, 0.7, 1.4])
def test_the_lowest_corner_of_the_block_has_the_gap_and_the_jacobian_of_the_paper(theta):
    side, height = 0.1, 0.13
    block = regular_block(side, 1.0, 0.3, 0.3)
    gap, J = rows_of(block, slope(2), placed(block, [0.4, height], numpy.zeros(3), angle=theta))
    radius = side / math.sqrt(2.0)
    lowest = int(numpy.argmin(gap - 1e-12 * numpy.arange(4)[::-1])) if theta == 0.0 else int(numpy.argmin(gap))
    assert gap[lowest] == pytest.approx(height - radius * math.cos(math.pi / 4 - theta), abs=1e-15)
    assert J[2 * lowest] == pytest.approx([0.0, 1.0, -radius * math.sin(math.pi / 4 - theta)], abs=1e-15)
    assert J[2 * lowest + 1] == pytest.approx([1.0, 0.0, radius * math.cos(math.pi / 4 - theta)], abs=1e-15)


def moved(body, motion, rate, time):
    turn = Rotation.from_rotvec(numpy.asarray(rate[3:]) * time).as_matrix() @ motion.rotation
    return placed(body, motion.position + time * numpy.asarray(rate[:3]), numpy.zeros(6), rotation=turn)


def test_the_normal_rows_of_a_box_are_the_rate_of_its_gaps_on_a_slope():
    body = box((0.2, 0.3, 0.1), 2.0, 0.4, 0.2)
    motion = placed(
        body, [0.1, 0.2, 0.5], numpy.zeros(6), rotation=Rotation.from_euler("xyz", [0.3, -0.2, 0.7]).as_matrix()
    )
    rate = numpy.array([0.3, -0.2, 0.5, 1.0, -2.0, 0.5])
    _gap, J = rows_of(body, slope(3, 0.2), motion)
    after, before = (rows_of(body, slope(3, 0.2), moved(body, motion, rate, t))[0] for t in (1e-5, -1e-5))
    assert J[0::3] @ rate == pytest.approx((after - before) / 2e-5, abs=1e-8)


def test_a_height_field_that_is_a_plane_gives_what_the_plane_gives():
    body = sphere(0.05, 1.0, 0.3, 0.8)
    motion = placed(body, [0.2, -0.1, 0.4], numpy.zeros(6))
    nodes = numpy.linspace(-1.0, 1.0, 21)
    heights = math.tan(0.2) * nodes
    gap, J = rows_of(body, slope(3, 0.2), motion)
    field_gap, field_J = rows_of(body, height_field(3, heights, -1.0, 0.1), motion)
    assert field_gap == pytest.approx(gap, abs=1e-14)
    assert field_J == pytest.approx(J, abs=1e-14)


def test_the_inverse_inertia_in_world_axes_is_that_of_the_turned_tensor():
    body = box((0.2, 0.3, 0.1), 2.0, 0.4, 0.2)
    R = Rotation.from_euler("xyz", [0.3, -0.2, 0.7]).as_matrix()
    W = numpy.zeros((6, 6))
    fill_inverse_inertia(body, R, W)
    assert W[3:, 3:] == pytest.approx(numpy.linalg.inv(R @ numpy.diag(body.inertia) @ R.T), rel=1e-12)


def test_a_rotation_about_a_spin_is_that_of_scipy():
    R = Rotation.from_euler("xyz", [0.3, -0.2, 0.7]).as_matrix()
    expected = R @ Rotation.from_rotvec(0.37 * numpy.array([1.0, -2.0, 3.0])).as_matrix()
    rotate_by(R, 1.0, -2.0, 3.0, 0.37)
    assert pytest.approx(expected, abs=1e-15) == R


def test_free_rotation_keeps_energy_and_the_size_of_the_angular_momentum_at_a_long_step():
    inertia, w = numpy.array([1.0, 2.0, 2.7]), numpy.array([0.1, 8.0, 0.2])
    energy, momentum = inertia @ w**2, numpy.linalg.norm(inertia * w)
    for _ in range(1000):
        w = numpy.array(gyroscopic_step(*inertia, *w, 0.05))
    assert inertia @ w**2 == pytest.approx(energy, rel=1e-12)
    assert numpy.linalg.norm(inertia * w) == pytest.approx(momentum, rel=1e-12)


@pytest.mark.parametrize("torque", [(0.0, 0.0, 0.0), (0.4, -1.1, 0.7)])
def test_the_error_of_free_rotation_falls_with_the_sixth_power_of_the_step(torque):
    """Euler's equations in body axes with R' = R [w x], under a torque that is constant in the world, by scipy."""
    inertia, start, duration = numpy.array([1.0, 2.0, 2.7]), numpy.array([1.0, 3.0, -0.8]), 1.0

    def rate(_time, state):
        R, w = state[:9].reshape(3, 3), state[9:]
        spin_matrix = numpy.array([[0.0, -w[2], w[1]], [w[2], 0.0, -w[0]], [-w[1], w[0], 0.0]])
        spin_rate = (R.T @ torque - numpy.cross(w, inertia * w)) / inertia
        return numpy.concatenate([(R @ spin_matrix).ravel(), spin_rate])

    first = numpy.concatenate([numpy.eye(3).ravel(), start])
    exact = solve_ivp(rate, (0.0, duration), first, method="DOP853", rtol=1e-13, atol=1e-14).y[:, -1]

    def error(steps):
        R, w = numpy.eye(3), tuple(start)
        for _ in range(steps):
            w = free_rotation(R, inertia, numpy.array([0.0, 0.0, 0.0, *torque]), *w, duration / steps)
        return abs(numpy.concatenate([R.ravel(), w]) - exact).max()

    errors = [error(steps) for steps in (4, 8, 16)]
    orders = [math.log2(coarse / fine) for coarse, fine in itertools.pairwise(errors)]
    assert min(orders) > 5.5, (errors, orders)
    assert errors[-1] < 1e-6
