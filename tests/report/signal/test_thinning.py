"""A thinned table is bounded, and its rows are means, minima or maxima of groups of equal size."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from contact_sim_pkg.report.signal.thinning import ThinnedRows


def taken(rows, limit, reduce=np.mean, part=1):
    table = ThinnedRows(limit, reduce)
    for first in range(0, len(rows), part):
        table.add(rows[first : first + part])
    return table


def test_few_rows_stay_as_they_are():
    rows = np.random.default_rng(1).normal(size=(7, 3))

    np.testing.assert_array_equal(taken(rows, 8).finish(), rows)


@pytest.mark.parametrize("reduce", [np.mean, np.min, np.max])
def test_rows_of_a_long_table_stand_for_groups(reduce):
    rows = np.random.default_rng(2).normal(size=(64, 2))

    table = taken(rows, 10, reduce)

    assert table.group == 8
    np.testing.assert_allclose(table.finish(), reduce(rows.reshape(8, 8, 2), axis=1), rtol=1e-13)


def test_the_last_row_may_stand_for_fewer():
    rows = np.arange(21.0)[:, None]

    table = taken(rows, 10)

    assert table.group == 4
    np.testing.assert_allclose(table.finish()[:, 0], [1.5, 5.5, 9.5, 13.5, 17.5, 20.0])


@pytest.mark.parametrize("reduce", [np.mean, np.min, np.max])
@given(size=st.integers(1, 500), part=st.integers(1, 200), limit=st.sampled_from([2, 4, 10, 50]))
def test_the_parts_that_rows_come_in_do_not_matter(reduce, size, part, limit):
    rows = np.cos(1.3 * np.arange(size))[:, None] * [1.0, 2.0]

    one_by_one, in_parts = taken(rows, limit, reduce), taken(rows, limit, reduce, part)

    assert in_parts.group == one_by_one.group
    np.testing.assert_allclose(in_parts.finish(), one_by_one.finish(), rtol=1e-13, atol=1e-15)


@given(st.integers(1, 3000), st.sampled_from([2, 4, 10, 50]))
def test_memory_is_bounded_and_extremes_survive(size, limit):
    rows = np.sin(1.7 * np.arange(size))[:, None]

    found = taken(rows, limit, np.max).finish()

    assert len(found) <= limit + 1
    assert found.max() == rows.max()


def test_rows_taken_before_a_widening_are_padded():
    table = taken(np.ones((3, 2)), 4)
    table.widen(1, 2)
    table.add(np.full((1, 5), 3.0))

    np.testing.assert_array_equal(table.finish(), [[0, 1, 1, 0, 0], [1.5, 2, 2, 1.5, 1.5]])


@pytest.mark.parametrize("limit", [0, 1, 7])
def test_a_limit_that_cannot_be_halved_is_refused(limit):
    with pytest.raises(ValueError, match=f"limit = {limit}"):
        ThinnedRows(limit)
