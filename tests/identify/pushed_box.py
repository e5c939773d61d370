"""Exact motion of a box that is pushed by a force fixed in its own axes, falls, tumbles and bounces without friction."""

import functools
import itertools

import numpy
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from contact_sim_pkg.identify.motion.states import BodyStates

MASS, LENGTHS = 1.3, numpy.array([0.10, 0.14, 0.20])
INERTIA = MASS * (LENGTHS @ LENGTHS - LENGTHS**2) / 12.0  # principal, body axes
CORNERS = 0.5 * LENGTHS * numpy.array(list(itertools.product((-1, 1), repeat=3)))
FORCE = numpy.array([3.0, -2.0, 1.5])  # [N], body axes
GRAVITY, RESTITUTION = 9.81, 0.7
START = numpy.array([0.0, 0.0, 0.3, 0.5, 0.1, 0.0, 0.3, 0.2, 0.5, 0.8, 1.0, 4.0, 3.0])


def _turn(state):
    return Rotation.from_quat(state[6:10] / numpy.linalg.norm(state[6:10]))


def _rate(_, state):
    """Newton's and Euler's equations; the state is place, velocity, quaternion (scalar last), spin in body axes."""
    spin, vector, scalar = state[10:], state[6:9], state[9]
    quaternion = 0.5 * numpy.append(scalar * spin + numpy.cross(vector, spin), -vector @ spin)
    fall = _turn(state).apply(FORCE) / MASS - [0.0, 0.0, GRAVITY]
    return numpy.concatenate([state[3:6], fall, quaternion, -numpy.cross(spin, INERTIA * spin) / INERTIA])


def _height(_, state):
    return float((state[2] + _turn(state).apply(CORNERS)[:, 2]).min())


_height.terminal, _height.direction = True, -1.0


def _bounced(state):
    """The normal speed of the lowest corner is turned around: Newton's restitution, no friction."""
    turn, after = _turn(state), state.copy()
    arm = CORNERS[turn.apply(CORNERS)[:, 2].argmin()]
    normal = turn.inv().apply([0.0, 0.0, 1.0])
    lever = numpy.cross(arm, normal)
    speed = state[5] + lever @ state[10:]
    impulse = -(1.0 + RESTITUTION) * speed / (1.0 / MASS + lever @ (lever / INERTIA))
    after[5] += impulse / MASS
    after[10:] += impulse * lever / INERTIA
    return after


@functools.cache
def motion(duration=0.5, rate=1000.0):
    """States at `rate` [1/s]."""
    times, rows, now, state = numpy.arange(round(duration * rate) + 1) / rate, [], 0.0, START
    while now < times[-1]:
        found = solve_ivp(
            _rate, (now, times[-1]), state, "DOP853", rtol=1e-12, atol=1e-14, events=_height, dense_output=True,
            max_step=0.004, first_step=1e-6,
        )  # fmt: skip
        now = found.t[-1]
        rows += list(found.sol(times[len(rows) : numpy.searchsorted(times, now)]).T)
        state = _bounced(found.y[:, -1])
    rows = numpy.array([*rows, found.y[:, -1]])
    turns = Rotation.from_quat(rows[:, 6:10])
    return BodyStates(times, rows[:, :3], turns.as_matrix(), rows[:, 3:6], turns.apply(rows[:, 10:]))
