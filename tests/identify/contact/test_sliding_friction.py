"""Friction of contacts that last: mu where the slip kept its direction, a lower bound elsewhere."""

import re

import numpy
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from tests.identify import motions

from contact_sim_pkg.identify.contact.lasting import lasting_note
from contact_sim_pkg.identify.identify import Setup, identify
from contact_sim_pkg.identify.motion import geometry
from contact_sim_pkg.identify.motion.flight import FlightModel
from contact_sim_pkg.identify.motion.states import BodyStates, SampleNoise
from contact_sim_pkg.identify.motion.wrench import NO_WRENCH
from contact_sim_pkg.identify.problem import IdentificationProblem, spatial_basis

FRICTION, GRAVITY, RADIUS = 0.4, 9.81, 0.05
CORNERS = numpy.array([[0.1, 0.15, 0.0], [0.1, -0.15, 0.0], [-0.1, 0.15, 0.0], [-0.1, -0.15, 0.0]])
NOISE = {"exact": None, "noise": (1e-4, 1e-4, 1e-3, 1e-3)}
BALL = Setup(geometry.sphere(RADIUS))


def ball(slope=0.0, across=0.0, duration=0.15):
    """A ball slides over a plane that falls along x by `slope` [rad]; scipy: J w' = r x F, F = -mu N s / |s|, J/m = 0.4 R^2."""
    normal = numpy.array([numpy.sin(slope), 0.0, numpy.cos(slope)])
    downhill, pressure = numpy.array([numpy.cos(slope), 0.0, -numpy.sin(slope)]), GRAVITY * numpy.cos(slope)

    def rate(_time, state):
        slip = state[3:6] + numpy.cross(state[6:9], -RADIUS * normal)
        push = -FRICTION * pressure * slip / numpy.linalg.norm(slip)
        return [
            *state[3:6],
            *(push + GRAVITY * numpy.sin(slope) * downhill),
            *(numpy.cross(-RADIUS * normal, push) / (0.4 * RADIUS**2)),
        ]

    time = 1e-3 * numpy.arange(round(1e3 * duration))
    start = numpy.concatenate([RADIUS * normal, 3.0 * downhill + [0.0, across, 0.0], numpy.zeros(3)])
    rows = solve_ivp(rate, (0.0, time[-1]), start, "DOP853", time, rtol=1e-12, atol=1e-13).y.T
    turned = Rotation.identity()
    turns = [turned.as_matrix()]
    for spin in 0.5 * (rows[1:, 6:] + rows[:-1, 6:]):
        turned = Rotation.from_rotvec(1e-3 * spin) * turned
        turns.append(turned.as_matrix())
    return BodyStates(time, rows[:, :3], numpy.array(turns), rows[:, 3:6], rows[:, 6:]), normal


def spinning_plate(spin):
    """A plate of four corners slides on level ground and spins about the vertical: each corner bears a quarter."""
    inertia = (0.2**2 + 0.3**2) / 12.0

    def rate(_time, state):
        arms = Rotation.from_rotvec([0.0, 0.0, state[2]]).apply(CORNERS)[:, :2]
        slips = state[3:5] + state[5] * numpy.stack([-arms[:, 1], arms[:, 0]], axis=1)
        pushes = -0.25 * FRICTION * GRAVITY * slips / numpy.linalg.norm(slips, axis=1)[:, None]
        moment = numpy.sum(arms[:, 0] * pushes[:, 1] - arms[:, 1] * pushes[:, 0])
        return [*state[3:], *pushes.sum(axis=0), moment / inertia]

    time = 1e-3 * numpy.arange(200)
    rows = solve_ivp(rate, (0.0, time[-1]), [0.0, 0.0, 0.3, 1.5, 0.2, spin], "DOP853", time, rtol=1e-11, atol=1e-12).y.T
    zero = numpy.zeros_like(time)
    turns = Rotation.from_rotvec(numpy.stack([zero, zero, rows[:, 2]], axis=1)).as_matrix()
    place, velocity, turning = (
        numpy.stack(columns, axis=1)
        for columns in ((rows[:, 0], rows[:, 1], zero), (rows[:, 3], rows[:, 4], zero), (zero, zero, rows[:, 5]))
    )
    return BodyStates(time, place, turns, velocity, turning)


def reported(note):
    """Whether the friction in a note is a bound, its value and its deviation."""
    match = re.search(r"friction (>= )?(\S+) ± (\S+)$", note)
    assert match, note
    return match[1] is not None, float(match[2]), float(match[3])


def told_of_plate(states, noise):
    """A motion that is a single contact has no flight, so that its words alone are asked for."""
    model = FlightModel(spatial_basis(), False, NO_WRENCH, GRAVITY)
    spread = SampleNoise(*(noise or (1e-9, 1e-9, 1e-9, 1e-9)))
    problem = IdentificationProblem(states, [], [], geometry.hull(CORNERS), geometry.plane(), model, spread, None)
    return reported(lasting_note(problem, 0, len(states.time) - 2).sentence)


@pytest.mark.parametrize("noise", NOISE.values(), ids=NOISE)
@pytest.mark.parametrize("spin", [2.0, 6.0, 12.0])
def test_corners_that_slip_apart_leave_a_bound_and_not_mu(spin, noise):
    states = spinning_plate(spin)
    states = states if noise is None else motions.noisy(states, 5, *noise)
    bound, value, deviation = told_of_plate(states, noise)
    assert bound
    assert 0.25 * FRICTION < value <= FRICTION + 3.0 * deviation


def test_corners_that_slip_alike_tell_mu():
    bound, value, _ = told_of_plate(spinning_plate(0.0), None)
    assert (bound, value) == (False, FRICTION)


@pytest.mark.parametrize("noise", NOISE.values(), ids=NOISE)
def test_a_slip_that_turns_leaves_a_bound(noise):
    states, normal = ball(slope=0.5, across=2.0)
    states = states if noise is None else motions.noisy(states, 5, *noise)
    bound, value, deviation = reported(identify(states, BALL._replace(ground=geometry.plane(normal))).contacts[0].note)
    assert bound
    assert value == pytest.approx(FRICTION, abs=3.0 * deviation + 5e-3)  # step by step it turns by little


@pytest.mark.parametrize("speed", [1e-4, 1e-3, 1e-2])
@pytest.mark.parametrize("seed", range(4))
def test_noise_does_not_raise_the_friction_of_a_straight_slide(speed, seed):
    """In 1 ms friction changes the velocity by 4 mm/s: sums of |c_t| of steps under noise are up to thrice that."""
    states = motions.noisy(ball()[0], seed, 1e-4, 1e-4, speed, speed)
    bound, value, deviation = reported(identify(states, BALL).contacts[0].note)
    assert not bound
    assert deviation < 0.02
    assert abs(value - FRICTION) < 4.0 * deviation + 5e-4  # of three digits
