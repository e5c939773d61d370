"""Every public function of the roller's contact, loads, moments and stress: checks over its domain, refusals outside."""

from __future__ import annotations

import math
import pkgutil

import numpy
import pytest
from hypothesis import strategies as st
from tests.properties import Table, positive, rows
from tests.rigs.roller.theory import test_motion_properties as moving

from contact_sim_pkg.pressure.closed_form.hertz import hertz_contact
from contact_sim_pkg.pressure.closed_form.hertz_stress import EllipseLoad, ellipse_stress
from contact_sim_pkg.pressure.closed_form.subsurface import Stress
from contact_sim_pkg.rigs.roller import theory as package
from contact_sim_pkg.rigs.roller.theory import ellipse, load_split, moments, stress, volumes, yaw_ellipse
from contact_sim_pkg.rigs.roller.theory.parameters import Bending, Curvatures, Roller

MODULES = ("ellipse", "load_split", "moments", "stress", "volumes", "yaw_ellipse")
NO_FUNCTIONS = {"parameters"}
TABLE = Table()
PREFIX = f"{package.__name__}."
holds = TABLE.holds
close = pytest.approx

CURVATURE, MODULUS, LOAD, YAW = st.floats(1.0, 200.0), positive(1e6, 1e12), positive(1e-3, 1e5), st.floats(-1.5, 1.5)
BODIES = st.builds(Curvatures, CURVATURE, CURVATURE, CURVATURE, CURVATURE)
KIND = st.sampled_from([ellipse.EXACT, ellipse.POLYNOMIAL])


def gap(curvatures, yaw, x, y):
    """Height of the roller over the shaft at (x, y): each surface by its own axes, the roller's turned by the yaw."""
    along, across = math.cos(yaw) * x + math.sin(yaw) * y, math.cos(yaw) * y - math.sin(yaw) * x
    own = curvatures.roller_axial * along**2 + curvatures.roller_rolling * across**2
    return 0.5 * (own + curvatures.shaft_axial * x**2 + curvatures.shaft_rolling * y**2)


def check_contact(found, curvatures, yaw, modulus, load, kind):
    """Along the axes of the ellipse the gap has no mixed part, and Hertz holds with its curvatures there."""
    c, s = math.cos(found.angle), math.sin(found.angle)
    near_x, near_y = gap(curvatures, yaw, c, s), gap(curvatures, yaw, -s, c)
    mixed = gap(curvatures, yaw, c - s, s + c) - near_x - near_y
    assert mixed == close(0.0, abs=1e-9 * (near_x + near_y))
    assert abs(found.angle) <= 0.25 * math.pi + 1e-12
    expected = hertz_contact(near_x, near_y, modulus, load)
    axes = (expected.a, expected.b) if near_x <= near_y else (expected.b, expected.a)
    exact = kind == ellipse.EXACT
    if exact or abs(near_x - near_y) < 0.8 * (near_x + near_y):
        found_here = (found.along_x, found.along_y, found.peak_pressure, found.approach)
        near = (*axes, expected.peak_pressure, expected.approach)
        assert found_here == close(near, rel=1e-6 if exact else 0.011)
    assert found.load == load == close(2.0 / 3.0 * found.area * found.peak_pressure, rel=1e-12)


SADDLE = {"curvatures": Curvatures(1.0, 1.0, -2.0, 0.0)}


@holds(ellipse.contact_of_rollers, curvatures=BODIES, yaw=YAW, modulus=MODULUS, load=LOAD, kind=KIND,
       outside=(SADDLE, {"modulus": 0.0}, {"kind": 7}))  # fmt: skip
def _(found, curvatures, yaw, modulus, load, kind):
    check_contact(found, curvatures, yaw, modulus, load, kind)
    assert ellipse.contact_of_rollers(curvatures, yaw, modulus, -load, kind).load == 0.0


@holds(ellipse.rolling_contact, curvatures=BODIES, yaw=YAW, modulus=MODULUS, load=LOAD, kind=KIND)
def _(found, curvatures, yaw, modulus, load, kind):
    check_contact(found, curvatures, yaw, modulus, load, kind)


@holds(ellipse.principal_curvatures, curvatures=BODIES, yaw=YAW)
def _(found, curvatures, yaw):
    """The gap along the two axes; its sum is the mean curvature."""
    c, s = math.cos(found.angle), math.sin(found.angle)
    assert found.near_x == close(gap(curvatures, yaw, c, s), rel=1e-9)
    assert found.near_y == close(gap(curvatures, yaw, -s, c), rel=1e-9)
    assert found.near_x + found.near_y == close(0.5 * sum(curvatures))


@holds(ellipse.rolling_contacts, curvatures=rows(CURVATURE, 8, 8).map(lambda v: v.reshape(2, 4)), yaws=rows(YAW, 2, 2),
       modulus=MODULUS, loads=rows(LOAD, 2, 2), kind=KIND, out=st.builds(lambda: numpy.ones((2, 6))))  # fmt: skip
def _(found, curvatures, yaws, modulus, loads, kind, out):
    for row, bodies, yaw, load in zip(out, curvatures, yaws, loads, strict=True):
        check_contact(
            ellipse.RollingContact(*row.tolist()), Curvatures(*bodies.tolist()), float(yaw), modulus, load, kind
        )


@holds(ellipse.local_coefficients, curvatures=BODIES, yaw=st.floats(-0.5, 0.5), modulus=MODULUS, kind=st.just(ellipse.EXACT),
       bends=rows(st.floats(-50.0, 2.0), 3, 3), out=st.builds(lambda: numpy.ones(3)))  # fmt: skip
def _(found, curvatures, yaw, modulus, kind, bends, out):
    """Hertz's approach under 1 N on a shaft of another curvature; False where it is too hollow."""
    each = [curvatures._replace(shaft_rolling=curvatures.shaft_rolling - float(bend)) for bend in bends]
    least = [min(gap(here, yaw, math.cos(t), math.sin(t)) for t in numpy.linspace(0.0, math.pi, 181)) for here in each]
    if min(least) > 0.01:
        assert found
        under = [ellipse.contact_of_rollers(here, yaw, modulus, 8.0).approach for here in each]
        assert out * 4.0 == close(numpy.array(under), rel=1e-9)  # 8^(2/3)
    elif min(least) < 0.0:
        assert not found


# How the load divides

SOFT, BENT = positive(1e-9, 1e-5), st.just(0.0) | positive(1e-10, 1e-5)


@holds(load_split.load_of_approach, contact_coefficient=SOFT, bending_compliance=BENT, approach=positive(1e-9, 1e-2))
def _(found, contact_coefficient, bending_compliance, approach):
    assert contact_coefficient * found ** (2 / 3) + bending_compliance * found == close(approach, rel=1e-12)


@holds(load_split.parallel_contact_load, contact_coefficient=SOFT, bending_compliance=BENT, load=LOAD)
def _(found, contact_coefficient, bending_compliance, load):
    """Contact and bending move alike, and together carry the load."""
    assert 0.0 <= found <= load * (1.0 + 1e-12)
    alike = bending_compliance * (load - found)
    assert contact_coefficient * found ** (2 / 3) == close(alike, rel=1e-9, abs=1e-12 * bending_compliance * load)


# Moments

ROLLER = Roller(0.02, 2e-5, 2e-5, 0.0, 3.5e-5, 100.0, 60.0, 50.0, 0.0, 0.0, 0.01)
BENDING = st.builds(Bending, st.floats(0.0, 500.0), st.floats(0.0, 0.2), st.floats(0.0, 0.2), st.just(0.005),
                    st.just(0.25 * math.pi * 0.005**4), st.floats(0.0, 0.3))  # fmt: skip
ANGLE = st.floats(-0.2, 0.2)
TILT = {"load": LOAD, "tilt": ANGLE}


def check_moments(found, bending, contact, load, tilt):
    """Integrals over the ellipse: the pressure's, the rolling friction's, and that of a traction in proportion to the bending."""
    straight = load * 0.02 * math.sin(tilt)
    about_y, about_z = straight, 0.01 * straight
    if bending is not None:
        a, b = contact.along_x, contact.along_y
        pull = bending.friction * bending.load * math.pi * a * b * (bending.radius - contact.approach)
        pull /= bending.second_moment
        arm = bending.contact_distance - bending.load_distance + 0.02 * math.sin(tilt)
        about_y -= pull * 0.02 * math.cos(tilt) * arm
        r, t = numpy.meshgrid((numpy.arange(60) + 0.5) / 60, (numpy.arange(60) + 0.5) * math.pi / 30)
        u, v = a * r * numpy.cos(t), b * r * numpy.sin(t)
        c, s = math.cos(contact.angle), math.sin(contact.angle)
        traction = pull / (math.pi * a * b) * (c * u - s * v)  # the bending grows along the shaft
        about_z += float(numpy.sum(traction * (s * u + c * v) * r)) * a * b / 60 * math.pi / 30
    assert found.tilt == close(about_y, rel=1e-9, abs=1e-15)
    assert found.yaw == close(about_z, rel=1e-3, abs=1e-4 * abs(found.yaw - 0.01 * straight) + 1e-15)


@holds(
    moments.moments,
    roller=st.just(ROLLER),
    curvatures=BODIES,
    bending=st.none() | BENDING,
    modulus=MODULUS,
    **TILT,
    yaw=YAW,
)
def _(found, roller, curvatures, bending, modulus, load, tilt, yaw):
    check_moments(found, bending, ellipse.contact_of_rollers(curvatures, yaw, modulus, load), load, tilt)


@holds(moments.moments_of_straight, roller=st.just(ROLLER), **TILT)
def _(found, roller, load, tilt):
    check_moments(found, None, None, load, tilt)


@holds(moments.moments_of_bent, roller=st.just(ROLLER), bending=BENDING, **TILT,
       ellipse=st.just(yaw_ellipse.exact_ellipse(Curvatures(100.0, 50.0, 200.0, 0.0), 1e11, 0.3)))  # fmt: skip
def _(found, roller, bending, load, tilt, **given):
    contact = ellipse.contact_of_rollers(Curvatures(100.0, 50.0, 200.0, 0.0), 0.3, 1e11, load)
    check_moments(found, bending, contact, load, tilt)


def check_ellipse(found, curvatures, modulus, yaw):
    contact = ellipse.contact_of_rollers(curvatures, yaw, modulus, 8.0)
    assert 4.0 * found.product == close(contact.area / math.pi, rel=1e-9)
    turned = (contact.along_x**2 - contact.along_y**2) * math.sin(2.0 * contact.angle)
    assert 4.0 * found.turned == close(turned, rel=1e-9, abs=1e-9 * contact.area)
    assert 4.0 * found.approach == close(contact.approach, rel=1e-9)


@holds(yaw_ellipse.exact_ellipse, curvatures=BODIES, modulus=MODULUS, yaw=YAW)
def _(found, curvatures, modulus, yaw):
    check_ellipse(found, curvatures, modulus, yaw)


@holds(yaw_ellipse.ellipse_at_yaw, curvatures=BODIES, modulus=MODULUS, yaw=YAW, fit=st.builds(yaw_ellipse.empty_fit))
def _(found, curvatures, modulus, yaw, fit):
    check_ellipse(found, curvatures, modulus, yaw)
    again = yaw_ellipse.ellipse_at_yaw(curvatures, modulus, yaw + 1e-3, fit)  # from the series now
    check_ellipse(again, curvatures, modulus, yaw + 1e-3)


@holds(yaw_ellipse.empty_fit)
def _(found):
    """Holds no yaw yet: the first one asks for the exact ellipse."""
    check_ellipse(
        yaw_ellipse.ellipse_at_yaw(Curvatures(9.0, 5.0, 3.0, 1.0), 1e9, 0.0, found),
        Curvatures(9.0, 5.0, 3.0, 1.0),
        1e9,
        0.0,
    )


# Stress and dangerous volumes

CONTACT = st.builds(ellipse.contact_of_rollers, BODIES, st.floats(-0.7, 0.7), st.just(1e11), LOAD)
TRACTION, POISSON = st.floats(-0.5, 0.5), st.floats(-0.5, 0.5)


def check_stress(found, contact, traction_x, traction_y, poisson, bending, point):
    """Tensor of the ellipse's own axes, turned by a rotation matrix."""
    c, s = math.cos(contact.angle), math.sin(contact.angle)
    turn = numpy.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    pulled = turn[:2, :2].T @ [traction_x, traction_y]
    load = EllipseLoad(contact.along_x, contact.along_y, contact.peak_pressure, *pulled)
    xx, yy, zz, xy, xz, yz = ellipse_stress(load, poisson, (turn.T @ point)[None, :])[0]
    own = turn @ numpy.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ turn.T
    if bending is not None:
        arm = bending.contact_distance - bending.load_distance + point[0]
        own[0, 0] += bending.load * arm * (bending.radius - point[2]) / bending.second_moment
    assert tuple(found) == close(
        tuple(own[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]), rel=1e-9, abs=1e-9 * contact.peak_pressure
    )


PLACE = st.floats(1e-5, 1e-3)


@holds(
    stress.bench_stress,
    contact=CONTACT,
    traction_x=TRACTION,
    traction_y=TRACTION,
    poisson=POISSON,
    x=PLACE,
    y=PLACE,
    z=PLACE,
)
def _(found, contact, traction_x, traction_y, poisson, x, y, z):
    check_stress(found, contact, traction_x, traction_y, poisson, None, numpy.array([x, y, z]))


@holds(
    stress.add_bending,
    stress=st.just(Stress(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)),
    bending=st.none() | BENDING,
    x=PLACE,
    z=PLACE,
)
def _(found, bending, x, z, **given):
    """Navier: the stress of the moment over the section; the middle of the shaft has none."""
    more = 0.0
    if bending is not None:
        moment = bending.load * (bending.contact_distance - bending.load_distance + x)
        more = moment / bending.second_moment * (bending.radius - z)
    assert found == (close(1.0 + more), 2.0, 3.0, 4.0, 5.0, 6.0)


@holds(stress.bench_stresses, contact=CONTACT, bending=st.none() | BENDING, traction_x=TRACTION, traction_y=TRACTION,
       poisson=POISSON, points=rows(PLACE, 6, 6).map(lambda v: v.reshape(2, 3)),
       out=st.builds(lambda: numpy.ones((2, 6))))  # fmt: skip
def _(found, contact, bending, traction_x, traction_y, poisson, points, out):
    for row, point in zip(out, points, strict=True):
        check_stress(row, contact, traction_x, traction_y, poisson, bending, point)


@holds(volumes.box_volume, contact=CONTACT)
def _(found, contact):
    assert found == close(16.0 * contact.along_x * contact.along_y * 3.0 * max(contact.along_x, contact.along_y))


CELLS, LIMITS = st.just((8, 8, 6)), st.tuples(positive(1e6, 1e9), positive(1e6, 1e9))
PARTS = st.tuples(st.floats(0.05, 0.9), st.floats(0.05, 0.9))
SMOOTH = st.builds(ellipse.contact_of_rollers, BODIES, st.floats(-0.7, 0.7), st.just(1e11), st.just(100.0))
WRONG = ({"limits": (1.0, math.nan)}, {"limits": (0.0, 1.0)}, {"poisson": 0.51}, {"traction": (0.0, math.nan)})


def at_load(contact, factor):
    """The same contact under `factor` times the load."""
    size = factor ** (1.0 / 3.0)
    return contact._replace(
        along_x=contact.along_x * size, along_y=contact.along_y * size, peak_pressure=contact.peak_pressure * size,
        approach=contact.approach * size**2, load=contact.load * factor,
    )  # fmt: skip


@holds(volumes.dangerous_volumes, contact=SMOOTH, poisson=st.floats(0.0, 0.5), limits=LIMITS,
       cells=CELLS, traction=st.tuples(TRACTION, TRACTION), kind=st.sampled_from([volumes.COUNTED, volumes.INTERPOLATED]),
       outside=(*WRONG, {"cells": (1, 2, 2)}, {"kind": 2}), examples=8)  # fmt: skip
def _(found, contact, poisson, limits, cells, traction, kind):
    """Of the union: no less than each, no more than all; with the load and limits c^3 and c times, c^3 times as large."""
    assert max(found[:6]) <= found.any * (1 + 1e-12) <= (sum(found[:6]) + 1e-300) * (1 + 1e-9)
    assert found.any <= volumes.box_volume(contact) * (1 + 1e-9)
    harder = (2.0 * limits[0], 2.0 * limits[1])
    scaled = volumes.dangerous_volumes(at_load(contact, 8.0), poisson, harder, cells, None, traction, kind)
    assert numpy.array(scaled) == close(8.0 * numpy.array(found), rel=1e-6, abs=1e-9 * found.any)
    lower = volumes.dangerous_volumes(contact, poisson, (0.9 * limits[0], 0.9 * limits[1]), cells, None, traction, kind)
    assert (numpy.array(lower) >= numpy.array(found) * (1 - 1e-12)).all()


@holds(volumes.fills_box, contact=CONTACT, volumes=st.just(volumes.Volumes(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1e-9)))
def _(found, contact, **given):
    assert found == (volumes.box_volume(contact) < 1e-9)


@holds(volumes.leaves_box, contact=SMOOTH, poisson=st.floats(0.0, 0.5), limits=st.tuples(positive(1e5, 1e9), positive(1e5, 1e9)),
       traction=st.tuples(TRACTION, TRACTION), outside=WRONG)  # fmt: skip
def _(found, contact, poisson, limits, traction):
    """It does where the floor below the middle is dangerous, and not where no limit is reached anywhere."""
    depth = 3.0 * max(contact.along_x, contact.along_y)
    floor = numpy.zeros((1, 6))
    stress.bench_stresses(contact, None, *traction, poisson, numpy.array([[0.0, 0.0, depth]]), floor)
    ratio = abs(floor[0]) / numpy.repeat(limits, 3)
    assert found or ratio.max() <= 1.0
    assert not (found and min(limits) > 3.0 * contact.peak_pressure)


@holds(volumes.largest_ratio, contact=SMOOTH, poisson=st.floats(0.0, 0.5), limits=LIMITS,
       cells=CELLS, bending=st.none() | BENDING, traction=st.tuples(TRACTION, TRACTION), outside=(*WRONG, {"cells": (2, 2, 0)}),
       examples=8)  # fmt: skip
def _(found, contact, poisson, limits, cells, bending, traction):
    """A limit just above it leaves nothing dangerous, one just below it something."""
    above, below = (tuple(limit * found * part for limit in limits) for part in (1.0 + 1e-9, 1.0 - 1e-6))
    assert volumes.dangerous_volumes(contact, poisson, above, cells, bending, traction).any == 0.0
    assert volumes.dangerous_volumes(contact, poisson, below, cells, bending, traction).any > 0.0
    unloaded = ellipse.RollingContact(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    assert volumes.largest_ratio(unloaded, poisson, limits, cells, bending, traction) == 0.0


test_each_holds_over_its_domain, test_each_refuses_what_it_cannot_do, test_each_public_function_has_a_property = (
    TABLE.tests(
        "contact_sim_pkg.rigs.roller.theory", MODULES, (ellipse.RollingContact, volumes.Volumes, yaw_ellipse.YawEllipse)
    )
)


def test_each_module_of_the_package_is_in_a_table():
    found = {
        module.name.removeprefix(PREFIX)
        for module in pkgutil.walk_packages(package.__path__, PREFIX)
        if not module.ispkg
    }
    assert found == {*MODULES, *moving.MODULES, *NO_FUNCTIONS}
