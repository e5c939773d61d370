"""In which axes the vectors of a topic are, the world's or the body's, and why; both are reported
with the result.

A header names the frame of its vectors. One rule for twists and wrenches: that of the poses is the
world; any other is taken as the body's, and so is an empty one beside poses that name theirs, since
what is measured on a body is in its axes: a guess, reported as one.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

__all__ = ["Axes", "AxesChoice", "Subject", "reading", "reading_as_requested", "reading_of_frames"]

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
