"""The part of the page on a rigid body over the ground."""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.report.drawing import Picture
from contact_sim_pkg.report.figures.contact import load_over_time
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.body.report.figures import impulses, modes, motion, way
from contact_sim_pkg.rigs.body.report.numbers import BLOCK
from contact_sim_pkg.rigs.body.report.pose import poses_of


class BlockPart(NamedTuple):
    """Pictures of one section."""

    key: str
    title: str
    pictures: list[Picture]


def block_parts(number: int, recording: Recording) -> list[BlockPart]:
    """Call inside `drawing.style()`; the way of the body is left out where the bag holds no scene."""
    contact = recording.contacts[BLOCK]
    pushed = [load_over_time(f"contact-{number}", BLOCK, contact), impulses(contact)]
    if recording.points is not None:
        pushed.insert(0, modes(recording.points))
    found = [BlockPart("contact", "Block contact", pushed)]
    if recording.motion is None or "block" not in recording.scene:
        return found
    poses = poses_of(recording.scene, recording.motion)
    return [BlockPart("way", "Way of the body", [way(poses), motion(poses)]), *found]
