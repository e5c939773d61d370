"""What every file of a bag gives, whatever its format."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from pathlib import Path
from typing import NamedTuple, Protocol

import zstandard

from contact_sim_pkg.bag.errors import BagError, CorruptChunkError
from contact_sim_pkg.bag.mcap.chunks import LARGEST_RECORD
from contact_sim_pkg.bag.metadata import RecordedTopic

__all__ = ["ZSTD_MAGIC", "BagMessage", "Part", "add_topic", "unpacked"]

LONGEST_NAME = 255
"""characters of a topic"""
ZSTD_MAGIC = b"\x28\xb5\x2f\xfd"
"""begins a packed file, and a packed message: CDR begins with 0"""


class BagMessage(NamedTuple):
    """One recorded message; times in [ns], of simulated time in a bag of ours, `data` as CDR."""

    topic: str
    type: str
    log_time: int
    data: bytes
    publish_time: int
    sequence: int


class Part(Protocol):
    """One file of a bag; it is never changed."""

    path: Path
    topics: dict[str, RecordedTopic]
    """by name"""
    counts: dict[str, int]
    """messages by topic"""
    texts: list[tuple[str, Mapping[str, str]]]
    """metadata records: name and content"""
    attachments: int
    """files kept in this one, which are not read"""
    notes: list[str]
    """what is missing, a sentence each"""
    begin: int
    end: int
    """earliest and latest log time [ns]; 0 without messages"""

    def messages(
        self, names: AbstractSet[str], epoch: int, damaged: Callable[[CorruptChunkError], None]
    ) -> Iterator[BagMessage]:
        """Messages of the topics in file order, their times less ``epoch`` [ns]; ``damaged`` is called for what cannot be
        read, and may raise.
        """


def add_topic(found: dict[str, RecordedTopic], row: RecordedTopic, path: Path) -> None:
    """Take a topic; BagError for what is no name, and for two definitions under one."""
    name = row.name
    if not name.isprintable() or len(name) > LONGEST_NAME:
        raise BagError(f"{path} has a topic whose name cannot be one: {name[:40]!r}")
    first = found.setdefault(name, row)
    if first.encoding != row.encoding:
        raise BagError(f"{path} has two encodings of the topic {name}: {first.encoding!r:.20} and {row.encoding!r:.20}")
    if (first.type, first.definition) != (row.type, row.definition):
        raise BagError(f"{path} has two definitions of the topic {name}: {first.type[:40]!r} and {row.type[:40]!r}")


def unpacked(data: bytes, place: str) -> bytes:
    """The bytes of a message that was packed by itself; CorruptChunkError where they are damaged or too large."""
    try:
        # of unknown size where the frame does not state one
        content = zstandard.ZstdDecompressor().stream_reader(data).read(LARGEST_RECORD + 1)
        if len(content) > LARGEST_RECORD:
            raise ValueError(f"it unpacks to more than {LARGEST_RECORD} bytes")
    except (zstandard.ZstdError, ValueError) as error:
        raise CorruptChunkError(f"{place} cannot be unpacked: {error}", 0, 0) from None
    return bytes(content)
