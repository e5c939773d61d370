"""Rotation of a free rigid body: `S W' + W x S W = kappa R^T tau`, `R' = R [W]`, in body axes.

S = I0/m and kappa = 1/m. Solved by Picard iteration on Chebyshev nodes over segments in which the
body turns by half a radian: errors of rounding size, and many copies with perturbed starts or
parameters at once.

Source: Identifiability eq 4, corrected (Euler's equation).

One flight: state at its first sample, its motion at any time, and how that depends on state and
parameters.

State: (position, velocity, rotation, angular velocity) in world axes; a change of it is 12 numbers
(dx, dv, small rotation in world axes, dw). Parameters p: I0/m = sum p_i E_i, then 1/m where a
wrench is known.

Source: Identifiability eqs 4 and 39.
"""

from __future__ import annotations

import itertools
from functools import cache
from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.motion.geometry import UP
from contact_sim_pkg.identify.motion.rotation import Array, exponential, logarithm
from contact_sim_pkg.identify.motion.wrench import ExternalWrench

__all__ = [
    "FlightModel",
    "FlightMotion",
    "FlightState",
    "motion",
    "moved",
    "plain_motion",
    "rates",
    "spin_rate",
    "state_at",
    "turn",
]


NODES = 20
SEGMENT_ROTATION = 0.5  # [rad]
SWEEPS = 60
STEADY = 4e-16  # change of a sweep that ends the iteration, relative


def turn(
    rotation: Array,
    angular_velocity: Array,
    inertia: Array,
    inverse_mass: Array,
    wrench: ExternalWrench,
    begin: float,
    times: Array,
) -> tuple[Array, Array]:
    """Rotations and angular velocities of copies of a body.

    Args:
        rotation: at `begin`, [c, 3, 3], body to world.
        angular_velocity: at `begin`, [c, 3] in [rad/s], world axes.
        inertia: S of each copy, [c, 3, 3] in [m^2], body axes.
        inverse_mass: kappa of each copy, [c] in [1/kg].
        wrench: whose torque turns it.
        begin: [s].
        times: [n] in [s], growing; before or after `begin`.

    Returns:
        Rotations [c, n, 3, 3] and angular velocities [c, n, 3] in world axes.
    """
    if wrench.torque is None and not numpy.ptp(inertia - inertia[:, :1, :1] * numpy.eye(3)):
        vectors = (times - begin)[None, :, None] * angular_velocity[:, None, :]
        return exponential(vectors) @ rotation[:, None], numpy.broadcast_to(angular_velocity[:, None], vectors.shape)
    # In body axes, as quaternion and spin; times before and after the start apart
    spin = numpy.einsum("cji,cj->ci", rotation, angular_velocity)
    start = numpy.concatenate([_quaternion(rotation), spin], axis=1)
    model: _Model = (inertia, numpy.asarray(numpy.linalg.inv(inertia)), inverse_mass, wrench)
    found = numpy.empty((len(rotation), len(times), 7))
    for side in (times >= begin, times < begin):
        if side.any():
            found[:, side] = _states_along(start, begin, times[side], model)
    matrices = _matrix(found[..., :4])
    return matrices, numpy.einsum("cnij,cnj->cni", matrices, found[..., 4:])


def spin_rate(rotation: Array, angular_velocity: Array, inertia: Array, moment: Array) -> Array:
    """`w' = R S^-1 (R^T k - W x S W)`, W = R^T w, of one body: [x, y, z] in [rad/s^2], world axes.

    `moment` is k = kappa tau, torque over mass, [x, y, z] in [m^2/s^2], world axes; `w' = R W'`
    since `w x w = 0`. rotation, inertia: [3, 3].
    """
    spin, own = rotation.T @ angular_velocity, rotation.T @ moment
    return rotation @ numpy.linalg.solve(inertia, own - numpy.cross(spin, inertia @ spin))


_Model = tuple[Array, Array, Array, ExternalWrench]


def _states_along(start: Array, begin: float, times: Array, model: _Model) -> Array:
    """States [c, n, 7] at times on one side of `begin`, segment by segment."""
    forward = bool(times[-1] >= begin)
    end = float(times[-1] if forward else times[0])
    fastest = float(numpy.linalg.norm(start[:, 4:], axis=1).max()) + 1.0
    count = max(1, int(numpy.ceil(abs(end - begin) * fastest / SEGMENT_ROTATION)))
    edges = begin + (end - begin) * numpy.arange(count + 1) / count
    edges[-1] = end
    found = numpy.empty((len(start), len(times), 7))
    done = numpy.zeros(len(times), dtype=bool)
    for low, high in itertools.pairwise(edges):
        # Solved on the nodes of the segment, then interpolated to the times inside
        values = _segment(start, low, high, model)
        inside = ~done & ((times <= high) if forward else (times >= high))
        if inside.any():
            place = (2.0 * times[inside] - low - high) / (high - low) if high != low else numpy.full(inside.sum(), -1.0)
            weights = numpy.polynomial.chebyshev.chebvander(place, NODES - 1) @ _basis()[1]
            found[:, inside] = numpy.einsum("tn,cnk->ctk", weights, values)
        done |= inside
        start = values[:, -1]
    return found


def _segment(start: Array, low: float, high: float, model: _Model) -> Array:
    """Values at the nodes, [c, NODES, 7], the first at `low` and the last at `high`."""
    nodes, _, integrals = _basis()
    times = low + 0.5 * (high - low) * (nodes + 1.0)
    values = numpy.repeat(start[:, None], NODES, axis=1)
    for _ in range(SWEEPS):
        rates = _rate(values, times, model)
        new = start[:, None] + 0.5 * (high - low) * numpy.einsum("mn,cnk->cmk", integrals, rates)
        change = abs(new - values).max() / max(1.0, abs(new).max())
        values = new
        if change <= STEADY:
            break
    values[..., :4] /= numpy.linalg.norm(values[..., :4], axis=-1, keepdims=True)
    return values


def _rate(values: Array, times: Array, model: _Model) -> Array:
    inertia, inverse, inverse_mass, wrench = model
    quaternion, spin = values[..., :4], values[..., 4:]
    moment = -numpy.cross(spin, numpy.einsum("cij,cnj->cni", inertia, spin))
    if wrench.torque is not None:
        torque = numpy.einsum("cnji,nj->cni", _matrix(quaternion), wrench.torque_at(times))
        moment = moment + inverse_mass[:, None, None] * torque
    scalar, vector = quaternion[..., :1], quaternion[..., 1:]
    turned = 0.5 * (scalar * spin + numpy.cross(vector, spin))
    slowed = -0.5 * numpy.sum(vector * spin, axis=-1, keepdims=True)
    return numpy.concatenate([slowed, turned, numpy.einsum("cij,cnj->cni", inverse, moment)], axis=-1)


@cache
def _basis() -> tuple[Array, Array, Array]:
    """Chebyshev nodes from -1 to 1; values at the nodes to coefficients; values to integrals from
    -1 to each node.
    """
    nodes = -numpy.cos(numpy.pi * numpy.arange(NODES) / (NODES - 1))
    chebyshev = numpy.polynomial.chebyshev
    coefficients: Array = numpy.linalg.inv(chebyshev.chebvander(nodes, NODES - 1)).astype(float)
    primitive = numpy.stack([chebyshev.chebint(row, lbnd=-1) for row in numpy.eye(NODES)], axis=1)
    integrals = chebyshev.chebvander(nodes, NODES) @ primitive @ coefficients
    integrals[0] = 0.0
    return nodes, coefficients, integrals


def _matrix(quaternion: Array) -> Array:
    """Rotations [..., 3, 3] of quaternions [..., 4], w first, of any length."""
    w, x, y, z = numpy.moveaxis(quaternion, -1, 0) / numpy.linalg.norm(quaternion, axis=-1)
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )
    return numpy.stack([numpy.stack(row, axis=-1) for row in rows], axis=-2)


def _quaternion(rotation: Array) -> Array:
    from scipy.spatial.transform import Rotation

    return numpy.roll(Rotation.from_matrix(rotation).as_quat(), 1, axis=-1)


STEP = 3e-6  # of the central differences, in [rad] and relative: errors of 1e-10, below the threshold of the rank test


class FlightModel(NamedTuple):
    """What a flight needs besides its state."""

    basis: Array  # E_i, [q, 3, 3]
    with_mass: bool  # 1/m is the last parameter
    wrench: ExternalWrench
    gravity: float  # [m/s^2]

    @property
    def unknowns(self) -> int:
        """Number of parameters."""
        return len(self.basis) + self.with_mass

    def inertia(self, parameters: Array) -> Array:
        """S = I0/m [3, 3] in [m^2], body axes."""
        inertia: Array = numpy.einsum("i,ijk->jk", parameters[: len(self.basis)], self.basis)
        return inertia

    def inverse_mass(self, parameters: Array) -> float:
        """1/m in [1/kg]; 0 where there is no wrench that could identify it."""
        return float(parameters[-1]) if self.with_mass else 0.0


class FlightState(NamedTuple):
    """State of the body at `time`, in world axes."""

    time: float  # [s]
    position: Array  # [3]
    velocity: Array  # [3]
    rotation: Array  # [3, 3]
    angular_velocity: Array  # [3]


class FlightMotion(NamedTuple):
    """Motion at n instants and its derivatives, rows in the order dx, dv, rotation, dw."""

    position: Array  # [n, 3]
    velocity: Array  # [n, 3]
    rotation: Array  # [n, 3, 3]
    angular_velocity: Array  # [n, 3]
    by_state: Array  # [n, 12, 12]
    by_parameters: Array  # [n, 12, p]


def moved(state: FlightState, change: Array) -> FlightState:
    """The state after a change [changes] of 12 numbers (dx, dv, small rotation, dw) in [m], [m/s],
    [rad], [rad/s]."""
    rotation = exponential(change[6:9]) @ state.rotation
    return FlightState(
        state.time, state.position + change[:3], state.velocity + change[3:6], rotation,
        state.angular_velocity + change[9:],
    )  # fmt: skip


def plain_motion(
    state: FlightState, parameters: Array, model: FlightModel, times: Array
) -> tuple[Array, Array, Array, Array]:
    """Position, velocity, angular velocity [times, 3] and rotation [times, 3, 3] at the times [s],
    without derivatives.

    Returned in the order position, velocity, rotation, angular velocity; parameters: [parameters].
    """
    position, velocity = _path(state, model.inverse_mass(parameters), model, times)
    rotation, angular_velocity = turn(
        state.rotation[None], state.angular_velocity[None], model.inertia(parameters)[None],
        numpy.array([model.inverse_mass(parameters)]), model.wrench, state.time, times,
    )  # fmt: skip
    return position, velocity, rotation[0], angular_velocity[0]


def state_at(state: FlightState, parameters: Array, model: FlightModel, time: float) -> FlightState:
    """The state of a flight at another time [s]; parameters: [parameters]."""
    position, velocity, rotation, spin = plain_motion(state, parameters, model, numpy.array([time]))
    return FlightState(time, position[0], velocity[0], rotation[0], spin[0])


def rates(state: FlightState, parameters: Array, model: FlightModel) -> Array:
    """Rates of a flight at its state: (v, kappa F - g z, w, w'), [changes] per [s], in the order of
    a change; parameters: [parameters]."""
    wrench, inverse_mass, at = model.wrench, model.inverse_mass(parameters), numpy.array([state.time])
    force = numpy.zeros(3) if wrench.force is None else numpy.asarray(wrench.force.value(at))[0]
    moment = inverse_mass * wrench.torque_at(at)[0]
    turning = spin_rate(state.rotation, state.angular_velocity, model.inertia(parameters), moment)
    fall = inverse_mass * force - model.gravity * UP
    return numpy.concatenate([state.velocity, fall, state.angular_velocity, turning])


def motion(state: FlightState, parameters: Array, scale: Array, model: FlightModel, times: Array) -> FlightMotion:
    """Motion at the times [times] [s] and its derivatives; scale: size of each parameter,
    [parameters]."""
    if not (times != state.time).any():
        return _standing(state, model, len(times))
    position, velocity = _path(state, model.inverse_mass(parameters), model, times)
    rotation, angular_velocity, steps = _copies(state, parameters, scale, model, times)
    count = len(steps)
    ahead, behind = slice(1, 1 + count), slice(1 + count, 1 + 2 * count)
    turned = logarithm(rotation[ahead] @ numpy.swapaxes(rotation[behind], -1, -2)) / (2.0 * steps[:, None, None])
    spun = (angular_velocity[ahead] - angular_velocity[behind]) / (2.0 * steps[:, None, None])
    by_all = numpy.concatenate([turned, spun], axis=2).transpose(1, 2, 0)  # [n, 6, 6 + p]
    samples = len(times)
    by_state, by_parameters = numpy.zeros((samples, 12, 12)), numpy.zeros((samples, 12, model.unknowns))
    by_state[:, :6, :6] = numpy.eye(6)
    by_state[:, :3, 3:6] = (times - state.time)[:, None, None] * numpy.eye(3)
    by_state[:, 6:, 6:] = by_all[:, :, :6]
    by_parameters[:, 6:] = _without_size(by_all[:, :, 6:], parameters, scale, model)
    if model.with_mass:
        by_parameters[:, :3, -1] = model.wrench.shift(state.time, times)
        by_parameters[:, 3:6, -1] = model.wrench.push(state.time, times)
    return FlightMotion(position, velocity, rotation[0], angular_velocity[0], by_state, by_parameters)


def _without_size(turning: Array, parameters: Array, scale: Array, model: FlightModel) -> Array:
    """Derivatives of rotation and spin [n, 6, p] by the parameters: the sizes of I0 and m together
    leave the turn as it is.

    By Euler's theorem `sum p_i d/dp_i = 0`, without a torque for I0/m alone: what rounding leaves
    of that is taken out, as it would identify a size that no flight identifies.
    """
    ray: Array = parameters.copy()
    if model.wrench.torque is None:
        ray[len(model.basis) :] = 0.0
        turning[:, :, len(model.basis) :] = 0.0
    weights = ray / scale**2
    return numpy.asarray(turning - (turning @ ray)[..., None] * weights / (ray @ weights))


def _standing(state: FlightState, model: FlightModel, samples: int) -> FlightMotion:
    """The state itself, for flights of a single instant."""
    fields = [numpy.repeat(field[None], samples, axis=0) for field in state[1:]]
    position, velocity, rotation, angular_velocity = fields
    by_state = numpy.repeat(numpy.eye(12)[None], samples, axis=0)
    return FlightMotion(
        position, velocity, rotation, angular_velocity, by_state, numpy.zeros((samples, 12, model.unknowns))
    )


def _path(state: FlightState, inverse_mass: float, model: FlightModel, times: Array) -> tuple[Array, Array]:
    """Position and velocity of the centre of mass under gravity and the known force."""
    passed = (times - state.time)[:, None]
    fall = model.gravity * UP
    velocity = state.velocity - passed * fall + inverse_mass * model.wrench.push(state.time, times)
    way = state.position + passed * state.velocity - 0.5 * passed**2 * fall
    return way + inverse_mass * model.wrench.shift(state.time, times), velocity


def _copies(
    state: FlightState, parameters: Array, scale: Array, model: FlightModel, times: Array
) -> tuple[Array, Array, Array]:
    """The motion, then its 6 + p copies perturbed ahead, then behind; and the size of each
    perturbation.
    """
    speed = STEP * max(1.0, float(numpy.linalg.norm(state.angular_velocity)))
    steps = numpy.concatenate([numpy.full(3, STEP), numpy.full(3, speed), STEP * scale])
    moves = numpy.concatenate([numpy.zeros((1, len(steps))), numpy.diag(steps), -numpy.diag(steps)])
    rotation = exponential(moves[:, :3]) @ state.rotation
    angular_velocity = state.angular_velocity + moves[:, 3:6]
    points = parameters + moves[:, 6:]
    inertia = numpy.stack([model.inertia(point) for point in points])
    inverse_mass = numpy.array([model.inverse_mass(point) for point in points])
    return *turn(rotation, angular_velocity, inertia, inverse_mass, model.wrench, state.time, times), steps
