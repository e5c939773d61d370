"""Accuracy and cost of the pressure fields: error of the grid beside error of the solver, for each
level.
"""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.twins.halfspace import dense_influence, pressure_at_approach
from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.rigs.vehicle.field.contact_field import PressureField
from contact_sim_pkg.rigs.vehicle.field.envelopment import yielding_of
from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.rigs.vehicle.seat.mass import occupant_mass
from contact_sim_pkg.rigs.vehicle.seat.schema import HalfSpaceField, SeatSection
from contact_sim_pkg.rigs.vehicle.seat.shape import seat_gap_on
from contact_sim_pkg.rigs.vehicle.tire.body import body_of
from contact_sim_pkg.rigs.vehicle.tire.force_table import gap_over_level_road
from contact_sim_pkg.rigs.vehicle.tire.lattice import plain_load
from contact_sim_pkg.rigs.vehicle.tire.schema import TireField
from contact_sim_pkg.run.sources import make_road, make_travel
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.accuracy import LEVELS
from contact_sim_pkg.scene.schema.pressure_field import PressureFieldSection

__all__ = ["bench_solves", "field_rows", "first_solve"]

Field = NDArray[numpy.float64]
Cells = tuple[int, int]
INSTANTS, FEW = 12, 3  # consecutive field instants around the middle of the first two seconds
MIDDLE = 1.0  # [s]
LOAD_SWING = 0.2  # of the standing load, up and down over the instants
CONVERGED_TOLERANCE = 1e-10
CHECK_ROWS, CHECK_COLS = 24, 24
CHECK_REPEATS = 5
CHECK_TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-6, 1e-8)
OWN_GRID, OWN_SOLVER = "own code, grid {}x{}", "own code, same grid to 1e-10"
DENSE = "dense NNLS (scipy), no shared code"


class FieldProblem(NamedTuple):
    """One contact's field: grid, gaps [m] at consecutive instants (one, where the shape is fixed),
    standing load [N].
    """

    settings: FieldSettings
    contact: str
    gaps: list[Field]
    load: float


class FieldSolution(NamedTuple):
    """Fields of one contact at the instants, on one grid."""

    pressures: list[Field]  # [Pa]
    approaches: Field  # [m]
    seconds: float  # median a solve, started from the field before


def field_rows(scene: ResolvedScene, notify: Callable[[str], None]) -> list[dict[str, Any]]:
    """Rows of each contact whose pressure field the scene has: solver, grid, and the check
    against another code.
    """
    rows: list[dict[str, Any]] = []
    contacts: tuple[str, ...] = ("tire", "seat")
    for contact in contacts:
        if scene.effect(contact, PressureFieldSection) is not None:
            rows += _rungs(scene, contact, notify)
            rows += _independent(scene, contact, notify)
    return rows


def first_solve(scene: ResolvedScene) -> float | None:
    """Time [s] of the scene's first field, tables and kernels included; None without a field."""
    if all(scene.effect(contact, PressureFieldSection) is None for contact in scene.data["effects"]):
        return None
    began = time.perf_counter()
    build(scene)  # fits the tangent: two solves
    return time.perf_counter() - began


def bench_solves(scene: ResolvedScene, cells: Cells, tolerance: float) -> tuple[float, float, float]:
    """Time [ms] of a solve of the tire's field, cold and from the field before (medians), and its
    worst L2 error [1] against 1e-10.
    """
    problem = _problem(scene, "tire", cells, tolerance)
    warm = _solve(problem)
    walls = []
    for gap in problem.gaps:
        field = PressureField(problem.settings, "tire")
        began = time.perf_counter()
        field.solve_load(gap, problem.load)
        walls.append(time.perf_counter() - began)
    converged = _solve(_problem(scene, "tire", cells, CONVERGED_TOLERANCE))
    return 1e3 * statistics.median(walls), 1e3 * warm.seconds, _errors(warm, converged)["pressure (L2)"]


def _rungs(scene: ResolvedScene, contact: str, notify: Callable[[str], None]) -> list[dict[str, Any]]:
    grids = {"tire": TireField, "seat": HalfSpaceField}[contact].levels_of(scene)
    finest = (2 * grids[-1].rows, 2 * grids[-1].cols)
    notify(f"{contact} field: reference grid {finest[0]}x{finest[1]}")
    reference = _solve(_problem(scene, contact, finest, grids[-1].tolerance), FEW)
    rate = scene.outputs.field_rate
    rows = []
    for level, grid in zip(LEVELS, grids, strict=True):
        cells = grid.cells
        notify(f"{contact} field: level {level.name}, {cells[0]}x{cells[1]}")
        found = _solve(_problem(scene, contact, cells, grid.tolerance))
        converged = _solve(_problem(scene, contact, cells, CONVERGED_TOLERANCE))
        shared = {
            "level": level.name, "grid": f"{cells[0]}x{cells[1]}", "tolerance": grid.tolerance,
            "ms_per_simulated_s": 1e3 * found.seconds * rate,
        }  # fmt: skip
        for name, error in _errors(found, converged).items():
            head = {"quantity": f"{contact} {name}", "part": "field solver"}
            rows.append({**head, **shared, "error": error, "reference": OWN_SOLVER})
        for name, error in _errors(_first(converged, FEW), reference).items():
            head = {"quantity": f"{contact} {name}", "part": "field grid"}
            rows.append({**head, **shared, "error": error, "reference": OWN_GRID.format(*finest)})
    return rows


def _independent(scene: ResolvedScene, contact: str, notify: Callable[[str], None]) -> list[dict[str, Any]]:
    """The solver on a small grid against dense non-negative least squares at the same approach."""
    cells = (CHECK_ROWS, CHECK_COLS)
    notify(f"{contact} field: dense check on {cells[0]}x{cells[1]}")
    problem = _problem(scene, contact, cells, CONVERGED_TOLERANCE)
    settings, gap = problem.settings, problem.gaps[len(problem.gaps) // 2]
    approach = PressureField(settings, contact).solve_load(gap, problem.load)
    influence = dense_influence(*cells, settings.cell_x, settings.cell_y, settings.modulus)
    belt = yielding_of(settings.belt, *cells, settings.cell_x, settings.cell_y)
    if belt is not None:
        row, col = numpy.divmod(numpy.arange(CHECK_ROWS * CHECK_COLS), CHECK_COLS)
        influence += belt[abs(row[:, None] - row), abs(col[:, None] - col)]
    exact = pressure_at_approach(influence, gap, approach)
    rate = scene.outputs.field_rate
    rows = []
    for tolerance in CHECK_TOLERANCES:
        walls = []
        for _ in range(CHECK_REPEATS):
            field = PressureField(settings._replace(tolerance=tolerance), contact)
            began = time.perf_counter()
            field.solve(gap, approach)
            walls.append(time.perf_counter() - began)
        error = float(numpy.linalg.norm(field.pressure - exact) / numpy.linalg.norm(exact))
        rows.append({
            "quantity": f"{contact} pressure (L2), cold", "part": "field solver", "level": "check",
            "grid": f"{cells[0]}x{cells[1]}", "tolerance": tolerance, "error": error, "reference": DENSE,
            "ms_per_simulated_s": 1e3 * statistics.median(walls) * rate,
        })  # fmt: skip
    return rows


def _problem(scene: ResolvedScene, contact: str, cells: Cells, tolerance: float) -> FieldProblem:
    """The field of one contact on a grid of `cells`, its gaps at the instants and the standing
    load.
    """
    model = build(scene)
    grids = model.tire_field if contact == "tire" else model.seat_field
    assert grids is not None
    usual = grids.usual.settings
    rows, cols = cells
    settings = usual._replace(
        rows=rows, cols=cols, cell_x=usual.rows * usual.cell_x / rows, cell_y=usual.cols * usual.cell_y / cols,
        tolerance=tolerance,
    )  # fmt: skip
    if contact == "seat":
        assert model.seat_shape is not None
        gaps, load = (
            [seat_gap_on(model.seat_shape, settings)],
            occupant_mass(scene.section(SeatSection).occupant) * GRAVITY,
        )
    else:
        gaps, load = _tire_gaps(scene, settings), plain_load(scene.data)
    return FieldProblem(settings, contact, gaps, load)


def _tire_gaps(scene: ResolvedScene, settings: FieldSettings) -> list[Field]:
    """Gaps [m] at consecutive field instants, heights taken at the cell centres of the grid."""
    surface, travel = make_road(scene).surface, make_travel(scene)
    step = 1.0 / scene.outputs.field_rate
    x = (numpy.arange(settings.rows, dtype=numpy.float64) - 0.5 * (settings.rows - 1)) * settings.cell_x
    y = (numpy.arange(settings.cols, dtype=numpy.float64) - 0.5 * (settings.cols - 1)) * settings.cell_y
    crown = gap_over_level_road(body_of(scene).form, x, y)
    middle = min(MIDDLE, 0.5 * scene.duration)
    at = [travel.position(middle + i * step) for i in range(INSTANTS)]
    return [numpy.asarray(crown - surface.heights(numpy.asarray(x + position), y)) for position in at]


def _solve(problem: FieldProblem, count: int = INSTANTS) -> FieldSolution:
    field = PressureField(problem.settings, problem.contact)
    pressures, approaches, walls = [], [], []
    for i in range(count):
        load = problem.load * (1.0 + LOAD_SWING * math.sin(0.7 * i))
        began = time.perf_counter()
        approaches.append(field.solve_load(problem.gaps[min(i, len(problem.gaps) - 1)], load))
        walls.append(time.perf_counter() - began)
        pressures.append(field.pressure.copy())
    return FieldSolution(pressures, numpy.array(approaches), statistics.median(walls[1:]))


def _first(solution: FieldSolution, count: int) -> FieldSolution:
    return FieldSolution(solution.pressures[:count], solution.approaches[:count], solution.seconds)


def _errors(found: FieldSolution, exact: FieldSolution) -> dict[str, float]:
    """Worst relative error over the instants, of the approach, the peak, the area and the field
    (means over the coarser cells).
    """
    values: dict[str, list[float]] = {"approach": [], "peak pressure": [], "contact area": [], "pressure (L2)": []}
    pairs = zip(found.pressures, exact.pressures, found.approaches, exact.approaches, strict=True)
    for one, other, approach, exact_approach in pairs:
        values["approach"].append(abs(approach / exact_approach - 1.0))
        values["peak pressure"].append(abs(one.max() / other.max() - 1.0))
        share, exact_share = (one > 0.0).mean(), (other > 0.0).mean()
        values["contact area"].append(abs(share / exact_share - 1.0))
        fine = _onto(other, one.shape)
        values["pressure (L2)"].append(float(numpy.linalg.norm(one - fine) / numpy.linalg.norm(fine)))
    return {name: float(max(errors)) for name, errors in values.items()}


def _onto(fine: Field, shape: tuple[int, ...]) -> Field:
    """Means over the cells of a coarser grid of `shape`: the integral, interpolated at the coarser
    edges, differentiated.
    """
    result = fine
    for axis in (0, 1):
        lines = numpy.moveaxis(result, axis, 0)
        integral = numpy.concatenate([numpy.zeros((1, lines.shape[1])), numpy.cumsum(lines, axis=0)])
        cells = len(lines)
        edges = numpy.linspace(0.0, cells, shape[axis] + 1)
        at_edges = numpy.array([numpy.interp(edges, numpy.arange(cells + 1), column) for column in integral.T]).T
        result = numpy.moveaxis(numpy.diff(at_edges, axis=0) * (shape[axis] / cells), 0, axis)
    return result
