"""The belt's influence against quadrature, against the string's differential equation, and its limits."""

from __future__ import annotations

import math

import numpy
import pytest
from scipy.integrate import quad
from scipy.linalg import solve_banded

from contact_sim_pkg.pressure.settings import BeltSettings, FieldSettings
from contact_sim_pkg.rigs.vehicle.field.contact_field import PressureField
from contact_sim_pkg.rigs.vehicle.field.envelopment import belt_influence, relaxation_length

BELT = BeltSettings(9900.0, 6.3e5)
CELL_X, CELL_Y = 5e-3, 7e-3


@pytest.mark.parametrize("row", [0, 1, 2, 17, 39])
def test_the_influence_is_the_integral_of_the_string_s_form_over_the_loaded_cell(row: int) -> None:
    table = belt_influence(BELT, 40, 3, CELL_X, CELL_Y)
    length, root = math.sqrt(BELT.tension / BELT.foundation), math.sqrt(BELT.tension * BELT.foundation)
    low, high = row * CELL_X - CELL_X / 2, row * CELL_X + CELL_X / 2
    area, _ = quad(lambda x: math.exp(-abs(x) / length) / (2.0 * root), low, high, points=[0.0] if row == 0 else None)
    assert table[row] == pytest.approx(numpy.full(3, CELL_Y * area), rel=1e-12)


def test_a_long_even_load_sinks_the_belt_by_load_over_foundation() -> None:
    table = belt_influence(BELT, 2000, 5, CELL_X, CELL_Y)
    everywhere = table[0].sum() + 2.0 * table[1:].sum()
    assert everywhere == pytest.approx(5 * CELL_Y / BELT.foundation, rel=1e-12)


def test_the_belt_follows_the_differential_equation_of_a_string_on_a_foundation() -> None:
    count, cell = 4001, 1e-3
    x = (numpy.arange(count) - count // 2) * cell
    line_load = numpy.where(abs(x) < 0.06, 5e4 * numpy.sqrt(numpy.maximum(1.0 - (x / 0.06) ** 2, 0.0)), 0.0)  # [N/m]
    table = belt_influence(BELT, count, 1, cell, 1.0)[:, 0]
    even = numpy.concatenate([table[:0:-1], table])
    deflection = numpy.convolve(line_load, even)[count - 1 : 2 * count - 1]
    stiff = numpy.zeros((3, count))
    stiff[0], stiff[2] = -BELT.tension / cell**2, -BELT.tension / cell**2
    stiff[1] = BELT.foundation + 2.0 * BELT.tension / cell**2
    assert deflection == pytest.approx(solve_banded((1, 1), stiff, line_load), abs=1e-4 * deflection.max())


def test_a_stiff_foundation_leaves_the_half_space_as_it_is() -> None:
    x = (numpy.arange(24) - 11.5) * 6e-3
    gap = x[:, None] ** 2 / 0.6 + x[None, :] ** 2 / 0.6
    settings = FieldSettings(24, 24, 6e-3, 6e-3, 4e6, 1e-8, 400, 0)
    alone, with_belt = (
        PressureField(settings, "tire"),
        PressureField(settings._replace(belt=BeltSettings(1e3, 1e13)), "tire"),
    )
    assert with_belt.solve_load(gap, 2000.0) == pytest.approx(alone.solve_load(gap, 2000.0), rel=1e-6)


def test_a_soft_belt_lets_the_tire_bend_over_a_short_obstacle() -> None:
    x, y = (numpy.arange(64) - 31.5) * 5e-3, (numpy.arange(24) - 11.5) * 1e-2
    bar_rows = slice(30, 34)
    gap = x[:, None] ** 2 / 0.6 + y[None, :] ** 2 / 0.6
    gap[bar_rows] -= 0.01  # a bar of 10 mm height and 20 mm length
    settings = FieldSettings(64, 24, 5e-3, 1e-2, 2e7, 1e-6, 400, 0)
    shares = []
    for belt in (None, BeltSettings(2000.0, 1e6)):
        field = PressureField(settings._replace(belt=belt), "tire")
        field.solve_load(gap, 3000.0)
        shares.append(field.pressure[bar_rows].sum() / field.pressure.sum())
    assert shares[0] == pytest.approx(1.0, rel=1e-12)  # the bar carries all
    assert shares[1] < 0.9  # the road beside it carries a part


def test_tension_and_foundation_must_be_positive_and_finite() -> None:
    for belt in (
        BeltSettings(0.0, 1.0),
        BeltSettings(1.0, -1.0),
        BeltSettings(math.nan, 1.0),
        BeltSettings(1.0, math.inf),
    ):
        with pytest.raises(ValueError, match="allowed are positive finite numbers"):
            relaxation_length(belt)
