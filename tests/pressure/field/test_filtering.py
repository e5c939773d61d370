"""Filters of a field by tables of frequencies against NumPy's transforms."""

from __future__ import annotations

import numpy
import pytest

from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.pressure.field.filtering import apply_filter, filter_of, good_shape, make_filter_buffers

SHAPES = [(1, 1), (2, 3), (7, 1), (1, 9), (8, 8), (33, 35), (40, 17), (80, 90), (96, 64)]


@entry
def filtered(table, buffers, field, result):
    apply_filter(table, buffers, field, result)


def even_table(rows, cols):
    """Frequencies of a table that is even along both sides, but not a product of one along each."""
    near_row, near_col = (
        numpy.minimum(numpy.arange(rows), rows - numpy.arange(rows)),
        numpy.minimum(numpy.arange(cols), cols - numpy.arange(cols)),
    )
    return numpy.fft.rfft2(1.0 / (1.0 + near_row[:, None] + near_col**2)).real


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("halves", [1, 2])
def test_a_filter_equals_the_transform_times_the_table(shape, halves):
    rows, cols = (halves * side for side in good_shape(*shape))
    table, field = even_table(rows, cols), numpy.random.default_rng(3).standard_normal(shape)
    expected = numpy.fft.irfft2(numpy.fft.rfft2(field, (rows, cols)) * table, (rows, cols))[: shape[0], : shape[1]]
    arranged, buffers, result = (
        filter_of(table / (rows * cols), *shape),
        make_filter_buffers(*shape),
        numpy.empty(shape),
    )
    filtered(arranged, buffers, numpy.ones(shape), result)  # leaves its traces in the buffers
    filtered(arranged, buffers, field, result)
    assert result == pytest.approx(expected, abs=1e-14 * abs(expected).max())
    filtered(arranged, buffers, field, field)  # onto itself: the same bits
    assert field.tobytes() == result.tobytes()


def test_a_table_of_another_grid_is_refused():
    with pytest.raises(ValueError, match=r"table is \(9, 4\), it must be \(8, 4\) or \(16, 7\)"):
        filter_of(numpy.ones((9, 4)), 8, 6)
