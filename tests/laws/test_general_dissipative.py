"""The general normal law: its special cases, both ends of contact, and its power of the rate near zero."""

import math

import numpy
import pytest

from contact_sim_lab.laws.one_mass.impact_works import ImpactWorks
from contact_sim_lab.laws.one_mass.runs import integrate
from contact_sim_lab.twins import general_law, impact
from contact_sim_pkg.laws.general_dissipative import SMOOTHING, rate_power, rate_power_slope
from contact_sim_pkg.laws.normal_force import normal_force, normal_force_rate, tension_event
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.parameters import GeneralDissipative, NormalDissipative, NormalElastic

PULLS = -math.inf
MASS, SPEED, GAP = 20.0, 0.5, 0.01
LAW = NormalElastic(1.0e5, 1.5)
APPROACHES = (1e-9, 1e-4, 0.01, 0.3)
RATES = (-2.0, -0.3, -1e-3, 0.0, 1e-3, 0.3, 2.0)


def loss(coefficient, p, q, lowest=0.0, reference_speed=SPEED):
    return GeneralDissipative(coefficient, p, q, SMOOTHING * reference_speed if q < 1.0 else 0.0, lowest)


def run(elastic, dissipative, tolerance=1e-12, duration=None):
    """A free impact with works: the last state, and the depth of the elastic impact."""
    depth = impact.elastic_impact(MASS, SPEED, elastic.coefficient, elastic.exponent)[1]
    energy = 0.5 * MASS * SPEED**2
    rig = ImpactWorks(PointContact(MASS, 0.0, 0.0, 0.0, elastic, dissipative))
    scale = numpy.array([depth, SPEED, energy, energy]) * tolerance
    end = GAP / SPEED + (60.0 * depth / SPEED if duration is None else duration)
    return integrate(rig, numpy.array([GAP, -SPEED, 0.0, 0.0]), scale, numpy.array([0.0, end])).states[-1]


def severity(elastic, coefficient, p, q):
    length = (MASS * SPEED**2 / elastic.coefficient) ** (1.0 / (elastic.exponent + 1.0))
    return coefficient * length ** (p - elastic.exponent) * SPEED**q / elastic.coefficient


@pytest.mark.parametrize("approach", APPROACHES)
@pytest.mark.parametrize("rate", RATES)
def test_hunt_crossley_is_the_case_of_equal_exponents(approach, rate):
    general = loss(0.8 * LAW.coefficient, LAW.exponent, 1.0)
    expected = LAW.coefficient * approach**1.5 * max(0.0, 1.0 + 0.8 * rate)
    assert normal_force(LAW, general, approach, rate, 1.0) == pytest.approx(expected, rel=1e-14)
    assert normal_force(LAW, NormalDissipative(0.8), approach, rate, 1.0) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize(("p", "q"), [(0.0, 1.0), (0.5, 1.0), (1.5, 2.0), (0.7, 1.3), (3.0, 0.5), (0.25, 0.0)])
def test_the_force_is_the_printed_sum_without_adhesion(p, q):
    for approach in APPROACHES:
        for rate in RATES:
            total = 1e5 * approach**1.5 + 700.0 * approach**p * math.copysign(abs(rate) ** q, rate) * (rate != 0.0)
            assert normal_force(LAW, loss(700.0, p, q), approach, rate, 1.0) == pytest.approx(
                max(0.0, total), rel=1e-6 if q < 1.0 else 1e-13, abs=1e-12
            )
            assert normal_force(LAW, loss(700.0, p, q, PULLS), approach, rate, 1.0) == pytest.approx(
                total, rel=1e-6 if q < 1.0 else 1e-13, abs=1e-12
            )


@pytest.mark.parametrize("p", [0.0, 0.5, 4.0])
@pytest.mark.parametrize("lowest", [0.0, PULLS])
def test_there_is_no_force_without_indentation(p, lowest):
    for approach in (0.0, -0.0, -5e-324, -1e-9, -1.0, -math.inf):
        for rate in RATES:
            assert normal_force(LAW, loss(700.0, p, 1.0, lowest), approach, rate, 1.0) == 0.0


@pytest.mark.parametrize(("p", "q"), [(0.0, 1.0), (0.5, 1.0), (1.5, 1.0), (2.5, 2.0)])
def test_the_margin_changes_its_sign_where_the_force_reaches_zero(p, q):
    general = loss(700.0, p, q)
    for approach in (1e-6, 1e-3, 0.05):
        zero_at = -((LAW.coefficient * approach ** (1.5 - p) / 700.0) ** (1.0 / q))
        assert tension_event(LAW, general, approach, zero_at * (1.0 - 1e-9), 1.0) > 0.0
        assert tension_event(LAW, general, approach, zero_at * (1.0 + 1e-9), 1.0) < 0.0
        assert tension_event(LAW, loss(700.0, p, q, PULLS), approach, 10.0 * zero_at, 1.0) == math.inf


@pytest.mark.parametrize("p", [0.0, 0.5, 1.5, 4.0])
def test_the_margin_is_finite_at_first_touch_and_in_flight(p):
    for approach in (-1.0, 0.0, 1e-300, 1e-80):
        assert math.isfinite(tension_event(LAW, loss(700.0, p, 1.0), approach, -0.3, 1.0))


@pytest.mark.parametrize("q", [0.0, 0.5, 1.0, 2.0])
def test_the_power_of_the_rate_is_odd_and_its_slope_is_its_derivative(q):
    general = loss(1.0, 0.5, q)
    for rate in (1e-7, 1e-4, 0.02, 1.7):
        assert rate_power(general, -rate) == -rate_power(general, rate)
        step = 1e-5 * rate
        slope = (rate_power(general, rate + step) - rate_power(general, rate - step)) / (2.0 * step)
        assert rate_power_slope(general, rate) == pytest.approx(
            slope, rel=1e-7, abs=1e-6 * rate_power(general, rate) / rate
        )


def test_dry_loss_is_smooth_over_a_millionth_of_the_reference_speed():
    general = loss(1.0, 0.0, 0.0, reference_speed=2.0)
    assert rate_power(general, 0.0) == 0.0
    assert rate_power(general, 2e-6) == pytest.approx(math.sqrt(0.5), rel=1e-12)
    assert rate_power(general, 2e-3) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize(("p", "q"), [(0.0, 1.0), (0.5, 1.0), (1.5, 2.0)])
def test_the_rate_of_the_force_is_its_derivative_in_time(p, q):
    general, acceleration = loss(700.0, p, q), -7.0
    for approach, rate in ((0.01, 0.2), (0.01, -0.2), (1e-4, 1.0)):
        step = 1e-6 * approach / abs(rate)
        ends = [
            normal_force(LAW, general, approach + rate * t + 0.5 * acceleration * t * t, rate + acceleration * t, 1.0)
            for t in (-step, step)
        ]
        expected = (ends[1] - ends[0]) / (2.0 * step)
        found = normal_force_rate(LAW, general, approach, rate, acceleration, 1.0)
        assert found == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("ratio", [0.01, 0.1, 0.3, 0.7, 0.99, 1.0, 1.5, 4.0])
def test_a_linear_spring_and_damper_parts_at_zero_force_with_the_closed_restitution(ratio):
    stiffness = 1.0e5
    damper = loss(2.0 * ratio * math.sqrt(stiffness * MASS), 0.0, 1.0)
    end = run(NormalElastic(stiffness, 1.0), damper)
    expected = general_law.kelvin_voigt_at_force(ratio)
    assert end[1] / SPEED == pytest.approx(expected, abs=2e-10)
    assert math.sqrt(end[3] / -end[2]) == pytest.approx(expected, abs=2e-10)


@pytest.mark.parametrize("ratio", [0.01, 0.1, 0.3, 0.7, 0.95])
def test_a_linear_spring_and_damper_parts_at_zero_gap_with_the_closed_restitution(ratio):
    stiffness = 1.0e5
    damper = loss(2.0 * ratio * math.sqrt(stiffness * MASS), 0.0, 1.0, PULLS)
    end = run(NormalElastic(stiffness, 1.0), damper)
    assert end[1] / SPEED == pytest.approx(general_law.kelvin_voigt_at_gap(ratio), abs=2e-10)


@pytest.mark.parametrize(
    ("p", "q", "coefficient"),
    [(0.5, 1.0, 300.0), (0.5, 1.0, 3000.0), (0.0, 1.0, 400.0), (1.5, 2.0, 2e5), (0.7, 1.3, 2000.0), (2.5, 1.0, 1e6)],
)
@pytest.mark.parametrize("end", ["force", "gap"])
def test_a_free_impact_ends_with_the_restitution_of_the_slow_twin(p, q, coefficient, end):
    found = run(LAW, loss(coefficient, p, q, 0.0 if end == "force" else PULLS))
    expected = general_law.restitution(severity(LAW, coefficient, p, q), 1.5, p, q, end)
    assert found[1] / SPEED == pytest.approx(expected, abs=1e-9)
    assert math.sqrt(found[3] / -found[2]) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(("q", "coefficient"), [(0.5, 300.0), (0.0, 300.0)])
def test_below_linear_the_smoothing_moves_the_restitution_by_less_than_a_millionth(q, coefficient):
    found = run(LAW, loss(coefficient, 0.5, q))[1] / SPEED
    expected = general_law.restitution(severity(LAW, coefficient, 0.5, q), 1.5, 0.5, q, "force")
    assert found == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("speed", [0.05, 0.5, 5.0])
def test_the_restitution_is_one_function_of_the_severity_alone(speed):
    """Other A, m, v0 at the same Z: the same e (here for the Kuwabara-Kono form)."""
    target = 0.4
    elastic, mass = NormalElastic(3.0e4, 1.5), 3.0
    length = (mass * speed**2 / elastic.coefficient) ** 0.4
    coefficient = target * elastic.coefficient * length / speed
    rig = PointContact(mass, 0.0, 0.0, 0.0, elastic, loss(coefficient, 0.5, 1.0))
    scale = numpy.array([length, speed]) * 1e-12
    end = integrate(rig, numpy.array([0.0, -speed]), scale, numpy.array([0.0, 20.0 * length / speed])).states[-1]
    assert end[1] / speed == pytest.approx(general_law.restitution(target, 1.5, 0.5, 1.0, "force"), abs=1e-9)


def test_with_gravity_the_works_hold_the_contact_force_only():
    """A drop of one bounce: -W_c and W_r differ from the kinetic energies by the weight's work over the approach."""
    rig = ImpactWorks(PointContact(MASS, 9.81, 0.0, 0.0, LAW, loss(300.0, 0.5, 1.0)))
    scale = numpy.array([0.01, 1.0, 1.0, 1.0]) * 1e-11
    states = integrate(rig, numpy.array([0.05, 0.0, 0.0, 0.0]), scale, numpy.array([0.0, 0.25])).states[-1]
    z, v, closing, opening = states
    assert z > 0.0
    energy = MASS * 9.81 * (z - 0.05) + 0.5 * MASS * v * v
    assert closing + opening == pytest.approx(energy, abs=1e-8)
    assert closing < 0.0 < opening
