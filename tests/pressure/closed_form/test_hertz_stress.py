"""Stress under a Hertz ellipse: against closed forms, a two-dimensional cubature of the point forces, and equilibrium."""

import math

import numpy
import pytest

from contact_sim_lab.rigs.roller.twin import ellipse_stress as point_forces
from contact_sim_pkg.pressure.closed_form.hertz_stress import EllipseLoad, ellipse_stress
from contact_sim_pkg.pressure.closed_form.subsurface import max_shear

XX, YY, ZZ, XY, XZ, YZ = range(6)


def at(load, poisson, *points):
    return ellipse_stress(load, poisson, numpy.array(points, dtype=float))


@pytest.mark.parametrize(
    ("a", "b", "poisson", "traction"),
    [
        (1.0, 1.0, 0.3, (0.0, 0.0)),
        (2.0, 0.7, 0.3, (0.3, -0.2)),
        (0.4, 1.1, 0.0, (0.0, 1.0)),
        (1.0, 0.3, 0.5, (1.0, 0.0)),
    ],
)
def test_it_is_the_sum_of_the_point_forces(a, b, poisson, traction):
    load = EllipseLoad(a, b, 1.3, *traction)
    points = numpy.random.default_rng(3).uniform(-1.5, 1.5, (12, 3)) * (a, b, min(a, b))
    points[:, 2] = abs(points[:, 2]) + 0.25 * min(a, b)
    expected = [1.3 * point_forces((a, b), traction, poisson, point, 200, 400) for point in points]
    assert ellipse_stress(load, poisson, points) == pytest.approx(numpy.array(expected), abs=1e-8)


@pytest.mark.parametrize("depth", [0.0, 1e-7, 1e-4, 0.01, 0.3, 1.0, 5.0, 100.0])
def test_on_the_axis_of_a_circle(depth):
    """Johnson (1985), eq 3.45."""
    stress = at(EllipseLoad(2.0, 2.0, 1.0, 0.0, 0.0), 0.3, (0.0, 0.0, 2.0 * depth))[0]
    below = -1.0 / (1.0 + depth**2)
    arc = math.atan2(1.0, depth)
    assert stress[ZZ] == pytest.approx(below, abs=2e-9)
    assert stress[XX] == pytest.approx(-1.3 * (1.0 - depth * arc) - 0.5 * below, abs=1e-8)
    assert stress[YY] == pytest.approx(stress[XX], abs=1e-8)
    assert stress[[XY, XZ, YZ]] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("radius", [0.0, 0.3, 0.9, 0.999, 1.001, 1.2, 4.0])
def test_on_the_surface_of_a_circle(radius):
    """Johnson (1985), eqs 3.42 and 3.43: radial and circumferential stress."""
    stress = at(EllipseLoad(1.0, 1.0, 1.0, 0.0, 0.0), 0.3, (radius, 0.0, 0.0))[0]
    if radius == 0.0:
        radial = around = -0.5 * (1.0 + 0.6)
    elif radius < 1.0:
        shape = 0.4 * (1.0 - (1.0 - radius**2) ** 1.5) / (3.0 * radius**2)
        radial, around = shape - math.sqrt(1.0 - radius**2), -shape - 0.6 * math.sqrt(1.0 - radius**2)
    else:
        radial = 0.4 / (3.0 * radius**2)
        around = -radial
    assert stress[[XX, YY]] == pytest.approx((radial, around), abs=1e-6)
    assert stress[ZZ] == pytest.approx(-math.sqrt(max(0.0, 1.0 - radius**2)), abs=1e-6)


def test_the_surface_carries_what_acts_on_it():
    load = EllipseLoad(1.0, 0.5, 2.0, 0.1, -0.3)
    places = numpy.array([(0.0, 0.0, 0.0), (0.3, 0.2, 0.0), (-0.8, 0.1, 0.0), (0.0, 0.49, 0.0), (1.1, 0.2, 0.0)])
    pressure = 2.0 * numpy.sqrt(numpy.maximum(0.0, 1.0 - places[:, 0] ** 2 - 4.0 * places[:, 1] ** 2))
    stress = ellipse_stress(load, 0.3, places)
    assert stress[:, ZZ] == pytest.approx(-pressure, abs=1e-8)
    assert stress[:, XZ] == pytest.approx(-0.1 * pressure, abs=1e-8)
    assert stress[:, YZ] == pytest.approx(0.3 * pressure, abs=1e-8)


def test_it_goes_over_into_the_surface():
    load = EllipseLoad(1.0, 0.5, 1.0, 0.1, 0.2)
    places = numpy.array([(0.3, 0.2), (0.9, 0.3), (1.5, 0.7), (0.0, 0.0), (-0.2, 0.6), (0.7, -0.3)])
    on, under = (ellipse_stress(load, 0.3, numpy.column_stack([places, numpy.full(6, z)])) for z in (0.0, 5e-7))
    assert under == pytest.approx(on, abs=1e-5)


def test_the_largest_shear_of_a_circle_lies_at_half_the_radius():
    """0.310 p0 at 0.481 a for nu = 0.3, 0.266 p0 at 0.548 a for nu = 0.5."""
    depths = numpy.linspace(0.3, 0.8, 2001)
    points = numpy.column_stack([0.0 * depths, 0.0 * depths, depths])
    for poisson, shear, depth in ((0.3, 0.310, 0.481), (0.5, 0.266, 0.548)):
        values = max_shear(ellipse_stress(EllipseLoad(1.0, 1.0, 1.0, 0.0, 0.0), poisson, points))
        assert values.max() == pytest.approx(shear, abs=5e-4)
        assert depths[values.argmax()] == pytest.approx(depth, abs=1e-3)


def largest_orthogonal_shear(load, axis):
    """Of the plane of one axis: size and depth."""
    across, depth = numpy.meshgrid(numpy.linspace(0.5, 1.0, 201), numpy.linspace(0.2, 0.6, 401), indexing="ij")
    points = numpy.zeros((across.size, 3))
    points[:, axis], points[:, 2] = across.ravel() * load[axis], depth.ravel()
    shear = abs(ellipse_stress(load, 0.3, points)[:, (XZ, YZ)[axis]])
    return shear.max(), points[shear.argmax(), 2]


def test_the_orthogonal_shear_of_circle_and_ellipse():
    """Circle 0.2139 p0 at 0.351 a; b/a = 0.65: 0.230 p0 at 0.265 a across, 0.190 p0 at 0.287 a along the major axis."""
    circle = largest_orthogonal_shear(EllipseLoad(1.0, 1.0, 1.0, 0.0, 0.0), 0)
    assert circle == pytest.approx((0.2139, 0.351), abs=1e-3)
    ellipse = EllipseLoad(1.0, 0.65, 1.0, 0.0, 0.0)
    assert largest_orthogonal_shear(ellipse, 1) == pytest.approx((0.230, 0.265), abs=1e-3)
    assert largest_orthogonal_shear(ellipse, 0) == pytest.approx((0.190, 0.287), abs=1e-3)


def test_a_slender_ellipse_is_a_line():
    """Line contact of half-width b: largest shear 0.3003 p0 at 0.786 b, orthogonal shear 0.2500 p0 at 0.866 b and 0.500 b."""
    load = EllipseLoad(2000.0, 1.0, 1.0, 0.0, 0.0)
    depths = numpy.linspace(0.6, 1.0, 4001)
    shear = max_shear(at(load, 0.3, *((0.0, 0.0, depth) for depth in depths)))
    assert shear.max() == pytest.approx(0.3003, abs=1e-4)
    assert depths[shear.argmax()] == pytest.approx(0.786, abs=1e-3)
    assert abs(at(load, 0.3, (0.0, 0.8660, 0.5))[0, YZ]) == pytest.approx(0.25, abs=1e-4)


@pytest.mark.parametrize("depth", [0.1, 0.5, 2.0])
def test_a_plane_at_any_depth_carries_the_load(depth):
    """The integral of zz over a plane is -P, of xz -f_x P: P = 2/3 pi a b p0. In x = tan(t), both ways."""
    load = EllipseLoad(1.0, 0.6, 1.0, 0.25, 0.0)
    nodes, weights = numpy.polynomial.legendre.leggauss(120)
    angle = 0.5 * math.pi * nodes
    place, weight = numpy.tan(angle), 0.5 * math.pi * weights / numpy.cos(angle) ** 2
    x, y = numpy.meshgrid(place, place, indexing="ij")
    points = numpy.column_stack([x.ravel(), y.ravel(), numpy.full(x.size, depth)])
    stress = ellipse_stress(load, 0.3, points).reshape(120, 120, 6)
    carried = numpy.einsum("i,j,ijk->k", weight, weight, stress)
    force = 2.0 / 3.0 * math.pi * 0.6
    assert carried[ZZ] == pytest.approx(-force, rel=2e-4)
    assert carried[XZ] == pytest.approx(-0.25 * force, rel=5e-4)  # it decays slower


def test_what_cannot_be_is_refused_by_name():
    good = EllipseLoad(1.0, 1.0, 1.0, 0.0, 0.0)
    with pytest.raises(ValueError, match=r"a = 0.0 m and b = 1.0 m must be above 0"):
        at(good._replace(a=0.0), 0.3, (0.0, 0.0, 1.0))
    with pytest.raises(ValueError, match=r"point 1 has z = -1.0 m"):
        at(good, 0.3, (0.0, 0.0, 1.0), (0.0, 0.0, -1.0))
    with pytest.raises(ValueError, match=r"Poisson's ratio is 0\.6"):
        at(good, 0.6, (0.0, 0.0, 1.0))
    with pytest.raises(ValueError, match="finite"):
        at(good, 0.3, (0.0, math.nan, 1.0))
