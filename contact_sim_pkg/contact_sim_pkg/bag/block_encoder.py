"""Messages of one block, from the records of a rig with their topics and stamps."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.topics import TOPICS

FRAMES = {name: topic.frame for name, topic in TOPICS.items()}

Message = tuple[str, int, bytes]  # topic, stamp [ns], CDR


class Output(NamedTuple):
    """One message to be: its columns by name, its topic and its stamp."""

    topic: str
    stamp: int  # [ns]
    record: Any  # of the topic's type, from `records/messages.py`
    frame: str = ""  # where it is not that of the topic


def encode_block(outputs: Iterable[Output]) -> list[Message]:
    """Messages of a block in canonical order: by stamp, by rank of the topic, then as given.

    Raises MessageError where a value does not fit its field, or arrays do not fit each other.
    """
    messages = [
        (each.topic, each.stamp, encode(each.record, each.stamp, each.frame or FRAMES[each.topic])) for each in outputs
    ]
    return sorted(messages, key=lambda message: (message[1], TOPICS[message[0]].rank))
