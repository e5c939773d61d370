"""Contact fields of a rig: effective height of road or cushion, and the pressure field
behind it.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.laws.elastic_law import elastic_force
from contact_sim_pkg.laws.normal_force import factor_of
from contact_sim_pkg.laws.parameters import Contact
from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.vehicle.field.contact_field import (
    FieldEdgeError,
    FieldError,
    FieldGrids,
    PressureField,
    approach_at,
    correction_of,
)
from contact_sim_pkg.run.errors import RunError

Gap = NDArray[numpy.float64]

AT_REST = 1e-8
"""Tolerance of the field that a run starts from."""

AS_PREDICTED = 0.1
"""Of the allowed height: a correction that differs by less from the expected one is as predicted.
"""


class FieldRecord(NamedTuple):
    """A pressure field at one instant."""

    pressure: Gap  # [rows, cols], [Pa]
    origin_x: float  # [m] of the centre of cell (0, 0)
    origin_y: float  # [m]
    approach: float  # [m]
    travel: float  # [m] of the contact along the road
    residual: float  # of its solution, relative
    is_level: bool = False  # whether it rests on level road alone


class Turn(NamedTuple):
    """How far a correction is from straight over a coupling step: on the parabola through the last two
    solutions and its end.
    """

    height: float  # [m] largest distance from the straight line
    rate: float  # [m/s] largest difference of the slopes
    bend: float  # [m] four times the sagitta; 0 at the start of a run


class ContactField(ABC):
    """Pressure field of one contact as the height that the bodies stand on.

    ``correction`` [m] is the effective-height correction: what the field adds to the smooth height,
    0 without a field.
    """

    STATE = State(
        ("grids", "correction", "published", "travel"),
        ("_solved", "_since", "_slope", "_count", "_is_first", "as_predicted", "_solved_on", "closer"),
    )

    is_static = False  # the gap has always the same form
    is_viscoelastic = False  # the field at the end of each coupling step acts on those after it

    def __init__(self, grids: FieldGrids | None, contact: Contact | None) -> None:
        """Make the driver of the pressure field ``grids``, None for the smooth height alone.

        ``contact`` has the law that stands for the field between its solutions.
        """
        self.grids, self.contact = grids, contact
        self.correction = 0.0  # [m] at the end of the last coupling step
        self._solved = 0.0  # [m] correction at the last solution of the field
        self._since = 0  # segments since then
        self._slope = 0.0  # [m] of correction per segment, between the last two solutions
        self._count = 1  # segments between them
        self._is_first = True  # there is one solution alone
        self.as_predicted = False  # no field needs to be solved before the next published one
        self.published: FieldRecord | None = None
        self._solved_on: PressureField | None = None  # the grid of that
        self.closer = 1.0  # times the tolerance of the field
        self.travel = 0.0  # [m] of the contact along the road

    def reset(self) -> None:
        """Reset all but the buffers."""
        self.begin(0.0)
        self.published = None
        for field in () if self.grids is None else self.grids.both():
            field.reset()

    @property
    def cell_area(self) -> float:
        """Area of a cell [m^2]."""
        assert self.grids is not None
        return self.grids.usual.settings.cell_x * self.grids.usual.settings.cell_y

    def begin(self, correction: float) -> None:
        """Start a run with ``correction`` [m]."""
        self.correction = self._solved = correction
        self._slope, self._since, self._count, self.as_predicted, self._is_first = 0.0, 0, 1, False, True

    def predicted(self, count: int) -> float:
        """Correction [m] after a step of ``count`` segments, extrapolated from the last two
        solutions.
        """
        return self._solved + self._slope * (self._since + count)

    def turn(self, correction: float, count: int, length: float) -> Turn:
        """The course to a ``correction`` [m], ``count`` segments of a ``length`` [s] on."""
        span = self._since + count
        whole, change = self._count + span, (correction - self._solved) / span - self._slope
        bend = 0.0 if self._is_first else change * count**2 / whole
        return Turn(abs(change) * span**2 / (4.0 * whole), abs(change) * span / whole / length, bend)

    def accept(self, correction: float, count: int, solved: bool, allowed: float) -> None:
        """Accept a coupling step of ``count`` segments with the ``correction`` [m] at its end.

        ``solved``: by a solution of the field; else it is the predicted one. ``allowed`` [m] is its
        error.
        """
        span = self._since + count
        if solved:
            self.as_predicted = self.is_static and abs(correction - self.predicted(count)) <= AS_PREDICTED * allowed
            self._slope, self._count = (correction - self._solved) / span, span
            self._solved, span, self._is_first = correction, 0, False
        self._since, self.correction = span, correction

    def solve(self, approach: float, geometric: float, block: int) -> float:
        """Solve the field at ``approach`` [m]; returns the correction [m] of the ``geometric``
        approach [m].

        Where the contact outgrows the usual grid, or touches beyond it, the wide grid is solved.
        Raises RunError where that is too small as well.
        """
        if self.grids is None or self.contact is None:
            return 0.0
        # The usual grid serves unless the contact reaches beyond it.
        try:
            correction = self._solve_on(self.grids.usual, approach, geometric)
            if self.is_clear(self.grids, approach) or not self.touches_beyond(self.grids, approach):
                return correction
        except FieldEdgeError:
            self.grids.usual.forget()
        except FieldError as error:
            raise RunError(f"block {block}: {error}") from None
        try:
            correction = self._solve_on(self.grids.wide, approach, geometric)
        except FieldError as error:
            raise RunError(f"block {block}: {error}") from None
        self.refuse_beyond(self.grids, approach, block)
        return correction

    def stand(self, load: float) -> float:
        """Approach [m] at which the field carries ``load`` [N] at the start of a run. Errors as
        ``solve``.
        """
        assert self.grids is not None
        return self._stand_on(self.grids, load)[0]

    def _stand_on(self, grids: FieldGrids, load: float) -> tuple[float, PressureField]:
        """Approach [m] under ``load`` [N], and the field that carries it: the usual or the wide
        one.
        """
        self.is_clear(grids, 0.0)  # compiled here, whichever grid the run starts on
        for field in grids.both():
            try:
                field.roll_to(self.road_row(field.settings), self.origin(field.settings)[0])
                # A start must not shake: what the field misses of the load would
                approach = field.solve_load(self.gap(field.settings), load, min(AT_REST, field.settings.tolerance))
                level = self.level_height(field)
                if level is not None and self.contact is not None:
                    approach = approach_at(self.contact.elastic, load) - level
                if field is grids.wide:
                    self.refuse_beyond(grids, approach, 0)
                elif self.touches_beyond(grids, approach):
                    continue
                return approach, field
            except FieldEdgeError as error:
                field.forget()
                last = error
            except FieldError as error:
                raise RunError(f"block 0: {error}") from None
        raise RunError(f"block 0: {last}")

    def store(self) -> None:  # noqa: B027  # most contacts are elastic
        """Store the last field as that of its instant, where the material is viscoelastic."""

    def pop_iterations(self) -> int:
        """Iterations since the last call."""
        if self.grids is None:
            return 0
        iterations = sum(field.iterations for field in self.grids.both())
        for field in self.grids.both():
            field.iterations = 0
        return iterations

    def copy_published(self) -> FieldRecord | None:
        """The last field, copied before the next solve overwrites it."""
        return None if self.published is None else self.published._replace(pressure=self.published.pressure.copy())

    def with_loss(self, found: FieldRecord, approach: float, rate: float) -> FieldRecord:
        """The elastic field with the dissipation of the contact's law: its integral is the force.

        ``approach`` [m] and its ``rate`` [m/s] are those of the smooth contact.
        """
        assert self.contact is not None
        factor = factor_of(self.contact.elastic, self.contact.dissipative, approach, rate, 1.0)
        return found._replace(pressure=found.pressure * factor)

    def _solve_on(self, field: PressureField, approach: float, geometric: float) -> float:
        assert self.contact is not None
        assert self.grids is not None
        gap = self.gap(field.settings)
        origin_x, origin_y = self.origin(field.settings)
        field.roll_to(self.road_row(field.settings), origin_x)
        field.closer = self.closer
        field.solve(gap, approach)
        self.published = FieldRecord(field.pressure, origin_x, origin_y, approach, self.travel, field.residual)
        self._solved_on = field
        level = self.level_height(field)
        if level is not None:  # the law is exact, the field its map
            self._carry(approach + level, field, is_level=True)
            return approach + level - geometric
        if field.load == 0.0:  # free: the nearest place may lie beyond the usual grid
            gap = self.gap(self.grids.wide.settings)
        correction = correction_of(self.contact.elastic, field, gap, approach, geometric)
        if field.unsettled != 0.0 and field.load > 0.0:
            self._carry(geometric + correction, field, is_level=False)
        return correction

    def _carry(self, height: float, field: PressureField, is_level: bool) -> None:
        """Scale the published pressure to the law's force at a ``height`` [m]."""
        assert self.contact is not None
        assert self.published is not None
        force = float(elastic_force(self.contact.elastic, height))
        self.published = self.published._replace(pressure=field.pressure * (force / field.load), is_level=is_level)

    def level_height(self, field: PressureField) -> float | None:
        """Height [m] of what the contact of the last solution rests on, where that is level and the
        law is made for it; None elsewhere.
        """
        return None

    def road_row(self, settings: FieldSettings) -> int:
        """Row of the road under the first row of a grid."""
        return 0

    def is_clear(self, grids: FieldGrids, approach: float) -> bool:
        """Whether a bound says that it does not."""
        return True

    def touches_beyond(self, grids: FieldGrids, approach: float) -> bool:
        """Whether the contact solved on the usual grid at ``approach`` [m] extends beyond it, as at
        a wall.
        """
        return False

    def refuse_beyond(self, grids: FieldGrids, approach: float, block: int) -> None:  # noqa: B027  # most have nothing there
        """Raise RunError where the contact solved on the wide grid at ``approach`` [m] extends
        beyond it.
        """

    @abstractmethod
    def gap(self, settings: FieldSettings) -> Gap:
        """Undeformed gap in [m] on the cells of a grid, at the present place."""

    @abstractmethod
    def origin(self, settings: FieldSettings) -> tuple[float, float]:
        """Centre of cell (0, 0) in the contact's frame, x and y in [m]."""
