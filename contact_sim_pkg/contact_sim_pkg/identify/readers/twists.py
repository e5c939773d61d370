"""Which twist belongs to which pose, and in which axes it is; both are reported with the result."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.identify.readers.axes import (
    Axes,
    AxesChoice,
    Subject,
    reading,
    reading_as_requested,
    reading_of_frames,
)

__all__ = ["Pairs", "pairs_of", "reading_of_odometry", "reading_of_twists"]

SAME = 1_000  # [ns] between the stamps of a pose and of its twist
FEWEST = 0.5  # share of the poses that must have a twist


class Pairs(NamedTuple):
    """Poses and twists of the same stamp."""

    places: list[tuple[int, int]]  # of pose and twist
    notes: tuple[str, ...]  # one where messages of either found no partner


def reading_of_odometry(message: Any, topic: str, requested: Axes) -> AxesChoice:
    """By its definition the twist of an Odometry is in the frame of its child_frame_id; world if
    that is frame_id.
    """
    frame, child, twist = message.header.frame_id, message.child_frame_id, _twist(topic)
    if requested != "auto":
        return reading_as_requested(twist, requested)
    if frame and child == frame:
        return reading(twist, False, f"its child_frame_id is its frame_id, {frame!r}")
    if child:
        return reading(twist, True, f"an Odometry has it in the frame of its child_frame_id, {child!r}")
    return reading(twist, True, "an Odometry has it in the frame of its child; its child_frame_id is empty")


def reading_of_twists(pose: Any, twist: Any, topic: str, requested: Axes) -> AxesChoice:
    """The twist of a TwistStamped is in the frame of its header."""
    return reading_of_frames(_twist(topic), twist.header.frame_id, pose.header.frame_id, requested)


def _twist(topic: str) -> Subject:
    return Subject("twist", topic, "--twist-axes")


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
    """For each stamp the place of the first other one that is the same, None where there is
    none.
    """
    order = numpy.argsort(numpy.array(others), kind="stable")
    ordered = numpy.array(others)[order]
    near = numpy.clip(numpy.searchsorted(ordered, numpy.array(stamps) - SAME), 0, len(ordered) - 1)
    same = abs(ordered[near] - numpy.array(stamps)) <= SAME
    return [int(order[place]) if fits else None for place, fits in zip(near, same, strict=True)]
