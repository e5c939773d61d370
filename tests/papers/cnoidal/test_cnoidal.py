"""The quadratic oscillator against scipy's integration, and the preloaded contact against its energy integral."""

import itertools
import math

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from contact_sim_lab.papers.cnoidal.cnoidal import (
    CnoidalError,
    QuadraticOscillator,
    contact_oscillator,
    position,
    released_at,
)
from contact_sim_lab.papers.cnoidal.periodic_contact import exact_period
from contact_sim_pkg.laws.parameters import NormalElastic

TIMES = numpy.linspace(0.0, 6.0, 121)


def integrated(oscillator, start):
    w, k = oscillator
    found = solve_ivp(
        lambda _t, y: [y[1], -w * w * y[0] - k * y[0] ** 2], (0.0, TIMES[-1]), [start, 0.0], "DOP853", TIMES,
        rtol=1e-13, atol=1e-15,
    )  # fmt: skip
    return found.y


@pytest.mark.parametrize("quadratic", [5.0, -5.0, 0.3, 0.0])
@pytest.mark.parametrize("start", [0.7, 0.2, 1e-3, -0.2, -0.7])
def test_the_motion_is_that_of_the_integrated_oscillator(quadratic, start):
    oscillator = QuadraticOscillator(3.0, quadratic)
    motion = released_at(oscillator, start)
    numpy.testing.assert_allclose(position(motion, TIMES), integrated(oscillator, start)[0], atol=2e-12)


@pytest.mark.parametrize("quadratic", [5.0, -5.0])
@pytest.mark.parametrize("start", [0.7, -0.7])
def test_the_turning_points_have_the_same_energy_and_half_a_period_between_them(quadratic, start):
    motion = released_at(QuadraticOscillator(3.0, quadratic), start)

    def level(y):
        return quadratic * y**3 / 3.0 + 4.5 * y**2

    assert level(motion.turn) == pytest.approx(level(motion.start), rel=1e-13)
    assert position(motion, 0.5 * motion.period) == pytest.approx(motion.turn, rel=1e-12)
    assert position(motion, motion.period) == pytest.approx(motion.start, rel=1e-12)


def test_at_the_saddle_the_motion_is_homoclinic_and_says_so():
    motion = released_at(QuadraticOscillator(3.0, 5.0), 0.9)
    assert motion.homoclinic
    assert math.isinf(motion.period)
    expected = 2.7 / numpy.cosh(1.5 * TIMES) ** 2 - 1.8
    numpy.testing.assert_allclose(position(motion, TIMES), expected, atol=1e-13)


def test_the_period_grows_without_bound_towards_the_saddle():
    periods = [released_at(QuadraticOscillator(3.0, 5.0), 0.9 * (1.0 - 10.0**-i)).period for i in range(1, 12, 2)]
    assert all(later > earlier + 0.5 for earlier, later in itertools.pairwise(periods))


@pytest.mark.parametrize(("quadratic", "start"), [(5.0, 0.91), (5.0, -1.9), (-5.0, 1.9), (-5.0, -0.91)])
def test_a_release_beyond_the_saddle_is_refused(quadratic, start):
    with pytest.raises(CnoidalError, match="runs away"):
        released_at(QuadraticOscillator(3.0, quadratic), start)


@pytest.mark.parametrize("values", [(0.0, 1.0, 0.1), (-1.0, 1.0, 0.1), (1.0, math.nan, 0.1), (1.0, 1.0, math.inf)])
def test_an_oscillator_without_sense_is_refused(values):
    with pytest.raises(ValueError, match="needs finite numbers and w0 above 0"):
        released_at(QuadraticOscillator(*values[:2]), values[2])


@pytest.mark.parametrize(
    ("part", "linear", "cnoidal"),
    [(0.1, -0.042, -0.016), (0.3, -0.40, -0.16), (0.5, -1.2, -0.51), (0.8, -4.0, -2.0)],
)
def test_a_preloaded_contact_has_the_period_errors_of_the_table(part, linear, cnoidal):
    """n = 3/2; in percent of the energy integral."""
    law, mass, preload = NormalElastic(2.46e5, 1.5), 45.6, 45.6 * 9.81
    oscillator, rest = contact_oscillator(mass, law, preload)
    exact = exact_period(law, mass, preload, rest * (1.0 + part))
    allowed = 0.05 * abs(linear) if part > 0.1 else 6e-4
    assert 100.0 * (2.0 * math.pi / oscillator.frequency / exact - 1.0) == pytest.approx(linear, abs=allowed)
    assert 100.0 * (released_at(oscillator, part * rest).period / exact - 1.0) == pytest.approx(
        cnoidal, abs=0.05 * abs(cnoidal)
    )


def test_the_oscillator_of_a_contact_holds_the_first_two_derivatives_of_its_force():
    law, mass, preload = NormalElastic(3.0e4, 2.2), 7.0, 150.0
    oscillator, rest = contact_oscillator(mass, law, preload)
    assert law.coefficient * rest**law.exponent == pytest.approx(preload, rel=1e-14)
    h = 1e-4 * rest
    low, middle, high = (law.coefficient * (rest + i * h) ** law.exponent / mass for i in (-1, 0, 1))
    assert oscillator.frequency**2 == pytest.approx((high - low) / (2.0 * h), rel=1e-7)
    assert oscillator.quadratic == pytest.approx((high - 2.0 * middle + low) / (2.0 * h * h), rel=1e-5)


@pytest.mark.parametrize(("mass", "preload"), [(0.0, 1.0), (1.0, 0.0), (-1.0, 1.0)])
def test_a_contact_without_mass_or_preload_is_refused(mass, preload):
    with pytest.raises(ValueError, match="above 0"):
        contact_oscillator(mass, NormalElastic(1.0, 1.5), preload)


@settings(max_examples=60)
@given(
    st.floats(-30.0, 30.0).map(lambda power: 10.0**power),
    st.floats(-30.0, 30.0).map(lambda power: 10.0**power),
    st.sampled_from([1.0, -1.0]),
    st.one_of(st.floats(-0.999, 0.499), st.floats(-18.0, -2.0).map(lambda power: 10.0**power)),
)
def test_the_motion_keeps_its_energy_over_the_whole_range(frequency, quadratic, sign, part):
    """Both turning points lie on one level of ``w0^2 y^2/2 + k y^3/3``, the motion runs between them once a period."""
    reach = frequency * (frequency / quadratic)
    oscillator, start = QuadraticOscillator(frequency, sign * quadratic), sign * part * reach
    motion = released_at(oscillator, start)

    def level(y):
        u = sign * y / reach
        return u * u * (0.5 + u / 3.0)

    assert level(motion.turn) == pytest.approx(level(start), rel=1e-11, abs=1e-300)
    assert motion.start == start
    assert motion.period * frequency >= 2.0 * math.pi * (1.0 - 1e-12)
    places = position(motion, motion.period * numpy.array([0.0, 0.25, 0.5, 0.75, 1.0]))
    width = abs(motion.turn - start)
    numpy.testing.assert_allclose(places[[0, 2, 4]], [start, motion.turn, start], rtol=0.0, atol=1e-11 * width)
    assert places[1] == pytest.approx(places[3], rel=0.0, abs=1e-11 * width)


def test_what_the_cnoidal_motion_cannot_do_is_refused():
    for bad in (math.nan, math.inf):
        with pytest.raises(ValueError, match="finite"):
            position(released_at(QuadraticOscillator(3.0, 5.0), 0.1), [0.0, bad])
        with pytest.raises(ValueError, match="above 0"):
            contact_oscillator(bad, NormalElastic(1.0, 1.5), 1.0)
        with pytest.raises(ValueError, match="elastic coefficient"):
            contact_oscillator(1.0, NormalElastic(bad, 1.5), 1.0)
    for values in ((1e-200, 1.0, 0.1), (1.0, 1e200, 0.1), (1.0, 1.0, 1e200)):
        with pytest.raises(ValueError, match="beyond"):
            released_at(QuadraticOscillator(*values[:2]), values[2])
