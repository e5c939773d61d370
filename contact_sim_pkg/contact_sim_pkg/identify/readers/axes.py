"""In which axes the vectors of a topic are, the world's or the body's, and why; both are reported
with the result.

A header names the frame of its vectors. One rule for twists and wrenches: that of the poses is the
world; any other is taken as the body's, and so is an empty one beside poses that name theirs, since
what is measured on a body is in its axes: a guess, reported as one.

Which twist belongs to which pose, and in which axes it is; both are reported with the result.
"""

from __future__ import annotations

from typing import Any, Literal, NamedTuple

import numpy

from contact_sim_pkg.bag.errors import BagError

__all__ = [
    "Axes",
    "AxesChoice",
    "Pairs",
    "Subject",
    "pairs_of",
    "reading",
    "reading_as_requested",
    "reading_of_frames",
    "reading_of_odometry",
    "reading_of_twists",
]


Axes = Literal["auto", "world", "body"]


class Subject(NamedTuple):
    """What is read."""

    what: str
    topic: str
    option: str  # which overrides its axes


class AxesChoice(NamedTuple):
    """Axes in which the vectors of a topic are read."""

    body: bool
    note: str  # which, and why


def reading_of_frames(subject: Subject, own: str, poses: str, requested: Axes) -> AxesChoice:
    """By the frames that the headers of the vectors and of the poses name, unless axes are
    requested.
    """
    if requested != "auto":
        return reading_as_requested(subject, requested)
    if own == poses:
        return reading(subject, False, f"its frame_id is that of the poses, {poses!r}")
    if not own:
        return reading(subject, True, f"a guess, since its frame_id is empty and that of the poses is {poses!r}")
    return reading(
        subject, True, f"its frame_id {own!r} is not that of the poses, {poses!r}, and is taken as the body's"
    )


def reading_as_requested(subject: Subject, requested: Axes) -> AxesChoice:
    """In the axes that the option names."""
    what, topic, option = subject
    return AxesChoice(requested == "body", f"the {what} of {topic} is read in {requested} axes: {option} {requested}")


def reading(subject: Subject, body: bool, why: str) -> AxesChoice:
    """In body or world axes, with the option for who knows better."""
    what, topic, option = subject
    axes, other = ("body", "world") if body else ("world", "body")
    return AxesChoice(body, f"the {what} of {topic} is read in {axes} axes: {why}; if it is not so: {option} {other}")


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
