"""Messages of a contact that is made of points: the points at one instant, and the episodes that ended in a block."""

from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.encoding import deserialize, equal_lengths, float64s, header, serialize
from contact_sim_pkg.bag.messages.frames import BENCH_FRAME

_POINTS = "contact_msgs_defs/msg/ContactPoints"
_EPISODES = "contact_msgs_defs/msg/ContactEpisodes"

WHOLE_CONTACT = -1  # in place of a point's number: the contact of all points together

Numbers = NDArray[numpy.float64]


class PointField(NamedTuple):
    """The candidate points of one contact at one instant; forces on the upper body."""

    block: int
    x: Numbers  # [points], [m] in the contact's frame
    y: Numbers  # [points], [m]
    approach: Numbers  # [points], [m], positive in compression
    normal: Numbers  # [points], [N], >= 0
    tangential: Numbers  # [points], [N], along x
    displacement: Numbers  # [points], [m] of the upper body's face along x
    state: NDArray[numpy.uint8]  # [points], 0 apart, 1 touches without friction, 2 sticks, 3 slips


class EpisodeBlock(NamedTuple):
    """The contact episodes that ended in one block, in the order in which they ended."""

    block: int
    point: NDArray[numpy.int32]  # [episodes], number of the point, from 0; WHOLE_CONTACT: all together
    touched: NDArray[numpy.uint8]  # [episodes], 1: began with a touch; 0: was there from the start of the run
    start: Numbers  # [episodes], [s]
    end: Numbers  # [episodes], [s], when the force was lost
    compression_work: Numbers  # [episodes], [J], W_c <= 0
    restitution_work: Numbers  # [episodes], [J], W_r >= 0
    restitution: Numbers  # [episodes], sqrt(W_r / -W_c)
    peak_force: Numbers  # [episodes], [N], largest sampled
    largest_approach: Numbers  # [episodes], [m]


def encode_contact_points(value: PointField, stamp_ns: int, frame_id: str) -> bytes:
    """The points of a contact; MessageError where an array differs in length from the others."""
    return _encode(_POINTS, value, stamp_ns, frame_id)


def decode_contact_points(data: bytes) -> PointField:
    """The points of a contact at one instant."""
    return PointField(*_decode(_POINTS, data, PointField._fields))


def encode_episodes(value: EpisodeBlock, stamp_ns: int, frame_id: str = BENCH_FRAME) -> bytes:
    """The episodes that ended in a block; MessageError where an array differs in length from the others."""
    return _encode(_EPISODES, value, stamp_ns, frame_id)


def decode_episodes(data: bytes) -> EpisodeBlock:
    """The episodes that ended in a block."""
    return EpisodeBlock(*_decode(_EPISODES, data, EpisodeBlock._fields))


def _encode(type_name: str, value: PointField | EpisodeBlock, stamp_ns: int, frame_id: str) -> bytes:
    """Block, then arrays of one length; whole numbers as they are, the others as float64."""
    arrays = {name: numpy.asarray(getattr(value, name)) for name in value._fields[1:]}
    equal_lengths(type_name, **arrays)
    fields = (numpy.ascontiguousarray(a) if a.dtype.kind in "iu" else float64s(a) for a in arrays.values())
    return serialize(type_name, header(stamp_ns, frame_id), value.block, *fields)


def _decode(type_name: str, data: bytes, names: tuple[str, ...]) -> tuple[Any, ...]:
    message = deserialize(type_name, data)
    arrays = {name: numpy.array(getattr(message, name)) for name in names[1:]}
    equal_lengths(type_name, **arrays)
    return (message.block, *arrays.values())
