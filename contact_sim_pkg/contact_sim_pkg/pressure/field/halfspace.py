"""The elastic half-space on a grid: influence of a loaded cell, and the displacement field of a
pressure field.

The normal displacement of the surface under a pressure p is `u(x, y) = 1/(pi E*) * integral of p /
distance`. With p constant in each cell this is a discrete convolution with Love's coefficients,
done here as a *linear* convolution (`pressure/field/filtering.py`: no periodic images). Because the
coefficients are even in both directions their transform is real.

Sources: Love (1929), Phil. Trans. R. Soc. A 228, 377; Stanley and Kato (1997), J. Tribology 119,
481.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require_count, require_positive, require_values
from contact_sim_pkg.compiled.jit import borrowing_kernel, entry, kernel
from contact_sim_pkg.pressure.field.belt import stiffness_of_belt
from contact_sim_pkg.pressure.field.filtering import (
    Filter,
    FilterBuffers,
    apply_filter,
    filter_of,
    good_shape,
    make_filter_buffers,
)

__all__ = ["Buffers", "HalfSpace", "coarsened", "displacement", "make_buffers", "make_half_space", "part_of"]

Field = NDArray[numpy.float64]
Counts = NDArray[numpy.int64]

MINIMUM_CELLS = 1
MAXIMUM_CELLS = 4096
"""Cells along one side: 4096 x 4096 needs about 1.5 GB."""

PRECONDITIONER_FLOOR = 1.0
"""Wave number [1/extent of the grid] below which the preconditioner stays constant; chosen by
iteration counts.
"""

LEAST_FURTHER = 1e-2
"""Part of the influence on the farthest cell across above which something yields beside the
half-space.
"""


class HalfSpace(NamedTuple):
    """A grid of `rows` x `cols` equal cells on a half-space; rows along x, cols along y; all arrays
    row-major.
    """

    rows: int
    cols: int
    cell_x: float  # [m] length of a cell along x
    cell_y: float  # [m] length of a cell along y
    modulus: float  # [Pa] contact modulus E*, 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2
    # [rows, cols] [m/Pa] displacement i rows and j cols away from a cell under unit pressure
    influence: Field
    transfer: Filter  # of `influence`, a linear convolution
    preconditioner: Filter  # approximate inverse of it, periodic on the grid
    without_belt: Filter  # the same of the half-space alone
    # [rows, cols] [m/Pa] the part of `influence` that is not of the half-space: of a belt in series
    further: Field
    # [rows] [m/Pa] the same on the last column where it is large enough to count, else 0
    along: Field
    # [rows, rows] [Pa/m] inverse of it, and of a strip as wide as the grid, see
    # `pressure/field/belt.py`; [0, 0] without
    belt: Field
    strip: Field
    # [rows, 2 cols - 1] `influence` from cols - 1 cells on one side to as many on the other
    mirrored: Field


class Buffers(NamedTuple):
    """Scratch of the convolutions, for one thread at a time."""

    filtering: FilterBuffers
    convolutions: Counts  # [1] how many were done


def make_half_space(
    rows: int, cols: int, cell_x: float, cell_y: float, modulus: float, further: Field | None = None
) -> HalfSpace:
    """Influence coefficients and transforms of a grid.

    rows, cols: number of cells along x and y; cell_x, cell_y: their size [m]; modulus: contact
    modulus E* [Pa]; further: influence [m/Pa] [rows, cols] of something else that yields under the
    pressure, in series with the half-space, as a belt does (`rigs/vehicle/field/inflated_belt.py`);
    the same for all columns, positive definite, and not growing with the distance within the size of a contact. Raises
    `ValueError` for sizes that are not positive and finite, counts that are not whole or outside 1
    to 4096, and a `further` of another shape or with a larger value than that of the loaded cell. A
    ratio cell_x/cell_y up to 100 either way is fine.
    """
    rows = require_count("half-space: rows", rows, least=MINIMUM_CELLS, most=MAXIMUM_CELLS)
    cols = require_count("half-space: cols", cols, least=MINIMUM_CELLS, most=MAXIMUM_CELLS)
    for name, value, unit in (("cell_x", cell_x, "m"), ("cell_y", cell_y, "m"), ("modulus", modulus, "Pa")):
        require_positive(f"half-space: {name}", value, unit)
    # In series with the half-space: displacements under one pressure add up
    influence = love_coefficients(rows, cols, cell_x, cell_y) / (numpy.pi * modulus)
    if further is not None:
        largest = float(further[0, 0]) if numpy.shape(further) == (rows, cols) else numpy.inf
        influence += require_values("half-space: further", further, "m/Pa", shape=(rows, cols), most=largest)
    return _half_space(
        influence, _further(influence, cell_x, cell_y, modulus), float(cell_x), float(cell_y), float(modulus)
    )


def part_of(whole: HalfSpace, rows: int, cols: int) -> HalfSpace:
    """A smaller grid, [rows, cols], of the same cells: what yields under them is the same.

    Raises `ValueError` for more rows or cols than the whole has, and for fewer than 1.
    """
    rows = require_count("half-space: rows", rows, least=MINIMUM_CELLS, most=whole.rows)
    cols = require_count("half-space: cols", cols, least=MINIMUM_CELLS, most=whole.cols)
    if (rows, cols) == (whole.rows, whole.cols):
        return whole
    influence, further = whole.influence[:rows, :cols], whole.further[:rows, :cols]
    return _half_space(influence, further, whole.cell_x, whole.cell_y, whole.modulus)


def coarsened(fine: HalfSpace) -> HalfSpace:
    """The same surface in cells of twice the size; rows and cols must be even.

    A coarse cell spreads its pressure over its four fine cells and takes the mean of their
    displacements: of the pairs of fine cells, 1, 2 and 1 of 4 lie one cell nearer, as far and one
    cell farther along each side. Raises `ValueError` for an odd count.
    """
    if fine.rows % 2 or fine.cols % 2:
        raise ValueError(f"half-space: {fine.rows} rows, {fine.cols} cols: even numbers are needed to halve them")
    far_rows, far_cols = numpy.arange(0, fine.rows, 2), numpy.arange(0, fine.cols, 2)
    influence = numpy.zeros((len(far_rows), len(far_cols)))
    for i, along_x in ((-1, 1.0), (0, 2.0), (1, 1.0)):
        for j, along_y in ((-1, 1.0), (0, 2.0), (1, 1.0)):
            influence += 0.25 * along_x * along_y * fine.influence[abs(far_rows + i)][:, abs(far_cols + j)]
    cell_x, cell_y = 2.0 * fine.cell_x, 2.0 * fine.cell_y
    return _half_space(influence, _further(influence, cell_x, cell_y, fine.modulus), cell_x, cell_y, fine.modulus)


def _further(influence: Field, cell_x: float, cell_y: float, modulus: float) -> Field:
    """What an influence [rows, cols] [m/Pa] holds beside that of the half-space."""
    rows, cols = influence.shape
    return influence - love_coefficients(rows, cols, cell_x, cell_y) / (numpy.pi * modulus)


def _half_space(influence: Field, further: Field, cell_x: float, cell_y: float, modulus: float) -> HalfSpace:
    influence, further = numpy.ascontiguousarray(influence), numpy.ascontiguousarray(further)
    rows, cols = influence.shape
    belted = further[0, -1] > LEAST_FURTHER * influence[0, -1]
    without_belt = _preconditioner(rows, cols, cell_x, cell_y, modulus)
    with_belt = _preconditioner(rows, cols, cell_x, cell_y, modulus, further) if belted else without_belt
    return HalfSpace(
        rows=rows,
        cols=cols,
        cell_x=cell_x,
        cell_y=cell_y,
        modulus=modulus,
        influence=influence,
        transfer=_transfer(influence),
        preconditioner=filter_of(with_belt, rows, cols),
        without_belt=filter_of(without_belt, rows, cols),
        further=further,
        along=further[:, -1].copy() if belted else numpy.zeros(rows),
        belt=stiffness_of_belt(further[:, -1]) if belted else numpy.zeros((0, 0)),
        strip=_strip(without_belt, rows, cols) if belted else numpy.zeros((0, 0)),
        mirrored=numpy.ascontiguousarray(numpy.concatenate([influence[:, :0:-1], influence], axis=1)),
    )


def make_buffers(half_space: HalfSpace) -> Buffers:
    """Scratch that fits a half-space."""
    return Buffers(make_filter_buffers(half_space.rows, half_space.cols), numpy.zeros(1, dtype=numpy.int64))


def love_coefficients(rows: int, cols: int, cell_x: float, cell_y: float) -> Field:
    """Integral of 1/distance [m] over a cell whose centre is i cells along x and j along y away;
    shape [rows, cols].

    With `f(x, y) = x asinh(y/|x|) + y asinh(x/|y|)` the sum of f over the four corners, signs + - -
    +. The edges lie at odd multiples of half a cell, so no argument is zero.
    """
    x = (numpy.arange(rows)[:, None] + numpy.array([0.5, -0.5])[None, :]) * cell_x
    y = (numpy.arange(cols)[:, None] + numpy.array([0.5, -0.5])[None, :]) * cell_y
    total = numpy.zeros((rows, cols))
    for a, b, sign in ((0, 0, 1.0), (1, 0, -1.0), (0, 1, -1.0), (1, 1, 1.0)):
        along_x, along_y = x[:, a][:, None], y[:, b][None, :]
        corner = along_x * numpy.arcsinh(along_y / abs(along_x)) + along_y * numpy.arcsinh(along_x / abs(along_y))
        total += sign * corner
    return total


@entry
def displacement(half_space: HalfSpace, buffers: Buffers, pressure: Field, result: Field) -> None:
    """Surface displacement [m] under a pressure field [Pa], both float64 [rows, cols], contiguous by
    rows (others are a numba `TypingError`); `result` is overwritten.

    Shapes are not checked.
    """
    convolve(half_space, buffers, pressure, result)


@kernel
def convolve(half_space: HalfSpace, buffers: Buffers, field: Field, result: Field) -> None:
    """`result = K field`, a linear convolution; `result` may be `field` itself.

    field: [rows, cols] [Pa]; result: [rows, cols] [m].
    """
    buffers.convolutions[0] += 1
    if is_zero(field):
        result[:] = 0.0
    else:
        apply_filter(half_space.transfer, buffers.filtering, field, result)


@kernel
def precondition(inverse: Filter, buffers: Buffers, field: Field, result: Field) -> None:
    """`result = M field`, M an approximate inverse of K: the filter E* |q| / 2 on the unpadded
    grid.

    inverse: of a half-space with or without its belt; field: [rows, cols] [m]; result: [rows, cols]
    [Pa].
    """
    apply_filter(inverse, buffers.filtering, field, result)


@borrowing_kernel
def is_zero(field: Field) -> bool:
    """Whether all of a field [rows, cols] is zero."""
    rows, cols = field.shape
    for i in range(rows):
        others = 0
        for j in range(cols):
            others += 1 if field[i, j] != 0.0 else 0
        if others > 0:
            return False
    return True


def _transfer(influence: Field) -> Filter:
    """Filter of the even extension of the influence table, by zeros between its ends."""
    rows, cols = influence.shape
    full_rows, full_cols = good_shape(rows, cols)
    even = numpy.zeros((2 * full_rows, 2 * full_cols))
    even[:rows, :cols] = influence
    even[even.shape[0] - rows + 1 :, :cols] = influence[:0:-1]
    even[:, even.shape[1] - cols + 1 :] = even[:, cols - 1 : 0 : -1]
    return filter_of(numpy.fft.rfft2(even).real / even.size, rows, cols)


def _preconditioner(
    rows: int, cols: int, cell_x: float, cell_y: float, modulus: float, further: Field | None = None
) -> Field:
    """`E* sqrt(|q|^2 + q0^2) / 2` on the unpadded grid, divided by its number of cells; q0 keeps it
    definite.

    What yields `further` in series with the half-space adds the eigenvalues of its nearest circulant
    to the reciprocal.
    """
    plain_rows, plain_cols = good_shape(rows, cols)
    wave_x = 2.0 * numpy.pi * numpy.fft.fftfreq(plain_rows, cell_x)[:, None]
    wave_y = 2.0 * numpy.pi * numpy.fft.rfftfreq(plain_cols, cell_y)[None, :]
    floor = PRECONDITIONER_FLOOR * (1.0 / (plain_rows * cell_x) ** 2 + 1.0 / (plain_cols * cell_y) ** 2)
    stiffness = 0.5 * modulus * numpy.sqrt(wave_x**2 + wave_y**2 + floor)
    if further is not None:
        stiffness /= 1.0 + stiffness * _nearest_circulant(further, plain_rows, plain_cols)
    return numpy.ascontiguousarray(stiffness / (plain_rows * plain_cols))


def _nearest_circulant(table: Field, rows: int, cols: int) -> Field:
    """Eigenvalues of the circulant of `rows` x `cols` cells nearest to the convolution with an even
    table (T. Chan 1988).
    """
    for length in (rows, cols):
        near = numpy.arange(length)
        far = length - near
        last = table.shape[0] - 1
        weight = (near / length)[:, None]
        table = ((1.0 - weight) * table[numpy.minimum(near, last)] + weight * table[numpy.minimum(far, last)]).T
    return numpy.asarray(numpy.fft.rfft2(table).real)


def _strip(preconditioner: Field, rows: int, cols: int) -> Field:
    """Sums across a strip of `cols` cells of what the preconditioner makes of a clearance that is 1
    on another line of it, [rows, rows] [Pa/m].
    """
    plain_rows, half = preconditioner.shape
    plain_cols = good_shape(rows, cols)[1]
    power = abs(numpy.fft.rfft(numpy.ones(cols), plain_cols)) ** 2
    twice = numpy.where((numpy.arange(half) == 0) | (2 * numpy.arange(half) == plain_cols), 1.0, 2.0)
    along = numpy.fft.fft(preconditioner @ (power * twice)).real
    near = numpy.arange(rows)
    return numpy.ascontiguousarray(along[(near[:, None] - near) % plain_rows])
