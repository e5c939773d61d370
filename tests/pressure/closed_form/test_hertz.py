"""Elliptic Hertz contact against multiple precision, the sphere, and its invariants."""

from __future__ import annotations

import math

import mpmath
import numpy
import pytest

from contact_sim_lab.twins import hertz as reference
from contact_sim_pkg.pressure.closed_form.hertz import (
    HertzContact,
    HertzError,
    ellipse_shape,
    hertz_contact,
    hertz_contact_at_approach,
    power_law,
)

MODULUS = 4e6
NEAR_THE_CIRCLE = [1e-9, 1e-5, 3e-4, 1e-3, 0.01, 0.0199, 0.0201, 0.03]
OMEGAS = [*NEAR_THE_CIRCLE, 0.3, 0.7, 0.95, 0.999, 1 - 1e-6, 1 - 1e-9, 1 - 1e-11, 1 - 1e-12]


@pytest.mark.parametrize("omega", OMEGAS)
def test_contact_equals_multiple_precision_from_the_circle_to_the_line(omega: float) -> None:
    small, large = 1.0 - omega, 1.0 + omega
    found, expected = (
        hertz_contact(small, large, MODULUS, 123.0),
        reference.contact_at_load(small, large, MODULUS, 123.0),
    )
    for name in ("approach", "a", "b", "peak_pressure"):
        assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=3e-15), name


@pytest.mark.parametrize("omega", [1e-5, 1e-3, 0.0199, 0.0201, 0.5, 1 - 1e-12])
def test_the_parameter_is_right_on_both_sides_of_the_series(omega: float) -> None:
    complement = ellipse_shape(1.0 - omega, 1.0 + omega).complement
    with mpmath.workdps(50):
        small, large = mpmath.mpf(1.0 - omega), mpmath.mpf(1.0 + omega)
        parameter, expected = reference.parameter_of((large - small) / (large + small))
    assert complement == pytest.approx(float(expected), rel=6e-15)
    assert 1.0 - complement == pytest.approx(float(parameter), rel=1e-13, abs=1e-16)


def test_a_negative_approach_after_a_positive_one_leaves_nothing_behind() -> None:
    touched = hertz_contact_at_approach(1.0, 2.0, MODULUS, 1e-5)
    assert touched.load > 0.0
    assert hertz_contact_at_approach(1.0, 2.0, MODULUS, -touched.approach).load == 0.0


def test_the_check_tire() -> None:
    contact = hertz_contact(0.5 / 1.0, 0.5 / 0.3, 3e6 / (1.0 - 0.5**2), 4000.0)
    assert contact.a == pytest.approx(0.10864, abs=5e-6)
    assert contact.b == pytest.approx(0.04893, abs=5e-6)
    assert contact.peak_pressure == pytest.approx(0.35927e6, abs=5.0)
    assert contact.approach == pytest.approx(9.892e-3, abs=5e-7)


def test_a_sphere_has_the_closed_form() -> None:
    radius, load = 0.02, 300.0
    contact = hertz_contact(0.5 / radius, 0.5 / radius, MODULUS, load)
    semi_axis = (3.0 * load * radius / (4.0 * MODULUS)) ** (1.0 / 3.0)
    expected = HertzContact(
        load, semi_axis**2 / radius, semi_axis, semi_axis, 3.0 * load / (2.0 * math.pi * semi_axis**2)
    )
    assert contact == pytest.approx(expected, rel=1e-14)
    assert power_law(0.5 / radius, 0.5 / radius, MODULUS) == pytest.approx(4 / 3 * MODULUS * radius**0.5, rel=1e-14)


@pytest.mark.parametrize("ratio", [1.0, 0.999, 0.3, 1e-2, 1e-6, 1e-11])
def test_load_and_approach_are_inverse_to_each_other(ratio: float) -> None:
    for load in numpy.logspace(-9, 9, 7):
        contact = hertz_contact(ratio, 1.0, MODULUS, load)
        assert hertz_contact_at_approach(ratio, 1.0, MODULUS, contact.approach) == pytest.approx(contact, rel=1e-13)
        assert power_law(ratio, 1.0, MODULUS) * contact.approach**1.5 == pytest.approx(load, rel=1e-13)


def test_peak_pressure_is_one_and_a_half_times_the_mean() -> None:
    contact = hertz_contact(0.2, 3.0, MODULUS, 50.0)
    assert contact.peak_pressure == pytest.approx(1.5 * 50.0 / (math.pi * contact.a * contact.b), rel=1e-13)


def test_exchanging_the_curvatures_changes_nothing() -> None:
    assert hertz_contact(0.2, 3.0, MODULUS, 50.0) == hertz_contact(3.0, 0.2, MODULUS, 50.0)


@pytest.mark.parametrize("nothing", [0.0, -0.0, -1e-12, -5.0])
def test_without_load_or_approach_everything_is_zero(nothing: float) -> None:
    assert hertz_contact(1.0, 2.0, MODULUS, nothing) == (0.0, 0.0, 0.0, 0.0, 0.0)
    assert hertz_contact_at_approach(1.0, 2.0, MODULUS, nothing) == (0.0, 0.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("curvatures", "fault"),
    [
        ((-1.0, -2.0), "conform"),
        ((0.0, 0.0), "conform"),
        ((-1.0, 1.0), "conform"),
        ((-0.5, 1.0), "saddle"),
        ((0.0, 1.0), "line contact"),
        ((1e-14, 1.0), "practically a line"),
        ((math.nan, 1.0), "finite"),
        ((1.0, math.inf), "finite"),
    ],
)
def test_surfaces_without_elliptic_contact_are_refused(curvatures: tuple[float, float], fault: str) -> None:
    for call in (hertz_contact, hertz_contact_at_approach):
        with pytest.raises(HertzError, match=fault):
            call(*curvatures, MODULUS, 1.0)
    with pytest.raises(HertzError, match=fault):
        power_law(*curvatures, MODULUS)


def test_impossible_moduli_and_loads_are_refused() -> None:
    with pytest.raises(HertzError, match=r"E\* is 0.0 Pa"):
        hertz_contact(1.0, 1.0, 0.0, 1.0)
    with pytest.raises(HertzError, match="load"):
        hertz_contact(1.0, 1.0, MODULUS, math.nan)
