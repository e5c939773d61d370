"""Bodies that a force carries exactly: nothing presses them down, so that speeds and times have no
scale of their own.
"""

import math

import numpy
import pytest
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from contact_sim_pkg.compiled.results import DONE
from contact_sim_pkg.laws.parameters import NormalElastic
from contact_sim_pkg.rigid.bodies.body import box, placed, regular_block, slope, sphere
from contact_sim_pkg.rigid.motion.compliant import CompliantMotion, compliant_contact
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.results import SOLVED

FRICTION, PUSH, SPEED = 0.3, 1.0, 0.1


def carried(body, *push):
    return body._replace(load=numpy.array([*push, *[0.0] * (len(body.load) - len(push))]))


@pytest.mark.parametrize("restitution", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("interval", [1.0, 0.01])
def test_a_block_that_is_pushed_along_lands_flat_and_slides_without_friction_or_leaves(restitution, interval):
    """1 kg, 0.05 m up, drifts down at 0.1 m/s and along under 1 N: the impact takes mu (1 + e) 0.1
    m/s of its speed along.
    """
    body = carried(regular_block(0.2, 1.0, FRICTION, restitution), PUSH, 0.0)
    motion = placed(body, [0.0, 0.15], [1.0, -SPEED, 0.0])
    located = LocatedBody(body, slope(2), motion)
    status, track = located.advance_over(interval, round(1.0 / interval))
    lost = FRICTION * (1.0 + restitution) * SPEED
    assert status == SOLVED
    assert motion.velocity == pytest.approx([2.0 - lost, restitution * SPEED, 0.0], abs=1e-12)
    assert motion.position == pytest.approx([1.5 - 0.5 * lost, 0.1 + 0.5 * restitution * SPEED], abs=1e-12)
    assert track.impulse[:, ::2].sum() == pytest.approx((1.0 + restitution) * SPEED, abs=1e-12)


@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_a_box_in_space_does_the_same_in_any_direction(restitution):
    body = carried(box((0.2, 0.3, 0.1), 1.0, FRICTION, restitution))
    heading = numpy.array([0.6, 0.8, 0.0])
    turned = Rotation.from_rotvec([0.0, 0.0, 0.4]).as_matrix()
    motion = placed(body, [0.0, 0.0, 0.1], [*(heading - [0.0, 0.0, SPEED]), 0.0, 0.0, 0.0], rotation=turned)
    assert LocatedBody(body, slope(3), motion).advance(1.0) == SOLVED
    lost = FRICTION * (1.0 + restitution) * SPEED
    end = (1.0 - lost) * heading + [0.0, 0.0, restitution * SPEED]
    assert motion.velocity == pytest.approx([*end, 0.0, 0.0, 0.0], abs=1e-12)
    assert motion.position == pytest.approx((1.0 - 0.5 * lost) * heading + [0.0, 0.0, 0.05 + 0.5 * end[2]], abs=1e-12)


@pytest.mark.parametrize(("coefficient", "exponent"), [(1e6, 1.0), (1e8, 1.5), (1e8, 2.5)])
@pytest.mark.parametrize("restitution", [0.06, 0.3])
def test_on_springs_a_ball_slower_than_the_reported_speed_rebounds_by_its_loss(coefficient, exponent, restitution):
    """In a free impact ``d (1 + e) = ln((1 + d)/(1 - d e))``, d = lambda v; below n d a/(2 w)
    lambda is kept, a = 0.1 m/s^2.
    """

    def excess(loss, e):
        return loss * (1.0 + e) - math.log1p(loss) + math.log1p(-loss * e)

    mass, load_acceleration = 2.0, 0.1
    loss = brentq(excess, 1e-3, (1.0 - 1e-14) / restitution, args=(restitution,), xtol=1e-15)
    depth = (mass * load_acceleration / coefficient) ** (1.0 / exponent)
    slowest = exponent * loss * load_acceleration / (2.0 * math.sqrt(exponent * load_acceleration / depth))
    for part, tolerance in ((2.0, 1e-5), (0.5, 1e-5), (0.2, 1e-5)):
        own = loss * min(1.0, part)
        expected = brentq(lambda e, own=own: excess(own, e), 1e-9, min(1.0, 1.0 / own) * (1.0 - 1e-14))
        ball = carried(sphere(0.05, mass, FRICTION, restitution))
        motion = placed(ball, [0.0, 0.0, 0.05 + 1e-7], [0.0, 0.0, -part * slowest, 0.0, 0.0, 0.0])
        contact = compliant_contact(ball, NormalElastic(coefficient, exponent), 1e6)
        assert CompliantMotion(ball, slope(3), motion, contact, 1e-6).advance(1.0) == DONE
        assert motion.position[2] > 0.05
        assert motion.velocity[2] == pytest.approx(expected * part * slowest, rel=tolerance)


def test_a_ball_that_spins_on_the_ground_goes_on_spinning_and_one_in_the_air_drifts():
    ball = carried(sphere(0.05, 1.0, FRICTION, 0.5))
    lying = placed(ball, [0.0, 0.0, 0.05], [0.2, 0.0, 0.0, 0.0, -3.0, 1.0])
    flying = placed(ball, [0.0, 0.0, 0.5], [0.2, 0.0, 0.0, 0.0, -3.0, 1.0])
    for motion in (lying, flying):
        height = motion.position[2]
        assert LocatedBody(ball, slope(3), motion).advance(2.0) == SOLVED
        assert motion.velocity == pytest.approx([0.2, 0.0, 0.0, 0.0, -3.0, 1.0], abs=1e-12)
        assert motion.position == pytest.approx([0.4, 0.0, height], abs=1e-12)


def test_a_block_at_rest_on_the_ground_tips_about_its_edge_under_a_torque_alone():
    """As on ice: the centre of mass goes straight up, and all work of the torque is motion."""
    body = carried(regular_block(0.2, 1.0, 0.0, 0.0))
    body.load[2] = 0.01
    motion = placed(body, [0.0, 0.1], numpy.zeros(3))
    located = LocatedBody(body, slope(2), motion)
    assert located.advance(1.0) == SOLVED
    energy = 0.5 * motion.velocity[1] ** 2 + 0.5 * body.inertia[0] * motion.velocity[2] ** 2
    assert energy == pytest.approx(0.01 * motion.angle[0], rel=1e-9)
    assert motion.position[0] == 0.0
    corner = 0.1 * math.sqrt(2.0) * math.sin(math.pi / 4.0 + motion.angle[0])
    assert motion.position[1] >= corner - 1e-10


@pytest.mark.parametrize("restitution", [0.1, 0.5, 0.9])
def test_a_ball_on_springs_rebounds_with_the_requested_restitution(restitution):
    """It drifts 0.05 m down at 0.1 m/s, touches for some milliseconds, and leaves."""
    ball = carried(sphere(0.05, 1.0, FRICTION, restitution))
    motion = placed(ball, [0.0, 0.0, 0.1], [0.3, 0.0, -SPEED, 0.0, 0.0, 0.0])
    ball_on_springs = CompliantMotion(
        ball, slope(3), motion, compliant_contact(ball, NormalElastic(1e6, 1.5), 1e6), 1e-10
    )
    for _ in range(100):
        assert ball_on_springs.advance(0.01) == DONE
    assert motion.velocity[2] == pytest.approx(restitution * SPEED, rel=1e-6)
