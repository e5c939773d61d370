"""Contact field of a tire: grids that follow the wheel, contact beyond them, viscoelastic tread."""

from __future__ import annotations

import math
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.laws.parameters import Contact, TabulatedElastic
from contact_sim_pkg.pressure.field.instant import grown_window
from contact_sim_pkg.pressure.settings import BeltSettings, FieldSettings, InflatedBelt
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.vehicle.field.contact_field import FieldError, FieldGrids, PressureField, approach_at
from contact_sim_pkg.rigs.vehicle.field.driver import AT_REST, ContactField, FieldRecord, Gap
from contact_sim_pkg.rigs.vehicle.field.sidewalls import Softening
from contact_sim_pkg.rigs.vehicle.tire.coarse_level import CoarseLevel, LevelSolution, can_be_halved, slope_under
from contact_sim_pkg.rigs.vehicle.tire.footprint import clear_beyond, level_under, tire_gap, touches_beyond
from contact_sim_pkg.rigs.vehicle.tire.model import TireGeometry, Tread, relaxed_grids
from contact_sim_pkg.rigs.vehicle.tire.tread_viscoelasticity import TreadState
from contact_sim_pkg.run.errors import RunError

Line = NDArray[numpy.float64]

CLOSER = 0.5
"""Of the field's tolerance, where it was not solved since the last published field: started from farther away it
ends farther from what it is solved for.
"""

MOST_STEPS = 600
"""Of a tread that rolls in before the start; slower than that it is nearly relaxed."""


class RoadField(ContactField):
    """Field of the road under the tire; ``place`` sets the wheel before a field is solved."""

    STATE = State(
        (*ContactField.STATE.physics, "_tread_state"),
        (*ContactField.STATE.solver, "level", "_between", "_coarse", "_offset"),
    )

    def __init__(
        self, grids: FieldGrids | None, contact: Contact | None, geometry: TireGeometry | None, tread: Tread | None
    ) -> None:
        """As ``ContactField``; ``geometry`` has radii and lattice, ``tread`` is None for elastic
        rubber.
        """
        super().__init__(grids, contact)
        self._geometry, self._tread = geometry, tread
        self._road: Any = None
        self._slope_of: tuple[FieldRecord | None, float] = None, 0.0  # the last that was computed
        self._gaps = {} if grids is None else {
            field.settings.rows: numpy.empty((field.settings.rows, field.settings.cols)) for field in grids.both()
        }  # fmt: skip
        self._tread_state: TreadState | None = None
        self.level: CoarseLevel | None = None
        self._between: LevelSolution | None = None  # the last solution, where it is not that of the fine field
        self._coarse: LevelSolution | None = None  # of the coarse level at this instant
        self._offset: tuple[LevelSolution, LevelSolution] | None = (
            None  # of fine and coarse at the last published field
        )
        if grids is not None:
            self._pressed = numpy.zeros((grids.wide.settings.rows, grids.wide.settings.cols))
        if tread is not None and grids is not None:
            wide = grids.wide.settings
            belt = tread.relaxed.belt
            bends = (belt, tread.belt) if isinstance(belt, InflatedBelt) and tread.belt is not None else None
            self._tread_state = TreadState(wide, tread.relaxed.modulus, tread.viscoelasticity, tread.step, bends)
            self.is_viscoelastic = True

    def reset(self) -> None:
        """See `ContactField`."""
        super().reset()
        self._between = self._coarse = self._offset = None
        if self.level is not None:
            self.level.reset()
        if self._tread_state is not None:
            self._tread_state.reset()

    def place(self, road: Any, travel: float) -> None:
        """Set the road of the block and the ``travel`` [m] of the wheel centre."""
        self._road, self.travel = road, travel
        if self._tread_state is not None and self.grids is not None:
            self._tread_state.move_to(self.road_row(self.grids.wide.settings))

    def use_level(self, allowed: float) -> None:
        """Solve half as many cells each way between published fields, as far as that misses little of an ``allowed``
        height [m]; a tread with memory and odd grids need their own cells.
        """
        if self.grids is None or self._geometry is None or self._tread_state is not None:
            return
        usual = self.grids.usual
        if can_be_halved(usual.settings):
            self.level = CoarseLevel(usual.settings, usual.contact, self._geometry, allowed)

    def solve(self, approach: float, geometric: float, block: int) -> float:
        """See `ContactField`."""
        self._between = None
        return super().solve(approach, geometric, block)

    def solve_between(self, approach: float, geometric: float, block: int) -> float:
        """As `solve` at an instant whose field is not published: by the coarse level where that will do."""
        if self.level is not None:
            self.level.count(is_published=False)
        if not self.goes_by_level or not self._solve_coarse(approach):
            return self.solve(approach, geometric, block)
        assert self.level is not None
        assert self._coarse is not None
        self._between = self.level.with_offset(self._coarse)
        return self._between.height - geometric

    def solve_published(self, approach: float, geometric: float, block: int) -> float:
        """As `solve` at an instant whose field is published, with the coarse one beside it."""
        if self.level is not None:
            self.level.count(is_published=True)
            if self._coarse is None and self.level.is_worth:
                self._solve_coarse(approach)
        self.closer = CLOSER if self.goes_by_level else 1.0
        correction = self.solve(approach, geometric, block)
        self.closer = 1.0
        found, field, self._offset = self.published, self._solved_on, None
        if self._coarse is not None and found is not None and field is not None and field.load > 0.0:
            assert self.contact is not None
            assert self._geometry is not None
            height = approach_at(self.contact.elastic, field.load) - field.unsettled
            slope = slope_under(self._geometry.form, field, found.pressure, found.origin_x)
            self._offset = LevelSolution(height, slope), self._coarse
            if self.level is not None:
                self.level.compare(field.pressure)
        return correction

    def begin_instant(self) -> None:
        """Forget the coarse level's solution: it was of another instant."""
        self._coarse = None

    @property
    def goes_by_level(self) -> bool:
        """Whether the coarse level is solved between published fields."""
        return self.level is not None and self.level.is_quiet

    @property
    def is_between(self) -> bool:
        """Whether the last solution is the coarse level's, so that its field is none to publish."""
        return self._between is not None

    def _solve_coarse(self, approach: float) -> bool:
        """Solve the coarse level at an ``approach`` [m]; whether there is one and it could be."""
        self._coarse = None
        if self.level is not None and self.contact is not None:
            self._coarse = self.level.at(self._road, self.travel, approach, self.contact.elastic)
        return self._coarse is not None

    def renew_level(self) -> float:
        """Take the offset of the coarse level at a published field; returns by how much [m] the one before missed it."""
        if self.level is None or self._offset is None:
            return 0.0
        return self.level.renew(*self._offset)

    def pop_iterations(self) -> int:
        """See `ContactField`; those of the coarse level count."""
        iterations = super().pop_iterations()
        if self.level is not None:
            iterations += self.level.field.iterations
            self.level.field.iterations = 0
        return iterations

    def stand(self, load: float) -> float:
        """See `ContactField`; a viscoelastic tread is relaxed."""
        if self._tread_state is None or self._tread is None or self.grids is None:
            return super().stand(load)
        self._tread_state.reset()
        relaxed = relaxed_grids(self.grids, self._tread)
        approach, field = self._stand_on(relaxed, load)
        row = self.road_row(relaxed.wide.settings)
        self._tread_state.settle(row, self._on_wide(field.pressure), self._softer(field))
        return approach

    def roll_in(self, load: float, speed: float) -> float | None:
        """Approach [m] under a ``load`` [N] of a tread with memory that has rolled here at a ``speed``
        [m/s] for the length of its grid; None where it stands, or rolls too slowly for that.
        """
        if self._tread_state is None or self._tread is None or self.grids is None or speed == 0.0:
            return None
        field, wide = self.grids.wide, self.grids.wide.settings
        way = speed * self._tread.step / wide.cell_x  # cells a step
        steps = math.ceil(wide.rows / abs(way)) + 1
        if steps > MOST_STEPS:
            return None
        field.roll_to(self.road_row(wide), self.origin(wide)[0])
        try:
            for step in range(1, steps):
                self._tread_state.roll(round(step * way) - round((step - 1) * way))
                field.solve_load(self.gap(wide), load)
                self._tread_state.store(self._on_wide(field.pressure), self._softer(field))
            # The field of the start, which the run solves again and stores
            self._tread_state.roll(round(steps * way) - round((steps - 1) * way))
            return field.solve_load(self.gap(wide), load, AT_REST)
        except FieldError as error:
            raise RunError(f"block 0: {error}") from None

    def store(self) -> None:
        """See `ContactField`; the tread stores the pressure."""
        if self._tread_state is not None and self.published is not None and self.grids is not None:
            pressure = self.published.pressure
            usual, wide = self.grids.both()
            field = usual if pressure.shape == usual.pressure.shape else wide
            self._tread_state.store(self._on_wide(pressure), self._softer(field))

    @property
    def _softening(self) -> Softening | None:
        return None if self.grids is None else self.grids.wide.softening

    def _softer(self, field: PressureField) -> Line | None:
        """Line load [N/m] on the rows of the wide grid that softening sidewalls leave to the belt."""
        softening = field.softening
        return None if softening is None else softening.load[softening.rows(len(self._pressed))]

    def _on_wide(self, pressure: Gap) -> Gap:
        """A pressure field on the wide grid, which both grids share their middle with."""
        if pressure.shape == self._pressed.shape:
            return pressure
        # Always the same cells, zeros around
        row, col, rows, cols = self._middle(pressure)
        self._pressed[row : row + rows, col : col + cols] = pressure
        return self._pressed

    def _middle(self, pressure: Gap) -> tuple[int, int, int, int]:
        """Window of the usual grid in the wide one."""
        (wide_rows, wide_cols), (rows, cols) = self._pressed.shape, pressure.shape
        return wide_rows // 2 - rows // 2, (wide_cols - cols) // 2, rows, cols

    def road_row(self, settings: FieldSettings) -> int:
        """See `ContactField`."""
        return round(self.travel / settings.cell_x) - settings.rows // 2

    def gap(self, settings: FieldSettings) -> Gap:
        """See `ContactField`; cells coincide with nodes of the road. The strain of a viscoelastic
        tread is added.
        """
        geometry, road = self._geometry, self._road
        assert geometry is not None
        out = self._gaps[settings.rows]
        # Height of the tire over the road.
        inside = tire_gap(
            road.height, road.first_row, settings.cell_x, settings.cell_y, geometry.form, self.road_row(settings), self.travel,
            1, out,
        )  # fmt: skip
        if not inside:
            raise RunError(
                f"road/patch: block {road.block} does not reach over the pressure grid at {self.travel:.6g} m"
            )
        # The middle of the wide grid is the usual one.
        if self._tread_state is not None:
            whole = self._tread_state.gap
            row, col = whole.shape[0] // 2 - settings.rows // 2, (whole.shape[1] - settings.cols) // 2
            out += whole[row : row + settings.rows, col : col + settings.cols]
            softening = self._softening
            if softening is not None:
                softening.bent[softening.rows(len(whole))] = self._tread_state.bent
        return out

    def is_clear(self, grids: FieldGrids, approach: float) -> bool:
        """See `ContactField`; what a tread remembers is not in the bound."""
        geometry, road = self._geometry, self._road
        assert geometry is not None
        softening, rows = grids.wide.softening, grids.wide.settings.rows
        opened = numpy.zeros(rows) if softening is None else softening.opening[softening.rows(rows)]
        return self._tread_state is None and clear_beyond(
            grids.wide.whole, opened, road.height, road.first_row, geometry.form, self._first_row(grids.usual.settings),
            self.travel, approach, grids.usual.pressure, geometry.lattice.road_rows,
        )  # fmt: skip

    def touches_beyond(self, grids: FieldGrids, approach: float) -> bool:
        """See `ContactField`."""
        if grids.usual.settings.belt is None:
            return self._touches(grids.usual, approach)
        return self._touches_with_belt(grids, approach) or self._beyond_both(grids, approach)

    def _touches_with_belt(self, grids: FieldGrids, approach: float) -> bool:
        """The same where a belt yields further than the half-space: by its displacements on the
        wide grid.
        """
        pressure, window = self._on_wide(grids.usual.pressure), self._middle(grids.usual.pressure)
        gap = grids.wide.opened(self.gap(grids.wide.settings))
        return bool(grown_window(grids.wide.whole, gap, approach, pressure, window) != window)

    def refuse_beyond(self, grids: FieldGrids, approach: float, block: int) -> None:
        """See `ContactField`."""
        wide = grids.wide.settings
        if self._beyond_both(grids, approach):
            raise RunError(
                f"block {block}: tire: the road touches it beyond its pressure grid of {wide.rows * wide.cell_x:.4g} m, at "
                f"{self.travel:.6g} m; enlarge effects.tire.contact_field.length and rows"
            )

    def _beyond_both(self, grids: FieldGrids, approach: float) -> bool:
        """Whether the road touches the tire outside the wide grid; not said of a string of a belt,
        which may yield as far as that.
        """
        return not isinstance(grids.wide.settings.belt, BeltSettings) and self._touches(grids.wide, approach)

    def _touches(self, field: PressureField, approach: float) -> bool:
        """Whether the road touches the tire outside a field's grid, as far as a tire reaches."""
        # All nodes of the road below the tire count, not only those of the grid.
        geometry, road, settings = self._geometry, self._road, field.settings
        assert geometry is not None
        return touches_beyond(
            road.height, road.first_row, geometry.form, self._first_row(settings), self.travel, approach, settings.modulus,
            settings.cell_x, settings.cell_y, field.pressure, geometry.lattice.road_rows, geometry.lattice.road_cols,
        )  # fmt: skip

    def _first_row(self, settings: FieldSettings) -> int:
        """Row of the road under the rear of the lattice, which reaches as far as a tire does."""
        assert self._geometry is not None
        return round(self.travel / settings.cell_x) - self._geometry.lattice.road_rows // 2

    def level_height(self, field: PressureField) -> float | None:
        """See `ContactField`; the law of an inflated tire is its field on a level road."""
        if (
            self._tread_state is not None
            or self.contact is None
            or not isinstance(self.contact.elastic, TabulatedElastic)
        ):
            return None
        road, first = self._road, self.road_row(field.settings) - self._road.first_row
        margin = (road.height.shape[1] - field.settings.cols) // 2
        level = level_under(road.height, first, margin, field.pressure)
        return None if math.isnan(level) else level

    def effective_slope(self) -> float:
        """Slope [1] of the even ground with the same longitudinal force, of the last solution.

        Rolling on by ds at the same approach changes the elastic energy by ``sum p z'(x) A ds``, z the
        height of the unloaded tire over its lowest point, and what softening sidewalls add to it: that
        is the force against the travel. On level road it is 0 for an elastic tread.
        """
        if self._between is not None:
            return self._between.slope
        found, geometry, field = self.published, self._geometry, self._solved_on
        if found is None or geometry is None or field is None:
            return 0.0
        if self._slope_of[0] is not found:
            # Computed on level road as well: a run compiles nothing that its preparation there has not
            slope = slope_under(geometry.form, field, found.pressure, found.origin_x)
            self._slope_of = found, 0.0 if found.is_level else slope
        return self._slope_of[1]

    def rolling_force(self) -> float:
        """Moment of rolling resistance over the radius in [N], of the last solution: what a tread
        with memory takes from the rotation, ``-sum p g'(x) A``, g the gap that its memory adds, and from
        what sidewalls put on the belt beside it; 0 for an elastic tread.
        """
        found, geometry = self.published, self._geometry
        if self._tread_state is None or found is None or geometry is None:
            return 0.0
        rows, cols = found.pressure.shape
        whole = self._tread_state.gap
        row, col = whole.shape[0] // 2 - rows // 2, (whole.shape[1] - cols) // 2
        climb = numpy.gradient(whole[row : row + rows, col : col + cols], axis=0)
        beside = 0.0 if self._softening is None else self._softening.remembered()
        return float(-(found.pressure * climb).sum() * geometry.lattice.cell_y) - beside

    def slope_force(self, load: float) -> float:
        """Force [N] of the last solution's pressure, of resultant ``load`` [N], on slopes of the
        road.
        """
        return self.rolling_force() - self.effective_slope() * load

    def origin(self, settings: FieldSettings) -> tuple[float, float]:
        """See `ContactField`."""
        return self.road_row(settings) * settings.cell_x - self.travel, -0.5 * (settings.cols - 1) * settings.cell_y
