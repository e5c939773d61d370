"""What a recording of the bench's own carries: the numerical error of the run that it is of.

A run errs in the same way wherever it is made, so that the error moves keys as a second recording with another force would:
by ``pinv(J) e``, and no request of the fit's own runs makes that less. ``e`` is what a run of the fitted scene at the request
of the recording differs by from one at a hundredth of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.sweep.measured import Measured, Points
from contact_sim_pkg.sweep.residuals import Residual
from contact_sim_pkg.sweep.scene_runs import Runs

__all__ = ["FINEST", "NO_ERROR", "OwnError", "own_error"]

Field = NDArray[numpy.float64]
FINEST = 1e-8
"""Accuracy that runs may request."""
FINER = 1e-2
"""Times the request of a recording, of the run that shows its error."""
ALIKE = 2.0
"""Times the own error of a recording, up to which what is left may be that error alone."""


class OwnError(NamedTuple):
    """Numerical error of a recording."""

    request: float = 0.0
    """of its run; 0: it is of no run of the bench"""
    moved: Field | None = None
    """residuals that the error moves"""

    @property
    def scatter(self) -> float:
        """Root of the mean square of a residual by it alone."""
        return 0.0 if self.moved is None else float(numpy.sqrt(numpy.mean(self.moved**2)))

    @property
    def finest(self) -> float:
        """Accuracy that a run may request: a finer one shows nothing that the recording holds."""
        return max(FINEST, self.request)

    def ways(self, slope: Field) -> Field:
        """By which keys may be off, each in the measure of its range, of residuals with such a ``slope``."""
        if self.moved is None:
            return numpy.zeros(slope.shape[1])
        return numpy.asarray(abs(numpy.linalg.pinv(slope) @ self.moved))

    def is_all(self, left: Field) -> bool:
        """Whether what is ``left`` is no more than that."""
        return self.moved is not None and float(numpy.sqrt(numpy.mean(left**2))) <= ALIKE * self.scatter


NO_ERROR = OwnError()


def own_error(runs: Runs, residual: Residual, to: Measured, place: Field) -> OwnError:
    """That of what was measured, at a place; two runs, or one where the fit requests what the recording did."""
    if isinstance(to, Points) or not to.request:
        return NO_ERROR
    left = []
    for request in (to.request, max(FINER * to.request, FINEST)):
        with _requesting(runs, request):
            left.append(residual.of(runs([place])[0]))
    return OwnError(to.request, left[1] - left[0])


@contextmanager
def _requesting(runs: Runs, accuracy: float) -> Iterator[None]:
    before = runs.accuracy, runs.is_held
    runs.accuracy, runs.is_held = accuracy, False
    try:
        yield
    finally:
        runs.accuracy, runs.is_held = before
