"""Travel against the trapezoidal rule, which is exact for piecewise linear speed."""

import numpy
import pytest
from hypothesis import given
from hypothesis import strategies as st

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.travel import Travel

POINTS = [(0.5, 10.0), (1.0, 20.0), (2.0, -20.0), (4.0, 0.0)]


def integrated(points, time):
    """Integral of the speed from 0 to `time` [s] by the trapezoidal rule between all breakpoints."""
    times, speeds = zip(*points, strict=True)
    low, high = min(0.0, time), max(0.0, time)
    knots = numpy.unique([low, high, *(t for t in times if low < t < high)])
    area = numpy.trapezoid if hasattr(numpy, "trapezoid") else numpy.trapz
    return float(numpy.sign(time) * area(numpy.interp(knots, times, speeds), knots))


@given(st.floats(-2.0, 8.0))
def test_position_is_the_integral_of_the_speed_from_time_zero(time):
    assert Travel(POINTS).position(time) == pytest.approx(integrated(POINTS, time), abs=1e-12)


def test_constant_speed_gives_distance_speed_times_time():
    assert Travel([(0.0, 25.0)]).position(3.0) == 75.0


@given(st.floats(0.0, 4.0), st.floats(0.01, 2.0))
def test_extent_holds_every_position_between_and_is_tight(start, length):
    travel = Travel(POINTS)
    low, high = travel.extent(start, start + length)
    path = [travel.position(t) for t in numpy.linspace(start, start + length, 400)]
    assert low <= min(path) + 1e-12
    assert high >= max(path) - 1e-12
    assert low >= min(path) - 1e-3
    assert high <= max(path) + 1e-3


def test_extent_sees_the_turning_point_inside():
    # from 20 m/s at 1 s to -20 m/s at 2 s: turns back at 1.5 s, 5 m ahead
    low, high = Travel([(1.0, 20.0), (2.0, -20.0)]).extent(1.0, 2.0)
    assert (low, high) == (20.0, pytest.approx(25.0))


def test_speed_interpolates_and_stays_constant_outside():
    travel = Travel(POINTS)
    assert [travel.speed(t) for t in (0.0, 0.75, 1.5, 9.0)] == [10.0, 15.0, 0.0, 0.0]


def test_travel_and_speed_at_many_times_are_those_at_each():
    travel, times = Travel(POINTS), numpy.linspace(-1.0, 6.0, 29)  # on the points and between
    places, speeds = travel.along(times)
    assert places.tolist() == [travel.position(t) for t in times]
    assert speeds.tolist() == [travel.speed(t) for t in times]


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([], "no point"),
        ([(0.0, 1.0), (0.0, 2.0)], "point 1 .* not after"),
        ([(0.0, float("nan"))], "point 0 .* finite"),
        ([(0.0, 151.0)], "within"),
    ],
)
def test_a_bad_programme_is_refused(points, message):
    with pytest.raises(ExcitationError, match=message):
        Travel(points)
