"""Materials back from simulated impacts with noise: error, and how often the intervals cover the truth."""

import numpy
import pytest
from tests.rigs.impact.material import simulated

from contact_sim_pkg.rigs.impact.material.errors import MaterialError
from contact_sim_pkg.rigs.impact.material.estimate import each_impact, repeated_impacts
from contact_sim_pkg.rigs.impact.material.options import Options

MODULUS, SPEED, COUNT = 8.0e6, 2.0, 100
SEEDS = 400


def of(seed, loss_tangent, options=Options(), count=COUNT, noise=0.01):  # noqa: B008 - a tuple
    duration, restitution = simulated.exact_impact(MODULUS, loss_tangent, SPEED, options.end)
    impacts = simulated.repeats(duration, restitution, SPEED, count, noise, seed)
    return repeated_impacts(impacts, numpy.arange(count), options)


@pytest.mark.parametrize("loss_tangent", [0.05, 0.2, 0.7])
def test_a_hundred_impacts_with_one_per_cent_noise_give_the_material_back(loss_tangent):
    for seed in range(20):
        found = of(seed, loss_tangent)
        assert found.storage_modulus.value == pytest.approx(MODULUS, rel=0.01)
        assert found.loss_tangent.value == pytest.approx(loss_tangent, rel=0.02)


@pytest.mark.parametrize(("loss_tangent", "count", "confidence"), [(0.2, 100, 0.95), (0.05, 10, 0.95), (0.5, 5, 0.8)])
def test_the_intervals_cover_the_truth_at_their_rate(loss_tangent, count, confidence):
    options = Options(confidence=confidence)
    truth = (MODULUS, MODULUS * loss_tangent, loss_tangent)
    hits = numpy.zeros(3)
    for seed in range(SEEDS):
        found = of(1000 + seed, loss_tangent, options, count)
        values = (found.storage_modulus, found.loss_modulus, found.loss_tangent)
        hits += [value.low <= true <= value.high for value, true in zip(values, truth, strict=True)]
    spread = (confidence * (1.0 - confidence) / SEEDS) ** 0.5
    assert numpy.abs(hits / SEEDS - confidence).max() < 3.5 * spread


@pytest.mark.parametrize("loss_tangent", [0.05, 0.2])
def test_no_unbiased_reading_scatters_less(loss_tangent):
    """Bound of Cramer and Rao: every true impact speed unknown, noise of 1 % each, derivatives from the slow reference."""
    count, noise, seeds = 100, 0.01, 600
    k = simulated.exact_impact(MODULUS, loss_tangent, SPEED)[1]
    step = 0.01 * loss_tangent
    ends = [simulated.exact_impact(MODULUS, loss_tangent + part * step, SPEED) for part in (-1.0, 1.0)]
    slope_k = (ends[1][1] - ends[0][1]) / (2.0 * step)
    slope_log_duration = numpy.log(ends[1][0] / ends[0][0]) / (2.0 * step)
    # unknowns: ln E', tan(beta), then the logarithm of a speed; rows: V0, tau, k of one impact over their noise
    rows = numpy.array([[0.0, 0.0, 1.0], [-0.4, slope_log_duration, -0.2], [0.0, slope_k / k, 0.0]]) / noise
    whole = rows.T @ rows
    information = whole[:2, :2] - numpy.outer(whole[:2, 2], whole[2, :2]) / whole[2, 2]
    bound = numpy.sqrt(numpy.diag(numpy.linalg.inv(count * information)))
    found = [of(7000 + seed, loss_tangent, count=count, noise=noise) for seed in range(seeds)]
    errors = numpy.array(
        [[numpy.log(e.storage_modulus.value / MODULUS), e.loss_tangent.value - loss_tangent] for e in found]
    )
    spread = errors.std(axis=0) / bound
    assert numpy.abs(spread - 1.0).max() < 3.5 / numpy.sqrt(2.0 * seeds)
    assert numpy.abs(errors.mean(axis=0) / bound).max() < 0.13
    assert numpy.mean([e.loss_tangent.error for e in found]) == pytest.approx(bound[1], rel=0.02)


def test_five_per_cent_noise_does_not_bias_a_thousand_repeats():
    errors = [numpy.log(of(seed, 0.2, count=1000, noise=0.05).storage_modulus.value / MODULUS) for seed in range(40)]
    assert numpy.mean(errors) == pytest.approx(0.0, abs=0.0015)


def test_noise_above_one_in_single_restitutions_does_not_bias_the_mean():
    found = [of(seed, 0.005) for seed in range(60)]
    mean = numpy.mean([each.loss_tangent.value for each in found])
    assert mean == pytest.approx(0.005, rel=0.05)
    rows = each_impact(
        simulated.repeats(*simulated.exact_impact(MODULUS, 0.005, SPEED), SPEED, 100, 0.01, 1), Options()
    )
    refused = [row for row in rows if row["E'"] is None]
    assert len(refused) > 0
    assert all("restitution" in row["note"] for row in refused)


def test_each_impact_without_noise_is_the_truth():
    duration, restitution = simulated.exact_impact(MODULUS, 0.3, SPEED)
    for row in each_impact(simulated.repeats(duration, restitution, SPEED, 3, 0.0, 0), Options()):
        assert row["E'"] == pytest.approx(MODULUS, rel=1e-8)
        assert row["E''"] == pytest.approx(0.3 * MODULUS, rel=1e-8)
        assert row["tan_beta"] == pytest.approx(0.3, rel=1e-8)


def test_one_impact_alone_has_no_interval():
    found = of(0, 0.3, count=1, noise=0.0)
    assert found.storage_modulus.value == pytest.approx(MODULUS, rel=1e-8)
    assert (found.storage_modulus.error, found.storage_modulus.low, found.storage_modulus.high) == (None, None, None)


def test_the_end_rule_and_the_form_are_those_of_the_options():
    gap = of(0, 0.3, Options(end="gap"), count=2, noise=0.0)
    assert gap.loss_tangent.value == pytest.approx(0.3, rel=1e-7)
    duration, restitution = simulated.exact_impact(MODULUS, 0.3, SPEED)
    impacts = simulated.repeats(duration, restitution, SPEED, 2, 0.0, 0)
    printed = repeated_impacts(impacts, numpy.arange(2), Options(form="printed"))
    assert printed.loss_tangent.value == pytest.approx(numpy.pi / 3 * (1 - restitution) / (1 + restitution), rel=1e-12)
    expected = (
        5.03 * 0.02 / (2**0.5 * (2.0 * 0.01) ** 0.5 * duration**2.5) * (1 + restitution) ** 2.5 / restitution**1.5
    )
    assert printed.storage_modulus.value == pytest.approx(expected, rel=1e-12)


def test_a_mean_that_tells_no_material_is_refused_with_its_lines():
    impacts = simulated.repeats(1e-3, 1e-4, SPEED, 3, 0.0, 0)
    with pytest.raises(MaterialError, match=r"simulated, lines 2 to 4.*restitution"):
        repeated_impacts(impacts, numpy.arange(3), Options())


def test_a_mean_above_one_is_read_as_no_loss_and_noted():
    impacts = simulated.repeats(1e-3, 1.01, SPEED, 4, 0.0, 0)
    found = repeated_impacts(impacts, numpy.arange(4), Options())
    assert found.loss_tangent.value == 0.0
    assert "above 1" in found.note
    assert of(0, 0.2).note is None


def test_a_contact_so_long_that_the_sphere_would_sink_in_is_refused_with_its_lines():
    impacts = simulated.repeats(0.1, 0.7, SPEED, 3, 0.0, 0)
    with pytest.raises(MaterialError, match=r"simulated, lines 2 to 4: depth over radius"):
        repeated_impacts(impacts, numpy.arange(3), Options())
