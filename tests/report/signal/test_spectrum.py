"""Spectra against closed forms: a sine's variance, white noise, and a one-mass oscillator."""

import numpy as np
import pytest
import scipy.signal

from contact_sim_pkg.report.signal.spectrum import power_density, segment_samples, transmissibility

RATE = 500.0


def test_the_integral_of_the_density_is_the_variance_of_a_sine():
    time = np.arange(0.0, 60.0, 1.0 / RATE)

    spectrum = power_density(3.0 * np.sin(2.0 * np.pi * 5.0 * time), RATE)

    resolution = spectrum.frequency[1]
    assert spectrum.density.sum() * resolution == pytest.approx(4.5, rel=1e-3)
    assert spectrum.frequency[spectrum.density.argmax()] == pytest.approx(5.0, abs=resolution)


def test_white_noise_has_the_density_of_twice_its_variance_over_the_rate():
    noise = np.random.default_rng(7).normal(scale=2.0, size=200_000)

    spectrum = power_density(noise, RATE)

    assert spectrum.density[5:-5].mean() == pytest.approx(2.0 * 4.0 / RATE, rel=0.02)


def test_transmissibility_of_a_base_excited_oscillator():
    omega, damping = 2.0 * np.pi * 4.0, 0.2
    time = np.arange(0.0, 120.0, 1.0 / RATE)
    floor = scipy.signal.sosfiltfilt(
        scipy.signal.butter(4, 30.0, fs=RATE, output="sos"), np.random.default_rng(3).normal(size=time.size)
    )
    oscillator = ([2.0 * damping * omega, omega**2], [1.0, 2.0 * damping * omega, omega**2])
    _, seat, _ = scipy.signal.lsim(oscillator, floor, time)

    result = transmissibility(floor, seat, RATE)

    band = (result.frequency >= 1.0) & (result.frequency <= 20.0)
    s = 2j * np.pi * result.frequency[band]
    exact = (2.0 * damping * omega * s + omega**2) / (s**2 + 2.0 * damping * omega * s + omega**2)
    np.testing.assert_allclose(result.magnitude[band], np.abs(exact), rtol=0.05)
    np.testing.assert_allclose(result.phase[band], np.angle(exact), atol=0.06)
    assert result.coherence[band].min() > 0.95


def test_unrelated_signals_have_little_coherence():
    generator = np.random.default_rng(11)

    result = transmissibility(generator.normal(size=60_000), generator.normal(size=60_000), RATE)

    assert np.median(result.coherence) < 0.1


def test_a_floor_at_rest_has_no_transmissibility():
    result = transmissibility(np.zeros(4000), np.random.default_rng(2).normal(size=4000), RATE)

    assert np.isnan(result.magnitude).all()
    assert np.isnan(result.coherence).all()


@pytest.mark.parametrize("samples", [2, 3, 17, 900, 2000, 9000, 60_000])
def test_number_of_segments_is_the_number_that_fits(samples):
    length = segment_samples(samples, RATE)
    starts = range(0, samples - length + 1, length - length // 2)

    assert 1 <= length <= samples
    assert power_density(np.arange(float(samples)), RATE).segments == len(starts)
