"""Every public function of Hertz's contact, axisymmetric profiles and the shallow shell: checks over its domain, refusals."""

from __future__ import annotations

import math

import mpmath
import numpy
import pytest
import scipy.integrate
from hypothesis import strategies as st
from tests.properties import Table, positive, rows

from contact_sim_lab.closed_form import axisymmetric, axisymmetric_profile
from contact_sim_lab.closed_form.axisymmetric_profile import PowerProfile, SlopeProfile
from contact_sim_pkg.pressure.closed_form import hertz, hertz_fits
from contact_sim_pkg.rigs.backrest import shell

MODULES = (
    "pressure.closed_form.hertz",
    "pressure.closed_form.hertz_fits",
    "rigs.backrest.shell",
)
LABORATORY = ("closed_form.axisymmetric", "closed_form.axisymmetric_profile")
TABLE = Table()
holds = TABLE.holds
close = pytest.approx

# Hertz

CURVATURE, MODULUS, LOAD = positive(1e-3, 1e4), positive(1e4, 1e12), positive(1e-9, 1e9)

LINE = {"curvature_a": 1e-13, "curvature_b": 1.0}


def check_hertz(found, smaller, larger, modulus):
    """The displacements under the pressure make up the gap (Johnson 1985, eqs 4.24 to 4.26), in 60 digits."""
    assert found.load == close(2.0 / 3.0 * math.pi * found.a * found.b * found.peak_pressure, rel=1e-12)
    with mpmath.workdps(60):
        a, b = mpmath.mpf(found.a), mpmath.mpf(found.b)
        m = 1 - (b / a) ** 2
        slope = mpmath.mpf(found.peak_pressure) * b / modulus
        if m > 1e-6:
            k, e = mpmath.ellipk(m), mpmath.ellipe(m)
            rounding = 1e-12 + 4e-15 / float(m)
            assert float(slope / a**2 * (k - e) / m / smaller) == close(1.0, rel=rounding)
            assert float(slope / a**2 * ((a / b) ** 2 * e - k) / m / larger) == close(1.0, rel=rounding)
        else:
            assert float(slope / a**2 * mpmath.pi / 4 / smaller) == close(1.0, rel=1e-5)
        assert float(slope * mpmath.ellipk(m)) == close(found.approach, rel=1e-12)


@holds(hertz.hertz_contact, curvature_a=CURVATURE, curvature_b=CURVATURE, modulus=MODULUS, load=LOAD,
       outside=(LINE, {"curvature_a": -1.0}, {"curvature_b": 0.0}))  # fmt: skip
def _(found, curvature_a, curvature_b, modulus, load):
    check_hertz(found, *sorted((curvature_a, curvature_b)), modulus)
    assert found.load == load
    assert hertz.hertz_contact(curvature_b, curvature_a, modulus, load) == found
    assert hertz.hertz_contact(curvature_a, curvature_b, modulus, -load) == (0.0,) * 5


@holds(hertz.hertz_contact_at_approach, curvature_a=CURVATURE, curvature_b=CURVATURE, modulus=MODULUS, approach=positive(1e-9, 1.0),
       outside=(LINE, {"curvature_a": -1.0}))  # fmt: skip
def _(found, curvature_a, curvature_b, modulus, approach):
    check_hertz(found, *sorted((curvature_a, curvature_b)), modulus)
    assert found.approach == approach
    deeper = hertz.hertz_contact_at_approach(curvature_a, curvature_b, modulus, 4.0 * approach)
    assert deeper.load == close(8.0 * found.load, rel=1e-12)


@holds(hertz.power_law, curvature_a=CURVATURE, curvature_b=CURVATURE, modulus=MODULUS, outside=(LINE,))
def _(found, curvature_a, curvature_b, modulus):
    contact = hertz.hertz_contact(curvature_a, curvature_b, modulus, 7.0)
    assert found * contact.approach**1.5 == close(7.0, rel=1e-12)
    assert hertz.power_law(0.5, 0.5, modulus) == close(4.0 / 3.0 * modulus, rel=1e-12)  # a sphere of 1 m


@holds(hertz.contact_at_load, curvature_a=CURVATURE, curvature_b=st.just(1e4), modulus=MODULUS, load=LOAD)
def _(found, curvature_a, curvature_b, modulus, load):
    check_hertz(found, curvature_a, curvature_b, modulus)
    assert found.load == load


@holds(
    hertz.contact_at_approach,
    curvature_a=CURVATURE,
    curvature_b=st.just(1e4),
    modulus=MODULUS,
    approach=positive(1e-9, 1.0),
)
def _(found, curvature_a, curvature_b, modulus, approach):
    check_hertz(found, curvature_a, curvature_b, modulus)
    assert found.approach == approach


@holds(hertz.ellipse_shape, curvature_a=CURVATURE, curvature_b=st.just(1e4))
def _(found, curvature_a, curvature_b):
    with mpmath.workdps(40):
        m = 1 - mpmath.mpf(found.complement)
        k, e = mpmath.ellipk(m), mpmath.ellipe(m)
        assert found.integral_k == close(float(k), rel=1e-14)
        assert found.integral_e == close(float(e), rel=1e-14)
        ratio = (1 - m) * (k - e) / (e - (1 - m) * k)
        assert float(ratio) == close(curvature_a / curvature_b, rel=1e-12)


def check_fit(found, kind, pairs, modulus, load):
    for (smaller, larger), (approach, a, b, peak) in zip(pairs, found, strict=True):
        assert 2.0 / 3.0 * math.pi * a * b * peak == close(load, rel=1e-12)
        omega = (larger - smaller) / (larger + smaller)
        exact = hertz.hertz_contact(smaller, larger, modulus, load)
        if kind == hertz_fits.POLYNOMIAL:
            terms = [2.667, -3.577, 4.244, -5.871, 10.312, -18.202, 24.577, -21.858, 11.213, -2.506]
            m = sum(c * omega**n for n, c in enumerate(terms, 1))  # of the paper's eq 10
            assert (b / a) ** 2 == close(1.0 - m, rel=1e-9)
            k, e = float(mpmath.ellipk(m)), float(mpmath.ellipe(m))
            assert approach == close(peak * b * k / modulus, rel=1e-9)
            assert peak * e == close(b * modulus * (smaller + larger), rel=1e-9)
        elif kind == hertz_fits.POWER:
            assert b / a == close((smaller / larger) ** (2.0 / 3.0), rel=1e-9)
        else:
            near = close(exact[1:], rel=1e-12 if kind == hertz_fits.EXACT else 1e-5)
            assert (approach, a, b, peak) == near


SHAPES = hertz_fits.make_shape_table()
KINDS = (hertz_fits.EXACT, hertz_fits.POLYNOMIAL, hertz_fits.POWER, hertz_fits.TABLE)


@holds(hertz_fits.contacts_at_load, kind=st.sampled_from(KINDS), table=st.just(SHAPES), curvature_a=rows(st.floats(1.0, 9.9), 3, 3),
       curvature_b=rows(st.floats(10.0, 50.0), 3, 3), modulus=MODULUS, load=LOAD,
       out=st.builds(lambda: numpy.ones((3, 4))))  # fmt: skip
def _(found, kind, table, curvature_a, curvature_b, modulus, load, out):
    check_fit(out, kind, list(zip(curvature_a, curvature_b, strict=True)), modulus, load)


@holds(hertz_fits.make_shape_table)
def _(found):
    for row in found[::32]:
        with mpmath.workdps(50):
            m = -mpmath.expm1(mpmath.mpf(row[0]))
            expected = (mpmath.log(mpmath.ellipk(m)), mpmath.log(mpmath.ellipe(m)))
        assert tuple(row[1:]) == close(tuple(float(v) for v in expected), abs=1e-9)


# Axisymmetric profiles

POWERS = st.builds(PowerProfile, positive(1e-3, 10.0), st.floats(1.0, 8.0))
SLOPES = st.builds(
    lambda c, k: SlopeProfile(lambda r: 2.0 * c * r + 4.0 * k * r**3), positive(0.1, 10.0), positive(0.1, 10.0)
)
PROFILE, RADIUS = POWERS | SLOPES, positive(1e-3, 2.0)
BAD = ({"profile": PowerProfile(1.0, 0.99)}, {"profile": SlopeProfile(lambda r: r, (0.5, 0.4))},
       {"profile": SlopeProfile(lambda r: r, (), 0.5), "radius": 0.6, "approach": 9.0, "load": 9e99},
       {"profile": SlopeProfile(lambda r: numpy.nan * r)})  # fmt: skip


def bad(*names):
    """What is refused, with those of its arguments that a function has."""
    return tuple({name: value for name, value in case.items() if name in ("profile", *names)} for case in BAD)


def slope_of(profile, r):
    if isinstance(profile, PowerProfile):
        return profile.coefficient * profile.exponent * r ** (profile.exponent - 1.0)
    return float(profile.slope(numpy.array([r]))[0])


def sneddon(profile, radius, power):
    """`a int sin(t)^power f'(a sin t) dt`."""
    found, _ = scipy.integrate.quad(
        lambda t: math.sin(t) ** power * slope_of(profile, radius * math.sin(t)), 0.0, 0.5 * math.pi, epsabs=0.0
    )
    return radius * found


@holds(axisymmetric.approach_at_radius, profile=PROFILE, radius=RADIUS, outside=(*bad("radius"), {"radius": -1e-9}))
def _(found, profile, radius):
    assert found == close(sneddon(profile, radius, 0), rel=1e-6)


@holds(
    axisymmetric.load_at_radius,
    profile=PROFILE,
    modulus=MODULUS,
    radius=RADIUS,
    outside=(*bad("radius"), {"modulus": 0.0}),
)
def _(found, profile, modulus, radius):
    assert found == close(2.0 * modulus * radius * sneddon(profile, radius, 2), rel=1e-6)


@holds(axisymmetric.pressure, profile=PROFILE, modulus=MODULUS, radius=RADIUS, r=rows(st.floats(0.1, 3.0)), infinite=True,
       outside=(*bad("radius"), {"r": numpy.array([-0.1])}, {"modulus": 0.0}), examples=8)  # fmt: skip
def _(found, profile, modulus, radius, r):
    """None outside; over the disc it carries the load."""
    assert (found[r >= radius] == 0.0).all()
    assert (found[r < radius] >= 0.0).all()
    node, weight = numpy.polynomial.legendre.leggauss(40)
    angle = 0.25 * math.pi * (node + 1.0)  # r = a sin t: no root at the edge
    inside = axisymmetric.pressure(profile, modulus, radius, radius * numpy.sin(angle))
    total = 2.0 * math.pi * radius**2 * 0.25 * math.pi * float(weight @ (inside * numpy.sin(angle) * numpy.cos(angle)))
    assert total == close(axisymmetric.load_at_radius(profile, modulus, radius), rel=1e-3)


@holds(axisymmetric.radius_at_approach, profile=PROFILE, approach=positive(1e-6, 1.0), outside=bad("approach"))
def _(found, profile, approach):
    assert axisymmetric.approach_at_radius(profile, found) == close(approach, rel=1e-12)


@holds(axisymmetric.radius_at_load, profile=PROFILE, modulus=MODULUS, load=positive(1e-6, 1e4),
       outside=(*bad("load"), {"modulus": 0.0}))  # fmt: skip
def _(found, profile, modulus, load):
    assert axisymmetric.load_at_radius(profile, modulus, found) == close(load, rel=1e-12)


@holds(axisymmetric_profile.refuse_profile, profile=PROFILE, outside=BAD[:2])
def _(found, profile):
    assert found is None


RISING = rows(st.floats(0.01, 1.0), 4, 4).map(lambda steps: numpy.append(0.0, numpy.cumsum(steps)))


@holds(axisymmetric_profile.tabulated_profile, radius=RISING, height=RISING,
       outside=({"radius": numpy.array([0.0, 1.0])}, {"height": numpy.zeros(5)}, {"radius": numpy.arange(1.0, 6.0)}))  # fmt: skip
def _(found, radius, height):
    """Its slope goes through the points, and never falls."""
    assert found.reach == radius[-1]
    for n in range(4):
        rise, _ = scipy.integrate.quad(lambda r: float(found.slope(numpy.array([r]))[0]), radius[n], radius[n + 1])
        assert rise == close(height[n + 1] - height[n], rel=1e-6)
    assert (found.slope(numpy.linspace(0.0, radius[-1], 101)) >= -1e-12 * height[-1] / radius[1]).all()


# Shallow shell

SHELL = st.builds(
    shell.ShallowShell, st.floats(0.3, 1.0), st.floats(0.3, 1.0), positive(1e-4, 0.02), positive(1e6, 1e12), st.floats(0.0, 0.5),
    positive(100.0, 1e4), st.sampled_from([math.inf, 1.0, -2.0]), st.sampled_from([math.inf, 1.5, -3.0]),
)  # fmt: skip
POINTS = rows(st.floats(0.0, 0.3), 4, 4).map(lambda v: v.reshape(2, 2))
COUNT = st.sampled_from([1, 4, 9, 25])
PLATE = shell.ShallowShell(1.0, 0.5, 0.01, 1e9, 0.3, 1000.0, math.inf, math.inf)
BAD_SHELL = tuple(
    {"shell": PLATE._replace(**change)} for change in ({"thickness": 0.06}, {"poisson": 0.51}, {"radius_1": 0.5})
)
BEYOND = {"points": numpy.array([[0.1, 1.1]])}


def frequency(made, m, n):
    """Energy of bending and stretching of one half wave each way, over its mass."""
    a, b = (m * math.pi / made.length_1) ** 2, (n * math.pi / made.length_2) ** 2
    plate = made.young * made.thickness**3 / (12.0 * (1.0 - made.poisson**2)) * (a + b) ** 2
    stretch = made.young * made.thickness * ((a / made.radius_2 + b / made.radius_1) / (a + b)) ** 2
    return math.sqrt((plate + stretch) / (made.density * made.thickness))


@holds(shell.natural_frequencies, shell=SHELL, count=COUNT, outside=(*BAD_SHELL, {"count": 3}, {"count": 2.5}))
def _(found, count, **given):
    side = math.isqrt(count)
    expected = [frequency(given["shell"], m, n) for m in range(1, side + 1) for n in range(1, side + 1)]
    assert found == close(numpy.array(expected), rel=1e-9)


@holds(
    shell.shell_modes, shell=SHELL, count=COUNT, points=POINTS, outside=(*BAD_SHELL, BEYOND, {"points": numpy.zeros(2)})
)
def _(found, count, points, **given):
    made = given["shell"]
    for (m, n), shape, slope_x, slope_y in zip(
        found.orders, found.shapes.T, found.slopes_x.T, found.slopes_y.T, strict=True
    ):
        turns_x, turns_y = m * math.pi / made.length_1, n * math.pi / made.length_2
        value = numpy.exp(1j * turns_x * points[:, 0]), numpy.exp(1j * turns_y * points[:, 1])
        assert shape == close(value[0].imag * value[1].imag, abs=1e-12)
        assert slope_x == close(turns_x * value[0].real * value[1].imag, abs=1e-9)
        assert slope_y == close(turns_y * value[0].imag * value[1].real, abs=1e-9)
    area = made.length_1 * made.length_2  # the mean of sin^2 sin^2 is 1/4
    assert found.modal_mass == close(0.25 * made.density * made.thickness * area)
    assert found.frequencies == close(shell.natural_frequencies(made, count))


@holds(shell.static_deflection, shell=SHELL, count=COUNT, loads=rows(st.floats(-10.0, 10.0), 2, 2), load_points=POINTS,
       points=POINTS, outside=(*BAD_SHELL, BEYOND, {"loads": numpy.ones(3)}))  # fmt: skip
def _(found, count, loads, load_points, points, **given):
    """Maxwell's reciprocity, and the crest of one mode under a load at its crest."""
    made = given["shell"]
    back = shell.static_deflection(made, count, numpy.array([3.0, 5.0]), points, load_points)
    assert loads @ back == close(
        numpy.array([3.0, 5.0]) @ found, rel=1e-9, abs=1e-12 * abs(loads).max() * abs(back).max()
    )
    crest = numpy.array([[0.5 * made.length_1, 0.5 * made.length_2]])
    mass = 0.25 * made.density * made.thickness * made.length_1 * made.length_2
    assert shell.static_deflection(made, 1, [2.0], crest, crest)[0] * mass * frequency(made, 1, 1) ** 2 == close(
        2.0, rel=1e-9
    )


def test_a_square_plate_bends_under_a_load_at_its_middle_as_in_the_tables():
    """w = 0.01160 P L^2/D (Timoshenko and Woinowsky-Krieger 1959, table 23)."""
    plate = PLATE._replace(length_2=1.0)
    stiffness = 1e9 * 0.01**3 / (12.0 * (1.0 - 0.3**2))
    middle = numpy.array([[0.5, 0.5]])
    assert shell.static_deflection(plate, 1600, [1.0], middle, middle)[0] * stiffness == close(0.01160, abs=5e-6)


@holds(shell.crown_gap, shell=SHELL, points=POINTS, outside=(*BAD_SHELL, BEYOND))
def _(found, points, **given):
    made = given["shell"]
    away = points - 0.5 * numpy.array([made.length_1, made.length_2])
    expected = away[:, 0] ** 2 / (2.0 * made.radius_1) + away[:, 1] ** 2 / (2.0 * made.radius_2)
    assert found == close(expected, rel=1e-9, abs=1e-15)


test_each_holds_over_its_domain, test_each_refuses_what_it_cannot_do, test_each_public_function_has_a_property = (
    TABLE.tests("contact_sim_pkg", MODULES)
)


def test_each_public_function_of_the_laboratory_has_a_property():
    assert TABLE.missing("contact_sim_lab", LABORATORY) == []
