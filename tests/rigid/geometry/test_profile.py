"""Bodies over heights along x: gaps at peaks and in valleys, rest where two faces meet, what never
ends is refused by name.
"""

import math

import numpy
import pytest

from contact_sim_pkg.rigid.bodies.body import (
    RigidBody,
    box,
    contact_count,
    contact_kinematics,
    fitted_ground,
    height_field,
    least_gap,
    placed,
    regular_block,
    rise_to_ground,
    slope,
    sphere,
)
from contact_sim_pkg.rigid.motion import located as located_module
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.problem import PLANE
from contact_sim_pkg.rigid.results import SOLVED, TOO_MANY_EVENTS

GRAVITY = 9.81
VALLEY = [1.0, 0.0, 1.0]  # faces of 45 degrees from x = -1 to 1
ROOF = [0.0, 1.0, 0.0]


def ball(radius, friction, restitution):
    """A ball in the plane."""
    return RigidBody(
        PLANE, 1.0, numpy.array([0.4 * radius**2]), numpy.zeros((1, 2)), radius, friction, restitution,
        numpy.array([0.0, -GRAVITY, 0.0]),
    )  # fmt: skip


def polygon(random, friction, restitution):
    """Five corners on a circle of 0.08 m."""
    angles = numpy.sort(random.random(5)) * 2.0 * math.pi
    points = 0.08 * numpy.column_stack([numpy.cos(angles), numpy.sin(angles)])
    points -= points.mean(axis=0)
    inertia = numpy.array([float((points**2).sum(axis=1).mean())])
    return RigidBody(PLANE, 1.0, inertia, points, 0.0, friction, restitution, numpy.array([0.0, -GRAVITY, 0.0]))


def energy(located):
    return located.kinetic_energy() + GRAVITY * located.body.mass * float(located.motion.position[-1])


def gaps_of(body, ground, motion):
    ground = fitted_ground(body, ground)
    contacts = contact_count(body, ground)
    gap, rows = numpy.zeros(contacts), numpy.zeros((contacts * body.width, len(body.load)))
    contact_kinematics(body, ground, motion, gap, rows)
    return gap, rows


def run(located, duration, interval=0.01):
    """Advance; energy may not grow, the body may not go below the ground by more than a billionth
    of its size.
    """
    last = energy(located)
    scale = abs(last) + located.body.mass * GRAVITY * located.size
    for _ in range(round(duration / interval)):
        assert located.advance(interval) == SOLVED
        now = energy(located)
        assert now <= last + 1e-5 * scale
        last = now
        assert least_gap(located.body, located.ground, located.motion) >= -1e-9 * located.size


@pytest.mark.parametrize(
    ("x", "z", "expected"), [(0.0, 2.0, 1.0), (0.5, 1.5, math.sqrt(0.5)), (1.5, 0.5, math.sqrt(0.5))]
)
def test_the_gap_of_a_ball_over_a_roof_is_its_distance_from_the_ridge_or_a_face(x, z, expected):
    body = ball(0.1, 0.3, 0.5)
    gap, rows = gaps_of(body, height_field(PLANE, ROOF, -1.0, 1.0), placed(body, [x, z], numpy.zeros(3)))
    nearest = int(numpy.argmin(gap))
    assert gap[nearest] == pytest.approx(expected - 0.1, rel=1e-14)
    assert numpy.linalg.norm(rows[2 * nearest, :2]) == pytest.approx(1.0, rel=1e-14)


def distance_to_heights(heights, origin, cell, x, z):
    """True distance to the polyline, which goes on beyond its ends; negative below it."""
    before, after = 20.0 * numpy.diff(heights)[[0, -1]]
    nodes = origin + cell * numpy.array([-20.0, *range(len(heights)), len(heights) + 19.0])
    corners = numpy.column_stack([nodes, [heights[0] - before, *heights, heights[-1] + after]])
    along = numpy.diff(corners, axis=0)
    share = (((numpy.array([x, z]) - corners[:-1]) * along).sum(axis=1) / (along**2).sum(axis=1)).clip(0.0, 1.0)
    away = numpy.linalg.norm(corners[:-1] + share[:, None] * along - (x, z), axis=1).min()
    return math.copysign(away, z - numpy.interp(x, *corners.T))


@pytest.mark.parametrize("steepness", [0.4, 2.0, 6.0])
def test_the_gap_of_a_ball_over_heights_is_its_true_distance(steepness):
    """Where the ball is nearer than a cell, and its middle not deeper than its radius."""
    random, seen = numpy.random.default_rng(7), 0
    for radius in (0.02, 0.05, 0.12):
        heights = random.random(12) * steepness * 0.05
        ground = height_field(PLANE, heights, -0.3, 0.05)
        body = ball(radius, 0.0, 0.3)
        for x in numpy.linspace(-0.35, 0.35, 29):
            for z in numpy.linspace(-0.1, heights.max() + 0.15, 25):
                expected = distance_to_heights(heights, -0.3, 0.05, x, z) - radius
                motion = placed(body, [x, z], numpy.zeros(3))
                assert least_gap(body, fitted_ground(body, ground), motion) == pytest.approx(expected, abs=1e-13)
                if abs(expected) < min(0.045, radius):
                    seen += 1
                    assert gaps_of(body, ground, motion)[0].min() == pytest.approx(expected, abs=1e-13)
    assert seen > 300


@pytest.mark.parametrize("heights", [[-0.11, 0.0, -0.07], [-0.5, -0.11, 0.0, -0.11, -0.5], [-0.05, 0.0, -0.2]])
@pytest.mark.parametrize("width", [2, 3])
def test_a_ball_does_not_fall_through_a_steep_peak(heights, width):
    body = ball(0.05, 0.0, 0.3) if width == PLANE else sphere(0.05, 1.0, 0.0, 0.3)
    start = [0.0, 0.1] if width == PLANE else [0.0, 0.0, 0.1]
    motion = placed(body, start, numpy.zeros(len(body.load)))
    run(LocatedBody(body, height_field(width, heights, 0.0, 0.05), motion), 0.6)


def test_a_ball_is_seen_wherever_it_lies_on_heights_of_one_slope():
    """Also where rounding lets its foot fall between two faces that are one."""
    random, body = numpy.random.default_rng(3), ball(0.05, 0.0, 0.3)
    for origin in random.uniform(-2.0, 0.0, 8):
        for rise, cell in ((0.0, 0.05), (0.0, 0.07), (0.37, 0.1)):
            ground, across = height_field(PLANE, rise * cell * numpy.arange(40), origin, cell), math.hypot(1.0, rise)
            for node in range(3, 36, 4):
                x = origin + node * cell - 0.05 * rise / across
                for ulp in range(-4, 5):
                    place = [x + ulp * numpy.spacing(x), rise * cell * node + 0.05 / across]
                    assert abs(gaps_of(body, ground, placed(body, place, numpy.zeros(3)))[0].min()) <= 1e-13


def test_the_rise_out_of_the_heights_is_reported():
    """Against bisection of its least gap; a ball on a face of slope s: its depth times ``sqrt(1 +
    s^2)``.
    """
    random = numpy.random.default_rng(5)
    for _ in range(20):
        for body in (ball(0.12, 0.3, 0.3), polygon(random, 0.3, 0.3)):
            ground = fitted_ground(body, height_field(PLANE, random.uniform(-0.2, 0.0, 12), -0.3, 0.05))
            motion = placed(body, random.uniform(-0.3, 0.3, 2), numpy.zeros(3))
            low, high = -3.0, 3.0
            for _ in range(60):
                middle = 0.5 * (low + high)
                raised = motion._replace(position=motion.position + numpy.array([0.0, middle]))
                low, high = (low, middle) if least_gap(body, ground, raised) >= 0.0 else (middle, high)
            assert rise_to_ground(body, ground, motion) == pytest.approx(high, abs=1e-13)
    body = ball(0.1, 0.3, 0.3)
    ground = fitted_ground(body, height_field(PLANE, [0.0, 2.0], 0.0, 1.0))
    rise = rise_to_ground(body, ground, placed(body, [0.3, 0.6], numpy.zeros(3)))
    assert rise == pytest.approx(0.1 * math.sqrt(5.0), rel=1e-14)
    for width in (2, 3):
        body = sphere(0.1, 1.0, 0.3, 0.3) if width == 3 else body
        place = placed(body, numpy.zeros(width), numpy.zeros(len(body.load)))
        assert rise_to_ground(body, slope(width, 1.2), place) == pytest.approx(0.1 / math.cos(1.2), rel=1e-14)


def test_the_normal_rows_are_the_rates_of_the_gaps_over_a_roof():
    ground = height_field(PLANE, ROOF, -1.0, 1.0)
    rate = numpy.array([0.3, -0.2, 1.1])
    for body, place in ((ball(0.1, 0.3, 0.5), [0.04, 1.2]), (regular_block(0.4, 1.0, 0.3, 0.5), [0.05, 1.3])):
        motions = [
            placed(body, numpy.array(place) + t * rate[:2], rate, angle=0.3 + t * rate[2]) for t in (-1e-6, 0.0, 1e-6)
        ]
        before, (gap, rows), after = (gaps_of(body, ground, motion) for motion in motions)
        near = gap < 0.3
        assert near.any()
        assert (rows[0::2] @ rate)[near] == pytest.approx((after[0] - before[0])[near] / 2e-6, abs=1e-7)


def test_a_ball_rests_in_a_valley_on_both_faces():
    """The split of least norm lets friction carry what it can: ``N (1 + mu) sqrt(2) = W``."""
    radius = 0.05
    body = ball(radius, 0.3, 0.5)
    located = LocatedBody(body, height_field(PLANE, VALLEY, -1.0, 1.0), placed(body, [0.3, 1.0], numpy.zeros(3)))
    run(located, 6.0)
    assert located.motion.position == pytest.approx([0.0, radius * math.sqrt(2.0)], abs=1e-9)
    assert not located.motion.velocity.any()
    assert located.impulse[0::2] == pytest.approx([0.01 * GRAVITY / (1.3 * math.sqrt(2.0))] * 2, rel=1e-9)


def test_a_sphere_that_slides_along_a_valley_rolls_there():
    """No slip at either face: speed over spin is the arm of the axis through both contacts,
    r/sqrt(2).
    """
    radius = 0.05
    body = sphere(radius, 1.0, 0.3, 0.5)
    motion = placed(body, [0.3, 0.0, 1.0], [0.0, 0.1, 0.0, 0.0, 0.0, 0.0])
    located = LocatedBody(body, height_field(3, VALLEY, -1.0, 1.0), motion)
    run(located, 6.0)
    assert motion.position[[0, 2]] == pytest.approx([0.0, radius * math.sqrt(2.0)], abs=1e-9)
    assert motion.velocity[1] == pytest.approx(-motion.velocity[3] * radius / math.sqrt(2.0), rel=1e-9)
    assert motion.velocity[1] > 0.01


def test_a_block_balances_with_its_edge_on_a_peak_between_its_corners():
    side = 0.1
    block = regular_block(side, 1.0, 0.5, 0.3)
    ground = height_field(PLANE, [0.0, 0.0, 0.05, 0.0, 0.0], -1.0, 0.5)
    located = LocatedBody(block, ground, placed(block, [0.0, 0.2], numpy.zeros(3)))
    run(located, 3.0)
    assert located.motion.position == pytest.approx([0.0, 0.05 + 0.5 * side], abs=1e-12)
    assert not located.motion.velocity.any()


def test_a_corner_that_slides_over_a_peak_leaves_the_ground_as_a_ballistic_point():
    """A point without friction: behind the ridge of a ramp it flies on a parabola."""
    angle, speed, start, passed = math.atan(0.5), 4.0, 0.5, 0.05
    point = ball(0.0, 0.0, 0.0)._replace(inertia=numpy.array([1e-3]))
    motion = placed(point, [start, 0.5 * start], [speed * math.cos(angle), speed * math.sin(angle), 0.0])
    located = LocatedBody(point, height_field(PLANE, [0.0, 0.5, -5.0], 0.0, 1.0), motion)
    slowing = GRAVITY * math.sin(angle)
    off = math.sqrt(speed**2 - 2.0 * slowing * (1.0 - start) / math.cos(angle))
    assert located.advance((speed - off) / slowing + passed) == SOLVED
    expected = [1.0 + off * math.cos(angle) * passed, 0.5 + off * math.sin(angle) * passed - 0.5 * GRAVITY * passed**2]
    assert motion.position == pytest.approx(expected, abs=1e-8)


@pytest.mark.parametrize("seed", range(12))
def test_bodies_come_to_rest_or_go_on_over_random_heights_without_gain_or_penetration(seed):
    random = numpy.random.default_rng(seed)
    cell = float(random.choice([0.02, 0.05, 0.1, 0.25]))
    heights = random.random(round(4.0 / cell)) * cell * random.choice([0.3, 1.0])
    restitution, friction = float(random.choice([0.0, 0.3, 0.8])), float(random.choice([0.0, 0.1, 0.5, 5.0]))
    bodies = (
        ball(0.05, friction, restitution),
        regular_block(0.1, 1.0, friction, restitution),
        polygon(random, friction, restitution),
    )
    body, spin = bodies[seed % 3], 5.0 * random.normal()
    motion = placed(body, [0.0, heights.max() + 0.3], [random.normal(), 0.0, spin], angle=random.random())
    run(LocatedBody(body, height_field(PLANE, heights, -2.0, cell), motion), 2.0)


@pytest.mark.parametrize("seed", range(4))
def test_bodies_in_space_go_over_random_heights_without_gain_or_penetration(seed):
    random = numpy.random.default_rng(seed)
    heights = random.random(40) * 0.05
    body = sphere(0.05, 1.0, 0.5, 0.5) if seed % 2 else box((0.1, 0.15, 0.08), 1.0, 0.5, 0.3)
    motion = placed(body, [0.0, 0.0, 0.5], random.normal(size=6))
    run(LocatedBody(body, height_field(3, heights, -2.0, 0.1), motion), 1.0)


def test_what_brings_the_motion_no_further_is_refused_and_not_run_for_ever(monkeypatch):
    monkeypatch.setattr(located_module, "MOST_SHORT", -1)
    block = regular_block(0.1, 1.0, 0.3, 0.3)
    located = LocatedBody(block, height_field(PLANE, VALLEY, -1.0, 1.0), placed(block, [0.3, 1.0], numpy.zeros(3)))
    status = SOLVED
    for _ in range(100):
        status = status or located.advance(0.01)
    assert status == TOO_MANY_EVENTS
