"""One tire patch, smooth or rough, on any grid: every grid sees the same surfaces at its own cell
centres.

The patch, the crown, the modulus, the load and the road are those of `rolling_problem`. There
coarser grids take every second node, which moves the crown over the road by half a node from grid
to grid. Here the road is summed from its waves at the cell centres, so that what is left between
two grids is the error of the grid alone.
"""

from __future__ import annotations

import functools
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.rigs.vehicle.work_precision.rolling_problem import (
    FINEST,
    FIRST,
    HIGHEST,
    LOAD,
    MODULUS,
    PATCH,
    RADII,
    ROAD,
    rough_road,
)
from contact_sim_pkg.pressure.field.halfspace import HalfSpace, make_half_space

__all__ = [
    "CURVATURES",
    "LOAD",
    "MODULUS",
    "PATCH",
    "Cells",
    "PatchProblem",
    "centres",
    "means_over",
    "patch_problem",
    "road_heights",
]

Field = NDArray[numpy.float64]
Cells = tuple[int, int]

CURVATURES = (0.5 / RADII[0], 0.5 / RADII[1])
"""Of the crown's gap A x^2 + B y^2 [1/m]: along x (rolling) and y."""


class PatchProblem(NamedTuple):
    """The gap of the patch on one grid."""

    half_space: HalfSpace
    gap: Field  # [m] [rows, cols], zero where the crown's lowest point would touch a flat road


def patch_problem(cells: Cells, seed: int | None = None) -> PatchProblem:
    """The patch on a grid of rows, cols; `seed` of the road, or None for a smooth one."""
    rows, cols = cells
    cell_x, cell_y = PATCH[0] / rows, PATCH[1] / cols
    x, y = centres(rows, cell_x), centres(cols, cell_y)
    gap = CURVATURES[0] * x[:, None] ** 2 + CURVATURES[1] * y[None, :] ** 2
    if seed is not None:
        gap = gap - road_heights(seed, x, y)
    return PatchProblem(make_half_space(rows, cols, cell_x, cell_y, MODULUS), numpy.ascontiguousarray(gap))


def centres(count: int, cell: float) -> Field:
    """Cell centres [m] of a row of cells around 0."""
    return numpy.asarray((numpy.arange(count, dtype=numpy.float64) - 0.5 * (count - 1)) * cell)


def road_heights(seed: int, x: Field, y: Field) -> Field:
    """Heights [m] of the road of `rolling_problem`, [len(x), len(y)], at x, y [m] from the middle
    of the patch.

    The road has no wave above half its sampling rate, so the sum over its waves goes through its
    nodes and is exact between.
    """
    waves = _waves(seed)
    along = numpy.arange(waves.shape[0]) - waves.shape[0] // 2
    start_x, start_y = FIRST[0] * FINEST + 0.5 * PATCH[0], FIRST[1] * FINEST + 0.5 * PATCH[1]
    turn_x = numpy.exp(2j * numpy.pi / (ROAD[0] * FINEST) * (x[:, None] + start_x) * along[None, :])
    turn_y = numpy.exp(2j * numpy.pi / (ROAD[1] * FINEST) * numpy.arange(waves.shape[1])[:, None] * (y[None] + start_y))
    return numpy.asarray((turn_x @ waves @ turn_y).real)


@functools.cache
def _waves(seed: int) -> NDArray[numpy.complex128]:
    """Complex amplitudes [m]: wave numbers along x from negative to positive, across from 0."""
    spectrum = numpy.fft.rfft2(rough_road(seed)) / (ROAD[0] * ROAD[1])
    most_x, most_y = (int(HIGHEST * nodes * FINEST) + 1 for nodes in ROAD)
    waves = numpy.concatenate([spectrum[-most_x:, : most_y + 1], spectrum[: most_x + 1, : most_y + 1]])
    waves[:, 1:] *= 2.0
    return numpy.asarray(waves)


def means_over(fine: Field, cells: Cells) -> Field:
    """Means over the cells of a coarser grid whose rows and cols divide those of the finer one."""
    rows, cols = cells
    if fine.shape[0] % rows or fine.shape[1] % cols:
        raise ValueError(f"a grid of {fine.shape} cells has no whole number of them in each cell of a grid of {cells}")
    return numpy.asarray(fine.reshape(rows, fine.shape[0] // rows, cols, fine.shape[1] // cols).mean(axis=(1, 3)))
