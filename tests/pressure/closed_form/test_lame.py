"""Lame curves: area and moments against quadrature, the fit against known curves and scipy."""

from __future__ import annotations

import math

import numpy
import pytest

from contact_sim_lab.twins import lame as reference
from contact_sim_pkg.pressure.closed_form.lame import LameFit, fit_boundary, fit_patch, lame_area, lame_moment


@pytest.mark.parametrize("exponent", [0.5, 1.0, 1.7, 2.0, 4.0, 12.0])
def test_area_and_moment_equal_quadrature(exponent: float) -> None:
    assert lame_area(0.3, 0.7, exponent) == pytest.approx(reference.area(0.3, 0.7, exponent), rel=1e-6)
    moment = reference.second_moment(0.3, 0.7, exponent)
    assert lame_moment(0.3, 0.7, exponent, 2.0, 0.0) == pytest.approx(moment, rel=1e-6)


@pytest.mark.parametrize(("exponent", "factor"), [(1.0, 2.0), (2.0, math.pi), (4.0, 3.70815), (0.5, 2.0 / 3.0)])
def test_area_of_the_known_curves(exponent: float, factor: float) -> None:
    assert lame_area(0.3, 0.7, exponent) == pytest.approx(factor * 0.21, rel=2e-6)


def test_limits_of_the_exponent() -> None:
    assert lame_area(1.0, 1.0, 100.0) == pytest.approx(4.0, rel=1e-3)
    assert lame_moment(1.0, 2.0, 2.0, 2.0, 0.0) == pytest.approx(math.pi / 2.0, rel=1e-14)
    assert 0.0 < lame_area(1.0, 1.0, 0.1) < 1e-4
    for exponent in (0.05, 0.0, -2.0, math.nan):
        with pytest.raises(ValueError, match=r"allowed from 0\.1"):
            lame_area(1.0, 1.0, exponent)
        with pytest.raises(ValueError, match=r"allowed from 0\.1"):
            lame_moment(1.0, 1.0, exponent, 2.0, 0.0)


@pytest.mark.parametrize("exponent", [0.4, 0.8, 1.0, 1.5, 2.0, 3.3, 8.0, 15.0])
@pytest.mark.parametrize("aspect", [1.0, 0.2, 30.0])
def test_the_fit_finds_a_curve_from_its_points(exponent: float, aspect: float) -> None:
    x, y = reference.points(0.05, 0.05 * aspect, exponent, 240)
    fit = fit_boundary(x + 1.0, y - 2.0, float(x.max()), float(y.max()))
    expected = (0.05, 0.05 * aspect, exponent, 1.0, -2.0)
    assert (fit.a, fit.b, fit.exponent, fit.centre_x, fit.centre_y) == pytest.approx(expected, rel=1e-5)
    assert fit.deviation < 1e-6


@pytest.mark.parametrize("exponent", [1.2, 2.0, 6.0])
def test_the_fit_of_noisy_points_is_that_of_a_general_solver(exponent: float) -> None:
    x, y = reference.points(0.06, 0.03, exponent, 200)
    noise = 1.0 + 0.03 * numpy.random.default_rng(8).standard_normal((2, 200))
    x, y = x * noise[0], y * noise[1]
    x, y = x - x.mean(), y - y.mean()
    expected = reference.fit(x, y, float(x.max()), float(y.max()))
    fit = fit_boundary(x.copy(), y.copy(), float(x.max()), float(y.max()))
    assert (fit.a, fit.b, fit.exponent) == pytest.approx(expected, rel=2e-4)


def test_the_exponent_stays_within_its_bounds() -> None:
    corners = numpy.linspace(-1.0, 1.0, 50)
    side = numpy.ones(50)
    x, y = numpy.concatenate([corners, side, corners, -side]), numpy.concatenate([side, corners, -side, corners])
    assert fit_boundary(x, y, 1.0, 1.0).exponent == pytest.approx(20.0, rel=1e-12)


def disc(exponent: float, rows: int, cols: int) -> tuple[numpy.ndarray, float, float]:
    x = ((numpy.arange(rows) + 0.5) / rows - 0.5) * 0.2
    y = ((numpy.arange(cols) + 0.5) / cols - 0.5) * 0.15
    inside = 1.0 - abs(x[:, None] / 0.06) ** exponent - abs(y[None, :] / 0.05) ** exponent
    return numpy.maximum(inside, 0.0), 0.2 / rows, 0.15 / cols


@pytest.mark.parametrize("exponent", [2.0, 4.0])
def test_a_fine_patch_gives_its_curve(exponent: float) -> None:
    pressure, cell_x, cell_y = disc(exponent, 256, 192)
    fit = fit_patch(pressure, cell_x, cell_y, 3.0, -1.0)
    assert (fit.a, fit.b) == pytest.approx((0.06, 0.05), rel=5e-3)
    assert fit.exponent == pytest.approx(exponent, rel=0.03)
    assert (fit.centre_x, fit.centre_y) == pytest.approx((3.0 + 127.5 * cell_x, -1.0 + 95.5 * cell_y), rel=1e-12)
    assert fit.fitted


@pytest.mark.parametrize("exponent", [0.7, 2.0, 4.0])
def test_holes_inside_the_contact_are_no_boundary(exponent: float) -> None:
    """Cells without pressure that the contact surrounds, as between the grains of a texture."""
    pressure, cell_x, cell_y = disc(exponent, 128, 96)
    whole = fit_patch(pressure, cell_x, cell_y, 0.0, 0.0)
    inner, _, _ = disc(exponent, 128, 96)
    inner = inner > 0.3
    holes = inner & (numpy.random.default_rng(4).random(pressure.shape) < 0.6)
    assert holes.sum() > 0.1 * (pressure > 0.0).sum()
    assert fit_patch(numpy.where(holes, 0.0, pressure), cell_x, cell_y, 0.0, 0.0) == whole


def test_the_outline_of_a_textured_contact_is_that_of_its_outermost_cells() -> None:
    """Half of the cells of an ellipse without pressure, to its edge: the half axes stay within two cells."""
    pressure, cell_x, cell_y = disc(2.0, 128, 96)
    bare = numpy.random.default_rng(5).random(pressure.shape) < 0.5
    fit = fit_patch(numpy.where(bare, 0.0, pressure), cell_x, cell_y, 0.0, 0.0)
    assert 0.06 - 2.0 * cell_x < fit.a < 0.06 + 0.5 * cell_x
    assert 0.05 - 2.0 * cell_y < fit.b < 0.05 + 0.5 * cell_y
    assert fit.deviation < 0.05


def test_a_patch_at_the_grid_s_edge_keeps_the_edge_as_boundary() -> None:
    fit = fit_patch(numpy.ones((40, 20)), 1e-3, 1e-3, 0.0, 0.0)
    assert (fit.a, fit.b) == pytest.approx((0.02, 0.01), rel=0.02)
    assert fit.exponent == pytest.approx(20.0)


def test_few_cells_give_half_extents_and_an_ellipse() -> None:
    pressure = numpy.zeros((20, 30))
    pressure[4:6, 7:10] = 1.0
    expected = LameFit(2e-3, 6e-3, 2.0, 5e-3 * 2 - 1e-3, 16.0 * 2e-3, 0.0, False)
    fit = fit_patch(pressure, 2e-3, 4e-3, 0.0, 0.0)
    assert fit == pytest.approx(expected)


def test_one_cell_is_a_patch_of_half_a_cell() -> None:
    pressure = numpy.zeros((5, 5))
    pressure[2, 3] = 7.0
    assert fit_patch(pressure, 1.0, 1.0, 0.0, 0.0) == (0.5, 0.5, 2.0, 2.0, 3.0, 0.0, False)


def test_without_contact_the_curve_is_a_point_at_the_centre() -> None:
    assert fit_patch(numpy.zeros((5, 3)), 1.0, 1.0, 0.0, 0.0) == (0.0, 0.0, 2.0, 2.0, 1.0, 0.0, False)
