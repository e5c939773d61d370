"""Motion of a rigid body that falls and bounces on the plane z = 0, written in another way than the
bench's own solvers.

Angular momentum in world axes is kept (`L' = tau`, `R' = [w] R`, `w = R I0^-1 R^T L`), integrated
by scipy's DOP853 with the impacts as its events; the impulse of an impact is a direct solution of
the 3 x 3 contact system (sticking) or lies on the friction cone against the slip before (sliding).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

__all__ = ["Bounce", "FallingBody", "Record", "fall"]

Array = NDArray[Any]
TOLERANCE = 1e-13
LONGEST_STEP = 0.004  # [s], so that the interpolation within a step is as exact as the step, up to some 20 rad/s
FIRST_STEP = 1e-6  # [s], so that the gap has opened before the next corner comes down
SHORTEST = 1e-6  # [s] between two impacts: the record ends before the bounces run into each other


class FallingBody(NamedTuple):
    """Body, contact law and known wrench."""

    mass: float  # [kg]
    inertia: Array  # I0, [3, 3], [kg m^2], body axes
    corners: Array  # [k, 3], [m]
    friction: float
    restitution: float
    gravity: float = 9.81  # [m/s^2]
    force: tuple[float, float, float] = (0.0, 0.0, 0.0)  # [N], world axes
    torque: tuple[float, float, float] = (0.0, 0.0, 0.0)  # [N m], world axes
    radius: float = 0.0  # [m] the hull of the corners is grown by


class Bounce(NamedTuple):
    """One impact."""

    time: float
    impulse: Array  # [3], [N s], world axes
    arm: Array  # [3], [m]
    sticks: bool


class Record(NamedTuple):
    """Samples and impacts."""

    time: Array  # [n]
    position: Array  # [n, 3]
    rotation: Array  # [n, 3, 3]
    velocity: Array  # [n, 3]
    angular_velocity: Array  # [n, 3]
    bounces: list[Bounce]


def fall(
    body: FallingBody,
    position: Array,
    rotation: Array,
    velocity: Array,
    angular_velocity: Array,
    duration: float,
    rate: float = 1000.0,
    most: int = 1000,
) -> Record:
    """Samples [samples, 3] and [samples, 3, 3] at `rate` [1/s] from 0 to `duration` [s], or to the
    impact after the `most`-th.

    The start is above the ground. The record ends early where two impacts follow each other within
    1e-6 s.
    """
    inverse = numpy.linalg.inv(body.inertia)
    momentum = rotation @ body.inertia @ rotation.T @ angular_velocity
    state = numpy.concatenate([position, velocity, rotation.ravel(), momentum])
    times = numpy.arange(round(duration * rate) + 1) / rate
    rows: list[tuple[Array, Array, Array, Array]] = []
    bounces: list[Bounce] = []
    now = 0.0

    def height(_: float, at: Array) -> float:
        return float((at[2] + at[6:15].reshape(3, 3)[2] @ body.corners.T).min() - body.radius)

    touch: Any = height
    touch.terminal, touch.direction = True, -1.0
    # One flight and one impact after the other
    while True:
        found = _flight(body, inverse, state, now, times[-1], touch)
        end, state = float(found.t[-1]), found.y[:, -1]
        within = times[(times >= now) & (times < end)] if found.status == 1 else times[times >= now]
        rows += [_at(body, inverse, found.sol(time)) for time in within]
        if found.status != 1 or len(bounces) == most or (bounces and end - bounces[-1].time < SHORTEST):
            break
        state, bounce = _impact(body, inverse, state, end)
        bounces.append(bounce)
        now = end
    places, turns, speeds, spins = (numpy.array(column) for column in zip(*rows, strict=True))
    return Record(times[: len(rows)], places, turns, speeds, spins, bounces)


def _flight(body: FallingBody, inverse: Array, state: Array, begin: float, end: float, touch: Any) -> Any:
    def event(time: float, at: Array, *_: Any) -> float:
        return float(touch(time, at))

    mark: Any = event
    mark.terminal, mark.direction = True, -1.0
    return solve_ivp(
        _rate, (begin, end), state, "DOP853", rtol=TOLERANCE, atol=1e-14, events=mark, args=(body, inverse),
        max_step=LONGEST_STEP, first_step=min(FIRST_STEP, 0.5 * (end - begin)), dense_output=True,
    )  # fmt: skip


def _rate(_: float, state: Array, body: FallingBody, inverse: Array) -> Array:
    rotation = state[6:15].reshape(3, 3)
    spin = rotation @ inverse @ rotation.T @ state[15:]
    turned = numpy.cross(spin, rotation, axisb=0, axisc=0)
    fall_rate = numpy.array(body.force) / body.mass - numpy.array([0.0, 0.0, body.gravity])
    return numpy.concatenate([state[3:6], fall_rate, turned.ravel(), numpy.array(body.torque)])


def _at(body: FallingBody, inverse: Array, state: Array) -> tuple[Array, Array, Array, Array]:
    left, _, right = numpy.linalg.svd(state[6:15].reshape(3, 3))
    rotation = left @ right
    return state[:3].copy(), rotation, state[3:6].copy(), rotation @ inverse @ rotation.T @ state[15:]


def _impact(body: FallingBody, inverse: Array, state: Array, time: float) -> tuple[Array, Bounce]:
    """Newton's restitution along z; sticking if the impulse lies in the friction cone, else sliding
    against the slip before.
    """
    rotation = state[6:15].reshape(3, 3)
    inverse_world = rotation @ inverse @ rotation.T
    reach = rotation @ body.corners[int((rotation @ body.corners.T)[2].argmin())] - numpy.array([0.0, 0.0, body.radius])
    lever = numpy.cross(numpy.eye(3), reach).T  # lever @ w = w x r
    mobility = numpy.eye(3) / body.mass + lever @ inverse_world @ lever.T
    point = state[3:6] + lever @ (inverse_world @ state[15:])
    wanted = numpy.array([0.0, 0.0, -body.restitution * point[2]])
    impulse = numpy.linalg.solve(mobility, wanted - point)
    sticks = bool(numpy.hypot(*impulse[:2]) <= body.friction * impulse[2])
    if not sticks:
        slip = point[:2] / numpy.hypot(*point[:2])
        direction = numpy.array([-body.friction * slip[0], -body.friction * slip[1], 1.0])
        impulse = direction * (wanted[2] - point[2]) / (mobility[2] @ direction)
    after = state.copy()
    after[3:6] += impulse / body.mass
    after[15:] += numpy.cross(reach, impulse)
    return after, Bounce(time, impulse, reach, sticks)
