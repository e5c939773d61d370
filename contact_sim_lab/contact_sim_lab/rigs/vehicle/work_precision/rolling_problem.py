"""A tire patch rolling over a rough road: the problem that solvers of a rolling pressure field are
compared on.

E = 5 MPa, nu = 0.49 on a rigid road, 4 kN, a patch of 0.20 m (rolling) x 0.15 m, crown radii 0.3 m
(rolling) and 0.5 m (lateral). The road is an isotropic Gaussian surface, 1.6 m x 0.4 m and
periodic; the one-sided spectrum of any of its profiles is `256e-6 m^3 (n / 0.1)^-2` for wave
numbers n of 5 to 200 cycles/m (ISO 8608 class C continued to texture). It is made at 0.2/256 m;
coarser grids take every second node.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.pressure.field.halfspace import HalfSpace, make_half_space

__all__ = ["GRIDS", "LOAD", "RollingProblem", "rolling_problem", "rough_road"]

Field = NDArray[numpy.float64]

MODULUS = 5e6 / (1.0 - 0.49**2)  # [Pa]
LOAD = 4000.0  # [N]
PATCH = (0.20, 0.15)  # [m] x (rolling), y
RADII = (0.3, 0.5)  # [m] rolling, lateral
FINEST = 0.2 / 256  # [m]
ROAD = (2048, 512)  # nodes: 1.6 m x 0.4 m
ROUGHNESS, LOWEST, HIGHEST = 256e-6, 5.0, 200.0  # [m^3] at 0.1 cycles/m; [cycles/m]
FIRST = (100, 160)  # node of the finest road under the patch's corner at step 0
GRIDS = {"128x96": 2, "256x192": 1}  # every how many nodes of the finest road


class RollingProblem(NamedTuple):
    """A road under a patch on one grid."""

    half_space: HalfSpace
    crown: Field  # [m] [rows, cols]
    road: Field  # [m] the patch's columns of the road, one period
    cells: int  # the road moves in one step

    def gap(self, step: int) -> Field:
        """Undeformed gap in [m] at a step."""
        rows = numpy.arange(self.half_space.rows) + step * self.cells
        return numpy.ascontiguousarray(self.crown - self.road.take(rows, axis=0, mode="wrap"))


def rough_road(seed: int) -> Field:
    """Heights in [m] of the finest road: white noise, filtered by the root of the spectrum `(G
    0.1^2 / 4) |n|^-3`.
    """
    wave = numpy.hypot(numpy.fft.fftfreq(ROAD[0], FINEST)[:, None], numpy.fft.rfftfreq(ROAD[1], FINEST)[None, :])
    inside = (wave >= LOWEST) & (wave <= HIGHEST)
    density = numpy.where(inside, 0.25 * ROUGHNESS * 0.01 * numpy.where(inside, wave, 1.0) ** -3.0, 0.0)
    noise = numpy.fft.rfft2(numpy.random.default_rng(seed).standard_normal(ROAD))
    return numpy.ascontiguousarray(numpy.fft.irfft2(noise * numpy.sqrt(density) / FINEST, ROAD))


def rolling_problem(grid: str, seed: int, cells: int = 1) -> RollingProblem:
    """The problem on one of `GRIDS`; `cells`: travel of a step."""
    every = GRIDS[grid]
    cell = FINEST * every
    rows, cols = round(PATCH[0] / cell), round(PATCH[1] / cell)
    x = (numpy.arange(rows) - 0.5 * (rows - 1)) * cell
    y = (numpy.arange(cols) - 0.5 * (cols - 1)) * cell
    crown = x[:, None] ** 2 / (2.0 * RADII[0]) + y[None, :] ** 2 / (2.0 * RADII[1])
    road = numpy.roll(rough_road(seed), -FIRST[0], axis=0)[::every, FIRST[1] :: every][:, :cols]
    return RollingProblem(make_half_space(rows, cols, cell, cell, MODULUS), crown, numpy.ascontiguousarray(road), cells)
