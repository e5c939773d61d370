"""Bags and messages of ROS 1, read by rosbags and handed on as CDR with the definitions of ROS 2."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from pathlib import Path

from rosbags.rosbag1 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from contact_sim_pkg.bag.errors import BagError, CorruptChunkError
from contact_sim_pkg.bag.metadata import CDR, RecordedTopic
from contact_sim_pkg.bag.parts.part import BagMessage, add_topic
from contact_sim_pkg.bag.typestore import HEADER, installed_types

__all__ = ["ROS1", "FromRos1", "Ros1Part"]

ROS1 = "ros1"
"""encoding of the messages of ROS 1 in an MCAP file"""


class FromRos1:
    """Converts the messages of a type: its header loses its number, all else stays."""

    encoding = CDR

    def __init__(self, type_name: str, text: str) -> None:
        """Type by its name and definition in ROS 1. What cannot be used has no definition: its messages are not read."""
        self.type, self.definition = type_name, ""
        self._store = get_typestore(Stores.EMPTY)
        try:
            package, _, name = type_name.replace("/msg/", "/").partition("/")
            self.type = f"{package}/msg/{name}"
            types = get_types_from_msg(text, self.type)
            types[HEADER] = installed_types().fielddefs[HEADER]
            self._store.register(types)
            self.definition = self._store.generate_msgdef(self.type, ros_version=2)[0]
        except Exception:  # noqa: BLE001 - parsers of foreign definitions raise errors of many kinds
            self.definition = ""

    def converted(self, data: bytes, place: str) -> bytes:
        """A message as CDR; CorruptChunkError where it does not fit its definition."""
        try:
            return bytes(self._store.ros1_to_cdr(data, self.type))
        except Exception as error:  # noqa: BLE001 - the generated parsers raise errors of many kinds
            raise CorruptChunkError(f"{place} does not fit its definition: {error!r:.200}", 0, 0) from None


class Ros1Part:
    """See `Part`: a `.bag`."""

    def __init__(self, path: Path) -> None:
        """Read the index of the file; BagError where it has none."""
        self.path, self.attachments = path, 0
        self.notes: list[str] = []
        self.texts: list[tuple[str, Mapping[str, str]]] = []
        self.topics: dict[str, RecordedTopic] = {}
        self.counts: dict[str, int] = {}
        self._converters: dict[str, FromRos1] = {}
        self._reader = Reader(path)
        try:
            self._reader.open()
        except Exception as error:  # noqa: BLE001 - the parser meets damaged bytes with errors of many kinds
            raise BagError(
                f"the bag {path} cannot be read: {str(error).rstrip('.') or type(error).__name__}; "
                "`rosbag reindex` makes it whole where it was cut off"
            ) from None
        for each in self._reader.connections:
            converter = self._converters.setdefault(each.topic, FromRos1(each.msgtype, each.msgdef.data))
            add_topic(
                self.topics, RecordedTopic(each.topic, each.topic, converter.type, converter.definition, "", ""), path
            )
            self.counts[each.topic] = self.counts.get(each.topic, 0) + each.msgcount
        self.begin = self._reader.start_time if self._reader.message_count else 0
        self.end = self._reader.end_time - 1 if self._reader.message_count else 0

    def messages(
        self, names: AbstractSet[str], epoch: int, damaged: Callable[[CorruptChunkError], None]
    ) -> Iterator[BagMessage]:
        """See `Part`."""
        wanted = [each for each in self._reader.connections if each.topic in names]
        if not wanted:
            return
        numbers = dict.fromkeys(names, 0)
        try:
            for connection, time, data in self._reader.messages(wanted):
                name, number = connection.topic, numbers[connection.topic]
                numbers[name] += 1
                converted = self._converters[name].converted(bytes(data), f"{self.path.name}: a message of {name}")
                yield BagMessage(name, self._converters[name].type, time - epoch, converted, time - epoch, number)
        except CorruptChunkError as error:
            damaged(error)
        except Exception as error:  # noqa: BLE001 - the parser meets damaged bytes with errors of many kinds
            damaged(CorruptChunkError(f"{self.path.name} is damaged: {error!r:.200}", 0, 0))
