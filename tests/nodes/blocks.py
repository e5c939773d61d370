"""Encoded excitation blocks of a scene with blocks of 10 ms."""

import numpy

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.records.messages import RoadPatch, VibrationBlock

LENGTH = 10_000_000  # [ns]


def vibration(
    block: int, *, stamp: int | None = None, value: float = 1.0, samples: int = 11, period: float = 1e-3
) -> bytes:
    acceleration = numpy.full(samples, value)
    return encode(
        VibrationBlock(block=block, sample_period=period, acceleration_x=acceleration, acceleration_z=acceleration),
        block * LENGTH if stamp is None else stamp,
    )


def road(block: int, *, height: float = 0.0) -> bytes:
    heights = numpy.full((4, 3), height, dtype=numpy.float32)
    return encode(
        RoadPatch(
            block=block,
            travel_start=0.1 * block,
            travel_end=0.1 * (block + 1),
            first_row=-1,
            cell_x=0.01,
            cell_y=0.01,
            height=heights,
        ),
        block * LENGTH,
    )
