"""Theta functions of N phases, and the motion ``2 d^2 ln Theta / dx^2`` with its split into
one-phase waves and interaction.

``Theta(eta) = sum over integer M of exp(i M.eta + 1/2 M.B M)``, B real, symmetric, negative
definite, and ``eta_j = k_j x - w_j t + phi_j`` (Driver and Seat eqs A1-A3). For one phase, with ``q
= exp(B/2)`` the nome of m,

``2 d^2 ln Theta/dx^2 = 2 k^2 (K/pi)^2 [1 - m - E/K + m cn^2(K eta/pi + K; m)]``,

so eq A5's sum of cn^2 needs a constant (a second derivative of a periodic logarithm has no mean).
``printed`` leaves it out.

Truncation: |M_i| <= ceil(sqrt(2 . 36 / l)), l the least eigenvalue of -B, leaves 1e-16. Below l = 1
the terms cancel; there Poisson's sum takes over, all of whose terms are positive: ``Theta(eta) =
sqrt((2 pi)^N / det(-B)) sum over M of exp(1/2 (eta + 2 pi M).B^-1 (eta + 2 pi M))``. Its exponents
are taken over that of M = 0, ``2 pi M.B^-1 (eta + pi M)``, and the wave is a variance, ``2 (var +
k.B^-1 k)`` of ``2 pi M.B^-1 k`` over the weights: neither cancels, however near B is to singular.

Range: eigenvalues of -B from 1e-100, entries of B to 1e100, phases to 1e15 rad, direction to 1e50.
Errors, seen against 60 digits: waves 1e-12 of the largest value that the wave takes, logarithms
1e-13 of themselves or of one.
"""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

import numpy
from numpy.typing import ArrayLike, NDArray

from contact_sim_pkg.pressure.closed_form.jacobi import cn_squared, quarter_period

Array = NDArray[numpy.float64]

DIGITS = 36.0  # exp(-36) is 2e-16
MODULAR_BELOW = 1.0
MOST_TERMS = 2_000_000
SMALL_PARAMETER = 1.0e-5
LEAST_EIGENVALUE, LARGEST_ENTRY, LARGEST_PHASE, LARGEST_DIRECTION = 1.0e-100, 1.0e100, 1.0e15, 1.0e50
TWO_PI = 2.0 * math.pi
TWO_PI_REST = 2.4492935982947064e-16  # 2 pi less the number above


class ThetaError(ValueError):
    """The matrix has no theta function, or one beyond the lattice bound; the text says why."""


class OnePhase(NamedTuple):
    """``offset + amplitude cn^2(argument eta + K; m)``: the wave of one phase."""

    amplitude: float  # 2 k^2 (K/pi)^2 m
    offset: float  # 2 k^2 (K/pi)^2 (1 - m - E/K)
    argument: float  # K/pi
    integral_k: float
    complement: float  # 1 - m


def theta(phases: ArrayLike, matrix: ArrayLike) -> Array:
    """Theta at ``phases`` [..., N] in [rad] for ``matrix`` B [N, N]. Raises ThetaError as
    ``log_theta``.
    """
    return numpy.exp(log_theta(phases, matrix))


def log_theta(phases: ArrayLike, matrix: ArrayLike) -> Array:
    """ln Theta [...] at phases [..., phases]; matrix B: [phases, phases].

    Raises ThetaError where B is not symmetric and negative definite, or needs more than 2e6 terms.
    """
    eta, b = _checked(phases, matrix)
    return _sums(eta, b, numpy.zeros(b.shape[0]))[0]


def theta_wave(phases: ArrayLike, matrix: ArrayLike, direction: ArrayLike) -> Array:
    """``2 d^2 ln Theta/dx^2`` [...] along ``direction`` d(eta)/dx [phases]: wave numbers, or
    frequencies for eq A4.

    phases: [..., phases]; matrix B: [phases, phases].
    """
    eta, b = _checked(phases, matrix)
    along = _direction(direction, b.shape[0])
    return _sums(eta, b, along)[1]


def poisson_wave(phases: ArrayLike, matrix: ArrayLike, direction: ArrayLike) -> Array:
    """As ``theta_wave``, always by Poisson's sum: expensive where -B is large, and a check of the
    lattice sum anywhere.

    phases: [N, n] [rad]; matrix: [N, N]; direction: [N].
    """
    eta, b = _checked(phases, matrix)
    return _modular_sums(eta, b, _direction(direction, b.shape[0]))[1]


def plain_sum(phases: ArrayLike, matrix: ArrayLike, direction: ArrayLike, *, printed: bool = False) -> Array:
    """Sum of the one-phase waves of B's diagonal (eq A5, with its constant; ``printed``
    without).

    phases: [N, n] [rad]; matrix: [N, N]; direction: [N].
    """
    eta, b = _checked(phases, matrix)
    along = _direction(direction, b.shape[0])
    total = numpy.zeros(eta.shape[:-1])
    rest, turns = _within_half_a_turn(eta)
    side = numpy.where(rest < 0.0, -0.5, 0.5)
    # The waves' crests are at odd multiples of pi
    from_crest = (rest - side * TWO_PI) - (side + turns) * TWO_PI_REST
    for j in range(b.shape[0]):
        wave = one_phase(float(b[j, j]), float(along[j]))
        total += wave.amplitude * cn_squared(wave.argument * from_crest[..., j], wave.complement).reshape(total.shape)
        total += 0.0 if printed else wave.offset
    return total


def interaction(phases: ArrayLike, matrix: ArrayLike, direction: ArrayLike) -> Array:
    """Interaction of the phases, ``theta_wave - plain_sum`` (eq A4); zero where B is diagonal.

    phases: [N, n] [rad]; matrix: [N, N]; direction: [N].
    """
    return theta_wave(phases, matrix, direction) - plain_sum(phases, matrix, direction)


def one_phase(entry: float, wave_number: float) -> OnePhase:
    """The wave of one phase with B = ``entry`` [1], -1e100 to -1e-100, and a wave number [1/m].

    Raises ThetaError outside, and for a wave number beyond 1e50.
    """
    if not -LARGEST_ENTRY <= entry <= -LEAST_EIGENVALUE:
        raise ThetaError(
            f"B = {entry} has no theta function within range; it must be a number below 0, "
            f"-{LARGEST_ENTRY:g} to -{LEAST_EIGENVALUE:g}"
        )
    _direction([wave_number], 1)
    integral_k, parameter, complement = _of_nome_exponent(-0.5 * entry)
    scale = 2.0 * (wave_number * integral_k / math.pi) ** 2
    offset = -0.5 * parameter + 0.0625 * parameter**2  # 1 - m - E/K where m is small
    if parameter > SMALL_PARAMETER:
        offset = complement - quarter_period(complement)[1] / integral_k
    return OnePhase(scale * parameter, scale * offset, integral_k / math.pi, integral_k, complement)


def _of_nome_exponent(exponent: float) -> tuple[float, float, float]:
    """K, m and 1 - m from ``q = exp(-exponent)``: theta constants of the nome q or, where q is
    large, of the other one.
    """
    if exponent >= math.pi:
        second, third, fourth = _constants(exponent)
        return 0.5 * math.pi * third**2, (second / third) ** 4, (fourth / third) ** 4
    other = math.pi * math.pi / exponent  # q' = exp(-pi K/K')
    second, third, fourth = _constants(other)
    return 0.5 * other * third**2, (fourth / third) ** 4, (second / third) ** 4


def _constants(exponent: float) -> tuple[float, float, float]:
    """theta_2, theta_3 and theta_4 at zero, of the nome ``exp(-exponent)``, exponent >= pi."""
    second = 2.0 * math.exp(-0.25 * exponent) * sum(math.exp(-exponent * n * (n + 1)) for n in range(4))
    even = 2.0 * sum(math.exp(-exponent * n * n) for n in (2, 4))
    odd = 2.0 * sum(math.exp(-exponent * n * n) for n in (1, 3))
    return second, 1.0 + even + odd, 1.0 + even - odd


def _checked(phases: ArrayLike, matrix: ArrayLike) -> tuple[Array, Array]:
    eta, b = (numpy.asarray(value, dtype=numpy.float64) for value in (phases, matrix))
    if b.ndim != 2 or b.shape[0] != b.shape[1] or eta.ndim < 1 or eta.shape[-1] != b.shape[0]:
        raise ThetaError(f"phases {eta.shape} and matrix {b.shape} do not fit; they must be [..., N] and [N, N]")
    if not (numpy.isfinite(b).all() and numpy.isfinite(eta).all()):
        raise ThetaError("phases and matrix must be finite numbers")
    if not numpy.array_equal(b, b.T):
        raise ThetaError("the matrix B must be symmetric")
    for name, values, bound in (("a phase", eta, LARGEST_PHASE), ("an entry of B", b, LARGEST_ENTRY)):
        if (abs(values) > bound).any():
            raise ThetaError(f"{name} is {abs(values).max():g} in size, at most {bound:g} is allowed")
    largest = float(numpy.linalg.eigvalsh(b).max())
    if not largest < 0.0:
        raise ThetaError(f"the matrix B must be negative definite; its largest eigenvalue is {largest:.6g}")
    if largest > -LEAST_EIGENVALUE:
        raise ThetaError(f"the largest eigenvalue of B is {largest:g}, it must be at most -{LEAST_EIGENVALUE:g}")
    return eta, b


def _direction(direction: ArrayLike, count: int) -> Array:
    along = numpy.asarray(direction, dtype=numpy.float64)
    if along.shape != (count,):
        raise ThetaError(f"the direction has the shape {along.shape}, it must be ({count},)")
    if not (abs(along) <= LARGEST_DIRECTION).all():
        raise ThetaError(f"the direction is {along}, it must be numbers of at most {LARGEST_DIRECTION:g} in size")
    return along


def _lattice(reach: Array) -> Array:
    """Integer points within ``reach`` [N] of the origin, [points, N]."""
    counts = [2 * int(r) + 1 for r in reach]
    if math.prod(counts) > MOST_TERMS:
        raise ThetaError(f"the sum needs {math.prod(counts):.3g} terms, at most {MOST_TERMS:.3g}: B is nearly singular")
    return numpy.array(list(itertools.product(*(range(-int(r), int(r) + 1) for r in reach))), dtype=numpy.float64)


def _within_half_a_turn(eta: Array) -> tuple[Array, Array]:
    """Remainder within -pi to pi of the phases by ``TWO_PI``, exact, and the number of turns taken
    off.
    """
    rest = numpy.fmod(eta, TWO_PI)
    rest = numpy.where(rest > math.pi, rest - TWO_PI, numpy.where(rest < -math.pi, rest + TWO_PI, rest))
    return rest, numpy.round((eta - rest) / TWO_PI)


def _sums(eta: Array, b: Array, along: Array) -> tuple[Array, Array]:
    """ln Theta, and twice its second derivative along ``along``."""
    least = float(numpy.linalg.eigvalsh(-b).min())
    return _modular_sums(eta, b, along) if least < MODULAR_BELOW else _plain_sums(eta, b, along, least)


def _plain_sums(eta: Array, b: Array, along: Array, least: float) -> tuple[Array, Array]:
    points = _lattice(numpy.full(b.shape[0], math.ceil(math.sqrt(2.0 * DIGITS / least))))
    exponents = 0.5 * numpy.einsum("mi,ij,mj->m", points, b, points)
    largest = exponents[points.any(axis=1)].max()  # the waves are made of these
    kept = exponents > largest - DIGITS - math.log(len(points))
    points, weights = points[kept], numpy.exp(exponents[kept])
    rest, turns = _within_half_a_turn(eta)
    angles, rates = (rest - turns * TWO_PI_REST) @ points.T, points @ along
    cosines = numpy.cos(angles)
    value = cosines @ weights
    first = -(numpy.sin(angles) @ (weights * rates)) / value
    second = -(cosines @ (weights * rates * rates)) / value
    return numpy.log(value), 2.0 * (second - first * first)


def _modular_sums(eta: Array, b: Array, along: Array) -> tuple[Array, Array]:
    """Poisson's sum about the phases, which are first brought into -pi to pi; in groups of phases
    that bound its memory.
    """
    inverse = numpy.linalg.inv(b)
    inverse = 0.5 * (inverse + inverse.T)
    rest, turns = (values.reshape(-1, b.shape[0]) for values in _within_half_a_turn(eta))
    at_origin = numpy.einsum("ei,ij,ej->e", rest, inverse, rest)
    farthest = 2.0 * DIGITS - float(at_origin.min(initial=0.0))  # no term that counts is beyond
    points = _lattice(numpy.ceil(numpy.sqrt(numpy.diag(-b) * farthest) / TWO_PI + 0.5))
    pulled = TWO_PI * points @ inverse
    rates = pulled @ along
    total, wave, largest = (numpy.empty(len(rest)) for _ in range(3))
    group = max(1, MOST_TERMS // len(points))
    for start in range(0, len(rest), group):
        part = slice(start, start + group)
        half = rest[part, None, :] + math.pi * points
        half += TWO_PI_REST * (0.5 * points - turns[part, None, :])
        exponents = numpy.einsum("mi,emi->em", pulled, half)
        largest[part] = exponents.max(axis=-1)
        weights = numpy.exp(exponents - largest[part, None])
        total[part] = weights.sum(axis=-1)
        mean = weights @ rates / total[part]
        variance = (weights * (rates - mean[:, None]) ** 2).sum(axis=-1) / total[part]
        wave[part] = 2.0 * (variance + along @ inverse @ along)
    size = 0.5 * (b.shape[0] * math.log(TWO_PI) - float(numpy.linalg.slogdet(-b)[1]))
    logarithm = numpy.log(total) + (largest + 0.5 * at_origin) + size
    return logarithm.reshape(eta.shape[:-1]), wave.reshape(eta.shape[:-1])
