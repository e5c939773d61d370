"""Displacement of the surface under Hertz fields."""

import numpy as np
import pytest
from tests.report import rolling_bag as known

from contact_sim_pkg.report.series import PressureMap
from contact_sim_pkg.rigs.vehicle.tire.body import TireBody, TireForm
from contact_sim_pkg.rigs.vehicle.tire.report.displacement import surface_displacement

BODY = TireBody(TireForm(known.RADIUS_X, known.RADIUS_Y), known.MODULUS, known.POISSON)


def hertz_map(load):
    x, y = known.cells()
    return PressureMap(known.pressure(load), known.CELL_X, known.CELL_Y, float(x[0, 0]), float(y[0, 0]))


@pytest.mark.parametrize("load", [2000.0, 4000.0, 9000.0])
def test_inside_a_hertz_contact_the_displacement_is_the_approach_less_the_crown(load):
    along, across, _, approach = known.ellipse(load)
    x, y = known.cells()

    raised = surface_displacement(hertz_map(load), BODY)

    well_inside = (x / along) ** 2 + (y / across) ** 2 < 0.9
    crown = 0.5 * x**2 / known.RADIUS_X + 0.5 * y**2 / known.RADIUS_Y
    np.testing.assert_allclose(raised[well_inside], (approach - crown)[well_inside], atol=0.005 * approach)


def test_far_away_the_load_acts_as_a_point():
    field = hertz_map(50.0)
    x, y = known.cells()

    raised = surface_displacement(field, BODY)

    load = field.pressure.sum() * known.CELL_X * known.CELL_Y
    point = load / (np.pi * known.MODULUS * np.hypot(x, y))
    assert raised[0, 0] == pytest.approx(point[0, 0], rel=0.01)


def test_a_field_without_load_moves_nothing():
    assert not surface_displacement(hertz_map(0.0), BODY).any()
