"""Nearest boundary point of an ellipsoid: on the surface, along the normal, and the nearest of many."""

from __future__ import annotations

import math

import numpy
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from contact_sim_lab.papers.distance.ellipsoid import supporting_plane
from contact_sim_lab.papers.distance.reference import directions, support

AXIS = st.floats(0.05, 20.0)
PLACE = st.one_of(st.just(0.0), st.floats(-2.0, 2.0), st.floats(-1e-9, 1e-9)).map(
    lambda place: place if abs(place) >= 1e-100 else 0.0  # whose square is a number
)
SPHERE = directions(20_000)


@settings(max_examples=300)
@given(AXIS, AXIS, AXIS, PLACE, PLACE, PLACE)
@example(1.0, 1.0, 1.0, 0.0, 0.0, 0.0)
@example(0.3, 0.5, 1.0, 1e-17, 0.1, 0.2)
@example(0.3, 0.3, 1.0, 0.0, 0.0, 0.7)
@example(0.3, 0.3 * (1.0 + 1e-15), 1.0, 0.0, 1e-12, 0.7)
def test_the_plane_supports_the_ellipsoid_at_the_nearest_point(
    h_1: float, h_2: float, h_3: float, x: float, y: float, z: float
) -> None:
    half_axes, normal = numpy.array([h_1, h_2, h_3]), numpy.empty(3)
    local = half_axes * (x, y, z)
    distance = supporting_plane(half_axes, local, normal)
    assert numpy.linalg.norm(normal) == pytest.approx(1.0, rel=1e-14)
    foot = half_axes**2 * normal / distance
    scale = half_axes.max() + abs(local).max()
    depth = distance - normal @ local
    assert foot == pytest.approx(local + depth * normal, abs=1e-12 * scale)
    sides = support((numpy.zeros(3), numpy.diag(half_axes**-2.0)), SPHERE) - SPHERE @ local
    # No direction supports the ellipsoid nearer to the point: inside that makes it the nearest, outside there is one foot only.
    inside = (local / half_axes) @ (local / half_axes) <= 1.0
    assert depth <= sides.min() + 1e-12 * scale
    assert depth >= -1e-12 * scale if inside else depth <= 1e-12 * scale


def test_along_a_cylinder_the_nearest_point_is_that_of_its_section() -> None:
    normal, section = numpy.empty(3), numpy.empty(3)
    distance = supporting_plane(numpy.array([math.inf, 1.0, 2.0]), numpy.array([50.0, 0.3, 0.9]), normal)
    flat = supporting_plane(numpy.array([1e7, 1.0, 2.0]), numpy.array([0.0, 0.3, 0.9]), section)
    assert normal == pytest.approx(section, abs=1e-13)
    assert distance == pytest.approx(flat, rel=1e-14)
