"""Moments on the roller: against integrals over the ellipse."""

import math

import pytest
from scipy.integrate import dblquad
from tests.rigs.roller.bench import BENDING, CURVATURES, MODULUS, ROLLER

from contact_sim_pkg.rigs.roller.theory.ellipse import contact_of_rollers
from contact_sim_pkg.rigs.roller.theory.moments import moments


def over_the_ellipse(contact, function):
    """Integral of function(x, y) over the ellipse, in the axes of the bench."""
    a, b, c, s = contact.along_x, contact.along_y, math.cos(contact.angle), math.sin(contact.angle)

    def polar(turn, r):
        u, v = a * r * math.cos(turn), b * r * math.sin(turn)
        return function(c * u - s * v, s * u + c * v, r) * a * b * r

    return dblquad(polar, 0.0, 1.0, 0.0, 2.0 * math.pi, epsabs=1e-13, epsrel=1e-9)[0]


@pytest.mark.parametrize("yaw", [0.0, 0.4, -1.1])
def test_the_moment_of_the_pressure_does_not_know_the_yaw(yaw):
    """M = F R sin(psi); and the pressure carries the load."""
    contact = contact_of_rollers(CURVATURES, yaw, MODULUS, 100.0)
    centre = ROLLER.radius * math.sin(0.05)

    def about_y(x, y, r):
        return (x + centre) * contact.peak_pressure * math.sqrt(1.0 - r * r)

    moment = moments(ROLLER, CURVATURES, None, MODULUS, 100.0, 0.05, yaw)
    assert moment.tilt == pytest.approx(over_the_ellipse(contact, about_y), rel=1e-9)
    assert moment.yaw == pytest.approx(0.01 * 100.0 * centre)


@pytest.mark.parametrize(("tilt", "yaw"), [(0.0, 0.0), (0.05, 0.3), (-0.1, -0.7)])
def test_the_moments_of_the_bent_shaft(tilt, yaw):
    """The traction -f0 sigma_xx along x, at the arm R cos(psi) for tilt and y for yaw (M_z = -y t_x)."""
    contact = contact_of_rollers(CURVATURES, yaw, MODULUS, 100.0)
    smooth = ROLLER._replace(rolling_friction=0.0)
    arm, centre = BENDING.contact_distance - BENDING.load_distance, ROLLER.radius * math.sin(tilt)
    scale = BENDING.friction * BENDING.load * (BENDING.radius - contact.approach) / BENDING.second_moment

    def traction(x):
        return -scale * (arm + centre + x)

    found = moments(smooth, CURVATURES, BENDING, MODULUS, 100.0, tilt, yaw)
    about_y = over_the_ellipse(contact, lambda x, y, r: traction(x)) * ROLLER.radius * math.cos(tilt)
    assert found.tilt - 100.0 * centre == pytest.approx(about_y, rel=1e-9)
    about_z = over_the_ellipse(contact, lambda x, y, r: -y * traction(x))
    assert found.yaw == pytest.approx(about_z, rel=1e-6, abs=1e-12)


def test_without_load_there_are_none():
    assert moments(ROLLER, CURVATURES, BENDING, MODULUS, 0.0, 0.1, 0.1) == (0.0, 0.0)
