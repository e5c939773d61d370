"""The part of the page on a rigid body over the ground."""

from __future__ import annotations

from contact_sim_pkg.report.figures.contact import contact_section, load_over_time
from contact_sim_pkg.report.page import Section
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.body.report.figures import impulses, modes, motion, way
from contact_sim_pkg.rigs.body.report.numbers import BLOCK
from contact_sim_pkg.rigs.body.report.pose import poses_of


def block_sections(number: int, recording: Recording) -> list[Section]:
    """Call inside `drawing.style()`; the way of the body is left out where the bag holds no
    scene.
    """
    if recording.motion is None:
        return [contact_section(number, BLOCK, recording)]
    contact = recording.contacts[BLOCK]
    pushed = [load_over_time(f"contact-{number}", BLOCK, contact), impulses(contact)]
    if recording.points is not None:
        pushed.insert(0, modes(recording.points))
    found = [Section("contact", "Block contact", pushed)]
    if "block" not in recording.scene:
        return found
    poses = poses_of(recording.scene, recording.motion)
    return [Section("way", "Way of the body", [way(poses), motion(poses)]), *found]
