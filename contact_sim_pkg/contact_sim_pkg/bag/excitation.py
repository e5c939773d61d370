"""Blocks of the excitation, received on a topic or from a bag: one that cannot drive a rig is
refused.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy

from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.records.messages import RoadPatch, VibrationBlock

Block = RoadPatch | VibrationBlock
FEWEST_SAMPLES = 2


def decode_road(data: bytes) -> RoadPatch:
    """A block of road; MessageError where its grid does not fit, a spacing is not above 0 or a
    value not finite.
    """
    patch = decode(RoadPatch, data)
    for name in ("travel_start", "travel_end", "height"):
        _refuse_not_finite(patch, name)
    for name in ("cell_x", "cell_y"):
        _refuse_not_above_zero(patch, name)
    return patch


def decode_vibration(data: bytes) -> VibrationBlock:
    """A block of vibration; MessageError where samples and arrays disagree, or a value is not
    finite.
    """
    vibration = decode(VibrationBlock, data)
    samples = len(vibration.acceleration_x)
    if samples < FEWEST_SAMPLES:
        raise MessageError(
            f"block {vibration.block} of VibrationBlock has {samples} samples; allowed: from {FEWEST_SAMPLES} samples"
        )
    for name in ("acceleration_x", "acceleration_z"):
        _refuse_not_finite(vibration, name)
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


def _refuse_not_above_zero(block: Block, name: str) -> None:
    value = getattr(block, name)
    if not 0.0 < value < float("inf"):
        raise MessageError(
            f"{name} of {type(block).__name__}, block {block.block}, is {value}; it must be above 0 and finite"
        )
