"""Windows: a field solved on the cells that overlap is the field of the whole grid."""

import numpy
import pytest

from contact_sim_lab.field.windowed import STEP, WindowedSolver, overlap_window
from contact_sim_pkg.pressure.field.halfspace import make_half_space
from contact_sim_pkg.pressure.field.solver import BAD_INPUT, CONVERGED, EDGE, make_workspace, solve_at_approach

ROWS, COLS = 40, 36
HALF_SPACE = make_half_space(ROWS, COLS, 0.006, 0.005, 6e6)
X, Y = numpy.meshgrid(numpy.arange(ROWS) * 0.006, numpy.arange(COLS) * 0.005, indexing="ij")


def rough_bowl(seed, row=20.0, col=17.0, roughness=3e-4):
    bowl = (X - 0.006 * row) ** 2 / 0.6 + (Y - 0.005 * col) ** 2 / 0.9
    return bowl + roughness * numpy.random.default_rng(seed).standard_normal((ROWS, COLS))


def whole(gap, approach, tolerance=1e-11):
    pressure = numpy.zeros((ROWS, COLS))
    result = solve_at_approach(HALF_SPACE, make_workspace(HALF_SPACE), gap, approach, tolerance, 500, pressure)
    return pressure, result


def windowed(gap, approach, tolerance=1e-11, start=None):
    pressure = numpy.zeros((ROWS, COLS)) if start is None else start.copy()
    result = WindowedSolver(HALF_SPACE).solve_at_approach(gap, approach, tolerance, 500, pressure)
    return pressure, result


@pytest.mark.parametrize("seed", range(6))
def test_the_field_is_that_of_the_whole_grid(seed):
    gap, approach = rough_bowl(seed, row=14 + 2 * seed, col=22 - seed), 0.6e-3 + 1.5e-4 * seed
    expected, reference = whole(gap, approach)
    found, result = windowed(gap, approach)
    assert result.status == reference.status == CONVERGED
    assert result.load == pytest.approx(reference.load, rel=1e-9)
    numpy.testing.assert_allclose(found, expected, atol=1e-7 * expected.max())
    _row, _col, rows, cols = overlap_window(gap, approach, expected)
    assert rows * cols < ROWS * COLS


def test_a_start_outside_the_window_is_forgotten():
    gap = rough_bowl(3)
    expected, _ = windowed(gap, 1e-3)
    found, result = windowed(gap, 1e-3, start=numpy.full((ROWS, COLS), 2e5))
    assert result.status == CONVERGED
    numpy.testing.assert_allclose(found, expected, atol=1e-7 * expected.max())


def test_a_window_holds_every_overlapping_cell_and_its_neighbours():
    for seed in range(20):
        gap = rough_bowl(seed, row=3 + 2 * seed % 35, col=2 + 3 * seed % 30)
        approach = gap.min() + 1e-3
        first_row, first_col, rows, cols = overlap_window(gap, approach, numpy.zeros((ROWS, COLS)))
        i, j = numpy.nonzero(gap < approach)
        assert first_row <= max(i.min() - 1, 0)
        assert first_row + rows > min(i.max() + 1, ROWS - 1)
        assert first_col <= max(j.min() - 1, 0)
        assert first_col + cols > min(j.max() + 1, COLS - 1)
        assert first_row >= 0
        assert first_col >= 0
        assert first_row + rows <= ROWS
        assert first_col + cols <= COLS
        assert rows % STEP == 0 or rows == ROWS
        assert cols % STEP == 0 or cols == COLS


def test_moving_the_gap_by_whole_cells_moves_the_bits_of_the_field():
    gap = numpy.full((ROWS, COLS), 1.0)
    gap[6:22, 5:20] = rough_bowl(1)[12:28, 9:24]
    found, _ = windowed(gap, 8e-4)
    moved, _ = windowed(numpy.roll(gap, (9, 11), (0, 1)), 8e-4)
    assert found.max() > 0.0
    assert numpy.roll(found, (9, 11), (0, 1)).tobytes() == moved.tobytes()


def test_without_overlap_the_field_is_zero():
    gap = rough_bowl(0)
    pressure, result = windowed(gap, float(gap.min()) - 1e-6, start=numpy.full((ROWS, COLS), 1e5))
    assert (result.status, result.load) == (CONVERGED, 0.0)
    assert not pressure.any()


@pytest.mark.parametrize(("row", "col"), [(0, 17), (39, 17), (20, 0), (20, 35), (0, 0)])
def test_contact_at_the_grid_s_edge_is_reported(row, col):
    gap = rough_bowl(2, row, col)
    expected, reference = whole(gap, 1e-3)
    found, result = windowed(gap, 1e-3)
    assert result.status == reference.status == EDGE
    numpy.testing.assert_allclose(found, expected, atol=1e-7 * expected.max())


@pytest.mark.parametrize("bad", [numpy.nan, numpy.inf, -numpy.inf])
def test_a_cell_that_is_not_finite_is_refused_also_outside_the_window(bad):
    gap = rough_bowl(4)
    gap[1, 1] = bad
    _, result = windowed(gap, 1e-3)
    assert result.status == BAD_INPUT


def test_arrays_of_another_shape_are_refused():
    with pytest.raises(ValueError, match="both must be"):
        WindowedSolver(HALF_SPACE).solve_at_approach(rough_bowl(0)[1:], 1e-3, 1e-3, 10, numpy.zeros((ROWS, COLS)))
