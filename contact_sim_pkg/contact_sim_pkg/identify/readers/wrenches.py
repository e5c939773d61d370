"""A known wrench on the body, from WrenchStamped messages beside its poses, in world axes.

A wrench in body axes is turned by the rotation of the poses: between its samples it goes along
straight lines in the axes in which it was recorded, and is turned at each of its stamps and at each
pose within its time.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy
from scipy.spatial.transform import Rotation, Slerp

from contact_sim_pkg.bag.encoding import SECOND
from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import Bag, open_bag
from contact_sim_pkg.identify.motion.states import BodyStates
from contact_sim_pkg.identify.readers.axes import Axes, Subject, reading_of_frames
from contact_sim_pkg.identify.readers.body_states import RecordedStates
from contact_sim_pkg.identify.readers.stamped import (
    Array,
    WrenchSamples,
    all_messages,
    chosen,
    one_a_stamp,
    stamp,
    vectors,
)

__all__ = ["WRENCH", "RecordedWrench", "read_wrench"]

WRENCH = "geometry_msgs/msg/WrenchStamped"


class RecordedWrench(NamedTuple):
    """A wrench, its time counted as that of the states."""

    samples: WrenchSamples
    notes: tuple[str, ...]  # what of the topic is not used, one line each
    reading: str  # in which axes it was read, and why


def read_wrench(path: Path, topic: str, recorded: RecordedStates, axes: Axes = "auto") -> RecordedWrench:
    """The wrench of a topic of the bag that holds the states.

    Args:
        path: of the bag. topic: of WrenchStamped. recorded: the states. axes: of the wrench;
        `auto`: by the frames that the headers name (`identify/readers/axes.py`).

    Raises:
        BagError: no such topic, no message, stamps that do not fit, or a wrench in body axes at no
        time of the poses.
    """
    return _read(open_bag(path, skip_bad=True), topic, recorded, axes)


def _read(bag: Bag, topic: str, recorded: RecordedStates, axes: Axes) -> RecordedWrench:
    name = chosen(bag, topic, (WRENCH,), "--force-topic")
    messages = sorted(all_messages(bag, name), key=stamp)
    time = (numpy.array([stamp(message) for message in messages], dtype=numpy.int64) - recorded.origin) / SECOND
    forces, torques = ([getattr(message.wrench, field) for message in messages] for field in ("force", "torque"))
    samples, notes = one_a_stamp(WrenchSamples(time, vectors(forces), vectors(torques)), name)
    subject = Subject("wrench", name, "--force-axes")
    reading = reading_of_frames(subject, messages[0].header.frame_id, recorded.frame, axes)
    if reading.body:
        samples = _turned(samples, recorded.states, name)
    return RecordedWrench(samples, notes, reading.note)


def _turned(samples: WrenchSamples, states: BodyStates, topic: str) -> WrenchSamples:
    """From body axes to world axes, over the time that wrench and poses have in common."""
    first, last = (max(samples.time[0], states.time[0]), min(samples.time[-1], states.time[-1]))
    if not first < last:
        raise BagError(
            f"the wrench of {topic} is known from {samples.time[0]:.6g} to {samples.time[-1]:.6g} s, the poses that would turn it "
            f"from body axes go from {states.time[0]:.6g} to {states.time[-1]:.6g} s; record both together"
        )
    instants = numpy.union1d(samples.time, states.time)
    instants = instants[(instants >= first) & (instants <= last)]
    turns = Slerp(states.time, Rotation.from_matrix(states.rotation))(instants)
    force, torque = (turns.apply(_straight(instants, samples.time, values)) for values in samples[1:])
    return WrenchSamples(instants, force, torque)


def _straight(instants: Array, time: Array, values: Array) -> Array:
    """Values [n, 3] at `time` [n] joined by straight lines, at `instants`."""
    return numpy.stack([numpy.interp(instants, time, column) for column in values.T], axis=1)
