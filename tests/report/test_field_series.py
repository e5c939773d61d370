"""What is kept of the fields that pass by."""

from types import SimpleNamespace

import numpy as np
import pytest

from contact_sim_pkg.report.field_series import AROUND_LARGEST_LOAD, FieldReader

CELL = 0.01  # [m]


def message(pressure, load=None, origin=(0.0, 0.0)):
    pressure = np.asarray(pressure, dtype=np.float32)
    rows, cols = pressure.shape
    return SimpleNamespace(
        rows=rows, cols=cols, cell_x=CELL, cell_y=CELL, origin_x=origin[0], origin_y=origin[1],
        load=float(pressure.sum()) * CELL**2 if load is None else load, peak=float(pressure.max()), mean=1.0, area=1.0,
        lame_a=0.0, lame_b=0.0, lame_n=2.0, centre_x=0.0, centre_y=0.0, pressure=pressure.ravel(),
    )  # fmt: skip


def passed(messages):
    fields = FieldReader()
    for number, each in enumerate(messages):
        fields.add(0.01 * number, each)
    return fields.finish()


@pytest.mark.parametrize("at", [0, 3, 100, 150, 199])
def test_the_fields_around_the_largest_load_are_kept(at):
    loads = np.where(np.arange(200) == at, 5.0, 1.0)

    series = passed([message(np.full((2, 3), number), load) for number, load in enumerate(loads)])

    kept = [each.field.pressure[0, 0] for each in series.event]
    assert kept == list(range(max(at - AROUND_LARGEST_LOAD, 0), min(at + AROUND_LARGEST_LOAD, 199) + 1))
    assert (series.heaviest.load, series.heaviest.time) == (5.0, pytest.approx(0.01 * at))


def test_a_larger_load_right_after_a_large_one_takes_its_place():
    loads = [1.0, 4.0, 1.0, 6.0, *[1.0] * 60]

    series = passed([message(np.ones((2, 2)), load) for load in loads])

    assert len(series.event) == 3 + 1 + AROUND_LARGEST_LOAD
    assert series.heaviest.time == pytest.approx(0.03)


def test_the_history_is_the_pressure_integrated_across_the_width():
    fields = np.random.default_rng(3).uniform(0.0, 1e5, (6, 5, 4))

    series = passed([message(each) for each in fields])

    np.testing.assert_allclose(series.history, fields.sum(axis=2) * CELL, rtol=1e-6)
    np.testing.assert_allclose(series.history_time, 0.01 * np.arange(6))
    assert series.history_group == 1


def test_the_history_of_a_narrow_grid_lies_at_its_place_on_the_wide_one():
    narrow, wide = message(np.full((2, 2), 3.0), origin=(0.0, 0.0)), message(np.ones((6, 4)), origin=(-0.02, -0.01))

    series = passed([narrow, wide, narrow])

    expected = np.array([[0, 0, 6, 6, 0, 0], [4, 4, 4, 4, 4, 4], [0, 0, 6, 6, 0, 0]]) * CELL
    np.testing.assert_allclose(series.history, expected)


def test_length_and_width_reach_over_the_outermost_loaded_cells():
    pressure = np.zeros((8, 9))
    pressure[1, 4] = pressure[5, 2] = 1e5

    series = passed([message(pressure), message(np.zeros((8, 9)))])

    np.testing.assert_allclose(series.length, [5 * CELL, 0.0])
    np.testing.assert_allclose(series.width, [3 * CELL, 0.0])
