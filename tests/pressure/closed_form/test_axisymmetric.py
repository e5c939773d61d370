"""Axisymmetric contact: closed forms, multiple precision, Hertz, tables, inverses and refusals."""

from __future__ import annotations

import math

import mpmath
import numpy
import pytest
import scipy.integrate
import scipy.interpolate
import scipy.optimize

from contact_sim_lab.closed_form.axisymmetric import (
    approach_at_radius,
    load_at_radius,
    pressure,
    radius_at_approach,
    radius_at_load,
)
from contact_sim_lab.closed_form.axisymmetric_profile import (
    AxisymmetricError,
    PowerProfile,
    SlopeProfile,
    tabulated_profile,
)
from contact_sim_lab.twins import axisymmetric as reference
from contact_sim_pkg.pressure.closed_form.hertz import hertz_contact

MODULUS = 4e6
INSIDE = numpy.array([1e-6, 0.01, 0.3, 0.5, 0.9, 0.999, 0.9999999])


def mixed_slope(r: numpy.ndarray) -> numpy.ndarray:
    """Cone, sphere and quartic together: f = 0.1 r + 2 r^2 + 30 r^4."""
    return 0.1 + 4.0 * r + 120.0 * r**3


def closed_pressure(k: int, factor: float, r: numpy.ndarray) -> numpy.ndarray:
    """p / (E*/pi) at a = 1 for approach `factor s^k`: `factor k I(k-1)`, I by its recurrence."""
    root = numpy.sqrt(1.0 - r**2)
    integrals = [numpy.arccosh(1.0 / r), root]
    for m in range(2, k):
        integrals.append((root + (m - 1) * r**2 * integrals[m - 2]) / m)
    return factor * k * integrals[k - 1]


@pytest.mark.parametrize(
    ("k", "approach", "load"), [(1, math.pi / 2, math.pi / 2), (2, 2.0, 8 / 3), (4, 8 / 3, 64 / 15)]
)
def test_power_profiles_have_their_closed_forms(k: int, approach: float, load: float) -> None:
    same = (PowerProfile(1.0, float(k)), SlopeProfile(lambda r: k * r ** (k - 1)))
    for profile in same:
        assert approach_at_radius(profile, 1.0) == pytest.approx(approach, rel=1e-13)
        assert load_at_radius(profile, 1.0, 1.0) == pytest.approx(load, rel=1e-13)
        found = pressure(profile, math.pi, 1.0, INSIDE)
        expected = closed_pressure(k, approach, INSIDE)
        assert found == pytest.approx(expected, rel=1e-10, abs=3e-10 * expected.max())


@pytest.mark.parametrize("k", [1.2, 1.5, 2.7, 9.0])
def test_broken_exponents_agree_between_quadrature_and_closed_form(k: float) -> None:
    power, slope = PowerProfile(3.0, k), SlopeProfile(lambda r: 3.0 * k * r ** (k - 1.0))
    assert approach_at_radius(slope, 0.2) == pytest.approx(approach_at_radius(power, 0.2), rel=1e-11)
    assert load_at_radius(slope, MODULUS, 0.2) == pytest.approx(load_at_radius(power, MODULUS, 0.2), rel=1e-11)
    centre = numpy.zeros(1)
    assert pressure(slope, MODULUS, 0.2, centre) == pytest.approx(pressure(power, MODULUS, 0.2, centre), rel=1e-9)


def test_the_paraboloid_is_hertz() -> None:
    radius = 0.3
    profile = PowerProfile(0.5 / radius, 2.0)
    hertz = hertz_contact(0.5 / radius, 0.5 / radius, MODULUS, 4000.0)
    assert radius_at_load(profile, MODULUS, 4000.0) == pytest.approx(hertz.a, rel=1e-14)
    assert radius_at_approach(profile, hertz.approach) == pytest.approx(hertz.a, rel=1e-14)
    found = pressure(profile, MODULUS, hertz.a, numpy.append(0.0, INSIDE) * hertz.a)
    expected = hertz.peak_pressure * numpy.sqrt(1.0 - numpy.append(0.0, INSIDE) ** 2)
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-10 * hertz.peak_pressure)


def test_a_mixed_profile_equals_multiple_precision() -> None:
    profile = SlopeProfile(mixed_slope)
    assert approach_at_radius(profile, 0.2) == pytest.approx(reference.approach(mixed_slope, 0.2), rel=1e-12)
    assert load_at_radius(profile, MODULUS, 0.2) == pytest.approx(reference.load(mixed_slope, MODULUS, 0.2), rel=1e-12)
    for r in (1e-4, 0.05, 0.19):
        found = pressure(profile, MODULUS, 0.2, numpy.array([r]))[0]
        expected = reference.pressure(mixed_slope, lambda x: 4.0 + 360.0 * x**2, MODULUS, 0.2, r)
        assert found == pytest.approx(expected, rel=1e-10)


def test_a_blunted_cone_with_a_break_equals_multiple_precision() -> None:
    """Slope r/b up to b, 1 beyond: its second derivative jumps at b."""
    b = 0.04
    profile = SlopeProfile(lambda r: numpy.minimum(r / b, 1.0), (b,))
    for a in (0.03, 0.04, 0.0401, 0.1):
        slope = lambda r: min(r / b, mpmath.mpf(1))  # noqa: E731
        assert approach_at_radius(profile, a) == pytest.approx(reference.approach(slope, a, (b,)), rel=1e-12)
        assert load_at_radius(profile, MODULUS, a) == pytest.approx(reference.load(slope, MODULUS, a, (b,)), rel=1e-12)


def blunted_pressure(b: float, a: float, r: float) -> float:
    """p / E* below the blunted cone: d(s) = s^2/b inside b, `s (s/b (1 - cos q) + pi/2 - q)`, q = asin(b/s) outside."""
    with mpmath.workdps(30):
        blunt, near, edge = mpmath.mpf(b), mpmath.mpf(r), mpmath.mpf(a)

        def approach_slope(s: mpmath.mpf) -> mpmath.mpf:
            if s <= blunt:
                return 2 * s / blunt
            q = mpmath.asin(blunt / s)
            return 2 * s / blunt * (1 - mpmath.cos(q)) + mpmath.pi / 2 - q  # the terms of dq/ds cancel

        if r == 0.0:
            outside = mpmath.quad(lambda s: approach_slope(s) / s, [blunt, 2 * blunt, edge])
            return float((2 + outside) / mpmath.pi)
        edges = [mpmath.mpf(0), *([mpmath.acosh(blunt / near)] if r < b else []), mpmath.acosh(edge / near)]
        return float(mpmath.quad(lambda u: approach_slope(near * mpmath.cosh(u)), edges) / mpmath.pi)


@pytest.mark.parametrize("r", [0.0, 1e-5, 0.02, 0.0399, 0.039999, 0.04, 0.0401, 0.06, 0.0999])
def test_the_pressure_of_a_blunted_cone_equals_multiple_precision(r: float) -> None:
    profile = SlopeProfile(lambda x: numpy.minimum(x / 0.04, 1.0), (0.04,))
    assert float(pressure(profile, 1.0, 0.1, r)) == pytest.approx(blunted_pressure(0.04, 0.1, r), rel=1e-9)


@pytest.mark.parametrize(
    ("profile", "a"),
    [(SlopeProfile(mixed_slope), 0.2), (SlopeProfile(lambda r: numpy.minimum(r / 0.04, 1.0), (0.04,)), 0.1)],
)
def test_the_load_is_the_integral_of_the_pressure(profile: SlopeProfile, a: float) -> None:
    def ring(angle: numpy.ndarray) -> numpy.ndarray:
        r = a * numpy.sin(angle)
        return 2.0 * math.pi * r * a * numpy.cos(angle) * pressure(profile, 1.0, a, r)

    edge = math.asin(0.4)  # the break of the second profile
    total = sum(scipy.integrate.fixed_quad(ring, *panel, n=40)[0] for panel in ((0.0, edge), (edge, math.pi / 2)))
    assert total == pytest.approx(load_at_radius(profile, 1.0, a), rel=1e-6)


@pytest.mark.parametrize(("k", "where"), [(3.0, None), (4.0, math.sqrt(0.5)), (6.0, None)])
def test_the_largest_pressure_leaves_the_centre_above_the_sphere(k: float, where: float | None) -> None:
    profile = PowerProfile(1.0, k)
    found = scipy.optimize.minimize_scalar(
        lambda r: -float(pressure(profile, 1.0, 1.0, r)), bounds=(0.0, 0.999), method="bounded"
    )
    assert found.x > 0.4
    assert -found.fun > 1.05 * float(pressure(profile, 1.0, 1.0, 0.0))
    if where is not None:  # p ~ sqrt(1 - r^2) (1 + 2 r^2)
        assert found.x == pytest.approx(where, abs=1e-4)
        assert -found.fun / float(pressure(profile, 1.0, 1.0, 0.0)) == pytest.approx(math.sqrt(2.0), rel=1e-7)


def test_the_paraboloid_has_its_largest_pressure_in_the_centre_and_the_cone_an_infinite_one() -> None:
    inside = numpy.linspace(0.0, 1.0, 21)
    assert numpy.all(numpy.diff(pressure(PowerProfile(1.0, 2.0), 1.0, 1.0, inside)) < 0.0)
    assert pressure(PowerProfile(1.0, 1.0), 1.0, 1.0, 0.0) == math.inf
    assert pressure(SlopeProfile(mixed_slope), 1.0, 1.0, 0.0) == math.inf
    assert numpy.all(pressure(SlopeProfile(mixed_slope), 1.0, 1.0, numpy.array([[1.0, 2.0]])) == 0.0)


def test_a_fine_table_tends_to_its_profile() -> None:
    exact = PowerProfile(5.0, 2.0)
    errors = []
    for points in (11, 41):
        radius = numpy.linspace(0.0, 0.2, points)
        table = tabulated_profile(radius, 5.0 * radius**2)
        inside = numpy.array([0.0, 0.05, 0.1])
        error = pressure(table, MODULUS, 0.15, inside) / pressure(exact, MODULUS, 0.15, inside) - 1.0
        errors.append(float(abs(error[1:]).max()))
        assert load_at_radius(table, MODULUS, 0.15) == pytest.approx(
            load_at_radius(exact, MODULUS, 0.15), rel=2.0 / points**2
        )
    assert errors[0] < 2e-3
    assert errors[1] < errors[0] / 4.0


def test_a_table_is_read_as_scipys_monotone_cubic() -> None:
    radius, height = numpy.array([0.0, 0.1, 0.15, 0.3, 0.5]), numpy.array([0.0, 0.01, 0.01, 0.2, 0.9])
    table = tabulated_profile(radius, height)
    expected = scipy.interpolate.PchipInterpolator(radius, height).derivative()
    between = numpy.linspace(0.101, 0.2999, 40)  # scipy ends with other slopes
    assert table.slope(between) == pytest.approx(expected(between), abs=1e-13)
    step = numpy.diff([scipy.integrate.quad(table.slope, 0.0, r, points=radius[1:-1])[0] for r in radius])
    assert step == pytest.approx(numpy.diff(height), abs=1e-12)


@pytest.mark.parametrize(
    "profile",
    [
        PowerProfile(2.0, 1.0),
        PowerProfile(2.0, 3.3),
        SlopeProfile(mixed_slope),
        SlopeProfile(lambda r: numpy.minimum(r / 0.04, 1.0), (0.04,)),
        tabulated_profile(numpy.linspace(0.0, 3.0, 9), numpy.linspace(0.0, 3.0, 9) ** 2),
    ],
)
def test_radius_is_inverse_to_approach_and_load(profile: PowerProfile | SlopeProfile) -> None:
    for radius in (1e-9, 0.01, 0.04, 0.3, 2.9):
        assert radius_at_approach(profile, approach_at_radius(profile, radius)) == pytest.approx(radius, rel=1e-12)
        load = load_at_radius(profile, MODULUS, radius)
        assert radius_at_load(profile, MODULUS, load) == pytest.approx(radius, rel=1e-12)
    for nothing in (0.0, -1.0):
        assert radius_at_approach(profile, nothing) == 0.0
        assert radius_at_load(profile, MODULUS, nothing) == 0.0
    assert load_at_radius(profile, MODULUS, 0.0) == 0.0


def test_what_has_no_disc_contact_is_refused() -> None:
    table = tabulated_profile(numpy.array([0.0, 1.0, 2.0]), numpy.array([0.0, 1.0, 4.0]))
    with pytest.raises(AxisymmetricError, match=r"allowed are 0 to 2\.0 m"):
        approach_at_radius(table, 2.1)
    with pytest.raises(AxisymmetricError, match=r"reach of 2\.0 m"):
        radius_at_load(table, MODULUS, 1e30)
    with pytest.raises(AxisymmetricError, match=r"k = 0\.5"):
        approach_at_radius(PowerProfile(1.0, 0.5), 1.0)
    with pytest.raises(AxisymmetricError, match=r"E\* is 0\.0"):
        load_at_radius(table, 0.0, 1.0)
    with pytest.raises(AxisymmetricError, match="load"):
        radius_at_load(table, MODULUS, math.nan)
    with pytest.raises(AxisymmetricError, match="approach"):
        radius_at_approach(PowerProfile(1.0, 2.0), math.inf)
    with pytest.raises(AxisymmetricError, match="not one disc"):  # a ring-shaped groove
        pressure(
            SlopeProfile(lambda r: numpy.where(r < 1.0, r, 1.0 - 3.0 * r), (1.0,)), 1.0, 1.3, numpy.array([0.1, 1.2])
        )
    with pytest.raises(AxisymmetricError, match="negative"):
        pressure(table, MODULUS, 1.0, numpy.array([-0.1]))


@pytest.mark.parametrize(
    ("radius", "height", "fault"),
    [
        ([0.0, 1.0], [0.0, 1.0], "shapes"),
        ([0.1, 1.0, 2.0], [0.0, 1.0, 2.0], "rise from 0"),
        ([0.0, 1.0, 1.0], [0.0, 1.0, 2.0], "rise from 0"),
        ([0.0, 1.0, 2.0], [0.0, 1.0, 0.5], "from the tip outwards"),
        ([0.0, 1.0, 2.0], [0.0, math.nan, 0.5], "finite"),
    ],
)
def test_bad_tables_are_refused(radius: list[float], height: list[float], fault: str) -> None:
    with pytest.raises(AxisymmetricError, match=fault):
        tabulated_profile(numpy.array(radius), numpy.array(height))
