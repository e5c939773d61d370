"""Bodies in space that slide across a slope: the slip turns, and with it the friction. Against own
equations and scipy's DOP853.
"""

import math

import numpy
import pytest
from scipy.integrate import solve_ivp

from contact_sim_pkg.rigid.bodies.body import RigidBody, placed, slope
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.problem import SPACE
from contact_sim_pkg.rigid.results import SOLVED

GRAVITY, ANGLE = 9.81, 0.3
UP = numpy.array([-math.sin(ANGLE), 0.0, math.cos(ANGLE)])  # normal of the slope
ALONG, ACROSS = numpy.array([math.cos(ANGLE), 0.0, math.sin(ANGLE)]), numpy.array([0.0, 1.0, 0.0])
PRESS, PULL = GRAVITY * math.cos(ANGLE), -GRAVITY * math.sin(ANGLE) * ALONG
TIGHT = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-14}


def body(points, inertia, radius, friction):
    load = numpy.array([0.0, 0.0, -GRAVITY, 0.0, 0.0, 0.0])
    return RigidBody(SPACE, 1.0, numpy.array(inertia), numpy.array(points), radius, friction, 0.0, load)


def after(located, duration, interval):
    status, _track = located.advance_over(interval, round(duration / interval))
    assert status == SOLVED
    return located.motion


@pytest.mark.parametrize("interval", [1e-3, 0.01, 0.1])
@pytest.mark.parametrize("friction", [0.2, 0.35])
def test_a_box_that_slides_across_a_slope_follows_its_curved_path_at_any_interval(friction, interval):
    """``v' = g_t - mu g_n v/|v|``: a point with friction, as the box on its face does not turn."""
    corners = 0.1 * numpy.array([[i, j, 0.1 * k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)])
    block = body(corners, [0.0034, 0.0034, 0.0067], 0.0, friction)
    axes = numpy.column_stack([ALONG, ACROSS, UP])
    start = 0.5 * ALONG + 1.0 * ACROSS
    motion = placed(block, 0.01 * UP, [*start, 0.0, 0.0, 0.0], rotation=axes)

    def rate(_time, y):
        return [*y[3:], *(PULL - friction * PRESS * y[3:] / numpy.linalg.norm(y[3:]))]

    expected = solve_ivp(rate, (0.0, 0.3), [*0.01 * UP, *start], **TIGHT).y[:, -1]
    found = after(LocatedBody(block, slope(SPACE, ANGLE), motion), 0.3, interval)
    assert found.position == pytest.approx(expected[:3], abs=1e-11)
    assert found.velocity == pytest.approx([*expected[3:], 0.0, 0.0, 0.0], abs=1e-10)


@pytest.mark.parametrize("interval", [1e-3, 0.01, 0.1])
def test_a_ball_that_slips_across_a_slope_turns_its_slip_and_comes_to_roll(interval):
    """``v' = g_t - mu g_n s``, ``w' = (r x f)/J``, s the direction of slip; it rolls from where
    slip is 0: v' = 5/7 g_t.
    """
    radius, friction, duration = 0.05, 0.3, 0.3
    ball = body([[0.0, 0.0, 0.0]], [0.4 * radius**2] * 3, radius, friction)
    velocity, spin = -0.5 * ALONG + 0.7 * ACROSS, 5.0 * ALONG - 20.0 * ACROSS

    def slip(y):
        return y[3:6] + numpy.cross(y[6:9], -radius * UP)

    def rate(_time, y):
        force = -friction * PRESS * slip(y) / numpy.linalg.norm(slip(y))
        return [*y[3:6], *(PULL + force), *(numpy.cross(-radius * UP, force) / (0.4 * radius**2))]

    def stops(_time, y):
        return numpy.linalg.norm(slip(y)) - 1e-9

    stops.terminal = True
    start = [*radius * UP, *velocity, *spin]
    slipping = solve_ivp(rate, (0.0, duration), start, events=[stops], max_step=1e-3, **TIGHT)
    assert 0.05 < slipping.t[-1] < 0.25
    rolling, left = slipping.y[:, -1], duration - slipping.t[-1]
    gain = 5.0 / 7.0 * PULL
    place = rolling[:3] + left * rolling[3:6] + 0.5 * left**2 * gain
    speed = rolling[3:6] + left * gain
    motion = placed(ball, radius * UP, [*velocity, *spin])
    found = after(LocatedBody(ball, slope(SPACE, ANGLE), motion), duration, interval)
    assert found.position == pytest.approx(place, abs=1e-9)
    assert found.velocity[:3] == pytest.approx(speed, abs=5e-9)
    assert found.velocity[3:] - (found.velocity[3:] @ UP) * UP == pytest.approx(
        numpy.cross(UP, speed) / radius, abs=1e-7
    )
