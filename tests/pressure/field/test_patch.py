"""Resultants of a pressure field."""

from __future__ import annotations

import math

import numpy
import pytest

from contact_sim_pkg.pressure.field.halfspace import make_half_space
from contact_sim_pkg.pressure.field.patch import contact_area, summarise
from contact_sim_pkg.pressure.field.solver import make_workspace, solve_at_load


def test_resultants_equal_sums_in_numpy() -> None:
    random = numpy.random.default_rng(3)
    pressure = random.random((31, 17)) * (random.random((31, 17)) > 0.6)
    summary = summarise(pressure, 2e-3, 3e-3, 0.5, -0.1)
    x, y = 0.5 + 2e-3 * numpy.arange(31), -0.1 + 3e-3 * numpy.arange(17)
    assert summary.load == pytest.approx(pressure.sum() * 6e-6, rel=1e-14)
    assert summary.peak == pressure.max()
    assert summary.area == contact_area(pressure, 2e-3, 3e-3)
    assert summary.mean == pytest.approx(summary.load / summary.area, rel=1e-14)
    assert summary.centre_x == pytest.approx((pressure.sum(1) * x).sum() / pressure.sum(), rel=1e-13)
    assert summary.centre_y == pytest.approx((pressure.sum(0) * y).sum() / pressure.sum(), rel=1e-13)


def test_without_contact_all_is_zero_and_the_centre_is_the_grid_s() -> None:
    assert summarise(numpy.zeros((5, 3)), 1.0, 2.0, 10.0, 0.0) == (0.0, 0.0, 0.0, 0.0, 12.0, 2.0)


def test_one_cell_carries_everything() -> None:
    pressure = numpy.zeros((4, 4))
    pressure[1, 2] = 5.0
    assert summarise(pressure, 0.5, 0.5, 0.0, 0.0) == (1.25, 5.0, 5.0, 0.25, 0.5, 1.0)


def hertz_disc(cells: int, semi_x: float, semi_y: float, shift: float = 0.0) -> numpy.ndarray:
    """Hertz pressure at the cell centres of a grid over 1 x 1."""
    x = (numpy.arange(cells) - 0.5 * (cells - 1) + shift) / cells
    inside = 1.0 - (x[:, None] / semi_x) ** 2 - (x[None, :] / semi_y) ** 2
    return numpy.asarray(numpy.sqrt(numpy.maximum(inside, 0.0)))


@pytest.mark.parametrize(("semi_x", "semi_y"), [(0.3, 0.3), (0.41, 0.2)])
@pytest.mark.parametrize("shift", [0.0, 0.3])
def test_an_edge_between_cells_gives_the_area_of_an_ellipse(semi_x: float, semi_y: float, shift: float) -> None:
    exact = math.pi * semi_x * semi_y
    for cells in (40, 80, 160):
        pressure = hertz_disc(cells, semi_x, semi_y, shift)
        assert contact_area(pressure, 1 / cells, 1 / cells) == pytest.approx(exact, rel=30.0 / cells**2)


def test_the_solved_field_of_a_sphere_has_its_area_closer_than_its_cells_count() -> None:
    cells, semi = 64, 0.3
    x = (numpy.arange(cells) - 0.5 * (cells - 1)) / cells
    half_space, pressure = make_half_space(cells, cells, 1 / cells, 1 / cells, 1.0), numpy.zeros((cells, cells))
    gap = 0.5 * (x[:, None] ** 2 + x[None, :] ** 2)
    solve_at_load(half_space, make_workspace(half_space), gap, 4.0 / 3.0 * semi**3, 1e-8, 300, pressure)
    exact = math.pi * semi**2
    counted = numpy.count_nonzero(pressure) / cells**2
    assert counted / exact - 1.0 > 5e-3
    assert summarise(pressure, 1 / cells, 1 / cells, 0.0, 0.0).area == pytest.approx(exact, rel=2e-3)


def test_a_contact_over_the_whole_grid_has_the_grid_s_area() -> None:
    assert contact_area(numpy.ones((7, 5)), 2.0, 3.0) == pytest.approx(7 * 5 * 6.0, rel=1e-15)


def test_a_pressure_that_rises_towards_its_edge_ends_at_the_cells_edge() -> None:
    pressure = numpy.zeros((9, 9))
    pressure[2:7, 3:6] = 1.0
    pressure[2, 3:6] = pressure[6, 3:6] = pressure[2:7, 3] = pressure[2:7, 5] = 4.0
    assert contact_area(pressure, 1.0, 1.0) == 15.0


def test_single_cells_count_as_cells_and_nothing_as_nothing() -> None:
    pressure = numpy.zeros((6, 6))
    assert contact_area(pressure, 1.0, 1.0) == 0.0
    pressure[0, 0] = pressure[3, 3] = pressure[5, 2] = 2.0
    assert contact_area(pressure, 0.5, 2.0) == 3.0


def test_the_area_turns_with_the_field() -> None:
    pressure = numpy.random.default_rng(1).random((13, 20)) ** 3
    pressure[pressure < 0.3] = 0.0
    area = contact_area(pressure, 0.1, 0.2)
    assert contact_area(numpy.ascontiguousarray(numpy.rot90(pressure)), 0.2, 0.1) == pytest.approx(area, rel=1e-14)
    assert contact_area(1e-6 * pressure, 0.1, 0.2) == pytest.approx(area, rel=1e-12)
