"""Obstacles against their closed forms."""

import numpy
import pytest

from contact_sim_pkg.excitation.kinds import kind_of

ACROSS = numpy.array([-0.1, 0.0, 0.1])


def road(kind, position=1.0, height=0.02, length=0.3, **keys):
    size = {"depth": height} if kind == "pothole" else {"height": height}
    return kind_of("road", {"kind": kind, "position": position, "length": length, **size, **keys})


def heights(obstacle, *x):
    height = obstacle.heights(numpy.array(x), ACROSS)
    assert height.shape == (len(x), 3)
    assert (height == height[:, :1]).all()
    return height[:, 0].tolist()


def test_a_flat_road_is_zero_everywhere():
    assert not kind_of("road", {"kind": "flat"}).heights(numpy.linspace(-5.0, 5.0, 7), ACROSS).any()


def test_a_bump_is_a_raised_cosine():
    bump = road("bump", 2.0, 0.04, 0.6)
    assert heights(bump, 1.69, 1.7, 1.85, 2.0, 2.15, 2.3) == pytest.approx([0.0, 0.0, 0.02, 0.04, 0.02, 0.0], abs=1e-15)


def test_a_cleat_has_sharp_edges_unless_it_has_flanks():
    assert heights(road("cleat", 1.0, 0.01, 0.05), 0.9749, 0.9751, 1.0249, 1.0251) == [0.0, 0.01, 0.01, 0.0]
    trapezoid = road("cleat", 1.0, 0.01, 0.05, edge=0.01)
    assert heights(trapezoid, 0.975, 0.98, 0.985, 1.0, 1.02) == pytest.approx([0.0, 0.005, 0.01, 0.01, 0.005])


def test_a_step_never_ends():
    assert heights(road("step", 1.0, 0.03, 0.0), 0.999, 1.0, 1e4) == [0.0, 0.03, 0.03]
    assert heights(road("step", 1.0, 0.03, 0.2), 0.9, 1.0, 1.1) == pytest.approx([0.0, 0.015, 0.03])


def test_a_pothole_goes_down():
    assert heights(road("pothole", 1.0, 0.08, 0.4), 0.7, 1.0, 1.3) == [0.0, -0.08, 0.0]


@pytest.mark.parametrize("shape", ["bump", "cleat", "pothole"])
def test_a_row_of_obstacles_repeats_in_both_directions(shape):
    once = road(shape, 1.0, 0.02, 0.3)
    row = road(shape, 1.0, 0.02, 0.3, period=2.0)
    x = numpy.linspace(0.1017, 1.9, 37)  # no node on a sharp edge
    for shift in (-4.0, 0.0, 2.0, 200.0):
        numpy.testing.assert_allclose(row.heights(x + shift, ACROSS), once.heights(x, ACROSS), atol=1e-13)
