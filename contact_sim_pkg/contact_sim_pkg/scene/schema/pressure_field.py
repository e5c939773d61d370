"""Keys of a pressure field, and its fidelity levels: what a requested accuracy stands for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, Protocol, TypeVar

from contact_sim_pkg.records.fields import Section, number
from contact_sim_pkg.scene.schema.accuracy import FASTEST, level_of, requested

if TYPE_CHECKING:
    from contact_sim_pkg.scene.schema.scene import Scene

MOST_CELLS_A_SIDE = 65536

LOOSER = 3.0
"""Factor on the tolerance of the least expensive level where an error of `FASTEST` or more is allowed."""


SOLVER_SHARE = 0.1
"""Of the request: tolerance of the solver at most."""


Wanted = TypeVar("Wanted", bound=Section)


class WithEffects(Protocol):
    """A scene, resolved or not."""

    def effect(self, contact: str, kind: type[Wanted], /) -> Wanted | None:
        """The section of an effect; None without it."""


class GridSection(NamedTuple):
    """A pressure field at one fidelity level."""

    rows: int  # along
    cols: int  # across
    tolerance: float  # relative, of the solver
    corrector_passes: int

    @property
    def cells(self) -> tuple[int, int]:
        """Rows and cols."""
        return self.rows, self.cols


class PressureFieldSection(Section):
    """Pressure field of a contact on a half-space; it is the contact, its integral is the force."""

    fixed: ClassVar[str] = "the cells of the field carry its state"

    levels: ClassVar[tuple[GridSection, ...]]
    """One grid for each of `accuracy.LEVELS`."""

    length: float | None = number(0.01, 5.0, "m", "extent forward")
    width: float | None = number(0.01, 5.0, "m", "extent to the left")
    rows: int | None = number(
        4, MOST_CELLS_A_SIDE, "", "cells along the field (forward); taken from accuracy when absent", default=None
    )
    cols: int | None = number(
        4, MOST_CELLS_A_SIDE, "", "cells across the field (left); taken from accuracy when absent", default=None
    )
    tolerance: float | None = number(
        1e-12, 0.1, "", "relative error of the pressure; taken from accuracy when absent", default=None
    )
    corrector_passes: int | None = number(
        0, 8, "", "most repetitions of a coupling step with the field at its end; taken from accuracy when absent",
        default=None,
    )  # fmt: skip

    @classmethod
    def levels_of(cls, scene: WithEffects) -> tuple[GridSection, ...]:
        """The levels of the contact in a scene."""
        return cls.levels

    def open_values(self, scene: Scene) -> dict[str, Any]:
        level = self.levels_of(scene)[level_of(scene.accuracy)]
        if requested(scene.accuracy) >= FASTEST:
            level = level._replace(tolerance=LOOSER * level.tolerance)
        return level._replace(tolerance=min(level.tolerance, requested(scene.accuracy) * SOLVER_SHARE))._asdict()

    def cells(self, scene: Scene) -> tuple[int, int]:
        """Rows and cols: as given, else those of the level."""
        rows, cols = self.levels_of(scene)[level_of(scene.accuracy)].cells
        return rows if self.rows is None else self.rows, cols if self.cols is None else self.cols
