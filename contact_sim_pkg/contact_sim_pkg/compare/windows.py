"""Windows of a run in which its accuracy is checked: 0.2 s round the largest force, the largest
estimated error and the event of the excitation.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

import numpy

from contact_sim_pkg.compare.columns import Column, Key
from contact_sim_pkg.compare.span import Span
from contact_sim_pkg.records.messages import RoadPatch, SolverCost, VibrationBlock
from contact_sim_pkg.run.block_simulation import InputBlock
from contact_sim_pkg.run.sources import Source
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = [
    "LEAD",
    "LENGTH",
    "CheckWindow",
    "event_block",
    "from_the_start",
    "size_of",
    "span_round",
    "windows_of",
]

LENGTH = 0.2  # [s]
LEAD = 0.1  # [s] from standstill to the window
MOST_LOOKS = 400
"""Blocks of the excitation that are looked at for its event, at most."""
NANOSECONDS = 1_000_000_000


class CheckWindow(NamedTuple):
    """A span of a run, and why it is checked."""

    span: Span
    reasons: tuple[str, ...]


def windows_of(
    scene: ResolvedScene, columns: Mapping[Key, Column], costs: Sequence[SolverCost], sources: Mapping[str, Source],
    blocks: int,
) -> list[CheckWindow]:  # fmt: skip
    """Windows of a run of so many blocks, those of the same blocks as one, in order of time."""
    places = {"largest force": _largest_force(scene, columns)}
    if any(len(cost.estimated_error) for cost in costs):
        places["largest estimated error"] = max(costs, key=_estimated).block
    if sources:
        places["event of the excitation"] = event_block(sources, blocks)
    found: list[CheckWindow] = []
    for reason, place in sorted(places.items(), key=lambda item: item[1]):
        span = span_round(scene, place, blocks)
        if found and span.shown < found[-1].span.end:  # overlaps: one longer window
            last = found.pop()
            span, before = last.span._replace(end=span.end), last.reasons
            found.append(CheckWindow(span, (*before, reason)))
        else:
            found.append(CheckWindow(span, (reason,)))
    return found


def _estimated(cost: SolverCost) -> float:
    """Largest estimated error of a normal force [N] in a block."""
    pairs = zip(cost.estimated, cost.estimated_error, strict=True)
    return max((float(error) for name, error in pairs if name.endswith("force.normal")), default=0.0)


def span_round(
    scene: ResolvedScene, block: int, blocks: int, seconds: float = LENGTH, standstill: float = LEAD
) -> Span:
    """The window of so many ``seconds`` with a block in its middle, within a run of so many blocks,
    and its lead-in from ``standstill`` [s] before it.
    """
    length, lead = max(1, round(seconds / scene.block_length)), round(standstill / scene.block_length)
    shown = max(0, min(block - length // 2, blocks - length))
    return Span(max(0, shown - lead), shown, min(blocks, shown + length))


def from_the_start(windows: Iterable[CheckWindow]) -> list[CheckWindow]:
    """One window from the start of the run to the end of the last: for a rig that begins nowhere
    else.
    """
    windows = list(windows)
    end = max(window.span.end for window in windows)
    return [CheckWindow(Span(0, 0, end), ("from the start", *(each for window in windows for each in window.reasons)))]


def event_block(sources: Mapping[str, Source], blocks: int) -> int:
    """The block whose excitation is largest: the steepest road, else the largest acceleration."""
    source = sources.get("road/patch") or next(iter(sources.values()))
    looked = range(0, blocks, max(1, -(-blocks // MOST_LOOKS)))
    return max(looked, key=lambda block: size_of(source.block(block)))


def size_of(block: InputBlock) -> float:
    """Largest slope [1] under the wheel centre, or largest acceleration [m/s^2], of a block."""
    if isinstance(block, VibrationBlock):
        return float(max(numpy.abs(block.acceleration_x).max(), numpy.abs(block.acceleration_z).max()))
    assert isinstance(block, RoadPatch)
    first, last = sorted((block.travel_start, block.travel_end))
    low = max(0, int(first / block.cell_x) - block.first_row)
    high = max(low + 2, int(last / block.cell_x) - block.first_row + 2)
    return float(numpy.abs(numpy.diff(block.height[low:high], axis=0)).max(initial=0.0)) / block.cell_x


def _largest_force(scene: ResolvedScene, columns: Mapping[Key, Column]) -> int:
    """Block of the largest force component."""
    forces = [column for column in columns.values() if column.kind == "force" and len(column.values)]
    if not forces:
        return 0
    largest = max(forces, key=lambda column: float(numpy.abs(column.values).max()))
    instant = largest.instants[int(numpy.argmax(numpy.abs(largest.values)))]
    return int(instant) // round(scene.block_length * NANOSECONDS)
