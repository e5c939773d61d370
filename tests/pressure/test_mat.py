"""Pressure that a mat would show under one contact force, against closed forms of a bed of springs."""

import numpy
import pytest

from contact_sim_pkg.laws.parameters import NormalElastic
from contact_sim_pkg.pressure.mat import paraboloid_gap, spread_force

SIDE = 0.5e-3  # [m]
FORCE, APPROACH = 700.0, 0.02  # [N], [m]


def spread(exponent, radius_x=0.3, radius_y=0.2, approach=APPROACH, force=FORCE):
    """Gap and pressure on cells of `SIDE` whose middle one lies under the crown."""
    x = SIDE * numpy.arange(-260, 261)
    gap = paraboloid_gap(x, x, radius_x, radius_y)
    elastic = NormalElastic(coefficient=1e5, exponent=exponent)
    return x, gap, spread_force(force, approach, elastic, gap, SIDE**2)


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0, 3.0])
def test_a_paraboloid_leaves_the_pressure_of_its_bed(exponent):
    """p = n F/(pi a b) (1 - x^2/a^2 - y^2/b^2)^(n-1) within the ellipse a^2 = 2 R1 d, b^2 = 2 R2 d."""
    x, _, pressure = spread(exponent)
    a_squared, b_squared = 2.0 * 0.3 * APPROACH, 2.0 * 0.2 * APPROACH
    inside = 1.0 - x[:, None] ** 2 / a_squared - x[None, :] ** 2 / b_squared
    peak = exponent * FORCE / (numpy.pi * numpy.sqrt(a_squared * b_squared))
    expected = numpy.where(inside > 0.0, peak * numpy.maximum(inside, 0.0) ** (exponent - 1.0), 0.0)
    assert pressure == pytest.approx(expected, rel=2e-3, abs=1e-12)  # the sum over cells is no integral
    assert pressure.sum() * SIDE**2 == pytest.approx(FORCE, rel=1e-13)


def test_a_contact_smaller_than_a_cell_loads_the_cell_under_the_crown():
    _, gap, pressure = spread(1.5, approach=-1e-6)
    assert pressure[gap == 0.0] == pytest.approx(FORCE / SIDE**2)
    assert numpy.count_nonzero(pressure) == 1


@pytest.mark.parametrize("force", [0.0, -3.0])
def test_without_force_there_is_no_pressure(force):
    assert not spread(1.5, force=force)[2].any()
