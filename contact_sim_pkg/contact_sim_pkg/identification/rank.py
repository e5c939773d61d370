"""Which combinations of parameters a set of measurements tells: singular values of the whitened, scaled regressor."""

from __future__ import annotations

from typing import NamedTuple

import numpy

from .rotation import Array

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


def split(regressor: Array) -> Split:
    """Directions that are identified and those that are not.

    A direction counts as identified where its singular value is above 1e-8 of the largest, and its standard deviation
    (one over the singular value) below the size of the parameters.

    Args:
        regressor: [rows, p], each row of unit noise, each column times the size of its parameter.
    """
    rows, count = regressor.shape
    if rows < count:
        regressor = numpy.concatenate([regressor, numpy.zeros((count - rows, count))])
    left, values, right = numpy.linalg.svd(regressor, full_matrices=False)
    kept = values > max(SMALLEST * float(values.max(initial=0.0)), 1.0)
    return Split(right[kept], values[kept], left[:rows, kept], right[~kept])
