"""The requested restitution of the general law: closed forms, and one root search against an integration by scipy."""

import math
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import brentq

from contact_sim_lab.twins import general_law
from contact_sim_pkg.laws.parameters import NormalElastic
from contact_sim_pkg.laws.restitution_law import (
    NEVER_PULLS,
    PULLS,
    coefficient_of_restitution,
    kelvin_voigt_ratio,
    kelvin_voigt_restitution,
    restitution_of_severity,
    severity_of_restitution,
)

ENDS = st.sampled_from([NEVER_PULLS, PULLS])
FEW = settings(max_examples=6)
MANY = settings(FEW, max_examples=40)

REQUESTED = (0.05, 0.1, 0.2, 1 / 3, 0.5, 0.7, 0.9, 0.98)


@pytest.mark.parametrize(
    "ratio", [0.0, 1e-6, 0.05, 0.3, 0.9, 0.99999, 1.0 - 1e-7, 1.0, 1.0 + 1e-7, 1.00001, 1.2, 3.0, 50.0]
)
def test_the_closed_form_of_spring_and_damper_is_that_of_forty_digits(ratio):
    expected = general_law.kelvin_voigt_at_force(ratio)
    assert kelvin_voigt_restitution(ratio, NEVER_PULLS) == pytest.approx(expected, rel=2e-10)
    assert kelvin_voigt_restitution(ratio, PULLS) == pytest.approx(general_law.kelvin_voigt_at_gap(ratio), rel=1e-12)


@pytest.mark.parametrize("requested", REQUESTED)
def test_the_damping_ratio_inverts_both_closed_forms(requested):
    at_force, at_gap = kelvin_voigt_ratio(requested, NEVER_PULLS), kelvin_voigt_ratio(requested, PULLS)
    assert general_law.kelvin_voigt_at_force(at_force) == pytest.approx(requested, abs=1e-12)
    assert general_law.kelvin_voigt_at_gap(at_gap) == pytest.approx(requested, abs=1e-12)


@pytest.mark.parametrize("requested", REQUESTED)
def test_a_quadratic_rate_with_equal_exponents_has_a_closed_form(requested):
    """p = n, q = 2: e^2 = 1/(1 + Z), from v dv = -X^n (1 + Z v |v|) dX on both ways."""
    severity = severity_of_restitution(requested, 1.5, 1.5, 2.0, NEVER_PULLS)
    assert 1.0 / math.sqrt(1.0 + severity) == pytest.approx(requested, abs=1e-10)


@pytest.mark.parametrize(
    ("n", "p", "q"), [(1.5, 0.5, 1.0), (1.5, 0.0, 1.0), (1.5, 2.5, 1.0), (1.0, 0.5, 2.0), (2.0, 1.0, 1.5)]
)
@pytest.mark.parametrize("lowest", [NEVER_PULLS, PULLS])
def test_the_root_search_delivers_what_is_requested_by_the_slow_twin(n, p, q, lowest):
    end = "force" if lowest == NEVER_PULLS else "gap"
    for requested in REQUESTED:
        severity = severity_of_restitution(requested, n, p, q, lowest)
        assert general_law.restitution(severity, n, p, q, end) == pytest.approx(requested, abs=1e-9)


def test_the_published_table_of_the_sphere_comes_out():
    """The free impact at zeta = 2.2354: restitution 0.0679 where the bodies part at x = 0."""
    assert restitution_of_severity(2.2354, 1.5, 0.5, 1.0, PULLS) == pytest.approx(0.0679, abs=5e-5)


@pytest.mark.parametrize("requested", REQUESTED)
def test_hunt_crossley_needs_the_same_loss_by_its_relation_and_by_the_search(requested):
    severity = severity_of_restitution(requested, 1.5, 1.5, 1.0, NEVER_PULLS)
    assert restitution_of_severity(severity, 1.5, 1.5, 1.0, NEVER_PULLS) == pytest.approx(requested, abs=1e-10)
    assert severity * (1 + requested) == pytest.approx(math.log((1 + severity) / (1 - severity * requested)), rel=1e-9)


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


@pytest.mark.parametrize("requested", [0.0, 0.0099, 1.01, -1.0, math.nan])
def test_a_restitution_outside_its_range_is_refused_with_its_value(requested):
    with pytest.raises(ValueError, match=str(requested)):
        severity_of_restitution(requested, 1.5, 0.5, 1.0, NEVER_PULLS)


def test_no_loss_is_needed_for_a_restitution_of_one():
    assert severity_of_restitution(1.0, 1.5, 0.5, 1.0, NEVER_PULLS) == 0.0


def dry_friction(requested, n, p):
    """q = 0 to x = 0: ``e^2 = 1 - 4 Z X^(p+1)/(p+1)``, ``X^(n+1) = (n+1)(1+e^2)/4`` from the energies; Z and X."""
    deepest = (0.25 * (n + 1.0) * (1.0 + requested**2)) ** (1.0 / (n + 1.0))
    return 0.25 * (p + 1.0) * (1.0 - requested**2) / deepest ** (p + 1.0), deepest


@pytest.mark.parametrize(
    ("n", "p", "lowest"), [(1.5, 0.5, PULLS), (1.0, 2.0, NEVER_PULLS), (1.0, 2.0, PULLS), (1.5, 1.5, NEVER_PULLS)]
)
def test_dry_friction_has_a_closed_form_and_ends(n, p, lowest):
    """Searches that never ended, or ended in an ArithmeticError: the first is that of Z = 0.326, X = 0.906."""
    severity, deepest = dry_friction(0.5, n, p)
    assert severity_of_restitution(0.5, n, p, 0.0, lowest) == pytest.approx(severity, rel=2e-6)
    if (n, p) == (1.5, 0.5):
        assert (severity, deepest) == pytest.approx((0.326, 0.906), abs=5e-4)


@pytest.mark.parametrize(("n", "p"), [(1.0, 2.0), (1.5, 4.0)])
def test_what_dry_friction_cannot_reach_is_refused_with_its_range(n, p):
    """The mass is held where ``X^n < Z X^p``: e >= sqrt((p-n)/(p+n+2)); just above it is found."""
    lowest = math.sqrt((p - n) / (p + n + 2.0))
    with pytest.raises(ValueError, match="friction holds the mass") as refusal:
        severity_of_restitution(0.3, n, p, 0.0, NEVER_PULLS)
    stated = float(re.search(r"from (\S+) to 1, not 0.3", str(refusal.value)).group(1))
    assert lowest < stated < lowest + 1.1e-3
    assert severity_of_restitution(stated, n, p, 0.0, PULLS) == pytest.approx(dry_friction(stated, n, p)[0], rel=1e-4)


def test_a_mass_that_creeps_for_longer_than_a_thousand_units_is_held():
    with pytest.raises(ValueError, match="friction holds the mass"):
        severity_of_restitution(0.1, 1.5, 4.0, 0.1, PULLS)


@FEW
@given(st.floats(1.0, 3.0), st.floats(0.0, 4.0), st.floats(0.05, 0.999), st.floats(0.1, 0.98), ENDS)
def test_every_search_below_the_linear_rate_delivers_or_names_its_range(n, p, q, requested, lowest):
    end = "force" if lowest == NEVER_PULLS else "gap"
    try:
        severity = severity_of_restitution(requested, n, p, q, lowest)
    except ValueError as refusal:
        stated = re.search(r"from (\S+) to 1", str(refusal))
    else:
        assert general_law.restitution(severity, n, p, q, end) == pytest.approx(requested, abs=1e-6)
        return
    assert p > n
    assert float(stated.group(1)) > requested


@settings(FEW, max_examples=15)
@given(st.floats(1.0, 10.0), st.floats(0.0, 4.0), st.floats(1.0, 3.0), st.floats(0.01, 1.0), ENDS)
def test_every_search_from_the_linear_rate_on_delivers(n, p, q, requested, lowest):
    severity = severity_of_restitution(requested, n, p, q, lowest)
    end = "force" if lowest == NEVER_PULLS else "gap"
    assert general_law.restitution(severity, n, p, q, end) == pytest.approx(requested, abs=2e-9)


@MANY
@given(st.floats(1.0, 10.0), st.floats(0.0, 4.0), st.floats(1.0, 3.0), st.floats(1e-16, 1e-9))
def test_next_to_one_the_loss_is_that_of_the_elastic_impact(n, p, q, loss):
    """1 - e = Z I, I the integral of 2 x^p v^q over the elastic way in, here by quadrature over u = x/X."""
    requested = 1.0 - loss
    deepest = (0.5 * (n + 1.0)) ** (1.0 / (n + 1.0))
    area = quad(lambda u: u**p * max(0.0, 1.0 - u ** (n + 1.0)) ** (0.5 * q), 0.0, 1.0, epsabs=1e-12)[0]
    severity = severity_of_restitution(requested, n, p, q, PULLS)
    if requested < 1.0 and not (p == n and q == 1.0) and not (n == 1.0 and p == 0.0 and q == 1.0):
        assert severity * 2.0 * deepest ** (p + 1.0) * area == pytest.approx(1.0 - requested, rel=1e-9)


GOOD = {"restitution": 0.5, "n": 1.5, "p": 0.5, "q": 1.0, "lowest_force": NEVER_PULLS}
OUTSIDE = {
    "restitution": (0.0, 0.0099, 1.0 + 1e-12, -0.5, math.nan, math.inf),
    "n": (0.0, 0.999, 10.1, -1.5, math.nan, math.inf),
    "p": (-1e-9, 4.1, math.nan, math.inf),
    "q": (-1e-9, 3.1, math.nan, -math.inf),
    "lowest_force": (-1.0, 1.0, math.nan, math.inf),
}


@pytest.mark.parametrize(("name", "value"), [(name, value) for name, values in OUTSIDE.items() for value in values])
def test_the_search_names_what_it_cannot_do(name, value):
    with pytest.raises(ValueError, match=f"{value}"):
        severity_of_restitution(**{**GOOD, name: value})
    if name != "restitution":
        with pytest.raises(ValueError, match=f"{value}"):
            restitution_of_severity(1.0, *list({**GOOD, name: value}.values())[1:])


@pytest.mark.parametrize("severity", [-1e-9, 1e21, math.nan, math.inf])
def test_a_severity_outside_its_range_is_refused(severity):
    with pytest.raises(ValueError, match="severity Z"):
        restitution_of_severity(severity, 1.5, 0.5, 1.0, NEVER_PULLS)


@pytest.mark.parametrize("bad", [math.nan, math.inf, -1.0, 0.0, 1e21])
def test_the_coefficient_names_what_it_cannot_do(bad):
    law = NormalElastic(1e5, 1.5)
    with pytest.raises(ValueError, match="mass"):
        coefficient_of_restitution(0.5, 1.0, bad, law, 0.5, 1.0, NEVER_PULLS)
    with pytest.raises(ValueError, match="elastic coefficient"):
        coefficient_of_restitution(0.5, 1.0, 20.0, NormalElastic(bad, 1.5), 0.5, 1.0, NEVER_PULLS)
    with pytest.raises(ValueError, match="elastic exponent"):
        coefficient_of_restitution(0.5, 1.0, 20.0, NormalElastic(1e5, bad), 0.5, 1.0, NEVER_PULLS)
    if bad != 0.0:  # counts as 1 mm/s
        with pytest.raises(ValueError, match="impact speed"):
            coefficient_of_restitution(0.5, bad, 20.0, law, 0.5, 1.0, NEVER_PULLS)


@pytest.mark.parametrize("severity", [1e-3, 0.3, 2.0, 1e6])
def test_forward_and_backward_motion_agree_below_the_linear_rate(severity):
    """With q = 0 and the end at x = 0: ``e^2 = 1 - 4 Z X^(p+1)/(p+1)``, 0 where the mass is held."""
    n, p = 1.0, 2.0
    deepest = brentq(lambda x: x ** (n + 1) / (n + 1) + severity * x ** (p + 1) / (p + 1) - 0.5, 0.0, 2.0, xtol=1e-15)
    held = deepest**n < severity * deepest**p
    expected = 0.0 if held else math.sqrt(1.0 - 4.0 * severity * deepest ** (p + 1) / (p + 1))
    assert restitution_of_severity(severity, n, p, 0.0, PULLS) == pytest.approx(expected, abs=1e-6)


@MANY
@given(st.floats(0.01, 1.0), ENDS)
def test_the_damping_ratio_is_inverted_over_its_whole_range(requested, lowest):
    ratio = kelvin_voigt_ratio(requested, lowest)
    exact = general_law.kelvin_voigt_at_force if lowest == NEVER_PULLS else general_law.kelvin_voigt_at_gap
    assert exact(ratio) == pytest.approx(requested, abs=1e-12)


@pytest.mark.parametrize("bad", [math.nan, -1e-9, math.inf])
def test_a_damping_ratio_below_zero_is_refused(bad):
    with pytest.raises(ValueError, match="damping ratio"):
        kelvin_voigt_restitution(bad, PULLS)
    with pytest.raises(ValueError, match="lowest force"):
        kelvin_voigt_restitution(0.5, bad)
