"""International Roughness Index: a road of one wave by the response of the golden car in closed form."""

import numpy as np
import pytest

from contact_sim_pkg.report.signal.roughness import roughness_index


def index_of_a_wave(length, amplitude):
    """IRI [m/km] of a sine: mean of |sprung - unsprung| slope, 2/pi of its amplitude, by the complex response."""
    speed, k1, k2, c, mu = 80.0 / 3.6, 653.0, 63.3, 6.0, 0.15
    w = 2.0 * np.pi * speed / length
    matrix = np.array(
        [[k2 - w**2 + 1j * w * c, -k2 - 1j * w * c], [-k2 - 1j * w * c, k1 + k2 - mu * w**2 + 1j * w * c]]
    )
    sprung, unsprung = np.linalg.solve(matrix, [0.0, k1])
    averaged = np.sinc(0.25 / length)  # over the 250 mm that the tire spans
    return 1e3 * 2.0 / np.pi * abs(sprung - unsprung) * averaged * amplitude * 2.0 * np.pi / length


@pytest.mark.parametrize("length", [2.0, 5.0, 12.0, 30.0])
def test_a_sine_has_the_response_of_the_golden_car(length):
    x = np.arange(0.0, 100.0 * length, 0.05)
    assert roughness_index(x, 0.003 * np.sin(2.0 * np.pi * x / length)) == pytest.approx(
        index_of_a_wave(length, 0.003), rel=0.01
    )


def test_it_goes_with_the_height_and_not_with_a_gradient():
    x = np.arange(0.0, 400.0, 0.1)
    height = 0.004 * np.random.default_rng(4).normal(size=x.size).cumsum() * np.sqrt(0.1)
    flat = roughness_index(x, height)
    assert roughness_index(x, 2.0 * height) == pytest.approx(2.0 * flat, rel=1e-9)
    assert roughness_index(x, height + 0.05 * x) == pytest.approx(flat, rel=1e-9)
    assert roughness_index(x, 0.05 * x) == pytest.approx(0.0, abs=1e-9)


def test_a_short_or_coarse_road_has_none():
    assert np.isnan(roughness_index(np.arange(0.0, 20.0, 0.1), np.zeros(200)))
    assert np.isnan(roughness_index(np.arange(0.0, 200.0, 0.5), np.zeros(400)))
    assert np.isnan(roughness_index(np.zeros(1), np.zeros(1)))
