"""What penetrates outside a window, by bounds, direct sums and one convolution, against SciPy's convolution."""

from __future__ import annotations

import numpy
import pytest
from scipy.signal import fftconvolve

from contact_sim_pkg.compiled.held import hold
from contact_sim_pkg.pressure.field.halfspace import make_half_space
from contact_sim_pkg.pressure.field.instant import grown_window
from contact_sim_pkg.pressure.field.window import make_part

WINDOW = (64, 72, 64, 60)  # first row, first column, rows, columns
MODULUS = 4e6


def loaded_grid():
    half_space = make_half_space(192, 192, 1e-3, 1.5e-3, MODULUS)
    pressure = numpy.zeros((192, 192))
    pressure[66:126, 74:130] = 1e5 * (0.5 + numpy.random.default_rng(8).random((60, 56)))
    row = abs(numpy.arange(-191, 192))
    moved = fftconvolve(pressure, half_space.influence[row][:, row], mode="full")[191:383, 191:383]
    return half_space, pressure, moved


@pytest.mark.parametrize("clearance", [2e-3, 1e-7], ids=["few blocks are close", "most blocks are"])
@pytest.mark.parametrize("spot", [None, (60, 80), (63, 71), (100, 140), (150, 20)])
def test_a_window_grows_to_what_penetrates_and_no_further(clearance, spot):
    half_space, pressure, moved = loaded_grid()
    # Everywhere as much above the deformed surface, but for one cell that lies below it.
    approach = 0.0
    gap = numpy.ascontiguousarray(approach - moved + clearance * (1.0 + moved / moved.max()))
    if spot is not None:
        gap[spot] = approach - moved[spot] - 1e-7
    whole = hold(make_part(half_space, 192, 192))
    first_row, first_col, rows, cols = grown_window(whole, gap, approach, pressure, WINDOW)
    if spot is None:
        assert (first_row, first_col, rows, cols) == WINDOW
        return
    row, col = spot
    assert first_row <= min(row, 66)
    assert first_row + rows > max(row, 125)
    assert first_col <= min(col, 74)
    assert first_col + cols > max(col, 129)
    # With a margin of two cells, and sides that the transforms are fast for.
    assert rows <= 1.2 * (max(row, 125) - min(row, 66) + 5) + 2
    assert cols <= 1.2 * (max(col, 129) - min(col, 74) + 5) + 2
