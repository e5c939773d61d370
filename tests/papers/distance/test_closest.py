"""Minimum distance of convex bodies against closed forms, SLSQP with 40 digits, and a linear-programming solver."""

from __future__ import annotations

import math

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from contact_sim_lab.papers.distance import reference
from contact_sim_lab.papers.distance.closest import CONVERGED, minimum_distance, minimum_distance_from
from contact_sim_lab.papers.distance.convex_body import ConvexBody, box, ellipsoid, half_space, sphere
from contact_sim_lab.papers.distance.convex_intersection import intersection, polyhedron


def random_ellipsoid(random: numpy.random.Generator, centre: numpy.ndarray) -> ConvexBody:
    turn = Rotation.random(random_state=int(random.integers(2**31))).as_matrix()
    return ellipsoid(centre, numpy.exp(random.uniform(-3.0, 0.0, 3)), turn)


@settings(max_examples=80)
@given(st.floats(1e-3, 1e3), st.floats(1e-3, 1e3), st.floats(1e-6, 1e3), st.floats(0.0, 6.0), st.floats(-1.0, 1.0))
def test_spheres_are_as_far_apart_as_their_centres_less_the_radii(
    radius_1: float, radius_2: float, gap: float, angle: float, height: float
) -> None:
    direction = numpy.array([math.cos(angle), math.sin(angle), height])
    direction /= numpy.linalg.norm(direction)
    centre = numpy.array([0.3, -0.2, 0.1])
    found = minimum_distance(
        sphere(centre, radius_1), sphere(centre + (radius_1 + radius_2 + gap) * direction, radius_2)
    )
    size = radius_1 + radius_2 + gap
    if gap > 1e-6 * size:
        assert found.distance == pytest.approx(gap, abs=1e-11 * size)
        assert found.point_1 == pytest.approx(centre + radius_1 * direction, abs=1e-7 * size)
        assert found.residual < 10.0 * CONVERGED


@pytest.mark.parametrize("seed", range(6))
def test_ellipsoids_have_the_distance_of_slsqp_and_40_digits(seed: int) -> None:
    random = numpy.random.default_rng(seed)
    bodies = [random_ellipsoid(random, random.uniform(-1.0, 1.0, 3) + k * numpy.array([2.5, 0, 0])) for k in (0, 1)]
    pairs = [(body.centres[0], body.shapes[0]) for body in bodies]
    found = minimum_distance(*bodies)
    assert found.distance == pytest.approx(reference.ellipsoid_distance(*pairs), rel=1e-13)
    assert found.residual < 1e-13
    for point, (centre, shape) in zip((found.point_1, found.point_2), pairs, strict=True):
        assert (point - centre) @ shape @ (point - centre) == pytest.approx(1.0, abs=1e-12)


def test_boxes_by_face_edge_and_corner() -> None:
    unit, turned = box([0, 0, 0], [1, 1, 1]), Rotation.from_euler("z", 45, degrees=True).as_matrix()
    corner = Rotation.align_vectors([[0, 0, -1]], [[1, 1, 1]])[0].as_matrix()
    assert minimum_distance(unit, box([2.5, 0.4, 0], [1, 1, 1])).distance == pytest.approx(0.5, rel=1e-12)
    assert minimum_distance(unit, box([3, 4, 0], [1, 1, 1])).distance == pytest.approx(math.sqrt(5.0), rel=1e-12)
    assert minimum_distance(unit, box([3, 3, 3], [1, 1, 1])).distance == pytest.approx(math.sqrt(3.0), rel=1e-12)
    edge = minimum_distance(unit, box([3, 0, 0], [1, 1, 1], turned))
    assert edge.distance == pytest.approx(2.0 - math.sqrt(2.0), rel=1e-12)
    assert edge.point_1[0] == pytest.approx(1.0, abs=1e-12)
    tip = minimum_distance(half_space([0, 0, 1], 0.0), box([0.2, 0.1, 2], [1, 1, 1], corner))
    assert tip.distance == pytest.approx(2.0 - math.sqrt(3.0), rel=1e-12)
    assert tip.point_2 == pytest.approx([0.2, 0.1, 2.0 - math.sqrt(3.0)], abs=1e-9)


def test_bodies_without_bounds_and_what_two_bodies_share() -> None:
    crossed = minimum_distance(ellipsoid([0, 0, 0], [math.inf, 1, 1]), ellipsoid([0, 0, 2.5], [1, math.inf, 1]))
    assert crossed.distance == pytest.approx(0.5, rel=1e-12)
    assert crossed.point_1 == pytest.approx([0.0, 0.0, 1.0], abs=1e-7)
    assert minimum_distance(half_space([0, 0, 1], 0.0), half_space([0, 0, -1], -0.3)).distance == pytest.approx(0.3)
    half_ball = intersection(sphere([0, 0, 0], 1.0), half_space([0, 0, 1], 0.0))
    rim = minimum_distance(half_ball, sphere([2, 0, 1], 0.5))
    assert rim.distance == pytest.approx(math.sqrt(2.0) - 0.5, rel=1e-12)
    assert rim.point_1 == pytest.approx([1.0, 0.0, 0.0], abs=1e-9)
    wedge = polyhedron([[1, 0, -1], [-1, 0, -1]], [0, 0])
    assert minimum_distance(wedge, half_space([0, 0, 1], -0.2)).distance == pytest.approx(0.2, rel=1e-10)


def test_overlapping_bodies_have_no_distance_and_share_the_point() -> None:
    for one, other in (
        (sphere([0, 0, 0], 1.0), sphere([1.0, 0, 0], 0.5)),
        (sphere([0, 0, 0], 1.0), sphere([0, 0, 0], 0.5)),
        (box([0, 0, 0], [1, 1, 1]), ellipsoid([0.9, 0.9, 0.9], [0.5, 2, 0.5])),
    ):
        found = minimum_distance(one, other)
        assert (found.distance, found.overlap) == (0.0, True)
        assert found.point_1 == pytest.approx(found.point_2, abs=1e-8)
        for body in (one, other):
            off = found.point_1 - body.centres
            assert (numpy.einsum("ki,kij,kj->k", off, body.shapes, off) < 1.0 + 1e-7).all()
            assert (body.normals @ found.point_1 < body.offsets + 1e-7).all()


@pytest.mark.parametrize("gap", [1e-3, 1e-5, 1e-7])
def test_a_small_gap_keeps_its_digits(gap: float) -> None:
    found = minimum_distance(sphere([0, 0, 0], 1.0), sphere([0, 0, 1.5 + gap], 0.5))
    assert found.distance == pytest.approx(gap, abs=2e-12)
    assert not found.overlap


@settings(max_examples=30)
@given(st.integers(0, 2**31 - 1))
def test_every_start_and_either_order_find_the_same_distance_in_any_frame(seed: int) -> None:
    random = numpy.random.default_rng(seed)
    one = random_ellipsoid(random, random.uniform(-1.0, 1.0, 3))
    other = random_ellipsoid(random, random.uniform(-1.0, 1.0, 3) + numpy.array([3.0, 0.0, 0.0]))
    first = minimum_distance(one, other)
    for start in range(1, 4):
        assert minimum_distance_from(one, other, start).distance == pytest.approx(first.distance, rel=1e-10)
    assert minimum_distance(other, one).distance == pytest.approx(first.distance, rel=1e-12)
    turn = Rotation.random(random_state=seed).as_matrix()
    moved = [
        ellipsoid(7.0 * turn @ b.centres[0] + 5.0, 7.0 * b.half_axes[0], turn @ b.rotations[0]) for b in (one, other)
    ]
    assert minimum_distance(*moved).distance == pytest.approx(7.0 * first.distance, rel=1e-11)
