"""Signals against closed forms and SciPy."""

import json
import math

import numpy
import pytest
from scipy import signal, stats

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.signals import AxisSignal
from contact_sim_pkg.excitation.vibrations.half_sine import HalfSine
from contact_sim_pkg.excitation.vibrations.haversine import Haversine
from contact_sim_pkg.excitation.vibrations.noise import NoiseSignal
from contact_sim_pkg.excitation.vibrations.sine import Sine
from contact_sim_pkg.excitation.vibrations.sweep import SweepSignal
from contact_sim_pkg.excitation.vibrations.triangle import Triangle

TIME = numpy.linspace(-0.5, 3.0, 1234)


def test_a_sine_has_its_amplitude_frequency_and_phase():
    expected = 2.0 * numpy.sin(2.0 * numpy.pi * 5.0 * TIME + 0.3)
    numpy.testing.assert_allclose(Sine(2.0, 5.0, 0.3).values(TIME), expected, atol=1e-13)


@pytest.mark.parametrize(("logarithmic", "method"), [(True, "logarithmic"), (False, "linear")])
@pytest.mark.parametrize(("start", "end"), [(0.5, 80.0), (80.0, 0.5)])
def test_a_sweep_is_scipys_chirp_from_phase_zero_and_rests_outside(logarithmic, method, start, end):
    found = SweepSignal(3.0, start, end, 2.0, logarithmic).values(TIME)
    inside = (TIME >= 0.0) & (TIME <= 2.0)
    expected = 3.0 * signal.chirp(TIME[inside], start, 2.0, end, method, phi=-90)
    numpy.testing.assert_allclose(found[inside], expected, atol=1e-10)
    assert not found[~inside].any()


def test_a_sweep_says_its_rate():
    assert SweepSignal(1.0, 1.0, 8.0, 180.0).describe()["rate_octaves_per_minute"] == pytest.approx(1.0)
    assert SweepSignal(1.0, 8.0, 1.0, 180.0).describe()["rate_octaves_per_minute"] == pytest.approx(-1.0)
    assert SweepSignal(1.0, 1.0, 10.0, 18.0, logarithmic=False).describe()["rate_Hz_per_s"] == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("kind", "quarter"), [(HalfSine, math.sqrt(0.5)), (Haversine, 0.5), (Triangle, 0.5)], ids=lambda each: str(each)
)
def test_a_shock_has_its_shape_and_changes_the_velocity_by_its_area(kind, quarter):
    shock = kind(-50.0, 0.2, 0.02)
    assert shock.values(numpy.array([0.19, 0.2, 0.205, 0.21, 0.22, 0.3])) == pytest.approx(
        [0.0, 0.0, -50.0 * quarter, -50.0, 0.0, 0.0], abs=1e-9
    )
    time = numpy.linspace(0.2, 0.22, 20001)
    area = shock.values(time).sum() * (time[1] - time[0])
    assert shock.describe()["velocity_change_m_per_s"] == pytest.approx(area, rel=1e-6)


@pytest.mark.parametrize("rms", [0.25, 2.0])
def test_noise_has_exactly_its_rms_inside_its_band_and_none_outside(rms):
    period, count = 20.0, 4000
    values = NoiseSignal(rms, 0.5, 20.0, 3, period).values(period * numpy.arange(count) / count)
    assert math.sqrt(numpy.mean(values**2)) == pytest.approx(rms, rel=1e-6)
    power = 2.0 * numpy.abs(numpy.fft.rfft(values) / count) ** 2
    frequency = numpy.arange(len(power)) / period
    inside = (frequency >= 0.5) & (frequency <= 20.0)
    numpy.testing.assert_allclose(power[inside], rms**2 / inside.sum(), rtol=1e-5)
    assert power[~inside].max() < 1e-12 * rms**2


def test_noise_is_gaussian_and_its_seeds_differ():
    time = 60.0 * numpy.arange(12000) / 12000
    first, second = (NoiseSignal(1.0, 0.5, 40.0, seed).values(time) for seed in (1, 2))
    for values in (first, second):
        assert abs(stats.skew(values)) < 0.1
        assert abs(stats.kurtosis(values)) < 0.15
    assert abs(numpy.corrcoef(first, second)[0, 1]) < 0.1
    assert NoiseSignal(1.0, 0.5, 40.0, 1).values(time).tobytes() == first.tobytes()


def test_noise_between_its_lattice_points_is_the_sum_of_its_harmonics():
    period, count = 10.0, 1024
    noise = NoiseSignal(1.0, 18.0, 20.0, 3, period)
    amplitude = numpy.fft.rfft(noise.values(period * numpy.arange(count) / count)) / count
    time = numpy.random.default_rng(1).uniform(-10.0, 30.0, 500)
    waves = numpy.arange(180, 201)
    exact = 2.0 * (amplitude[waves] * numpy.exp(2j * numpy.pi * numpy.outer(time, waves) / period)).sum(axis=1).real
    assert numpy.sqrt(numpy.mean((noise.values(time) - exact) ** 2)) < 1e-6


def test_waveforms_add_up_on_each_axis():
    both = AxisSignal(x=[Sine(1.0, 2.0)], z=[Sine(2.0, 3.0), HalfSine(5.0, 1.0, 0.1)])
    x, z = both.acceleration(TIME)
    numpy.testing.assert_array_equal(x, Sine(1.0, 2.0).values(TIME))
    expected = Sine(2.0, 3.0).values(TIME) + HalfSine(5.0, 1.0, 0.1).values(TIME)
    numpy.testing.assert_allclose(z, expected, atol=1e-14)
    assert not AxisSignal().acceleration(TIME)[0].any()


def test_description_is_plain_json():
    described = AxisSignal(x=[NoiseSignal(1.0, 1.0, 9.0, 2)], z=[SweepSignal(1.0, 1.0, 2.0, 3.0)]).describe()
    assert json.loads(json.dumps(described)) == described
    assert described["notes"] == ["The noise repeats after 60 s."]


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Sine(-1.0, 1.0), "amplitude of the sine is -1"),
        (lambda: Sine(1.0, math.nan), "frequency of the sine is nan"),
        (lambda: SweepSignal(1.0, 0.0, 2.0, 1.0), "start frequency"),
        (lambda: SweepSignal(1.0, 2.0, 2.0, 1.0), "use a sine"),
        (lambda: HalfSine(1.0, 0.0, 0.0), "duration of the half-sine"),
        (lambda: NoiseSignal(1.0, 5.0, 4.0, 1), "highest frequency"),
        (lambda: NoiseSignal(1.0, 1.0, 1.1, 1), "holds 7 harmonics .* longer period"),
        (lambda: NoiseSignal(1.0, 1.0, 9.0, -1), "seed of the noise"),
        (lambda: NoiseSignal(1.0, 1.0, 1e4, 1, 1e4), "limit 16777216"),
    ],
)
def test_bad_parameters_are_refused(make, message):
    with pytest.raises(ExcitationError, match=message):
        make()
