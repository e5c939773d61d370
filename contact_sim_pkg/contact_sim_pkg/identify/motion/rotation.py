"""Rotations as matrices that take body axes to world axes.

Source: Murray, Li and Sastry, A Mathematical Introduction to Robotic Manipulation, 2.2.
"""

from __future__ import annotations

import numpy
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

__all__ = ["Array", "angular_inertia", "cross_matrix", "exponential", "from_quaternion", "logarithm", "mean"]


Array = NDArray[numpy.float64]
LARGE = -0.4  # cosine of the largest angle taken from the antisymmetric part


def cross_matrix(vector: Array) -> Array:
    """`[v]` with `[v] w = v x w`, [3, 3]."""
    x, y, z = vector
    return numpy.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def exponential(vector: Array) -> Array:
    """Rotations by the rotation vectors [..., 3] in [rad]: [..., 3, 3]."""
    vectors = numpy.asarray(vector, dtype=numpy.float64)
    matrices: Array = Rotation.from_rotvec(vectors.reshape(-1, 3)).as_matrix()
    return matrices.reshape(*vectors.shape, 3)


def logarithm(matrix: Array) -> Array:
    """Rotation vectors in [rad], at most pi long, of rotations [..., 3, 3]: [..., 3].

    From the antisymmetric part up to 2 rad; scipy does the larger ones, where that part loses its
    digits.
    """
    sines = 0.5 * (matrix[..., [2, 0, 1], [1, 2, 0]] - matrix[..., [1, 2, 0], [2, 0, 1]])
    sine, cosine = numpy.sqrt(numpy.sum(sines * sines, axis=-1)), 0.5 * (numpy.trace(matrix, axis1=-2, axis2=-1) - 1.0)
    if numpy.min(cosine, initial=1.0) < LARGE:
        vectors: Array = Rotation.from_matrix(matrix.reshape(-1, 3, 3)).as_rotvec()
        return vectors.reshape(matrix.shape[:-1])
    ratio = numpy.where(sine > 0.0, numpy.arctan2(sine, cosine) / numpy.where(sine > 0.0, sine, 1.0), 1.0)
    return numpy.asarray(sines * ratio[..., None])


def from_quaternion(quaternion: Array) -> Array:
    """Rotations [n, 3, 3] of quaternions [n, 4] in the order w, x, y, z, or of any leading shape;
    they need not be of length 1."""
    quaternions = numpy.asarray(quaternion, dtype=numpy.float64)
    scalar_last = numpy.roll(quaternions.reshape(-1, 4), -1, axis=1)
    matrices: Array = Rotation.from_quat(scalar_last).as_matrix()
    return matrices.reshape(*quaternions.shape[:-1], 3, 3)


def mean(first: Array, second: Array) -> Array:
    """The rotation half-way from the first [3, 3] to the second."""
    half: Array = exponential(0.5 * logarithm(second @ first.T)) @ first
    return half


def angular_inertia(rotation: Array, inertia: Array) -> Array:
    """`R S R^T`: an inertia [3, 3] given in body axes, in world axes [3, 3]; rotation: [3, 3]."""
    turned: Array = rotation @ inertia @ rotation.T
    return turned
