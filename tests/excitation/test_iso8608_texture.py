"""The isotropic texture: its spectrum along a line against quadrature over the plane, with the profile against G(n)."""

import math

import numpy
import pytest
from scipy import integrate

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.iso8608_texture import Texture
from contact_sim_pkg.excitation.roads.iso8608 import Iso8608Road

LONGEST, SHORTEST = 0.3, 0.04
X = 8.0 * numpy.arange(2048) / 2048


def line_spectrum(height, length):
    amplitude = numpy.fft.rfft(height, axis=0) / len(height)
    return numpy.arange(len(amplitude)) / length, (2.0 * numpy.abs(amplitude) ** 2 * length).mean(axis=1)


def quadrature(n, exponent, scale):
    """Spectrum along a line: integral of q^-(w+1) over ny inside the ring, as a share of the whole plane's."""

    def plane(s):
        return (n**2 + s**2) ** (-0.5 * (exponent + 1.0))

    whole = integrate.quad(plane, 0.0, math.inf, epsrel=1e-9)[0]
    low = math.sqrt(max(LONGEST**-2 - n**2, 0.0))
    high = math.sqrt(max(SHORTEST**-2 - n**2, 0.0))
    return scale * n**-exponent * integrate.quad(plane, low, high, epsrel=1e-9)[0] / whole


@pytest.mark.parametrize("exponent", [1.5, 2.0, 3.0])
def test_share_of_the_spectrum_along_a_line_agrees_with_quadrature(exponent):
    texture = Texture(1.0, exponent, LONGEST, SHORTEST, 1)
    for n in (0.3, 2.0, 3.2, 3.5, 8.0, 20.0, 24.5):
        expected = quadrature(n, exponent, 1.0) * n**exponent
        assert float(texture.share(numpy.array(n))) == pytest.approx(expected, abs=1e-7)


def test_spectrum_along_and_across_is_the_one_requested():
    texture = Texture(64e-8, 2.0, LONGEST, SHORTEST, 3)
    across = 4.0 * numpy.arange(512) / 512
    # the strip as lines along x: all of it, so that the mean over the lines is over all phases
    height = texture.heights(X, across - 2.0)
    for profile, length in ((height, 8.0), (height.T, 4.0)):
        n, density = line_spectrum(profile, length)
        for low, high in ((4.0, 6.0), (6.0, 10.0), (10.0, 18.0)):
            band = (n >= low) & (n < high)
            expected = numpy.mean([quadrature(value, 2.0, 64e-8) for value in n[band]])
            assert density[band].mean() == pytest.approx(expected, rel=0.08)


def test_variance_is_that_of_the_ring_in_the_plane():
    # integral over the ring of C q^-3 = 2 pi C (longest - shortest), C = scale / 4 for w = 2
    texture = Texture(64e-8, 2.0, LONGEST, SHORTEST, 3)
    closed_form = math.sqrt(2.0 * math.pi * 16e-8 * (LONGEST - SHORTEST))
    assert texture.rms == pytest.approx(closed_form, rel=0.02)
    height = texture.heights(X, numpy.linspace(-2.0, 2.0, 64, endpoint=False))
    assert numpy.std(height) == pytest.approx(closed_form, rel=0.03)


def test_profile_and_texture_together_continue_one_spectrum():
    road = Iso8608Road(256e-6, 5, 8.0, texture_wavelength=SHORTEST)
    height = road.heights(X, numpy.linspace(-2.0, 2.0, 128, endpoint=False))
    n, density = line_spectrum(height, 8.0)
    for low, high in ((0.9, 2.0), (2.0, 3.2), (3.6, 6.0), (6.0, 10.0)):
        band = (n >= low) & (n < high)
        lost = numpy.sqrt(1.0 - (n[band] * SHORTEST) ** 2)  # share of an isotropic surface for w = 2
        expected = numpy.mean(256e-8 / n[band] ** 2 * lost)
        assert density[band].mean() == pytest.approx(expected, rel=0.12)


def test_interpolation_error_is_below_a_millionth_of_the_roads_rms():
    road = Iso8608Road(256e-6, 5, 100.0, texture_wavelength=SHORTEST)
    lattice = 8.0 * numpy.arange(1024) / 1024
    amplitude = numpy.fft.rfft(road.texture.heights(lattice, numpy.array([0.1]))[:, 0]) / 1024
    x = numpy.random.default_rng(1).uniform(0.0, 50.0, 2000)
    waves = numpy.arange(0, 256)
    factor = numpy.where(waves == 0, 1.0, 2.0) * amplitude[:256]
    exact = (factor * numpy.exp(2j * numpy.pi * numpy.outer(x, waves) / 8.0)).sum(axis=1).real
    error = road.texture.heights(x, numpy.array([0.1]))[:, 0] - exact
    assert numpy.sqrt(numpy.mean(error**2)) < 1e-6 * road.describe()["rms_m"]


def test_a_track_wider_than_the_strip_is_refused():
    with pytest.raises(ExcitationError, match="wider than the strip"):
        Texture(1e-8, 2.0, LONGEST, SHORTEST, 1).heights(X, numpy.array([-2.1, 2.1]))


def test_waves_wider_than_the_strip_are_refused():
    with pytest.raises(ExcitationError, match="does not fit its strip"):
        Texture(1e-8, 2.0, 5.0, SHORTEST, 1)


def test_too_fine_a_texture_is_refused_before_memory_is_taken():
    with pytest.raises(ExcitationError, match="limit"):
        Texture(1e-8, 2.0, 0.02, 0.01, 1).heights(X, numpy.linspace(-1.0, 1.0, 2000))
