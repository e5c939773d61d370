"""The envelope of a long series keeps what the eye looks for."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from contact_sim_pkg.analysis.decimate import envelope


def test_a_short_series_is_drawn_as_it_is():
    time, values = np.arange(10.0), np.arange(10.0) ** 2

    assert envelope(time, values, columns=5)[1] is values


def test_a_spike_of_one_sample_survives():
    values = np.zeros(100_000)
    values[54_321] = 7.0

    time, drawn = envelope(np.arange(100_000.0), values)

    assert drawn.size <= 1400
    assert time[drawn.argmax()] == 54_321.0
    assert drawn.max() == 7.0


@given(st.integers(3, 2000), st.integers(1, 40), st.integers(0, 2**32 - 1))
def test_every_drawn_point_is_a_sample_and_time_never_runs_back(size, columns, seed):
    values = np.random.default_rng(seed).normal(size=size)
    time = np.arange(float(size))

    drawn_time, drawn = envelope(time, values, columns)

    assert np.all(np.diff(drawn_time) >= 0.0)
    np.testing.assert_array_equal(drawn, values[drawn_time.astype(int)])
    assert (drawn.min(), drawn.max()) == (values.min(), values.max())
    assert drawn.size <= max(2 * columns, size if size <= 2 * columns else 0)
