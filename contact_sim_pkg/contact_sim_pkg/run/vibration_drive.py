"""Accelerations of a vibration block at the ends of a rig's segments."""

from __future__ import annotations

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.messages import RoadPatch, VibrationBlock
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.scene.timing import Timing

VIBRATION = "platform/vibration"


def accelerations(timing: Timing, block: int, vibration: RoadPatch | VibrationBlock | None) -> tuple[Vector, Vector]:
    """Forward and upward acceleration [m/s^2], each [points], at the ends of the segments of a
    block; linear between the samples.

    Raises RunError where the block is missing, another one, or of another length.
    """
    points = timing.intervals * timing.segments + 1
    samples = (points - 1) // timing.vibration_stride + 1
    if not isinstance(vibration, VibrationBlock):
        raise RunError(f"{VIBRATION}: block {block} with {samples} samples was due, none came")
    if vibration.block != block or len(vibration.acceleration_x) != samples:
        found = f"block {vibration.block} with {len(vibration.acceleration_x)} samples"
        raise RunError(f"{VIBRATION}: block {block} with {samples} samples was due, {found} came")
    position, index = numpy.arange(points) / timing.vibration_stride, numpy.arange(samples)
    forward, upward = vibration.acceleration_x, vibration.acceleration_z
    return numpy.interp(position, index, forward), numpy.interp(position, index, upward)
