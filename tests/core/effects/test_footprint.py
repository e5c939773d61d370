"""The effective height of the road from one field to the next."""

import numpy
import pytest

from contact_sim_pkg.core.effects.footprint import effective_between


def between(smooth, offset, offset_end):
    height = numpy.empty_like(smooth)
    effective_between(smooth, offset, offset_end, height)
    return height


PLACE = numpy.linspace(0.0, 1.0, 11)
EDGE = -0.5 * (3.0 * PLACE**2 - 2.0 * PLACE**3)  # [m] an S-curve down by half a metre


def test_it_has_the_heights_of_both_instants():
    height = between(EDGE, 0.02, 0.3)
    assert (height[0], height[-1]) == pytest.approx((0.02, -0.2))


def test_a_straight_road_is_left_alone():
    assert between(0.1 * PLACE, 0.01, 0.03) == pytest.approx(0.01 + 0.12 * PLACE)


def test_an_edge_does_not_stand_out_over_both_ends():
    height = between(EDGE, 0.0, 0.5)  # both ends at 0: the tire still stands on the edge
    assert abs(height).max() < 1e-12


def test_a_bump_inside_the_interval_is_kept():
    bump = 0.03 * numpy.sin(numpy.pi * PLACE)
    assert between(bump, 0.01, 0.01) == pytest.approx(bump + 0.01)
