"""Stress in the axes of the bench, and the volumes where it passes its limits."""

import math

import numpy
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from tests.rigs.roller.bench import BENDING, CURVATURES, MODULUS

from contact_sim_pkg.pressure.closed_form.hertz_stress import EllipseLoad, ellipse_stress
from contact_sim_pkg.rigs.roller.theory.ellipse import RollingContact, contact_of_rollers
from contact_sim_pkg.rigs.roller.theory.stress import bench_stresses
from contact_sim_pkg.rigs.roller.theory.volumes import COUNTED, INTERPOLATED, box_volume, dangerous_volumes, leaves_box

CIRCLE = RollingContact(1.0, 1.0, 0.0, 1.0, 1.0, 1.0)  # a unit circle of unit pressure
NEVER = 1e300


def stresses(contact, bending, traction, points):
    out = numpy.empty((len(points), 6))
    bench_stresses(contact, bending, *traction, 0.3, points, out)
    return out


def test_a_yawed_contact_has_the_stress_of_its_turned_ellipse():
    contact = contact_of_rollers(CURVATURES, 0.8, MODULUS, 100.0)
    points = numpy.random.default_rng(2).uniform(0.0, 3e-4, (20, 3))
    c, s = math.cos(contact.angle), math.sin(contact.angle)
    turn = numpy.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])  # into the axes of the ellipse
    pull = turn @ (0.1, -0.2, 0.0)
    own = ellipse_stress(
        EllipseLoad(contact.along_x, contact.along_y, contact.peak_pressure, pull[0], pull[1]), 0.3, points @ turn.T
    )
    xx, yy, zz, xy, xz, yz = own.T
    tensor = numpy.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]).transpose(2, 0, 1)
    back = turn.T @ tensor @ turn
    expected = numpy.stack([back[:, i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))], axis=1)
    found = stresses(contact, None, (0.1, -0.2), points)
    assert found == pytest.approx(expected, abs=1e-9 * contact.peak_pressure)


def test_bending_is_linear_over_the_shaft_and_225_mpa_at_its_surface():
    """Q = 225 N at 98 mm on a shaft of 5 mm: the paper's 225 MPa."""
    points = numpy.array([(0.0, 0.0, 0.0), (0.0, 0.0, 0.005), (0.098, 0.0, 0.0)])
    free = RollingContact(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    bent = stresses(free, BENDING, (0.0, 0.0), points)
    assert abs(bent[0, 0]) == pytest.approx(225e6, rel=2e-3)
    assert bent[1:, 0] == pytest.approx(0.0, abs=1e-3)
    assert abs(bent[:, 1:]).max() == 0.0


def volume_of_the_normal_stress(limit):
    """Of -zz > limit under a circle: zz = -(z/sqrt(u))^3 u/(u^2 + z^2), by columns of revolution."""

    def over(r, z):
        s = r * r + z * z - 1.0
        u = 0.5 * (s + math.sqrt(s * s + 4.0 * z * z))
        return (z / math.sqrt(u)) ** 3 * u / (u * u + z * z) - limit

    def height(r):
        """Depth down to which the limit is passed, less that from which on it is."""
        depths = numpy.linspace(1e-6, 6.0, 4000)
        values = numpy.array([over(r, z) for z in depths])
        where = numpy.flatnonzero(values > 0.0)
        if not len(where):
            return 0.0
        low, high = where[0], where[-1]
        top = 0.0 if low == 0 else brentq(lambda z: over(r, z), depths[low - 1], depths[low])
        return brentq(lambda z: over(r, z), depths[high], depths[high + 1]) - top

    return quad(lambda r: 2.0 * math.pi * r * height(r), 0.0, 3.0, limit=200, epsrel=1e-4)[0]


@pytest.mark.parametrize(("kind", "error"), [(COUNTED, 0.02), (INTERPOLATED, 0.004)])
def test_the_volume_of_one_component(kind, error):
    limit = 0.3
    found = dangerous_volumes(CIRCLE, 0.3, (limit, NEVER), (48, 48, 48), kind=kind)
    assert found.zz == pytest.approx(volume_of_the_normal_stress(limit), rel=error)
    assert (found.xy, found.xz, found.yz) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("limit", [0.1, 0.2, 0.3, 0.45, 0.6])
def test_the_default_cells_reach_two_parts_in_a_thousand_of_the_closed_form(limit):
    found = dangerous_volumes(CIRCLE, 0.3, (limit, NEVER))
    assert found.zz == pytest.approx(volume_of_the_normal_stress(limit), rel=2e-3)


@pytest.mark.parametrize("load", [79.5, 185.5, 238.5])
def test_the_default_cells_reach_two_parts_in_a_thousand_of_the_union(load):
    """Loads of a fatigue test with traction; beside three times as many columns and depths each way."""
    contact = contact_of_rollers(CURVATURES, 0.0, MODULUS, load)
    limits, traction = (2.6e8, 1.5e8), (0.0, 0.01)
    fine = dangerous_volumes(contact, 0.3, limits, (144, 180, 36), None, traction)
    found = dangerous_volumes(contact, 0.3, limits, traction=traction)
    assert found.any == pytest.approx(fine.any, rel=2e-3)


def test_it_reaches_as_deep_as_on_the_axis():
    """z = a sqrt(p0 / limit - 1): 140 against 40 MPa gives 1.581 a. Here 1.999 a and 2.001 a from a column of the box."""
    for depth, inside in ((1.999, True), (2.001, False)):
        limit = 1.0 / (1.0 + 2.0**2)
        stress = stresses(CIRCLE, None, (0.0, 0.0), numpy.array([(0.0, 0.0, depth)]))
        assert bool(abs(stress[0, 2]) > limit) is inside


def test_the_union_lies_between_the_largest_and_the_sum():
    contact = contact_of_rollers(CURVATURES, 0.3, MODULUS, 100.0)
    found = dangerous_volumes(contact, 0.3, (2.6e8, 1.5e8), (16, 16, 12), traction=(0.0, 0.1))
    assert max(found[:-1]) <= found.any <= sum(found[:-1])


def test_volumes_grow_when_limits_fall_and_end_with_the_box():
    contact = contact_of_rollers(CURVATURES, 0.0, MODULUS, 100.0)
    sizes = [dangerous_volumes(contact, 0.3, (limit, limit), (12, 12, 10)).any for limit in (3e9, 1e9, 3e8, 1e8, 1e-3)]
    assert sizes[0] == 0.0
    assert sizes == sorted(sizes)
    assert sizes[-1] == pytest.approx(box_volume(contact), rel=1e-12)


@pytest.mark.parametrize(("limits", "traction", "error"), [
    ((2.6e8, 1.5e8), (0.0, 0.0), 0.002), ((2.6e8, 1.5e8), (0.0, 0.3), 0.005), ((1.5e9, 6e8), (0.0, 0.3), 0.03),
])  # fmt: skip
def test_a_dangerous_layer_at_the_surface_is_seen(limits, traction, error):
    """Traction takes the largest stress to the surface; beside cells counted one by one, 80 x 80 x 200."""
    contact = contact_of_rollers(CURVATURES, 0.0, MODULUS, 100.0)
    fine = dangerous_volumes(contact, 0.3, limits, (80, 80, 200), None, traction, COUNTED)
    found = dangerous_volumes(contact, 0.3, limits, (32, 40, 16), None, traction, INTERPOLATED)
    assert found.any == pytest.approx(fine.any, rel=error)


@pytest.mark.parametrize("profile", [0.1, 0.5, 2.0])
def test_a_slender_ellipse_keeps_its_volume(profile):
    """The stress lives within the smaller axis; beside counted cells that are even over what is dangerous: b/a 0.13 to 0.02."""
    contact = contact_of_rollers(CURVATURES._replace(roller_axial=1.0 / profile), 0.0, MODULUS, 100.0)
    fine = dangerous_volumes(contact, 0.3, (2.6e8, 1.5e8), (32, 40, 600), kind=COUNTED)
    found = dangerous_volumes(contact, 0.3, (2.6e8, 1.5e8), (32, 40, 16), kind=INTERPOLATED)
    assert found.any == pytest.approx(fine.any, rel=0.03)
    assert found.zz == pytest.approx(fine.zz, rel=0.03)


@pytest.mark.parametrize(("limits", "leaves"), [((2.6e8, 1.5e8), False), ((1e8, 3e7), True), ((1e12, 1e12), False)])
def test_a_volume_that_leaves_its_box_is_reported(limits, leaves):
    """Beside a box that is three times as large each way."""
    contact = contact_of_rollers(CURVATURES, 0.0, MODULUS, 100.0)
    wide = numpy.linspace(-6.0, 6.0, 61)
    x, y, z = numpy.meshgrid(contact.along_x * wide, contact.along_y * wide, 9.0 * contact.along_x * wide[31:] / 6.0)
    points = numpy.ascontiguousarray(numpy.stack([x.ravel(), y.ravel(), z.ravel()], axis=1))
    a, b = contact.along_x, contact.along_y
    outside = (abs(points[:, 0]) > 2.0 * a) | (abs(points[:, 1]) > 2.0 * b) | (points[:, 2] > 3.0 * a)
    over = abs(stresses(contact, None, (0.0, 0.0), points[outside])) > numpy.repeat(limits, 3)
    assert bool(over.any()) is leaves
    assert leaves_box(contact, 0.3, limits) is leaves


def test_they_scale_with_the_contact():
    """Same pressure, twice the size: eight times the volume."""
    double = RollingContact(2.0, 2.0, 0.0, 1.0, 1.0, 1.0)
    one, two = (dangerous_volumes(contact, 0.3, (0.3, 0.15), (16, 16, 12)) for contact in (CIRCLE, double))
    assert numpy.array(two) == pytest.approx(8.0 * numpy.array(one), rel=1e-9)


def test_no_contact_and_impossible_limits():
    free = RollingContact(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    assert dangerous_volumes(free, 0.3, (1.0, 1.0)) == (0.0,) * 7
    with pytest.raises(ValueError, match="above 0 is needed"):
        dangerous_volumes(CIRCLE, 0.3, (0.0, 1.0))
    with pytest.raises(ValueError, match="at least 2"):
        dangerous_volumes(CIRCLE, 0.3, (1.0, 1.0), (1, 2, 2))
