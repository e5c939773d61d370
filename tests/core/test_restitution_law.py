"""The asked restitution of the general law: closed forms, and one root search against an integration by scipy."""

import math

import pytest

from contact_sim_pkg.core.parameters import NormalElastic
from contact_sim_pkg.core.restitution_law import (
    NEVER_PULLS,
    PULLS,
    coefficient_of_restitution,
    kelvin_voigt_ratio,
    kelvin_voigt_restitution,
    restitution_of_severity,
    severity_of_restitution,
)
from contact_sim_pkg.reference import general_law

ASKED = (0.05, 0.1, 0.2, 1 / 3, 0.5, 0.7, 0.9, 0.98)


@pytest.mark.parametrize(
    "ratio", [0.0, 1e-6, 0.05, 0.3, 0.9, 0.99999, 1.0 - 1e-7, 1.0, 1.0 + 1e-7, 1.00001, 1.2, 3.0, 50.0]
)
def test_the_closed_form_of_spring_and_damper_is_that_of_forty_digits(ratio):
    expected = general_law.kelvin_voigt_at_force(ratio)
    assert kelvin_voigt_restitution(ratio, NEVER_PULLS) == pytest.approx(expected, rel=2e-10)
    assert kelvin_voigt_restitution(ratio, PULLS) == pytest.approx(general_law.kelvin_voigt_at_gap(ratio), rel=1e-12)


@pytest.mark.parametrize("asked", ASKED)
def test_the_damping_ratio_inverts_both_closed_forms(asked):
    at_force, at_gap = kelvin_voigt_ratio(asked, NEVER_PULLS), kelvin_voigt_ratio(asked, PULLS)
    assert general_law.kelvin_voigt_at_force(at_force) == pytest.approx(asked, abs=1e-12)
    assert general_law.kelvin_voigt_at_gap(at_gap) == pytest.approx(asked, abs=1e-12)


@pytest.mark.parametrize("asked", ASKED)
def test_a_quadratic_rate_with_equal_exponents_has_a_closed_form(asked):
    """p = n, q = 2: e^2 = 1/(1 + Z), from v dv = -X^n (1 + Z v |v|) dX on both ways."""
    severity = severity_of_restitution(asked, 1.5, 1.5, 2.0, NEVER_PULLS)
    assert 1.0 / math.sqrt(1.0 + severity) == pytest.approx(asked, abs=1e-10)


@pytest.mark.parametrize(
    ("n", "p", "q"), [(1.5, 0.5, 1.0), (1.5, 0.0, 1.0), (1.5, 2.5, 1.0), (1.0, 0.5, 2.0), (2.0, 1.0, 1.5)]
)
@pytest.mark.parametrize("lowest", [NEVER_PULLS, PULLS])
def test_the_root_search_delivers_what_is_asked_by_the_slow_twin(n, p, q, lowest):
    end = "force" if lowest == NEVER_PULLS else "gap"
    for asked in ASKED:
        severity = severity_of_restitution(asked, n, p, q, lowest)
        assert general_law.restitution(severity, n, p, q, end) == pytest.approx(asked, abs=1e-9)


def test_the_published_table_of_the_sphere_comes_out():
    """SEEDS 4.4 at zeta = 2.2354: restitution 0.0679 where the bodies part at x = 0."""
    assert restitution_of_severity(2.2354, 1.5, 0.5, 1.0, PULLS) == pytest.approx(0.0679, abs=5e-5)


@pytest.mark.parametrize("asked", ASKED)
def test_hunt_crossley_needs_the_same_loss_by_its_relation_and_by_the_search(asked):
    severity = severity_of_restitution(asked, 1.5, 1.5, 1.0, NEVER_PULLS)
    assert restitution_of_severity(severity, 1.5, 1.5, 1.0, NEVER_PULLS) == pytest.approx(asked, abs=1e-10)
    assert severity * (1 + asked) == pytest.approx(math.log((1 + severity) / (1 - severity * asked)), rel=1e-9)


def test_the_coefficient_scales_with_mass_speed_and_stiffness():
    base = coefficient_of_restitution(0.5, 0.5, 20.0, NormalElastic(1e5, 1.5), 0.5, 1.0, NEVER_PULLS)
    severity = severity_of_restitution(0.5, 1.5, 0.5, 1.0, NEVER_PULLS)
    for mass, speed, stiffness in ((20.0, 0.5, 1e5), (45.0, 2.0, 3e4)):
        length = (mass * speed**2 / stiffness) ** 0.4
        found = coefficient_of_restitution(0.5, speed, mass, NormalElastic(stiffness, 1.5), 0.5, 1.0, NEVER_PULLS)
        assert found == pytest.approx(severity * stiffness * length / speed, rel=1e-12)
    assert base > 0.0


def test_grazing_impacts_count_as_one_millimetre_a_second():
    law = NormalElastic(1e5, 1.5)
    slow = coefficient_of_restitution(0.5, 1e-9, 20.0, law, 0.5, 1.0, NEVER_PULLS)
    assert slow == coefficient_of_restitution(0.5, 1e-3, 20.0, law, 0.5, 1.0, NEVER_PULLS)


@pytest.mark.parametrize("asked", [0.0, 0.0099, 1.01, -1.0, math.nan])
def test_a_restitution_outside_its_range_is_refused_with_its_value(asked):
    with pytest.raises(ValueError, match=str(asked)):
        severity_of_restitution(asked, 1.5, 0.5, 1.0, NEVER_PULLS)


def test_no_loss_is_needed_for_a_restitution_of_one():
    assert severity_of_restitution(1.0, 1.5, 0.5, 1.0, NEVER_PULLS) == 0.0
