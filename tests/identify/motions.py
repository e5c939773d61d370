"""Exact motions of falling bodies, shared by the tests of this folder."""

import functools

import numpy
from scipy.spatial.transform import Rotation

from contact_sim_lab.identify.twins.falling_body import FallingBody, fall
from contact_sim_pkg.identify.motion.rotation import exponential
from contact_sim_pkg.identify.motion.states import BodyStates
from contact_sim_pkg.rigid.bodies.body import RigidBody, box, placed, slope
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.problem import PLANE, SPACE
from contact_sim_pkg.rigid.results import SOLVED

SIDE, MASS = 0.1, 1.3
LENGTHS = numpy.array([0.10, 0.14, 0.20])
SQUARE = 0.5 * SIDE * numpy.array([[-1.0, 0, -1], [1, 0, -1], [-1, 0, 1], [1, 0, 1]])
SPATIAL_INERTIA = numpy.diag((LENGTHS @ LENGTHS - LENGTHS**2) / 12.0)


@functools.cache
def planar(duration=0.75, force=(0.0, 0.0, 0.0), torque=(0.0, 0.0, 0.0), friction=0.3):
    """A square falls and bounces in the x-z plane; m/J = 6/s^2."""
    body = FallingBody(MASS, MASS * SIDE**2 / 6 * numpy.eye(3), SQUARE, friction, 0.6, force=force, torque=torque)
    turned = exponential(numpy.array([0.0, 0.2, 0.0]))
    return fall(body, numpy.array([0, 0, 0.3]), turned, numpy.array([0.5, 0, 0]), numpy.array([0, 2.0, 0]), duration)


@functools.cache
def spatial(duration=0.5, force=(0.0, 0.0, 0.0), torque=(0.0, 0.0, 0.0)):
    """A box falls, tumbles and bounces in space."""
    corners = 0.5 * LENGTHS * numpy.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)])
    body = FallingBody(MASS, MASS * SPATIAL_INERTIA, corners, 0.3, 0.7, force=force, torque=torque)
    turned = exponential(numpy.array([0.3, 0.2, 0.5]))
    return fall(body, numpy.array([0, 0, 0.3]), turned, numpy.array([0.5, 0.1, 0]), numpy.array([1.0, 2, 3]), duration)


@functools.cache
def coming_to_rest(rate, duration=1.0):
    """A square of 1 kg falls 0.2 m onto a corner and comes to rest by many small impacts, `rate` samples a second; by the bench."""
    load = numpy.array([0.0, -9.81, 0.0])
    corners = numpy.ascontiguousarray(SQUARE[:, [0, 2]])  # another layout is another type, compiled in a minute
    square = RigidBody(PLANE, 1.0, numpy.array([SIDE**2 / 6.0]), corners, 0.0, 0.3, 0.3, load)
    located = LocatedBody(square, slope(PLANE), placed(square, [0.0, 0.26884], [0.0, 0.0, 0.0], 0.2))
    states = resting_states(round(duration * rate) + 1, rate)
    for place in range(len(states.time)):
        at = located.motion
        states.position[place, [0, 2]], states.velocity[place, [0, 2]] = at.position, at.velocity[:2]
        states.angular_velocity[place, 1] = -at.velocity[2]
        states.rotation[numpy.ix_([place], [0, 2], [0, 2])] = at.rotation
        assert located.advance(1.0 / rate) == SOLVED
    return states


@functools.cache
def random_box(seed, rate, duration=1.2):
    """A box of random sides, friction and restitution tumbles to rest, by the bench; its states, sides and I0/m."""
    random = numpy.random.default_rng(seed)
    sides = random.uniform(0.05, 0.3, 3)
    body = box(tuple(sides), 1.0, random.uniform(0.1, 1.0), random.uniform(0.0, 0.7))
    height, speed, spin = random.uniform(0.3, 0.5), random.uniform(-1.0, 1.0, 2), random.uniform(-6.0, 6.0, 3)
    turned = Rotation.random(random_state=seed).as_matrix()
    located = LocatedBody(body, slope(SPACE), placed(body, [0.0, 0.0, height], [*speed, 0.0, *spin], rotation=turned))
    states = resting_states(round(duration * rate) + 1, rate)
    for place in range(len(states.time)):
        at = located.motion
        states.position[place], states.rotation[place] = at.position, numpy.reshape(at.rotation, (3, 3))
        states.velocity[place], states.angular_velocity[place] = at.velocity[:3], at.velocity[3:]
        assert located.advance(1.0 / rate) == SOLVED
    return states, sides, body.inertia


def resting_states(count, rate):
    """States to be filled in."""
    nothing = numpy.zeros((3, count, 3))
    return BodyStates(
        numpy.arange(count) / rate, nothing[0], numpy.tile(numpy.eye(3), (count, 1, 1)), nothing[1], nothing[2]
    )


def states_of(record, end=None):
    """The samples of a record, up to the instant `end`."""
    kept = slice(None) if end is None else slice(0, int(numpy.searchsorted(record.time, end)))
    return BodyStates(*(field[kept] for field in record[:5]))


def noisy(states, seed, position=0.0, rotation=0.0, velocity=1e-3, spin=1e-2):
    """States with Gaussian noise on every component."""
    draw = functools.partial(numpy.random.default_rng(seed).normal, size=states.position.shape)
    return BodyStates(
        states.time,
        states.position + position * draw(),
        exponential(rotation * draw()) @ states.rotation,
        states.velocity + velocity * draw(),
        states.angular_velocity + spin * draw(),
    )
