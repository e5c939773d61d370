"""Pressure field of a half-space of foam under the occupant."""

from __future__ import annotations

from contact_sim_pkg.laws.parameters import Contact
from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.rigs.vehicle.field.contact_field import FieldGrids
from contact_sim_pkg.rigs.vehicle.field.driver import ContactField, Gap
from contact_sim_pkg.rigs.vehicle.seat.shape import SeatShape, seat_cells, seat_gap_on


class CushionField(ContactField):
    """Field of the cushion under the occupant, whose gap does not change."""

    is_static = True

    def __init__(self, grids: FieldGrids | None, contact: Contact | None, shape: SeatShape | None) -> None:
        """As ``ContactField``; ``shape`` is the occupant's lower surface."""
        super().__init__(grids, contact)
        self._gaps = {} if grids is None or shape is None else {
            field.settings.rows: seat_gap_on(shape, field.settings) for field in grids.both()
        }  # fmt: skip
        cells = {} if grids is None else {field.settings.rows: seat_cells(field.settings) for field in grids.both()}
        self._origins = {rows: (float(x[0]), float(y[0])) for rows, (x, y) in cells.items()}

    def gap(self, settings: FieldSettings) -> Gap:
        """See `ContactField`."""
        return self._gaps[settings.rows]

    def origin(self, settings: FieldSettings) -> tuple[float, float]:
        """See `ContactField`."""
        return self._origins[settings.rows]
