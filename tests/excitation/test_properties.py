"""Every public form of road, vibration and travel given by formulas: checks over its domain, refusals outside."""

from __future__ import annotations

import inspect
import math

import numpy
import pytest
import scipy.integrate
import scipy.signal
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.properties import Table, positive

from contact_sim_pkg.excitation import signals, travel
from contact_sim_pkg.excitation.kinds import kind_of
from contact_sim_pkg.excitation.roads import iso8608
from contact_sim_pkg.excitation.vibrations import half_sine, noise, sine, sweep
from contact_sim_pkg.records.fields import Section

TABLE = Table()
holds = TABLE.holds
close = pytest.approx
ACROSS = numpy.zeros(1)


def test_each_public_name_is_in_the_table():
    modules = (iso8608, half_sine, noise, sine, signals, sweep, travel)
    public = {
        thing for module in modules for name, thing in vars(module).items()
        if (inspect.isclass(thing) or inspect.isfunction(thing)) and thing.__module__ == module.__name__ and name[0] != "_"
        if not (inspect.isclass(thing) and issubclass(thing, Section)) and not name.endswith("_key")  # of the schema
    }  # fmt: skip
    assert public - {case.function for case in TABLE} == {signals.Waveform, signals.require}  # a protocol; a guard


@holds(iso8608.roughness_of_class, name=st.sampled_from("ABCDEFGH"))
def _(found, name):
    assert found == close(16e-6 * 4 ** (ord(name) - ord("A")))


@holds(iso8608.band_variance, roughness=st.just(0.0) | positive(1e-6, 1e-2), exponent=st.just(1.0) | st.floats(1.0, 4.0),
       low=st.floats(0.01, 0.1), high=st.floats(0.1, 5.0), outside=({"low": 0.2, "high": 0.1}, {"low": 0.0}))  # fmt: skip
def _(found, roughness, exponent, low, high):
    expected = scipy.integrate.quad(lambda n: roughness * (n / 0.1) ** -exponent, low, high, epsabs=0.0)[0]
    assert found == close(expected, rel=1e-6)


@holds(iso8608.Iso8608Road, roughness=st.just(0.0) | positive(1e-6, 1e-2), seed=st.integers(0, 9), length=st.just(20.0),
       exponent=st.floats(1.0, 4.0), shortest_wavelength=st.just(0.5), longest_wavelength=st.just(10.0), lattice_cell=st.just(0.0),
       outside=({"roughness": 1.01}, {"seed": 0.5}, {"exponent": 0.9}, {"longest_wavelength": 0.4}), examples=10)  # fmt: skip
def _(found, roughness, seed, length, exponent, shortest_wavelength, longest_wavelength, lattice_cell):
    """The variance of the heights over one length is the integral of the spectrum over the band, for every seed."""
    expected = scipy.integrate.quad(lambda n: roughness * (n / 0.1) ** -exponent, 0.1, 2.0)[0]
    x = numpy.linspace(0.0, length, 4096, endpoint=False)
    heights = found.heights(x, ACROSS)[:, 0]
    assert numpy.mean(heights**2) == close(expected, rel=1e-4)
    assert found.heights(x[:9] + 3.0 * length, ACROSS)[:, 0] == close(heights[:9], abs=1e-9 * math.sqrt(expected))


def obstacle(shape, position, height, length, flank, period):
    size = {"depth": abs(height)} if shape == "pothole" else {"height": height}
    flanks = {} if shape == "bump" else {"edge": flank}
    keys = {"kind": shape, "position": position, "length": length, "period": period}
    return kind_of("road", {**keys, **size, **flanks})


@settings(max_examples=30)
@given(st.sampled_from(["bump", "cleat", "pothole"]), st.integers(-5, 5), st.floats(0.01, 0.5), st.floats(0.1, 1.0),
       st.just(0.0) | positive(1e-4, 0.05), st.none() | st.floats(1.0, 5.0))  # fmt: skip
def test_an_obstacle_adds_its_volume(shape, position, height, length, flank, period):
    """The volume that it adds to a metre of road's width."""
    found = obstacle(shape, position, height, length, flank, period)
    x = position + numpy.linspace(-0.5, 0.5, 20001) * (1.0 if period is None else period)
    heights = found.heights(x, ACROSS)[:, 0]
    volume = {"bump": 0.5 * length, "cleat": length - flank, "pothole": flank - length}[shape] * height
    assert scipy.integrate.trapezoid(heights, x) == close(volume, abs=1e-3 * abs(height) + 1e-12)
    assert heights[10000] == close(-height if shape == "pothole" else height)


RANGE, LOW, HIGH = st.floats(0.0, 100.0), st.floats(1.0, 20.0), st.floats(21.0, 60.0)
TIMES = numpy.linspace(0.0, 1.0, 201)


@holds(
    sine.Sine,
    amplitude=RANGE,
    frequency=LOW,
    phase=st.floats(-3.0, 3.0),
    outside=({"amplitude": 1.1e4}, {"frequency": -1.0}),
)
def _(found, amplitude, frequency, phase):
    expected = (amplitude * numpy.exp(1j * (2.0 * math.pi * frequency * TIMES + phase))).imag
    assert found.values(TIMES) == close(expected, abs=1e-9)


@holds(sweep.SweepSignal, amplitude=RANGE, start=LOW, end=HIGH, duration=st.just(1.0), logarithmic=st.booleans(),
       outside=({"start": 5.0, "end": 5.0}, {"duration": 0.0}))  # fmt: skip
def _(found, amplitude, start, end, duration, logarithmic):
    method = "logarithmic" if logarithmic else "linear"
    chirp = amplitude * scipy.signal.chirp(TIMES, start, duration, end, method, phi=-90)
    assert found.values(TIMES) == close(chirp, abs=1e-7)


@holds(half_sine.HalfSine, peak=st.floats(-100.0, 100.0), start=st.floats(0.0, 0.5), duration=st.floats(0.1, 0.5),
       outside=({"duration": 0.0},))  # fmt: skip
def _(found, peak, start, duration):
    t = numpy.linspace(0.0, 1.0, 20001)
    assert scipy.integrate.trapezoid(found.values(t), t) == close(2.0 / math.pi * peak * duration, rel=1e-5, abs=1e-9)
    assert found.values(numpy.array([start + 0.5 * duration])) == close(numpy.array([peak]))


@holds(noise.NoiseSignal, rms=RANGE, low=LOW, high=HIGH, seed=st.integers(0, 9), period=st.just(20.0),
       outside=({"low": 30.0, "high": 20.0}, {"period": 0.01}, {"seed": 1.5}), examples=8)  # fmt: skip
def _(found, rms, low, high, seed, period):
    """Exactly its rms over a period, and nothing outside the band."""
    t = numpy.arange(4096) * period / 4096
    values = found.values(t)
    assert numpy.mean(values**2) == close(rms**2, rel=1e-5)
    spectrum, wave = abs(numpy.fft.rfft(values)), numpy.arange(2049) / period
    assert spectrum[(wave < low - 1e-9) | (wave > high + 1e-9)].max() <= 1e-4 * spectrum.max() + 1e-12


@holds(
    signals.AxisSignal,
    x=st.just((sine.Sine(2.0, 3.0),)),
    z=st.just((sine.Sine(1.0, 5.0), half_sine.HalfSine(3.0, 0.2, 0.1))),
)
def _(found, x, z):
    along, up = found.acceleration(TIMES)
    assert along == close(x[0].values(TIMES))
    assert up == close(z[0].values(TIMES) + z[1].values(TIMES))


PROGRAMME = st.lists(st.tuples(st.floats(0.1, 2.0), st.floats(-40.0, 40.0)), min_size=1, max_size=5).map(
    lambda steps: tuple(zip(numpy.cumsum([s[0] for s in steps]).tolist(), [s[1] for s in steps], strict=True))
)


@holds(
    travel.Travel,
    points=PROGRAMME,
    outside=({"points": ()}, {"points": ((1.0, 2.0), (1.0, 3.0))}, {"points": ((0.0, 150.1),)}),
)
def _(found, points):
    """The travel is the integral of the speed; its extent holds all of it and is reached."""
    times, speeds = zip(*points, strict=True)
    t = numpy.unique(numpy.append(numpy.linspace(0.0, times[-1] + 1.0, 2001), times))
    speed = numpy.interp(t, times, speeds)
    way = scipy.integrate.cumulative_trapezoid(speed, t, initial=0.0)
    assert [found.position(x) for x in t] == close(way.tolist(), abs=1e-9)
    assert [found.speed(x) for x in t] == close(speed.tolist(), abs=1e-9)
    low, high = found.extent(0.0, float(t[-1]))
    step = abs(speed).max() * (t[1] - t[0])
    assert low <= way.min() + 1e-9
    assert high >= way.max() - 1e-9
    assert (low, high) == close((way.min(), way.max()), abs=step + 1e-9)


test_each_holds_over_its_domain, test_each_refuses_what_it_cannot_do, _ = TABLE.tests("", ())
