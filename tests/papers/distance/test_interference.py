"""Interference of convex bodies against closed forms, support functions and a linear program over many directions."""

from __future__ import annotations

import math

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from contact_sim_lab.papers.distance import reference
from contact_sim_lab.papers.distance.convex_body import ConvexBody, box, ellipsoid, half_space, sphere
from contact_sim_lab.papers.distance.convex_intersection import polyhedron
from contact_sim_lab.papers.distance.interference import interference


def random_ellipsoid(random: numpy.random.Generator, spread: float) -> ConvexBody:
    turn = Rotation.random(random_state=int(random.integers(2**31))).as_matrix()
    return ellipsoid(random.uniform(-spread, spread, 3), numpy.exp(random.uniform(-2.0, 0.0, 3)), turn)


def pair_of(body: ConvexBody) -> tuple[numpy.ndarray, numpy.ndarray]:
    return body.centres[0], body.shapes[0]


@settings(max_examples=100)
@given(st.floats(0.01, 10.0), st.floats(0.01, 10.0), st.floats(0.0, 2.0), st.floats(0.0, 6.0))
def test_spheres_overlap_by_their_radii_less_the_distance_of_their_centres(
    radius_1: float, radius_2: float, share: float, angle: float
) -> None:
    apart = share * (radius_1 + radius_2)
    centre = apart * numpy.array([math.cos(angle), math.sin(angle), 0.0])
    found = interference(sphere([0, 0, 0], radius_1), sphere(centre, radius_2))
    expected = min(radius_1 + radius_2 - apart, 2.0 * min(radius_1, radius_2))
    assert found.depth == pytest.approx(expected, abs=1e-8 * (radius_1 + radius_2))
    assert found.residual < 1e-9
    if apart > abs(radius_1 - radius_2) * 1.001 + 1e-6:
        assert found.one_foot_each
        assert found.normal @ centre == pytest.approx(apart, rel=1e-6)
    if apart < abs(radius_1 - radius_2) * 0.999:
        assert found.nested
        assert not found.one_foot_each


def test_concentric_spheres_have_twice_the_smaller_radius_and_no_direction() -> None:
    for radius in (0.2, 0.5, 1.0):
        found = interference(sphere([1, 1, 1], 0.5), sphere([1, 1, 1], radius))
        assert found.depth == pytest.approx(2.0 * min(0.5, radius), rel=1e-12)
        assert not found.one_foot_each


@pytest.mark.parametrize("angle", [20.0, 60.0, 90.0, 120.0])
def test_a_wedge_in_a_half_space(angle: float) -> None:
    depth, half = 0.1, math.radians(angle / 2.0)
    wedge = polyhedron([[math.cos(half), 0, -math.sin(half)], [-math.cos(half), 0, -math.sin(half)]], [0, 0])
    found = interference(wedge, half_space([0, 0, 1], depth))
    # The ball's centre lies a height c above the apex, its radius is c sin(half) and the rest up to the face.
    assert found.depth == pytest.approx(2.0 * depth * math.sin(half) / (1.0 + math.sin(half)), rel=1e-12)
    assert found.depth == pytest.approx(2.0 / 3.0 * depth) or angle != 60.0
    assert not found.one_foot_each
    assert not found.nested


def test_boxes_cylinders_and_half_spaces() -> None:
    faces = interference(box([0, 0, 0], [1, 1, 1]), box([1.7, 0.3, 0.2], [1, 0.5, 1]))
    assert (faces.depth, faces.one_foot_each) == (pytest.approx(0.3, rel=1e-12), True)
    assert faces.normal == pytest.approx([1.0, 0.0, 0.0], abs=1e-9)
    ball = interference(sphere([0, 0, 0], 1.0), half_space([0, 0, 1], -0.7))
    assert (ball.depth, ball.one_foot_each) == (pytest.approx(0.3, rel=1e-12), True)
    sunk = interference(sphere([0, 0, 0], 1.0), half_space([0, 0, 1], 5.0))
    assert (sunk.depth, sunk.nested) == (pytest.approx(2.0, rel=1e-12), True)
    crossed = interference(ellipsoid([0, 0, 0], [math.inf, 1, 1]), ellipsoid([0, 0, 1.9], [1, math.inf, 1]))
    assert crossed.depth == pytest.approx(0.1, rel=1e-11)


@pytest.mark.parametrize("seed", range(12))
def test_ellipsoids_that_touch_the_ball_once_each_have_the_separating_translation(seed: int) -> None:
    random = numpy.random.default_rng(100 + seed)
    found = None
    while found is None or found.depth <= 0.0 or not found.one_foot_each:
        one, other = random_ellipsoid(random, 0.6), random_ellipsoid(random, 0.6)
        found = interference(one, other)
    assert found.residual < 1e-12
    assert found.depth == pytest.approx(reference.separating_translation(pair_of(one), pair_of(other)), rel=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_the_ball_is_the_largest_of_a_linear_program_over_directions(seed: int) -> None:
    random = numpy.random.default_rng(200 + seed)
    found = None
    while found is None or found.depth <= 0.0:
        one, other = random_ellipsoid(random, 0.3), random_ellipsoid(random, 0.3)
        found = interference(one, other)
    radius = reference.largest_ball_radius([pair_of(one), pair_of(other)])
    assert 0.5 * found.depth <= radius
    assert 0.5 * found.depth == pytest.approx(radius, rel=2e-3)


@settings(max_examples=60)
@given(st.integers(0, 2**31 - 1))
def test_order_frame_and_scale_do_not_matter_and_the_overlap_bounds_the_depth(seed: int) -> None:
    random = numpy.random.default_rng(seed)
    bodies = [random_ellipsoid(random, 0.5), random_ellipsoid(random, 0.5)]
    found = interference(*bodies)
    assert found.residual < 1e-9
    assert interference(*bodies[::-1]).depth == pytest.approx(found.depth, rel=1e-9, abs=1e-10)
    turn = Rotation.random(random_state=seed).as_matrix()
    moved = [ellipsoid(0.1 * turn @ b.centres[0] - 4.0, 0.1 * b.half_axes[0], turn @ b.rotations[0]) for b in bodies]
    assert interference(*moved).depth == pytest.approx(0.1 * found.depth, rel=1e-8, abs=1e-10)
    if found.depth > 0.0:
        assert found.depth <= 2.0 * min(body.half_axes.min() for body in bodies) * (1.0 + 1e-12)
        for body in bodies:
            local = body.rotations[0].T @ (found.point - body.centres[0])
            normals = reference.directions(500)
            room = reference.support((numpy.zeros(3), numpy.diag(body.half_axes[0] ** -2.0)), normals) - normals @ local
            assert 0.5 * found.depth <= room.min() * (1.0 + 1e-9)


@pytest.mark.parametrize("gap", [1e-3, 1e-6, 1e-8, 0.0, -1e-8, -1e-6, -1e-3])
def test_the_depth_goes_smoothly_through_touch(gap: float) -> None:
    found = interference(sphere([0, 0, 0], 1.0), sphere([0, 0, 1.5 + gap], 0.5))
    assert found.depth == pytest.approx(-gap, abs=5e-12)
    assert found.normal == pytest.approx([0.0, 0.0, 1.0], abs=1e-4)


def test_an_overlap_without_bound_is_refused() -> None:
    with pytest.raises(ValueError, match="balls of any size"):
        interference(half_space([0, 0, 1], 0.0), half_space([0, 0, 1], 1.0))


def test_a_ball_that_two_curved_bodies_touch_once_each_says_so() -> None:
    one = ellipsoid(
        [-0.1, 0.369, -0.271], [0.692, 0.168, 0.324], Rotation.from_rotvec([0.437, 0.578, 1.072]).as_matrix()
    )
    other = sphere([-0.362, -0.237, -0.188], 0.043)
    found = interference(one, other)
    assert found.depth == pytest.approx(reference.separating_translation(pair_of(one), pair_of(other)), rel=1e-9)
    assert found.one_foot_each
