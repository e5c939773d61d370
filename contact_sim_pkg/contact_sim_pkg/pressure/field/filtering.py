"""A field on a grid times a table of its frequencies: the convolutions of the half-space.

    result = sum over k of  T_k  F_k  exp(2 pi i k . x)

with F the transform of the field and T real and even along both sides, as are those of an influence
and of its inverse. Where the table is of twice the grid each way the convolution is a linear one: the
field is continued by zeros, which are never transformed (`compiled/fourier.py`).

Rows are transformed in pairs, as real and imaginary part of one signal, eight columns at a time. Then,
for eight of the frequencies along the rows at a time: the transform along the columns, the product
with the table, and the way back, all of it in a buffer that fits the first cache.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.fourier import (
    FURTHER,
    IMAGINARY,
    Axis,
    good_size,
    make_axis,
    put,
    transform,
)
from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.compiled.lanes import WIDTH, load, store, transpose

__all__ = ["Filter", "FilterBuffers", "apply_filter", "filter_of", "good_shape", "make_filter_buffers"]

Field = NDArray[numpy.float64]
Filter = NDArray[numpy.float64]
Values = NDArray[numpy.float64]


class FilterBuffers(NamedTuple):
    """Tables and scratch for the filters of one grid, for one thread at a time."""

    pairs: Axis  # along the rows, taken in pairs
    across: Axis  # along the columns
    turns: Values  # cosine and sine of `-pi k / rows` for k = 0 ... rows
    # [frequencies along the rows, columns] real parts, then imaginary parts of each row
    spectrum: Field
    signals: Field  # [4, ...] lanes
    line: Values  # [8]


def good_shape(rows: int, cols: int) -> tuple[int, int]:
    """Rows and columns of the grid that a field of `rows` x `cols` is continued to: even, and products
    of 2, 3 and 5.
    """
    return 2 * good_size(-(-rows // 2)), good_size(cols)


def filter_of(table: Field, rows: int, cols: int) -> Filter:
    """Arrange a table of frequencies in the order of use, [blocks, halves, columns, 8].

    table: [rows, cols / 2 + 1] where it is for the periodic grid of `good_shape`, or [2 rows, cols +
    1] for the linear convolution, divided by its number of cells; even along both sides. Raises
    ValueError for another shape.
    """
    rows, cols = good_shape(rows, cols)
    halves = 2 if table.shape == (2 * rows, cols + 1) else 1
    if table.shape != (halves * rows, halves * cols // 2 + 1):
        raise ValueError(
            f"filter: its table is {table.shape}, it must be {(rows, cols // 2 + 1)} or {(2 * rows, cols + 1)}"
        )
    frequencies = halves * rows // 2 + 1
    blocks = -(-frequencies // WIDTH)
    along = numpy.zeros((blocks * WIDTH, halves * cols))
    column = numpy.arange(halves * cols)
    # Half of it: the transform along the rows comes out twice as large
    along[:frequencies] = 0.5 * table[:frequencies][:, numpy.minimum(column, halves * cols - column)]
    return numpy.ascontiguousarray(along.reshape(blocks, WIDTH, cols, halves).transpose(0, 3, 2, 1))


def make_filter_buffers(rows: int, cols: int) -> FilterBuffers:
    """Tables and scratch for a grid."""
    rows, cols = good_shape(rows, cols)
    pairs, across = make_axis(rows // 2), make_axis(cols)
    frequencies, columns = -(-(rows + 1) // WIDTH) * WIDTH, -(-cols // WIDTH) * WIDTH
    turns = numpy.exp(-1j * numpy.pi * (numpy.arange(rows + 1) / rows)).view(float)
    # Rows lie apart by an odd number of lines of the cache
    spectrum = numpy.zeros((frequencies, 2 * columns + WIDTH))
    signals = numpy.zeros((4, max(rows // 2 + 1, columns) * FURTHER))
    return FilterBuffers(pairs, across, turns, spectrum, signals, numpy.zeros(WIDTH))


@borrowing_kernel
def apply_filter(filter_: Filter, buffers: FilterBuffers, field: Field, result: Field) -> None:
    """`result` of a filter; it may be `field` itself.

    filter_: [blocks, halves, columns, 8]; field, result: [rows, cols].
    """
    cols, halves = field.shape[1], filter_.shape[1]
    for first in range(0, cols, WIDTH):
        rows_forward(buffers, field, first, halves)
    for block in range(filter_.shape[0]):
        filter_columns(buffers, filter_[block], block * WIDTH, cols)
    for first in range(0, cols, WIDTH):
        rows_back(buffers, result, first, halves)


@borrowing_kernel
def rows_forward(buffers: FilterBuffers, field: Field, first: int, halves: int) -> None:
    """Transform eight columns of a field along the rows into the spectrum.

    field: [rows, cols].
    """
    rows, cols = field.shape
    pairs, turns, spectrum, line = buffers.pairs, buffers.turns, buffers.spectrum, buffers.line
    even, odd = buffers.signals[0], buffers.signals[1]
    count, stride = min(WIDTH, cols - first), spectrum.shape[1]
    imaginary = (stride - WIDTH) // 2
    # Pairs of rows, and their turned copy for the odd frequencies.
    line[:] = 0.0
    nothing = load(line, 0)
    for m in range(pairs.length):
        x = read_row(field, 2 * m, first, count, line) if 2 * m < rows else nothing
        y = read_row(field, 2 * m + 1, first, count, line) if 2 * m + 1 < rows else nothing
        store(even, m * FURTHER, x)
        store(even, m * FURTHER + IMAGINARY, y)
        if halves == 2:
            put(odd, m * FURTHER, x, y, turns, 4 * m)
    # Frequencies k and `highest - k` of the pairs give those of the rows.
    highest = halves * pairs.length
    for half in range(halves):
        signal, other = buffers.signals[half], buffers.signals[2 + half]
        if transform(pairs, signal, other):
            signal = other
        for k in range(half, highest // 2 + 1, halves):
            mirror = highest - k if k > 0 else 0
            here, there = k // halves * FURTHER, mirror // halves * FURTHER
            ar, ai = load(signal, here), load(signal, here + IMAGINARY)
            br, bi = load(signal, there), load(signal, there + IMAGINARY)
            er, ei, dr, di = ar + br, ai - bi, ai + bi, br - ar
            cosine, sine = turns[4 // halves * k], turns[4 // halves * k + 1]
            wr, wi = cosine * dr - sine * di, cosine * di + sine * dr
            at, at_mirror = k * stride + first, (highest - k) * stride + first
            store(spectrum, at, er + wr)
            store(spectrum, at + imaginary, ei + wi)
            store(spectrum, at_mirror, er - wr)
            store(spectrum, at_mirror + imaginary, wi - ei)


@borrowing_kernel
def filter_columns(buffers: FilterBuffers, table: Field, first: int, cols: int) -> None:
    """Eight frequencies along the rows from `first` on: there and back along the columns, times the
    table between.

    table: [halves, columns, 8].
    """
    across, spectrum = buffers.across, buffers.spectrum
    even, odd = buffers.signals[0], buffers.signals[1]
    halves, length, stride = table.shape[0], across.length, spectrum.shape[1]
    start, imaginary = first * stride, (stride - WIDTH) // 2
    for col in range(0, cols, WIDTH):
        transpose(spectrum, start + col, stride, even, col * FURTHER, FURTHER)
        transpose(spectrum, start + imaginary + col, stride, even, col * FURTHER + IMAGINARY, FURTHER)
    even[cols * FURTHER : length * FURTHER] = 0.0
    if halves == 2:
        for col in range(length):
            at = col * FURTHER
            put(odd, at, load(even, at), load(even, at + IMAGINARY), across.turns, 2 * col)
    for half in range(halves):
        signal, other, factors = buffers.signals[half], buffers.signals[2 + half], table[half]
        turned = transform(across, signal, other)
        middle, back = (other, signal) if turned else (signal, other)
        for col in range(length):
            at, factor = col * FURTHER, load(factors, col * WIDTH)
            x, y = factor * load(middle, at), factor * load(middle, at + IMAGINARY)
            store(middle, at, y)
            store(middle, at + IMAGINARY, x)
        # Back, with exchanged parts, and in as many passes: it ends where it began
        transform(across, middle, back)
    if halves == 2:
        for col in range(cols):
            add_turned_back(even, odd, col * FURTHER, across.turns, 2 * col)
    for col in range(0, cols, WIDTH):
        transpose(even, col * FURTHER + IMAGINARY, FURTHER, spectrum, start + col, stride)
        transpose(even, col * FURTHER, FURTHER, spectrum, start + imaginary + col, stride)


@borrowing_kernel
def rows_back(buffers: FilterBuffers, result: Field, first: int, halves: int) -> None:
    """Eight columns of the spectrum back along the rows.

    result: [rows, cols].
    """
    rows, cols = result.shape
    pairs, turns, spectrum = buffers.pairs, buffers.turns, buffers.spectrum
    count, stride = min(WIDTH, cols - first), spectrum.shape[1]
    imaginary, highest = (stride - WIDTH) // 2, halves * pairs.length
    for half in range(halves):
        signal, other = buffers.signals[half], buffers.signals[2 + half]
        for k in range(half, highest // 2 + 1, halves):
            at, at_mirror = k * stride + first, (highest - k) * stride + first
            ar, ai = load(spectrum, at), load(spectrum, at + imaginary)
            br, bi = load(spectrum, at_mirror), load(spectrum, at_mirror + imaginary)
            er, ei, dr, di = ar + br, ai - bi, ar - br, ai + bi
            cosine, sine = turns[4 // halves * k], turns[4 // halves * k + 1]
            wr, wi = cosine * dr + sine * di, cosine * di - sine * dr
            here, there = k // halves * FURTHER, (highest - k) // halves * FURTHER
            # Parts exchanged, for the way back; after the other, with which it is one at half of the highest
            store(signal, there + IMAGINARY, er + wi)
            store(signal, there, wr - ei)
            store(signal, here + IMAGINARY, er - wi)
            store(signal, here, ei + wr)
        if transform(pairs, signal, other):
            for at in range(0, pairs.length * FURTHER, WIDTH):
                store(signal, at, load(other, at))
    even, odd = buffers.signals[0], buffers.signals[1]
    for m in range((rows + 1) // 2):
        if halves == 2:
            add_turned_back(even, odd, m * FURTHER, turns, 4 * m)
        write_row(result, 2 * m, first, count, even, m * FURTHER + IMAGINARY, buffers.line)
        if 2 * m + 1 < rows:
            write_row(result, 2 * m + 1, first, count, even, m * FURTHER, buffers.line)


@borrowing_kernel
def add_turned_back(even: Values, odd: Values, at: int, turns: Values, turn: int) -> None:
    """Add the number at `at` of the odd frequencies, turned back, to that of the even ones; parts are
    exchanged.
    """
    cosine, sine = turns[turn], turns[turn + 1]
    x, y = load(odd, at + IMAGINARY), load(odd, at)
    store(even, at + IMAGINARY, load(even, at + IMAGINARY) + (cosine * x + sine * y))
    store(even, at, load(even, at) + (cosine * y - sine * x))


@borrowing_kernel
def read_row(field: Field, row: int, first: int, count: int, line: Values) -> float:
    """Lanes of a row of a field [rows, cols] from column `first` on, `count` of them; the others are
    those of `line`.
    """
    if count == WIDTH:
        return load(field, row * field.shape[1] + first)
    for j in range(count):
        line[j] = field[row, first + j]
    return load(line, 0)


@borrowing_kernel
def write_row(field: Field, row: int, first: int, count: int, source: Values, at: int, line: Values) -> None:
    """Write `count` of the lanes at `at` into a row of a field [rows, cols] from column `first` on."""
    if count == WIDTH:
        store(field, row * field.shape[1] + first, load(source, at))
        return
    store(line, 0, load(source, at))
    for j in range(count):
        field[row, first + j] = line[j]
