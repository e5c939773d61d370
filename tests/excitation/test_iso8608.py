"""The random road against closed forms of its spectrum (ISO 8608) and the golden car of the IRI."""

import itertools
import math

import numpy
import pytest
from scipy import integrate

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.roads.iso8608 import CLASS_ROUGHNESS, Iso8608Road, band_variance, roughness_of_class

CENTRE = numpy.zeros(1)
STEP, LENGTH = 0.05, 2000.0
LINE = STEP * numpy.arange(round(LENGTH / STEP))


def spectrum(height, length):
    """One-sided spectrum [m^3] of a periodic line and its wave numbers [cycles/m]."""
    amplitude = numpy.fft.rfft(height, axis=0) / len(height)
    return numpy.arange(len(amplitude)) / length, 2.0 * numpy.abs(amplitude) ** 2 * length


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("name", ["A", "C"])
def test_rms_exponent_and_roughness_are_those_of_the_class(name, seed):
    roughness = roughness_of_class(name)
    road = Iso8608Road(roughness, seed, LENGTH)
    height = road.heights(LINE, CENTRE)[:, 0]
    closed_form = math.sqrt(roughness * 0.1**2 * (100.0 - 0.3))  # Gd n0^2 (1/n1 - 1/n2)
    assert numpy.std(height) == pytest.approx(closed_form, rel=0.02)
    n, density = spectrum(height, LENGTH)
    band = (n > 0.011) & (n < 2.83)
    slope, level = numpy.polyfit(numpy.log(n[band] / 0.1), numpy.log(density[band]), 1)
    assert -slope == pytest.approx(2.0, abs=0.02)
    assert math.exp(level) == pytest.approx(roughness, rel=0.03)


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.5, 4.0])
def test_the_spectrum_falls_with_the_exponent_that_is_requested(exponent):
    height = Iso8608Road(64e-6, 4, 500.0, exponent).heights(LINE[:10000], CENTRE)[:, 0]
    n, density = spectrum(height, 500.0)
    band = (n > 0.05) & (n < 3.0)
    slope = numpy.polyfit(numpy.log(n[band]), numpy.log(density[band]), 1)[0]
    assert -slope == pytest.approx(exponent, abs=0.03)
    expected = integrate.quad(lambda s: 64e-6 * 0.1**exponent * s**-exponent, 0.01, 1 / 0.3, epsrel=1e-10)[0]
    assert numpy.var(height) == pytest.approx(expected, rel=1e-3)
    assert band_variance(64e-6, exponent, 0.01, 1 / 0.3) == pytest.approx(expected, rel=1e-8)


def test_interpolation_error_is_below_a_millionth_of_the_rms_for_the_worst_band():
    # only the shortest waves: the exact sum of the harmonics that the fine lattice holds, at places off the lattice
    length, shortest = 60.0, 0.3
    road = Iso8608Road(256e-6, 8, length, 1.0, shortest, 0.33)
    lattice = length * numpy.arange(4096) / 4096
    amplitude = numpy.fft.rfft(road.heights(lattice, CENTRE)[:, 0]) / 4096
    x = numpy.random.default_rng(1).uniform(-100.0, 200.0, 3000)
    waves = numpy.arange(150, 220)
    exact = 2.0 * (amplitude[waves] * numpy.exp(2j * numpy.pi * numpy.outer(x, waves) / length)).sum(axis=1).real
    error = road.heights(x, CENTRE)[:, 0] - exact
    assert numpy.sqrt(numpy.mean(error**2)) < 1e-6 * numpy.std(exact)


def test_the_road_has_nothing_outside_its_band():
    height = Iso8608Road(256e-6, 5, 200.0, 2.0, 0.5, 20.0).heights(LINE[:4000], CENTRE)[:, 0]
    n, density = spectrum(height, 200.0)
    inside = (n >= 1 / 20.0 - 0.003) & (n <= 2.0 + 0.003)
    assert density[~inside].max() < 1e-9 * density[inside].max()


def test_the_road_is_the_same_for_the_same_seed_and_another_for_another():
    x = numpy.linspace(0.0, 30.0, 200)
    first, again, other = (Iso8608Road(64e-6, seed, 100.0).heights(x, CENTRE) for seed in (7, 7, 8))
    assert first.tobytes() == again.tobytes()
    assert abs(numpy.corrcoef(first[:, 0], other[:, 0])[0, 1]) < 0.9


def test_without_texture_the_road_is_even_across_and_repeats_after_its_length():
    road = Iso8608Road(64e-6, 7, 100.0)
    x = numpy.linspace(0.0, 99.0, 50)
    height = road.heights(x, numpy.array([-0.1, 0.0, 0.2]))
    assert (height == height[:, :1]).all()
    numpy.testing.assert_allclose(road.heights(x + 300.0, CENTRE), height[:, :1], atol=1e-12)


def test_international_roughness_index_of_class_a_is_that_of_the_golden_car():
    """2.219 mm/m without the moving average: quarter car at 80 km/h, exact per harmonic, mean over seeds."""
    speed = 80.0 / 3.6
    n = numpy.arange(1, len(LINE) // 2 + 1) / LENGTH
    s = 2j * numpy.pi * n * speed
    tire, spring, damper, wheel = 653.0, 63.3, 6.0, 0.15  # divided by the body mass
    coupling = spring + damper * s
    wheel_motion = tire * (s**2 + coupling) / ((s**2 + coupling) * (wheel * s**2 + coupling + tire) - coupling**2)
    travel = wheel_motion * (coupling / (s**2 + coupling) - 1.0)
    indices = []
    for seed in range(4):
        height = Iso8608Road(16e-6, seed, LENGTH, 2.0, 0.3, 100.0).heights(LINE, CENTRE)[:, 0]
        rate = numpy.fft.irfft(numpy.concatenate(([0.0], numpy.fft.rfft(height)[1:] * travel * s)), len(LINE))
        indices.append(1e3 * numpy.mean(numpy.abs(rate)) / speed)
    assert numpy.mean(indices) == pytest.approx(2.219, rel=0.02)


def test_waves_below_two_cells_are_left_out_and_it_is_said():
    road = Iso8608Road(64e-6, 1, 100.0, lattice_cell=0.25)
    assert road.describe()["shortest_wavelength_m"] == 0.5
    assert any("below 0.5 m" in note for note in road.describe()["notes"])


def test_waves_longer_than_the_road_are_left_out_and_it_is_said():
    road = Iso8608Road(64e-6, 1, 50.0)
    assert road.describe()["longest_wavelength_m"] == 50.0
    assert any("longer than the road" in note for note in road.describe()["notes"])


def test_classes_are_four_times_as_rough_from_one_to_the_next():
    values = list(CLASS_ROUGHNESS.values())
    assert values[0] == 16e-6
    assert [b / a for a, b in itertools.pairwise(values)] == [4.0] * 7


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"roughness": -1.0}, "roughness"),
        ({"roughness": float("nan")}, "roughness"),
        ({"seed": -1}, "seed"),
        ({"seed": 1.5}, "seed"),
        ({"length": 0.0}, "length"),
        ({"exponent": 5.0}, "exponent"),
        ({"shortest_wavelength": 20.0, "longest_wavelength": 10.0}, "no wave"),
        ({"length": 1e6, "shortest_wavelength": 0.01}, "limit 16777216"),
        ({"texture_wavelength": 0.5}, "texture wavelength"),
    ],
)
def test_a_bad_road_is_refused(changes, message):
    with pytest.raises(ExcitationError, match=message):
        Iso8608Road(**{"roughness": 64e-6, "seed": 1, **changes})


def test_an_unknown_class_is_refused_with_the_allowed_ones():
    with pytest.raises(ExcitationError, match="'I' is unknown; allowed: A, B"):
        roughness_of_class("I")
