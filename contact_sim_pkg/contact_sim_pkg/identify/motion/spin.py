"""Rotation of a free rigid body: `S W' + W x S W = kappa R^T tau`, `R' = R [W]`, in body axes.

S = I0/m and kappa = 1/m. Solved by Picard iteration on Chebyshev nodes over segments in which the
body turns by half a radian: errors of rounding size, and many copies with perturbed starts or
parameters at once.

Source: Identifiability eq 4, corrected (Euler's equation).
"""

from __future__ import annotations

import itertools
from functools import cache

import numpy

from contact_sim_pkg.identify.contact.wrench import ExternalWrench
from contact_sim_pkg.identify.motion.rotation import Array, exponential

__all__ = ["spin_rate", "turn"]

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
