"""Whether the excitation of a bag is the one that its scene makes, and whether a finer lattice
carries the same road.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.excitation.blocks import Surface
from contact_sim_pkg.records.messages import RoadPatch, VibrationBlock
from contact_sim_pkg.run.block_simulation import InputBlock
from contact_sim_pkg.run.sources import Source

__all__ = ["foreign_topics", "other_road"]

ROUNDING = 2e-7
"""Of the largest height: two roads that agree to float32."""


def foreign_topics(recorded: Mapping[str, Source], made: Mapping[str, Source], blocks: Iterable[int]) -> list[str]:
    """Topics whose recorded blocks are not those that the scene's own sources make."""
    looked = list(blocks)
    return [
        topic
        for topic, source in recorded.items()
        if topic not in made or not all(_equal(source.block(block), made[topic].block(block)) for block in looked)
    ]


def other_road(coarse: Source, surface: Surface, blocks: Iterable[int]) -> float:
    """Largest difference [m], beyond rounding, of recorded or made heights from a ``surface`` that
    was made for a finer lattice, at the nodes of the coarser; 0 where they agree.
    """
    largest = 0.0
    for block in blocks:
        patch = coarse.block(block)
        assert isinstance(patch, RoadPatch)
        difference = float(numpy.abs(surface.heights(*_nodes(patch)).astype(numpy.float32) - patch.height).max())
        if difference > ROUNDING * float(numpy.abs(patch.height).max(initial=0.0)):
            largest = max(largest, difference)
    return largest


def _nodes(patch: RoadPatch) -> tuple[Vector, Vector]:
    """Places along and across the road [m] of the nodes of a patch."""
    rows, cols = patch.height.shape
    along = (patch.first_row + numpy.arange(rows)) * patch.cell_x
    across = (numpy.arange(cols) - 0.5 * (cols - 1)) * patch.cell_y
    return numpy.asarray(along, dtype=numpy.float64), numpy.asarray(across, dtype=numpy.float64)


def _equal(first: InputBlock, second: InputBlock) -> bool:
    if isinstance(first, RoadPatch) and isinstance(second, RoadPatch):
        return first.first_row == second.first_row and numpy.array_equal(first.height, second.height)
    if isinstance(first, VibrationBlock) and isinstance(second, VibrationBlock):
        return numpy.array_equal(first.acceleration_z, second.acceleration_z) and numpy.array_equal(
            first.acceleration_x, second.acceleration_x
        )
    return False
