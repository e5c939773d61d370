"""Which twist belongs to which pose, and in which axes it is; both are told to the person who reads the result."""

from __future__ import annotations

from typing import Any, Literal, NamedTuple

import numpy

from .errors import BagError

__all__ = ["Pairs", "Reading", "TwistAxes", "pairs_of", "reading_of_odometry", "reading_of_twists"]

TwistAxes = Literal["auto", "world", "body"]

SAME = 1_000  # [ns] between the stamps of a pose and of its twist
FEWEST = 0.5  # share of the poses that must have a twist


class Reading(NamedTuple):
    """Axes in which the twist of a topic is read."""

    body: bool
    note: str  # which, and why


class Pairs(NamedTuple):
    """Poses and twists of the same stamp."""

    places: list[tuple[int, int]]  # of pose and twist
    notes: tuple[str, ...]  # one where messages of either found no partner


def reading_of_odometry(message: Any, topic: str, asked: TwistAxes) -> Reading:
    """By its definition the twist of an Odometry is in the frame of its child_frame_id; world if that is frame_id."""
    frame, child = message.header.frame_id, message.child_frame_id
    if asked != "auto":
        return _asked(topic, asked)
    if frame and child == frame:
        return _reading(topic, False, f"its child_frame_id is its frame_id, {frame!r}")
    if child:
        return _reading(topic, True, f"an Odometry has it in the frame of its child_frame_id, {child!r}")
    return _reading(topic, True, "an Odometry has it in the frame of its child; its child_frame_id is empty")


def reading_of_twists(pose: Any, twist: Any, topic: str, asked: TwistAxes) -> Reading:
    """The twist of a TwistStamped is in the frame of its header; the body's, unless it is that of the poses."""
    poses, own = pose.header.frame_id, twist.header.frame_id
    if asked != "auto":
        return _asked(topic, asked)
    if own == poses:
        return _reading(topic, False, f"its frame_id is that of the poses, {poses!r}")
    if not own:
        return _reading(topic, True, f"a guess, since its frame_id is empty and that of the poses is {poses!r}")
    return _reading(
        topic, True, f"its frame_id {own!r} is not that of the poses, {poses!r}, and is taken as the body's"
    )


def _asked(topic: str, asked: TwistAxes) -> Reading:
    return Reading(asked == "body", f"the twist of {topic} is read in {asked} axes: --twist-axes {asked}")


def _reading(topic: str, body: bool, why: str) -> Reading:
    axes, other = ("body", "world") if body else ("world", "body")
    return Reading(body, f"the twist of {topic} is read in {axes} axes: {why}; if it is not so: --twist-axes {other}")


def pairs_of(poses: list[int], twists: list[int], topics: tuple[str, str]) -> Pairs:
    """Places of poses and twists of the same stamp [ns], in the order of the poses.

    Raises:
        BagError: less than half of the poses have a twist.
    """
    partners = _partners(poses, twists)
    places = [(place, other) for place, other in enumerate(partners) if other is not None]
    if len(places) < FEWEST * len(poses):
        raise BagError(
            f"of {len(poses)} poses on {topics[0]} only {len(places)} have a twist of the same stamp (within 1 us); record both "
            "with one stamp, or use Odometry"
        )
    alone = len(poses) - len(places), _partners(twists, poses).count(None)
    note = (
        f"{alone[0]} of {len(poses)} poses on {topics[0]} have no twist of the same stamp (within 1 us), and {alone[1]} of "
        f"{len(twists)} twists on {topics[1]} no pose: they are left out"
    )
    return Pairs(places, (note,) if any(alone) else ())


def _partners(stamps: list[int], others: list[int]) -> list[int | None]:
    """For each stamp the place of the first other one that is the same, None where there is none."""
    order = numpy.argsort(numpy.array(others), kind="stable")
    ordered = numpy.array(others)[order]
    near = numpy.clip(numpy.searchsorted(ordered, numpy.array(stamps) - SAME), 0, len(ordered) - 1)
    same = abs(ordered[near] - numpy.array(stamps)) <= SAME
    return [int(order[place]) if fits else None for place, fits in zip(near, same, strict=True)]
