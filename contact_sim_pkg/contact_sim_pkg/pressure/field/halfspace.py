"""The elastic half-space on a grid: influence of a loaded cell, and the displacement field of a
pressure field.

The normal displacement of the surface under a pressure p is `u(x, y) = 1/(pi E*) * integral of p /
distance`. With p constant in each cell this is a discrete convolution with Love's coefficients,
done here as a *linear* convolution (zero-padded transforms: no periodic images). Because the
coefficients are even in both directions their transform is real. Only the needed parts are
transformed: loaded rows on the way in, grid rows on the way out.

Sources: Love (1929), Phil. Trans. R. Soc. A 228, 377; Stanley and Kato (1997), J. Tribology 119,
481.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require_count, require_positive, require_values
from contact_sim_pkg.compiled.jit import borrowing_kernel, entry, kernel
from contact_sim_pkg.compiled.transforms import good_size, rocket_fft
from contact_sim_pkg.pressure.field.belt import stiffness_of_belt

__all__ = ["Buffers", "HalfSpace", "coarsened", "displacement", "make_buffers", "make_half_space", "part_of"]

Field = NDArray[numpy.float64]
Spectrum = NDArray[numpy.complex128]
Axis = NDArray[numpy.int64]

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
    # [padded rows, padded cols/2+1] real transform of `influence`, divided by the padded size
    transfer: Field
    # [rows', cols'/2+1] approximate inverse of `transfer` on the unpadded grid
    preconditioner: Field
    # [rows', cols'/2+1] the same of the half-space alone
    without_belt: Field
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
    """Scratch arrays of the transforms, for one thread at a time."""

    padded: Field  # [rows, padded cols] real; the right part stays zero
    spectrum: Spectrum  # [padded rows, padded cols/2+1] complex
    plain: Field  # [rows', cols'] real, for the preconditioner
    plain_spectrum: Spectrum  # [rows', cols'/2+1] complex
    row_axis: Axis
    col_axis: Axis
    convolutions: Axis  # [1] how many were done


def make_half_space(
    rows: int, cols: int, cell_x: float, cell_y: float, modulus: float, further: Field | None = None
) -> HalfSpace:
    """Influence coefficients and transforms of a grid.

    rows, cols: number of cells along x and y; cell_x, cell_y: their size [m]; modulus: contact
    modulus E* [Pa]; further: influence [m/Pa] [rows, cols] of something else that yields under the
    pressure, in series with the half-space, as a belt does (`rigs/vehicle/tire/inflated_belt.py`);
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
    return HalfSpace(
        rows=rows,
        cols=cols,
        cell_x=cell_x,
        cell_y=cell_y,
        modulus=modulus,
        influence=influence,
        transfer=_transfer(influence),
        preconditioner=_preconditioner(rows, cols, cell_x, cell_y, modulus, further) if belted else without_belt,
        without_belt=without_belt,
        further=further,
        along=further[:, -1].copy() if belted else numpy.zeros(rows),
        belt=stiffness_of_belt(further[:, -1]) if belted else numpy.zeros((0, 0)),
        strip=_strip(without_belt, rows, cols) if belted else numpy.zeros((0, 0)),
        mirrored=numpy.ascontiguousarray(numpy.concatenate([influence[:, :0:-1], influence], axis=1)),
    )


def make_buffers(half_space: HalfSpace) -> Buffers:
    """Scratch arrays that fit a half-space."""
    rows, cols = half_space.rows, half_space.cols
    padded_rows = half_space.transfer.shape[0]
    # A periodic transfer has no padding
    padded_cols = cols if padded_rows == rows else _padded(cols)
    plain_rows, plain_cols = _good(rows), _good(cols)
    return Buffers(
        numpy.zeros((rows, padded_cols)),
        numpy.zeros((padded_rows, padded_cols // 2 + 1), dtype=numpy.complex128),
        numpy.zeros((plain_rows, plain_cols)),
        numpy.zeros((plain_rows, plain_cols // 2 + 1), dtype=numpy.complex128),
        numpy.array([0], dtype=numpy.int64),
        numpy.array([1], dtype=numpy.int64),
        numpy.zeros(1, dtype=numpy.int64),
    )


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
    """Surface displacement [m] under a pressure field [Pa], both float64 [rows, cols]; `result` is
    overwritten.

    Not checked.
    """
    convolve(half_space, buffers, pressure, result)


@kernel
def convolve(half_space: HalfSpace, buffers: Buffers, field: Field, result: Field) -> None:
    """`result = K field` by one pruned, zero-padded transform pair; `result` may be `field`
    itself.

    field: [rows, cols] [Pa]; result: [rows, cols] [m].
    """
    rows, cols = field.shape
    padded, spectrum, transfer = buffers.padded, buffers.spectrum, half_space.transfer
    buffers.convolutions[0] += 1
    first, last = load_padded(field, padded)
    if first >= last:
        result[:] = 0.0
        return
    # Rows without pressure have no spectrum: they are not transformed
    spectrum[:first] = 0.0
    spectrum[last:] = 0.0
    rocket_fft.r2c(padded[first:last], spectrum[first:last], buffers.col_axis, True, 1.0, 1)
    rocket_fft.c2c(spectrum, spectrum, buffers.row_axis, True, 1.0, 1)
    multiply(spectrum, transfer)
    rocket_fft.c2c(spectrum, spectrum, buffers.row_axis, False, 1.0, 1)
    rocket_fft.c2r(spectrum[:rows], padded, buffers.col_axis, False, 1.0, 1)
    # Unpad, and leave the padding zero for the next call
    for i in range(rows):
        for j in range(cols):
            result[i, j] = padded[i, j]
        for j in range(cols, padded.shape[1]):
            padded[i, j] = 0.0


@kernel
def precondition(inverse: Field, buffers: Buffers, field: Field, result: Field) -> None:
    """`result = M field`, M an approximate inverse of K: the filter E* |q| / 2 on the unpadded
    grid.

    inverse: [rows', cols'/2+1], of a half-space with or without its belt; field: [rows, cols] [m];
    result: [rows, cols] [Pa].
    """
    rows, cols = field.shape
    plain, spectrum = buffers.plain, buffers.plain_spectrum
    # The transform has a size of small prime factors; a grid of another size is padded
    fits = plain.shape == field.shape
    if fits:
        rocket_fft.r2c(field, spectrum, buffers.col_axis, True, 1.0, 1)
    else:
        for i in range(plain.shape[0]):
            for j in range(plain.shape[1]):
                plain[i, j] = field[i, j] if i < rows and j < cols else 0.0
        rocket_fft.r2c(plain, spectrum, buffers.col_axis, True, 1.0, 1)
    rocket_fft.c2c(spectrum, spectrum, buffers.row_axis, True, 1.0, 1)
    multiply(spectrum, inverse)
    rocket_fft.c2c(spectrum, spectrum, buffers.row_axis, False, 1.0, 1)
    if fits:
        rocket_fft.c2r(spectrum, result, buffers.col_axis, False, 1.0, 1)
        return
    rocket_fft.c2r(spectrum, plain, buffers.col_axis, False, 1.0, 1)
    for i in range(rows):
        for j in range(cols):
            result[i, j] = plain[i, j]


@borrowing_kernel
def load_padded(field: Field, padded: Field) -> tuple[int, int]:
    """Copy a field into the padded rows; returns the first row that is not all zero and the row
    after the last such.

    field: [rows, cols]; padded: [rows, padded cols].
    """
    rows, cols = field.shape
    first, last = rows, 0
    for i in range(rows):
        loaded = 0
        for j in range(cols):
            padded[i, j] = field[i, j]
            loaded += 1 if field[i, j] != 0.0 else 0
        if loaded > 0:
            first, last = min(first, i), i + 1
    return first, last


@borrowing_kernel
def multiply(spectrum: Spectrum, factor: Field) -> None:
    """`spectrum *= factor`, complex by real.

    Both: [rows, cols / 2 + 1] of the transform.
    """
    for i in range(spectrum.shape[0]):
        for j in range(spectrum.shape[1]):
            spectrum[i, j] = complex(spectrum[i, j].real * factor[i, j], spectrum[i, j].imag * factor[i, j])


def _good(count: int) -> int:
    """The next length that the transform is fast for."""
    return good_size(count) if count > 1 else 2


def _padded(count: int) -> int:
    """Length of a linear convolution of `count` cells: at least 2 count - 1."""
    return _good(2 * count)


def _transfer(influence: Field) -> Field:
    """Real transform of the even extension of the influence table, divided by the number of padded
    cells.
    """
    rows, cols = influence.shape
    even = numpy.zeros((_padded(rows), _padded(cols)))
    even[:rows, :cols] = influence
    even[even.shape[0] - rows + 1 :, :cols] = influence[:0:-1]
    even[:, even.shape[1] - cols + 1 :] = even[:, cols - 1 : 0 : -1]
    return numpy.ascontiguousarray(numpy.fft.rfft2(even).real / even.size)


def _preconditioner(
    rows: int, cols: int, cell_x: float, cell_y: float, modulus: float, further: Field | None = None
) -> Field:
    """`E* sqrt(|q|^2 + q0^2) / 2` on the unpadded grid, divided by its number of cells; q0 keeps it
    definite.

    What yields `further` in series with the half-space adds the eigenvalues of its nearest circulant
    to the reciprocal.
    """
    plain_rows, plain_cols = _good(rows), _good(cols)
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
    plain_cols = _good(cols)
    power = abs(numpy.fft.rfft(numpy.ones(cols), plain_cols)) ** 2
    twice = numpy.where((numpy.arange(half) == 0) | (2 * numpy.arange(half) == plain_cols), 1.0, 2.0)
    along = numpy.fft.fft(preconditioner @ (power * twice)).real
    near = numpy.arange(rows)
    return numpy.ascontiguousarray(along[(near[:, None] - near) % plain_rows])
