"""A bag as it was recorded, finished or not: topics, messages in file order, columns for plots and
studies.

Types come from the definitions in the bag, not from those installed. Nothing is ever changed on
disk.
"""

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

from rosbags.serde import SerdeError
from rosbags.typesys.store import Typestore

from contact_sim_pkg.bag.columns import Stack
from contact_sim_pkg.bag.encoding import deserialize
from contact_sim_pkg.bag.errors import BagError, CorruptChunkError, UnreadableTypeError
from contact_sim_pkg.bag.metadata import (
    CDR,
    LACKING,
    OUTCOME,
    RECORD,
    ROSBAG2,
    SCENE_KEY,
    RecordedTopic,
    unsealed,
    wall_time_of,
)
from contact_sim_pkg.bag.parts.find import parts_of
from contact_sim_pkg.bag.parts.part import BagMessage, Part, add_topic
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.bag.typestore import store_of_definition, type_hash

__all__ = ["Bag", "BagMessage", "open_bag"]

SCENE_TOPIC, SCENE_TYPE = "bench/scene", "std_msgs/msg/String"


class Bag:
    """A bag that is read. `notes` are lines on what is missing; `complete` is True without any."""

    def __init__(self, parts: list[Part], skip_bad: bool) -> None:
        """Take files that were opened, in their order; `open_bag` does that."""
        self.path, self._parts, self._skip_bad = parts[0].path, parts, skip_bad
        self.notes = [note for part in parts for note in part.notes]
        self.topics: dict[str, RecordedTopic] = {}
        for part in parts:
            for row in part.topics.values():
                add_topic(self.topics, row, part.path)
        self.left_out: list[str] = []
        """Lines on topics that a reader of all of them could not read and went on without."""
        self._stores: dict[str, Typestore] = {}
        self.metadata: dict[str, str] = {}
        """The texts kept at the start and at the end of the recording: scene, versions, how it
        ended.
        """
        self.scene: str | None = None
        """The resolved scene as YAML; None in a bag without one."""
        self._epoch = 0  # [ns] that the stored times are later than simulated time
        self._take_texts()
        if LACKING in self.metadata:
            self.notes.append(f"{self.path.name}: {self.metadata[LACKING]}")

    @property
    def complete(self) -> bool:
        """True where the bag was finished and no damaged chunk has been skipped so far."""
        return not self.notes

    @property
    def not_copied(self) -> str:
        """Line on parts of the file that the reader skips and a recovery leaves out; empty
        where there is nothing.
        """
        names = [name for part in self._parts for name, _ in part.texts if name not in (RECORD, OUTCOME, ROSBAG2)]
        found = [f"the metadata record {name!r}" for name in names]
        attachments = sum(part.attachments for part in self._parts)
        if attachments:
            found.append(f"{attachments} MCAP attachment(s)")
        return ", ".join(found)

    def _take_texts(self) -> None:
        """Set `metadata` and `scene`; BagError, or a note with `skip_bad`, for damaged ones."""
        ours = [record for part in self._parts for record in part.texts if record[0] in (RECORD, OUTCOME)]
        for (name, _), texts in zip(ours, unsealed([content for _, content in ours]), strict=True):
            if texts is None:
                self._leave_out(f"the texts {name!r} in the metadata of {self.path} are not as they were written")
            self.metadata.update(texts or {})
        self._epoch = wall_time_of(self.metadata)
        kept, recorded = self.metadata.get(SCENE_KEY), self._recorded_scene()
        if recorded is not None and kept not in (None, recorded):
            self._leave_out(f"the scene in the metadata of {self.path} is another than the one on bench/scene")
            self.metadata[SCENE_KEY] = recorded
        self.scene = kept if recorded is None else recorded

    def _leave_out(self, sentence: str) -> None:
        if not self._skip_bad:
            raise BagError(f"{sentence}; the file is damaged or was changed, `bench recover` saves what holds")
        self.notes.append(f"{sentence} and are left out" if "texts" in sentence else f"{sentence}, which is taken")

    def _recorded_scene(self) -> str | None:
        """The text of the first message on `bench/scene`, under the checksum of its chunk; None
        without one.
        """
        for name, row in self.topics.items():
            known = row.type == SCENE_TYPE and row.encoding == CDR
            if SCENE_TOPIC in (row.relative_name, _relative(name)) and known and self.count(name):
                first = next(self.messages(name), None)
                return None if first is None else str(deserialize(SCENE_TYPE, first.data).data)
        return None

    def topic(self, name: str) -> RecordedTopic:
        """The topic shown as `name` or `/name`, or the only one that is called so or
        `/namespace/name`, or has its type.

        By type only where the table has no other topic of that type. BagError: none, or many.
        """
        for candidate in (name, f"/{name}"):
            if candidate in self.topics:
                return self.topics[candidate]
        called = [topic for topic in self.topics.values() if topic.relative_name == name]
        fitting = called or [topic for full, topic in self.topics.items() if full.endswith(f"/{name}")]
        if not fitting and name in TOPICS and sum(row.type == TOPICS[name].type for row in TOPICS.values()) == 1:
            fitting = [topic for topic in self.topics.values() if topic.type == TOPICS[name].type]
        if len(fitting) == 1:
            return fitting[0]
        many = f"{len(fitting)} topics called" if fitting else "no topic called"
        raise BagError(f"{self.path} has {many} {name!r}; it has {', '.join(self.topics) or 'none at all'}")

    def hash_of(self, topic: str) -> str:
        """The hash `RIHS01_…` of the topic's type as the bag states it, or else by the definition
        in the bag.
        """
        row = self.topic(topic)
        return row.type_hash or self._types(row).hash_rihs01(row.type)

    def refuse_other_definition(self, topic: str) -> None:
        """BagError where a topic has not the installed definition of our type, by which its bytes
        would be read.
        """
        row = self.topic(topic)
        needed = TOPICS[topic].type if topic in TOPICS else row.type
        if row.type != needed or self._types(row).hash_rihs01(row.type) != type_hash(needed):
            raise BagError(
                f"{self.path}: {row.name} was recorded with another definition of {needed} than the installed one; use the "
                "version that recorded it"
            )

    def __contains__(self, name: str) -> bool:
        """Whether the bag has the topic."""
        try:
            self.topic(name)
        except BagError:
            return False
        return True

    def count(self, topic: str | None = None) -> int:
        """Messages on a topic, or on all; 0 for a topic that the bag does not have."""
        if topic is None:
            return sum(sum(part.counts.values()) for part in self._parts)
        name = self.topic(topic).name if topic in self else ""
        return sum(part.counts.get(name, 0) for part in self._parts)

    @property
    def begin(self) -> int:
        """Earliest log time in [ns]; 0 without messages. A bag of another recorder is in wall time."""
        return min((part.begin - self._epoch for part in self._parts if part.end), default=0)

    @property
    def end(self) -> int:
        """Latest log time in [ns]; 0 without messages."""
        return max((part.end - self._epoch for part in self._parts if part.end), default=0)

    def messages(self, topic: str | None = None) -> Iterator[BagMessage]:
        """All messages, or those of one topic, in file order.

        Raises CorruptChunkError at a damaged chunk, which names its time range; with `skip_bad` a
        note is kept instead.
        """
        names = self.topics.keys() if topic is None else {self.topic(topic).name}
        for part in self._parts:
            yield from part.messages(names, self._epoch, self._skip_or_raise)

    def decoded(self, topic: str) -> Iterator[tuple[int, Any]]:
        """Log time in [ns] and message object of each message of a topic, by the bag's own
        definition of its type.
        """
        for message in self.messages(topic):
            yield message.log_time, self.decode(message)

    def decode(self, message: BagMessage) -> Any:
        """The object of a message, by the bag's own definition of its type; BagError where it does
        not fit that.
        """
        return self._decode(self.topics[message.topic], message.log_time, message.data)

    def _decode(self, row: RecordedTopic, log_time: int, data: bytes) -> Any:
        try:
            # A view: rosbags copies what it takes off the front
            return self._types(row).deserialize_cdr(memoryview(data), row.type)
        except (SerdeError, AssertionError) as error:
            where = f"{self.path}: the message of {row.name} at {log_time / 1e9:.6f} s"
            raise BagError(f"{where} does not fit the definition in the bag: {error}") from None

    def columns(self, topic: str, fields: tuple[str, ...] | None = None) -> dict[str, Any]:
        """The fields of all messages of a topic as columns.

        Args:
            topic: name of the topic.
            fields: names of the columns wanted; all where it is None.

        Returns:
            `log_time` and, with a header, `stamp` as int64 [ns] and `time`, the stamp in [s]; then
            one entry a field, nested ones with dots (`wrench.force.z`): scalars as [messages],
            arrays of one length as [messages, length], arrays that differ in length as a list. A
            field `time` of the message itself is `time_in_message`.

        Raises:
            BagError: no such topic or field, or a message does not fit its definition.
            MemoryLimitError: the columns are too large.
        """
        stack = self.stack(topic, fields)
        for message in self.messages(topic):
            stack.add(message.log_time, message.data)
        return stack.columns()

    def stack(self, topic: str, fields: tuple[str, ...] | None = None) -> Stack:
        """What takes messages of a topic one by one, and makes columns of them."""
        row = self.topic(topic)
        return Stack(self._types(row), row.type, fields, partial(self._decode, row), f"{self.path}, {row.name}")

    def _types(self, row: RecordedTopic) -> Typestore:
        if row.encoding != CDR:
            raise UnreadableTypeError(
                f"{self.path}: the messages of {row.name} are encoded as {row.encoding!r:.20}, and only {CDR} is read"
            )
        if row.type not in self._stores:
            try:
                self._stores[row.type] = store_of_definition(row.type, row.definition)
            except UnreadableTypeError as error:
                raise UnreadableTypeError(f"{row.name}: {error}") from None
        return self._stores[row.type]

    def _skip_or_raise(self, error: CorruptChunkError) -> None:
        if not self._skip_bad:
            raise error
        note = str(error).replace("reading stops there unless bad chunks are skipped", "it was skipped")
        if note not in self.notes:
            self.notes.append(note)


def open_bag(path: Path | str, *, skip_bad: bool = False) -> Bag:
    """Open a bag of anybody for reading: MCAP, SQLite or ROS 1, in one file or several, packed or not.

    Args:
        path: the bag's directory, or its file.
        skip_bad: go on after a damaged chunk or file, and without damaged texts, instead of stopping at
            them.

    Raises:
        BagError: there is no bag, or its texts do not hold: their checksum fails, or its metadata and
            `bench/scene` hold different scenes.
    """
    return Bag(parts_of(Path(path), skip_bad=skip_bad), skip_bad)


def _relative(name: str) -> str:
    return "/".join(name.split("/")[-2:])
