"""Shear of the rolling tire from one solution of the field to the next: bristles, and the belt on its
sidewalls where the scene calls for it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.vehicle.tire.brush.belt_motion import (
    BELT_SAMPLES,
    BELT_STATES,
    BY_DRIFT,
    RIM,
    SPIN,
    WORKS,
    X_RATE,
    Y_RATE,
    YAW_RATE,
    BeltDrive,
    advance_belt,
)
from contact_sim_pkg.rigs.vehicle.tire.brush.rolling_brush import (
    BrushResult,
    PatchGrid,
    RollingStep,
    advance_brush,
    make_brush_state,
    rolling_step,
)
from contact_sim_pkg.rigs.vehicle.tire.model import RollingFriction
from contact_sim_pkg.rigs.vehicle.tire.parameters import Brush

__all__ = ["RollingShear", "Sheared", "TireStep", "Works"]

LEAST_LOAD = 0.1
"""Of the nominal load: below it friction rises no more."""

Field = NDArray[numpy.float64]


class TireStep(NamedTuple):
    """A coupling step, as bristles and belt take it: from one solution of the field to the next."""

    start: float  # [s]
    segment_length: float  # [s]
    segments: int
    travel: float  # [m] of the axle at the end
    slopes: float  # [N] force of the pressure on slopes at the end
    rolling: float  # [N] moment of rolling resistance over the radius, at the end
    deflection: float  # [m] of the axle, at the end
    sample_every: int  # segments
    behind_sample: int  # segments since the last sample

    @property
    def duration(self) -> float:
        """In [s]."""
        return self.segments * self.segment_length


class Works(NamedTuple):
    """Works [J] since the start, as `TireWork.msg` says them."""

    axle: float
    drift: float
    rim: float
    slopes: float
    moving: float
    springs: float
    strained: float
    brake: float
    dampers: float
    rolling: float
    bristles: float
    sampling: float

    @property
    def entries(self) -> tuple[float, float, float, float, float]:
        """Kinetic, potential, stored energy, work supplied and dissipated [J], as of the ledger; the sampling of the shear
        counts as dissipated by the bristles.
        """
        lost = self.brake + self.dampers + self.rolling + self.bristles + self.sampling
        return self.moving, 0.0, self.springs + self.strained, self.axle + self.drift + self.rim + self.slopes, lost


class Sheared(NamedTuple):
    """Shear at one field instant, on the cells of its pressure field."""

    slip: float
    slip_angle: float  # [rad]
    result: BrushResult  # its work since the instant before
    shear_x: Field  # [Pa]
    shear_y: Field  # [Pa]
    state: NDArray[numpy.uint8]


class RollingShear:
    """Bristles and belt of one tire; ``start`` once, then ``roll`` from field to field, in order."""

    STATE = State(
        (
            "_bristles", "_belt", "_time", "_travel", "_speed", "_angle", "_slopes", "_rolling", "_radius", "_last", "_result",
            "_load", "_moving", "_shear_x", "_shear_y", "_state",
        ),
        held=("_bristles",),
    )  # fmt: skip

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
        self._belt = numpy.zeros(BELT_STATES)
        self._time, self._travel, self._speed, self._angle = 0.0, 0.0, math.nan, 0.0
        self._slopes, self._rolling, self._radius = 0.0, 0.0, self._friction.radius
        self._samples: Field = numpy.zeros((0, BELT_SAMPLES))
        self._last: Field = numpy.zeros(BELT_SAMPLES)
        self._result = BrushResult(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        self._load = math.nan  # [N] smoothed
        self._moving = 0.0  # [J] kinetic energy at the start

    @property
    def has_belt(self) -> bool:
        """Whether a belt on sidewalls moves under it, whose works are known."""
        return self._friction.sidewalls is not None

    def start(self, pressure: Field, origin: tuple[float, float], travel: float, slopes: float) -> None:
        """Lay the bristles under the first field, which stands at ``travel`` [m]."""
        self.reset()
        self._travel, self._slopes = travel, slopes
        self._load, self._brush = self._smoothed(pressure, 0.0)
        step = rolling_step(0.0, *self._friction.slips.at(0.0))
        self._result = self._advance_bristles(self._lay(pressure, origin), step)

    def roll(self, step: TireStep, pressure: Field, origin: tuple[float, float]) -> Field:
        """Roll on to a field ``pressure`` [Pa] with cell (0, 0) at the ``origin`` [m].

        Returns the samples of `belt_motion.py` at the segments that hold one, [samples, 8]; good
        until the next call.
        """
        grid, sidewalls = self._lay(pressure, origin), self._friction.sidewalls
        before, way = self._result, step.travel - self._travel
        speed = way / step.duration
        self._load, self._brush = self._smoothed(pressure, way)
        # The slips in the middle of the coupling step act over all of it.
        slip, angle = self._friction.slips.at(step.start + 0.5 * step.duration)
        first, radius = math.isnan(self._speed), self._friction.radius_at(step.deflection)
        radii = radius if first else self._radius, radius
        rim = (1.0 + slip) * speed / (0.5 * (radii[0] + radii[1]))
        if first:  # the wheel rolls already
            self._speed, self._angle, self._belt[SPIN], self._belt[RIM] = speed, angle, rim, rim
            self._moving = self.kept()[0]
            self._last[:] = (0.0, 0.0, 0.0, self._slopes, 0.0, 0.0, 0.0, rim)
        if sidewalls is None:
            found = self._advance_bristles(grid, rolling_step(way, slip, angle, step.duration))
            samples = self._between(step, found, rim)
        else:
            parts = math.ceil(step.segment_length / self._friction.longest_step * (1.0 - 1e-9))
            drive = BeltDrive(
                step.duration, way, way * math.tan(angle), speed - self._speed, rim, radii,
                (self._slopes, step.slopes), (self._rolling * radii[0], step.rolling * radii[1]),
                *self._friction.torques.at(step.start + 0.5 * step.duration), step.segments * parts,
                step.sample_every * parts, step.behind_sample * parts,
            )  # fmt: skip
            rows = step.segments // step.sample_every + 2
            if len(self._samples) < rows:
                self._samples = numpy.zeros((rows, BELT_SAMPLES))
            self._steer(speed, angle)
            found = advance_belt(
                self._brush, sidewalls, self._bristles, self._belt, grid, self._pressure, drive, self._shear_x,
                self._shear_y, self._state, self._samples,
            )  # fmt: skip
            samples = self._samples
        self._time, self._travel, self._speed = step.start + step.duration, step.travel, speed
        self._slopes, self._rolling, self._radius = step.slopes, step.rolling, radii[1]
        dissipated, released = before.dissipated + found.dissipated, before.released + found.released
        self._result = found._replace(dissipated=dissipated, released=released)
        return samples

    def publish(self, pressed: Field) -> Sheared:
        """The present shear on the cells of the field ``pressed``."""
        part, result = self._part(pressed), self._result
        self._result = result._replace(dissipated=0.0, released=0.0)
        slip, angle = self._friction.slips.at(self._time)
        sidewalls = self._friction.sidewalls
        if sidewalls is not None and sidewalls.wheel is not None:
            way = 0.0 if math.isnan(self._speed) else self._speed
            slip = 0.0 if way == 0.0 else float(self._belt[RIM]) * self._radius / way - 1.0
        return Sheared(
            slip, angle, result, self._shear_x[part].copy(), self._shear_y[part].copy(), self._state[part].copy()
        )  # fmt: skip

    def works(self) -> Works:
        """Works of belt, rim and bristles since the start; of a belt on sidewalls, see `has_belt`."""
        axle, drift, rim, slopes, springs, brake, dampers, rolling, bristles, of_shear = self._belt[WORKS].tolist()
        moving, strained = self.kept()
        return Works(
            axle, drift, rim, slopes, moving - self._moving, springs, strained, brake, dampers, rolling, bristles,
            -of_shear - bristles - strained,
        )  # fmt: skip

    def kept(self) -> tuple[float, float]:
        """Kinetic energy of belt and rim in the plane of the road, and energy in the bristles [J]."""
        sidewalls, belt, brush = self._friction.sidewalls, self._belt, self._friction.brush
        area, bristles = self._wide.cell_x * self._wide.cell_y, self._bristles.bristles
        squares = (numpy.einsum("ij,ij->", u, u) for u in (bristles.deflection_x, bristles.deflection_y))
        along, across = (float(square) for square in squares)
        strained = 0.5 * area * (brush.stiffness_x * along + brush.stiffness_y * across)
        if sidewalls is None or math.isnan(self._speed):
            return 0.0, strained
        aside = self._speed * math.tan(self._angle) + belt[Y_RATE]
        kinetic = sidewalls.mass * ((self._speed + belt[X_RATE]) ** 2 + aside**2)
        kinetic += sidewalls.inertia * belt[SPIN] ** 2 + sidewalls.yaw_inertia * belt[YAW_RATE] ** 2
        if sidewalls.wheel is not None:
            kinetic += sidewalls.wheel.inertia * belt[RIM] ** 2
        return 0.5 * float(kinetic), strained

    def _steer(self, speed: float, angle: float) -> None:
        """Let the axle drift by a ``speed`` [m/s] and slip ``angle`` [rad] from now on; what that changes of the belt's
        kinetic energy the axle supplies.
        """
        sidewalls, aside = self._friction.sidewalls, float(self._belt[Y_RATE])
        assert sidewalls is not None
        before, now = (v * math.tan(a) + aside for v, a in ((self._speed, self._angle), (speed, angle)))
        self._belt[BY_DRIFT] += 0.5 * sidewalls.mass * (now**2 - before**2)
        self._angle = angle

    def _smoothed(self, pressure: Field, way: float) -> tuple[float, Brush]:
        """Load [N], smoothed over a length of the contact, after a ``way`` [m] to a field ``pressure`` [Pa],
        and the bristles with their friction under it.
        """
        by_load, brush = self._friction.by_load, self._friction.brush
        if by_load is None:
            return math.nan, brush
        load = float(pressure.sum()) * self._wide.cell_x * self._wide.cell_y
        if not math.isnan(self._load):
            length = max(1, int((pressure > 0.0).any(axis=1).sum())) * self._wide.cell_x
            load = self._load + (load - self._load) * -math.expm1(-abs(way) / length)
        ratio = max(load, LEAST_LOAD * by_load.nominal) / by_load.nominal
        return load, brush._replace(along=ratio**-by_load.along, across=ratio**-by_load.across)

    def _part(self, pressed: Field) -> tuple[slice, slice]:
        """The middle of the bristles' grid that a field covers."""
        rows, cols = pressed.shape
        row, col = self._wide.rows // 2 - rows // 2, (self._wide.cols - cols) // 2
        return slice(row, row + rows), slice(col, col + cols)

    def _lay(self, pressure: Field, origin: tuple[float, float]) -> PatchGrid:
        """Lay a field in the middle of the bristles' grid; returns where that lies."""
        part, wide = self._part(pressure), self._wide
        self._pressure.fill(0.0)
        self._pressure[part] = pressure
        x, y = origin[0] - part[0].start * wide.cell_x, origin[1] - part[1].start * wide.cell_y
        return PatchGrid(x, y, wide.cell_x, wide.cell_y)

    def _advance_bristles(self, grid: PatchGrid, step: RollingStep) -> BrushResult:
        found: BrushResult = advance_brush(
            self._brush, self._bristles, grid, self._pressure, step, shear_x=self._shear_x,
            shear_y=self._shear_y, mode=self._state,
        )  # fmt: skip
        return found

    def _between(self, step: TireStep, found: BrushResult, rim: float) -> Field:
        """Samples of a belt that is one with the rim, linear between the fields."""
        radius, before = self._friction.radius_at(step.deflection), self._last
        now: Field = numpy.array(
            (
                found.force_x, found.force_y, found.moment_z, step.slopes + found.force_x, found.force_y,
                -radius * (found.force_x + step.rolling), found.moment_z, rim,
            )
        )  # fmt: skip
        at = numpy.arange(-step.behind_sample % step.sample_every, step.segments, step.sample_every)
        self._last = now
        return numpy.asarray(before + (now - before) * (at / step.segments)[:, None])
