"""Rotations as matrices that take body axes to world axes."""

from __future__ import annotations

import numpy
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

__all__ = ["Array", "angular_inertia", "cross_matrix", "exponential", "from_quaternion", "logarithm", "mean"]

Array = NDArray[numpy.float64]


def cross_matrix(vector: Array) -> Array:
    """`[v]` with `[v] w = v x w`, for vectors [..., 3]: [..., 3, 3]."""
    x, y, z = numpy.moveaxis(numpy.asarray(vector), -1, 0)
    zero = numpy.zeros_like(x)
    rows = ((zero, -z, y), (z, zero, -x), (-y, x, zero))
    return numpy.stack([numpy.stack(row, axis=-1) for row in rows], axis=-2)


def exponential(vector: Array) -> Array:
    """Rotations by the rotation vectors [..., 3] in [rad]: [..., 3, 3]."""
    vectors = numpy.asarray(vector, dtype=numpy.float64)
    matrices: Array = Rotation.from_rotvec(vectors.reshape(-1, 3)).as_matrix()
    return matrices.reshape(*vectors.shape, 3)


def logarithm(matrix: Array) -> Array:
    """Rotation vectors in [rad], at most pi long, of rotations [..., 3, 3]: [..., 3]."""
    vectors: Array = Rotation.from_matrix(matrix.reshape(-1, 3, 3)).as_rotvec()
    return vectors.reshape(matrix.shape[:-1])


def from_quaternion(quaternion: Array) -> Array:
    """Rotations of quaternions [..., 4] in the order w, x, y, z; they need not be of length 1."""
    quaternions = numpy.asarray(quaternion, dtype=numpy.float64)
    scalar_last = numpy.roll(quaternions.reshape(-1, 4), -1, axis=1)
    matrices: Array = Rotation.from_quat(scalar_last).as_matrix()
    return matrices.reshape(*quaternions.shape[:-1], 3, 3)


def mean(first: Array, second: Array) -> Array:
    """The rotation half-way from the first [3, 3] to the second."""
    half: Array = exponential(0.5 * logarithm(second @ first.T)) @ first
    return half


def angular_inertia(rotation: Array, inertia: Array) -> Array:
    """`R S R^T`: an inertia given in body axes, in world axes."""
    turned: Array = rotation @ inertia @ rotation.T
    return turned
