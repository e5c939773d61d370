"""Whether the excitation of a bag is the one that its scene makes, and whether a finer lattice
carries the same road.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.messages import RoadPatch, VibrationBlock
from contact_sim_pkg.run.block_simulation import InputBlock
from contact_sim_pkg.run.sources import Source

Places = NDArray[numpy.int64]

__all__ = ["common_difference", "foreign_topics", "other_road"]

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


def other_road(coarse: Source, fine: Source, blocks: Iterable[int]) -> float:
    """Largest difference [m] of two lattices of a road at common nodes beyond rounding; 0 where
    they agree.
    """
    largest = 0.0
    for block in blocks:
        first, second = coarse.block(block), fine.block(block)
        assert isinstance(first, RoadPatch)
        assert isinstance(second, RoadPatch)
        found = common_difference(first, second)
        if found is not None and found > ROUNDING * float(numpy.abs(first.height).max(initial=0.0)):
            largest = max(largest, found)
    return largest


def common_difference(coarse: RoadPatch, fine: RoadPatch) -> float | None:
    """Largest difference [m] of the heights at nodes that both lattices have; None without such."""
    rows, rows_too = _common(_along(coarse), _along(fine), 1e-6 * fine.cell_x)
    cols, cols_too = _common(_across(coarse), _across(fine), 1e-6 * fine.cell_y)
    if not len(rows) or not len(cols):
        return None
    difference = coarse.height[numpy.ix_(rows, cols)].astype(float) - fine.height[numpy.ix_(rows_too, cols_too)]
    return float(numpy.abs(difference).max())


def _along(patch: RoadPatch) -> Vector:
    return numpy.asarray((patch.first_row + numpy.arange(patch.height.shape[0])) * patch.cell_x, dtype=numpy.float64)


def _across(patch: RoadPatch) -> Vector:
    cols = patch.height.shape[1]
    return numpy.asarray((numpy.arange(cols) - 0.5 * (cols - 1)) * patch.cell_y, dtype=numpy.float64)


def _common(first: Vector, second: Vector, within: float) -> tuple[Places, Places]:
    """Places in two rising series of values that are the same within a bound."""
    nearest = numpy.clip(numpy.searchsorted(second, first - within), 0, len(second) - 1)
    equal = numpy.abs(second[nearest] - first) <= within
    return numpy.flatnonzero(equal), nearest[equal]


def _equal(first: InputBlock, second: InputBlock) -> bool:
    if isinstance(first, RoadPatch) and isinstance(second, RoadPatch):
        return first.first_row == second.first_row and numpy.array_equal(first.height, second.height)
    if isinstance(first, VibrationBlock) and isinstance(second, VibrationBlock):
        return numpy.array_equal(first.acceleration_z, second.acceleration_z) and numpy.array_equal(
            first.acceleration_x, second.acceleration_x
        )
    return False
