"""Foam by a measured curve: scipy's PCHIP, its integral, the straight line beyond it, bulging below it."""

import numpy
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.interpolate import PchipInterpolator

from contact_sim_pkg.laws.foam_columns import columns_of
from contact_sim_pkg.laws.parameters import FoamCurve

STRAIN = (0.03, 0.1, 0.2, 0.4, 0.55, 0.6)
STRESS = (900.0, 2000.0, 2600.0, 3500.0, 6000.0, 9000.0)
COLUMNS = columns_of(FoamCurve(0.08, STRAIN, STRESS))
PCHIP = PchipInterpolator((0.0, *STRAIN), (0.0, *STRESS))
PLACES = numpy.array([1e-6, 0.02, 0.03, 0.17, 0.4, 0.58, 0.6])


def test_the_stress_at_a_point_is_the_measured_one():
    assert COLUMNS.stress(numpy.array(STRAIN)) == pytest.approx(STRESS, rel=1e-14)


def test_between_points_it_is_scipys_pchip():
    assert COLUMNS.stress(PLACES) == pytest.approx(PCHIP(PLACES), rel=1e-12)
    assert COLUMNS.modulus(PLACES) == pytest.approx(PCHIP(PLACES, 1), rel=1e-9)
    energy = [quad(lambda e: float(PCHIP(e)), 0.0, place, points=STRAIN)[0] for place in PLACES]
    assert COLUMNS.energy(PLACES) == pytest.approx(energy, rel=1e-9)


def test_beyond_its_end_the_slope_stays():
    slope, beyond = float(PCHIP(0.6, 1)), numpy.array([0.7, 0.9])
    assert COLUMNS.stress(beyond) == pytest.approx(9000.0 + slope * (beyond - 0.6), rel=1e-12)
    assert COLUMNS.modulus(beyond) == pytest.approx([slope, slope], rel=1e-12)
    stored = PCHIP.integrate(0.0, 0.6) + (beyond - 0.6) * 9000.0 + 0.5 * slope * (beyond - 0.6) ** 2
    assert COLUMNS.energy(beyond) == pytest.approx(stored, rel=1e-12)


def test_below_zero_it_bulges_by_the_slope_at_first_contact():
    below = numpy.array([-0.3, -0.01])
    first = float(PCHIP(0.0, 1))
    assert COLUMNS.first_modulus == pytest.approx(first)
    assert COLUMNS.stress(below) == pytest.approx(first * below)
    assert COLUMNS.modulus(below) == pytest.approx([first, first])
    assert COLUMNS.energy(below) == pytest.approx(0.5 * first * below**2)


def test_a_toe_and_a_plateau_at_the_end_keep_a_tenth_of_their_secant():
    found = columns_of(FoamCurve(0.08, (0.1, 0.2, 0.3, 0.4), (100.0, 2000.0, 4000.0, 4010.0)))
    assert found.first_modulus == pytest.approx(0.1 * 100.0 / 0.1)
    assert float(found.modulus(numpy.array(0.5))) == pytest.approx(0.1 * 10.0 / 0.1)


@given(st.lists(st.tuples(st.floats(1e-3, 1.0), st.floats(1e-3, 1e4)), min_size=2, max_size=12))
def test_no_rising_curve_ever_falls(steps):
    strain, stress = numpy.cumsum(steps, axis=0).T
    found = columns_of(FoamCurve(0.08, tuple(0.9 * strain / strain[-1]), tuple(stress)))
    values = found.stress(numpy.linspace(-0.1, 0.99, 400))
    assert (numpy.diff(values) > -1e-9 * stress[-1]).all()


@pytest.mark.parametrize(
    ("strain", "stress"),
    [
        ((0.1, 0.1, 0.2), (1.0, 2.0, 3.0)), ((0.1, 0.2, 0.3), (1.0, 3.0, 2.0)), ((0.1, 0.2, 1.0), (1.0, 2.0, 3.0)),
        ((0.1, 0.2), (1.0, 2.0, 3.0)), ((0.1,), (1.0,)), ((0.1, 0.2), (1.0, float("nan"))), ((0.0, 0.2), (0.0, 1.0)),
    ],
)  # fmt: skip
def test_what_is_no_curve_is_refused(strain, stress):
    with pytest.raises(ValueError, match="curve"):
        columns_of(FoamCurve(0.08, strain, stress))
