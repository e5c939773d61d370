"""Exact motions of falling bodies, shared by the tests of this folder."""

import functools

import numpy

from contact_sim_pkg.identification.rotation import exponential
from contact_sim_pkg.identification.states import BodyStates
from contact_sim_pkg.reference.falling_body import FallingBody, fall

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
