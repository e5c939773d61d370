"""The fast Fourier transform of eight columns at a time, in compiled code.

A signal of n complex numbers in each of eight lanes lies in a row of `2 n` vectors, real part and
imaginary part in turn. Its transform

    X_k = sum_m x_m exp(-2 pi i k m / n)

is made by one pass for each factor of n (2, 3, 4 or 5) from one buffer to another and back (Stockham:
no reordering). With the two parts exchanged, before and after, it is the inverse times n.

A signal of 2 n numbers of which the second half is zero has the transforms of two signals of n
numbers: the even frequencies are those of x, the odd ones of `x_m exp(-pi i m / n)`. Forward and back
each save the pass that would handle the zeros.

Source: Van Loan, Computational Frameworks for the Fast Fourier Transform, 1.7 and 2.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.compiled.lanes import WIDTH, load, store

__all__ = ["FURTHER", "IMAGINARY", "Axis", "good_size", "make_axis", "put", "transform"]

IMAGINARY = WIDTH
"""From the real part of a number to its imaginary part, in a buffer."""

FURTHER = 2 * WIDTH
"""From one number to the next."""

Values = NDArray[numpy.float64]
Passes = NDArray[numpy.int64]

SINE_3 = math.sin(math.pi / 3.0)
COSINE_5, COSINE_5_TWICE = math.cos(0.4 * math.pi), math.cos(0.8 * math.pi)
SINE_5, SINE_5_TWICE = math.sin(0.4 * math.pi), math.sin(0.8 * math.pi)


class Axis(NamedTuple):
    """Tables of the transforms of one length n."""

    length: int
    passes: Passes  # [passes, 4] factor, twiddles in a pass over its factor less one, stride, first twiddle
    twiddles: Values  # cosine and sine by which a pass multiplies, in the order of use
    turns: Values  # cosine and sine of `-pi k / n` for k = 0 ... n


def good_size(count: int) -> int:
    """The least length of a transform from ``count`` on: a product of 2, 3 and 5."""
    size = max(count, 1)
    while _without(size, 2, 3, 5) != 1:
        size += 1
    return size


def make_axis(length: int) -> Axis:
    """Tables for a ``length`` >= 1 that is a product of 2, 3 and 5. Raises ValueError for another."""
    if length < 1 or _without(length, 2, 3, 5) != 1:
        raise ValueError(f"transform: its length is {length}, it must be a product of 2, 3 and 5")
    passes, twiddles = [], [numpy.zeros(0, dtype=numpy.complex128)]
    rest, stride, place = length, 1, 0
    for factor in (5, 4, 3, 2):
        while rest % factor == 0:
            size, rest = rest, rest // factor
            passes.append((factor, rest, stride, place))
            turns = numpy.arange(rest)[:, None] * numpy.arange(1, factor)
            twiddles.append(numpy.exp(-2j * numpy.pi * (turns.ravel() / size)))
            stride, place = stride * factor, place + 2 * (factor - 1) * rest
    table = numpy.array(passes, dtype=numpy.int64).reshape(-1, 4)
    half_turns = numpy.exp(-1j * numpy.pi * (numpy.arange(length + 1) / length))
    return Axis(length, table, numpy.concatenate(twiddles).view(float), half_turns.view(float))


def _without(number: int, *factors: int) -> int:
    for factor in factors:
        while number % factor == 0:
            number //= factor
    return number


@borrowing_kernel
def transform(axis: Axis, signal: Values, other: Values) -> bool:
    """Transform of the lanes in `signal`, [2 n 8]; whether it ends in `other`, which is overwritten."""
    turned = False
    for i in range(len(axis.passes)):
        # From a table: of a literal number another version would be compiled
        factor, rest, stride, place = axis.passes[i, 0], axis.passes[i, 1], axis.passes[i, 2], axis.passes[i, 3]
        if factor == 5:
            fives(signal, other, rest, stride, axis.twiddles, place)
        elif factor == 4:
            fours(signal, other, rest, stride, axis.twiddles, place)
        elif factor == 3:
            threes(signal, other, rest, stride, axis.twiddles, place)
        else:
            twos(signal, other, rest, stride, axis.twiddles, place)
        signal, other, turned = other, signal, not turned
    return turned


@borrowing_kernel
def put(out: Values, to: int, x: float, y: float, twiddles: Values, place: int) -> None:
    """Write lanes of a number, x + i y, times a twiddle."""
    cosine, sine = twiddles[place], twiddles[place + 1]
    store(out, to, cosine * x - sine * y)
    store(out, to + IMAGINARY, cosine * y + sine * x)


@borrowing_kernel
def twos(source: Values, out: Values, count: int, stride: int, twiddles: Values, place: int) -> None:
    """A pass of factor 2: `count` twiddles, each for `stride` pairs."""
    apart = stride * count * FURTHER
    for p in range(count):
        for q in range(stride):
            a, b = (q + stride * p) * FURTHER, (q + stride * p) * FURTHER + apart
            to, next_to = (q + stride * 2 * p) * FURTHER, (q + stride * (2 * p + 1)) * FURTHER
            ar, ai = load(source, a), load(source, a + IMAGINARY)
            br, bi = load(source, b), load(source, b + IMAGINARY)
            store(out, to, ar + br)
            store(out, to + IMAGINARY, ai + bi)
            put(out, next_to, ar - br, ai - bi, twiddles, place + 2 * p)


@borrowing_kernel
def threes(source: Values, out: Values, count: int, stride: int, twiddles: Values, place: int) -> None:
    """A pass of factor 3."""
    apart, on = stride * count * FURTHER, stride * FURTHER
    for p in range(count):
        turn = place + 4 * p
        for q in range(stride):
            a, to = (q + stride * p) * FURTHER, (q + stride * 3 * p) * FURTHER
            b, c = a + apart, a + 2 * apart
            ar, ai = load(source, a), load(source, a + IMAGINARY)
            br, bi = load(source, b), load(source, b + IMAGINARY)
            cr, ci = load(source, c), load(source, c + IMAGINARY)
            sr, si, dr, di = br + cr, bi + ci, SINE_3 * (br - cr), SINE_3 * (bi - ci)
            store(out, to, ar + sr)
            store(out, to + IMAGINARY, ai + si)
            mr, mi = ar - 0.5 * sr, ai - 0.5 * si
            put(out, to + on, mr + di, mi - dr, twiddles, turn)
            put(out, to + 2 * on, mr - di, mi + dr, twiddles, turn + 2)


@borrowing_kernel
def fours(source: Values, out: Values, count: int, stride: int, twiddles: Values, place: int) -> None:
    """A pass of factor 4."""
    apart, on = stride * count * FURTHER, stride * FURTHER
    for p in range(count):
        turn = place + 6 * p
        for q in range(stride):
            a, to = (q + stride * p) * FURTHER, (q + stride * 4 * p) * FURTHER
            b, c, d = a + apart, a + 2 * apart, a + 3 * apart
            ar, ai = load(source, a), load(source, a + IMAGINARY)
            cr, ci = load(source, c), load(source, c + IMAGINARY)
            br, bi = load(source, b), load(source, b + IMAGINARY)
            dr, di = load(source, d), load(source, d + IMAGINARY)
            er, ei, fr, fi = ar + cr, ai + ci, ar - cr, ai - ci
            gr, gi, hr, hi = br + dr, bi + di, br - dr, bi - di
            store(out, to, er + gr)
            store(out, to + IMAGINARY, ei + gi)
            put(out, to + on, fr + hi, fi - hr, twiddles, turn)
            put(out, to + 2 * on, er - gr, ei - gi, twiddles, turn + 2)
            put(out, to + 3 * on, fr - hi, fi + hr, twiddles, turn + 4)


@borrowing_kernel
def fives(source: Values, out: Values, count: int, stride: int, twiddles: Values, place: int) -> None:
    """A pass of factor 5."""
    apart, on = stride * count * FURTHER, stride * FURTHER
    for p in range(count):
        turn = place + 8 * p
        for q in range(stride):
            a, to = (q + stride * p) * FURTHER, (q + stride * 5 * p) * FURTHER
            b, c, d, e = a + apart, a + 2 * apart, a + 3 * apart, a + 4 * apart
            ar, ai = load(source, a), load(source, a + IMAGINARY)
            br, bi = load(source, b), load(source, b + IMAGINARY)
            er, ei = load(source, e), load(source, e + IMAGINARY)
            cr, ci = load(source, c), load(source, c + IMAGINARY)
            dr, di = load(source, d), load(source, d + IMAGINARY)
            sr, si, tr, ti = br + er, bi + ei, cr + dr, ci + di
            fr, fi, gr, gi = br - er, bi - ei, cr - dr, ci - di
            store(out, to, ar + (sr + tr))
            store(out, to + IMAGINARY, ai + (si + ti))
            mr, mi = ar + (COSINE_5 * sr + COSINE_5_TWICE * tr), ai + (COSINE_5 * si + COSINE_5_TWICE * ti)
            nr, ni = SINE_5 * fr + SINE_5_TWICE * gr, SINE_5 * fi + SINE_5_TWICE * gi
            put(out, to + on, mr + ni, mi - nr, twiddles, turn)
            put(out, to + 4 * on, mr - ni, mi + nr, twiddles, turn + 6)
            mr, mi = ar + (COSINE_5_TWICE * sr + COSINE_5 * tr), ai + (COSINE_5_TWICE * si + COSINE_5 * ti)
            nr, ni = SINE_5_TWICE * fr - SINE_5 * gr, SINE_5_TWICE * fi - SINE_5 * gi
            put(out, to + 2 * on, mr + ni, mi - nr, twiddles, turn + 2)
            put(out, to + 3 * on, mr - ni, mi + nr, twiddles, turn + 4)
