"""What supports a body at one contact: the effective height of road or cushion, and the pressure
field that sets it.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.laws.normal_force import pressure_factor
from contact_sim_pkg.laws.parameters import Contact
from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.rigs.vehicle.contact_field import FieldEdgeError, FieldError, PressureField, offset_of
from contact_sim_pkg.rigs.vehicle.contact_model import FieldGrids
from contact_sim_pkg.rigs.vehicle.model import seat_cells, seat_gap_on
from contact_sim_pkg.rigs.vehicle.outputs import FieldRecord
from contact_sim_pkg.rigs.vehicle.seat.shape import SeatShape
from contact_sim_pkg.run.errors import RunError

Gap = NDArray[numpy.float64]

CALM = 0.1
"""Of the allowed height: an offset that differs by less from the expected one is as expected."""


class Support(ABC):
    """The support of one contact; ``offset`` [m] is what its field adds to the smooth height, 0
    without a field.
    """

    still = False  # the support has always the same form
    remembers = False  # the field of each coupling step's end decides on those after it

    def __init__(self, grids: FieldGrids | None, contact: Contact | None) -> None:
        """Take the pressure field (None: the smooth height is all there is) and the contact whose
        law it serves.
        """
        self.grids, self.contact = grids, contact
        self.offset = 0.0  # [m] at the end of the last coupling step
        self._solved = 0.0  # [m] offset at the last solution of the field
        self._since = 0  # segments since then
        self._slope = 0.0  # [m] of the offset a segment, between the last two solutions
        self._count = 1  # segments between them
        self.calm = False  # the last offset was as expected: between published fields it is not looked for
        self.published: FieldRecord | None = None
        self.travel = 0.0  # [m] of the contact along the road

    def reset(self) -> None:
        """Forget everything but the buffers."""
        self.begin(0.0)
        self.published = None
        for field in () if self.grids is None else self.grids.both():
            field.reset()

    def begin(self, offset: float) -> None:
        """A run starts with ``offset`` [m]."""
        self.offset = self._solved = offset
        self._slope, self._since, self._count, self.calm = 0.0, 0, 1, False

    def expected(self, count: int) -> float:
        """Offset in [m] after a coupling step of ``count`` segments if it goes on as between the
        last two solutions.
        """
        return self._solved + self._slope * (self._since + count)

    def bend(self, offset: float, count: int) -> float:
        """Largest distance in [m] of the straight line to ``offset`` [m], ``count`` segments on,
        from a parabola through three.
        """
        span = self._since + count
        slope = (offset - self._solved) / span
        return abs(slope - self._slope) * span**2 / (4.0 * (self._count + span))

    def turn(self, offset: float, count: int) -> float:
        """Largest error in [m] a segment of the slope of that line against the parabola's."""
        span = self._since + count
        return abs((offset - self._solved) / span - self._slope) * span / (self._count + span)

    def take(self, offset: float, count: int, solved: bool, allowed: float) -> None:
        """A coupling step of ``count`` segments is done; ``offset`` [m] was found there, or
        expected; ``allowed`` [m] is its error.
        """
        span = self._since + count
        if solved:
            self.calm = self.still and abs(offset - self.expected(count)) <= CALM * allowed
            self._slope, self._count = (offset - self._solved) / span, span
            self._solved, span = offset, 0
        self._since, self.offset = span, offset

    def solve(self, approach: float, geometric: float, block: int) -> float:
        """Solve the field at ``approach`` [m]; returns the offset to the ``geometric`` approach [m]
        of the smooth height.

        Where the contact outgrows the usual grid, or touches beyond it, the wide one takes over.
        Raises RunError where that is too small as well.
        """
        if self.grids is None or self.contact is None:
            return 0.0
        try:
            offset = self._solve_on(self.grids.usual, approach, geometric)
            if not self.touches_beyond(self.grids, approach):
                return offset
        except FieldEdgeError:
            self.grids.usual.reset()
        except FieldError as error:
            raise RunError(f"block {block}: {error}") from None
        try:
            offset = self._solve_on(self.grids.wide, approach, geometric)
        except FieldError as error:
            raise RunError(f"block {block}: {error}") from None
        self.refuse_beyond(self.grids, approach, block)
        return offset

    def stand(self, load: float) -> float:
        """Approach in [m] at which the field carries ``load`` [N]; the start of a run. Errors as
        ``solve``.
        """
        assert self.grids is not None
        return self._stand_on(self.grids, load)[0]

    def _stand_on(self, grids: FieldGrids, load: float) -> tuple[float, PressureField]:
        """Approach in [m] under ``load`` [N] and the field that carries it: the usual one, or the
        wide one.
        """
        for field in grids.both():
            try:
                field.roll_to(self.road_row(field.settings))
                approach = field.solve_load(self.gap(field.settings), load)
                if field is grids.wide:
                    self.refuse_beyond(grids, approach, 0)
                elif self.touches_beyond(grids, approach):
                    continue
                return approach, field
            except FieldEdgeError as error:
                field.reset()
                last = error
            except FieldError as error:
                raise RunError(f"block 0: {error}") from None
        raise RunError(f"block 0: {last}")

    def keep(self) -> None:  # noqa: B027  # most supports remember nothing
        """The last field is the one of its instant: what remembers it takes it over."""

    def take_cost(self) -> tuple[int, float]:
        """Iterations since the last call, and the residual of the last field."""
        if self.grids is None:
            return 0, 0.0
        iterations = sum(field.iterations for field in self.grids.both())
        for field in self.grids.both():
            field.iterations = 0
        return iterations, max(field.residual for field in self.grids.both())

    def copy_published(self) -> FieldRecord | None:
        """The last field, copied before the next solve overwrites it."""
        return None if self.published is None else self.published._replace(pressure=self.published.pressure.copy())

    def with_loss(self, found: FieldRecord, approach: float, rate: float) -> FieldRecord:
        """The elastic field with the loss of the contact's law, so that its integral is the force
        at its instant.

        ``approach`` [m] and its ``rate`` [m/s] are those of the smooth contact.
        """
        assert self.contact is not None
        factor = pressure_factor(self.contact.elastic, self.contact.dissipative, approach, rate, 1.0)
        return found._replace(pressure=found.pressure * factor)

    def _solve_on(self, field: PressureField, approach: float, geometric: float) -> float:
        assert self.contact is not None
        assert self.grids is not None
        gap = self.gap(field.settings)
        field.roll_to(self.road_row(field.settings))
        field.solve(gap, approach)
        self.published = FieldRecord(field.pressure, *self.origin(field.settings), approach, self.travel)
        if field.load == 0.0:  # free: the nearest place may lie beyond the usual grid
            gap = self.gap(self.grids.wide.settings)
        return offset_of(self.contact.elastic, field, gap, approach, geometric)

    def road_row(self, settings: FieldSettings) -> int:
        """Row of the road under the first row of a grid."""
        return 0

    def touches_beyond(self, grids: FieldGrids, approach: float) -> bool:
        """Whether the contact just solved on the usual grid at ``approach`` [m] goes on outside it:
        it stands before a wall.
        """
        return False

    def refuse_beyond(self, grids: FieldGrids, approach: float, block: int) -> None:  # noqa: B027  # most have nothing there
        """Raise RunError where the contact just solved on the wide grid at ``approach`` [m] goes on
        outside it.
        """

    @abstractmethod
    def gap(self, settings: FieldSettings) -> Gap:
        """Undeformed gap in [m] on the cells of a grid, at the present place."""

    @abstractmethod
    def origin(self, settings: FieldSettings) -> tuple[float, float]:
        """Centre of cell (0, 0) in the contact's frame, x and y in [m]."""


class CushionSupport(Support):
    """The cushion under the occupant, whose form does not change."""

    still = True

    def __init__(self, grids: FieldGrids | None, contact: Contact | None, shape: SeatShape | None) -> None:
        """As ``Support``; ``shape`` is the occupant's lower surface."""
        super().__init__(grids, contact)
        self._gaps = {} if grids is None or shape is None else {
            field.settings.rows: seat_gap_on(shape, field.settings) for field in grids.both()
        }  # fmt: skip
        cells = {} if grids is None else {field.settings.rows: seat_cells(field.settings) for field in grids.both()}
        self._origins = {rows: (float(x[0]), float(y[0])) for rows, (x, y) in cells.items()}

    def gap(self, settings: FieldSettings) -> Gap:
        """See Support."""
        return self._gaps[settings.rows]

    def origin(self, settings: FieldSettings) -> tuple[float, float]:
        """See Support."""
        return self._origins[settings.rows]
