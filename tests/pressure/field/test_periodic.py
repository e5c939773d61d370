import numpy
import pytest

from contact_sim_pkg.pressure.field.halfspace import displacement, make_buffers
from contact_sim_pkg.pressure.field.periodic import PeriodicField, make_periodic_half_space
from contact_sim_pkg.pressure.field.solver import CONVERGED

MODULUS = 3e6
LENGTH = 0.2


def wavy_gap(rows, cols, amplitude):
    x = (numpy.arange(rows) + 0.5) / rows * LENGTH - 0.5 * LENGTH  # the crest lies in the middle
    return numpy.repeat(amplitude * (1.0 - numpy.cos(2.0 * numpy.pi * x / LENGTH))[:, None], cols, axis=1), x


def solved(rows, cols, amplitude, mean_pressure, tolerance=1e-10):
    gap, x = wavy_gap(rows, cols, amplitude)
    cell = LENGTH / rows
    field = PeriodicField(make_periodic_half_space(rows, cols, cell, cell, MODULUS))
    load = mean_pressure * rows * cols * cell**2
    return field.solve_at_load(gap, load, tolerance, 2000), field.pressure, x


@pytest.mark.parametrize(("rows", "cols"), [(48, 30), (64, 16), (36, 27)])
def test_a_wave_of_pressure_displaces_by_its_wave_length(rows, cols):
    half_space = make_periodic_half_space(rows, cols, 1e-3, 2e-3, MODULUS)
    phase = 2.0 * numpy.pi * (3.0 * numpy.arange(rows)[:, None] / rows + 2.0 * numpy.arange(cols)[None, :] / cols)
    wave_number = 2.0 * numpy.pi * numpy.hypot(3.0 / (rows * 1e-3), 2.0 / (cols * 2e-3))
    found = numpy.empty((rows, cols))
    displacement(half_space, make_buffers(half_space), 7.0 + numpy.cos(phase), found)
    numpy.testing.assert_allclose(found, 2.0 / (MODULUS * wave_number) * numpy.cos(phase), rtol=0, atol=1e-18)


def test_the_mean_pressure_displaces_nothing():
    half_space = make_periodic_half_space(24, 32, 1e-3, 1e-3, MODULUS)
    found = numpy.empty((24, 32))
    displacement(half_space, make_buffers(half_space), numpy.full((24, 32), 5.0), found)
    numpy.testing.assert_allclose(found, 0.0, atol=1e-20)


def test_full_contact_of_a_wave_has_the_closed_form():
    amplitude = 1e-5
    swing = numpy.pi * MODULUS * amplitude / LENGTH  # Johnson (1985), eq. 13.2
    result, pressure, x = solved(64, 48, amplitude, 1.5 * swing)
    assert result.status == CONVERGED
    exact = swing * (1.5 + numpy.cos(2.0 * numpy.pi * x / LENGTH))
    numpy.testing.assert_allclose(pressure, numpy.repeat(exact[:, None], 48, axis=1), rtol=1e-6)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.85])
def test_part_contact_of_a_wave_is_that_of_westergaard(share):
    amplitude = 1e-4
    mean = share * numpy.pi * MODULUS * amplitude / LENGTH
    result, pressure, x = solved(512, 48, amplitude, mean, tolerance=1e-8)
    assert result.status == CONVERGED
    angle, edge = numpy.pi * x / LENGTH, numpy.sqrt(share)  # sin(pi a / wave length), Johnson (1985), eq. 13.4
    inside = numpy.maximum(edge**2 - numpy.sin(angle) ** 2, 0.0)
    exact = 2.0 * mean * numpy.cos(angle) / edge**2 * numpy.sqrt(inside)
    error = numpy.linalg.norm(pressure[:, 20] - exact) / numpy.linalg.norm(exact)
    assert error < 0.01
    numpy.testing.assert_allclose(pressure, numpy.repeat(pressure[:, :1], 48, axis=1), rtol=1e-4, atol=1e-4 * mean)


def test_moving_the_surface_through_the_period_moves_the_field():
    rng = numpy.random.default_rng(4)
    wave = numpy.hypot(numpy.fft.fftfreq(48, 1 / 48)[:, None], numpy.fft.rfftfreq(64, 1 / 64)[None, :])
    spectrum = numpy.where((wave > 0) & (wave < 8), 1.0 / numpy.maximum(wave, 1.0) ** 2, 0.0)
    gap = 1e-4 * numpy.fft.irfft2(numpy.fft.rfft2(rng.standard_normal((48, 64))) * spectrum, (48, 64))
    field = PeriodicField(make_periodic_half_space(48, 64, 1e-3, 1e-3, MODULUS))
    first = field.solve_at_load(gap, 0.5, 1e-11, 2000)
    before = field.pressure.copy()
    assert 0.02 < (before > 0.0).mean() < 0.9
    second = field.solve_at_load(numpy.roll(gap, (31, 50), (0, 1)), 0.5, 1e-11, 2000)
    assert first.status == second.status == CONVERGED
    numpy.testing.assert_allclose(
        field.pressure, numpy.roll(before, (31, 50), (0, 1)), rtol=0, atol=1e-7 * before.max()
    )
