"""Messages of the excitation: a block of road, a block of vibration."""

import numpy

from contact_sim_pkg.bag.encoding import (
    above_zero,
    deserialize,
    equal_lengths,
    finite,
    float32s,
    float64s,
    grid,
    header,
    serialize,
)
from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.bag.messages.frames import BENCH_FRAME
from contact_sim_pkg.excitation.blocks import RoadPatch, VibrationBlock

_ROAD = "contact_msgs_defs/msg/RoadPatch"
_VIBRATION = "contact_msgs_defs/msg/VibrationBlock"


def encode_road_patch(value: RoadPatch, stamp_ns: int, frame_id: str = BENCH_FRAME) -> bytes:
    """One block of road; rows and cols are the shape of `height`."""
    rows, cols = value.height.shape
    return serialize(
        _ROAD, header(stamp_ns, frame_id), *value[:4], rows, cols, value.cell_x, value.cell_y, float32s(value.height)
    )


def decode_road_patch(data: bytes) -> RoadPatch:
    """One block of road; MessageError where the grid does not fit, a spacing is not above 0 or a value not finite."""
    message = deserialize(_ROAD, data)
    height = grid(_ROAD, message.block, message.rows, message.cols, message.height)
    finite(_ROAD, message.block, travel_start=message.travel_start, travel_end=message.travel_end, height=height)
    above_zero(_ROAD, message.block, cell_x=message.cell_x, cell_y=message.cell_y)
    travel = (message.travel_start, message.travel_end)
    return RoadPatch(message.block, *travel, message.first_row, message.cell_x, message.cell_y, height)


def encode_vibration(value: VibrationBlock, stamp_ns: int, frame_id: str = BENCH_FRAME) -> bytes:
    """One block of vibration; `samples` is the length of its arrays."""
    x, z = float64s(value.acceleration_x), float64s(value.acceleration_z)
    equal_lengths(_VIBRATION, acceleration_x=x, acceleration_z=z)
    return serialize(_VIBRATION, header(stamp_ns, frame_id), value.block, value.sample_period, len(x), x, z)


def decode_vibration(data: bytes) -> VibrationBlock:
    """One block of vibration; MessageError where samples and arrays disagree, or a value is not finite."""
    message = deserialize(_VIBRATION, data)
    x, z = numpy.array(message.acceleration_x), numpy.array(message.acceleration_z)
    if not len(x) == len(z) == message.samples or len(x) < 2:
        raise MessageError(
            f"block {message.block} of {_VIBRATION} has {len(x)} and {len(z)} values for {message.samples} samples; "
            "allowed: one value a sample, from 2 samples"
        )
    finite(_VIBRATION, message.block, acceleration_x=x, acceleration_z=z)
    above_zero(_VIBRATION, message.block, sample_period=message.sample_period)
    return VibrationBlock(message.block, message.sample_period, x, z)
