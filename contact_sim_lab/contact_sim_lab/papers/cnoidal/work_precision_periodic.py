"""Work-precision study of the periodic contact motion: linear resonance, exact quadratic oscillator
(cnoidal), integrated motion; and the steady response to a shaken seat written with few functions:
S_lin, the cnoidal ansatz, harmonics of as many unknowns.

The free motion is that of the back rest's mass under its own weight, released at rest deeper than
its balance by a part of it.
"""

from __future__ import annotations

import functools
import math
from typing import NamedTuple

import numpy

from contact_sim_lab.laws.one_mass.runs import integrate
from contact_sim_lab.papers.cnoidal.cnoidal import CnoidalMotion, contact_oscillator, position, released_at
from contact_sim_lab.papers.cnoidal.fit import Array, fit_ansatz, fit_harmonics, harmonics_of_period
from contact_sim_lab.papers.cnoidal.periodic_contact import (
    AMPLITUDES,
    FREQUENCIES,
    GRAVITY,
    LAW,
    MASS,
    exact_period,
    steady_response,
)
from contact_sim_lab.records.work_precision import (
    FidelityLevel,
    Row,
    WorkPrecision,
    milliseconds,
    relative,
    row,
    timed_once,
)
from contact_sim_pkg.laws.one_mass.parameters import PointContact

__all__ = ["ANSATZ_PART", "PART", "RELEASES", "WORK_PRECISION", "ansatz_rows", "rows"]

PART = "periodic contact motion"
ANSATZ_PART = "steady response in few functions"
RELEASES = (0.1, 0.3, 0.5, 0.8)  # of the approach in balance, deeper
PERIOD, MOTION, RESPONSE = "period", "approach over a period", "approach of the steady response"
REFERENCE = "energy integral by quadrature to 1e-12; motion integrated to 1e-13"
RESPONSE_REFERENCE = "steady response integrated to 1e-9"
POINTS = 201


class Free(NamedTuple):
    """The free motion from rest at ``start`` [m] beyond the balance."""

    start: float
    period: float  # [s]
    times: Array
    motion: Array  # [m] about the balance


def rows() -> list[Row]:
    """Each release, each way."""
    oscillator, rest = contact_oscillator(MASS, LAW, MASS * GRAVITY)
    found = []
    for part in RELEASES:
        free, start = _free(part * rest, rest), part * rest
        linear = CnoidalMotion(start, -start, 0.5 * oscillator.frequency, 1.0, 2.0 * math.pi / oscillator.frequency)
        case = f"released {part:g} of the balance deeper"
        for name, motion, call in (
            ("linear resonance", linear, lambda: 2.0 * math.pi / oscillator.frequency),
            ("cnoidal", released_at(oscillator, start), lambda start=start: released_at(oscillator, start)),
        ):
            level = FidelityLevel(name, milliseconds(call))
            found += _pair(case, level, free, motion.period, position(motion, free.times))
        level = FidelityLevel("integrated", milliseconds(functools.partial(_integrated, start, rest, free.times, 1e-8)))
        states = _integrated(free.start, rest, free.times, 1e-8)
        pull = LAW.coefficient * (rest - states[-1, 0]) ** LAW.exponent / MASS - GRAVITY
        found += _pair(case, level, free, free.period - float(states[-1, 1] / pull), -states[:, 0])
    return found


def ansatz_rows() -> list[Row]:
    """Each frequency and amplitude of the figures, each set of functions."""
    found = []
    for amplitude in AMPLITUDES:
        for frequency in FREQUENCIES:
            approach = steady_response(frequency, amplitude).approach
            case = f"{amplitude:g} g, {frequency:g} Hz"
            fits = {
                "S_lin, N = 2 (7 unknowns)": timed_once(functools.partial(_residual, approach, False)),
                "ansatz, N = 2 (11 unknowns)": timed_once(functools.partial(_residual, approach, True)),
                "3 harmonics (7 unknowns)": timed_once(functools.partial(fit_harmonics, approach, 3)),
                "5 harmonics (11 unknowns)": timed_once(functools.partial(fit_harmonics, approach, 5)),
            }
            for name, (residual, ms) in fits.items():
                found.append(row(ANSATZ_PART, case, RESPONSE, FidelityLevel(name, ms), RESPONSE_REFERENCE, residual))
    return found


def _residual(approach: Array, nonlinear: bool) -> float:
    return fit_ansatz(approach, harmonics_of_period(len(approach)), nonlinear=nonlinear).residual


def _pair(case: str, level: FidelityLevel, free: Free, period: float, motion: Array) -> list[Row]:
    error = relative(period, free.period)
    distance = float(numpy.sqrt(numpy.mean((motion - free.motion) ** 2) / numpy.mean(free.motion**2)))
    return [
        row(PART, case, PERIOD, level, REFERENCE, error, value=period, expected=free.period),
        row(PART, case, MOTION, level, REFERENCE, distance),
    ]


def _free(start: float, rest: float) -> Free:
    period = exact_period(LAW, MASS, MASS * GRAVITY, rest + start)
    times = numpy.linspace(0.0, period, POINTS, dtype=numpy.float64)
    return Free(start, period, times, -_integrated(start, rest, times, 1e-13)[:, 0])


def _integrated(start: float, rest: float, times: Array, tolerance: float) -> Array:
    """States [z + rest, v] of the free motion."""
    rig = PointContact(MASS, GRAVITY, 0.0, 0.0, LAW, None)
    scale = numpy.array([rest, math.sqrt(GRAVITY * rest)]) * tolerance
    states = integrate(rig, numpy.array([-rest - start, 0.0]), scale, times).states
    return numpy.asarray(states + numpy.array([rest, 0.0]))


WORK_PRECISION = (
    WorkPrecision(PART, rows),
    WorkPrecision(ANSATZ_PART, ansatz_rows),
)
