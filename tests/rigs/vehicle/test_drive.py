"""Heights between the ends of a segment."""

import numpy
import pytest
from scipy.interpolate import CubicHermiteSpline

from contact_sim_pkg.integrate.drive import Drive
from contact_sim_pkg.rigs.vehicle.motion.ground import ground_at

START, LENGTH = 2.0, 0.25
ENDS = numpy.array([START, START + LENGTH])


@pytest.mark.parametrize("part", [0.0, 0.2, 0.5, 0.9, 1.0])
def test_heights_with_rates_are_the_cubic_of_both(part):
    road, road_rate, cushion, cushion_rate = [0.1, 0.3], [1.0, -2.0], [0.02, 0.01], [0.0, 0.5]
    drive = Drive(START, LENGTH, *road, *cushion, 0.0, 0.0, 0.0, 0.0, None, None, *road_rate, *cushion_rate)
    time = START + part * LENGTH
    height, rate, foam, foam_rate, *_others = ground_at(drive, time, 9.81)
    for value, slope, ends, rates in ((height, rate, road, road_rate), (foam, foam_rate, cushion, cushion_rate)):
        spline = CubicHermiteSpline(ENDS, ends, rates)
        assert value == pytest.approx(float(spline(time)), abs=1e-14)
        assert slope == pytest.approx(float(spline.derivative()(time)), abs=1e-12)


def test_heights_without_rates_are_straight():
    drive = Drive(START, LENGTH, 0.1, 0.3, 0.0, 0.0, 0.0, 0.0, 2.0, 4.0)
    ground = ground_at(drive, START + 0.25 * LENGTH, 9.81)
    assert (ground.height, ground.height_rate, ground.acceleration_z) == pytest.approx((0.15, 0.8, 2.5))
