import math

import mpmath
import numpy
import pytest
from scipy.special import ellipe, ellipj, ellipk

from contact_sim_pkg.pressure.closed_form.jacobi import cn_squared, jacobi_cn, quarter_period

ARGUMENTS = numpy.linspace(-15.0, 15.0, 61)


@pytest.mark.parametrize("m", [0.0, 1e-9, 0.2, 0.4999, 0.5, 0.5001, 0.8, 0.99])
def test_cn_and_the_complete_integrals_are_those_of_scipy(m):
    numpy.testing.assert_allclose(jacobi_cn(ARGUMENTS, 1.0 - m), ellipj(ARGUMENTS, m)[1], atol=3e-14)
    integral_k, integral_e = quarter_period(1.0 - m)
    assert integral_k == pytest.approx(ellipk(m), rel=1e-14)
    assert integral_e == pytest.approx(ellipe(m), rel=1e-14)


@pytest.mark.parametrize("complement", [1e-6, 1e-15, 1e-60, 1e-200])
def test_cn_keeps_its_digits_where_the_parameter_is_one_to_rounding(complement):
    with mpmath.workdps(230):
        m = 1 - mpmath.mpf(complement)
        exact = [float(mpmath.ellipfun("cn", mpmath.mpf(u), m=m)) for u in ARGUMENTS[::6]]
    numpy.testing.assert_allclose(jacobi_cn(ARGUMENTS[::6], complement), exact, atol=1e-14)


def test_the_limits_are_cosine_and_hyperbolic_secant():
    numpy.testing.assert_array_equal(jacobi_cn(ARGUMENTS, 1.0), numpy.cos(ARGUMENTS))
    numpy.testing.assert_allclose(jacobi_cn(ARGUMENTS, 0.0), 1.0 / numpy.cosh(ARGUMENTS), rtol=1e-15)
    assert jacobi_cn([-1e9, 1e9], 0.0).tolist() == [0.0, 0.0] or jacobi_cn([1e9], 0.0)[0] < 1e-300
    assert quarter_period(0.0) == (math.inf, 1.0)


def test_the_square_has_half_the_period():
    integral_k = quarter_period(0.3)[0]
    numpy.testing.assert_allclose(cn_squared(ARGUMENTS + 2.0 * integral_k, 0.3), cn_squared(ARGUMENTS, 0.3), atol=1e-14)


@pytest.mark.parametrize("complement", [-1e-9, 1.0000001, math.nan])
def test_a_parameter_outside_its_range_is_refused_with_its_value(complement):
    with pytest.raises(ValueError, match=str(complement)):
        jacobi_cn(0.3, complement)
