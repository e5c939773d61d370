"""Balance of angular momentum over one contact, divided by the mass, and its derivatives.

`f = A2 w2 - A1 w1 - r x pi - h kappa tau`, A = R S R^T, `pi = v2 - v1 + h g z - h kappa F` the
contact's impulse over the mass, r from the centre of mass to the contact. Impact: h = 0. Lasting
contact: one step of length h; R1 and R2 are half a step before and after the mean rotation. A
contact that lasts over several samples takes both rotations as they are and the moment of its
impulses from `identify/problem.py`: `f = A2 w2 - A1 w1 - r2 x pi + int r' x pi dt - h kappa tau`.
Source: Identifiability, eqs 19-31 and 39, corrected: linear in S and kappa.

The combinations of parameters that measurements identify: singular values of the whitened,
scaled regressor.

Source: Golub and Van Loan, Matrix Computations, 5.5.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.motion.flight import FlightModel, FlightState
from contact_sim_pkg.identify.motion.geometry import UP, GroundPlane, Shape, arm
from contact_sim_pkg.identify.motion.rotation import Array, angular_inertia, cross_matrix, exponential, mean
from contact_sim_pkg.identify.problem import ImpulseMoment

__all__ = ["Balance", "Side", "Split", "balance", "impulse", "lasting_balance", "split"]


class Side(NamedTuple):
    """The motion at one end of a contact, and its derivatives by the flight's state and by the
    parameters.
    """

    state: FlightState
    by_state: Array  # [12, 12], or [12, k] by any other k numbers
    by_parameters: Array  # [12, p]


class Balance(NamedTuple):
    """What is left of the balance, and its derivatives."""

    value: Array  # [3], [m^2/s]
    by_before: Array  # [3, 12]
    by_after: Array  # [3, 12]
    by_parameters: Array  # [3, p]


def impulse(before: FlightState, after: FlightState, inverse_mass: float, model: FlightModel) -> Array:
    """pi: impulse of the contact over the mass, [x, y, z] in [m/s]; inverse_mass: [1/kg]."""
    passed = after.time - before.time
    free = passed * model.gravity * UP - inverse_mass * model.wrench.push(before.time, after.time)
    return numpy.asarray(after.velocity - before.velocity + free)


def balance(
    before: Side, after: Side, parameters: Array, model: FlightModel, shape: Shape, ground: GroundPlane, point: int
) -> Balance:
    """The balance of one contact at `point` of the shape; parameters: [parameters].

    Value: [3] in [m^2/s]; derivatives by the states before and after [3, 12], by the parameters [3,
    parameters].
    """
    first, second = before.state, after.state
    inertia, inverse_mass = model.inertia(parameters), model.inverse_mass(parameters)
    # Orientation in the middle of the step, and the rotations half a step before and after it
    middle = mean(first.rotation, second.rotation)
    half = 0.25 * (second.time - first.time) * (first.angular_velocity + second.angular_velocity)
    turned = [exponential(-half) @ middle, exponential(half) @ middle]
    inertias = [angular_inertia(rotation, inertia) for rotation in turned]
    spins = (first.angular_velocity, second.angular_velocity)
    push = impulse(first, second, inverse_mass, model)
    reach = arm(shape, ground, middle, point)
    twist = model.wrench.twist(first.time, second.time)
    value = inertias[1] @ spins[1] - inertias[0] @ spins[0] - numpy.cross(reach, push) - inverse_mass * twist
    # Derivatives: by both states, then by the parameters, directly and through the states
    locals_ = _by_motion(inertias, spins, push, middle @ shape.points[point], reach)
    direct = numpy.zeros((3, model.unknowns))
    for place, part in enumerate(model.basis):
        direct[:, place] = angular_inertia(turned[1], part) @ spins[1] - angular_inertia(turned[0], part) @ spins[0]
    if model.with_mass:
        direct[:, -1] = numpy.cross(reach, model.wrench.push(first.time, second.time)) - twist
    by_parameters = direct + locals_[0] @ before.by_parameters + locals_[1] @ after.by_parameters
    return Balance(value, locals_[0] @ before.by_state, locals_[1] @ after.by_state, by_parameters)


def lasting_balance(
    before: Side,
    after: Side,
    parameters: Array,
    model: FlightModel,
    shape: Shape,
    ground: GroundPlane,
    point: int,
    swept: ImpulseMoment,
) -> Balance:
    """The balance of one contact at `point` that lasts from `before` to `after`; parameters:
    [parameters].

    Value: [3] in [m^2/s]; derivatives by the states before and after [3, 12], by the parameters [3,
    parameters].
    """
    first, second = before.state, after.state
    inertia, inverse_mass = model.inertia(parameters), model.inverse_mass(parameters)
    inertias = [angular_inertia(state.rotation, inertia) for state in (first, second)]
    spins = (first.angular_velocity, second.angular_velocity)
    reaches = [arm(shape, ground, state.rotation, point) for state in (first, second)]
    push, twist = impulse(first, second, inverse_mass, model), model.wrench.twist(first.time, second.time)
    late = numpy.cross(reaches[1] - reaches[0], first.velocity - swept.velocity)
    rest = swept.moment - inverse_mass * (swept.by_inverse_mass + twist) - late
    value = inertias[1] @ spins[1] - inertias[0] @ spins[0] - numpy.cross(reaches[1], push) + rest
    direct = numpy.zeros((3, model.unknowns))
    for place, part in enumerate(model.basis):
        turned = [angular_inertia(state.rotation, part) @ state.angular_velocity for state in (first, second)]
        direct[:, place] = turned[1] - turned[0]
    if model.with_mass:
        pushed = model.wrench.push(first.time, second.time)
        direct[:, -1] = numpy.cross(reaches[1], pushed) - swept.by_inverse_mass - twist
    lever = second.rotation @ shape.points[point]
    turnings = [numpy.zeros((3, 3)), cross_matrix(push) @ -cross_matrix(lever)]
    blocks = [
        _of_motion(sign, inertias[k], spins[k], reaches[k], turnings[k]) for k, sign in enumerate((-1.0, 1.0))
    ]  # fmt: skip
    by_parameters = direct + blocks[0] @ before.by_parameters + blocks[1] @ after.by_parameters
    return Balance(value, blocks[0] @ before.by_state, blocks[1] @ after.by_state, by_parameters)


def _of_motion(sign: float, inertia: Array, spin: Array, reach: Array, turning: Array) -> Array:
    """Derivative [3, 12] by the motion at one end, whose angular momentum and impulse count
    `sign`.
    """
    block = numpy.zeros((3, 12))
    block[:, 3:6] = -sign * cross_matrix(reach)
    block[:, 6:9] = turning + sign * (inertia @ cross_matrix(spin) - cross_matrix(inertia @ spin))
    block[:, 9:] = sign * inertia
    return block


def _by_motion(
    inertias: list[Array], spins: tuple[Array, Array], push: Array, lever: Array, reach: Array
) -> tuple[Array, Array]:
    """Derivatives [3, 12] by the motion before and after; a small rotation of either turns the mean
    by half of it.
    """
    turning = cross_matrix(push) @ -cross_matrix(lever)
    for sign, inertia, spin in ((-1.0, inertias[0], spins[0]), (1.0, inertias[1], spins[1])):
        turning = turning + sign * (inertia @ cross_matrix(spin) - cross_matrix(inertia @ spin))
    found = []
    for sign, inertia in ((-1.0, inertias[0]), (1.0, inertias[1])):
        block = numpy.zeros((3, 12))
        block[:, 3:6] = -sign * cross_matrix(reach)
        block[:, 6:9] = 0.5 * turning
        block[:, 9:] = sign * inertia
        found.append(block)
    return found[0], found[1]


SMALLEST = 1e-8  # of the largest singular value


class Split(NamedTuple):
    """Orthonormal directions in parameters over their sizes."""

    identified: Array  # [rank, p]
    values: Array  # [rank]; 1 / value is the standard deviation along the direction, in sizes of the parameters
    left: Array  # [rows, rank]
    missing: Array  # [p - rank, p]

    @property
    def rank(self) -> int:
        """Number of identified directions."""
        return len(self.values)


def split(regressor: Array, *, with_mass: bool) -> Split:
    """Directions that are identified and those that are not.

    A direction counts as identified where its singular value is above 1e-8 of the largest, and its
    standard deviation (one over the singular value) below the size of the parameters. The largest
    is that of its own kind: inertia and 1/m are brought to one size first, since exact velocities
    may identify the mass 1e8 times better than rounded rotations the inertia. That is allowed, for
    the rounding of a QR decomposition is that of each column.

    Args:
        regressor: [rows, p], each row of unit noise, each column times the size of its parameter.
        with_mass: whether the last column is that of 1/m.
    """
    rows, count = regressor.shape
    if rows < count:
        regressor = numpy.concatenate([regressor, numpy.zeros((count - rows, count))])
    # Columns brought to one size, those without information apart
    visible, hidden = _separated(regressor, _kinds(regressor, with_mass))
    left, values, right = numpy.linalg.svd(regressor @ visible.T, full_matrices=False)
    # Rows have unit noise: a singular value above 1 is a deviation below the size
    directions, kept = right @ visible, values > 1.0
    return Split(directions[kept], values[kept], left[:rows, kept], numpy.concatenate([directions[~kept], hidden]))


def _kinds(regressor: Array, with_mass: bool) -> Array:
    """Norm of the columns of inertia, and of that of 1/m, [p]; 1 where they are empty."""
    sizes = numpy.full(regressor.shape[1], float(numpy.linalg.norm(regressor[:, : -1 if with_mass else None])))
    if with_mass:
        sizes[-1] = float(numpy.linalg.norm(regressor[:, -1]))
    return numpy.where(sizes > 0.0, sizes, 1.0)


def _separated(regressor: Array, sizes: Array) -> tuple[Array, Array]:
    """Orthonormal directions that the columns over their `sizes` determine, and the others,
    rows.
    """
    _, values, right = numpy.linalg.svd(regressor / sizes, full_matrices=False)
    silent = right[values <= SMALLEST * float(values.max(initial=0.0))] / sizes
    whole, _ = numpy.linalg.qr(silent.T, mode="complete")
    return whole[:, len(silent) :].T, whole[:, : len(silent)].T
