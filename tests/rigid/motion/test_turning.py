"""Bodies that turn on active contacts, against their own equations of motion integrated by scipy,
and against first integrals.
"""

import math

import numpy
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.spatial.transform import Rotation
from tests.rigid.motion.turning_paths import (
    STICKS,
    normal_force,
    on_corner,
    path_of_modes,
    planar_path,
    sliding_tip_path,
    slip_of_corner,
    spare_of_corner,
    top_path,
)

from contact_sim_pkg.rigid.bodies.body import (
    Motion,
    RigidBody,
    box,
    height_field,
    least_gap,
    placed,
    regular_block,
    slope,
)
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.problem import PLANE, SPACE
from contact_sim_pkg.rigid.results import SOLVED

GRAVITY = 9.81
CORNER, TIP = 0, 0  # the point that is on the ground


def carried(body, motion, duration, samples=1, tolerance=1e-10):
    """The body after ``duration`` in so many samples, and its track."""
    located = LocatedBody(body, slope(body.width), motion, tolerance=tolerance)
    status, track = located.advance_over(duration / samples, samples)
    assert status == SOLVED
    return located, track


def planar_motion(body, state):
    return placed(body, state[:2], state[3:6], angle=state[2])


def planar_state(located):
    motion = located.motion
    return numpy.array([*motion.position, *motion.angle, *motion.velocity])


def energy(located):
    body = located.body
    return located.kinetic_energy() - body.load[: body.width] @ located.motion.position


def rod(friction, length=0.4, mass=0.8):
    """A thin rod in the plane; its lower end is point 0, angle 0 is upright."""
    ends = numpy.array([[0.0, -0.5 * length], [0.0, 0.5 * length]])
    load = numpy.array([0.0, -mass * GRAVITY, 0.0])
    return RigidBody(PLANE, mass, numpy.array([mass * length**2 / 12.0]), ends, 0.0, friction, 0.0, load)


def top(friction, mass=0.5, height=0.03, radius=0.04):
    """A symmetric top: its tip is point 0, below a ring of four points."""
    ring = [[radius * math.cos(a), radius * math.sin(a), 0.02] for a in 0.5 * math.pi * numpy.arange(4)]
    load = numpy.array([0.0, 0.0, -mass * GRAVITY, 0.0, 0.0, 0.0])
    inertia = mass * numpy.array([4.0e-4, 4.0e-4, 7.0e-4])
    return RigidBody(SPACE, mass, inertia, numpy.array([[0.0, 0.0, -height], *ring]), 0.0, friction, 0.0, load)


@pytest.mark.parametrize("samples", [1, 60])
def test_a_block_that_falls_about_a_sticking_corner_is_a_compound_pendulum(samples):
    block, start = regular_block(0.1, 1.0, 1.0, 0.0), 0.3
    state = on_corner(block, CORNER, STICKS, start)
    located, track = carried(block, planar_motion(block, state), 0.06, samples)
    for sample in range(0, samples, 7):
        _time, expected = planar_path(block, CORNER, STICKS, state, 0.06 * (sample + 1) / samples)
        assert [*track.position[sample], track.angle[sample]] == pytest.approx(expected[:3], abs=1e-9)
        assert track.velocity[sample] == pytest.approx(expected[3:6], abs=1e-9)
        assert track.impulse[: sample + 1, 1].sum() == pytest.approx(expected[6], abs=1e-9)
        assert track.impulse[: sample + 1, 0].sum() == pytest.approx(expected[7], abs=1e-9)
    assert planar_state(located)[2] < start - 0.05


def test_a_load_that_changes_between_two_calls_is_felt_by_a_body_that_turns():
    block = regular_block(0.1, 1.0, 1.0, 0.0)
    pushed = block._replace(load=block.load * 2.0 + numpy.array([1.0, 0.0, 0.0]))
    state = on_corner(block, CORNER, STICKS, 0.3)
    located, _track = carried(block, planar_motion(block, state), 0.02)
    located.body = pushed
    assert located.advance(0.02) == SOLVED
    _time, middle = planar_path(block, CORNER, STICKS, state, 0.02)
    _time, expected = planar_path(pushed, CORNER, STICKS, middle[: len(state)], 0.02)
    assert planar_state(located) == pytest.approx(expected[:6], abs=1e-9)


@pytest.mark.parametrize("tolerance", [1e-4, 1e-7, 1e-10])
def test_the_error_of_a_pivot_falls_with_the_tolerance(tolerance):
    block = regular_block(0.1, 1.0, 1.0, 0.0)
    state = on_corner(block, CORNER, STICKS, 0.3)
    located, _track = carried(block, planar_motion(block, state), 0.06, 1, tolerance)
    _time, expected = planar_path(block, CORNER, STICKS, state, 0.06)
    scales = numpy.array([0.1, 0.1, 1.0, *[math.sqrt(GRAVITY * 0.1)] * 2, math.sqrt(GRAVITY / 0.1)])
    assert numpy.abs((planar_state(located) - expected[:6]) / scales).max() <= 10.0 * tolerance


@pytest.mark.parametrize(("start", "end"), [(0.2, 0.6), (0.4, 1.2)])
def test_a_rod_falls_on_a_smooth_floor_in_the_time_of_its_energy_integral(start, end):
    """``w^2 = (w_0^2 (I + m l^2 sin^2 a_0) + 2 m g l (cos a_0 - cos a))/(I + m l^2 sin^2 a)``, l
    half the length.
    """
    body, spin = rod(0.0), 1.0
    m, half, inertia = body.mass, 0.2, float(body.inertia[0])

    def speed(angle):
        first = spin**2 * (inertia + m * half**2 * math.sin(start) ** 2)
        gain = 2.0 * m * GRAVITY * half * (math.cos(start) - math.cos(angle))
        return math.sqrt((first + gain) / (inertia + m * half**2 * math.sin(angle) ** 2))

    state = on_corner(body, TIP, 1, start, spin)
    state[3] = 0.25  # the centre of mass goes on at this speed
    duration = quad(lambda angle: 1.0 / speed(angle), start, end, epsabs=1e-14, epsrel=1e-13)[0]
    located, _track = carried(body, planar_motion(body, state), duration)
    assert located.motion.angle[0] == pytest.approx(end, abs=1e-9)
    assert located.motion.velocity[2] == pytest.approx(speed(end), abs=1e-8)
    assert located.motion.velocity[0] == 0.25
    assert located.motion.position[1] == pytest.approx(half * math.cos(end), abs=1e-9)


@pytest.mark.parametrize(("friction", "slip"), [(0.1, 0.5), (0.2, -1.5), (0.3, 1.0)])
def test_a_rod_whose_lower_end_slides_follows_coulombs_law(friction, slip):
    body, mode = rod(friction), int(math.copysign(1, slip))
    state = on_corner(body, TIP, mode, 0.3, 0.5, slip)
    located, track = carried(body, planar_motion(body, state), 0.1)
    _time, expected = planar_path(body, TIP, mode, state, 0.1)
    assert mode * slip_of_corner(body, TIP, expected) > 0.1
    assert planar_state(located) == pytest.approx(expected[:6], abs=1e-9)
    assert track.impulse[0, :2] == pytest.approx(expected[[7, 6]], abs=1e-9)


@pytest.mark.parametrize("friction", [0.15, 0.3])
def test_a_corner_that_sticks_begins_to_slide_when_its_force_leaves_the_cone(friction):
    body = rod(friction)
    state = on_corner(body, TIP, STICKS, 0.05, 0.2)
    moment, _at_slip = planar_path(body, TIP, STICKS, state, 1.0, spare_of_corner)
    for before, sticks in ((1e-9, 1.0), (-1e-9, 0.0)):
        _located, track = carried(body, planar_motion(body, state), moment - before)
        assert track.sticks[0, TIP] == sticks


@pytest.mark.parametrize(
    ("friction", "modes"),
    [(0.1, (STICKS, 1, -1)), (0.3, (STICKS, 1, -1)), (0.35, (STICKS, 1, STICKS, -1)), (0.5, (STICKS, -1))],
)
def test_the_end_of_a_falling_rod_slides_forward_and_back_as_friction_requires(friction, modes):
    """What ends each mode is found by scipy; the last lasts to 0.54 s, when the rod is about to hit
    the ground.
    """
    body = rod(friction)
    state, duration = on_corner(body, TIP, STICKS, 0.05, 0.2), 0.54
    moments, expected = path_of_modes(body, TIP, modes, state, duration)
    located, track = carried(body, planar_motion(body, state), duration)
    assert expected[2] < 0.5 * math.pi
    assert located.events == len(moments)
    assert planar_state(located) == pytest.approx(expected[:6], abs=1e-8)
    assert track.impulse[0, :2] == pytest.approx(expected[[7, 6]], abs=1e-8)


def test_a_rod_that_turns_up_fast_leaves_a_smooth_floor_and_flies():
    body, after = rod(0.0), 0.03
    state = on_corner(body, TIP, 1, -0.8, 8.0)
    moment, off = planar_path(body, TIP, 1, state, 1.0, normal_force)
    located, track = carried(body, planar_motion(body, state), moment + after)
    fall = numpy.array([0.0, 0.5 * GRAVITY * after**2, 0.0, 0.0, GRAVITY * after, 0.0])
    expected = off[:6] + after * numpy.concatenate([off[3:6], numpy.zeros(3)]) - fall
    assert planar_state(located) == pytest.approx(expected, abs=1e-8)
    assert track.impulse[0, 1] == 0.0
    assert track.impulse[0, 0] == pytest.approx(off[7], abs=1e-8)


def test_a_box_that_falls_about_an_edge_is_a_compound_pendulum():
    sides, start, duration = (0.1, 0.2, 0.16), 0.3, 0.06
    body = box(sides, 2.0, 2.0, 0.0)
    turned = Rotation.from_rotvec([0.0, start, 0.0]).as_matrix()
    arm = turned @ [0.05, 0.0, -0.08]
    located, track = carried(body, placed(body, -arm, numpy.zeros(6), rotation=turned), duration)
    flat = RigidBody(PLANE, 2.0, body.inertia[1:2], numpy.array([[0.05, -0.08]]), 0.0, 2.0, 0.0, body.load[[0, 2, 4]])
    state = on_corner(flat, 0, STICKS, -start)  # a turn of x towards z is one about -y
    _time, expected = planar_path(flat, 0, STICKS, state, duration)
    motion = located.motion
    assert motion.position == pytest.approx([expected[0], 0.0, expected[1]], abs=1e-9)
    assert motion.rotation == pytest.approx(Rotation.from_rotvec([0.0, -expected[2], 0.0]).as_matrix(), abs=1e-9)
    assert motion.velocity == pytest.approx([expected[3], 0.0, expected[4], 0.0, -expected[5], 0.0], abs=1e-9)
    assert track.impulse[0].reshape(-1, 3).sum(axis=0)[:2] == pytest.approx(expected[[7, 6]], abs=1e-9)
    assert numpy.count_nonzero(track.impulse[0, ::3]) == 2
    assert expected[2] > -start + 0.02


def leaning_box(friction, lean):
    """A tall box tilted about a lower edge along x, along which gravity leans: the two corners bear
    unequal loads.
    """
    body = box((0.1, 0.1, 0.16), 2.0, friction, 0.0)
    weight = 2.0 * GRAVITY
    load = numpy.array([-weight * math.sin(lean), 0.0, -weight * math.cos(lean), 0.0, 0.0, 0.0])
    turned = Rotation.from_rotvec([-0.3, 0.0, 0.0]).as_matrix()
    arm = turned @ [0.0, 0.05, -0.08]
    return body._replace(load=load), placed(body, -arm, numpy.zeros(6), rotation=turned)


@pytest.mark.parametrize("lean", [0.1, 0.3])
def test_corners_that_share_the_friction_along_an_edge_unequally_stay_in_their_cones(lean):
    """The box turns as a pendulum under what gravity is left across the edge; the forces add up to
    what momentum requires.
    """
    body, motion = leaning_box(0.6, lean)
    start, duration = motion.position.copy(), 0.05
    flat = RigidBody(PLANE, 2.0, body.inertia[:1], numpy.array([[0.05, -0.08]]), 0.0, 0.6, 0.0, body.load[[1, 2, 3]])
    _time, expected = planar_path(flat, 0, STICKS, on_corner(flat, 0, STICKS, -0.3), duration)
    located, track = carried(body, motion, duration, 50)
    assert motion.position == pytest.approx([start[0], *expected[:2]], abs=1e-9)
    assert motion.velocity == pytest.approx([0.0, *expected[3:6], 0.0, 0.0], abs=1e-9)
    normal, along, across = (track.impulse[:, k::3] for k in range(3))
    pressed = numpy.flatnonzero(normal[0])
    assert len(pressed) == 2
    assert normal[:, pressed].max() > 1.5 * normal[:, pressed].min()
    assert (numpy.hypot(along, across) <= 0.6 * normal * (1.0 + 1e-9) + 1e-15).all()
    total = track.impulse.reshape(50, -1, 3).sum(axis=(0, 1))
    assert total == pytest.approx([expected[7], -body.load[0] * duration, expected[6]], abs=1e-9)
    assert located.events == 0


SPINS = [(0.4, [0.3, -0.2, 90.0]), (0.2, [1.0, 0.5, 140.0])]


@pytest.mark.parametrize(("tilt", "spin"), SPINS)
def test_a_top_on_a_sticking_tip_follows_the_equations_of_euler(tilt, spin):
    """Energy, and the spin about the vertical and about its own axis, stay what they were."""
    body, duration = top(5.0), 0.3
    turned = Rotation.from_euler("xz", [tilt, 0.4]).as_matrix()
    position, rotation, velocity = top_path(body, TIP, turned, spin, 0.0)
    located, track = carried(body, placed(body, position, velocity, rotation=rotation), duration)
    about_z = (body.mass * numpy.cross(position, velocity[:3]) + turned @ (body.inertia * spin))[2]
    before = energy(LocatedBody(body, slope(SPACE), placed(body, position, velocity, rotation=rotation)))
    weight = -body.load[:3] * duration
    expected = top_path(body, TIP, turned, spin, duration)
    motion = located.motion
    assert motion.position == pytest.approx(expected[0], abs=1e-9)
    assert motion.rotation == pytest.approx(expected[1], abs=1e-8)
    assert motion.velocity == pytest.approx(expected[2], abs=1e-7)
    momentum = body.mass * numpy.cross(motion.position, motion.velocity[:3])
    momentum += motion.rotation @ (body.inertia * (motion.rotation.T @ motion.velocity[3:]))
    assert momentum[2] == pytest.approx(about_z, rel=1e-9)
    assert motion.rotation[:, 2] @ motion.velocity[3:] == pytest.approx(spin[2], rel=1e-9)
    assert energy(located) == pytest.approx(before, rel=1e-9)
    push = body.mass * (expected[2][:3] - velocity[:3]) + weight
    assert track.impulse[0, :3] == pytest.approx(push[[2, 0, 1]], abs=1e-9)


@pytest.mark.parametrize(("friction", "spin"), [(0.1, [0.3, -0.2, 90.0]), (0.3, [1.0, 0.5, 140.0])])
def test_a_top_whose_tip_slides_follows_coulombs_law_in_space(friction, spin):
    body, duration = top(friction), 0.05
    turned = Rotation.from_euler("xz", [0.3, 0.4]).as_matrix()
    position, rotation, velocity = sliding_tip_path(body, TIP, turned, [0.9, -0.5], spin, 0.0)
    located, _track = carried(body, placed(body, position, velocity, rotation=rotation), duration)
    expected = sliding_tip_path(body, TIP, turned, [0.9, -0.5], spin, duration)
    assert located.events == 0
    assert located.motion.position == pytest.approx(expected[0], abs=1e-9)
    assert located.motion.rotation == pytest.approx(expected[1], abs=1e-8)
    assert located.motion.velocity == pytest.approx(expected[2], abs=1e-7)


def turning_cases():
    """Bodies that only turn on active contacts: a rod that slides and sticks, a box on an edge,
    tops on a tip.
    """
    fall = rod(0.35)
    yield pytest.param(fall, planar_motion(fall, on_corner(fall, TIP, STICKS, 0.05, 0.2)), 0.54, id="rod")
    yield pytest.param(*leaning_box(0.6, 0.3), 0.05, id="edge")
    for friction in (0.1, 5.0):
        body, turned = top(friction), Rotation.from_euler("xz", [0.3, 0.4]).as_matrix()
        start = sliding_tip_path(body, TIP, turned, [0.9, -0.5], [0.3, -0.2, 90.0], 0.0)
        if friction > 1.0:
            start = top_path(body, TIP, turned, [0.3, -0.2, 90.0], 0.0)
        yield pytest.param(body, placed(body, start[0], start[2], rotation=start[1]), 0.05, id=f"top {friction}")


@pytest.mark.parametrize(("body", "motion", "duration"), [*turning_cases()])
def test_turning_keeps_energy_and_momentum_and_does_not_depend_on_the_output(body, motion, duration):
    start, copies = motion.velocity.copy(), [Motion(*map(numpy.copy, motion)) for _ in range(2)]
    before = energy(LocatedBody(body, slope(body.width), motion))
    once, whole = carried(body, copies[0], duration)
    often, track = carried(body, copies[1], duration, 1000)
    assert energy(often) + often.dissipated == pytest.approx(before, rel=1e-9)
    assert energy(once) + once.dissipated == pytest.approx(before, rel=1e-9)
    assert often.dissipated == pytest.approx(once.dissipated, abs=1e-9 * before)
    for one, many in zip(copies[0], copies[1], strict=True):
        assert many == pytest.approx(one, rel=1e-9, abs=1e-9)
    assert track.impulse.sum(axis=0) == pytest.approx(whole.impulse[0], abs=1e-9)
    rows = track.impulse.reshape(1000, -1, body.width).sum(axis=1)
    push = numpy.column_stack([*rows.T[1:], rows[:, 0]]) + duration / 1000.0 * body.load[: body.width]
    gains = numpy.diff(numpy.vstack([start, track.velocity])[:, : body.width], axis=0)
    assert body.mass * gains == pytest.approx(push, abs=1e-10)


def test_an_end_of_a_rod_that_only_the_force_on_the_other_presses_down_stays_on_its_wall():
    """Between two smooth walls at right angles: ``(1 + k) f'' = -(sqrt(2) g/l)(cos f - sin f)``, k
    = 4 I/(m l^2), f from one wall.

    At first the spin alone would lift the second end, by 0.1 g/sqrt(2), while the force on the
    first lets it press on its wall.
    """
    length, share, start = 0.2, 0.3, math.radians(30.0)
    half, load_acceleration = 0.5 * length, GRAVITY / math.sqrt(2.0)
    rate = math.sqrt(1.1 * load_acceleration / (half * math.cos(start)))

    def motion_of(_time, state):
        return state[1], -load_acceleration / (half * (1.0 + share)) * (math.cos(state[0]) - math.sin(state[0]))

    def pressures(state):
        f, speed, gain = *state, motion_of(0.0, state)[1]
        on_first = load_acceleration + half * (math.cos(f) * gain - math.sin(f) * speed**2)
        return on_first, load_acceleration - half * (math.sin(f) * gain + math.cos(f) * speed**2)

    load = numpy.array([0.0, -GRAVITY, 0.0])
    ends = numpy.array([[-half, 0.0], [half, 0.0]])
    rod = RigidBody(PLANE, 1.0, numpy.array([share * half**2]), ends, 0.0, 0.0, 0.0, load)
    along = numpy.array([[1.0, -1.0], [1.0, 1.0]]) / math.sqrt(2.0)  # columns: up the walls
    place = along @ [half * math.cos(start), half * math.sin(start)]
    velocity = along @ [-half * math.sin(start) * rate, half * math.cos(start) * rate]
    motion = placed(rod, place, [*velocity, -rate], angle=1.25 * math.pi - start)
    located = LocatedBody(rod, height_field(PLANE, numpy.array([2.0, 0.0, 2.0]), -2.0, 2.0), motion, tolerance=1e-12)
    for sample in range(1, 11):
        located.advance(1e-3)
        span = (0.0, 1e-3 * sample)
        truth = solve_ivp(motion_of, span, (start, rate), method="DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
        assert min(pressures(truth)) > 0.0
        assert least_gap(located.body, located.ground, motion) >= -1e-12
        assert motion.angle[0] == pytest.approx(1.25 * math.pi - truth[0], abs=1e-10)
        assert motion.velocity[2] == pytest.approx(-truth[1], rel=1e-9)
