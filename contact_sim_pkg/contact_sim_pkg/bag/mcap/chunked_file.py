"""An MCAP file of packed chunks, written as messages come (https://mcap.dev/spec).

The `mcap` package lays out the records that are few. Messages, of which a run has thousands a
second, are laid out here: a chunk is packed from one buffer, and reaches the file with its index in
one write.
"""

import struct
import zlib
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence

import zstandard
from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import (
    Channel,
    ChunkIndex,
    DataEnd,
    Footer,
    Header,
    McapRecord,
    Metadata,
    MetadataIndex,
    Schema,
    Statistics,
    SummaryOffset,
)

from contact_sim_pkg.bag.mcap.append_file import AppendFile
from contact_sim_pkg.bag.mcap.layout import MAGIC

CHUNK_BYTES = (
    4 << 20
)  # ten blocks of a road, most of it that of the block before: packed together they take a third less
PACKING = zstandard.ZstdCompressionParameters.from_level(-8, window_log=22, hash_log=17)
"""Sees a whole chunk, and skips quickly what does not repeat (docs/decisions/0031-chunks-of-our-own.md)."""

_MESSAGE = struct.Struct("<BQHIQQ")  # opcode, length, channel, sequence, log and publish time
_CHUNK = struct.Struct("<BQQQQII4sQ")  # opcode, length, first and last time, size, checksum, "zstd", packed size
_INDEX = struct.Struct("<BQHI")  # opcode, length, channel, bytes of times and places
_FOOTER = struct.Struct("<BQQQ")  # opcode, length, places of the summary and of its offsets: what its checksum covers
_HEAD = 9  # opcode and length, which do not count in a length


class ChunkedFile:
    """The records of a file under construction; those that stand in its summary are kept."""

    def __init__(self, file: AppendFile, library: str) -> None:
        """Begin the file; BagWriteError, from here on, where it cannot grow."""
        self._file = file
        self._schemas: dict[str, Schema] = {}
        self._channels: list[Channel] = []
        self._counts: Counter[int] = Counter()
        self._chunks: list[ChunkIndex] = []
        self._metadata: list[MetadataIndex] = []
        self._packer = zstandard.ZstdCompressor(compression_params=PACKING)
        self._begin_chunk()
        file.write(MAGIC + _laid_out([Header("ros2", library)]))

    def _begin_chunk(self) -> None:
        self._parts: list[bytes] = []
        self._size = 0
        self._entries: defaultdict[int, list[int]] = defaultdict(list)  # by channel, log time and place of each message

    def add_metadata(self, name: str, texts: Mapping[str, str]) -> None:
        """Append texts under a name."""
        data = _laid_out([Metadata(name, dict(texts))])
        self._metadata.append(MetadataIndex(self._file.tell(), len(data), name))
        self._file.write(data)

    def add_channel(self, topic: str, encoding: str, type_name: str, definition: str, texts: Mapping[str, str]) -> int:
        """The number of a new channel; it and its type stand in the first chunk and in the summary."""
        schema = self._schemas.get(type_name)
        if schema is None:
            schema = Schema(len(self._schemas) + 1, definition.encode(), "ros2msg", type_name)
            self._schemas[type_name] = schema
            self._add_record(schema)
        channel = Channel(len(self._channels) + 1, topic, encoding, dict(texts), schema.id)
        self._channels.append(channel)
        self._add_record(channel)
        return channel.id

    def _add_record(self, record: McapRecord) -> None:
        self._parts.append(_laid_out([record]))
        self._size += len(self._parts[-1])

    def add_message(self, channel: int, sequence: int, log_time: int, publish_time: int, data: bytes) -> None:
        """Append a message to the chunk, which ends at 4 MiB; times in [ns]."""
        head = _MESSAGE.pack(
            Opcode.MESSAGE, _MESSAGE.size - _HEAD + len(data), channel, sequence, log_time, publish_time
        )
        self._entries[channel] += (log_time, self._size)
        self._parts += (head, data)
        self._size += _MESSAGE.size + len(data)
        if self._size > CHUNK_BYTES:
            self.end_chunk()

    def end_chunk(self) -> None:
        """Hand the chunk, where it has messages, and its index to the operating system."""
        if not self._entries:
            return
        content, entries = b"".join(self._parts), self._entries
        self._begin_chunk()
        packed = self._packer.compress(content)
        times = [time for each in entries.values() for time in each[::2]]
        start, end = min(times), max(times)
        head = _CHUNK.pack(
            Opcode.CHUNK, _CHUNK.size - _HEAD + len(packed), start, end, len(content), zlib.crc32(content), 4, b"zstd",
            len(packed),
        )  # fmt: skip
        place, length = self._file.tell(), len(head) + len(packed)
        indexes, offsets, at = [], {}, place + length
        for channel, each in entries.items():
            offsets[channel] = at
            indexes.append(
                _INDEX.pack(Opcode.MESSAGE_INDEX, _INDEX.size - _HEAD + 8 * len(each), channel, 8 * len(each))
            )
            indexes.append(struct.pack(f"<{len(each)}Q", *each))
            at += _INDEX.size + 8 * len(each)
            self._counts[channel] += len(each) // 2
        self._file.write(b"".join((head, packed, *indexes)))
        self._chunks.append(
            ChunkIndex(
                chunk_start_offset=place, chunk_length=length, message_start_time=start, message_end_time=end,
                message_index_offsets=offsets, message_index_length=at - place - length, compression="zstd",
                compressed_size=len(packed), uncompressed_size=len(content),
            )
        )  # fmt: skip

    @property
    def extent(self) -> tuple[int, int]:
        """First and last log time of the chunks, [ns]; both 0 without messages."""
        start = min((chunk.message_start_time for chunk in self._chunks), default=0)
        return start, max((chunk.message_end_time for chunk in self._chunks), default=0)

    def finish(self) -> None:
        """End the chunk, and write the summary and the end of the file at once."""
        self.end_chunk()
        start, end = self.extent
        statistics = Statistics(
            message_count=self._counts.total(), message_start_time=start, message_end_time=end,
            channel_message_counts=dict(self._counts), channel_count=len(self._channels),
            schema_count=len(self._schemas), chunk_count=len(self._chunks), metadata_count=len(self._metadata),
            attachment_count=0,
        )  # fmt: skip
        data_end = _laid_out([DataEnd(0)])
        first = self._file.tell() + len(data_end)
        summary, offsets = b"", []
        groups: tuple[tuple[Opcode, Sequence[McapRecord]], ...] = (
            (Opcode.SCHEMA, [*self._schemas.values()]), (Opcode.CHANNEL, self._channels),
            (Opcode.STATISTICS, [statistics]), (Opcode.CHUNK_INDEX, self._chunks),
            (Opcode.METADATA_INDEX, self._metadata),
        )  # fmt: skip
        for opcode, records in groups:
            group = _laid_out(records)
            offsets.append(SummaryOffset(opcode, first + len(summary), len(group)))
            summary += group
        places = (first, first + len(summary))
        summary += _laid_out(offsets)
        checksum = zlib.crc32(_FOOTER.pack(Opcode.FOOTER, 20, *places), zlib.crc32(summary))
        self._file.write(data_end + summary + _laid_out([Footer(*places, checksum)]) + MAGIC)


def _laid_out(records: Sequence[McapRecord]) -> bytes:
    """The bytes of records."""
    builder = RecordBuilder()
    for record in records:
        record.write(builder)
    data: bytes = builder.end()  # type: ignore[no-untyped-call]
    return data
