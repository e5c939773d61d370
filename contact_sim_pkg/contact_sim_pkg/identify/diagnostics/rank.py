"""The combinations of parameters that measurements identify: singular values of the whitened,
scaled regressor.

Source: Golub and Van Loan, Matrix Computations, 5.5.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.motion.rotation import Array

__all__ = ["Split", "split"]

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
