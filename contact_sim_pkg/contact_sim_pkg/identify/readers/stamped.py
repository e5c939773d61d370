"""Stamped messages of others: the topic that holds them, their stamps and vectors, one sample a
stamp.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeVar

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.encoding import SECOND
from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.identify.motion.states import BodyStates

__all__ = ["Array", "WrenchSamples", "all_messages", "chosen", "one_a_stamp", "stamp", "vectors"]

Array = NDArray[numpy.float64]

OVERTAKEN = 50.0  # usual steps by which a message may be late
FEWEST_STAMPS = 3  # messages a stamp in the mean, beyond which a topic is not stamped
XYZ = "xyz"


class WrenchSamples(NamedTuple):
    """A known wrench at the centre of mass over time, in world axes."""

    time: Array  # [n], [s]
    force: Array  # [n, 3], [N]
    torque: Array  # [n, 3], [N m]


Samples = TypeVar("Samples", BodyStates, WrenchSamples)


def chosen(bag: Bag, topic: str | None, types: tuple[str, ...], option: str) -> str:
    """The name of a topic, or the only one of the types; BagError with what the bag has."""
    kinds = " or ".join(name.split("/")[-1] for name in types)
    fitting = [name for name, row in bag.topics.items() if row.type in types]
    if topic is not None:
        name = topic if topic in bag.topics else f"/{topic}"
        if name not in bag.topics:
            raise BagError(f"{bag.path} has no topic {topic}; of {kinds} it has {', '.join(fitting) or 'none'}")
        if bag.topics[name].type not in types:
            raise BagError(f"{name} of {bag.path} is of {bag.topics[name].type}; {option} needs {kinds}")
        return name
    preferred = [name for name in fitting if bag.topics[name].type == types[0]] or fitting
    if len(preferred) != 1:
        what = f"several topics of {kinds} ({', '.join(preferred)}); choose one with {option}"
        none = f"no topic of {kinds}, from which the motion of a body could be read"
        raise BagError(f"{bag.path} has {what if preferred else none}")
    return preferred[0]


def all_messages(bag: Bag, topic: str) -> list[Any]:
    """The messages of a topic; BagError where there is none, or a stamp lies far before those
    recorded earlier.
    """
    messages = [message for _, message in bag.decoded(topic)]
    if not messages:
        raise BagError(f"{topic} of {bag.path} holds no message")
    _refuse_early_stamp(numpy.array([stamp(message) for message in messages], dtype=numpy.int64), topic)
    return messages


def _refuse_early_stamp(stamps: NDArray[numpy.int64], topic: str) -> None:
    """Messages may overtake each other by some steps; a stamp that is further back is wrong."""
    latest = numpy.maximum.accumulate(stamps)
    sample = int(numpy.argmax(latest - stamps))
    forward = numpy.diff(stamps)
    back = int(latest[sample] - stamps[sample])
    if back > 0 and (forward > 0).any() and back > OVERTAKEN * float(numpy.median(forward[forward > 0])):
        raise BagError(
            f"the stamp of sample {sample} of {topic} lies {back / SECOND:.6g} s before one that was recorded earlier; correct the "
            "stamps, or take the sample out"
        )


def stamp(message: Any) -> int:
    """Stamp of the header in [ns]."""
    return int(message.header.stamp.sec) * SECOND + int(message.header.stamp.nanosec)


def vectors(values: list[Any]) -> Array:
    """Components x, y, z of messages: [n, 3]."""
    return numpy.array([[getattr(value, name) for name in XYZ] for value in values], dtype=numpy.float64).reshape(-1, 3)


def one_a_stamp(samples: Samples, topic: str) -> tuple[Samples, tuple[str, ...]]:
    """Of samples in the order of time the first of each stamp; what others of it were, unless they
    repeat the first.

    Raises:
        BagError: there are far fewer stamps than messages.
    """
    first = numpy.concatenate([[True], numpy.diff(samples.time) > 0.0])
    if FEWEST_STAMPS * first.sum() < len(first):
        raise BagError(
            f"the {len(first)} messages on {topic} have {first.sum()} stamps; allowed: one stamp each. Let the publisher fill in "
            "header.stamp"
        )
    # For each message the first one of its stamp
    of_stamp = numpy.maximum.accumulate(numpy.where(first, numpy.arange(len(first)), 0))
    rows = numpy.column_stack([field.reshape(len(first), -1) for field in samples])
    other = int(((rows != rows[of_stamp]).any(axis=1) & ~first).sum())
    note = (
        f"{other} messages on {topic} have the stamp of another one and other values: the first of each stamp is used"
    )
    return type(samples)(*(field[first] for field in samples)), (note,) if other else ()
