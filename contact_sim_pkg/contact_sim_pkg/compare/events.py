"""Spans of a scene round its own events, which follow from the scene and its excitation alone: the
same blocks on every machine, whatever else runs there.

* road: passage of its steepest obstacle, with what follows; of a road that is rough throughout its
  steepest place,
* slip or torque that the scene prescribes: where it is largest,
* vibration: its largest acceleration, with periods enough of an occupant at 4 Hz.

A rig that begins nowhere but at the start runs from there, all of the scene, or as much as its work
lets it (`MOST_WORK`), which is estimated from the scene.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import takewhile
from typing import NamedTuple

from contact_sim_pkg.compare.span import Span, begins_later
from contact_sim_pkg.compare.windows import LEAD, LENGTH, size_of, span_round
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.run.sources import Source
from contact_sim_pkg.run.work import estimated_work
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["EventSpan", "event_spans", "whole_run"]

ROAD = "road/patch"
QUIET = 0.01
"""Of the largest slope: a road with no more in half of its blocks, or more, is even beside its
obstacles."""
MOST_LOOKS = 3000
"""Blocks of the excitation that are looked at, at most: all of half a minute."""
PASSAGE = 0.6  # [s] of the passage of an obstacle, at most
SHAKEN, SHAKEN_LEAD = 2.0, 1.0  # [s] round the largest acceleration, and from standstill to it
SUDDEN = 2.0
"""Largest over median acceleration of a block, from which on it is an event beside a road."""
AS_LARGE = 0.99
MOST_WORK = 10.0  # [s] of computing on a usual machine, of a run from the start


class EventSpan(NamedTuple):
    """Blocks round an event."""

    span: Span
    reason: str


def event_spans(scene: ResolvedScene, sources: Mapping[str, Source]) -> list[EventSpan]:
    """Spans of a resolved scene in order of time; those that overlap are one."""
    blocks = max(1, scene.blocks)
    if not begins_later(scene):
        return [whole_run(scene)]
    found: list[EventSpan] = []
    for each in sorted(_spans(scene, sources, blocks), key=lambda each: each.span.shown):
        if found and each.span.first < found[-1].span.end:
            last = found.pop()
            span = last.span._replace(end=max(last.span.end, each.span.end))
            each = EventSpan(span, ", ".join(dict.fromkeys((last.reason, each.reason))))
        found.append(each)
    return found or [whole_run(scene)]


def whole_run(scene: ResolvedScene) -> EventSpan:
    """A scene from its start, as much of it as its work lets it."""
    blocks = max(1, scene.blocks)
    work = sum(part.seconds for part in estimated_work(scene))
    end = min(blocks, max(1, int(blocks * MOST_WORK / work))) if work > 0.0 else blocks
    return EventSpan(Span(0, 0, end), "the whole run" if end == blocks else "from the start")


def _spans(scene: ResolvedScene, sources: Mapping[str, Source], blocks: int) -> Iterator[EventSpan]:
    for topic, source in sources.items():
        looked = range(0, blocks, max(1, -(-blocks // MOST_LOOKS)))
        sizes = [size_of(source.block(block)) for block in looked]
        place = _largest(sizes)
        if topic == ROAD:
            first, last = _passage(sizes, place)
            middle, length = looked[first] + (looked[last] - looked[first]) // 2, looked[last] - looked[first]
            seconds = min(PASSAGE, length * scene.block_length) + LENGTH
            steepest = "steepest place of the road" if first == last else "passage of the obstacle"
            reason = steepest if sizes[place] > 0.0 else "even road"
            yield EventSpan(span_round(scene, middle, blocks, seconds, LEAD), reason)
        elif ROAD not in sources:
            yield EventSpan(span_round(scene, looked[place], blocks, SHAKEN, SHAKEN_LEAD), "largest acceleration")
        elif sizes[place] > SUDDEN * sorted(sizes)[len(sizes) // 2]:
            yield EventSpan(span_round(scene, looked[place], blocks, LENGTH, LEAD), "largest acceleration")
    named = rigs()[scene.rig].events
    for reason, time in load(named)(scene) if named else ():
        block = min(blocks - 1, max(0, round(time / scene.block_length)))
        yield EventSpan(span_round(scene, block, blocks, LENGTH, LEAD), reason)


def _largest(sizes: Sequence[float]) -> int:
    """The middle one of the largest: a steady excitation is looked at in the middle of the run."""
    largest = max(sizes)
    found = [place for place, size in enumerate(sizes) if size >= AS_LARGE * largest]
    return found[len(found) // 2]


def _passage(sizes: Sequence[float], place: int) -> tuple[int, int]:
    """First and last of the looks in which the obstacle at the steepest ``place`` is passed; the
    place itself where the road is rough throughout.
    """
    least = QUIET * sizes[place]
    if sorted(sizes)[len(sizes) // 2] > least or not sizes[place] > 0.0:
        return place, place
    before = sum(1 for _ in takewhile(lambda size: size > least, reversed(sizes[:place])))
    behind = sum(1 for _ in takewhile(lambda size: size > least, sizes[place + 1 :]))
    return place - before, place + behind
