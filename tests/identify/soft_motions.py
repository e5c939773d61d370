"""Motions of a body whose corners press into a soft ground, by scipy's DOP853: shares no code with the bench."""

import functools

import numpy
from scipy.integrate import solve_ivp

from contact_sim_pkg.identify.motion.states import BodyStates

GRAVITY = 9.81
CREEP = 0.01  # [m/s] of slip below which friction is linear in it


def soft_fall(mass, inertia, corners, contact, start, duration, rate, force=(0.0, 0.0, 0.0), radius=0.0):
    """Samples at `rate` [1/s] of a body that falls onto z = 0.

    Each corner pushes with `k x (1 + d x')`, never pulls, and is held back by `mu N s / sqrt(s^2 + 0.01^2)`, s its slip.
    `contact`: (k [N/m], d [s/m], mu); `start`: (position, rotation matrix, velocity, angular velocity).
    """
    stiffness, loss, friction = contact
    position, rotation, velocity, spin = (numpy.asarray(each, dtype=float) for each in start)
    momentum = rotation @ inertia @ rotation.T @ spin
    inverse, pushed = numpy.linalg.inv(inertia), numpy.asarray(force)

    def rate_of(_time, state):
        place, speed, turned, angular = state[:3], state[3:6], state[6:15].reshape(3, 3), state[15:]
        turning = turned @ inverse @ turned.T @ angular
        total, moment = mass * numpy.array([0.0, 0.0, -GRAVITY]) + pushed, numpy.zeros(3)
        for corner in corners:
            arm = turned @ corner - [0.0, 0.0, radius]
            depth = -(place[2] + arm[2])
            if depth <= 0.0:
                continue
            at = speed + numpy.cross(turning, arm)
            normal = max(0.0, stiffness * depth * (1.0 - loss * at[2]))
            slip = numpy.array([at[0], at[1], 0.0])
            pressed = numpy.array([0.0, 0.0, normal]) - friction * normal * slip / numpy.sqrt(slip @ slip + CREEP**2)
            total, moment = total + pressed, moment + numpy.cross(arm, pressed)
        skew = numpy.cross(turning, turned, axisb=0, axisc=0)
        return numpy.concatenate([speed, total / mass, skew.ravel(), moment])

    def lift(_time, state):
        return (state[2] + state[6:15].reshape(3, 3)[2] @ corners.T).min() - radius

    lift.terminal = True
    time = numpy.arange(round(duration * rate) + 1) / rate
    state, now, parts = numpy.concatenate([position, velocity, rotation.ravel(), momentum]), 0.0, []
    steps = {-1.0: 0.01, 1.0: 0.1 * numpy.sqrt(mass / stiffness)}  # in flight, in contact
    lift.direction = -1.0
    while now < time[-1]:
        wanted = time[(time > now) | (time == 0.0) & (now == 0.0)]
        found = solve_ivp(
            rate_of, (now, time[-1]), state, "DOP853", wanted, rtol=1e-10, atol=1e-12, events=lift,
            max_step=steps[lift.direction], first_step=1e-6,
        )  # fmt: skip
        parts += [found.y.T] if len(found.t) else []
        now, state = (found.t_events[0][0], found.y_events[0][0]) if found.status else (time[-1], state)
        lift.direction = -lift.direction
    rows = numpy.concatenate(parts)
    turned = rows[:, 6:15].reshape(-1, 3, 3)
    spins = numpy.einsum("nij,jk,nlk,nl->ni", turned, inverse, turned, rows[:, 15:])
    left, _, right = numpy.linalg.svd(turned)
    return BodyStates(time, rows[:, :3], left @ right, rows[:, 3:6], spins)


@functools.cache
def bouncing_square(stiffness=1e4, rate=1000.0, force=(0.0, 0.0, 0.0), duration=0.75):
    """A 1.3 kg square of 0.1 m side falls and bounces in the x-z plane; m/J = 600/m^2."""
    corners = 0.05 * numpy.array([[-1.0, 0, -1], [1, 0, -1], [-1, 0, 1], [1, 0, 1]])
    cosine, sine = numpy.cos(0.2), numpy.sin(0.2)
    turned = numpy.array([[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]])
    start = ((0.0, 0.0, 0.3), turned, (0.5, 0.0, 0.0), (0.0, 2.0, 0.0))
    return soft_fall(1.3, 1.3 / 600.0 * numpy.eye(3), corners, (stiffness, 0.3, 0.3), start, duration, rate, force)
