"""States of a rigid body from a bag: ours (`bench/motion`), or anyone's with Odometry, or PoseStamped and TwistStamped.

Foreign bags are read as `any_bag.py` says. The twist of an Odometry is in body axes, as its
definition says; that of a TwistStamped is in the frame that its header names (`twists.py`).
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.identification.rotation import exponential, from_quaternion
from contact_sim_pkg.identification.states import BodyStates

from .any_bag import AnyBag, use_bag
from .encoding import SECOND
from .errors import BagError
from .messages import decode_motion, stamp_of
from .reader import Bag, open_bag
from .twists import TwistAxes, pairs_of, reading_of_odometry, reading_of_twists

__all__ = [
    "ODOMETRY",
    "POSE",
    "TWIST",
    "WRENCH",
    "RecordedStates",
    "WrenchSamples",
    "bench_states",
    "read_body_states",
    "read_wrench",
]

Array = NDArray[numpy.float64]

ODOMETRY, POSE = "nav_msgs/msg/Odometry", "geometry_msgs/msg/PoseStamped"
TWIST, WRENCH = "geometry_msgs/msg/TwistStamped", "geometry_msgs/msg/WrenchStamped"
MOTION = "bench/motion"
FEWEST_STAMPS = 3  # messages a stamp in the mean, beyond which a topic is not stamped
NORM = 0.01  # allowed difference of a quaternion's length from 1
XYZ = "xyz"


class RecordedStates(NamedTuple):
    """States, their time counted from the first sample: a float holds seconds since 1970 to 1e-7 only."""

    states: BodyStates
    origin: int  # [ns], stamp of the first sample
    notes: tuple[str, ...] = ()  # what of the bag could not be read, one line each
    reading: tuple[str, ...] = ()  # how the rest was read, one line each


class WrenchSamples(NamedTuple):
    """A known wrench over time, in the axes of the pose's frame."""

    time: Array  # [n], [s]
    force: Array  # [n, 3], [N]
    torque: Array  # [n, 3], [N m]


def read_body_states(
    path: Path, topic: str | None = None, twist_topic: str | None = None, twist_axes: TwistAxes = "auto"
) -> RecordedStates:
    """States of the body in world axes.

    Args:
        path: directory or file of the bag.
        topic: of Odometry or PoseStamped; the only one of its kind where it is None, or `bench/motion` of a bag of ours.
        twist_topic: of TwistStamped; the only one where it is None.
        twist_axes: of the twist; `auto`: as the message says, which `reading` tells.

    Raises:
        BagError: no bag, no such topic, several to choose from, or stamps that do not fit.
    """
    own = _own(path)
    if own is not None and topic in (None, MOTION, f"/{MOTION}"):
        return bench_states(own)
    return use_bag(path, lambda bag: _foreign(bag, topic, twist_topic, twist_axes))


def read_wrench(path: Path, topic: str, origin: int) -> WrenchSamples:
    """The wrench of a WrenchStamped topic, its time counted from `origin` [ns]; BagError where there is none."""
    rows = use_bag(
        path,
        lambda bag: [
            (_stamp(message), message.wrench) for message in bag.read(_choose(bag, topic, (WRENCH,), "--force-topic"))
        ],
    )
    time = (numpy.array([stamp for stamp, _ in rows], dtype=numpy.int64) - origin) / SECOND
    return WrenchSamples(time, _vectors([w.force for _, w in rows]), _vectors([w.torque for _, w in rows]))


def bench_states(bag: Bag) -> RecordedStates:
    """States from `bench/motion`: coordinates that end in x, z and pitch (plane), or x, y, z and rotation_x, _y, _z.

    Pitch is the angle about y; rotation_x to _z are a rotation vector, body to world, whose velocity is the angular
    velocity in world axes.
    """
    blocks = [(message.data, decode_motion(message.data)) for message in bag.messages(MOTION)]
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
    return RecordedStates(kept_states, origin, tuple(bag.notes), (f"the velocities of {MOTION} are in world axes",))


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


def _own(path: Path) -> Bag | None:
    """The bag, if it is one of ours."""
    try:
        bag = open_bag(path, skip_bad=True)
    except BagError:
        return None
    return bag if MOTION in bag else None


def _foreign(bag: AnyBag, topic: str | None, twist_topic: str | None, twist_axes: TwistAxes) -> RecordedStates:
    name = _choose(bag, topic, (ODOMETRY, POSE), "--topic")
    messages = _all(bag, name)
    time = [_stamp(message) for message in messages]
    alone: tuple[str, ...] = ()
    if bag.topics[name] == ODOMETRY:
        poses, twists = [message.pose.pose for message in messages], [message.twist.twist for message in messages]
        reading = reading_of_odometry(messages[0], name, twist_axes)
    else:
        poses = [message.pose for message in messages]
        twist_name = _choose(bag, twist_topic, (TWIST,), "--twist-topic")
        other = _all(bag, twist_name)
        pairs, alone = pairs_of(time, [_stamp(message) for message in other], (name, twist_name))
        time, poses = [time[first] for first, _ in pairs], [poses[first] for first, _ in pairs]
        twists = [other[second].twist for _, second in pairs]
        reading = reading_of_twists(messages[0], other[0], twist_name, twist_axes)
    found = _states(time, poses, twists, reading.body, name)
    return found._replace(notes=(*bag.notes, *found.notes), reading=(reading.note, *alone))


def _all(bag: AnyBag, topic: str) -> list[Any]:
    messages = list(bag.read(topic))
    if not messages:
        raise BagError(f"{topic} of {bag.path} holds no message")
    return messages


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
    velocity = _vectors([twist.linear for twist in twists])[order]
    spin = _vectors([twist.angular for twist in twists])[order]
    if turning:
        velocity, spin = (numpy.einsum("nij,nj->ni", rotation, vectors) for vectors in (velocity, spin))
    position = _vectors([pose.position for pose in poses])[order]
    states, note = _one_a_stamp(BodyStates(seconds, position, rotation, velocity, spin), topic)
    return RecordedStates(states, min(time), note)


def _one_a_stamp(states: BodyStates, topic: str) -> tuple[BodyStates, tuple[str, ...]]:
    """The first state of each stamp; what others of it were, unless they repeat the first: a message recorded twice.

    Raises:
        BagError: there are far fewer stamps than messages.
    """
    first = numpy.concatenate([[True], numpy.diff(states.time) > 0.0])
    if FEWEST_STAMPS * first.sum() < len(first):
        raise BagError(
            f"the {len(first)} messages on {topic} have {first.sum()} stamps; allowed: one stamp each. Let the publisher fill in "
            "header.stamp"
        )
    of_stamp = numpy.maximum.accumulate(numpy.where(first, numpy.arange(len(first)), 0))
    rows = numpy.column_stack([field.reshape(len(first), -1) for field in states])
    other = int(((rows != rows[of_stamp]).any(axis=1) & ~first).sum())
    note = (
        f"{other} messages on {topic} have the stamp of another one and other values: the first of each stamp is used"
    )
    return BodyStates(*(field[first] for field in states)), (note,) if other else ()


def _choose(bag: AnyBag, topic: str | None, types: tuple[str, ...], option: str) -> str:
    """The name of a topic, or the only one of the types; BagError with what the bag has."""
    kinds = " or ".join(name.split("/")[-1] for name in types)
    fitting = [name for name, kind in bag.topics.items() if kind in types]
    if topic is not None:
        name = topic if topic in bag.topics else f"/{topic}"
        if name not in bag.topics:
            raise BagError(f"{bag.path} has no topic {topic}; of {kinds} it has {', '.join(fitting) or 'none'}")
        if bag.topics[name] not in types:
            raise BagError(f"{name} of {bag.path} is of {bag.topics[name]}; {option} needs {kinds}")
        return name
    preferred = [name for name in fitting if bag.topics[name] == types[0]] or fitting
    if len(preferred) != 1:
        what = f"several topics of {kinds} ({', '.join(preferred)}); choose one with {option}"
        none = f"no topic of {kinds}, from which the motion of a body could be read"
        raise BagError(f"{bag.path} has {what if preferred else none}")
    return preferred[0]


def _stamp(message: Any) -> int:
    return int(message.header.stamp.sec) * SECOND + int(message.header.stamp.nanosec)


def _vectors(values: list[Any]) -> Array:
    return numpy.array([[getattr(value, name) for name in XYZ] for value in values], dtype=numpy.float64).reshape(-1, 3)
