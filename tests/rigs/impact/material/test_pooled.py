"""All speeds of a temperature together: narrower intervals where they agree, a note where they do not."""

import numpy
import pytest
from scipy import stats
from tests.rigs.impact.material import simulated

from contact_sim_pkg.rigs.impact.material.estimate import EstimatedValue, MaterialEstimate, repeated_impacts
from contact_sim_pkg.rigs.impact.material.groups import groups
from contact_sim_pkg.rigs.impact.material.options import Options
from contact_sim_pkg.rigs.impact.material.pooled import pooled_speeds
from contact_sim_pkg.rigs.impact.material.reading import Impacts
from contact_sim_pkg.rigs.impact.material.report import report_of

MODULUS, TANGENT = 8.0e6, 0.2


def many_speeds(seed, noise=0.01, stiffer=0.0, count=100, temperature=True):
    """``count`` impacts at as many speeds, 0.5 to 3 m/s; E' rises by ``stiffer`` a decade of speed."""
    random = numpy.random.default_rng(seed)
    speed = numpy.exp(random.uniform(numpy.log(0.5), numpy.log(3.0), count))
    duration, k = simulated.exact_impact(MODULUS, TANGENT, 1.0)
    modulus = 1.0 + stiffer * numpy.log10(speed)
    ones = numpy.ones(count)
    return Impacts(
        "simulated", numpy.arange(count), simulated.MASS * ones, simulated.RADIUS * ones,
        simulated.noisy(speed, noise, random), simulated.noisy(duration * speed**-0.2 * modulus**-0.4, noise, random),
        simulated.noisy(k * ones, noise, random), 293.0 * ones if temperature else None, (),
    )  # fmt: skip


@pytest.mark.parametrize("temperature", [True, False])
def test_a_hundred_impacts_at_a_hundred_speeds_tell_as_much_as_repeats(temperature):
    hits, alarms = numpy.zeros(2), 0
    for seed in range(200):
        impacts, options = many_speeds(seed, temperature=temperature), Options()
        estimates = [repeated_impacts(impacts, chosen, options) for chosen in groups(impacts, options)]
        (found,) = pooled_speeds(estimates, options)
        assert found.storage_modulus.value == pytest.approx(MODULUS, rel=0.011)
        assert found.loss_tangent.value == pytest.approx(TANGENT, rel=0.011)
        pairs = ((found.storage_modulus, MODULUS), (found.loss_tangent, TANGENT))
        hits += [value.low <= true <= value.high for value, true in pairs]
        alarms += found.note is not None
    assert (found.impacts, found.groups) == (100, 7)
    assert found.temperature == (293.0 if temperature else None)
    assert numpy.abs(hits / 200 - 0.95).max() < 3.5 * (0.95 * 0.05 / 200) ** 0.5
    assert alarms <= 8


def test_a_modulus_that_rises_with_speed_is_noted():
    (found,) = report_of(many_speeds(0, stiffer=0.15), Options()).pooled
    assert found.agreement < 1e-3
    assert "depends on speed" in found.note


def test_repeats_and_single_speeds_have_no_such_row():
    duration, k = simulated.exact_impact(MODULUS, TANGENT, 1.0)
    assert report_of(simulated.repeats(duration, k, 1.0, 20, 0.01, 0), Options()).pooled == []


def test_the_agreement_is_the_f_test_of_the_means():
    random = numpy.random.default_rng(3)
    samples = [random.normal(0.2, 0.01, count) for count in (4, 7, 9)]

    def value(sample):
        return EstimatedValue(float(sample.mean()), float(sample.std(ddof=1)) / len(sample) ** 0.5, None, None)

    storage = EstimatedValue(1.0, 1.0, None, None)  # the same in each: it tells nothing
    estimates = [
        MaterialEstimate(len(s), 293.0, 1.0 + i, 0.5, storage, value(s), value(s)) for i, s in enumerate(samples)
    ]
    (found,) = pooled_speeds(estimates, Options())
    assert found.agreement == pytest.approx(min(1.0, 2.0 * stats.f_oneway(*samples).pvalue), rel=1e-9)
    everything = numpy.concatenate(samples)
    within = sum(((s - s.mean()) ** 2).sum() for s in samples) / (20 - 3)
    half = stats.t.ppf(0.975, 17) * (within / 20) ** 0.5
    assert found.loss_tangent.value == pytest.approx(everything.mean(), rel=1e-12)
    assert found.loss_tangent.high - found.loss_tangent.value == pytest.approx(half, rel=1e-12)


def test_single_impacts_at_different_speeds_are_their_own_scatter():
    impacts = many_speeds(1, count=5)
    impacts = impacts._replace(speed=numpy.array([0.3, 0.5, 0.9, 1.6, 3.0]))
    report = report_of(impacts, Options())
    assert len(groups(impacts, Options())) == 5
    (found,) = report.pooled
    logs = numpy.log([each.storage_modulus.value for each in report.estimates])
    assert found.storage_modulus.value == pytest.approx(numpy.exp(logs.mean()), rel=1e-12)
    half = stats.t.ppf(0.975, 4) * logs.std(ddof=1) / 5**0.5
    assert numpy.log(found.storage_modulus.high / found.storage_modulus.value) == pytest.approx(half, rel=1e-12)
    assert found.agreement is None
