"""The impact in its own units against closed forms and a slow integration in time."""

import itertools
import math

import numpy
import pytest
from scipy.integrate import solve_ivp

from contact_sim_lab.rigs.impact.twins import goloshchapov
from contact_sim_pkg.rigs.impact.theory.closed_form.scaled_motion import scaled_course, scaled_impact
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError


@pytest.mark.parametrize("end", ["force", "gap"])
def test_without_loss_the_closed_forms_come_out_to_rounding(end):
    duration, depth = goloshchapov.elastic_limit()
    found = scaled_impact(0.0, end)
    assert found.duration == pytest.approx(duration, rel=3e-15)
    assert found.depth == pytest.approx(depth, rel=3e-15)
    assert found.peak_force == pytest.approx(depth**1.5, rel=3e-15)
    assert found.restitution == pytest.approx(1.0, rel=3e-15)
    assert found.turning_time == pytest.approx(duration / 2.0, rel=3e-15)


@pytest.mark.parametrize("severity", [1e-3, 0.03, 0.29141108544940847, 1.0, 2.2354, 6.0])
@pytest.mark.parametrize("end", ["force", "gap"])
def test_every_result_is_that_of_a_slow_integration_in_time(severity, end):
    expected = goloshchapov.impact(severity, end)
    found = scaled_impact(severity, end)
    allowed = {"abs": 1e-10, "rel": 1e-9}
    assert found.duration == pytest.approx(expected.duration, **allowed)
    assert found.restitution == pytest.approx(expected.restitution, **allowed)
    assert found.depth == pytest.approx(expected.depth, **allowed)
    assert found.turning_time == pytest.approx(expected.turning_time, **allowed)
    assert found.peak_force == pytest.approx(expected.peak_force, **allowed)


@pytest.mark.parametrize("severity", [1e-300, 1e-15, 1e-12, 1e-8, 1e-5])
def test_a_vanishing_loss_tends_to_the_elastic_impact(severity):
    """First order: 1 - k = zeta times the integral of sqrt(X) X' over the way, ``2 int sqrt(X) sqrt(1 - (X/X_m)^(5/2)) dX``."""
    found = scaled_impact(severity, "force")
    duration, depth = goloshchapov.elastic_limit()
    # X = X_m w^(2/5): int X^(1/2) sqrt(1 - w) dX = 2/5 X_m^(3/2) B(3/5, 3/2)
    lost = 0.8 * depth**1.5 * math.gamma(0.6) * math.gamma(1.5) / math.gamma(2.1)
    assert 1.0 - found.restitution == pytest.approx(severity * lost, rel=2e-9 + 2 * severity, abs=2e-15)
    assert found.duration == pytest.approx(duration, rel=2 * severity + 4e-15)


@pytest.mark.parametrize("severity", [0.0, 0.3, 3.0])
def test_the_course_is_that_of_a_slow_integration_in_time(severity):
    times = numpy.linspace(0.0, scaled_impact(severity, "force").duration, 41)

    def rate(_t, y):
        root = max(y[0], 0.0) ** 0.5
        return [y[1], -root * (y[0] + severity * y[1])]

    slow = [numpy.array([0.0, 1.0])]
    for first, last in itertools.pairwise(times):  # every time the end of an integration: no dense output
        run = solve_ivp(rate, (first, last), slow[-1], method="DOP853", rtol=1e-13, atol=1e-16)
        slow.append(run.y[:, -1])
    depth, speed = scaled_course(severity, times)
    assert numpy.abs(depth - numpy.array(slow)[:, 0]).max() < 1e-10
    assert numpy.abs(speed - numpy.array(slow)[:, 1]).max() < 1e-10
    assert depth[0] == 0.0
    assert speed[0] == 1.0


@pytest.mark.parametrize("severity", [0.01, 0.5, 5.0])
def test_energy_lost_is_the_work_of_the_viscous_force(severity):
    found = scaled_impact(severity, "gap")
    nodes, weights = numpy.polynomial.legendre.leggauss(40)
    work = 0.0
    for origin, way in (
        (0.0, 1.0),
        (found.duration, -1.0),
    ):  # from both ends, in the root of the time since: smooth there
        edge = math.sqrt(found.turning_time if way > 0.0 else found.duration - found.turning_time)
        root = 0.5 * edge * (1.0 + way * nodes)
        times = numpy.clip(origin + way * root**2, 0.0, found.duration)
        depth, speed = scaled_course(severity, times)
        work += severity * float((weights * numpy.sqrt(depth) * speed**2 * 2.0 * root).sum()) * 0.5 * edge
    assert 0.5 * (1.0 - found.restitution**2) == pytest.approx(work, rel=1e-9)


@pytest.mark.parametrize("severity", [-1e-9, 1.1e3, float("nan"), float("inf")])
def test_a_severity_outside_the_range_is_refused_by_its_value(severity):
    with pytest.raises(ImpactError, match="severity"):
        scaled_impact(severity, "force")


def test_a_mass_that_does_not_come_back_is_refused():
    with pytest.raises(ImpactError, match="does not leave"):
        scaled_impact(500.0, "gap")


def test_another_end_rule_is_refused_by_its_name():
    with pytest.raises(ValueError, match="end rule 'tension'"):
        scaled_impact(1.0, "tension")
