"""An MCAP file of a bag."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from pathlib import Path
from typing import Any

from mcap.records import Channel, Message, Schema

from contact_sim_pkg.bag.errors import CorruptChunkError
from contact_sim_pkg.bag.mcap.append_file import is_being_written
from contact_sim_pkg.bag.mcap.layout import chunk_records, read_layout
from contact_sim_pkg.bag.metadata import RELATIVE_NAME, RecordedTopic
from contact_sim_pkg.bag.parts.part import ZSTD_MAGIC, BagMessage, add_topic, unpacked
from contact_sim_pkg.bag.parts.ros1 import ROS1, FromRos1
from contact_sim_pkg.bag.typestore import ros2msg_text
from contact_sim_pkg.files import open_regular_file

__all__ = ["McapPart"]


class McapPart:
    """See `Part`. Chunks or none, summary or none; cut off or damaged, as far as whole chunks go."""

    def __init__(self, path: Path) -> None:
        """Read the layout of the file; BagError where it is no MCAP."""
        with open_regular_file(path) as file:
            self._layout = layout = read_layout(file, path.name)
        self.path, self.attachments = path, layout.attachments
        self.notes = [layout.note] if layout.note else []
        if layout.note and is_being_written(path):
            self.notes.append(f"{path.name} is being recorded at this moment")
        self.topics: dict[str, RecordedTopic] = {}
        self._converters: dict[str, FromRos1] = {}
        for channel in layout.channels.values():
            add_topic(self.topics, self._topic(channel, layout.schemas.get(channel.schema_id)), path)
        self.counts: dict[str, int] = {}
        unknown = 0
        for number, count in layout.counts.items():
            if number in layout.channels:
                name = layout.channels[number].topic
                self.counts[name] = self.counts.get(name, 0) + count
            else:
                unknown += count
        if unknown:
            self.notes.append(f"{unknown} messages of {path.name} cannot be read: what says their topic is damaged")
        self.texts: list[tuple[str, Mapping[str, str]]] = [(record.name, record.metadata) for record in layout.records]
        self.begin = min((chunk.start for chunk in layout.chunks), default=0)
        self.end = max((chunk.end for chunk in layout.chunks), default=0)

    def _topic(self, channel: Channel, schema: Schema | None) -> RecordedTopic:
        type_name, text = (schema.name, schema.data.decode("utf-8", "replace")) if schema else ("", "")
        kept, encoding = channel.metadata, channel.message_encoding
        if encoding == ROS1 and schema is not None:
            converter = self._converters[channel.topic] = FromRos1(type_name, text)
            type_name, text, encoding = converter.type, converter.definition, converter.encoding
        elif schema is not None:
            text = ros2msg_text(type_name, text, schema.encoding)
        return RecordedTopic(
            channel.topic,
            channel.topic,
            type_name,
            text,
            kept.get("topic_type_hash", ""),
            kept.get("offered_qos_profiles", ""),
            kept.get(RELATIVE_NAME, ""),
            encoding,
        )

    def messages(
        self, names: AbstractSet[str], epoch: int, damaged: Callable[[CorruptChunkError], None]
    ) -> Iterator[BagMessage]:
        """See `Part`."""
        channels = self._layout.channels
        numbers = {number: self.topics[each.topic] for number, each in channels.items() if each.topic in names}
        with open_regular_file(self.path) as file:
            for place in self._layout.chunks:
                if place.channels is not None and place.channels.isdisjoint(numbers):
                    continue
                try:
                    yield from self._messages_of(
                        chunk_records(file, place, self.path.name, numbers), numbers, epoch, damaged
                    )
                except CorruptChunkError as error:
                    damaged(error)

    def _messages_of(
        self,
        records: Iterable[Any],
        rows: dict[int, RecordedTopic],
        epoch: int,
        damaged: Callable[[CorruptChunkError], None],
    ) -> Iterator[BagMessage]:
        for record in records:
            if not isinstance(record, Message):
                continue
            row, data = rows[record.channel_id], record.data
            if data.startswith(ZSTD_MAGIC) or row.name in self._converters:
                try:
                    data = self._plain(row.name, data)
                except CorruptChunkError as error:
                    damaged(error)
                    continue
            yield BagMessage(
                row.name, row.type, record.log_time - epoch, data, record.publish_time - epoch, record.sequence
            )

    def _plain(self, name: str, data: bytes) -> bytes:
        """The message as CDR: unpacked, and converted from ROS 1."""
        place = f"{self.path.name}: a message of {name}"
        data = unpacked(data, place) if data.startswith(ZSTD_MAGIC) else data
        return self._converters[name].converted(data, place) if name in self._converters else data
