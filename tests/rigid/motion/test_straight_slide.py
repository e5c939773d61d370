"""A body at rest or sliding straight on: against closed forms, and against a call a sample, each
surveyed and solved.
"""

import math

import numpy
import pytest
from scipy.spatial.transform import Rotation

from contact_sim_pkg.rigid.bodies.body import box, height_field, placed, regular_block, slope, sphere
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.results import SOLVED

GRAVITY, TICK = 9.81, 1e-3


def cube(velocity, load, friction=0.3, sides=(0.2, 0.15, 0.1), ground=None):
    body = box(sides, 2.0, friction, 0.0)._replace(load=numpy.array([*load, 0.0, 0.0, 0.0]))
    motion = placed(body, [0.0, 0.0, 0.5 * sides[2]], [*velocity, 0.0, 0.0, 0.0])
    return LocatedBody(body, ground or slope(3), motion)


def block(speed, load, friction=0.3):
    body = regular_block(0.1, 2.0, friction, 0.0)._replace(load=numpy.array([*load, 0.0]))
    return LocatedBody(body, slope(2), placed(body, [0.0, 0.05], [speed, 0.0, 0.0]))


def leaning(angle, across=False):
    normal, along = -2.0 * GRAVITY * math.cos(angle), -2.0 * GRAVITY * math.sin(angle)
    return (0.0, along, normal) if across else (along, 0.0, normal)


CASES = {
    "slides along an axis": lambda: cube((2.0, 0.0, 0.0), leaning(0.0)),
    "slides aslant": lambda: cube((1.0, -1.7, 0.0), leaning(0.0)),
    "slides across a slope": lambda: cube((2.0, 0.0, 0.0), leaning(0.25, across=True)),
    "slides down a slope": lambda: cube((-0.1, 0.0, 0.0), leaning(0.5)),
    "rests": lambda: cube((0.0, 0.0, 0.0), leaning(0.0)),
    "sticks on a slope": lambda: cube((0.0, 0.0, 0.0), leaning(0.25)),
    "slides in the plane": lambda: block(2.0, (0.0, -2.0 * GRAVITY)),
    "slides down in the plane": lambda: block(-0.1, (leaning(0.5)[0], leaning(0.5)[2])),
    "sticks in the plane": lambda: block(0.0, (leaning(0.25)[0], leaning(0.25)[2])),
    "tips over its front corners": lambda: cube((3.0, 0.0, 0.0), leaning(0.0), 0.9, (0.1, 0.1, 0.2)),
}


@pytest.mark.parametrize("case", CASES)
def test_many_samples_in_one_call_are_those_of_a_call_a_sample(case):
    at_once, one_by_one = CASES[case](), CASES[case]()
    status, track = at_once.advance_over(TICK, 40)
    assert status == SOLVED
    for k in range(40):
        status, sample = one_by_one.advance_over(TICK, 1)
        assert status == SOLVED
        assert track.position[k] == pytest.approx(sample.position[0], abs=1e-14)
        assert track.velocity[k] == pytest.approx(sample.velocity[0], abs=1e-12)
        assert track.impulse[k] == pytest.approx(sample.impulse[0], abs=1e-11 * 2.0 * GRAVITY * TICK)
        assert numpy.array_equal(track.sticks[k], sample.sticks[0])
    assert at_once.dissipated == pytest.approx(one_by_one.dissipated, abs=1e-12)


def test_a_box_that_slides_to_a_stop_comes_as_far_as_coulomb_friction_allows_and_loses_its_energy():
    body = cube((1.2, 1.6, 0.0), leaning(0.0))
    assert body.advance_over(TICK, 1000)[0] == SOLVED
    far = 2.0**2 / (2.0 * 0.3 * GRAVITY)
    assert body.motion.position == pytest.approx([0.6 * far, 0.8 * far, 0.05], rel=1e-9)
    assert not body.motion.velocity.any()
    assert body.dissipated == pytest.approx(0.5 * 2.0 * 2.0**2, rel=1e-9)


@pytest.mark.parametrize("size", [1e-3, 0.1, 1.0, 10.0])
@pytest.mark.parametrize("angle", [-0.3, -0.2, -0.107, -0.05, 0.0, 0.05, 0.13, 0.2, 0.28])
def test_a_box_that_slides_straight_on_a_slope_stops_where_coulomb_friction_requires_at_any_accuracy(angle, size):
    """Up and down, turned about the normal by any angle: v^2/(2 a), a = g (mu cos +- sin). Rounded
    on a slope.
    """
    normal = numpy.array([-math.sin(angle), 0.0, math.cos(angle)])
    along = numpy.array([math.cos(angle), 0.0, math.sin(angle)])
    body, speed = box((size, 0.8 * size, 0.6 * size), size**3, 0.4, 0.3), 3.0 * math.sqrt(GRAVITY * size)
    for azimuth in (0.0, 0.7, math.pi / 2.0, 2.0, -1.1):
        turned = (Rotation.from_euler("y", -angle) * Rotation.from_euler("z", azimuth)).as_matrix()
        for way in (1.0, -1.0):
            slowing = GRAVITY * (0.4 * math.cos(angle) + way * math.sin(angle))
            far, lasts = speed**2 / (2.0 * slowing), speed / slowing
            start = 0.3 * size * normal
            motion = placed(body, start, [*(way * speed * along), 0.0, 0.0, 0.0], rotation=turned)
            status, _track = LocatedBody(body, slope(3, angle), motion, tolerance=1e-3).advance_over(0.06 * lasts, 20)
            assert status == SOLVED
            assert motion.position == pytest.approx(start + way * far * along, abs=1e-12 * far)
            assert not motion.velocity.any()


def test_a_sliding_box_presses_where_the_moment_of_its_friction_asks_it_to():
    """Front and back corners carry ``W/4 (1 +- 2 mu h/a)``, a the length along the slide, h the
    height of the centre.
    """
    body = cube((2.0, 0.0, 0.0), leaning(0.0))
    track = body.advance_over(TICK, 20)[1]
    loads = track.impulse[-1, ::3] / TICK
    front = body.body.points[:, 0] > 0.0
    active = loads > 0.0
    quarter, shift = 2.0 * GRAVITY / 4.0, 2.0 * 0.3 * 0.05 / 0.2
    assert loads[active & front] == pytest.approx([quarter * (1.0 + shift)] * 2, rel=1e-12)
    assert loads[active & ~front] == pytest.approx([quarter * (1.0 - shift)] * 2, rel=1e-12)
    assert track.impulse[-1, 1::3].sum() == pytest.approx(-0.3 * 2.0 * GRAVITY * TICK, rel=1e-12)


@pytest.mark.parametrize("ground", [slope(3), height_field(3, numpy.zeros(9), -1.0, 0.25)], ids=["plane", "heights"])
def test_a_box_at_rest_has_a_quarter_of_its_weight_on_each_corner_in_every_sample(ground):
    body = cube((0.0, 0.0, 0.0), leaning(0.0), ground=ground)
    status, track = body.advance_over(TICK, 30)
    assert status == SOLVED
    loads = track.impulse[:, ::3] / TICK
    assert (loads > 0.0).sum(axis=1).tolist() == [4] * 30
    assert loads[loads > 0.0] == pytest.approx(2.0 * GRAVITY / 4.0, rel=1e-12)
    assert numpy.array_equal(track.position, numpy.tile([0.0, 0.0, 0.05], (30, 1)))
    assert body.solves < 10


def test_a_load_that_changes_between_two_calls_is_felt_by_a_body_at_rest():
    ball = sphere(0.05, 1.0, 0.3, 0.0)
    located = LocatedBody(ball, slope(3), placed(ball, [0.0, 0.0, 0.05], numpy.zeros(6)))
    for factor in (1.0, 3.0, 0.5):
        located.body = ball._replace(load=factor * ball.load)
        track = located.advance_over(TICK, 5)[1]
        assert track.impulse[:, 0] == pytest.approx([factor * GRAVITY * TICK] * 5, rel=1e-12)
    located.body = ball._replace(load=-ball.load)
    located.advance_over(TICK, 5)
    assert located.motion.position[2] == pytest.approx(0.05 + 0.5 * GRAVITY * (5 * TICK) ** 2, rel=1e-12)
