"""Corners that land while another is active: found where they touch, whatever the interval, so that
no energy comes of it.
"""

import math

import numpy
import pytest

from contact_sim_pkg.rigid.bodies.body import RigidBody, least_gap, placed, slope
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.problem import PLANE
from contact_sim_pkg.rigid.results import SOLVED, SPIN_TOO_FAST

GRAVITY = 9.81


def wheel(corners, radius, angle, spin):
    """A regular polygon on one corner of two, about which it turns down a slope (positive spin
    turns x towards z).
    """
    around = 2.0 * math.pi * numpy.arange(corners) / corners - 0.5 * math.pi
    points = radius * numpy.column_stack([numpy.cos(around), numpy.sin(around)])
    inertia = radius**2 / 6.0 * (2.0 + math.cos(2.0 * math.pi / corners))
    body = RigidBody(PLANE, 1.0, numpy.array([inertia]), points, 0.0, 5.0, 0.0, numpy.array([0.0, -GRAVITY, 0.0]))
    turned = angle + math.pi / corners
    rotation = numpy.array([[math.cos(turned), -math.sin(turned)], [math.sin(turned), math.cos(turned)]])
    along, up = numpy.array([math.cos(angle), math.sin(angle)]), numpy.array([-math.sin(angle), math.cos(angle)])
    placed_points = points @ rotation.T
    lowest = numpy.argsort(placed_points @ up)[:2]
    pivot = placed_points[lowest[numpy.argmin(placed_points[lowest] @ along)]]
    velocity = [spin * pivot[1], -spin * pivot[0], spin]
    return LocatedBody(body, slope(PLANE, angle), placed(body, -pivot, velocity, turned))


@pytest.mark.parametrize("interval", [1e-3, 0.01, 0.02])
@pytest.mark.parametrize(
    ("corners", "radius", "angle", "spin"), [(8, 0.1, 0.05, 3.0), (4, 0.1, 0.5, 9.0), (6, 1.0, 0.2, 3.0)]
)
def test_a_wheel_of_corners_loses_the_energy_of_its_ledger_and_sinks_nowhere(corners, radius, angle, spin, interval):
    located = wheel(corners, radius, angle, spin)
    body, motion = located.body, located.motion

    def energy():
        return located.kinetic_energy() + GRAVITY * motion.position[1]

    start, impacts = energy(), 0
    for _ in range(round(1.0 / interval)):
        assert located.advance(interval) == SOLVED
        impacts += len(located.impacts)
        assert least_gap(body, located.ground, motion) >= -1e-10 * radius
        assert energy() + located.dissipated == pytest.approx(start, abs=1e-9 * start)
    assert impacts >= 1


def test_a_body_that_spins_without_bound_is_refused_and_not_run_for_ever():
    located = wheel(4, 0.1, 0.0, 1.0)
    located.body = located.body._replace(load=numpy.array([0.0, -GRAVITY, 1e12]))
    assert located.advance(0.1) == SPIN_TOO_FAST
