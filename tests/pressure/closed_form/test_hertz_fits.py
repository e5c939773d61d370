"""Cheaper ellipses: the errors that are announced for them, against multiple precision."""

import numpy
import pytest

from contact_sim_lab.twins import hertz as reference
from contact_sim_pkg.pressure.closed_form.hertz_fits import (
    EXACT,
    POLYNOMIAL,
    POWER,
    TABLE,
    contacts_at_load,
    make_shape_table,
)

MODULUS, LOAD = 4e6, 123.0
TABLE_OF_SHAPES = make_shape_table()


def errors(kind, omega):
    """Relative errors, with sign, of approach, a, b and peak pressure."""
    small, large = 1.0 - omega, 1.0 + omega
    out = numpy.empty((1, 4))
    contacts_at_load(kind, TABLE_OF_SHAPES, numpy.array([small]), numpy.array([large]), MODULUS, LOAD, out)
    exact = reference.contact_at_load(small, large, MODULUS, LOAD)
    return out[0] / [exact.approach, exact.a, exact.b, exact.peak_pressure] - 1.0


@pytest.mark.parametrize(
    ("omega", "aspect"),
    [(0.1, 3e-5), (0.3, 1.9e-4), (0.5, 7e-4), (0.7, 2.7e-3), (0.9, 0.018), (0.98, 0.17), (0.99, 0.36), (0.995, 0.68)],
)
def test_the_polynomial_has_the_errors_that_are_known_of_it(omega, aspect):
    _approach, a, b, _peak = errors(POLYNOMIAL, omega)
    assert (1.0 + b) / (1.0 + a) - 1.0 == pytest.approx(aspect, rel=0.05, abs=5e-6)


@pytest.mark.parametrize("omega", [0.01, 0.05, 0.1, 0.2, 0.3])
def test_the_polynomial_is_the_exact_relation_to_2e_4_up_to_omega_0_3(omega):
    _approach, a, b, _peak = errors(POLYNOMIAL, omega)
    assert abs((1.0 + b) / (1.0 + a) - 1.0) < 2e-4


@pytest.mark.parametrize(("omega", "peak"), [(0.75, 1e-3), (0.93, 1e-2)])
def test_the_polynomial_s_peak_pressure_is_good_as_far_as_announced(omega, peak):
    assert abs(errors(POLYNOMIAL, omega)[3]) == pytest.approx(peak, rel=0.1)


@pytest.mark.parametrize(("ratio", "low"), [(0.3, 0.005), (0.1, 0.03), (0.01, 0.16)])
def test_the_power_fit_is_low_as_announced(ratio, low):
    _approach, a, b, _peak = errors(POWER, (1.0 - ratio) / (1.0 + ratio))
    assert 1.0 - (1.0 + b) / (1.0 + a) == pytest.approx(low, rel=0.15)


@pytest.mark.parametrize("omega", [0.0, 1e-6, 0.01, 0.2, 0.4, 0.6, 0.9, 0.999, 1 - 1e-6, 1 - 1e-9, 1 - 1e-12])
def test_the_table_holds_five_digits_from_the_circle_to_the_line(omega):
    assert abs(errors(TABLE, max(omega, 1e-14))).max() < (1e-5 if omega < 0.2 else 1e-6)


@pytest.mark.parametrize("omega", [1e-9, 0.01, 0.3, 0.9, 1 - 1e-9])
def test_the_exact_root_is_exact(omega):
    assert abs(errors(EXACT, omega)).max() < 3e-15


def test_without_load_everything_is_zero():
    for kind in (EXACT, POLYNOMIAL, POWER, TABLE):
        out = numpy.ones((1, 4))
        contacts_at_load(kind, TABLE_OF_SHAPES, numpy.array([1.0]), numpy.array([2.0]), MODULUS, 0.0, out)
        assert not out.any()
