"""What moves the rig over one block, at every segment's end: travel, smooth road height,
accelerations, impulses.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.excitation.blocks import AHEAD
from contact_sim_pkg.excitation.travel import Travel
from contact_sim_pkg.rigs.vehicle.model import Model
from contact_sim_pkg.rigs.vehicle.tire.asperity_push import asperity_push
from contact_sim_pkg.rigs.vehicle.tire.footprint import effective_heights
from contact_sim_pkg.rigs.vehicle.tire.model import TireGeometry
from contact_sim_pkg.run.errors import RunError

ROAD, VIBRATION = "road/patch", "platform/vibration"
PLACES_AHEAD = 65
"""Places on the way ahead through which the line of its mean slope is laid."""


class BlockDrive(NamedTuple):
    """Values at the ends of all segments of a block, [segments + 1], or of a part of them."""

    road: Any  # the block's RoadPatch, None without a tire
    travel: Vector  # [m] of the wheel centre
    smooth: Vector  # [m] height that a smooth tire sees
    rate: Vector  # [m/s] of that height
    acceleration_x: Vector  # [m/s^2] of the floor
    acceleration_z: Vector  # [m/s^2]
    push: Vector | None  # [N] of the road's asperities; None where the scene calls for none

    speed: float = 0.0  # [m/s] at the start of the block
    table: Vector | None = None  # [m] height of a machine's table, which the smooth one contains; None: 0

    def table_at(self, point: int) -> float:
        """Height [m] of the table under the road at the end of a segment."""
        return 0.0 if self.table is None else float(self.table[point])

    def part(self, first: int, segments: int) -> BlockDrive:
        """The same for ``segments`` segments from number ``first``."""
        chosen = slice(first, first + segments + 1)
        return BlockDrive(
            self.road, self.travel[chosen], self.smooth[chosen], self.rate[chosen], self.acceleration_x[chosen],
            self.acceleration_z[chosen], None if self.push is None else self.push[chosen],
            self.speed, None if self.table is None else self.table[chosen],
        )  # fmt: skip


def block_drive(model: Model, travel: Travel | None, block: int, road: Any, vibration: Any) -> BlockDrive:
    """Drive of block number ``block`` from its input blocks; ``travel`` is None without a tire.

    Raises RunError where an input is missing, of another block, or does not fit the scene.
    """
    a_x, a_z = _accelerations(model, block, vibration)
    places, smooth, rate, push = _rolling(model, travel, block, road)
    speed, table = float(places[1] - places[0]) / model.timing.segment_length, None
    if model.machine is not None and model.machine.deflection is not None:
        table, rising = model.machine.table(_ends(model, block), model.timing.segment_length)
        smooth, rate = smooth + table, rate + rising
    return BlockDrive(road, places, smooth, rate, a_x, a_z, push, speed, table)


def _ends(model: Model, block: int) -> Vector:
    """Times [s] of the ends of all segments of a block."""
    steps = model.timing.intervals * model.timing.segments
    return numpy.arange(block * steps, (block + 1) * steps + 1, dtype=numpy.float64) * model.timing.segment_length


def _accelerations(model: Model, block: int, vibration: Any) -> tuple[Vector, Vector]:
    """Accelerations of the floor, straight between the samples; of a loaded axle that of its servo."""
    timing = model.timing
    points = timing.intervals * timing.segments + 1
    if not model.shaken:
        zeros = numpy.zeros(points)
        if model.machine is None or model.quarter is None or model.machine.is_held:
            return zeros, zeros
        mass = sum(each.mass for each in model.quarter.masses)
        servo = model.machine.acceleration(_ends(model, block), mass, model.quarter.wheel.mass, model.rig.gravity)
        return zeros, servo
    samples = (points - 1) // timing.vibration_stride + 1
    if vibration is None or vibration.block != block or len(vibration.acceleration_z) != samples:
        found = "none" if vibration is None else f"block {vibration.block} with {len(vibration.acceleration_z)} samples"
        raise RunError(f"{VIBRATION}: block {block} with {samples} samples was due, {found} came")
    position = numpy.arange(points) / timing.vibration_stride
    index = numpy.arange(samples)
    return (
        numpy.interp(position, index, vibration.acceleration_x),
        numpy.interp(position, index, vibration.acceleration_z),
    )


def _rolling(
    model: Model, travel: Travel | None, block: int, road: Any
) -> tuple[Vector, Vector, Vector, Vector | None]:
    """Travel of the wheel, height that a smooth tire sees, its rate, and impulses of the road."""
    timing, geometry = model.timing, model.tire_geometry
    steps = timing.intervals * timing.segments
    if geometry is None or travel is None:
        zeros = numpy.zeros(steps + 1)
        return zeros, zeros, zeros, None
    _check_road(geometry, block, road)
    places, speeds = travel.along(_ends(model, block))
    smooth, slopes = numpy.empty(steps + 1), numpy.empty(steps + 1)
    inside = effective_heights(
        road.height, road.first_row, geometry.lattice.cell_x, geometry.weights, places, smooth, slopes
    )
    if not inside:
        raise RunError(
            f"{ROAD}: block {block} does not reach over the footprint from {places[0]:.6g} to {places[-1]:.6g} m"
        )
    push = None if model.asperities is None else asperity_push(model.asperities, geometry, road, places)
    return places, smooth, slopes * speeds, push


def rate_at_start(model: Model, travel: Travel | None, road: Any, rate: float, time: float) -> float:
    """Vertical speed [m/s] with which the whole rig begins at a ``time`` [s]: that of the road under the tire
    as far as the road goes on so (decision 0034).

    The smaller of ``rate`` [m/s], that of the height which a smooth tire sees, and the mean one: of the line
    through those heights over the travel of `AHEAD`, by least squares. 0 where they differ in sign, and
    where the ``road`` does not reach as far, as behind its first block. Of an axle that is held 0.
    """
    geometry, machine = model.tire_geometry, model.machine
    if geometry is None or travel is None or rate == 0.0 or (machine is not None and machine.is_held):
        return 0.0
    start, end = travel.position(time), travel.position(time + AHEAD)
    places = numpy.linspace(start, end, PLACES_AHEAD, dtype=numpy.float64)
    heights, slopes = numpy.empty(PLACES_AHEAD), numpy.empty(PLACES_AHEAD)
    if start == end or not effective_heights(
        road.height, road.first_row, geometry.lattice.cell_x, geometry.weights, places, heights, slopes
    ):
        return 0.0
    way = places - places.mean()
    mean = float(way @ heights / (way @ way)) * travel.speed(time)
    return max(0.0, min(rate, mean)) if rate > 0.0 else min(0.0, max(rate, mean))


def _check_road(geometry: TireGeometry, block: int, road: Any) -> None:
    lattice = geometry.lattice
    if road is None or road.block != block:
        raise RunError(f"{ROAD}: block {block} was due, {'none' if road is None else f'block {road.block}'} came")
    if road.height.shape[1] != lattice.road_cols or abs(road.cell_x / lattice.cell_x - 1.0) > 1e-12:
        raise RunError(
            f"{ROAD}: block {block} has {road.height.shape[1]} columns and cells of {road.cell_x} m, the scene needs "
            f"{lattice.road_cols} columns and cells of {lattice.cell_x} m"
        )
    if not numpy.isfinite(road.height).all():
        row, col = (int(index) for index in numpy.argwhere(~numpy.isfinite(road.height))[0])
        raise RunError(
            f"{ROAD}: block {block} has the height {road.height[row, col]} at row {row}, column {col}; it must be finite"
        )
