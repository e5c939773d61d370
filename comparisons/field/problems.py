"""The four problems (a) to (d) that solvers of the pressure field are compared on."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.rigs.vehicle.work_precision.rolling_problem import LOAD, rolling_problem

__all__ = ["Field", "Problem", "hertz", "rough", "tire"]

Field = NDArray[numpy.float64]

HERTZ_RADIUS, HERTZ_CONTACT = 2.0, 0.25  # of a unit square
HURST, LOWEST, HIGHEST, SLOPE = 0.8, 4, 64, 0.1  # waves a side; root of the mean square slope


class Problem(NamedTuple):
    """A half-space of square cells, a gap and a load."""

    rows: int
    cols: int
    cell: float  # [m]
    modulus: float  # [Pa] contact modulus E*
    load: float  # [N]
    periodic: bool  # repeats along both sides; else the half-space is free around the grid
    gap: Callable[[int], Field]  # [m] of a step
    cells: int = 1  # rows that the road moves in a step
    exact: Field | None = None  # [Pa] closed form at the cells' centres

    @property
    def mean_pressure(self) -> float:
        """Load over the area of the grid [Pa]."""
        return self.load / (self.rows * self.cols * self.cell**2)


def hertz(cells: int) -> Problem:
    """(a) A paraboloid of radius 2 on a unit square, E* = 1, contact radius a quarter of the side; free."""
    x = (numpy.arange(cells) + 0.5) / cells - 0.5
    squared = x[:, None] ** 2 + x[None, :] ** 2
    gap = numpy.ascontiguousarray(squared / (2.0 * HERTZ_RADIUS))
    peak = 2.0 * HERTZ_CONTACT / (numpy.pi * HERTZ_RADIUS)
    exact = peak * numpy.sqrt(numpy.maximum(1.0 - squared / HERTZ_CONTACT**2, 0.0))
    load = 4.0 * HERTZ_CONTACT**3 / (3.0 * HERTZ_RADIUS)
    return Problem(cells, cells, 1.0 / cells, 1.0, load, False, lambda _step: gap, exact=exact)


def rough(cells: int, mean_pressure: float, seed: int) -> Problem:
    """(b) A self-affine surface on a unit square, E* = 1, periodic: filtered white noise, spectrum `|q|^-(2 + 2 H)`."""
    side = numpy.fft.fftfreq(cells, 1.0 / cells)[:, None], numpy.fft.rfftfreq(cells, 1.0 / cells)[None, :]
    waves = numpy.hypot(*side)
    inside = (waves >= LOWEST) & (waves <= HIGHEST)
    amplitude = numpy.where(inside, numpy.where(inside, waves, 1.0) ** (-1.0 - HURST), 0.0)
    noise = numpy.fft.rfft2(numpy.random.default_rng(seed).standard_normal((cells, cells))) * amplitude
    slopes = [numpy.fft.irfft2(2j * numpy.pi * wave * noise, (cells, cells)) for wave in side]
    height = numpy.fft.irfft2(noise, (cells, cells)) * (SLOPE / numpy.sqrt(sum((one**2).mean() for one in slopes)))
    gap = numpy.ascontiguousarray(-height)
    return Problem(cells, cells, 1.0 / cells, 1.0, mean_pressure, True, lambda _step: gap)


def tire(grid: str, seed: int, cells: int = 1) -> Problem:
    """(c), (d) A tire patch on a rough road (`rigs/vehicle/studies/rolling_problem.py`), free; `cells`: travel of a step."""
    rolling = rolling_problem(grid, seed, cells)
    space = rolling.half_space
    return Problem(space.rows, space.cols, space.cell_x, space.modulus, LOAD, False, rolling.gap, cells)
