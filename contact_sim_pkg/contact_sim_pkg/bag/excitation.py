"""Blocks of the excitation, received on a topic or from a bag: one that cannot drive a rig is
refused. Nothing is clamped.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.records.messages import RoadPatch, VibrationBlock

Block = RoadPatch | VibrationBlock
FEWEST_SAMPLES = 2
LARGEST_HEIGHT = 1.0e3  # [m]
LARGEST_ACCELERATION = 1.0e4  # [m/s^2]


def decode_road(data: bytes) -> RoadPatch:
    """A block of road, heights [m] as [rows, cols]; MessageError where its grid does not fit, a
    spacing is not above 0, a value not finite or a height beyond `LARGEST_HEIGHT`.
    """
    patch = decode(RoadPatch, data)
    for name in ("travel_start", "travel_end", "height"):
        _refuse_not_finite(patch, name)
    for name in ("cell_x", "cell_y"):
        _refuse_not_above_zero(patch, name)
    _within("height", patch.block, patch.height, LARGEST_HEIGHT, "m")
    return patch


def decode_vibration(data: bytes) -> VibrationBlock:
    """A block of vibration, in [m/s^2]; MessageError where samples and arrays disagree, or a value
    is not finite or beyond `LARGEST_ACCELERATION`.
    """
    vibration = decode(VibrationBlock, data)
    samples = len(vibration.acceleration_x)
    if samples < FEWEST_SAMPLES:
        raise MessageError(
            f"block {vibration.block} of VibrationBlock has {samples} samples; allowed: from {FEWEST_SAMPLES} samples"
        )
    for name in ("acceleration_x", "acceleration_z"):
        _refuse_not_finite(vibration, name)
        _within(name, vibration.block, getattr(vibration, name), LARGEST_ACCELERATION, "m/s^2")
    _refuse_not_above_zero(vibration, "sample_period")
    return vibration


DECODERS: dict[str, Callable[[bytes], Block]] = {"road/patch": decode_road, "platform/vibration": decode_vibration}
"""Topic of the excitation -> what reads its blocks."""


def _refuse_not_finite(block: Block, name: str) -> None:
    """MessageError with the number of values that are not finite, and the place of the first."""
    value: Any = getattr(block, name)
    if not numpy.isfinite(value).all():
        bad = numpy.argwhere(~numpy.isfinite(value))
        where = ("", ", the first at number {}", ", the first at row {}, column {}")[bad.shape[1]].format(*bad[0])
        raise MessageError(
            f"{name} of {type(block).__name__}, block {block.block}, has {len(bad)} value(s) that are NaN or infinite{where}"
        )


def _within(name: str, block: int, values: NDArray[numpy.floating], bound: float, unit: str) -> None:
    largest = float(numpy.abs(values).max(initial=0.0))
    if largest > bound:
        raise MessageError(f"{name} of block {block} reaches {largest:.6g} {unit}; allowed: up to {bound:.6g} {unit}")


def _refuse_not_above_zero(block: Block, name: str) -> None:
    value = getattr(block, name)
    if not 0.0 < value < float("inf"):
        raise MessageError(
            f"{name} of {type(block).__name__}, block {block.block}, is {value}; it must be above 0 and finite"
        )
