"""Encoded excitation blocks of a scene with blocks of 10 ms."""

import numpy

from contact_sim_pkg.bag.messages import encode_road_patch, encode_vibration
from contact_sim_pkg.excitation.blocks import RoadPatch, VibrationBlock

LENGTH = 10_000_000  # [ns]


def vibration(
    block: int, *, stamp: int | None = None, value: float = 1.0, samples: int = 11, period: float = 1e-3
) -> bytes:
    acceleration = numpy.full(samples, value)
    return encode_vibration(
        VibrationBlock(block, period, acceleration, acceleration), block * LENGTH if stamp is None else stamp
    )


def road(block: int, *, height: float = 0.0) -> bytes:
    heights = numpy.full((4, 3), height, dtype=numpy.float32)
    return encode_road_patch(RoadPatch(block, 0.1 * block, 0.1 * (block + 1), -1, 0.01, 0.01, heights), block * LENGTH)
