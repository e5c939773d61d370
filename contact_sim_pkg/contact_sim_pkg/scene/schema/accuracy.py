"""What an asked accuracy stands for: grids, tolerances, corrector passes. One table.

The figures behind the rungs are those of `bench accuracy`, which measures each of them against a reference on the
user's machine; the levels of the field of the tire are (force 64 × 48 cells to 1e-2, field 128 × 96
to 1e-3, reference 256 × 192 to 1e-6).
"""

from __future__ import annotations

from typing import Literal, NamedTuple

Contact = Literal["tire", "seat"]

FASTEST = 0.1
"""What `accuracy: realtime` stands for: the cheapest rung."""
LOOSEST_INTEGRATION = 1e-4
INTEGRATION_SHARE = 1e-2
"""The time integration may make this part of the asked error."""
HELD_INTEGRATION = 1e-8
"""Loosest for a rigid body that turns on held points: the impacts that follow multiply its errors, and less costs nothing."""


class Rung(NamedTuple):
    """One price of a pressure field."""

    name: str
    accuracy: float  # smallest asked error that this rung is taken for
    tire_cells: tuple[int, int]  # rows (along), cols (across)
    seat_cells: tuple[int, int]
    tolerance: float  # of the field solver
    corrector_passes: int

    def cells(self, contact: Contact) -> tuple[int, int]:
        """Rows and cols of the field of a contact."""
        return self.tire_cells if contact == "tire" else self.seat_cells

    def field_tolerance(self, contact: Contact) -> float:
        """Tolerance of the field solver. The light frame of an occupant feels a tenth of what the wheel feels."""
        return self.tolerance * (0.1 if contact == "seat" else 1.0)

    def passes(self, contact: Contact) -> int:
        """Corrector passes of a field: the cushion does not move under the body, so it needs one fewer."""
        return self.corrector_passes - (1 if contact == "seat" else 0)


RUNGS: tuple[Rung, ...] = (
    Rung("force", 1e-2, (48, 64), (40, 40), 1e-2, 1),
    Rung("field", 1e-3, (96, 128), (64, 64), 1e-3, 2),
    Rung("reference", 0.0, (192, 256), (96, 96), 1e-6, 4),
)
"""Cheapest first."""


def asked(accuracy: float | str) -> float:
    """The accuracy as a number."""
    return FASTEST if isinstance(accuracy, str) else accuracy


def rung_for(accuracy: float | str) -> Rung:
    """The cheapest rung that reaches the asked accuracy."""
    return next(rung for rung in RUNGS if asked(accuracy) >= rung.accuracy)


def rung_name(contact: Contact, rows: int, cols: int) -> str:
    """Name of the rung with these cells, or `custom`."""
    return next((rung.name for rung in RUNGS if rung.cells(contact) == (rows, cols)), "custom")


def integration_tolerance(accuracy: float | str, *, impacts: bool = False) -> float:
    """Relative tolerance of a time step; ``impacts``: of a rigid body, whose impacts have no duration."""
    return min(HELD_INTEGRATION if impacts else LOOSEST_INTEGRATION, INTEGRATION_SHARE * asked(accuracy))


def cells_of(accuracy: float | str, contact: Contact, rows: int | None, cols: int | None) -> tuple[int, int]:
    """Rows and cols of a field: as given, else those of the rung."""
    default_rows, default_cols = rung_for(accuracy).cells(contact)
    return (default_rows if rows is None else rows, default_cols if cols is None else cols)
