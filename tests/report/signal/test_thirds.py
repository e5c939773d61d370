"""Third-octave bands: a sine in its own band, white noise by the width of each, what a record cannot show."""

import numpy as np
import pytest

from contact_sim_pkg.report.signal.thirds import NOMINAL, third_octaves

RATE = 500.0


def test_a_sine_is_in_the_band_of_its_frequency():
    time = np.arange(0.0, 20.0, 1.0 / RATE)
    for centre in (1.0, 4.0, 31.5):
        found = third_octaves(9.81 + 0.6 * np.sin(2.0 * np.pi * centre * time), RATE)
        assert found[NOMINAL.index(centre)] == pytest.approx(0.6 / np.sqrt(2.0), rel=1e-3)
        others = np.delete(found, NOMINAL.index(centre))
        assert np.nanmax(others) < 0.03


def test_the_squares_of_all_bands_are_the_square_of_what_lies_in_them():
    """Parseval, by a filter in the frequency domain between the outer edges."""
    values = np.random.default_rng(1).normal(size=60_000)
    spectrum = np.fft.rfft(values)
    lines = np.fft.rfftfreq(values.size, 1.0 / RATE)
    inside = (lines > 10.0**-0.35) & (lines < 10.0**2.05)
    left = np.fft.irfft(np.where(inside, spectrum, 0.0), values.size)
    assert np.sqrt(np.sum(third_octaves(values, RATE) ** 2)) == pytest.approx(left.std(), rel=1e-4)


def test_white_noise_fills_a_band_by_its_width():
    values = np.random.default_rng(2).normal(size=400_000)
    found = third_octaves(values, RATE)
    for place in (10, 15, 20):
        width = 10.0 ** ((place - 2.5) / 10.0) - 10.0 ** ((place - 3.5) / 10.0)
        assert found[place] == pytest.approx(np.sqrt(width / (0.5 * RATE)), rel=0.03)


def test_a_band_that_the_record_cannot_show_is_unknown():
    """4 s have lines 0.25 Hz apart, and at 100 Hz nothing is above 50 Hz."""
    found = third_octaves(np.random.default_rng(3).normal(size=400), 100.0)
    known = [centre for centre, value in zip(NOMINAL, found, strict=True) if np.isfinite(value)]
    assert (known[0], known[-1]) == (1.25, 40.0)
