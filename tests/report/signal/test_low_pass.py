"""The 100 Hz filter against its gain in closed form, applied in the frequency domain."""

import numpy as np
import pytest

from contact_sim_pkg.report.signal.low_pass import highest, low_pass, lowest

RATES = [500.0, 1000.0, 4000.0]


def gain(frequency, rate, cutoff=100.0):
    """Two passes of a digital Butterworth filter of order 2, 1/sqrt(2) at the cutoff."""
    warped = np.tan(np.pi * frequency / rate) / np.tan(np.pi * cutoff / rate)
    return 1.0 / (1.0 + (np.sqrt(2.0) - 1.0) * warped**4)


@pytest.mark.parametrize("rate", RATES)
def test_a_pulse_is_filtered_as_by_its_spectrum(rate):
    time = np.arange(0.0, 2.0, 1.0 / rate)
    inside = (time >= 1.0) & (time <= 1.006)
    pulse = np.where(inside, 9000.0 * np.sin(np.pi * (time - 1.0) / 0.006), 0.0)
    frequency = np.fft.rfftfreq(time.size, 1.0 / rate)
    response = np.where(frequency < 0.5 * rate, gain(np.minimum(frequency, 0.4999 * rate), rate), 0.0)

    expected = np.fft.irfft(np.fft.rfft(pulse) * response, time.size)

    filtered = low_pass(pulse, rate)
    np.testing.assert_allclose(filtered, expected, atol=1e-3)
    peak = highest(time, filtered)
    assert peak.value == pytest.approx(expected.max(), rel=1e-6)
    assert peak.value < 0.9 * pulse.max()
    assert peak.time == pytest.approx(1.003, abs=1.0 / rate)


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize(("frequency", "ratio"), [(100.0, 2.0**-0.5), (5.0, 1.0), (200.0, None)])
def test_a_sine_keeps_its_phase_and_the_gain_of_the_filter(rate, frequency, ratio):
    time = np.arange(0.0, 4.0, 1.0 / rate)
    sine = np.sin(2.0 * np.pi * frequency * time)

    filtered = low_pass(sine, rate)

    middle = slice(time.size // 4, 3 * time.size // 4)
    expected = gain(frequency, rate)
    np.testing.assert_allclose(filtered[middle], expected * sine[middle], atol=1e-9)
    if ratio is not None:
        assert expected == pytest.approx(ratio, rel=1e-4)


def test_a_level_signal_stays_level_to_its_ends():
    np.testing.assert_allclose(low_pass(np.full(300, 3335.0), 1000.0), 3335.0, rtol=1e-12)


@pytest.mark.parametrize("rate", [100.0, 200.0])
def test_sampling_too_slow_for_the_cutoff_gives_no_filtered_signal(rate):
    assert low_pass(np.ones(100), rate) is None


@pytest.mark.parametrize("samples", [2, 3, 17])
def test_a_record_shorter_than_the_filter_is_filtered_all_the_same(samples):
    assert low_pass(np.ones(samples), 1000.0) == pytest.approx(np.ones(samples))


def test_the_first_of_equal_peaks_counts():
    time, values = np.arange(5.0), np.array([0.0, 2.0, -3.0, 2.0, -3.0])

    assert highest(time, values) == (1.0, 2.0)
    assert lowest(time, values) == (2.0, -3.0)
