"""The pressure field that a run solves: it follows the road, and what it knows from before changes no answer."""

import numpy
import pytest

from contact_sim_pkg.pressure.field.solver import make_workspace, solve_at_approach
from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.rigs.vehicle.field.contact_field import FieldEdgeError, PressureField, fit_tangent

SETTINGS = FieldSettings(52, 48, 2e-3, 2e-3, 6e6, 1e-10, 900, 1)
X = (numpy.arange(52)[:, None] - 25.0) * 2e-3
Y = (numpy.arange(48)[None, :] - 23.0) * 2e-3
BOWL = X**2 / 0.6 + Y**2 / 0.6
ROAD = 8e-5 * numpy.random.default_rng(3).standard_normal((400, 48))


def gap_at(row):
    return BOWL - ROAD[row : row + 52]


def expected_at(field, row, approach):
    pressure = numpy.zeros((52, 48))
    workspace = make_workspace(field.whole.value.half_space)
    solve_at_approach(field.whole.value.half_space, workspace, gap_at(row), approach, 1e-11, 900, pressure)
    return pressure


@pytest.mark.parametrize("travel", [1, 5, 32, -3])
def test_every_pass_at_every_place_is_the_field_of_that_place(travel):
    field = PressureField(SETTINGS, "tire")
    for step in range(5):
        row = 150 + travel * step
        for approach in (9e-4, 1.02e-3, 1.0e-3):  # a predictor and two correctors
            field.roll_to(row, 0.0)
            load = field.solve(gap_at(row), approach)
        expected = expected_at(field, row, approach)
        assert load == pytest.approx(expected.sum() * 4e-6, rel=1e-8)
        numpy.testing.assert_allclose(field.pressure, expected, atol=1e-6 * expected.max())


def test_a_field_that_forgot_runs_to_the_same_bits_again():
    field, runs = PressureField(SETTINGS, "tire"), []
    for _ in range(2):
        field.reset()
        loads = []
        for row in (10, 12, 12, 14, 46, 47):
            field.roll_to(row, 0.0)
            loads.append(field.solve(gap_at(row), 1e-3))
        runs.append((loads, field.pressure.tobytes()))
    assert runs[0] == runs[1]


def test_a_wheel_that_lifts_off_and_lands_elsewhere_is_solved():
    field = PressureField(SETTINGS, "tire")
    for row, approach in ((10, 1e-3), (60, -1.0), (61, -1.0), (200, 1e-3)):
        field.roll_to(row, 0.0)
        load = field.solve(gap_at(row), approach)
        assert (load > 0.0) == (approach > 0.0)
    expected = expected_at(field, 200, 1e-3)
    numpy.testing.assert_allclose(field.pressure, expected, atol=1e-6 * expected.max())


def test_contact_at_the_edge_of_the_grid_is_an_error_and_the_field_is_usable_after_it():
    field = PressureField(SETTINGS, "tire")
    with pytest.raises(FieldEdgeError, match="tire: the contact reaches the edge"):
        field.solve(gap_at(10), 1.0)
    field.reset()
    assert field.solve(gap_at(10), 1e-3) > 0.0


@pytest.mark.parametrize("tolerance", [1e-1, 1e-2, 5e-3, 1e-6])
@pytest.mark.parametrize("load", [300.0, 700.0])
def test_the_tangent_of_a_sphere_is_hertz_law_whatever_the_field_is_solved_to(tolerance, load):
    radius, modulus = 0.3, SETTINGS.modulus
    law = fit_tangent(PressureField(SETTINGS._replace(tolerance=tolerance), "tire"), BOWL, load)
    approach = (3.0 * load / (4.0 * modulus * radius**0.5)) ** (2.0 / 3.0)
    assert law.exponent == pytest.approx(1.5, rel=0.01)
    assert law.coefficient * approach**law.exponent == pytest.approx(load, rel=0.01)
