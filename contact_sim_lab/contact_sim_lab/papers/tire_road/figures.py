"""Figures of *Tire/Road Contact*: displacement and pressure on a single bump and on an irregular road.

The paper gives no numbers. A passenger car's tire as an elastic half-space stands with its middle on
a raised-cosine bump, or on a self-affine patch; both are chosen.
"""

from __future__ import annotations

from functools import lru_cache, partial
from typing import TYPE_CHECKING, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.records.paper import Drawn, Figure, Number, PaperError, Parameter, Values
from contact_sim_lab.twins.halfspace import dense_influence, direct_sum, pressure_at_approach
from contact_sim_lab.twins.hertz import contact_at_load
from contact_sim_pkg.excitation.roads.bump import BumpRoad
from contact_sim_pkg.excitation.roads.flat import FlatRoad
from contact_sim_pkg.excitation.roads.self_affine import SelfAffineRoad
from contact_sim_pkg.pressure.field.halfspace import displacement, make_buffers, make_half_space
from contact_sim_pkg.pressure.field.iteration import make_workspace
from contact_sim_pkg.pressure.field.solver import solve_at_load
from contact_sim_pkg.rigs.vehicle.tire.body import TireForm
from contact_sim_pkg.rigs.vehicle.tire.force_table import gap_over_level_road

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas

__all__ = ["FIGURES"]

Field = NDArray[numpy.float64]
Road = FlatRoad | BumpRoad | SelfAffineRoad
FLAT = FlatRoad(kind="flat")

RADIUS_ROLLING, RADIUS_LATERAL = 0.30, 1.0  # [m]
FORM = TireForm(radius_rolling=RADIUS_ROLLING, radius_lateral=RADIUS_LATERAL)
MODULUS = 3.0e6 / (1.0 - 0.5**2)  # [Pa] E*, incompressible tread on a rigid road
SIDE, CELLS = 0.32, {"bump": 128, "irregular": 256}  # [m] of the grid at 4000 N, cells along it
TOLERANCE, MOST = 1e-9, 2000
SMALL = (48, 48, 0.25, 0.30)  # rows, columns and sides [m] at 4000 N of the grid that is also solved densely
PLACES = 20
POINTS = (1600, 800)  # along and across the strip of the irregular road: four a wave of 5 mm

LOAD = Parameter("load", "N", 4000.0, least=500.0, most=20000.0, help="on the tire")
BUMP = (
    LOAD, Parameter("height", "m", 0.005, least=0.0, most=0.02, help="of the bump"),
    Parameter("length", "m", 0.06, least=0.001, most=0.3, help="of the bump"),
)  # fmt: skip
IRREGULAR = (
    LOAD, Parameter("rms", "m", 5.0e-4, least=0.0, most=2e-3, help="height of the road"),
    Parameter("hurst", "", 0.8, least=0.0, most=1.0, help="Hurst's exponent"),
    Parameter("seed", "", 1, least=0, most=2**31, help="of the phases"),
)  # fmt: skip


class Solved(NamedTuple):
    """A field on its grid."""

    x: Field  # [rows] [m]
    y: Field  # [cols] [m]
    gap: Field  # [rows, cols] [m] of the undeformed bodies
    pressure: Field  # [rows, cols] [Pa]
    displacement: Field  # [rows, cols] [m] of the tread
    approach: float  # [m]

    @property
    def cells(self) -> tuple[float, float]:
        """Sides of a cell [m]."""
        return float(self.x[1] - self.x[0]), float(self.y[1] - self.y[0])


def _centres(count: int, side: float) -> Field:
    places: Field = (numpy.arange(count, dtype=numpy.float64) + 0.5) * (side / count) - 0.5 * side
    return places


def _growth(load: float) -> float:
    """Of the footprint from 4000 N to `load` [N], by Hertz: the grids follow it."""
    return float((load / 4000.0) ** (1.0 / 3.0))


def _grid(kind: str, load: float) -> tuple[int, int, float, float]:
    """Rows, columns and sides [m] of the grid; its cells never grow."""
    growth = _growth(load)
    cells = 2 * round(0.5 * CELLS[kind] * max(growth, 1.0))
    return cells, cells, SIDE * growth, SIDE * growth


def _small(load: float) -> tuple[int, int, float, float]:
    growth = _growth(load)
    return SMALL[0], SMALL[1], SMALL[2] * growth, SMALL[3] * growth


def _own_gap(kind: str, road: Road, values: Values, at: Solved) -> Field:
    """Gap [m] of the undeformed bodies as the figure states them, apart from what the solver was given:
    x²/2R + y²/2R_y - h, with h = H/2 (1 + cos(2π x/L)) on the bump; the irregular road itself is the input.
    """
    x, y = at.x[:, None], at.y[None, :]
    tire: Field = 0.5 * x**2 / RADIUS_ROLLING + 0.5 * y**2 / RADIUS_LATERAL
    if kind == "flat":
        return tire
    if kind == "irregular":
        return numpy.asarray(tire - road.heights(at.x, at.y))
    turn = numpy.minimum(2.0 * numpy.abs(x) / values["length"], 1.0)
    return numpy.asarray(tire - 0.5 * values["height"] * (1.0 + numpy.cos(numpy.pi * turn)))


def _solve(road: Road, load: float, grid: tuple[int, int, float, float]) -> Solved:
    rows, cols, length, width = grid
    x, y = _centres(rows, length), _centres(cols, width)
    gap = gap_over_level_road(FORM, x, y) - road.heights(x, y)
    half_space = make_half_space(rows, cols, length / rows, width / cols, MODULUS)
    pressure = numpy.zeros((rows, cols))
    found = solve_at_load(half_space, make_workspace(half_space), gap, load, TOLERANCE, MOST, pressure)
    if max(pressure[0].max(), pressure[-1].max(), pressure[:, 0].max(), pressure[:, -1].max()) > 0.0:
        raise PaperError(
            f"load {load:g} N: the footprint on this road reaches the edge of the grid; set a smaller road height"
        )
    moved = numpy.zeros((rows, cols))
    displacement(half_space, make_buffers(half_space), pressure, moved)
    return Solved(x, y, gap, pressure, moved, found.approach)


@lru_cache(maxsize=4)
def _case(kind: str, items: tuple[tuple[str, float], ...]) -> tuple[Road, Solved, Solved]:
    """Road, field on it and reference field on a flat road."""
    values = dict(items)
    grid = _grid(kind, values["load"])
    road: Road
    if kind == "bump":
        road = BumpRoad(kind="bump", position=0.0, height=values["height"], length=values["length"])
    else:
        road = SelfAffineRoad(values["hurst"], values["rms"], 0.2, 0.005, int(values["seed"]), SIDE / CELLS[kind])
    return road, _solve(road, values["load"], grid), _solve(FLAT, values["load"], grid)


def _conditions(found: Solved, gap: Field, load: float) -> list[Number]:
    """Eqs 2 to 4: load [N], clearance where nothing presses and where something does over `gap` [m]."""
    clearance = gap + found.displacement - found.approach
    pressed = found.pressure > 0.0
    scale = float(abs(found.approach)) or 1.0
    area = found.cells[0] * found.cells[1]
    stated = "over the gap of the stated radii and road"
    return [
        Number("load, ∬ p", "N", float(found.pressure.sum() * area), load, 1e-6, "eq 2: the load of the figure",
               relative=True),
        Number("smallest p", "Pa", float(found.pressure.min()), 0.0, 0.0, "eq 3: p ≥ 0"),
        Number("largest |clearance| in the contact over Δ", "", float(abs(clearance[pressed]).max()) / scale, 0.0, 1e-6,
               f"eq 3, {stated}"),
        Number("cells outside the contact with a clearance below zero", "",
               float((clearance[~pressed] < -1e-9 * scale).sum()), 0.0, 0.0, f"eq 4, {stated}"),
    ]  # fmt: skip


def _road_numbers(kind: str, road: Road, values: Values) -> list[Number]:
    """Of the irregular road, which is drawn: its height over the whole strip of 2 m by 1 m, after which it repeats."""
    if kind != "irregular":
        return []
    x, y = (numpy.arange(count) * side / count for count, side in zip(POINTS, (2.0, 1.0), strict=True))
    rms = float(road.heights(x, y).std())
    return [Number("rms height of the road", "m", rms, values["rms"], 1.2e-8, "that of the figure", relative=True)]


def _surface_numbers(found: Solved, gap: Field, load: float) -> list[Number]:
    rng = numpy.random.default_rng(7)
    places = numpy.stack([rng.integers(0, n, PLACES) for n in found.pressure.shape], axis=1)
    direct = direct_sum(places, found.pressure, *found.cells, MODULUS)
    own = found.displacement[places[:, 0], places[:, 1]]
    error = float(abs(own - direct).max() / abs(direct).max())
    return [
        Number(
            f"largest error of u over its largest, {PLACES} places",
            "",
            error,
            0.0,
            1e-6,
            "direct sum of Love's logarithms",
        ),
        *_conditions(found, gap, load),
        Number("largest u", "m", float(found.displacement.max()), None, 0.0, "", note="the paper gives no number"),
    ]


def _reference_numbers(flat: Solved, load: float) -> list[Number]:
    hertz = contact_at_load(0.5 / RADIUS_LATERAL, 0.5 / RADIUS_ROLLING, MODULUS, load)
    origin = "Hertz in 50 digits"
    return [
        Number("reference state: p₀", "Pa", float(flat.pressure.max()), hertz.peak_pressure, 1e-3, origin, relative=True),
        Number("reference state: approach Δ", "m", flat.approach - float(flat.gap.min()), hertz.approach, 1e-3, origin,
               relative=True),
    ]  # fmt: skip


def _pressure_numbers(kind: str, road: Road, values: Values, found: Solved, flat: Solved) -> list[Number]:
    load = values["load"]
    small, level = (_solve(each, load, _small(load)) for each in (road, FLAT))
    matrix = dense_influence(*SMALL[:2], *small.cells, MODULUS)
    gap = _own_gap(kind, road, values, small)
    dense = pressure_at_approach(matrix, gap, small.approach)
    dense_level = pressure_at_approach(matrix, _own_gap("flat", road, values, level), level.approach)
    area = small.cells[0] * small.cells[1]
    error = float(abs(small.pressure - dense).max() / dense_level.max())
    origin = f"dense non-negative least squares, {SMALL[0]} × {SMALL[1]} cells"
    return [
        *_reference_numbers(flat, load),
        Number("load of the dense solution at the approach obtained", "N", float(dense.sum() * area), load, 1e-9,
               "eq 2: the load of the figure", relative=True),
        Number("the same on a flat road", "N", float(dense_level.sum() * area), load, 1e-9, "eq 2: the load of the figure",
               relative=True),
        Number("largest error of p over p_ref,max", "", error, 0.0, 1e-7, origin),
        Number(f"largest p/p_ref,max, {SMALL[0]} × {SMALL[1]} cells", "", float(small.pressure.max() / level.pressure.max()),
               float(dense.max() / dense_level.max()), 1e-8, origin, relative=True),
        *_conditions(found, _own_gap(kind, road, values, found), load),
        Number("largest p/p_ref,max", "", float(found.pressure.max() / flat.pressure.max()), None, 0.0, "",
        note="on the fine grid"),
    ]  # fmt: skip


def _compute(kind: str, what: str, values: Values) -> Drawn:
    road, found, flat = _case(kind, tuple(values.items()))
    if what == "u":
        numbers = _surface_numbers(found, _own_gap(kind, road, values, found), values["load"])
    else:
        numbers = _pressure_numbers(kind, road, values, found, flat)
    numbers = [*_road_numbers(kind, road, values), *numbers]

    def draw(canvas: Canvas) -> None:
        shown = found.displacement * 1e3 if what == "u" else found.pressure / flat.pressure.max()
        label = "u, mm" if what == "u" else "p/p_ref,max"
        surface = canvas.add_subplot(1, 2, 1, projection="3d")
        every = max(1, len(found.x) // 64)
        x, y = numpy.meshgrid(found.x[::every] * 1e3, found.y[::every] * 1e3, indexing="ij")
        surface.plot_surface(x, y, shown[::every, ::every], cmap="viridis", rcount=64, ccount=64, linewidth=0)
        surface.set(xlabel="x, mm", ylabel="y, mm", title=label)
        lines = canvas.add_subplot(1, 2, 2)
        middle = len(found.y) // 2
        lines.plot(found.x * 1e3, shown[:, middle], label=label)
        reference = flat.displacement * 1e3 if what == "u" else flat.pressure / flat.pressure.max()
        lines.plot(found.x * 1e3, reference[:, middle], ":", label="the same on a flat road")
        if what == "u":
            lines.plot(
                found.x * 1e3, road.heights(found.x, found.y)[:, middle] * 1e3, "k", linewidth=0.7, label="road, mm"
            )
        lines.set(xlabel="x along the road, mm, in the middle of the tire")
        lines.legend()

    return Drawn(numbers, draw, (9.0, 4.0))


_MADE_BY = (
    "contact_sim_pkg.pressure.field.solver:solve_at_load", "contact_sim_pkg.pressure.field.halfspace:displacement",
    "contact_sim_pkg.excitation.roads.bump:BumpRoad", "contact_sim_pkg.excitation.roads.self_affine:SelfAffineRoad",
)  # fmt: skip
_U = "u by a direct sum at 20 places, 1e-6; load of the figure; signs over the gap of its own closed form"
_P = (
    "Hertz at the load of the figure, 1e-3, for the reference state; p/p_ref by dense non-negative least squares over the gap "
    "of its own closed form, 1 %"
)
_RENUMBERED = "The text calls figures 4 and 5 figures 5 and 6."
FIGURES: tuple[Figure, ...] = (
    Figure("2", "displacement of the tread on a single bump", _MADE_BY[:3], _U, partial(_compute, "bump", "u"), parameters=BUMP),
    Figure("3", "displacement of the tread on an irregular road", (*_MADE_BY[:2], _MADE_BY[3]), _U,
           partial(_compute, "irregular", "u"), parameters=IRREGULAR),
    Figure("4", "pressure over that of the reference state, single bump", _MADE_BY[:3], _P, partial(_compute, "bump", "p"),
           parameters=BUMP, note=_RENUMBERED),
    Figure("5", "pressure over that of the reference state, irregular road", (*_MADE_BY[:2], _MADE_BY[3]), _P,
           partial(_compute, "irregular", "p"), parameters=IRREGULAR, note=_RENUMBERED),
)  # fmt: skip
