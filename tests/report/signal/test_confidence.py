"""A signal that breaks each assumption is named, one that keeps them is not; intervals hold what they say."""

import math

import numpy as np
import pytest
import scipy.stats

from contact_sim_pkg.report.signal import confidence

RATE = 500.0
NOISE = np.random.default_rng(7).normal(size=round(60 * RATE))


def test_a_long_fast_even_signal_breaks_nothing():
    assert confidence.short(NOISE.size, RATE) == ()
    assert confidence.slow(RATE) == ()
    assert confidence.peaky(5.0) == ()
    assert confidence.clipped(confidence.clipped_share(NOISE)) == ()


def test_each_broken_assumption_is_named_with_its_figure():
    assert confidence.short(round(3 * RATE), RATE) == ("too short: 3 s, 34 s needed",)
    assert confidence.slow(100.0)[0].startswith("wrong rate: 100 Hz carries nothing above 50 Hz")
    assert confidence.peaky(22.9) == ("crest factor 22.9 above 9: read VDV and MTVV",)
    clipped = np.clip(NOISE, -1.5, 1.5)
    share = confidence.clipped_share(clipped)
    assert 0.0 < share < 0.134  # a normal signal lies beyond 1.5 in 13.4 % of the time, few samples in runs of three
    slow = np.clip(np.sin(np.arange(10_000) / 100.0), -0.5, 0.5)
    assert confidence.clipped_share(slow) == pytest.approx(2.0 / 3.0, abs=0.01)
    assert confidence.clipped(confidence.clipped_share(slow))[0].startswith("clipped: 67 % of the samples")


def test_two_equal_extremes_are_no_clipping():
    values = NOISE.copy()
    values[10:12] = values.max() + 1.0
    assert confidence.clipped_share(values) == 0.0


def test_the_interval_of_a_mean_holds_it_in_95_of_100_records():
    generator = np.random.default_rng(3)
    held = 0
    for _ in range(200):
        values = generator.normal(size=6000) + 2.0
        held += abs(values.mean() - 2.0) <= confidence.spread_of_mean(values, 100.0)
    assert 0.89 <= held / 200 <= 0.99


def test_the_interval_of_few_values_is_that_of_students_t():
    """Of one degree of freedom at 0.975 t is tan(0.475 pi); two values 2 apart have the standard error 1."""
    assert confidence.half_interval([1.0, 3.0]) == pytest.approx(math.tan(0.475 * math.pi))
    assert confidence.half_interval([1.0, 2.0, 5.0, 7.0]) == pytest.approx(
        scipy.stats.t(3).ppf(0.975) * scipy.stats.sem([1.0, 2.0, 5.0, 7.0])
    )
    assert math.isnan(confidence.half_interval([1.0]))


def test_short_records_have_no_interval_and_a_constant_ratio_has_none_to_speak_of():
    assert math.isnan(confidence.spread_of_mean(NOISE[:1000], RATE))
    assert confidence.spread_of_ratio(0.5 * NOISE, NOISE, RATE) == pytest.approx(0.0, abs=1e-12)
    assert confidence.spread_of_rms(NOISE, RATE) == pytest.approx(1.96 / math.sqrt(2 * NOISE.size), rel=0.5)
