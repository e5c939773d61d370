"""Influence coefficients and convolution against Love's logarithms in multiple precision and dense products."""

from __future__ import annotations

import numpy
import pytest
from numba.core.errors import TypingError
from scipy.signal import fftconvolve

from contact_sim_lab.twins import halfspace as reference
from contact_sim_pkg.pressure.field.halfspace import (
    _nearest_circulant,
    coarsened,
    displacement,
    love_coefficients,
    make_buffers,
    make_half_space,
    part_of,
)
from contact_sim_pkg.pressure.settings import BeltSettings
from contact_sim_pkg.rigs.vehicle.field.envelopment import belt_influence

MODULUS = 3.7e6


@pytest.mark.parametrize(("cell_x", "cell_y"), [(1.0, 1.0), (1.0, 0.01), (0.003, 0.3), (1e-9, 2e-9)])
def test_influence_equals_love_s_logarithms(cell_x: float, cell_y: float) -> None:
    table = love_coefficients(40, 30, cell_x, cell_y) / (numpy.pi * MODULUS)
    for i in (0, 1, 2, 7, 39):
        for j in (0, 1, 3, 29):
            expected = reference.cell_displacement(i * cell_x, j * cell_y, cell_x / 2, cell_y / 2, MODULUS)
            assert table[i, j] == pytest.approx(expected, rel=1e-11), (i, j)


@pytest.mark.parametrize("field", [numpy.ones((20, 20))[3:12, 4:15], numpy.ones((9, 11), order="F")])
def test_a_field_that_is_not_contiguous_is_refused_and_not_misread(field: numpy.ndarray) -> None:
    half_space, result = make_half_space(9, 11, 1e-3, 1e-3, MODULUS), numpy.empty((9, 11))
    with pytest.raises(TypingError, match="must be float64 and contiguous by rows"):
        displacement(half_space, make_buffers(half_space), field, result)


def test_a_far_cell_acts_as_a_point_load() -> None:
    table = love_coefficients(1000, 1, 2e-3, 3e-3)
    assert table[999, 0] == pytest.approx(2e-3 * 3e-3 / (999 * 2e-3), rel=1e-5)


@pytest.mark.parametrize("shape", [(1, 1), (1, 5), (5, 1), (2, 2), (7, 11), (13, 8), (24, 24)])
def test_displacement_equals_the_dense_product(shape: tuple[int, int]) -> None:
    half_space = make_half_space(*shape, 1e-3, 2.5e-3, MODULUS)
    pressure = numpy.random.default_rng(5).random(shape)
    result = numpy.empty(shape)
    displacement(half_space, make_buffers(half_space), pressure, result)
    dense = reference.dense_influence(*shape, 1e-3, 2.5e-3, MODULUS)
    assert result == pytest.approx(reference.displacement(dense, pressure), rel=1e-13)


@pytest.mark.parametrize("loaded", [(0, 1), (3, 9), (40, 64), (0, 64)])
def test_displacement_is_right_whichever_rows_are_loaded(loaded: tuple[int, int]) -> None:
    half_space = make_half_space(64, 48, 2e-3, 3e-3, MODULUS)
    buffers, result = make_buffers(half_space), numpy.empty((64, 48))
    displacement(half_space, buffers, numpy.ones((64, 48)), result)  # leaves its traces in the buffers
    pressure = numpy.zeros((64, 48))
    pressure[slice(*loaded)] = numpy.random.default_rng(2).random((loaded[1] - loaded[0], 48))
    displacement(half_space, buffers, pressure, result)
    row, col = abs(numpy.arange(-63, 64)), abs(numpy.arange(-47, 48))
    expected = fftconvolve(pressure, half_space.influence[row][:, col], mode="full")[63:127, 47:95]
    assert result == pytest.approx(expected, rel=1e-11)


def test_a_zero_pressure_gives_exactly_no_displacement() -> None:
    half_space = make_half_space(9, 6, 1e-3, 1e-3, MODULUS)
    result = numpy.full((9, 6), numpy.nan)
    displacement(half_space, make_buffers(half_space), numpy.zeros((9, 6)), result)
    assert not result.any()


def test_there_are_no_periodic_images() -> None:
    half_space = make_half_space(32, 32, 1e-3, 1e-3, MODULUS)
    pressure, result = numpy.zeros((32, 32)), numpy.empty((32, 32))
    pressure[0, 0] = 1.0
    displacement(half_space, make_buffers(half_space), pressure, result)
    assert result[31, 31] == pytest.approx(1e-6 / (numpy.pi * MODULUS * 31e-3 * 2**0.5), rel=1e-3)


def test_displacement_of_uniform_pressure_at_the_centre_is_that_of_a_loaded_square() -> None:
    half_space = make_half_space(33, 33, 1e-3, 1e-3, MODULUS)
    result = numpy.empty((33, 33))
    displacement(half_space, make_buffers(half_space), numpy.ones((33, 33)), result)
    side = 33e-3
    assert result[16, 16] == pytest.approx(4.0 * side * numpy.log(1.0 + 2.0**0.5) / (numpy.pi * MODULUS), rel=1e-12)


@pytest.mark.parametrize(
    ("arguments", "fault"),
    [
        ((0, 5, 1.0, 1.0, 1.0), "rows 0: a finite number at least 1 and at most 4096 is needed"),
        ((5, 5000, 1.0, 1.0, 1.0), "cols 5000"),
        ((5, 5, 0.0, 1.0, 1.0), "cell_x"),
        ((5, 5, 1.0, numpy.nan, 1.0), "cell_y"),
        ((5, 5, 1.0, 1.0, -2.0), "modulus"),
    ],
)
def test_impossible_grids_are_refused(arguments: tuple[int, int, float, float, float], fault: str) -> None:
    with pytest.raises(ValueError, match=fault):
        make_half_space(*arguments)


def test_a_part_of_a_grid_is_the_grid_of_that_size() -> None:
    part, alone = (
        part_of(make_half_space(20, 14, 2e-3, 3e-3, MODULUS), 9, 5),
        make_half_space(9, 5, 2e-3, 3e-3, MODULUS),
    )
    for one, other in zip(part, alone, strict=True):
        assert numpy.array_equal(one, other)


def test_a_coarse_cell_moves_as_the_mean_of_its_fine_cells() -> None:
    shape = (12, 8)
    coarse = coarsened(make_half_space(*shape, 2e-3, 3e-3, MODULUS))
    pressure, result = numpy.random.default_rng(3).random((6, 4)), numpy.empty((6, 4))
    displacement(coarse, make_buffers(coarse), pressure, result)
    dense = reference.dense_influence(*shape, 2e-3, 3e-3, MODULUS)
    fine = reference.displacement(dense, numpy.repeat(numpy.repeat(pressure, 2, axis=0), 2, axis=1))
    assert result == pytest.approx(fine.reshape(6, 2, 4, 2).mean(axis=(1, 3)), rel=1e-12)


def test_what_yields_further_adds_its_displacement() -> None:
    further = 1e-9 / (1.0 + numpy.add.outer(numpy.arange(7.0), numpy.arange(6.0)))
    both, plain = make_half_space(7, 6, 2e-3, 3e-3, MODULUS, further), make_half_space(7, 6, 2e-3, 3e-3, MODULUS)
    pressure, with_it, without = numpy.random.default_rng(4).random((7, 6)), numpy.empty((7, 6)), numpy.empty((7, 6))
    displacement(both, make_buffers(both), pressure, with_it)
    displacement(plain, make_buffers(plain), pressure, without)
    rows, cols = abs(numpy.arange(-6, 7)), abs(numpy.arange(-5, 6))
    expected = fftconvolve(pressure, further[rows][:, cols], mode="full")[6:13, 5:11]
    assert with_it - without == pytest.approx(expected, rel=1e-9)


def test_the_circulant_of_a_table_is_the_nearest_to_its_matrix() -> None:
    rows, cols = 5, 4
    table = numpy.exp(-0.4 * numpy.arange(rows))[:, None] / (1.0 + numpy.arange(cols))
    row, col = numpy.divmod(numpy.arange(rows * cols), cols)
    down, across = row[:, None] - row, col[:, None] - col
    dense = table[abs(down), abs(across)]
    nearest = numpy.array(  # in the Frobenius norm: the mean over all entries that a circulant has in common
        [[dense[(down % rows == i) & (across % cols == j)].mean() for j in range(cols)] for i in range(rows)]
    )
    assert _nearest_circulant(table, rows, cols) == pytest.approx(numpy.fft.rfft2(nearest).real, abs=1e-12)


def test_a_belt_is_seen_in_the_influence_and_coarser_cells_are_not_taken_for_one() -> None:
    size = (48, 64, 6e-3, 7e-3)
    plain = make_half_space(*size, MODULUS)
    assert not len(plain.belt)
    assert not len(coarsened(plain).belt)
    assert not len(part_of(plain, 20, 12).belt)
    for belt in (BeltSettings(9900.0, 6.3e5), BeltSettings(9900.0, 3e6)):
        belted = make_half_space(*size, MODULUS, belt_influence(belt, *size))
        assert belted.belt.shape == (48, 48)
        assert part_of(belted, 24, 20).belt.shape == (24, 24)
        assert coarsened(belted).belt.shape == (24, 24)
