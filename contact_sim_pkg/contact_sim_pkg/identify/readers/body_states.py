"""States of a rigid body from a bag: ours (`bench/motion`), or anyone's with Odometry, or
PoseStamped and TwistStamped.

The twist of an Odometry is in body
axes, as its definition says; that of a TwistStamped is in the frame that its header names
(`identify/readers/axes.py`, `identify/readers/axes.py`).
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy

from contact_sim_pkg.bag.encoding import SECOND
from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.messages import decode, stamp_of
from contact_sim_pkg.bag.reader import Bag, open_bag
from contact_sim_pkg.identify.motion.rotation import exponential, from_quaternion
from contact_sim_pkg.identify.motion.states import BodyStates
from contact_sim_pkg.identify.readers.axes import Axes, pairs_of, reading_of_odometry, reading_of_twists
from contact_sim_pkg.identify.readers.stamped import Array, all_messages, chosen, one_a_stamp, stamp, vectors
from contact_sim_pkg.records.messages import BodyMotion

__all__ = ["ODOMETRY", "POSE", "TWIST", "RecordedStates", "bench_states", "read_body_states"]

ODOMETRY, POSE = "nav_msgs/msg/Odometry", "geometry_msgs/msg/PoseStamped"
TWIST = "geometry_msgs/msg/TwistStamped"
MOTION = "bench/motion"
NORM = 0.01  # allowed difference of a quaternion's length from 1


class RecordedStates(NamedTuple):
    """States, their time counted from the first sample: a float holds seconds since 1970 to 1e-7
    only.
    """

    states: BodyStates
    origin: int  # [ns], stamp of the first sample
    notes: tuple[str, ...] = ()  # what of the bag could not be read, one line each
    reading: tuple[str, ...] = ()  # how the rest was read, one line each
    frame: str = ""  # of the poses, as their header names it


def read_body_states(
    path: Path, topic: str | None = None, twist_topic: str | None = None, twist_axes: Axes = "auto"
) -> RecordedStates:
    """States of the body in world axes.

    Args:
        path: directory or file of the bag. topic: of Odometry or PoseStamped; the only one of its
        kind where it is None, or `bench/motion` of a bag of ours. twist_topic: of TwistStamped; the
        only one where it is None. twist_axes: of the twist; `auto`: by the definition of the
        message; `reading` reports the choice.

    Raises:
        BagError: no bag, no such topic, several to choose from, or stamps that do not fit.
    """
    bag = open_bag(path, skip_bad=True)
    if MOTION in bag and topic in (None, MOTION, f"/{MOTION}"):
        return bench_states(bag)
    if not bag.topics:
        raise BagError(f"of the bag {path} nothing can be read: {'; '.join(bag.notes) or 'it is empty'}")
    return _foreign(bag, topic, twist_topic, twist_axes)


def bench_states(bag: Bag) -> RecordedStates:
    """States from `bench/motion`: coordinates that end in x, z and pitch (plane), or x, y, z and
    rotation_x, _y, _z.

    Pitch is the angle about y; rotation_x to _z are a rotation vector, body to world, whose
    velocity is the angular velocity in world axes.
    """
    bag.refuse_other_definition(MOTION)
    blocks = [(message.data, decode(BodyMotion, message.data)) for message in bag.messages(MOTION)]
    if not blocks:
        raise BagError(f"{bag.path} holds no message on {MOTION}")
    names = blocks[0][1].bodies
    rows = _coordinates(names, bag.path)
    origin = stamp_of(blocks[0][0])
    time = numpy.concatenate(
        [
            (stamp_of(data) - origin) / SECOND + block.sample_period * numpy.arange(block.position.shape[1])
            for data, block in blocks
        ]
    )
    position = numpy.concatenate([block.position for _, block in blocks], axis=1)
    velocity = numpy.concatenate([block.velocity for _, block in blocks], axis=1)
    place, turn = _spread(position, rows[:3]), _spread(position, rows[3:])
    kept = numpy.concatenate(
        [[True], numpy.diff(time) > 0.0]
    )  # the last sample of a block may be the first of the next
    states = BodyStates(time, place, exponential(turn), _spread(velocity, rows[:3]), _spread(velocity, rows[3:]))
    kept_states = BodyStates(*(field[kept] for field in states))
    read = f"the velocities of {MOTION} are in world axes"
    frame = next(message.header.frame_id for _, message in bag.decoded(MOTION))
    return RecordedStates(kept_states, origin, tuple(bag.notes), (read,), frame)


def _coordinates(names: tuple[str, ...], path: Path) -> list[int | None]:
    """Rows of x, y, z and of the rotation about x, y, z; None where the body does not move."""
    tails = {
        "x": ("_x",), "y": ("_y",), "z": ("_z",), "rx": ("_rotation_x", "_roll"), "ry": ("_rotation_y", "_pitch"),
        "rz": ("_rotation_z", "_yaw"),
    }  # fmt: skip
    turning = tails["rx"] + tails["ry"] + tails["rz"]
    found: list[int | None] = []
    for key, ends in tails.items():
        rows = [
            row for row, name in enumerate(names)
            if name.endswith(ends) and (len(key) == 2 or not name.endswith(turning))
        ]  # fmt: skip
        if len(rows) > 1:
            raise BagError(
                f"{MOTION} of {path} moves more than one body ({', '.join(names)}); identify needs a single one"
            )
        found.append(rows[0] if rows else None)
    if found[0] is None or found[2] is None or found[4] is None:
        raise BagError(
            f"{MOTION} of {path} holds {', '.join(names)}, which is no rigid body: it needs x, z and a rotation"
        )
    return found


def _spread(values: Array, rows: list[int | None]) -> Array:
    """Rows of coordinates as vectors [n, 3]; zero where there is no row."""
    columns = [numpy.zeros(values.shape[1]) if row is None else values[row] for row in rows]
    return numpy.stack(columns, axis=1)


def _foreign(bag: Bag, topic: str | None, twist_topic: str | None, twist_axes: Axes) -> RecordedStates:
    name = chosen(bag, topic, (ODOMETRY, POSE), "--topic")
    messages = all_messages(bag, name)
    time = [stamp(message) for message in messages]
    alone: tuple[str, ...] = ()
    if bag.topics[name].type == ODOMETRY:
        poses, twists = [message.pose.pose for message in messages], [message.twist.twist for message in messages]
        reading = reading_of_odometry(messages[0], name, twist_axes)
    else:
        poses = [message.pose for message in messages]
        twist_name = chosen(bag, twist_topic, (TWIST,), "--twist-topic")
        other = all_messages(bag, twist_name)
        # A pose and a twist of one stamp make a state
        pairs, alone = pairs_of(time, [stamp(message) for message in other], (name, twist_name))
        time, poses = [time[first] for first, _ in pairs], [poses[first] for first, _ in pairs]
        twists = [other[second].twist for _, second in pairs]
        reading = reading_of_twists(messages[0], other[0], twist_name, twist_axes)
    found = _states(time, poses, twists, reading.body, name)
    return found._replace(
        notes=(*bag.notes, *found.notes), reading=(reading.note, *alone), frame=messages[0].header.frame_id
    )


def _states(time: list[int], poses: list[Any], twists: list[Any], turning: bool, topic: str) -> RecordedStates:
    """Poses and twists as states; a twist in body axes is turned into world axes."""
    order = numpy.argsort(numpy.array(time), kind="stable")
    seconds = (numpy.array(time, dtype=numpy.int64)[order] - min(time)) / SECOND
    quaternions = numpy.array([[getattr(pose.orientation, name) for name in "wxyz"] for pose in poses])[order]
    lengths = numpy.linalg.norm(quaternions, axis=1)
    if not (abs(lengths - 1.0) < NORM).all():
        place = int(abs(lengths - 1.0).argmax())
        raise BagError(
            f"the orientation of sample {place} of {topic} has the length {lengths[place]:.4g}; allowed: 1 (within {NORM:g})"
        )
    rotation = from_quaternion(quaternions)
    velocity = vectors([twist.linear for twist in twists])[order]
    spin = vectors([twist.angular for twist in twists])[order]
    if turning:
        velocity, spin = (numpy.einsum("nij,nj->ni", rotation, each) for each in (velocity, spin))
    position = vectors([pose.position for pose in poses])[order]
    states, note = one_a_stamp(BodyStates(seconds, position, rotation, velocity, spin), topic)
    return RecordedStates(states, min(time), note)
