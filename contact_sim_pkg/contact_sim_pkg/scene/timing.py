"""How the blocks of a resolved scene are cut in time."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene


@dataclass(frozen=True)
class Timing:
    """How a block is cut: blocks into intervals (field instants), intervals into segments (linear
    drive) and samples.
    """

    block_length: float  # [s]
    blocks: int
    intervals: int  # a block
    segments: int  # an interval
    sample_every: int  # segments a sample of the forces
    vibration_stride: int  # segments a sample of the vibration
    displays: int  # wrenches a block

    @property
    def segment_length(self) -> float:
        """Length of a segment in [s]."""
        return self.block_length / (self.intervals * self.segments)

    @property
    def samples(self) -> int:
        """Samples of the forces in a block."""
        return self.intervals * self.segments // self.sample_every


def make_timing(scene: ResolvedScene, with_field: bool, parts: int = 1) -> Timing:
    """Cut of a block into segments, at least ``parts`` a sample of the forces; the loader has
    checked that every rate fits it.
    """
    length, outputs, shaken = scene.block_length, scene.outputs, scene.vibration
    samples = round(length * outputs.force_rate)
    intervals = round(length * outputs.field_rate) if with_field else 1
    vibration = 1 if shaken is None else round(length * shaken.sample_rate)
    segments = math.lcm(samples * parts, intervals, vibration)
    return Timing(
        length,
        round(scene.duration / length),
        intervals,
        segments // intervals,
        segments // samples,
        segments // vibration,
        round(length * outputs.display_rate),
    )
