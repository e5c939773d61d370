"""The envelope of a long series keeps what the eye looks for."""

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure

from contact_sim_pkg.report.drawing import draw_series
from contact_sim_pkg.report.signal.decimate import bands, envelope


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


@given(st.integers(40, 3000), st.integers(1, 40), st.integers(0, 2**32 - 1))
def test_a_band_holds_every_sample_and_its_line_is_the_mean(size, columns, seed):
    values = np.random.default_rng(seed).normal(size=size)

    time, low, mean, high = bands(np.arange(float(size)), values, columns)

    parts = [
        values[start:stop]
        for start, stop in pairwise(int(each) for each in np.linspace(0, size, columns + 1).astype(int))
    ]
    np.testing.assert_array_equal(low, [part.min() for part in parts])
    np.testing.assert_array_equal(high, [part.max() for part in parts])
    np.testing.assert_allclose(mean, [part.mean() for part in parts], atol=1e-12)
    assert (np.diff(time) > 0.0).all()


def test_a_long_noisy_series_is_a_band_with_a_line_and_not_a_bar():
    """50 Hz over 10 s, as forces of a rough road: the line through every extreme covered its band in full colour."""
    time = np.arange(40_000) / 4000.0
    values = np.sin(2.0 * np.pi * 50.0 * time) + 3.0 * np.sin(2.0 * np.pi * 0.3 * time)
    axes = Figure().subplots()

    assert "Band" in draw_series(axes, time, values, color="#0a6c9e")

    (line,), (band,) = axes.lines, axes.collections
    drawn = np.interp(line.get_xdata(), time, 3.0 * np.sin(2.0 * np.pi * 0.3 * time))
    assert np.abs(line.get_ydata() - drawn).max() < 0.5  # 1.4 periods in a column
    extent = band.get_paths()[0].get_extents()
    assert (extent.y0, extent.y1) == (values.min(), values.max())
    assert draw_series(axes, time[:100], values[:100], color="#0a6c9e") == ""
