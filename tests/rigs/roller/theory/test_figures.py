"""The paper's figures 9 to 14: what its text says of them, under curves R11(t), R21(t) and F_N(t) that meet all of it."""

import math

import numpy
import pytest

from contact_sim_pkg.rigs.roller.theory.ellipse import contact_of_rollers
from contact_sim_pkg.rigs.roller.theory.parameters import Curvatures
from contact_sim_pkg.rigs.roller.theory.stress import bench_stresses
from contact_sim_pkg.rigs.roller.theory.volumes import dangerous_volumes

MODULUS = 210e9 / (1.0 - 0.3**2) / 2.0
LIMITS = (4e7, 1e7)


def radii(t):
    """R11 curves along y, R21 along x."""
    return 0.320 + 0.002 * t, 0.340 - (0.130 - 0.012 * t) * math.cos(math.pi * t / 2.0)


def contact(t):
    r11, r21 = radii(t)
    return contact_of_rollers(
        Curvatures(1.0 / r21, 0.0, 1.0 / r11, 0.0), 0.0, MODULUS, 72.0 - 15.0 * math.sin(math.pi * t / 4.0) ** 2
    )


@pytest.mark.parametrize(
    ("t", "a", "b", "area", "peak", "approach"),
    [
        (0.0, 5.682, 4.292, 0.766, 141.0, 9.43), (2.0, 5.779, 4.671, 0.848, 100.8, 7.11),
        (4.0, 5.568, 4.745, 0.830, 130.1, 9.09), (6.0, 5.443, 4.823, 0.825, 103.7, 7.22),
    ],
)  # fmt: skip
def test_the_contact_of_figure_10(t, a, b, area, peak, approach):
    """The sheet of the paper, to its last digit: 1e-4 m, 1e-6 m^2, 1e6 Pa, 1e-7 m."""
    found = contact(t)
    assert max(found[:2]) == pytest.approx(a * 1e-4, abs=0.6e-7)
    assert min(found[:2]) == pytest.approx(b * 1e-4, abs=0.6e-7)
    assert found.area == pytest.approx(area * 1e-6, abs=0.6e-9)
    assert found.peak_pressure == pytest.approx(peak * 1e6, abs=0.06e6)
    assert found.approach == pytest.approx(approach * 1e-7, abs=0.006e-7)


def test_the_radii_are_as_figure_9_has_them():
    assert [radii(t)[0] > radii(t)[1] for t in (0.0, 2.0, 4.0, 6.0)] == [True, False, True, False]


def test_the_relations_that_the_paper_states():
    """S(0) < S(4) and p0(0) > p0(4), printed as S(1), p0(1); at 2 and 6 the other way round."""
    at = {t: contact(t) for t in (0.0, 2.0, 4.0, 6.0)}
    assert at[0.0].area < at[4.0].area
    assert at[0.0].peak_pressure > at[4.0].peak_pressure
    assert at[6.0].area < at[2.0].area
    assert at[6.0].peak_pressure > at[2.0].peak_pressure


def test_the_ellipse_turns_its_long_axis_from_y_to_x_and_back():
    long_along_x = [contact(t).along_x > contact(t).along_y for t in (0.0, 2.0, 4.0, 6.0, 8.0)]
    assert long_along_x == [False, True, False, True, False]


def test_the_shear_of_figure_12():
    """max |xz| at t = 2 in the plane y = 0: 0.203 p0 = 2.05e7 Pa."""
    now = contact(2.0)
    x, z = numpy.meshgrid(numpy.linspace(0.0, 1.5, 151) * now.along_x, numpy.linspace(0.01, 1.0, 100) * now.along_x)
    points = numpy.stack([x.ravel(), numpy.zeros(x.size), z.ravel()], axis=1)
    out = numpy.empty((len(points), 6))
    bench_stresses(now, None, 0.0, 0.0, 0.3, points, out)
    largest = abs(out[:, 4]).max()
    assert largest == pytest.approx(2.05e7, abs=0.01e7)
    assert largest / now.peak_pressure == pytest.approx(0.203, abs=0.001)


def test_the_dangerous_volumes_follow_pressure():
    """A larger share of the box where p0 is larger: t = 0 before 4 before 6 before 2."""
    shares = {}
    for t in (0.0, 2.0, 4.0, 6.0):
        now = contact(t)
        a, b = max(now[:2]), min(now[:2])
        shares[t] = dangerous_volumes(now, 0.3, LIMITS, (24, 24, 16)).any / (48.0 * a * a * b)
    assert shares[0.0] > shares[4.0] > shares[6.0] > shares[2.0] > 0.0
