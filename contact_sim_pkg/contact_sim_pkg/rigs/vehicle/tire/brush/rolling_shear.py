"""Shear of the rolling tire from published field to published field: the brush, fed with the slip
programme of the scene.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.rigs.vehicle.tire.brush.rolling_brush import (
    BrushResult,
    PatchGrid,
    advance_brush,
    make_brush_state,
    rolling_step,
)
from contact_sim_pkg.rigs.vehicle.tire.model import RollingFriction

__all__ = ["RollingShear", "Sheared"]

Field = NDArray[numpy.float64]


class Sheared(NamedTuple):
    """Shear at one field instant, on the cells of its pressure field."""

    slip: float
    slip_angle: float  # [rad]
    result: BrushResult
    shear_x: Field  # [Pa]
    shear_y: Field  # [Pa]
    state: NDArray[numpy.uint8]


class RollingShear:
    """The bristles of one tire; ``advance`` at each field instant, in order."""

    def __init__(self, friction: RollingFriction, wide: FieldSettings) -> None:
        """Bristles on the ``wide`` grid: smaller fields lie in its middle."""
        self._friction, self._wide = friction, wide
        shape = (wide.rows, wide.cols)
        self._pressure: Field = numpy.zeros(shape)
        self._shear_x: Field = numpy.zeros(shape)
        self._shear_y: Field = numpy.zeros(shape)
        self._state: NDArray[numpy.uint8] = numpy.zeros(shape, dtype=numpy.uint8)
        self.reset()

    def reset(self) -> None:
        """Reset to a standing, unstrained tire."""
        self._bristles = make_brush_state(self._wide.rows, self._wide.cols)
        self._time = 0.0
        self._travel: float | None = None

    def advance(self, pressure: Field, origin_x: float, origin_y: float, travel: float, time: float) -> Sheared:
        """Roll on to ``travel`` [m] at ``time`` [s], where the field is ``pressure`` [Pa] with cell
        (0, 0) at the origin [m].
        """
        wide, friction = self._wide, self._friction
        # Embed the field in the middle of the wide grid, on which the bristles live.
        row = wide.rows // 2 - pressure.shape[0] // 2
        col = (wide.cols - pressure.shape[1]) // 2
        part = (slice(row, row + pressure.shape[0]), slice(col, col + pressure.shape[1]))
        self._pressure.fill(0.0)
        self._pressure[part] = pressure
        # The slips in the middle of the step act over all of it.
        before = self._travel if self._travel is not None else travel
        step = rolling_step(travel - before, *friction.slips_at(0.5 * (self._time + time)))
        grid = PatchGrid(origin_x - row * wide.cell_x, origin_y - col * wide.cell_y, wide.cell_x, wide.cell_y)
        result = advance_brush(
            friction.brush,
            self._bristles,
            grid,
            self._pressure,
            step,
            shear_x=self._shear_x,
            shear_y=self._shear_y,
            mode=self._state,
        )
        self._time, self._travel = time, travel
        shear_x, shear_y = self._shear_x[part].copy(), self._shear_y[part].copy()
        return Sheared(*friction.slips_at(time), result, shear_x, shear_y, self._state[part].copy())
