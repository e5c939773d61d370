"""Spectra of seat tests on a platform: what is sent has the density that the filters of scipy give."""

import math

import numpy
import pytest
from scipy import integrate, signal

from contact_sim_pkg import load_scene, run
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.excitation.kinds import Setting, kind_of
from contact_sim_pkg.excitation.vibrations.platform import SPECTRA
from contact_sim_pkg.report.export.table import table_of

RATE, PERIOD = 1000.0, 180.0
BAND = 0.2  # [Hz]
# rms in m/s^2 of the unweighted signal as ISO 7096:2000 states it (table of the classes), quoted
STATED = {"EM1": 1.71, "EM2": 2.05, "EM4": 0.96, "EM7": 2.25}


def filtered(name, frequency):
    """G0 |H|^2 by scipy's analogue Butterworth filters."""
    plateau, high_poles, high, low_poles, low = SPECTRA[name]
    found = plateau
    for poles, edge, kind in ((high_poles, high, "high"), (low_poles, low, "low")):
        _, response = signal.freqs(
            *signal.butter(poles, 2.0 * math.pi * edge, kind, analog=True), 2.0 * math.pi * frequency
        )
        found = found * numpy.abs(response) ** 2
    return found


def banded(values, rate):
    """Mean density in bands of 0.2 Hz up to 20 Hz, and their middles."""
    lines = 2.0 * numpy.abs(numpy.fft.rfft(values)) ** 2 / (rate * values.size)
    width, count = round(BAND * values.size / rate), round(20.0 / BAND)
    frequency = numpy.arange(1, width * count + 1) * rate / values.size
    return frequency.reshape(count, width), lines[1 : width * count + 1].reshape(count, width).mean(axis=1)


def agrees(name, values):
    frequency, density = banded(values, RATE)
    expected = filtered(name, frequency.ravel()).reshape(frequency.shape).mean(axis=1)
    assert numpy.abs(density - expected).max() < 0.1 * expected.max()
    whole = math.sqrt(integrate.quad(lambda f: filtered(name, numpy.array([f]))[0], 0.01, 25.0, limit=200)[0])
    assert numpy.sqrt(numpy.mean(values**2)) == pytest.approx(whole, rel=0.03)


def sent(name, seed):
    section = kind_of("vibration", {"kind": "platform", "spectrum": name})
    time = numpy.arange(round(PERIOD * RATE)) / RATE
    return section.signal(Setting(seed, PERIOD, 1e-2, None)).acceleration(time)[1]


@pytest.mark.parametrize("name", SPECTRA)
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_density_and_the_rms_are_those_of_the_filters(name, seed):
    agrees(name, sent(name, seed))


@pytest.mark.parametrize(("name", "rms"), STATED.items())
def test_the_rms_is_the_stated_one(name, rms):
    assert numpy.sqrt(numpy.mean(sent(name, 1) ** 2)) == pytest.approx(rms, rel=0.03)


def test_seeds_differ_and_the_scale_multiplies():
    assert not numpy.allclose(sent("EM5", 1), sent("EM5", 2))
    doubled = kind_of("vibration", {"kind": "platform", "spectrum": "EM5", "scale": 2.0}).signal(
        Setting(1, PERIOD, 1e-2, None)
    )
    time = numpy.arange(100) / RATE
    assert doubled.acceleration(time)[1] == pytest.approx(2.0 * sent("EM5", 1)[:100], rel=1e-12, abs=1e-12)


def test_the_recorded_excitation_has_the_density_too(tmp_path):
    """The bag has what the platform did, block by block, each with both of its ends."""
    scene = load_scene("seat_ride", "duration=180", "vibration={kind: platform, spectrum: EM5}")
    time, *columns = table_of(open_bag(run(scene, tmp_path / "bag", progress=False).path), "vibration").columns
    _, first = numpy.unique(numpy.round(time.values, 6), return_index=True)
    values = next(each for each in columns if each.name == "acceleration_z").values[first][: round(PERIOD * RATE)]
    agrees("EM5", values)
