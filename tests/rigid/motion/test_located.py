"""Rigid bodies in time with located events, against closed forms."""

import math

import numpy
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from contact_sim_pkg.rigid.bodies.body import box, height_field, placed, regular_block, slope, sphere
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.results import REVERSE, SEPARATE, SLIDE, SOLVED, STICK

GRAVITY = 9.81


def run(body, duration, interval=1e-3):
    """Advance and return the impacts and the time of the last rest."""
    impacts, rested = [], math.nan
    for k in range(round(duration / interval)):
        assert body.advance(interval) == SOLVED
        impacts += body.impacts
        if not math.isnan(body.rested):
            rested = k * interval + body.rested
    return impacts, rested


@pytest.mark.parametrize(("height", "restitution"), [(1.0, 0.8), (0.3, 0.5), (2.0, 0.9)])
def test_a_sphere_bounces_to_rest_at_the_time_of_the_geometric_series(height, restitution):
    radius = 0.05
    body = sphere(radius, 1.0, 0.3, restitution)
    motion = placed(body, [0.0, 0.0, height + radius], numpy.zeros(6))
    located = LocatedBody(body, slope(3), motion)
    first = math.sqrt(2.0 * height / GRAVITY)
    expected = first * (1.0 + restitution) / (1.0 - restitution)
    impacts, rested = run(located, math.ceil(2.0 * expected), 0.05)
    assert rested == pytest.approx(expected, abs=1e-12)
    assert len(impacts) <= 2.0 + math.log(located.rest_speed / (GRAVITY * first)) / math.log(restitution)
    assert not motion.velocity.any()
    assert motion.position[2] == pytest.approx(radius, abs=1e-12)


@pytest.mark.parametrize("restitution", [0.3, 0.8])
def test_the_impulses_of_a_bouncing_body_carry_its_weight_to_rounding(restitution):
    """From rest to rest the ground gives m g t, the last bounces that are taken as one included."""
    body = sphere(0.05, 2.0, 0.3, restitution)
    located = LocatedBody(body, slope(3), placed(body, [0.0, 0.0, 1.05], numpy.zeros(6)))
    status, track = located.advance_over(1e-2, 500)
    assert (status, located.motion.velocity.any()) == (SOLVED, False)
    assert track.impulse[:, 0].sum() == pytest.approx(2.0 * GRAVITY * 5.0, rel=1e-13)


def test_a_block_slides_to_a_stop_after_the_distance_of_coulombs_law():
    block = regular_block(0.1, 1.0, 0.3, 0.0)
    motion = placed(block, [0.0, 0.05], [2.0, 0.0, 0.0])
    run(LocatedBody(block, slope(2), motion), 1.0)
    assert motion.position[0] == pytest.approx(2.0**2 / (2.0 * 0.3 * GRAVITY), rel=1e-9)
    assert not motion.velocity.any()


@pytest.mark.parametrize("width", [2, 3])
def test_a_body_on_a_slope_below_the_angle_of_friction_does_not_creep(width):
    angle = math.radians(15.0)
    if width == 2:
        body = regular_block(0.1, 1.0, 0.3, 0.3)
        motion = placed(body, [-0.05 * math.sin(angle), 0.05 * math.cos(angle)], numpy.zeros(3), angle=angle)
    else:
        body = box((0.2, 0.1, 0.1), 1.0, 0.3, 0.3)
        turned = Rotation.from_rotvec([0.0, -angle, 0.0]).as_matrix()
        motion = placed(body, turned @ [0.0, 0.0, 0.05], numpy.zeros(6), rotation=turned)
    start = motion.position.copy()
    run(LocatedBody(body, slope(width, angle), motion), 2.0, 0.01)
    assert numpy.abs(motion.position - start).max() / 2.0 <= 1e-15


def test_a_block_on_a_steeper_slope_slides_with_the_acceleration_that_friction_leaves():
    angle, friction = math.radians(30.0), 0.3
    block = regular_block(0.1, 1.0, friction, 0.0)
    motion = placed(block, [-0.05 * math.sin(angle), 0.05 * math.cos(angle)], numpy.zeros(3), angle=angle)
    start = motion.position.copy()
    run(LocatedBody(block, slope(2, angle), motion), 0.5)
    acceleration = GRAVITY * (math.sin(angle) - friction * math.cos(angle))
    assert numpy.linalg.norm(motion.position - start) == pytest.approx(0.5 * acceleration * 0.5**2, rel=1e-9)


def test_a_sphere_that_lands_with_slip_rolls_with_five_sevenths_of_its_speed():
    body = sphere(0.05, 1.0, 0.2, 0.0)
    motion = placed(body, [0.0, 0.0, 0.05], [1.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    run(LocatedBody(body, slope(3), motion), 1.0)
    assert motion.velocity[0] == pytest.approx(5.0 / 7.0, rel=1e-9)
    assert motion.velocity[4] == pytest.approx(5.0 / 7.0 / 0.05, rel=1e-9)


@pytest.mark.parametrize("interval", [1e-3, 0.1])
@pytest.mark.parametrize("angle", [0.0, 0.3])
def test_a_ball_that_rolls_or_slides_keeps_its_side_spin_and_its_line_at_any_interval(angle, interval):
    """Slip keeps its direction and falls by 7/2 mu g, the ball ends at 5/7 of its speed; across a
    slope it gains 5/7 g sin(angle).

    The spin about the normal has no torque.
    """
    radius, side, friction, duration = 0.05, 50.0, 0.3, 0.4
    up = numpy.array([-math.sin(angle), 0.0, math.cos(angle)])
    down = numpy.array([-math.cos(angle), 0.0, -math.sin(angle)]) * math.sin(angle)
    start = numpy.array([0.0, 1.0, 0.0])
    spin = side * up + (numpy.cross(up, start) / radius if angle else 0.0)
    motion = placed(sphere(radius, 1.0, friction, 0.0), radius * up, [*start, *spin])
    run(LocatedBody(sphere(radius, 1.0, friction, 0.0), slope(3, angle), motion), duration, interval)
    if angle:
        gain = 5.0 / 7.0 * GRAVITY * down
        way, velocity = start * duration + 0.5 * gain * duration**2, start + gain * duration
    else:
        slides = 2.0 / (7.0 * friction * GRAVITY)
        way = start * (slides - 0.5 * friction * GRAVITY * slides**2 + 5.0 / 7.0 * (duration - slides))
        velocity = 5.0 / 7.0 * start
    assert motion.position == pytest.approx(radius * up + way, abs=1e-12)
    assert motion.velocity[:3] == pytest.approx(velocity, abs=1e-12)
    assert motion.velocity[3:] == pytest.approx(side * up + numpy.cross(up, velocity) / radius, abs=1e-10)


def test_a_box_tumbles_in_the_air_as_the_equations_of_euler_say():
    body = box((0.2, 0.3, 0.1), 2.0, 0.4, 0.5)
    turned = Rotation.from_euler("xyz", [0.3, -0.2, 0.7]).as_matrix()
    motion = placed(body, [0.0, 0.0, 100.0], [0.1, 0.0, 0.0, 1.0, 5.0, 0.3], rotation=turned)
    momentum = turned @ numpy.diag(body.inertia) @ turned.T @ motion.velocity[3:]

    def rate(_time, flat):
        R = flat.reshape(3, 3)
        return numpy.cross(R @ numpy.diag(1.0 / body.inertia) @ R.T @ momentum, R, axisb=0, axisc=0).ravel()

    expected = solve_ivp(rate, (0.0, 0.5), turned.ravel(), "DOP853", rtol=1e-12, atol=1e-14).y[:, -1].reshape(3, 3)
    run(LocatedBody(body, slope(3), motion), 0.5)
    assert motion.rotation == pytest.approx(expected, abs=1e-10)
    assert motion.position == pytest.approx([0.05, 0.0, 100.0 - 0.5 * GRAVITY * 0.25], rel=1e-12)


def test_elastic_bounces_of_a_block_keep_its_energy():
    block = regular_block(0.1, 1.0, 0.0, 1.0)
    motion = placed(block, [0.0, 0.3], [0.3, 0.0, 1.0], angle=0.4)
    located = LocatedBody(block, slope(2), motion)
    start = located.kinetic_energy() + GRAVITY * motion.position[1]
    impacts = []
    while len(impacts) < 100:
        assert located.advance(0.01) == SOLVED
        impacts += located.impacts
    assert located.kinetic_energy() + GRAVITY * motion.position[1] == pytest.approx(start, rel=1e-12)


def test_no_impact_of_a_falling_box_gains_kinetic_energy_and_the_box_comes_to_rest_on_a_face():
    body = box((0.2, 0.3, 0.1), 2.0, 0.4, 0.5)
    turned = Rotation.from_euler("xyz", [0.3, -0.2, 0.7]).as_matrix()
    motion = placed(body, [0.0, 0.0, 0.5], [1.0, 0.0, 0.0, 3.0, 5.0, 0.3], rotation=turned)
    located = LocatedBody(body, slope(3), motion)
    energy = located.kinetic_energy()
    impacts, _rested = run(located, 3.0)
    assert min(impact.lost for impact in impacts) >= -1e-12 * energy
    assert not motion.velocity.any()
    heights = motion.position[2] + (body.points @ motion.rotation.T)[:, 2]
    assert numpy.sort(heights)[:4] == pytest.approx(numpy.zeros(4), abs=1e-8)
    assert sorted(located.modes()) == [SEPARATE] * 4 + [STICK] * 4
    assert sorted(located.impulse[::3])[4:] == pytest.approx([1e-3 * 2.0 * GRAVITY / 4.0] * 4, rel=1e-6)


@pytest.mark.parametrize("seed", range(3))
def test_a_box_thrown_at_random_comes_to_rest_and_does_not_creep(seed):
    random = numpy.random.default_rng(seed)
    body = box((0.2, 0.15, 0.1), 1.0, 0.5, 0.3)
    turned = Rotation.random(random_state=seed).as_matrix()
    motion = placed(body, [0.0, 0.0, 0.4], random.normal(size=6) * [1.0, 1.0, 1.0, 4.0, 4.0, 4.0], rotation=turned)
    located = LocatedBody(body, slope(3), motion)
    energy = math.inf
    for _ in range(60):
        assert located.advance(0.05) == SOLVED
        now = located.kinetic_energy() + GRAVITY * float(motion.position[2])
        assert now <= energy + 1e-9
        energy = now
    assert not motion.velocity.any()
    place = motion.position.copy()
    run(located, 1.0, 0.05)
    assert numpy.abs(motion.position - place).max() <= 1e-15


def test_a_rod_that_pivots_fast_lifts_off_where_its_end_would_be_pulled():
    """Its end stays down while ``m (g + path) >= 0``: a body turning at w about its end needs ``w^2
    r`` from its weight.
    """
    rod = regular_block(0.1, 1.0, 5.0, 0.0)._replace(
        points=numpy.array([[-0.5, 0.0], [0.5, 0.0]]), inertia=numpy.array([1.0 / 12.0])
    )
    for rate, leaves in ((4.0, False), (5.0, True)):  # upright, w^2 r = g at sqrt(2 g) = 4.43 rad/s
        motion = placed(rod, [0.0, 0.5], [-0.5 * rate, 0.0, rate], angle=0.5 * math.pi)
        located = LocatedBody(rod, slope(2), motion)
        assert located.advance(1e-3) == SOLVED
        assert (located.impulse[::2].max() == 0.0) == leaves


def test_corner_impacts_stick_slide_or_reverse_as_the_friction_requires():
    found = set()
    for friction, speed, spin in ((1.0, 0.0, 0.0), (0.1, 2.0, 0.0), (0.1, 0.05, 0.0), (0.1, -0.05, 0.0)):
        block = regular_block(0.1, 1.0, friction, 0.3)
        motion = placed(block, [0.0, 0.2], [speed, -1.0, spin], angle=0.5)
        located = LocatedBody(block, slope(2), motion)
        impacts, _rested = run(located, 0.1)
        found.add(impacts[0].modes[0])
    assert found == {STICK, SLIDE, REVERSE}


def test_a_sphere_on_a_height_field_that_is_a_plane_moves_as_on_that_plane():
    angle, radius = 0.2, 0.05
    nodes = numpy.linspace(-2.0, 2.0, 41)
    field = height_field(3, math.tan(angle) * nodes, -2.0, 0.1)
    positions = []
    for ground in (slope(3, angle), field):
        body = sphere(radius, 1.0, 0.3, 0.5)
        motion = placed(body, [0.0, 0.0, 0.3], numpy.zeros(6))
        run(LocatedBody(body, ground, motion), 0.5)
        positions.append(motion.position.copy())
    assert positions[1] == pytest.approx(positions[0], abs=1e-7)


@pytest.mark.parametrize("pressed", [True, False])
def test_a_corner_is_active_where_the_spin_that_changes_by_itself_presses_it_down(pressed):
    """Without ``dw/dt = -I^-1 (w x Iw)`` in it the acceleration of the corner has the other sign:
    active or free turns round.
    """
    generator = numpy.random.default_rng(5)
    body, found = box((0.3, 0.2, 0.05), 1.0, 0.5, 0.0), 0
    while found < 5:
        R, w = (
            Rotation.random(random_state=int(generator.integers(1 << 30))).as_matrix(),
            12.0 * generator.normal(size=3),
        )
        arms = body.points @ R.T
        arm = arms[arms[:, 2].argmin()]
        own = R.T @ w
        gain = R @ (-numpy.cross(own, body.inertia * own) / body.inertia)
        path = -9.81 + numpy.cross(w, numpy.cross(w, arm))[2]
        whole = path + numpy.cross(gain, arm)[2]
        if not (min(abs(path), abs(whole)) > 2.0 and path * whole < 0.0 and (whole < 0.0) == pressed):
            continue
        found += 1
        motion = placed(body, [0.0, 0.0, -arm[2]], [0.0, 0.0, -numpy.cross(w, arm)[2], *w], rotation=R)
        located = LocatedBody(body, slope(3), motion)
        assert located.advance(1e-5) == SOLVED
        assert (located.impulse[::3].max() > 0.0) == pressed
        assert located.events <= 2
