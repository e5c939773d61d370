"""The ellipse as series over the yaw, beside the elliptic root."""

import math

import numpy
import pytest
from tests.rigs.roller.bench import BENDING, CURVATURES, MODULUS, ROLLER

from contact_sim_pkg.rigs.roller.theory.ellipse import contact_of_rollers
from contact_sim_pkg.rigs.roller.theory.moments import moments
from contact_sim_pkg.rigs.roller.theory.motion import accelerations
from contact_sim_pkg.rigs.roller.theory.parameters import Curvatures
from contact_sim_pkg.rigs.roller.theory.yaw_ellipse import ellipse_at_yaw, empty_fit

CASES = [
    CURVATURES,
    Curvatures(3.0, 0.0, 3.0001, 0.0),
    Curvatures(20.0, 0.0, 200.0, 0.0),
    Curvatures(50.0, 50.0, 1.0, 1.0),
]


def wanted(curvatures, yaw, load):
    contact = contact_of_rollers(curvatures, yaw, MODULUS, load)
    a, b = contact.along_x, contact.along_y
    return a * b, (a * a - b * b) * math.sin(2.0 * contact.angle), contact.approach, a * a + b * b


@pytest.mark.parametrize("curvatures", CASES)
@pytest.mark.parametrize("load", [1.0, 300.0])
def test_the_series_follow_a_yaw_that_wanders_to_rounding(curvatures, load):
    """Small steps, and leaps that leave the interval; the exact root is tested elsewhere."""
    random, yaw, fit = numpy.random.default_rng(4), 0.0, empty_fit()
    for number in range(300):
        yaw += random.normal(0.0, 0.5 if number % 50 == 49 else 0.01)
        found = [load ** (2.0 / 3.0) * value for value in ellipse_at_yaw(curvatures, MODULUS, yaw, fit)]
        product, turned, approach, size = wanted(curvatures, yaw, load)
        assert found[0] == pytest.approx(product, rel=3e-14)
        assert found[1] == pytest.approx(turned, abs=3e-14 * size)
        assert found[2] == pytest.approx(approach, rel=3e-14)


def test_a_slender_ellipse_is_as_exact_as_its_root():
    """b/a = 0.002: the root itself keeps 1e-12 of the axes."""
    slender, fit = Curvatures(100.0, 0.0, 0.01, 0.0), empty_fit()
    for yaw in numpy.linspace(-0.3, 0.3, 101):
        product, _turned, approach, _size = wanted(slender, yaw, 1.0)
        found = ellipse_at_yaw(slender, MODULUS, yaw, fit)
        assert (found.product, found.approach) == pytest.approx((product, approach), rel=1e-11)


def test_the_accelerations_of_many_instants_are_those_of_the_equations():
    """Curvatures that change on the way; the moments by the exact root."""
    random = numpy.random.default_rng(7)
    curvatures = numpy.repeat(numpy.array([CURVATURES, Curvatures(90.0, 40.0, 180.0, 5.0)]), 4, axis=0)
    states, loads, found = random.normal(0.0, 0.01, (8, 4)), random.uniform(0.0, 300.0, 8), numpy.zeros((8, 2))
    loads[3] = 0.0
    accelerations(ROLLER, curvatures, BENDING, MODULUS, loads, states, found)
    gyro = ROLLER.inertia_spin * ROLLER.spin
    for k in range(8):
        pushed = moments(ROLLER, Curvatures(*curvatures[k]), BENDING, MODULUS, loads[k], states[k, 0], states[k, 1])
        about_y = pushed.tilt - 60.0 * states[k, 0] - gyro * states[k, 3]
        about_z = pushed.yaw - 50.0 * states[k, 1] + gyro * states[k, 2]
        assert found[k] == pytest.approx((about_y / 2e-5, about_z / 2e-5), rel=1e-11, abs=1e-9)
