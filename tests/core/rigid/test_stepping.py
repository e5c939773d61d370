"""Rigid bodies at a fixed step: first order against closed forms, restitution that the gap does not take away."""

import math

import numpy
import pytest
from scipy.spatial.transform import Rotation

from contact_sim_pkg.core.rigid.body import box, placed, regular_block, slope, sphere
from contact_sim_pkg.core.rigid.results import SOLVED, SPIN_TOO_FAST
from contact_sim_pkg.core.rigid.stepping import SteppedBody


def slid(step):
    block = regular_block(0.1, 1.0, 0.3, 0.0)
    motion = placed(block, [0.0, 0.05], [2.0, 0.0, 0.0])
    assert SteppedBody(block, slope(2), motion, step).advance(round(1.0 / step)) == SOLVED
    return motion.position[0] - 2.0**2 / (2.0 * 0.3 * 9.81)


def test_the_error_of_the_sliding_distance_is_of_first_order():
    coarse, fine = slid(1e-3), slid(2.5e-4)
    assert abs(coarse) == pytest.approx(0.5 * 2.0 * 1e-3, rel=0.05)
    assert coarse / fine == pytest.approx(4.0, rel=0.1)


@pytest.mark.parametrize("step", [2e-3, 1e-3, 3e-4])
def test_a_drop_comes_back_with_the_restitution_that_was_asked_for(step):
    ball = sphere(0.05, 1.0, 0.3, 0.7)
    motion = placed(ball, [0.0, 0.0, 0.25], numpy.zeros(6))
    body = SteppedBody(ball, slope(3), motion, step)
    before = 0.0
    while body.impacts == 0:
        before = motion.velocity[2]
        assert body.advance(1) == SOLVED
    assert motion.velocity[2] == pytest.approx(0.7 * (9.81 * step - before), rel=1e-12)


def test_a_block_at_rest_on_a_slope_stays():
    angle = math.radians(15.0)
    block = regular_block(0.1, 1.0, 0.3, 0.3)
    motion = placed(block, [-0.05 * math.sin(angle), 0.05 * math.cos(angle)], numpy.zeros(3), angle=angle)
    start = motion.position.copy()
    assert SteppedBody(block, slope(2, angle), motion, 1e-3).advance(1000) == SOLVED
    assert numpy.abs(motion.position - start).max() <= 1e-15


def test_a_step_in_which_the_body_turns_by_more_than_a_radian_is_refused():
    block = regular_block(0.1, 1.0, 0.3, 0.3)
    motion = placed(block, [0.0, 1.0], [0.0, 0.0, 2000.0])
    assert SteppedBody(block, slope(2), motion, 1e-3).advance(1) == SPIN_TOO_FAST


@pytest.mark.parametrize("step", [1e-3, 2e-4])
def test_a_tumbling_box_comes_to_rest_on_four_corners(step):
    """On an edge and on a face the contacts contradict each other: a step cannot close unlike gaps of four corners that stick.

    A tilt by ε closed in a step leaves a slip of ε times its own speed, here some 1e-9 m/s: that of the nearest motion is taken.
    """
    body = box((0.2, 0.3, 0.1), 2.0, 0.4, 0.5)
    turned = Rotation.from_rotvec([0.3, -0.2, 0.7]).as_matrix()
    motion = placed(body, [0.0, 0.0, 0.5], [1.0, 0.0, 0.0, 3.0, 5.0, 0.3], rotation=turned)
    stepped = SteppedBody(body, slope(3), motion, step)
    energy = math.inf
    for _ in range(30):
        assert stepped.advance(round(0.1 / step)) == SOLVED
        assert stepped.residual <= 1e-7
        v, spin = motion.velocity[:3], motion.rotation.T @ motion.velocity[3:]
        now = float(v @ v + 0.5 * body.inertia @ spin**2 + 2.0 * 9.81 * motion.position[2])
        assert now <= energy * (1.0 + 1e-9)
        energy = now
    assert numpy.abs(motion.velocity).max() <= 1e-12
    assert stepped.residual <= 1e-12
    assert stepped.impulse[::3].sum() == pytest.approx(0.1 * 2.0 * 9.81, rel=1e-9)
    assert sorted(stepped.impulse[::3] > 0.0) == [False] * 4 + [True] * 4


@pytest.mark.parametrize("seed", [3, 8, 18, 30])
def test_a_box_with_friction_of_one_and_more_tumbles_on_the_true_cone_to_the_end(seed):
    """Edges whose ends drift apart by rounding squeeze themselves up to the cone: every step has a solution on a plane."""
    generator = numpy.random.default_rng(seed)
    friction, sides = float(generator.choice([1.0, 2.0, 5.0])), generator.uniform(0.05, 0.4, 3)
    body = box(tuple(sides), 1.0, friction, float(generator.choice([0.0, 0.5])))
    velocity = [*generator.normal(size=2), 0.0, *(5.0 * generator.normal(size=3))]
    motion = placed(body, [0.0, 0.0, 0.5], velocity, rotation=Rotation.random(random_state=seed).as_matrix())
    stepped = SteppedBody(body, slope(3), motion, 1e-3)
    energy = math.inf
    for _ in range(14):
        assert stepped.advance(50) == SOLVED
        assert stepped.residual <= 1e-7
        v, spin = motion.velocity[:3], motion.rotation.T @ motion.velocity[3:]
        now = float(v @ v + body.inertia @ spin**2 + 2.0 * 9.81 * motion.position[2])
        assert now <= energy * (1.0 + 1e-3), "a fixed step keeps energy to first order"
        energy = now


@pytest.mark.parametrize("restitution", [0.3, 0.8, 0.95])
@pytest.mark.parametrize("step", [2e-3, 1e-3, 3e-4])
def test_a_ball_that_bounces_comes_to_rest(step, restitution):
    """A step ends on the ground before the ball leaves it again: a bounce above it would give height, in small ones without end."""
    ball = sphere(0.05, 1.0, 0.3, restitution)
    motion = placed(ball, [0.0, 0.0, 0.15], numpy.zeros(6))
    fall = math.sqrt(2.0 * 0.1 / 9.81)
    rest = fall * (1.0 + restitution) / (1.0 - restitution)
    body = SteppedBody(ball, slope(3), motion, step)
    assert body.advance(math.ceil(1.2 * rest / step)) == SOLVED
    assert motion.velocity[2] == 0.0
    assert motion.position[2] == pytest.approx(0.05, abs=1e-9)


@pytest.mark.parametrize("step", [2e-3, 1e-3, 3e-4])
def test_a_ball_that_bounces_without_loss_never_rises_above_its_start(step):
    ball = sphere(0.05, 1.0, 0.3, 1.0)
    motion = placed(ball, [0.0, 0.0, 0.15], numpy.zeros(6))
    body = SteppedBody(ball, slope(3), motion, step)
    highest = 0.0
    for _ in range(round(3.0 / step)):
        assert body.advance(1) == SOLVED
        highest = max(highest, float(motion.position[2]))
    assert highest <= 0.15


@pytest.mark.parametrize("step", [1e-3, 1e-4])
def test_a_box_that_tumbles_down_a_slope_comes_to_rest(step):
    """Friction of 0.6 holds it on 0.2 rad; four corners that stick ask a step for what no motion of the box gives."""
    body = box((0.2, 0.3, 0.1), 1.0, 0.6, 0.5)
    turned = Rotation.from_rotvec([0.3, -0.2, 0.7]).as_matrix()
    motion = placed(body, [0.0, 0.0, 0.5], [0.5, 0.0, 0.0, 3.0, 5.0, 0.3], rotation=turned)
    stepped = SteppedBody(body, slope(3, 0.2), motion, step)
    assert stepped.advance(round(2.0 / step)) == SOLVED
    assert numpy.abs(motion.velocity).max() <= 1e-12
