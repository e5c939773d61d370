"""The shear fields of a rolling tire, read one by one."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.report.series import FloatArray, PressureMap, Recording

SCALARS = ("slip", "slip_angle", "force_x", "force_y", "moment_z", "sliding_share", "dissipated")
MOSTLY = 0.95
"""Share of slipping cells above which the footprint slides as a whole."""
SMALL = 0.05
"""Share of the other force below which a force has no map of its own."""


class ShearMap(NamedTuple):
    """The shear on a rolling tire at one instant."""

    time: float
    """[s]"""
    slip: float
    """(omega R - v) / v"""
    slip_angle: float
    """[rad]"""
    force_x: float
    force_y: float
    """[N] on the tire"""
    moment_z: float
    """[N m]"""
    sliding_share: float
    """slipping cells among those in contact"""
    grid: PressureMap
    """magnitude of the shear on its grid"""
    shear_x: FloatArray
    shear_y: FloatArray
    """[Pa] [rows, cols] on the tire"""
    state: NDArray[np.uint8]
    """[rows, cols] 0 separated, 1 sticks, 2 slips"""


class ShearSeries(NamedTuple):
    """Friction of a rolling tire over time, and its shear where it is largest."""

    time: FloatArray
    """[s]"""
    slip: FloatArray
    """(omega R - v) / v"""
    slip_angle: FloatArray
    """[rad]"""
    force_x: FloatArray
    force_y: FloatArray
    """[N] on the tire, forward and left positive"""
    moment_z: FloatArray
    """[N m] on the tire"""
    sliding_share: FloatArray
    """slipping cells among those in contact"""
    dissipated: FloatArray
    """[J] since the instant before"""
    largest: list[ShearMap]
    """where the force along, and where that across, is largest while some cells stick; one where
    the other is small
    """


def shear_of(recording: Recording) -> ShearSeries | None:
    """Friction of a recording; None where the bag holds none."""
    return recording.series.get("shear")


class ShearReader:
    """Scalars of all fields, and the whole fields with the largest force along and across that
    still stick somewhere.
    """

    def __init__(self) -> None:
        """Nothing read yet."""
        self._scalars: list[tuple[float, ...]] = []
        self._largest: dict[str, tuple[float, Any]] = {}

    def add(self, time: float, _type: str, message: Any) -> None:
        """Read the field at `time` [s]. BagError for one that does not fill its grid."""
        cells = message.rows * message.cols
        if any(len(values) != cells for values in (message.shear_x, message.shear_y, message.state)):
            raise BagError(f"the shear at {time:.6f} s does not fill its {message.rows} x {message.cols} cells")
        self._scalars.append((time, *(float(getattr(message, name)) for name in SCALARS)))
        for name in ("force_x", "force_y"):
            before = self._largest.get(name)
            if before is None or _worth(name, message) > _worth(name, before[1]):
                self._largest[name] = (time, message)

    def finish(self) -> ShearSeries:
        """The series of all fields read; at least one."""
        if not self._scalars:
            raise BagError("no shear was read")
        time, *columns = np.array(self._scalars).T
        along, across = (self._largest[name] for name in ("force_x", "force_y"))
        force_x, force_y = abs(along[1].force_x), abs(across[1].force_y)
        if force_y <= SMALL * force_x or along[0] == across[0]:
            chosen = [along]
        else:
            chosen = [across] if force_x <= SMALL * force_y else [along, across]
        largest = [_shear_map(*each) for each in chosen]
        return ShearSeries(time, **dict(zip(SCALARS, columns, strict=True)), largest=largest)


def _worth(name: str, message: Any) -> tuple[bool, float]:
    """Order of what is shown: cells that stick and cells that slip say more than a footprint that
    slides as a whole.
    """
    return message.sliding_share <= MOSTLY, abs(getattr(message, name))


def _shear_map(time: float, message: Any) -> ShearMap:
    shape = (message.rows, message.cols)
    x, y = (np.array(values, dtype=np.float64).reshape(shape) for values in (message.shear_x, message.shear_y))
    state = np.array(message.state, dtype=np.uint8).reshape(shape)
    grid = PressureMap(np.hypot(x, y), message.cell_x, message.cell_y, message.origin_x, message.origin_y)
    slip, angle, force_x, force_y, moment, share = (float(getattr(message, name)) for name in SCALARS[:-1])
    return ShearMap(time, slip, angle, force_x, force_y, moment, share, grid, x, y, state)
