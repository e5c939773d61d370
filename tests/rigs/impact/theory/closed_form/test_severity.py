"""The frequency that the impact results in: published table, fold, uniqueness, inversion."""

import numpy
import pytest

from contact_sim_lab.rigs.impact.twins import goloshchapov
from contact_sim_pkg.rigs.impact.theory.closed_form.scaled_motion import scaled_impact
from contact_sim_pkg.rigs.impact.theory.closed_form.severity import (
    fold,
    loss_tangent_of_restitution,
    loss_tangent_of_severity,
    severity_of_loss_tangent,
)
from contact_sim_pkg.rigs.impact.theory.errors import FoldError, ImpactError

# tan(beta): k with end = force, k with end = gap, T with end = force
TABLE = {
    0.01: (0.9655, 0.9652, 3.1991), 0.02: (0.9330, 0.9315, 3.1806), 0.05: (0.8457, 0.8371, 3.1287),
    0.10: (0.7284, 0.6979, 3.0517), 0.20: (0.5644, 0.4701, 2.9243), 0.30: (0.4566, 0.2847, 2.8219),
    0.40: (0.3811, 0.0928, 2.7365), 0.60: (0.2829, None, 2.5998), 0.80: (0.2227, None, 2.4930),
    1.00: (0.1823, None, 2.4056),
}  # fmt: skip


@pytest.mark.parametrize("loss_tangent", TABLE)
def test_the_published_table_of_the_consistent_impact_comes_out(loss_tangent):
    at_force, at_gap, duration = TABLE[loss_tangent]
    found = scaled_impact(severity_of_loss_tangent(loss_tangent, "force"), "force")
    assert found.restitution == pytest.approx(at_force, abs=5.1e-5)
    assert found.duration == pytest.approx(duration, abs=5.1e-5)
    if at_gap is not None:
        gap = scaled_impact(severity_of_loss_tangent(loss_tangent, "gap"), "gap")
        assert gap.restitution == pytest.approx(at_gap, abs=5.1e-5)


@pytest.mark.parametrize(("loss_tangent", "end"), [(0.05, "force"), (0.7, "force"), (0.05, "gap"), (0.39, "gap")])
def test_the_severity_is_that_of_a_slow_search(loss_tangent, end):
    expected = goloshchapov.severity(loss_tangent, end)
    assert severity_of_loss_tangent(loss_tangent, end) == pytest.approx(expected, rel=2e-9)


def test_the_fold_of_the_end_rule_gap_lies_where_it_is_published():
    severity, loss_tangent = fold()
    assert severity == pytest.approx(2.2354, abs=5e-5)
    assert loss_tangent == pytest.approx(0.4037, abs=5e-5)
    assert scaled_impact(severity, "gap").restitution == pytest.approx(0.0679, abs=5e-5)
    assert loss_tangent_of_severity(severity * 0.98, "gap") < loss_tangent
    assert loss_tangent_of_severity(severity * 1.02, "gap") < loss_tangent


@pytest.mark.parametrize("loss_tangent", [0.40374, 0.5, 2.0])
def test_above_the_fold_the_refusal_names_the_bound(loss_tangent):
    with pytest.raises(FoldError, match=r"up to 0\.40373") as caught:
        severity_of_loss_tangent(loss_tangent, "gap")
    assert caught.value.bound == pytest.approx(0.4037334, abs=1e-7)
    assert caught.value.loss_tangent == loss_tangent


def test_just_below_the_fold_there_is_an_answer_on_the_branch_of_the_elastic_impact():
    bound = fold()[1]
    for part in (0.5, 0.9, 0.999, 1.0 - 1e-9):
        severity = severity_of_loss_tangent(part * bound, "gap")
        assert 0.0 < severity <= fold()[0]
        assert loss_tangent_of_severity(severity, "gap") == pytest.approx(part * bound, rel=1e-13)


def test_with_the_end_rule_force_every_loss_tangent_has_one_severity():
    severities = numpy.geomspace(1e-6, 1000.0, 200)
    found = numpy.array([loss_tangent_of_severity(z, "force") for z in severities])
    assert (numpy.diff(found) > 0.0).all()
    assert found[-1] > 100.0


@pytest.mark.parametrize("loss_tangent", [1e-6, 0.003, 0.1, 0.39, 1.0, 5.0])
@pytest.mark.parametrize("end", ["force", "gap"])
def test_the_restitution_gives_the_loss_tangent_back(loss_tangent, end):
    if end == "gap" and loss_tangent > 0.4:
        return
    restitution = scaled_impact(severity_of_loss_tangent(loss_tangent, end), end).restitution
    found = loss_tangent_of_restitution(restitution, end)
    assert found == pytest.approx(loss_tangent, rel=1e-12, abs=2e-16 / 1.0)


def test_a_small_loss_costs_3_545_times_its_tangent():
    for end in ("force", "gap"):
        restitution = scaled_impact(severity_of_loss_tangent(1e-5, end), end).restitution
        assert (1.0 - restitution) / 1e-5 == pytest.approx(3.545, abs=6e-4)


@pytest.mark.parametrize("loss_tangent", [-0.1, 101.0, float("nan"), float("inf")])
def test_a_loss_tangent_outside_the_range_is_refused(loss_tangent):
    with pytest.raises(ImpactError, match="loss tangent"):
        severity_of_loss_tangent(loss_tangent, "force")


@pytest.mark.parametrize("restitution", [-0.1, 0.0, 1.0 + 1e-12, float("nan")])
def test_a_restitution_outside_the_range_is_refused(restitution):
    with pytest.raises(ImpactError, match="restitution"):
        loss_tangent_of_restitution(restitution, "force")


@pytest.mark.parametrize("end", ["force", "gap"])
def test_a_vanishing_loss_tangent_has_the_severity_of_the_elastic_duration(end):
    duration = goloshchapov.elastic_limit()[0]
    for loss_tangent in (5e-324, 1e-300, 1e-45, 1e-17, 1e-15, 3e-13, 1e-10, 9.9e-9, 1.01e-8):
        found = severity_of_loss_tangent(loss_tangent, end)
        assert found == pytest.approx(3.0 * loss_tangent * duration / 3.141592653589793, rel=4e-15 + 4 * loss_tangent)
