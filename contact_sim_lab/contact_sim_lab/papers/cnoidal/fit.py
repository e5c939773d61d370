"""The cnoidal ansatz fitted to a computed motion, and its residual (Driver and Seat eqs 12, 13, A6;
corrected).

``S = c + sum_k a_k C_k + sum_k b_k C_k / (1 + sum_k g_k C_k)``, ``C_k = cn^2(K(m_k)/pi (eta_k +
f_k); m_k)``, k = 1..N. For a periodic response of fundamental W ``eta_k = k W t``: cn^2 has the
period 2 K, so every C_k repeats with the response. For the wave of N phases the eta_k are those
phases. c, a, b, g, m and f are fitted by least squares from m = 0.1, b = g = 0 and the Fourier
amplitudes; the least found may be a local one. The ansatz is exact for one phase only; elsewhere
its residual says its worth.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from scipy.optimize import least_squares

from contact_sim_pkg.pressure.closed_form.jacobi import cn_squared, quarter_period

__all__ = ["AnsatzFit", "ansatz", "fit_ansatz", "fit_harmonics", "harmonics_of_period"]

Array = NDArray[numpy.float64]

START_PARAMETER = 0.1  # m
LARGEST_PARAMETER = 1.0 - 1e-9
SMALLEST_DENOMINATOR = 1e-6
LARGEST_EVALUATIONS = 300
FLAT = 1e-3  # of the largest singular value, columns of length 1: directions below are not determined
SHARE = 0.1  # of such a direction above which an unknown is not determined


class AnsatzFit(NamedTuple):
    """What was fitted, and what is left."""

    constant: float
    linear: Array  # a [N]
    numerator: Array  # b [N]
    denominator: Array  # g [N]
    parameters: Array  # m [N]
    shifts: Array  # f [N] [rad]
    residual: float  # rms of the difference over the rms of the samples about their mean
    unknowns: int
    apart: Array  # [N] whether a and b are determined each, and not their sum alone


def harmonics_of_period(count: int, terms: int = 2) -> Array:
    """Phases ``k W t`` [terms, count] of evenly spaced samples over one period, the end left
    out.
    """
    phase = 2.0 * math.pi * numpy.arange(count) / count
    return numpy.arange(1, terms + 1)[:, None] * phase


def fit_ansatz(samples: Array, phases: Array, *, nonlinear: bool = True) -> AnsatzFit:
    """Fit to ``samples`` [n] at ``phases`` [N, n] in [rad].

    ``nonlinear``: with the quotient; False: S_lin alone. Raises ValueError where the samples are
    fewer than the unknowns, or all the same.
    """
    terms = len(phases)
    mean, size = float(samples.mean()), float(samples.std())
    unknowns = 1 + (5 if nonlinear else 3) * terms
    if len(samples) < unknowns or size == 0.0:
        raise ValueError(f"{len(samples)} samples with a spread of {size:g} cannot fix {unknowns} unknowns")
    # Unknowns of order 1.
    scaled = (samples - mean) / size

    def difference(values: Array) -> Array:
        return _ansatz(phases, nonlinear, values) - scaled

    # Elliptic parameters stay below 1.
    low, high = numpy.full(unknowns, -numpy.inf), numpy.full(unknowns, numpy.inf)
    low[1 + terms : 1 + 2 * terms], high[1 + terms : 1 + 2 * terms] = 0.0, LARGEST_PARAMETER
    found = least_squares(
        difference, _start(scaled, phases, nonlinear), bounds=(low, high), x_scale="jac", max_nfev=LARGEST_EVALUATIONS,
    )  # fmt: skip
    c, a, m, f, b, g = _parts(found.x, terms, nonlinear)
    residual = float(numpy.sqrt(numpy.mean(found.fun**2)))
    return AnsatzFit(
        constant=mean + size * c,
        linear=size * a,
        numerator=size * b,
        denominator=g,
        parameters=m,
        shifts=f,
        residual=residual,
        unknowns=unknowns,
        apart=_apart(found.jac, terms, nonlinear),
    )


def ansatz(fit: AnsatzFit, phases: Array) -> Array:
    """S at ``phases`` [N, n] in [rad]."""
    waves = _waves(phases, fit.parameters, fit.shifts)
    return numpy.asarray(fit.constant + fit.linear @ waves + (fit.numerator @ waves) / (1.0 + fit.denominator @ waves))


def fit_harmonics(samples: Array, count: int) -> float:
    """Residual [1] of the mean and ``count`` harmonics of one period, as that of ``fit_ansatz``; 1
    + 2 count unknowns.

    samples: [samples] of the period.
    """
    spectrum = numpy.fft.rfft(samples - samples.mean())
    spectrum[: count + 1] = 0.0
    rest = numpy.fft.irfft(spectrum, len(samples))
    return float(rest.std() / samples.std())


def _start(scaled: Array, phases: Array, nonlinear: bool) -> Array:
    """cn^2 is (1 + cos)/2 for small m: amplitude and shift are those of the Fourier component, the
    amplitude twice.
    """
    components = 2.0 * numpy.mean(scaled * numpy.exp(-1j * phases), axis=1)
    linear, terms = 2.0 * numpy.abs(components), len(phases)
    rest = numpy.zeros(2 * terms if nonlinear else 0)
    shifts = numpy.angle(components)
    return numpy.concatenate([[-0.5 * linear.sum()], linear, numpy.full(terms, START_PARAMETER), shifts, rest])


def _apart(slopes: Array, terms: int, nonlinear: bool) -> Array:
    """Whether a and b of each term are determined one by one [terms]; slopes [n, unknowns]. As g falls to 0 their sum
    alone is, ``a C + b C/(1 + g C)``.
    """
    lengths = numpy.linalg.norm(slopes, axis=0)
    _left, singular, directions = numpy.linalg.svd(
        slopes / numpy.where(lengths > 0.0, lengths, 1.0), full_matrices=False
    )
    flat = numpy.linalg.norm(directions[singular < FLAT * singular[0]], axis=0) > SHARE
    _c, a, _m, _f, b, _g = _parts(flat, terms, nonlinear)
    apart: Array = numpy.logical_not(numpy.logical_or(a, b))
    return apart


def _parts(values: Array, terms: int, nonlinear: bool) -> tuple[float, Array, Array, Array, Array, Array]:
    a, m, f = (values[1 + i * terms : 1 + (i + 1) * terms] for i in range(3))
    none = numpy.zeros(terms)
    b, g = (values[1 + 3 * terms : 1 + 4 * terms], values[1 + 4 * terms :]) if nonlinear else (none, none)
    return float(values[0]), a, m, f, b, g


def _waves(phases: Array, parameters: Array, shifts: Array) -> Array:
    waves = []
    for phase, m, f in zip(phases, parameters, shifts, strict=True):
        complement = 1.0 - float(m)
        waves.append(cn_squared(quarter_period(complement)[0] / math.pi * (phase + f), complement))
    return numpy.array(waves)


def _ansatz(phases: Array, nonlinear: bool, values: Array) -> Array:
    c, a, m, f, b, g = _parts(values, len(phases), nonlinear)
    waves = _waves(phases, m, f)
    below = 1.0 + g @ waves
    below = numpy.where(numpy.abs(below) < SMALLEST_DENOMINATOR, SMALLEST_DENOMINATOR, below)
    return numpy.asarray(c + a @ waves + (b @ waves) / below)
