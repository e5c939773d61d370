"""Shifts over temperature: published point, inverses, poles, and the impact that they carry over."""

import math

import pytest

from contact_sim_pkg.rigs.impact.theory import shift
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError

RUBBER = shift.Wlf(223.0)
ARRHENIUS = shift.Arrhenius(293.0, 8e4)


def test_the_published_equivalent_temperature_comes_out():
    assert shift.equivalent_temperature(RUBBER, 293.0, 100.0, 2.0) == pytest.approx(270.30, abs=5e-3)


@pytest.mark.parametrize("law", [RUBBER, ARRHENIUS])
@pytest.mark.parametrize("temperature", [224.0, 260.0, 293.0, 320.0])
def test_shift_and_temperature_are_inverse(law, temperature):
    assert shift.temperature_of_shift(law, shift.log_shift(law, temperature)) == pytest.approx(temperature, rel=1e-12)
    assert shift.equivalent_temperature(law, temperature, 2.0, 2.0) == pytest.approx(temperature, rel=1e-12)


def test_arrhenius_takes_the_natural_logarithm_of_ten_and_the_gas_constant():
    expected = 8e4 / (math.log(10.0) * 8.31446261815324) * (1 / 273.0 - 1 / 293.0)
    assert shift.log_shift(ARRHENIUS, 273.0) == pytest.approx(expected, rel=1e-14)


def test_faster_is_colder():
    for law in (RUBBER, ARRHENIUS):
        assert shift.equivalent_temperature(law, 293.0, 20.0, 2.0) < 293.0
        assert shift.equivalent_temperature(law, 293.0, 0.2, 2.0) > 293.0


@pytest.mark.parametrize("temperature", [171.4, 171.0, 100.0])
def test_wlf_refuses_its_pole_and_what_lies_below(temperature):
    with pytest.raises(ImpactError, match=r"pole at 171\.4 K"):
        shift.log_shift(RUBBER, temperature)
    assert shift.log_shift(RUBBER, 171.5) > 1e3


@pytest.mark.parametrize("temperature", [0.0, -20.0, math.nan])
def test_a_temperature_must_be_absolute(temperature):
    with pytest.raises(ImpactError, match="temperature"):
        shift.log_shift(ARRHENIUS, temperature)


def test_outside_the_range_of_wlf_there_is_a_note():
    assert shift.shift_note(RUBBER, 222.0) is not None
    assert shift.shift_note(RUBBER, 324.0) is not None
    assert shift.shift_note(RUBBER, 293.0) is None
    assert shift.shift_note(ARRHENIUS, 100.0) is None


@pytest.mark.parametrize("value", [-17.44, -20.0])
def test_a_shift_that_no_temperature_has_is_refused(value):
    with pytest.raises(ImpactError, match="shift"):
        shift.temperature_of_shift(RUBBER, value)
    with pytest.raises(ImpactError, match="shift"):
        shift.temperature_of_shift(ARRHENIUS, -1e3)


def test_the_contact_time_carries_the_fifth_root_of_the_speed():
    assert shift.carried_duration(1e-3, 100.0, 2.0) == pytest.approx(1e-3 * 50**-0.2)
