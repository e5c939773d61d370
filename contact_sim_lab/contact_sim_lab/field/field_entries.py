"""Every way into the pressure field behind one call, so that what must hold is checked for all of
them.

Static, windowed and rolling, each at a given load and at a given approach; rolling also with two
fields behind it, of another gap and of this one a cell further, so that prediction and window take
part.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.field.windowed import WindowedSolver
from contact_sim_pkg.pressure.field.halfspace import HalfSpace
from contact_sim_pkg.pressure.field.rolling import RollingField
from contact_sim_pkg.pressure.field.solver import FieldResult, make_workspace, solve_at_approach, solve_at_load

__all__ = ["ENTRIES", "Entry", "SolveRequest", "holds_load"]

Field = NDArray[numpy.float64]


class SolveRequest(NamedTuple):
    """One contact, by its load and by its approach, and how well it is wanted."""

    load: float  # [N]
    approach: float  # [m]
    tolerance: float = 1e-10
    cap: int = 2000


Entry = Callable[[HalfSpace, Field, SolveRequest], tuple[Field, FieldResult]]


def _static_load(half_space: HalfSpace, gap: Field, request: SolveRequest) -> tuple[Field, FieldResult]:
    pressure = numpy.zeros(gap.shape)
    arguments = (half_space, make_workspace(half_space), gap, request.load, request.tolerance, request.cap, pressure)
    return pressure, solve_at_load(*arguments)


def _static_approach(half_space: HalfSpace, gap: Field, request: SolveRequest) -> tuple[Field, FieldResult]:
    pressure = numpy.zeros(gap.shape)
    arguments = (
        half_space,
        make_workspace(half_space),
        gap,
        request.approach,
        request.tolerance,
        request.cap,
        pressure,
    )
    return pressure, solve_at_approach(*arguments)


def _windowed_load(half_space: HalfSpace, gap: Field, request: SolveRequest) -> tuple[Field, FieldResult]:
    pressure, solver = numpy.zeros(gap.shape), WindowedSolver(half_space)
    return pressure, solver.solve_at_load(gap, request.load, request.tolerance, request.cap, pressure)


def _windowed_approach(half_space: HalfSpace, gap: Field, request: SolveRequest) -> tuple[Field, FieldResult]:
    pressure, solver = numpy.zeros(gap.shape), WindowedSolver(half_space)
    return pressure, solver.solve_at_approach(gap, request.approach, request.tolerance, request.cap, pressure)


def _rolling_load(half_space: HalfSpace, gap: Field, request: SolveRequest) -> tuple[Field, FieldResult]:
    field = RollingField(half_space)
    return field.pressure, field.solve_at_load(gap, request.load, request.tolerance, request.cap)


def _rolling_approach(half_space: HalfSpace, gap: Field, request: SolveRequest) -> tuple[Field, FieldResult]:
    field = RollingField(half_space)
    return field.pressure, field.solve_at_approach(gap, request.approach, request.tolerance, request.cap)


def _rolled_load(half_space: HalfSpace, gap: Field, request: SolveRequest) -> tuple[Field, FieldResult]:
    field = _rolled(half_space, gap, request)
    return field.pressure, field.solve_at_load(gap, request.load, request.tolerance, request.cap)


def _rolled_approach(half_space: HalfSpace, gap: Field, request: SolveRequest) -> tuple[Field, FieldResult]:
    field = _rolled(half_space, gap, request)
    return field.pressure, field.solve_at_approach(gap, request.approach, request.tolerance, request.cap)


def _rolled(half_space: HalfSpace, gap: Field, request: SolveRequest) -> RollingField:
    """A field with two steps behind it: a bowl around the middle, and (where it has heights) this
    gap one row earlier.
    """
    field = RollingField(half_space)
    x = (numpy.arange(half_space.rows) - 0.5 * (half_space.rows - 1)) * half_space.cell_x
    y = (numpy.arange(half_space.cols) - 0.5 * (half_space.cols - 1)) * half_space.cell_y
    extent = half_space.rows * half_space.cell_x
    bowl = (x[:, None] ** 2 + y[None, :] ** 2) / extent
    field.solve_at_approach(bowl, 0.02 * extent, 1e-3, request.cap)
    field.roll(1)
    if numpy.isfinite(gap).all():
        field.solve_at_approach(numpy.roll(gap, 1, axis=0), request.approach, 1e-3, request.cap)
        field.roll(1)
    return field


ENTRIES: dict[str, Entry] = {
    "static, load": _static_load,
    "static, approach": _static_approach,
    "windowed, load": _windowed_load,
    "windowed, approach": _windowed_approach,
    "rolling, load": _rolling_load,
    "rolling, approach": _rolling_approach,
    "rolled, load": _rolled_load,
    "rolled, approach": _rolled_approach,
}


def holds_load(name: str) -> bool:
    """Whether the entry is given a load."""
    return name.endswith("load")
