import numpy
import pytest

from comparisons.field.problems import hertz, rough, tire


def test_the_closed_form_of_hertz_carries_the_load():
    problem = hertz(256)
    assert problem.exact.sum() * problem.cell**2 == pytest.approx(problem.load, rel=1e-3)


def test_the_rough_surface_has_the_slope_the_band_and_the_exponent_that_are_asked_for():
    heights = -rough(256, 0.018, 3).gap(0)
    along = numpy.fft.fftfreq(256, 1 / 256)[:, None], numpy.fft.fftfreq(256, 1 / 256)[None, :]
    power = abs(numpy.fft.fft2(heights)) ** 2 / 256.0**4
    slope = (power * (2.0 * numpy.pi) ** 2 * (along[0] ** 2 + along[1] ** 2)).sum()
    assert numpy.sqrt(slope) == pytest.approx(0.1, rel=1e-9)
    wave = numpy.hypot(*along)
    assert power[(wave < 4) | (wave > 64)].max() < 1e-25
    low, high = (power[(wave >= a) & (wave < b)].mean() for a, b in ((8, 12), (32, 48)))
    assert numpy.log(low / high) / numpy.log(4.0) == pytest.approx(2.0 + 2.0 * 0.8, abs=0.25)


def test_the_tire_is_the_rolling_problem():
    problem = tire("128x96", 2, cells=2)
    assert (problem.rows, problem.cols, problem.cells) == (128, 96, 2)
    assert problem.mean_pressure == pytest.approx(4000.0 / (0.2 * 0.15))
    x = (numpy.arange(128) - 63.5) * problem.cell
    crown = (x**2 / 0.6)[:, None]  # beyond the crown both steps see the same road
    first, second = problem.gap(0) - crown, problem.gap(1) - crown
    numpy.testing.assert_allclose(second[:-2], first[2:], atol=1e-15)


def test_a_tire_that_has_gone_round_sees_its_road_again():
    problem = tire("128x96", 1, cells=32)
    numpy.testing.assert_array_equal(problem.gap(0), problem.gap(32))  # 1.6 m in steps of 50 mm
    assert abs(problem.gap(0) - problem.gap(31)).max() > 1e-3
