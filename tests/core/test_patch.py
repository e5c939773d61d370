"""Resultants of a pressure field."""

from __future__ import annotations

import numpy
import pytest

from contact_sim_pkg.core.patch import summarise


def test_resultants_equal_sums_in_numpy() -> None:
    random = numpy.random.default_rng(3)
    pressure = random.random((31, 17)) * (random.random((31, 17)) > 0.6)
    summary = summarise(pressure, 2e-3, 3e-3, 0.5, -0.1)
    x, y = 0.5 + 2e-3 * numpy.arange(31), -0.1 + 3e-3 * numpy.arange(17)
    assert summary.load == pytest.approx(pressure.sum() * 6e-6, rel=1e-14)
    assert summary.peak == pressure.max()
    assert summary.area == pytest.approx(numpy.count_nonzero(pressure) * 6e-6, rel=1e-14)
    assert summary.mean == pytest.approx(summary.load / summary.area, rel=1e-14)
    assert summary.centre_x == pytest.approx((pressure.sum(1) * x).sum() / pressure.sum(), rel=1e-13)
    assert summary.centre_y == pytest.approx((pressure.sum(0) * y).sum() / pressure.sum(), rel=1e-13)


def test_without_contact_all_is_zero_and_the_centre_is_the_grid_s() -> None:
    assert summarise(numpy.zeros((5, 3)), 1.0, 2.0, 10.0, 0.0) == (0.0, 0.0, 0.0, 0.0, 12.0, 2.0)


def test_one_cell_carries_everything() -> None:
    pressure = numpy.zeros((4, 4))
    pressure[1, 2] = 5.0
    assert summarise(pressure, 0.5, 0.5, 0.0, 0.0) == (1.25, 5.0, 5.0, 0.25, 0.5, 1.0)
