"""Master curve: the shift of a simulated material is found again; nothing is found where nothing tells it."""

import math

import numpy
import pytest

from contact_sim_pkg.rigs.impact.material.errors import MaterialError
from contact_sim_pkg.rigs.impact.material.estimate import EstimatedValue, MaterialEstimate
from contact_sim_pkg.rigs.impact.material.master_curve import master_curve
from contact_sim_pkg.rigs.impact.theory.shift import Arrhenius, Wlf, log_shift

TEMPERATURES = tuple(range(265, 335, 10))
SPEEDS = (0.3, 0.7, 1.5, 3.0)
NOISE = 0.003


def state(law, temperature, speed, random):
    """A group of a material whose modulus rises with the reduced speed as a glass transition does."""
    place = math.log10(speed) + log_shift(law, temperature) - log_shift(law, 300.0)
    modulus = 3e6 * math.exp(2.0 / (1.0 + math.exp(-0.8 * (place - 1.0)))) * (1.0 + NOISE * random.standard_normal())
    value = EstimatedValue(modulus, NOISE * modulus, modulus * (1 - 2 * NOISE), modulus * (1 + 2 * NOISE))
    return MaterialEstimate(20, float(temperature), speed, 0.6, value, value, EstimatedValue(0.2, 0.01, 0.18, 0.22))


def states(law, seed=0, speeds=SPEEDS, temperatures=TEMPERATURES):
    random = numpy.random.default_rng(seed)
    return [state(law, t, v, random) for t in temperatures for v in speeds]


@pytest.mark.parametrize("seed", range(5))
def test_the_glass_temperature_is_found_again(seed):
    found = master_curve(states(Wlf(223.0), seed), "wlf", reference=300.0)
    assert found.found == pytest.approx(223.0, abs=6.0)
    assert found.found_error is not None
    assert abs(found.found - 223.0) < 5.0 * found.found_error
    assert found.scatter < 3.0 * NOISE


@pytest.mark.parametrize("seed", range(5))
def test_the_activation_energy_is_found_again(seed):
    found = master_curve(states(Arrhenius(300.0, 9e4), seed), "arrhenius", reference=300.0)
    assert found.found == pytest.approx(9e4, rel=0.08)
    assert found.found_error is not None


def test_a_given_shift_places_every_group():
    groups = states(Wlf(223.0))
    found = master_curve(groups, "wlf", 223.0, 300.0)
    law = Wlf(223.0)
    for group, shift, speed in zip(groups, found.log_shift, found.reduced_speed, strict=True):
        assert shift == pytest.approx(log_shift(law, group.temperature) - log_shift(law, 300.0), abs=1e-12)
        assert speed == pytest.approx(group.speed * 10**shift, rel=1e-12)
    assert found.found is None
    assert found.law == law
    nearest = master_curve(groups, "wlf", 223.0)
    assert nearest.reference_temperature == 295.0


def test_one_speed_or_one_temperature_does_not_determine_the_shift():
    for groups in (states(Wlf(223.0), speeds=(1.0,)), states(Wlf(223.0), temperatures=(300,)), states(Wlf(223.0))[:4]):
        with pytest.raises(MaterialError, match="determine the shift"):
            master_curve(groups, "wlf")


def test_a_missing_temperature_and_one_outside_the_law_are_refused():
    groups = states(Wlf(223.0))
    with pytest.raises(MaterialError, match="column T"):
        master_curve([groups[0]._replace(temperature=None), *groups[1:]], "wlf", 223.0)
    with pytest.raises(MaterialError, match="pole"):
        master_curve(groups, "wlf", 330.0)
    with pytest.raises(MaterialError, match="glass temperature -3"):
        master_curve(groups, "wlf", -3.0)
    with pytest.raises(ValueError, match="shift 'vft'"):
        master_curve(groups, "vft")
