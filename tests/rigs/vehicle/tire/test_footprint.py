"""The effective height of the road: under the footprint, from one field to the next, and what touches beyond a grid."""

import math

import numpy
import pytest

from contact_sim_pkg.compiled.held import hold
from contact_sim_pkg.pressure.field.halfspace import make_half_space
from contact_sim_pkg.pressure.field.window import make_part
from contact_sim_pkg.rigs.vehicle.motion.heights import effective_between
from contact_sim_pkg.rigs.vehicle.tire.body import TireForm
from contact_sim_pkg.rigs.vehicle.tire.footprint import (
    clear_beyond,
    effective_heights,
    hertz_weights,
    level_under,
    mean_slope,
    touches_beyond,
)

CELL = 0.005  # [m]
ROWS, COLS = 161, 41
ALONG = CELL * numpy.arange(ROWS)[:, None] * numpy.ones(COLS)  # [m] of the nodes
ACROSS = CELL * (numpy.arange(COLS) - COLS // 2) * numpy.ones((ROWS, 1))
WEIGHTS = hertz_weights(0.06, 0.08, CELL, CELL, COLS)
PLACES = numpy.linspace(0.3, 0.5, 777)  # [m], most of them between nodes


def heights(road):
    out, slopes = numpy.empty(len(PLACES)), numpy.empty(len(PLACES))
    assert effective_heights(road.astype(numpy.float32), 0, CELL, WEIGHTS, PLACES, out, slopes)
    return out


def test_the_slope_is_that_of_the_height():
    road = (0.01 * numpy.sin(40.0 * ALONG)).astype(numpy.float32)
    places = numpy.linspace(0.3, 0.5, 20001)
    height, slope = numpy.empty(len(places)), numpy.empty(len(places))
    assert effective_heights(road, 0, CELL, WEIGHTS, places, height, slope)
    assert slope == pytest.approx(numpy.gradient(height, places, edge_order=2), abs=1e-5)
    assert slope.max() > 0.01


def test_a_plane_has_the_height_under_the_wheel():
    assert heights(0.2 * ALONG + 0.1 * ACROSS + 0.01) == pytest.approx(0.2 * PLACES + 0.01, abs=1e-7)


def moments(power):
    """Difference of the ``power`` of 1.2 and 0.8: footprints a fifth of the approach apart from the standing one."""
    return 1.2**power - 0.8**power


def test_a_parabola_is_raised_as_far_as_two_hertz_contacts_say():
    """The mean of x**2 over sqrt(s - (x/a)**2 - (y/b)**2) is s a**2 / 5, its weight s**1.5; nodes leave 1 % of it."""
    mean = 0.06**2 / 5.0 * moments(2.5) / moments(1.5)
    assert heights(0.5 * (ALONG - 0.4) ** 2) == pytest.approx(
        0.5 * (PLACES - 0.4) ** 2 + 0.5 * mean, abs=0.01 * mean + 0.125 * CELL**2
    )


def test_a_hertz_contact_answers_to_a_road_as_to_its_own_curvature():
    """A road with the curvature c (x**2 + y**2) / 2 makes 1/R of a sphere 1/R - c; at a constant load its
    approach, (3 F / 4 E)**(2/3) R**(-1/3), then falls by c a**2 / 3. The range of the weights leaves 1 %, the nodes 1 %."""
    a, cols = 0.06, 41
    weights = hertz_weights(a, a, CELL, CELL, cols)
    x = CELL * (numpy.arange(len(weights)) - len(weights) // 2)
    y = CELL * (numpy.arange(cols) - cols // 2)
    raised = float((weights * 0.5 * (x[:, None] ** 2 + y**2)).sum())
    assert raised == pytest.approx(a**2 / 3.0, rel=0.02)


def test_a_wall_comes_without_jerks_between_the_nodes():
    """Along x a Hertz contact s weighs as s - (x/a)**2: two of them evenly where both are, 0.4 / 0.7987 / a."""
    height = heights(0.1 * (ALONG > 0.4))
    u = (0.4 + 0.5 * CELL - PLACES) / 0.06

    def beyond_u(s):
        at = numpy.clip(u, -math.sqrt(s), math.sqrt(s))
        return 2.0 / 3.0 * s**1.5 - s * at + at**3 / 3.0

    whole = 4.0 / 3.0 * moments(1.5)
    assert height == pytest.approx(0.1 * (beyond_u(1.2) - beyond_u(0.8)) / whole, abs=0.002)
    assert numpy.diff(height).max() / numpy.diff(PLACES)[0] < 1.1 * 0.1 * 0.4 / whole / 0.06


def test_a_lattice_that_does_not_hold_the_footprint_is_reported():
    out, slope = numpy.empty(1), numpy.empty(1)
    for place in (0.05, 0.75):
        flat = numpy.zeros((ROWS, COLS), dtype=numpy.float32)
        assert not effective_heights(flat, 0, CELL, WEIGHTS, numpy.array([place]), out, slope)


def beyond(road, approach, pressure):
    """On a grid of 40 x 20 cells around the wheel at 0.4 m, of which ``pressure`` holds the middle."""
    form = TireForm(0.3, 0.5)
    return touches_beyond(road.astype(numpy.float32), 0, form, 60, 0.4, approach, 2e6, CELL, CELL, pressure, 40, 20)


def test_a_wall_touches_beyond_the_grid_where_it_is_higher_than_the_tire():
    none = numpy.zeros((20, 20))
    crown = 0.5 * (15 * CELL) ** 2 / 0.3  # at the first node behind the wall, 15 cells ahead, on the middle line nearly
    for height, touches in ((0.9 * crown - 0.002, False), (1.1 * crown - 0.002, True)):
        assert beyond(height * (ALONG > 0.4 + 14.5 * CELL), 0.002, none) is touches


def test_a_wall_inside_the_grid_does_not_touch_beyond_it():
    inside = 0.05 * ((ALONG > 0.4) & (ALONG < 0.42))
    assert not beyond(inside, 0.002, numpy.zeros((20, 20)))


def test_what_the_pressure_pushes_away_does_not_touch():
    """A load P on one cell sinks a place at a distance r by P / (pi E* r)."""
    wall = 0.0200 * (ALONG > 0.4 + 14.5 * CELL)
    crown = 0.5 * (15 * CELL) ** 2 / 0.3 + 0.5 * (0.5 * CELL) ** 2 / 0.5
    depth = 0.0200 - crown
    pressure = numpy.zeros((20, 20))
    distance = 15 * CELL
    for share, touches in ((0.95, True), (1.05, False)):
        pressure[10, 9:11] = 0.5 * share * depth * math.pi * 2e6 * distance / CELL**2
        assert beyond(wall * (abs(ACROSS) < 2 * CELL), 0.0, pressure) is touches


def between(smooth, offset, offset_end):
    height, rate = numpy.empty_like(smooth), numpy.empty_like(smooth)
    effective_between(smooth, numpy.zeros_like(smooth), (offset, offset_end, 0.0), 1.0, height, rate)
    return height


@pytest.mark.parametrize(("offset", "offset_end", "bend"), [(0.01, 0.01, 0.02), (0.0, 0.3, -0.1), (0.0, -0.1, 0.05)])
def test_the_rate_is_that_of_the_height_on_a_parabola_of_corrections(offset, offset_end, bend):
    time = numpy.linspace(0.0, 0.5, 2001)
    smooth, rate = 0.03 * numpy.sin(7.0 * time) - 0.1 * time, 0.21 * numpy.cos(7.0 * time) - 0.1
    height, found = numpy.empty_like(time), numpy.empty_like(time)
    effective_between(smooth, rate, (offset, offset_end, bend), 0.5, height, found)
    assert found == pytest.approx(numpy.gradient(height, time, edge_order=2), abs=1e-4)
    straight = numpy.empty_like(time)
    effective_between(smooth, rate, (offset, offset_end, 0.0), 0.5, straight, found)
    assert straight[1000] - height[1000] == pytest.approx(0.25 * bend)
    assert (straight[0], straight[-1]) == pytest.approx((height[0], height[-1]))


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


def test_a_correction_the_same_way_as_the_road_leaves_its_form():
    height = between(EDGE, 0.0, -0.1)
    assert height == pytest.approx(EDGE - 0.1 * PLACE)


def test_a_bump_inside_the_interval_is_kept():
    bump = 0.03 * numpy.sin(numpy.pi * PLACE)
    assert between(bump, 0.01, 0.01) == pytest.approx(bump + 0.01)


def clear(road, approach, pressure):
    """What the bound says of that grid."""
    whole = hold(make_part(make_half_space(40, 20, CELL, CELL, 2e6), 40, 20))
    none, form = numpy.zeros(40), TireForm(0.3, 0.5)
    return clear_beyond(whole, none, road.astype(numpy.float32), 0, form, 60, 0.4, approach, pressure, 40)


def test_a_bound_says_of_no_road_that_touches_that_it_does_not():
    """Beside a loaded strip the surface has sunk: the road may stand above it and be clear still."""
    strip = numpy.zeros((20, 10))
    strip[5:15, 2:8] = 2e5
    beside, found = abs(ACROSS) > 0.03, []
    for height in numpy.linspace(-2e-3, 6e-3, 81):
        road = numpy.where(beside, height, -0.01)
        found.append((clear(road, 0.002, strip), beyond(road, 0.002, strip), clear(road, 0.002, 0.0 * strip)))
    assert not any(bound and touches for bound, touches, _none in found)
    first = [[bool(row[k]) for row in found].index(wanted) for k, wanted in ((0, False), (1, True), (2, False))]
    assert first[2] + 5 < first[0] <= first[1]


def test_a_grid_that_the_road_does_not_hold_is_not_said_to_be_clear():
    whole, none = hold(make_part(make_half_space(40, 20, CELL, CELL, 2e6), 40, 20)), numpy.zeros((20, 20))
    flat = numpy.full((30, 20), -1.0, dtype=numpy.float32)
    assert not clear_beyond(
        whole, numpy.zeros(whole.value.half_space.rows), flat, 0, TireForm(0.3, 0.5), 0, 0.1, 0.002, none, 40
    )


def test_the_slope_under_a_field_is_that_of_its_centre_on_a_parabola():
    pressure = numpy.zeros((7, 5))
    pressure[1, 2], pressure[4, 3] = 1.0, 3.0
    expected = (1.0 * (-0.01 + CELL) + 3.0 * (-0.01 + 4 * CELL)) / 4.0 / 0.3
    assert mean_slope(TireForm(0.3, 0.5), pressure, -0.01, CELL) == pytest.approx(expected, rel=1e-14)
    assert mean_slope(TireForm(0.3, 0.5), 0.0 * pressure, -0.01, CELL) == 0.0


@pytest.mark.parametrize(("place", "level"), [((9, 9), True), ((10, 12), False), ((13, 10), False), ((14, 14), True)])
def test_what_a_field_rests_on_is_level_with_the_nodes_beside_it(place, level):
    road, pressure = numpy.full((30, 20), 0.25, dtype=numpy.float32), numpy.zeros((8, 6))
    road[place] = 0.26
    pressure[1:4, 1:3] = 1.0  # on nodes 11 to 13, 11 to 12; 10 to 14, 10 to 13 with those beside
    found = level_under(road, 10, 10, pressure)
    assert found == 0.25 if level else math.isnan(found)
    assert math.isnan(level_under(road, 10, 10, 0.0 * pressure))
