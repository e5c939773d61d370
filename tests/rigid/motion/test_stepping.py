"""Rigid bodies at a fixed step: first order against closed forms, restitution that the gap does not
take away.
"""

import math

import numpy
import pytest
from scipy.spatial.transform import Rotation

from contact_sim_pkg.rigid.body import box, placed, regular_block, slope, sphere
from contact_sim_pkg.rigid.motion.stepping import SteppedBody
from contact_sim_pkg.rigid.results import SOLVED, SPIN_TOO_FAST


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
def test_a_drop_comes_back_with_the_requested_restitution(step):
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
    """On an edge and on a face the contacts contradict each other: a step cannot close unlike gaps
    of four corners that stick.

    A tilt by ε closed in a step leaves a slip of ε times its own speed, here some 1e-9 m/s: that of
    the nearest motion is taken.
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
    """Edges whose ends drift from each other by rounding squeeze themselves up to the cone: every
    step has a solution on a plane.
    """
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


def flat(width, friction, restitution):
    if width == 2:
        return regular_block(0.1, 1.0, friction, restitution)
    return box((0.1, 0.1, 0.1), 1.0, friction, restitution)


def energies(body, height, step, time):
    """Energy over the one at the start, every 50 steps, of ``body`` dropped from ``height``, its
    centre of mass 0.05 m up.
    """
    motion = placed(body, [*[0.0] * (body.width - 1), height], numpy.zeros(len(body.load)))
    stepped, found = SteppedBody(body, slope(body.width), motion, step), []
    for _ in range(round(time / step / 50)):
        assert stepped.advance(50) == SOLVED
        assert numpy.abs(motion.rotation - numpy.eye(body.width)).max() <= 1e-9
        speed, above = float(motion.velocity[body.width - 1]), float(motion.position[-1]) - 0.05
        found.append((0.5 * speed**2 + 9.81 * above) / (9.81 * (height - 0.05)))
    return numpy.array(found)


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("width", [2, 3])
def test_a_box_dropped_flat_from_any_height_bounces_as_a_ball_and_does_not_tumble(width, friction, restitution):
    """At round heights and steps the gaps of its corners at the end of a step are 0 up to rounding,
    of either sign.

    Box and ball may meet the ground a step apart, which is a part 2 h v/z of the energy of the fall
    z, at each bounce.
    """
    body, ball = flat(width, friction, restitution), sphere(0.05, 1.0, friction, restitution)
    for height in numpy.round(numpy.arange(0.1, 1.3, 0.05), 2):
        speed, bounces = math.sqrt(2.0 * 9.81 * (height - 0.05)), 1.5 / math.sqrt(8.0 * (height - 0.05) / 9.81) + 1.0
        found, expected = energies(body, height, 1e-3, 1.5), energies(ball, height, 1e-3, 1.5)
        assert numpy.abs(found - expected).max() <= bounces * 2.0 * 1e-3 * speed / (height - 0.05)


@pytest.mark.parametrize("width", [2, 3])
@pytest.mark.parametrize(("step", "time"), [(1e-4, 1.0), (1e-5, 0.95)])
def test_at_finer_steps_too(width, step, time):
    found = energies(flat(width, 0.3, 1.0), 0.5, step, time)
    expected = energies(sphere(0.05, 1.0, 0.3, 1.0), 0.5, step, time)
    assert numpy.abs(found - expected).max() <= 3.0 * 2.0 * step * 3.0 / 0.45


def tilted(tilt, restitution, friction, deep, step, steps):
    """A block that falls: at the end of step ``steps``, which lands, its low corner would be
    ``deep`` m in the ground.
    """
    body = regular_block(0.1, 1.0, friction, restitution)
    fallen = 0.5 * 9.81 * step**2 * steps * (steps + 1)
    height = fallen + 0.05 * (math.cos(tilt) + math.sin(tilt)) - deep
    motion = placed(body, [0.0, height], numpy.zeros(3), angle=tilt)
    return SteppedBody(body, slope(2), motion, step), motion


@pytest.mark.parametrize("tilt", [1e-13, 1e-9, 1e-6])
@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_corners_farther_from_each_other_than_rounding_but_less_than_a_step_resolves_are_struck_at_once(
    tilt, restitution
):
    """One corner is in the ground at the end of the step and the other above it, 5e-5 of the way of
    the step at most.
    """
    step, steps = 1e-3, 200
    stepped, motion = tilted(tilt, restitution, 0.3, 0.05 * tilt, step, steps)
    assert stepped.advance(steps + 1) == SOLVED
    assert abs(motion.velocity[2]) <= 2.0 * tilt / step
    assert motion.velocity[1] == pytest.approx(restitution * 9.81 * step * steps, abs=2.0 * 9.81 * step)


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_a_corner_that_another_drives_into_the_ground_is_in_reach_too(friction, restitution):
    """The low corner stops 0.9 of its way v h early; that adds 0.2 of it to the way of the other (J
    = m s^2/6), 0.1 above.
    """
    step, steps = 1e-3, 200
    way = 9.81 * step**2 * steps
    stepped, motion = tilted(way / 0.1, restitution, friction, 0.9 * way, step, steps)
    assert stepped.advance(steps) == SOLVED
    corners = stepped.body.points @ motion.rotation.T + motion.position
    assert corners[:, 1].min() >= -1e-3 * way


@pytest.mark.parametrize("spin", [0.0, 1e-15, -1e-15])
@pytest.mark.parametrize("restitution", [0.5, 1.0])
def test_corners_that_tie_at_the_rest_speed_bounce_alike(spin, restitution):
    """Both approach at 2 g h, one a rounding faster and one slower: both bounce or none."""
    step = 1e-3
    body = regular_block(0.1, 1.0, 0.3, restitution)
    motion = placed(body, [0.0, 0.05], [0.0, -9.81 * step, spin])
    assert SteppedBody(body, slope(2), motion, step).advance(1) == SOLVED
    assert abs(motion.velocity[2]) <= 1e-12


@pytest.mark.parametrize("restitution", [0.3, 0.8, 0.95])
@pytest.mark.parametrize("step", [2e-3, 1e-3, 3e-4])
def test_a_ball_that_bounces_comes_to_rest(step, restitution):
    """A step ends on the ground before the ball leaves it again: a bounce above it would give
    height, in small ones without end.
    """
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
    """Friction of 0.6 holds it on 0.2 rad; four corners that stick require of a step what no motion
    of the box gives.
    """
    body = box((0.2, 0.3, 0.1), 1.0, 0.6, 0.5)
    turned = Rotation.from_rotvec([0.3, -0.2, 0.7]).as_matrix()
    motion = placed(body, [0.0, 0.0, 0.5], [0.5, 0.0, 0.0, 3.0, 5.0, 0.3], rotation=turned)
    stepped = SteppedBody(body, slope(3, 0.2), motion, step)
    assert stepped.advance(round(2.0 / step)) == SOLVED
    assert numpy.abs(motion.velocity).max() <= 1e-12
