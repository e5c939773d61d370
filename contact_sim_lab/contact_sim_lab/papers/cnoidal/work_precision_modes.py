"""Work-precision study of the interaction of two phases: plain sum of one-phase waves, fitted
ansatz, lattice sum of the theta function.

B11 = -2.2, B22 = -3.1, k = (1, 1.6); B12 is what ties the phases together. Distances are rms over
both phases, relative to the rms of the plain sum. The lattice sum is compared with Poisson's sum of
the same function, which shares no term with it.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy

from contact_sim_lab.papers.cnoidal import theta
from contact_sim_lab.papers.cnoidal.fit import Array, ansatz, fit_ansatz
from contact_sim_lab.records.work_precision import FidelityLevel, Row, WorkPrecision, milliseconds, row, timed_once

__all__ = ["COUPLINGS", "PART", "WORK_PRECISION", "matrix_of", "phases_of", "rows"]

PART = "interaction of modes"
QUANTITY = "wave of two phases"
COUPLINGS = (-0.2, -0.5, -1.0)
WAVE_NUMBERS = numpy.array([1.0, 1.6])
POINTS = 32  # along each phase
REFERENCE = "the theta function by Poisson's sum"


def rows() -> list[Row]:
    """Each coupling, each way."""
    found = []
    phases = phases_of(POINTS)
    for coupling in COUPLINGS:
        matrix = matrix_of(coupling)
        exact = theta.poisson_wave(phases, matrix, WAVE_NUMBERS)
        plain = theta.plain_sum(phases, matrix, WAVE_NUMBERS)
        size = float(numpy.sqrt(numpy.mean(plain**2)))
        fitted, fit_ms = timed_once(functools.partial(_fitted, exact, phases))
        # From inexpensive to exact
        for level, value in (
            (FidelityLevel("sum of one-phase cn²", _cost(theta.plain_sum, matrix)), plain),
            (FidelityLevel("fitted ansatz (A6)", fit_ms), fitted),
            (
                FidelityLevel("theta lattice sum", _cost(theta.theta_wave, matrix)),
                theta.theta_wave(phases, matrix, WAVE_NUMBERS),
            ),
        ):
            distance = float(numpy.sqrt(numpy.mean((value - exact) ** 2))) / size
            found.append(row(PART, f"B12 = {coupling:g}", QUANTITY, level, REFERENCE, distance))
    return found


def matrix_of(coupling: float) -> Array:
    """Matrix B [2, 2] with the off-diagonal ``coupling`` [1]."""
    return numpy.array([[-2.2, coupling], [coupling, -3.1]])


def phases_of(points: int) -> Array:
    """Both phases over a whole turn, [points, points, 2]."""
    turn = 2.0 * math.pi * numpy.arange(points) / points
    return numpy.stack(numpy.meshgrid(turn, turn, indexing="ij"), axis=-1)


def _cost(wave: Callable[..., Array], matrix: Array) -> float:
    return milliseconds(functools.partial(wave, phases_of(POINTS), matrix, WAVE_NUMBERS))


def _fitted(exact: Array, phases: Array) -> Array:
    """The ansatz, fitted to the answer: it needs it first."""
    pairs = phases.reshape(-1, 2).T
    return ansatz(fit_ansatz(exact.ravel(), pairs), pairs).reshape(exact.shape)


WORK_PRECISION = (WorkPrecision(PART, rows),)
