"""Places of the parts of an MCAP file: from its summary, or, where it was cut off, from a walk
over its records.

Nothing is used before it was checked: a record is read when its length fits into the file and
below a limit, a chunk is unpacked when its checksum is right. The file is never changed.
"""

import struct
import zlib
from collections import Counter
from collections.abc import Container, Iterable, Iterator
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import IO, NamedTuple

from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.reader import SeekingReader
from mcap.records import Channel, Chunk, ChunkIndex, McapRecord, Message, Metadata, MetadataIndex, Schema
from mcap.summary import Summary

from contact_sim_pkg.bag.errors import BagError, CorruptChunkError
from contact_sim_pkg.bag.mcap.chunks import LARGEST_RECORD, damaged, decompressed
from contact_sim_pkg.bag.metadata import CHECKSUM_KEY

MAGIC = b"\x89MCAP0\r\n"
_HEAD = 9  # opcode and length of a record
_RECORD = struct.Struct("<BQ")  # that head
_MESSAGE = struct.Struct("<HIQQ")  # channel, sequence, log and publish time
LARGEST_ROW = 4 << 20  # [bytes] of messages outside of chunks that are read together
_FAULTS = (McapError, struct.error, ValueError, OSError, IndexError, KeyError, OverflowError)


class ChunkPlace(NamedTuple):
    """One chunk of the file, or a row of messages outside of chunks; times in [ns]."""

    offset: int
    length: int
    start: int
    end: int
    channels: frozenset[int] | None  # those of its messages; None where that is not known
    bare: bool = False  # messages outside of chunks


class Layout(NamedTuple):
    """Everything about a file but its messages; `note` names what is missing, and is empty where
    nothing is.
    """

    chunks: list[ChunkPlace]
    schemas: dict[int, Schema]
    channels: dict[int, Channel]
    counts: dict[int, int]  # messages by channel
    records: list[Metadata]
    attachments: int  # number of MCAP attachments, which are not read
    finished: bool
    note: str


def read_layout(file: IO[bytes], name: str) -> Layout:
    """The layout of a file, finished or not; BagError where it is no MCAP file at all."""
    file.seek(0)
    magic = file.read(len(MAGIC))
    if magic != MAGIC:
        raise BagError(
            f"{name} is no MCAP file: it begins with {magic.hex(' ') or 'nothing'}, not with {MAGIC.hex(' ')}"
        )
    return _from_summary(file, name) or _walk(file, name)


def counts_on_disk(path: Path) -> tuple[dict[str, int], bool]:
    """Messages by topic that the file lists, and whether it is finished with each chunk in its
    place; else empty.
    """
    try:
        with path.open("rb") as file:
            layout = read_layout(file, path.name)
            in_place = all(_head(file, place.offset) == (Opcode.CHUNK, place.length - _HEAD) for place in layout.chunks)
    except (BagError, OSError):
        return {}, False
    counts: Counter[str] = Counter()
    for channel, count in layout.counts.items():
        if channel in layout.channels:
            counts[layout.channels[channel].topic] += count
    return dict(counts), layout.finished and in_place


def chunk_records(
    file: IO[bytes], place: ChunkPlace, name: str, channels: Container[int] | None = None
) -> Iterator[McapRecord]:
    """Schemas, channels and messages of one chunk in file order; CorruptChunkError where it is damaged.

    With `channels` only the messages of these.
    """
    try:
        if place.bare:
            file.seek(place.offset)
            yield from _records(file.read(place.length), channels)
            return
        opcode, length = _head(file, place.offset)
        if opcode != Opcode.CHUNK or length != place.length - _HEAD or length > LARGEST_RECORD:
            raise ValueError(f"a chunk of {place.length} bytes should stand there")
        chunk = decompressed(Chunk.read(_stream(file, length)))
        if chunk.uncompressed_crc not in (0, zlib.crc32(chunk.data)):  # 0: none stated
            raise ValueError("its checksum is not that of its content")
        yield from _records(chunk.data, channels)
    except _FAULTS as error:
        raise damaged(name, place.offset, place.start, place.end, error) from None


def _records(content: bytes, channels: Container[int] | None) -> Iterator[McapRecord]:
    """Records of an unpacked chunk; those of other kinds are passed over."""
    # All lengths are checked before the first record is handed out
    for opcode, start, end in [*_places(content)]:
        # Messages are many: no stream is made for each
        if opcode == Opcode.MESSAGE:
            channel, sequence, log_time, publish_time = _MESSAGE.unpack_from(content, start)
            if channels is None or channel in channels:
                yield Message(channel, log_time, content[start + _MESSAGE.size : end], publish_time, sequence)
        elif opcode == Opcode.SCHEMA:
            yield Schema.read(ReadDataStream(BytesIO(content[start:end])))
        elif opcode == Opcode.CHANNEL:
            yield Channel.read(ReadDataStream(BytesIO(content[start:end])))


def _places(content: bytes) -> Iterator[tuple[int, int, int]]:
    """Kind, start and end of each record."""
    end = 0
    while end < len(content):
        opcode, length = _RECORD.unpack_from(content, end)
        start, end = end + _HEAD, end + _HEAD + length
        if end > len(content) or (opcode == Opcode.MESSAGE and length < _MESSAGE.size):
            raise ValueError(f"a record of {length} bytes reaches beyond its end")
        yield opcode, start, end


def _stream(file: IO[bytes], length: int) -> ReadDataStream:
    content = file.read(length)
    if len(content) < length:
        raise ValueError(f"{length - len(content)} bytes are missing")
    return ReadDataStream(BytesIO(content))


def _head(file: IO[bytes], offset: int) -> tuple[int, int]:
    file.seek(offset)
    head = file.read(_HEAD)
    return (head[0], int.from_bytes(head[1:], "little")) if len(head) == _HEAD else (0, 0)


def _from_summary(file: IO[bytes], name: str) -> Layout | None:
    """The layout from a summary whose checksum is right and which says all; None where there is none."""
    try:
        summary = _summary(file)
        if summary is None or summary.statistics is None:
            return None
        counts = dict(summary.statistics.channel_message_counts)
        # A writer may leave out channels, the index of chunks, or chunks altogether
        if (
            sum(counts.values()) != summary.statistics.message_count
            or len(summary.chunk_indexes) != summary.statistics.chunk_count
            or len(summary.metadata_indexes) != summary.statistics.metadata_count
            or (counts and not summary.chunk_indexes)
            or not counts.keys() <= summary.channels.keys()
            or any(each.schema_id not in (0, *summary.schemas) for each in summary.channels.values())
        ):
            return None
        # in the order of the file, which is that of the messages
        chunks = [_place(index) for index in sorted(summary.chunk_indexes, key=lambda index: index.chunk_start_offset)]
        records = [_indexed(file, index) for index in summary.metadata_indexes]
        attached = summary.statistics.attachment_count
        return Layout(chunks, summary.schemas, summary.channels, counts, records, attached, True, "")
    except _FAULTS:
        return None


def _summary(file: IO[bytes]) -> Summary | None:
    """The summary of a file that ends with a footer, empty where the writer left it out; None where it is not whole."""
    if not _summary_is_whole(file):
        return None
    file.seek(0)
    summary: Summary | None = SeekingReader(file, record_size_limit=LARGEST_RECORD).get_summary()
    return summary or Summary()


def _summary_is_whole(file: IO[bytes]) -> bool:
    """Whether the file ends with a footer, and the summary, if any, has the checksum that the footer states
    (0: none stated).
    """
    tail = _HEAD + 20 + len(MAGIC)
    end = file.seek(0, 2)
    file.seek(max(0, end - tail))
    footer = file.read()
    if len(footer) < tail or footer[-len(MAGIC) :] != MAGIC or footer[0] != Opcode.FOOTER:
        return False
    start, _, checksum = struct.unpack("<QQI", footer[_HEAD : _HEAD + 20])
    if start == 0:
        return True
    if not 0 < start <= end - tail or end - start > LARGEST_RECORD:
        return False
    file.seek(start)
    return bool(checksum == 0 or zlib.crc32(file.read(end - start - len(MAGIC) - 4)) == checksum)


def _place(index: ChunkIndex) -> ChunkPlace:
    channels = frozenset(index.message_index_offsets) or None
    return ChunkPlace(
        index.chunk_start_offset, index.chunk_length, index.message_start_time, index.message_end_time, channels
    )


def _metadata(file: IO[bytes], length: int) -> Metadata:
    stream = _stream(file, length)
    record: Metadata = Metadata.read(stream)
    if stream.count != length:
        raise ValueError(f"its texts end after {stream.count} of {length} bytes")
    return record


def _indexed(file: IO[bytes], index: MetadataIndex) -> Metadata:
    """The metadata record of an index, which has a checksum, as the name in it; a checksum that
    fails where it cannot be read.
    """
    try:
        if _head(file, index.offset) != (Opcode.METADATA, index.length - _HEAD):
            raise ValueError
        return replace(_metadata(file, index.length - _HEAD), name=index.name)
    except _FAULTS:
        return Metadata(index.name, {CHECKSUM_KEY: ""})


def _walk(file: IO[bytes], name: str) -> Layout:
    """The layout from the records themselves, up to the first that is cut off or cannot be
    believed.
    """
    found = Layout([], {}, {}, {}, [], 0, False, "")
    end, damaged_records, attachments = file.seek(0, 2), 0, 0
    last_is_whole = True
    offset, opcode, reason = len(MAGIC), 0, ""
    while offset < end:
        opcode, length = _head(file, offset)
        reason = _why_not(opcode, length, end - offset - _HEAD)
        if reason:
            break
        whole = _take(file, ChunkPlace(offset, length + _HEAD, 0, 0, None), opcode, found, name)
        damaged_records += not whole
        attachments += opcode == Opcode.ATTACHMENT
        last_is_whole = whole if opcode in (Opcode.CHUNK, Opcode.MESSAGE) else last_is_whole
        offset += length + _HEAD
    if opcode == Opcode.DATA_END:
        reason = _why_not_finished(file, found, damaged_records)
        if not reason:
            return found._replace(attachments=attachments, finished=True)
    elif not last_is_whole:
        found.chunks.pop()  # torn by a power loss: its length reached the disk, its content did not
    lost = f"{reason}, the last {end - offset} bytes are not read" if reason else "it was not finished"
    return found._replace(note=_note(name, found, lost, damaged_records), attachments=attachments)


def _why_not_finished(file: IO[bytes], found: Layout, damaged_records: int) -> str:
    """What is wrong with a file that was walked to the end of its data; empty where all of it was found."""
    try:
        summary = _summary(file)
    except _FAULTS:
        summary = None
    if summary is None:
        return "its summary is damaged"
    walked = sum(found.counts.values())
    stated = walked if summary.statistics is None else summary.statistics.message_count
    if stated != walked:
        return f"its statistics state {stated} messages"
    return "some of its records are damaged" if damaged_records else ""


def _why_not(opcode: int, length: int, left: int) -> str:
    """Why the walk cannot go past this record; empty where it can."""
    if opcode == Opcode.DATA_END:
        return "its data ends there"
    if left < 0 or opcode in (0, Opcode.FOOTER):
        return "it was not finished"
    if length > LARGEST_RECORD:
        return f"it is damaged: a record of kind {opcode} claims {length} bytes, limit {LARGEST_RECORD}"
    if length > left:
        return f"it was not finished: a record of kind {opcode} is cut off after {left} of {length} bytes"
    return ""


def _take(file: IO[bytes], place: ChunkPlace, opcode: int, found: Layout, name: str) -> bool:
    """Add one record of the walk; False where it is damaged (a chunk stays listed, so that a reader
    meets it).
    """
    length = place.length - _HEAD
    try:
        if opcode == Opcode.CHUNK:
            times = file.read(16)
            found.chunks.append(place._replace(start=_time(times[:8]), end=_time(times[8:])))
            _count(chunk_records(file, found.chunks[-1], name), found)
        elif opcode == Opcode.MESSAGE:
            _add_message(file.read(_MESSAGE.size), place, found)
        elif opcode == Opcode.METADATA:
            found.records.append(_metadata(file, length))
        elif opcode == Opcode.SCHEMA:
            _count([Schema.read(_stream(file, length))], found)
        elif opcode == Opcode.CHANNEL:
            _count([Channel.read(_stream(file, length))], found)
    except (CorruptChunkError, *_FAULTS):
        return False
    return True


def _add_message(head: bytes, place: ChunkPlace, found: Layout) -> None:
    """Take a message outside of chunks, to those in front of it where they are its neighbours."""
    channel, _, log_time, _ = _MESSAGE.unpack(head)
    last = found.chunks[-1] if found.chunks else place
    if last.bare and last.offset + last.length == place.offset and last.length < LARGEST_ROW:
        found.chunks[-1] = ChunkPlace(
            last.offset, last.length + place.length, min(last.start, log_time), max(last.end, log_time),
            (last.channels or frozenset()) | {channel}, True,
        )  # fmt: skip
    else:
        found.chunks.append(place._replace(start=log_time, end=log_time, channels=frozenset((channel,)), bare=True))
    found.counts[channel] = found.counts.get(channel, 0) + 1


def _time(eight: bytes) -> int:
    return int.from_bytes(eight, "little")


def _count(records: Iterable[McapRecord], found: Layout) -> None:
    for record in records:
        if isinstance(record, Schema):
            found.schemas[record.id] = record
        elif isinstance(record, Channel):
            found.channels[record.id] = record
        elif isinstance(record, Message):
            found.counts[record.channel_id] = found.counts.get(record.channel_id, 0) + 1


def _note(name: str, found: Layout, lost: str, damaged_records: int) -> str:
    content = f"{sum(found.counts.values())} messages"
    if found.counts:
        content += f" up to {max(chunk.end for chunk in found.chunks) / 1e9:.3f} s"
    bad = f"; {damaged_records} of its records are damaged" if damaged_records else ""
    return f"{name} holds {content}: {lost}{bad}"
