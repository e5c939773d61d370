"""Spectra against scipy and closed forms: a sine's variance, white noise, and a one-mass oscillator."""

import subprocess
import sys

import numpy as np
import pytest
import scipy.signal

from contact_sim_pkg.report.signal.spectrum import Welch, power_density, segment_samples, transmissibility

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


@pytest.mark.parametrize(("rms", "defined"), [(1e-14, False), (0.9e-6, False), (1.1e-6, True)])
def test_a_source_that_moves_by_rounding_alone_is_at_rest(rms, defined):
    source = np.random.default_rng(3).normal(size=60_000)
    source *= rms / source.std()

    result = transmissibility(source, 50.0 * source, RATE)

    for column in (result.magnitude, result.phase, result.coherence):
        assert np.isfinite(column[1:]).all() == defined
        assert np.isnan(column).all() != defined


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


def noises(signals, samples):
    """Coloured noises with offsets, the later ones following the first in part."""
    white = np.random.default_rng(5).normal(size=(signals, samples))
    return np.cumsum(white, axis=0) + 9.81


@pytest.mark.parametrize(("samples", "length"), [(9000, 2000), (9000, 1001), (4000, 4000), (50, 4), (9, 3), (7, 2)])
def test_cross_densities_are_those_of_scipy(samples, length):
    signals = noises(3, samples)
    welch = Welch(3, length, RATE)
    ends = list(welch.advance(signals))
    found = welch.mean()

    for source in range(3):
        for target in range(3):
            frequency, expected = scipy.signal.csd(signals[source], signals[target], RATE, nperseg=length)
            np.testing.assert_allclose(found.frequency, frequency, rtol=1e-14)
            difference = np.abs(found.density[source, target] - expected)
            assert difference.max() <= 1e-10 * np.abs(expected).max()
    assert ends == list(range(length - 1, samples, length - length // 2))
    assert found.segments == len(ends)


def test_responses_are_those_of_scipy():
    source, target = noises(2, 9000)
    length = segment_samples(9000, RATE)
    _, cross = scipy.signal.csd(source, target, RATE, nperseg=length)
    _, power = scipy.signal.welch(source, RATE, nperseg=length)
    _, coherence = scipy.signal.coherence(source, target, RATE, nperseg=length)

    found = transmissibility(source, target, RATE)

    np.testing.assert_allclose(found.magnitude, np.abs(cross / power), rtol=1e-10)
    np.testing.assert_allclose(found.phase, np.angle(cross / power), atol=1e-10)
    np.testing.assert_allclose(found.coherence, coherence, rtol=1e-10)


@pytest.mark.parametrize("part", [1, 7, 100, 300])
def test_signals_in_parts_give_the_bits_of_the_whole(part):
    signals = noises(2, 900)
    whole, parts = Welch(2, 200, RATE), Welch(2, 200, RATE)

    ends = list(whole.advance(signals))
    found = [first + end for first in range(0, 900, part) for end in parts.advance(signals[:, first : first + part])]

    assert found == ends
    assert parts.mean().density.tobytes() == whole.mean().density.tobytes()


def test_a_response_in_the_middle_of_a_run_loads_no_part_of_scipy():
    # It takes 0.3 s, which a simulator that keeps a clock does not have
    code = (
        "import sys, numpy\n"
        "from contact_sim_pkg.report.signal.spectrum import Welch\n"
        "welch = Welch(2, 64, 100.0)\n"
        "list(welch.advance(numpy.random.default_rng(1).standard_normal((2, 256))))\n"
        "before = set(sys.modules)\n"
        "assert numpy.isfinite(welch.mean().response(0, 1).magnitude).any()\n"
        "print(*sorted(name for name in set(sys.modules) - before if name.startswith('scipy')))"
    )
    found = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert found.stdout.split() == []
