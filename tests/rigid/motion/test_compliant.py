"""A rigid body on compliant contact: it tends to the rigid laws as the contact gets stiffer, and
never gains energy.
"""

import math

import mpmath
import numpy
import pytest

from contact_sim_pkg.compiled.results import DONE, NOT_FINITE
from contact_sim_pkg.laws.parameters import NormalElastic
from contact_sim_pkg.rigid.bodies.body import box, height_field, placed, regular_block, slope, sphere
from contact_sim_pkg.rigid.motion.compliant import (
    CompliantMotion,
    compliant_contact,
    quaternion_of,
    resting_swing,
    sentence_of,
)
from contact_sim_pkg.rigid.motion.located import LocatedBody

GRAVITY, RADIUS, SIDE, TICK = 9.81, 0.05, 0.1, 1e-3


def moved(body, ground, motion, stiffness, exponent=1.0, tolerance=1e-6, tangential=None):
    law = compliant_contact(body, NormalElastic(stiffness, exponent), tangential or stiffness)
    return CompliantMotion(body, ground, motion, law, tolerance)


def run(body, duration, tick=TICK):
    for _ in range(round(duration / tick)):
        assert body.advance(tick) == DONE
    return body.motion


def ball(restitution, friction=0.3, height=1.0, velocity=(0.0, 0.0, 0.0), spin=(0.0, 0.0, 0.0)):
    body = sphere(RADIUS, 1.0, friction, restitution)
    return body, placed(body, numpy.array([0.0, 0.0, RADIUS + height]), numpy.array([*velocity, *spin]))


def energy(body):
    v, b, R = body.motion.velocity, body.body, body.motion.rotation
    spin = v[b.width :] if b.width == 2 else R.T @ v[3:]
    kinetic = 0.5 * b.mass * v[: b.width] @ v[: b.width] + 0.5 * b.inertia @ spin**2
    return kinetic + b.mass * GRAVITY * body.motion.position[-1] + body.stored


def tops(body, count):
    """Heights of the first bounces."""
    found, last = [], 0.0
    while len(found) < count:
        assert body.advance(TICK) == DONE
        z, v = body.motion.position[2] - RADIUS, body.motion.velocity[2]
        if last > 0.0 >= v:
            found.append(z + 0.5 * v * v / GRAVITY)
        last = v
    return numpy.array(found)


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0])
def test_a_body_at_rest_swings_with_the_slope_of_its_force_law(exponent):
    depth, frequency = resting_swing(sphere(RADIUS, 2.0, 0.3, 0.5), NormalElastic(1e6, exponent))
    assert 1e6 * depth**exponent == pytest.approx(2.0 * GRAVITY, rel=1e-12)
    slope = float(mpmath.diff(lambda x: 1e6 * x**exponent, depth))
    assert frequency == pytest.approx(math.sqrt(slope / 2.0), rel=1e-9)


@pytest.mark.parametrize(
    ("restitution", "exponent", "stiffnesses"),
    [(0.8, 1.0, (1e6, 1e8)), (0.8, 1.5, (1e9, 1e11)), (0.3, 1.0, (1e8, 1e10))],
)
def test_bounces_are_as_high_as_the_restitution_requires_the_better_the_stiffer(restitution, exponent, stiffnesses):
    expected = restitution ** (2.0 * numpy.arange(1, 4))
    errors = []
    for stiffness in stiffnesses:
        body = moved(*_on_flat(ball(restitution)), stiffness, exponent)
        errors.append(float(numpy.abs(tops(body, 3) / expected - 1.0).max()))
    assert errors[1] < 3e-3
    assert errors[1] < 0.2 * errors[0]


def _on_flat(pair):
    body, motion = pair
    return body, slope(body.width), motion


@pytest.mark.parametrize("speed", [0.5, 2.0, 8.0])
def test_the_ratio_of_speeds_is_the_requested_one_at_any_speed_and_mass(speed):
    body, motion = ball(0.6, height=1e-3, velocity=(0.0, 0.0, -speed))
    body = body._replace(mass=3.7, load=3.7 * body.load)
    system = moved(body, slope(3), motion, 1e11)
    run(system, 0.01)
    landed = math.sqrt(speed**2 + 2.0 * GRAVITY * 1e-3)
    flown = 0.01 - (landed - speed) / GRAVITY
    assert motion.velocity[2] + GRAVITY * flown == pytest.approx(0.6 * landed, rel=5e-4)


def test_a_ball_that_slides_through_its_impact_takes_the_impulse_of_coulombs_law():
    body, motion = ball(0.5, friction=0.1, height=1e-3, velocity=(3.0, -4.0, -2.0))
    system = moved(body, slope(3), motion, 1e9)
    run(system, 0.005)
    fallen = math.sqrt(4.0 + 2.0 * GRAVITY * 1e-3)
    lost = 0.1 * 1.5 * fallen
    assert motion.velocity[:2] == pytest.approx([3.0 - 0.6 * lost, -4.0 + 0.8 * lost], rel=1e-3)
    spin = numpy.cross([0.0, 0.0, -RADIUS], [-0.6 * lost, 0.8 * lost, 0.0]) / (0.4 * RADIUS**2)
    assert motion.velocity[3:5] == pytest.approx(spin[:2], rel=2e-3)


def test_the_stopping_distance_tends_to_that_of_coulombs_law_as_the_stiffness_grows():
    distance, errors = 4.0 / (2.0 * 0.3 * GRAVITY), []
    for stiffness in (1e5, 1e6, 1e7):
        block = regular_block(SIDE, 1.0, 0.3, 0.0)
        motion = placed(block, numpy.array([0.0, 0.5 * SIDE]), numpy.array([2.0, 0.0, 0.0]))
        run(moved(block, slope(2), motion, stiffness), 1.0)
        errors.append(abs(float(motion.position[0]) / distance - 1.0))
    assert errors[2] < 1e-6
    assert errors[1] < 0.15 * errors[0]
    assert errors[2] < 0.15 * errors[1]


def test_a_block_sticks_on_a_slope_below_its_friction_angle_and_does_not_creep():
    angle = math.radians(15.0)
    normal = numpy.array([-math.sin(angle), math.cos(angle)])
    block = regular_block(SIDE, 1.0, 0.3, 0.3)
    motion = placed(block, 0.5 * SIDE * normal, numpy.zeros(3), angle=angle)
    system = moved(block, slope(2, angle), motion, 1e6)
    run(system, 1.0)
    settled = motion.position.copy()
    assert numpy.abs(settled - 0.5 * SIDE * normal).max() < 2e-5
    run(system, 2.0)
    assert numpy.abs(motion.position - settled).max() < 1e-12
    assert system.sticks().tolist() == (system.rig.gap < 0.0).tolist()
    assert sum(system.sticks()) == 2


def test_above_its_friction_angle_it_slides_with_the_constant_acceleration():
    angle = math.radians(25.0)
    normal, along = numpy.array([-math.sin(angle), math.cos(angle)]), numpy.array([math.cos(angle), math.sin(angle)])
    block = regular_block(SIDE, 1.0, 0.3, 0.0)
    motion = placed(block, 0.5 * SIDE * normal, numpy.zeros(3), angle=angle)
    run(moved(block, slope(2, angle), motion, 1e7), 0.5)
    acceleration = GRAVITY * (math.sin(angle) - 0.3 * math.cos(angle))
    assert motion.velocity[:2] @ along == pytest.approx(-acceleration * 0.5, rel=1e-3)


def _fall():
    block = regular_block(SIDE, 1.0, 0.3, 0.3)
    return block, slope(2), placed(block, numpy.array([0.0, 0.26884]), numpy.zeros(3), angle=0.2)


def _tumble():
    body = box((0.2, 0.3, 0.1), 2.0, 0.4, 0.5)
    motion = placed(body, numpy.array([0.0, 0.0, 0.4]), numpy.array([1.0, 0.3, 0.0, 3.0, 5.0, 0.3]))
    return body, slope(3), motion


def _bowl():
    body, motion = ball(0.7, height=0.1, velocity=(0.5, 0.0, 0.0))
    heights = 0.02 * (numpy.arange(-20, 21) / 4.0) ** 2
    return body, height_field(3, heights, -1.0, 0.05), motion


@pytest.mark.parametrize("case", [_fall, _tumble])
def test_energy_never_grows_and_what_is_lost_is_accounted_for(case):
    system = moved(*case(), 1e6, tolerance=1e-7)
    start = last = energy(system)
    for _ in range(1500):
        assert system.advance(TICK) == DONE
        now = energy(system)
        assert now <= last + 1e-9 * start
        last = now
        assert now + system.dissipated == pytest.approx(start, abs=1e-6 * start)
    assert last < 0.5 * start


def test_a_ball_comes_to_rest_in_a_bowl_of_heights():
    system = moved(*_bowl(), 1e6, tolerance=1e-6)
    start = energy(system)
    run(system, 1.0, tick=0.01)
    assert energy(system) < start


def test_without_loss_and_friction_the_energy_stays():
    body, motion = ball(1.0, friction=0.0)
    system = moved(body, slope(3), motion, 1e6, tolerance=1e-8)
    start = energy(system)
    run(system, 5.0, tick=0.01)
    assert energy(system) == pytest.approx(start, rel=1e-8)


def test_in_the_air_it_flies_as_the_rigid_body_does():
    """Against the event scheme, whose free rotation is another method (composed implicit
    midpoint).
    """
    body, ground, motion = _tumble()
    motion.position[2] = 10.0
    rigid = LocatedBody(body, ground, placed(body, motion.position, motion.velocity))
    system = moved(body, ground, motion, 1e6, tolerance=1e-7)
    run(system, 0.5)
    assert rigid.advance(0.5) == 0
    for mine, twin in zip(motion, rigid.motion, strict=True):
        assert mine == pytest.approx(twin, abs=1e-8)


def test_the_impulses_of_a_body_at_rest_carry_its_weight():
    body = box((0.2, 0.3, 0.1), 2.0, 0.4, 0.0)
    motion = placed(body, numpy.array([0.0, 0.0, 0.05]), numpy.zeros(6))
    system = moved(body, slope(3), motion, 1e6)
    run(system, 0.5)
    assert system.impulse[::3].sum() == pytest.approx(2.0 * GRAVITY * TICK, rel=1e-6)
    assert sorted(system.impulse[::3] > 0.0) == [False] * 4 + [True] * 4


def test_a_rotation_and_its_quaternion_turn_alike():
    random = numpy.random.default_rng(5)
    for _ in range(50):
        w, x, y, z = quaternion = random.normal(size=4) / 1.0
        quaternion /= numpy.linalg.norm(quaternion)
        w, x, y, z = quaternion
        cross = numpy.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        found = quaternion_of(numpy.eye(3) + 2.0 * w * cross + 2.0 * cross @ cross)
        assert abs(found @ quaternion) == pytest.approx(1.0, abs=1e-14)


@pytest.mark.fault("D1")
def test_a_state_that_is_not_finite_is_reported():
    body, motion = ball(0.5, velocity=(0.0, 0.0, 0.0))
    system = moved(body, slope(3), motion, 1e6)
    system.state[9] = math.inf
    assert system.advance(TICK) == NOT_FINITE
    assert "not finite" in sentence_of(NOT_FINITE)
