"""What a coupling step misses in its middle: fields of their own are solved there, and beside the
grid of the contact one of half as many cells each way.

Between two solutions of the fields nothing sees the road but its smooth height, and a step longer
than the waves that shake the force tells nothing about them: three solutions in a row look smooth
whatever lies between. So every few steps the bodies go to the middle once more, and the force of
the field there is compared with the force that acted. The solutions of these fields are used for
nothing else: the run is that of its own fields.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_force, elastic_stiffness
from contact_sim_pkg.laws.parameters import Contact, NormalDissipative
from contact_sim_pkg.pressure.field.patch import contact_area
from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.vehicle.field.contact_field import FieldError, FieldGrids, PressureField, make_grids
from contact_sim_pkg.rigs.vehicle.field.coupling_rule import extent_of
from contact_sim_pkg.rigs.vehicle.field.driver import ContactField
from contact_sim_pkg.rigs.vehicle.model import Model
from contact_sim_pkg.rigs.vehicle.run.bodies import Bodies, CouplingStep
from contact_sim_pkg.rigs.vehicle.seat.cushion_field import CushionField
from contact_sim_pkg.rigs.vehicle.tire.coarse_level import CoarseLevel, can_be_halved, halved
from contact_sim_pkg.rigs.vehicle.tire.road_field import RoadField
from contact_sim_pkg.run.errors import RunError

CLOSER = 0.1
"""Of the tolerance of the contact's field: that of the fields which check it."""

FIRST_PAUSE, LONGEST_PAUSE = 1, 24
"""Steps from one check to the next: at the start of a run, doubled each time, and later."""

UNUSUAL, LEAST_UNUSUAL = 3.0, 0.05
"""Times the usual estimate of a step, and of the allowed error: a larger one is checked at once."""

LONGER = 1.5
"""Times the way of the last step that was checked: a longer one is checked at once, since three solutions on a road that
changes may lie on a parabola by chance.
"""

WEIGHT, UNLUCKY = 0.125, 3.0
"""Of the newest value in a running mean; the largest error of a block over the root mean square."""

KINDS = ("normal", "along", "peak", "area", "speed")
"""Of the errors of a contact: normal force [N], force along the travel [N], largest pressure [Pa],
area [m^2], speed [m/s] of the body that touches.
"""

SAMPLED = 0.85
"""Of the error in the middle of a step, where it is largest: what the samples show of it."""

COLUMNS = 2 * len(KINDS)

HALVED, HALVED_AT_EDGE = 3.0, 1.0
"""Error of a grid of half as many cells each way over that of the grid, less one: of second order; of
first order on an edge of the road that no grid resolves.
"""

EDGE_OF_RATE = 2.0
"""Rate at the ends of a step whose height errs by so much less in its middle, over its length: of a
parabola."""


class Missed(NamedTuple):
    """Errors of one contact in the middle of a coupling step, or of its grid; None: not known."""

    normal: float = 0.0  # [N]
    along: float = 0.0  # [N] along the travel
    peak: float | None = None  # [Pa]
    area: float | None = None  # [m^2]
    speed: float | None = None  # [m/s] of the body that touches


class Middle(NamedTuple):
    """Errors of both contacts: of the interpolation in time, and of grids."""

    tire: Missed
    seat: Missed
    tire_grid: Missed
    seat_grid: Missed


NOTHING, UNKNOWN = Missed(), Missed(math.nan, math.nan)


def middle_of(step: CouplingStep) -> int:
    """Segment at whose end a step is looked at: the middle one; of a single one that, for its grid."""
    return max(1, step.segments // 2)


class MissedSoFar:
    """Errors that the checks of a run found, block by block: the largest of the block, or `UNLUCKY`
    times the usual one.
    """

    STATE = State((), ("_square", "_block"))

    def __init__(self) -> None:
        """No check yet."""
        self._square, self._block = [math.nan] * COLUMNS, [0.0] * COLUMNS

    def add(self, found: Middle) -> None:
        """Count the errors of a check."""
        values = (*_errors(found.tire, found.tire_grid), *_errors(found.seat, found.seat_grid))
        for place, value in enumerate(values):
            if math.isnan(value):
                continue
            square, before = value * value, self._square[place]
            self._square[place] = square if math.isnan(before) else before + WEIGHT * (square - before)
            self._block[place] = max(self._block[place], value)

    def add_estimate(self, contact: int, error: float) -> None:
        """Count the error [N] of a normal force by the curvature over a step."""
        self._block[len(KINDS) * contact] = max(self._block[len(KINDS) * contact], error)

    def pop(self) -> Vector:
        """Estimated errors of the block that ends, [contacts, `KINDS`] in SI units; NaN: not known."""
        usual = [UNLUCKY * math.sqrt(square) for square in self._square]
        found = [max(largest, each) or each for largest, each in zip(self._block, usual, strict=True)]
        self._block = [0.0] * COLUMNS
        return SAMPLED * numpy.array(found).reshape(-1, len(KINDS))


def _errors(middle: Missed, grid: Missed) -> tuple[float, ...]:
    unknown = (math.nan if value is None else value for value in (grid.peak, grid.area, middle.speed))
    return middle.normal + grid.normal, middle.along, *unknown


class Halved:
    """The grid of a contact with half as many cells each way."""

    STATE = State((), ("_field", "_usual"))

    def __init__(self, settings: FieldSettings, contact: str, *, at_edge: bool) -> None:
        """Make the grid; it has the same extent. ``at_edge``: of the road that no grid resolves."""
        self._order = HALVED_AT_EDGE if at_edge else HALVED
        self._settings, self._field = settings, PressureField(halved(settings), contact)
        self.reset()

    def reset(self) -> None:
        """Drop the previous solution."""
        self._usual: float | None = None  # [N] how much more the field of this grid carries
        self._field.reset()

    def missed(self, fine: ContactField, approach: float) -> Missed:
        """Error of the usual grid of ``fine``, solved at ``approach`` [m], by the difference to this
        one.
        """
        usual = fine.grids.usual if fine.grids is not None else None
        if usual is None or fine.published is None or fine.published.pressure.shape != usual.pressure.shape:
            return NOTHING
        row = fine.road_row(self._settings)
        gap = fine.gap(self._settings)
        try:
            # Always the same nodes of the road, so that its heights pass by unchanged
            origin = fine.origin(self._settings)[0] + row % 2 * self._settings.cell_x
            self._field.roll_to((row + row % 2) // 2, origin)
            self._field.solve(numpy.ascontiguousarray(gap[row % 2 :: 2, ::2]), approach)
        except FieldError:
            self._field.reset()
            return NOTHING
        cell, pressure, half = fine.cell_area, usual.pressure, self._field.pressure
        # cells count alone: their shape does not matter to the share of them that an edge leaves out
        areas = contact_area(pressure, 1.0, cell), contact_area(half, 1.0, 4.0 * cell)
        return Missed(
            normal=self._load_missed(self._field.load - usual.load) / self._order,
            peak=abs(float(half.max()) - float(pressure.max())) / self._order,
            area=abs(areas[0] - areas[1]) / self._order,
        )

    def _load_missed(self, more: float) -> float:
        """Error [N] of a force where this grid carries so much ``more`` [N] than the usual one: beside
        what it always does, which a run takes up in the height that it stands at.
        """
        usual = more if self._usual is None else self._usual
        self._usual = usual + WEIGHT * (more - usual)
        return abs(more - usual)


class CouplingCheck:
    """Checks of the coupling steps of one run. ``is_due`` after each step, then ``look``."""

    STATE = State((), ("_pause", "_since", "_usual", "_way", "_tire", "_seat", "_level", "_halves"))

    def __init__(self, model: Model, tire: RoadField, seat: CushionField) -> None:
        """Make the fields for a ``model`` whose run has the fields ``tire`` and ``seat``."""
        self._tire = RoadField(_closer(model.tire_field, "tire"), tire.contact, model.tire_geometry, None)
        self._run, self._level = tire, None
        grids = self._tire.grids
        if tire.level is not None and grids is not None and model.tire_geometry is not None:
            self._level = CoarseLevel(grids.usual.settings, grids.usual.contact, model.tire_geometry, math.inf)
        self._order = HALVED_AT_EDGE if model.has_edge else HALVED
        self._mass, self._swing = _swing_of(model)
        self._seat = CushionField(_closer(model.seat_field, "seat"), seat.contact, model.seat_shape)
        self._halves = tuple(
            None if grids is None or not can_be_halved(grids.usual.settings)
            else Halved(grids.usual.settings, name, at_edge=model.has_edge)
            for grids, name in ((model.tire_field, "tire"), (model.seat_field, "seat"))
        )  # fmt: skip
        self.reset()

    def reset(self) -> None:
        """Reset all but the buffers."""
        self._pause, self._since, self._usual, self._way = FIRST_PAUSE, 0, 0.0, math.inf
        for field in (self._tire, self._level, self._seat, *self._halves):
            if field is not None:
                field.reset()

    def is_due(self, step: CouplingStep, error: float) -> bool:
        """Whether a step with an estimated ``error`` is checked; each call counts as a step."""
        self._since += 1
        unusual = error > max(UNUSUAL * self._usual, LEAST_UNUSUAL)
        self._usual += WEIGHT * (error - self._usual)
        way = extent_of(step.drive.travel)
        if not (unusual or way > LONGER * self._way or self._since >= self._pause):
            return False
        self._pause = min(2 * self._pause, LONGEST_PAUSE) if self._since >= self._pause and not unusual else self._pause
        self._since, self._way = 0, way
        return True

    def look(self, bodies: Bodies, step: CouplingStep, slopes: tuple[float, float]) -> Middle:
        """Errors in the middle of a step, where the ``bodies`` have been moved to; ``slopes`` [1]:
        effective ones of the road at both ends. What cannot be solved there is not known.
        """
        half = middle_of(step)
        drive, laid = step.drive, bodies.laid(half)
        tire, seat = UNKNOWN, UNKNOWN
        tire_grid = seat_grid = NOTHING
        try:
            by_level = self._look_by_level(bodies, step, slopes, laid[0])
            if by_level is not None:
                tire, tire_grid = by_level
            elif self._tire.grids is not None:
                self._tire.place(drive.road, float(drive.travel[half]))
                smooth, approach = float(drive.smooth[half]), bodies.tire_approach(drive.table_at(half))
                found = self._tire.solve(approach, bodies.tire_approach(smooth), step.block)
                slope = slopes[0] + (slopes[1] - slopes[0]) * half / step.segments
                tire = _missed(self._tire.contact, bodies.tire_approach(laid[0]), smooth + found - laid[0], step)
                along = abs(self._tire.effective_slope() - slope) * self._load(self._tire)
                tire = tire._replace(along=along, speed=tire.normal * self._speed_of(step.duration))
                tire_grid = self._grid(0, self._tire, approach)
            if self._seat.grids is not None:
                approach = bodies.seat_approach(0.0)
                found = self._seat.solve(approach, approach, step.block)
                seat = _missed(self._seat.contact, bodies.seat_approach(laid[1]), found - laid[1], step)
                seat_grid = self._grid(1, self._seat, approach)
        except RunError:
            self._tire.reset()
            self._seat.reset()
            return Middle(UNKNOWN, UNKNOWN, NOTHING, NOTHING)
        return Middle(tire, seat, tire_grid, seat_grid)

    def _look_by_level(
        self, bodies: Bodies, step: CouplingStep, slopes: tuple[float, float], laid: float
    ) -> tuple[Missed, Missed] | None:
        """Errors at the tire by the coarse level, on whose height ``laid`` [m] the bodies were moved, and of the grid by
        the difference of the levels at the last published field; None where the fine field is solved at each step.
        """
        level, contact = self._run.level, self._run.contact
        if self._level is None or level is None or contact is None or not level.is_quiet:
            return None
        half, drive, below = middle_of(step), step.drive, bodies.tire_approach(0.0)
        approach = below + drive.table_at(half)
        coarse = self._level.at(drive.road, float(drive.travel[half]), approach, contact.elastic)
        if coarse is None:
            return None
        found, load = level.with_offset(coarse), self._level.field.load
        tire = _missed(contact, bodies.tire_approach(laid), found.height - below - laid, step)
        slope = slopes[0] + (slopes[1] - slopes[0]) * half / step.segments
        tire = tire._replace(along=abs(found.slope - slope) * load, speed=tire.normal * self._speed_of(step.duration))
        return tire, Missed(peak=level.peak_differs / self._order, area=level.area_differs / self._order)

    def _speed_of(self, duration: float) -> float:
        """Speed [m/s] of wheel or belt for each newton that the most unlucky step misses in its middle:
        the usual one misses less, two thirds of that on average, now up, now down, as far back as the
        swing on the tire remembers.
        """
        return 2.0 / 3.0 / UNLUCKY * math.sqrt(duration * self._swing) / self._mass

    def _grid(self, place: int, field: ContactField, approach: float) -> Missed:
        half = self._halves[place]
        return NOTHING if half is None else half.missed(field, approach)

    @staticmethod
    def _load(field: ContactField) -> float:
        return 0.0 if field.published is None else float(field.published.pressure.sum()) * field.cell_area


def _swing_of(model: Model) -> tuple[float, float]:
    """Mass [kg] of what touches the road, and the period [s] of its swing on its springs at rest."""
    quarter = model.quarter
    if quarter is None or model.coupling is None:
        return 1.0, 0.0
    mass, beside = quarter.tread.mass, quarter.beside
    law, load = quarter.contact.law.elastic, model.coupling.allowances[0].load
    stiffness = float(elastic_stiffness(law, float(approach_of_force(law, load)))) + beside
    return mass, 2.0 * math.pi * math.sqrt(mass / stiffness)


def _closer(grids: FieldGrids | None, contact: str) -> FieldGrids | None:
    if grids is None:
        return None
    settings = grids.usual.settings
    return make_grids(settings._replace(tolerance=CLOSER * settings.tolerance), contact)


def _missed(contact: Contact | None, approach: float, height: float, step: CouplingStep) -> Missed:
    """Error of the normal force at an ``approach`` [m] whose ``height`` [m] is missing, with that of
    the loss, which sees the rate of the height.
    """
    if contact is None:
        return NOTHING
    force = float(elastic_force(contact.elastic, approach))
    normal = abs(float(elastic_force(contact.elastic, approach + height)) - force)
    loss = contact.dissipative
    damping = loss.damping if isinstance(loss, NormalDissipative) else 0.0
    return Missed(normal + force * damping * EDGE_OF_RATE * abs(height) / step.duration)
