"""Elastic law, foam and losses over their whole range against forty digits, and what they refuse."""

import math

import mpmath
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_pkg.laws.elastic_law import (
    approach_of_force,
    elastic_energy,
    elastic_force,
    elastic_order,
    elastic_stiffness,
)
from contact_sim_pkg.laws.normal_force import normal_force, normal_force_rate, pressure_factor, tension_event
from contact_sim_pkg.laws.parameters import FoamElastic, GeneralDissipative, NormalDissipative, NormalElastic

QUICK = settings(max_examples=60)
SIZE = st.floats(-12.0, 12.0).map(lambda power: 10.0**power)
POWER = st.builds(NormalElastic, SIZE, st.one_of(st.sampled_from([1.0, 1.5, 3.0]), st.floats(1.0, 3.0)))
FOAM = st.builds(
    lambda area, thickness, ratio, plateau, densification, r: FoamElastic(
        area, thickness, ratio * plateau, plateau, densification, r
    ),
    st.floats(1e-3, 10.0), st.floats(0.005, 2.0), st.floats(1.0 + 1e-6, 100.0), st.floats(10.0, 1e8), st.floats(0.0, 1e8),
    st.floats(0.1, 20.0),
)  # fmt: skip
RATE = st.floats(-1e3, 1e3)
GENERAL = st.builds(
    lambda coefficient, p, q, lowest: GeneralDissipative(coefficient, p, q, 1e-6 if q < 1.0 else 0.0, lowest),
    st.floats(0.0, 1e12), st.floats(0.0, 4.0), st.floats(0.0, 3.0), st.sampled_from([0.0, -math.inf]),
)  # fmt: skip


@QUICK
@given(POWER, SIZE)
def test_the_power_law_is_right_over_its_range(law, x):
    with mpmath.workdps(40):
        n, force = mpmath.mpf(law.exponent), law.coefficient * mpmath.mpf(x) ** law.exponent
        assert elastic_force(law, x) == pytest.approx(float(force), rel=1e-13)
        assert elastic_stiffness(law, x) == pytest.approx(float(n * force / x), rel=1e-13)
        assert elastic_energy(law, x) == pytest.approx(float(force * x / (n + 1)), rel=1e-13)
        assert approach_of_force(law, float(force)) == pytest.approx(x, rel=1e-13)
    assert elastic_order(law) == law.exponent


@QUICK
@given(FOAM, st.one_of(st.floats(-12.0, -2.0).map(lambda power: 10.0**power), st.floats(0.01, 0.999)))
def test_foam_is_right_over_its_range(foam, strain):
    x = strain * foam.thickness
    with mpmath.workdps(40):
        a, r = mpmath.mpf(foam.modulus) / foam.plateau, mpmath.mpf(foam.densification_exponent)

        def stress(e):
            stretch = 1 - e
            first = 1 / stretch - stretch ** (a - 1)
            return foam.plateau * first + foam.densification * (stretch ** (-r - 1) - 1 / stretch)

        e = mpmath.mpf(x) / foam.thickness
        stretch = 1 - e
        energy = foam.plateau * (-mpmath.log(stretch) - (1 - stretch**a) / a)
        energy += foam.densification * ((stretch**-r - 1) / r + mpmath.log(stretch))
        slope = foam.plateau * (stretch**-2 + (a - 1) * stretch ** (a - 2))
        slope += foam.densification * ((r + 1) * stretch ** (-r - 2) - stretch**-2)
        force = float(foam.area * stress(e))
        assert elastic_force(foam, x) == pytest.approx(force, rel=1e-10)
        assert elastic_stiffness(foam, x) == pytest.approx(float(foam.area / foam.thickness * slope), rel=1e-10)
        assert elastic_energy(foam, x) == pytest.approx(float(foam.area * foam.thickness * energy), rel=1e-10)
    assert approach_of_force(foam, force) == pytest.approx(x, rel=1e-9)
    assert elastic_order(foam) == 1.0


@QUICK
@given(POWER, st.floats(0.0, 100.0), st.floats(1e-9, 1.0), RATE, st.floats(0.1, 1.9))
def test_hunt_and_crossley_is_right_over_its_range(law, damping, x, rate, memory):
    loss = NormalDissipative(damping)
    factor = max(0.0, memory + damping * rate)
    force = law.coefficient * x**law.exponent
    assert normal_force(law, loss, x, rate, memory) == pytest.approx(force * factor, rel=1e-12, abs=1e-15 * force)
    assert tension_event(law, loss, x, rate, memory) == pytest.approx(memory + damping * rate, rel=1e-14, abs=1e-15)
    assert pressure_factor(law, loss, x, rate, memory) == pytest.approx(factor, rel=1e-12, abs=1e-14)
    moving = factor > 0.0
    expected = law.exponent * force / x * factor * rate + damping * force * 3.0 if moving else 0.0
    scale = abs(law.exponent * force / x * factor * rate) + damping * force * 3.0
    assert normal_force_rate(law, loss, x, rate, 3.0, memory) == pytest.approx(expected, rel=1e-12, abs=1e-13 * scale)


@QUICK
@given(POWER, GENERAL, st.floats(1e-9, 1.0), RATE)
def test_the_general_law_is_right_over_its_range(law, loss, x, rate):
    with mpmath.workdps(40):
        size = mpmath.sqrt(mpmath.mpf(rate) ** 2 + mpmath.mpf(loss.smoothing_speed) ** 2)
        power = mpmath.mpf(rate) * size ** (mpmath.mpf(loss.rate_exponent) - 1) if size else mpmath.mpf(0)
        elastic = law.coefficient * mpmath.mpf(x) ** law.exponent
        lost = loss.coefficient * mpmath.mpf(x) ** loss.approach_exponent * power
        expected = elastic + lost if loss.lowest_force < 0.0 else max(0, elastic + lost)
        scale = float(abs(elastic) + abs(lost))
    assert normal_force(law, loss, x, rate, 1.0) == pytest.approx(float(expected), rel=1e-12, abs=1e-13 * scale)
    margin = tension_event(law, loss, x, rate, 1.0)
    assert margin == math.inf if loss.lowest_force < 0.0 else (margin > 0.0) == (elastic + lost > 0)


@QUICK
@given(st.one_of(POWER, FOAM), st.one_of(st.none(), GENERAL), st.floats(max_value=0.0, allow_nan=False), RATE)
def test_without_an_approach_there_is_no_force(law, loss, x, rate):
    assert normal_force(law, loss, x, rate, 1.0) == normal_force_rate(law, loss, x, rate, 1.0, 1.0) == 0.0
    assert elastic_force(law, x) == elastic_stiffness(law, x) == elastic_energy(law, x) == 0.0
    assert approach_of_force(law, max(x, -1e300)) == 0.0
    assert pressure_factor(law, loss, x, rate, 1.0) == 1.0


GOOD = NormalElastic(1e5, 1.5)
SPONGE = FoamElastic(0.12, 0.08, 4e4, 3e3, 150.0, 3.0)
LOSS = GeneralDissipative(10.0, 0.5, 0.5, 1e-6, 0.0)


@pytest.mark.parametrize(
    ("law", "name"),
    [
        *[(GOOD._replace(**{name: bad}), name) for name in GOOD._fields for bad in (0.0, -1.0, math.nan, math.inf)],
        *[(SPONGE._replace(**{name: bad}), name) for name in SPONGE._fields for bad in (-1.0, math.nan, math.inf)],
        (SPONGE._replace(modulus=2e3), "modulus"),
        (SPONGE._replace(thickness=0.0), "thickness"),
    ],
)
def test_an_elastic_law_outside_its_range_is_refused(law, name):
    for function in (elastic_force, elastic_stiffness, elastic_energy, approach_of_force):
        with pytest.raises(ValueError, match=name):
            function(law, 0.01)
    with pytest.raises(ValueError, match=name):
        elastic_order(law)
    with pytest.raises(ValueError, match=name):
        normal_force(law, None, 0.01, 0.1, 1.0)


@pytest.mark.parametrize(
    ("loss", "name"),
    [
        *[(NormalDissipative(bad), "damping") for bad in (-1e-9, math.nan, math.inf)],
        *[(LOSS._replace(coefficient=bad), "coefficient") for bad in (-1.0, math.nan, math.inf)],
        *[(LOSS._replace(approach_exponent=bad), "approach exponent") for bad in (-1e-9, 4.1, math.nan)],
        *[(LOSS._replace(rate_exponent=bad), "rate exponent") for bad in (-1e-9, 3.1, math.nan)],
        *[(LOSS._replace(smoothing_speed=bad), "smoothing") for bad in (-1e-9, math.nan, math.inf)],
        *[(LOSS._replace(lowest_force=bad), "lowest force") for bad in (-1.0, 1.0, math.nan)],
    ],
)
def test_a_loss_outside_its_range_is_refused(loss, name):
    for function in (normal_force, tension_event, pressure_factor):
        with pytest.raises(ValueError, match=name):
            function(GOOD, loss, 0.01, 0.1, 1.0)
    with pytest.raises(ValueError, match=name):
        normal_force_rate(GOOD, loss, 0.01, 0.1, 0.0, 1.0)


def test_arguments_that_are_no_numbers_and_results_beyond_them_are_refused():
    for function in (elastic_force, elastic_stiffness, elastic_energy):
        with pytest.raises(ValueError, match="approach"):
            function(GOOD, math.nan)
        with pytest.raises(ValueError, match="of this law inf"):
            function(NormalElastic(1e300, 3.0), 1e200)
    with pytest.raises(ValueError, match="force"):
        approach_of_force(SPONGE, math.inf)
    for values in ((math.nan, 0.1, 1.0), (0.01, math.nan, 1.0), (0.01, 0.1, math.nan), (0.01, 0.1, -0.1)):
        with pytest.raises(ValueError, match="is needed"):
            normal_force(GOOD, LOSS, *values)
    with pytest.raises(ValueError, match="acceleration"):
        normal_force_rate(GOOD, None, 0.01, 0.1, math.nan, 1.0)
