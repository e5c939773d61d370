"""Convex bodies: what is inside them, what they refuse."""

from __future__ import annotations

import math

import numpy
import pytest
from scipy.spatial.transform import Rotation

from contact_sim_lab.papers.distance.convex_body import (
    BodyError,
    ConvexBody,
    box,
    ellipsoid,
    half_space,
    quadric,
    sphere,
)
from contact_sim_lab.papers.distance.convex_intersection import intersection, polyhedron

TURN = Rotation.from_euler("xyz", [0.3, -0.7, 1.1]).as_matrix()


def values(body: ConvexBody, point: numpy.ndarray) -> numpy.ndarray:
    off = point - body.centres
    curved = numpy.einsum("ki,kij,kj->k", off, body.shapes, off) - 1.0
    return numpy.concatenate([curved, body.normals @ point - body.offsets])


def test_the_boundary_of_each_body_is_where_its_constraint_is_zero() -> None:
    tip = numpy.array([1.0, 2.0, 3.0]) + TURN @ numpy.array([0.0, 0.5, 0.0])
    for body in (
        ellipsoid([1, 2, 3], [0.3, 0.5, 0.7], TURN),
        ellipsoid([1, 2, 3], [math.inf, 0.5, 0.7], TURN),
        quadric([1, 2, 3], TURN @ numpy.diag([0.0, 4.0, 9.0]) @ TURN.T),
        sphere([1, 2, 3], 0.5),
    ):
        assert values(body, tip) == pytest.approx([0.0], abs=1e-12)
    corner = numpy.array([1.0, 2.0, 3.0]) + TURN @ numpy.array([0.1, -0.2, 0.3])
    assert sorted(abs(values(box([1, 2, 3], [0.1, 0.2, 0.3], TURN), corner)))[:3] == pytest.approx([0.0] * 3, abs=1e-12)
    assert values(half_space([0, 3, 4], 2.0), numpy.array([0.0, 1.2, 1.6])) == pytest.approx([0.0], abs=1e-12)


def test_every_body_has_a_point_inside() -> None:
    thin = polyhedron([[1, 0.001, 0], [-1, 0.001, 0], [0, -1, 0]], [0.0, 0.0, 1.0])
    cap = intersection(sphere([5, 5, 5], 1.0), half_space([0, 0, 1], 4.01))
    lens = intersection(sphere([0, 0, 0], 1.0), sphere([1.999, 0, 0], 1.0), half_space([0, 1, 0], 0.0))
    for body in (thin, cap, lens, half_space([0, 0, 1], -3.0), polyhedron(numpy.eye(3), [1.0, -1.0, 7.0])):
        assert (values(body, body.inside) < 0.0).all()


def test_what_is_no_body_is_refused() -> None:
    refused = (
        (lambda: sphere([0, 0, 0], 0.0), "above 0"),
        (lambda: sphere([0, math.nan, 0], 1.0), "three finite numbers"),
        (lambda: ellipsoid([0, 0, 0], [math.inf] * 3), "not all infinite"),
        (lambda: ellipsoid([0, 0, 0], [1, 1, 1], numpy.ones((3, 3))), "orthogonal"),
        (lambda: quadric([0, 0, 0], numpy.diag([1.0, -1.0, 1.0])), "eigenvalues"),
        (lambda: quadric([0, 0, 0], [[1, 2, 0], [0, 1, 0], [0, 0, 1]]), "symmetric"),
        (lambda: half_space([0, 0, 0], 1.0), "a half-space has the normal"),
        (lambda: polyhedron(numpy.eye(3), [1.0, 2.0]), "must be"),
        (lambda: polyhedron([[1, 0, 0], [-1, 0, 0]], [1.0, -1.0]), "empty or flat"),
        (lambda: polyhedron([[1, 0, 0], [-1, 0, 0]], [1.0, -2.0]), "empty or flat"),
        (lambda: intersection(sphere([0, 0, 0], 1.0), sphere([2.1, 0, 0], 1.0)), "empty or flat"),
        (lambda: intersection(), "at least one"),
    )
    for make, reason in refused:
        with pytest.raises(BodyError, match=reason):
            make()
