"""One flight: state at its first sample, its motion at any time, and how that depends on state and
parameters.

State: (position, velocity, rotation, angular velocity) in world axes; a change of it is 12 numbers
(dx, dv, small rotation in world axes, dw). Parameters p: I0/m = sum p_i E_i, then 1/m where a
wrench is known.

Source: Identifiability eqs 4 and 39.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.contact.wrench import ExternalWrench
from contact_sim_pkg.identify.geometry import UP
from contact_sim_pkg.identify.motion.rotation import Array, exponential, logarithm
from contact_sim_pkg.identify.motion.spin import spin_rate, turn

__all__ = ["FlightModel", "FlightMotion", "FlightState", "motion", "moved", "plain_motion", "rates", "state_at"]

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
