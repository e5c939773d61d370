"""Impacts that cannot be, and impacts far off their repeats: refused or named by their line."""

import numpy
import pytest

from contact_sim_pkg.rigs.impact.material.errors import MaterialError
from contact_sim_pkg.rigs.impact.material.options import Options
from contact_sim_pkg.rigs.impact.material.reading import Impacts
from contact_sim_pkg.rigs.impact.material.report import report_of


def impacts(k, tau=1e-3):
    k = numpy.array(k, dtype=float)
    ones = numpy.ones(len(k))
    return Impacts("a.csv", numpy.arange(2, 2 + len(k)), 0.02 * ones, 0.01 * ones, ones, tau * ones, k, None, ())


@pytest.mark.parametrize(("k", "line"), [([1.2], 2), ([1.06, 1.07, 1.06], 3), ([1.2] * 50, 2)])
def test_more_speed_after_than_before_is_refused_with_the_line(k, line):
    with pytest.raises(MaterialError, match=rf"a\.csv, line {line}: restitution {max(k)}, .* 0 to 1 is possible"):
        report_of(impacts(k), Options())


def test_a_mean_above_one_by_noise_is_read_as_no_loss():
    noisy = 1.1 + 0.3 * numpy.random.default_rng(2).standard_normal(9)
    assert noisy.mean() > 1.05  # by less than three standard errors
    for k in ([1.03], [1.03, 1.01], noisy):
        (found,) = report_of(impacts(k), Options()).estimates
        assert "above 1" in found.note


@pytest.mark.parametrize(
    ("k", "note"),
    [
        ([0.5, 1.3, 0.52], "k = 1.3 (line 3) far off the group's median 0.52"),
        ([0.5, 0.9], "k = 0.5 (line 2), 0.9 (line 3) far off the group's median 0.7"),
        ([0.5, 0.52, 0.48, 0.51, 0.2], "k = 0.2 (line 6) far off the group's median 0.5"),
        ([0.5, 0.52, 0.48], None),
        ([0.5], None),
    ],
)
def test_an_impact_far_off_its_repeats_is_named(k, note):
    (found,) = report_of(impacts(k), Options()).estimates
    assert found.note == note


def test_a_contact_time_far_off_is_named_whatever_the_noise_of_the_others():
    tau = 1e-3 * (1.0 + 0.02 * numpy.random.default_rng(0).standard_normal(40))
    k = 0.5 + 0.01 * numpy.random.default_rng(1).standard_normal(40)
    assert report_of(impacts(k, tau), Options()).estimates[0].note is None
    tau[7] *= 2.0
    assert "tau = " in report_of(impacts(k, tau), Options()).estimates[0].note
    assert "(line 9)" in report_of(impacts(k, tau), Options()).estimates[0].note
