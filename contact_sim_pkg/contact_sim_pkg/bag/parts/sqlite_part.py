"""An SQLite file of a bag (`.db3`), whole or cut off."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from contextlib import closing
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import quote

from contact_sim_pkg.bag.errors import BagError, CorruptChunkError
from contact_sim_pkg.bag.metadata import CDR, RecordedTopic
from contact_sim_pkg.bag.parts.part import ZSTD_MAGIC, BagMessage, add_topic, unpacked
from contact_sim_pkg.bag.parts.sqlite_pages import rows_of_pages
from contact_sim_pkg.bag.typestore import ros2msg_text, text_of_known

__all__ = ["SqlitePart"]


class _Row(NamedTuple):
    """One row of the table of messages; time in [ns]."""

    number: int
    topic: int
    time: int
    data: bytes


class SqlitePart:
    """See `Part`. Messages come in the order in which they were written."""

    def __init__(self, path: Path) -> None:
        """Read the tables of topics and definitions; BagError where they cannot be read."""
        self.path, self.attachments = path, 0
        self.notes: list[str] = []
        self.texts: list[tuple[str, Mapping[str, str]]] = []
        self.topics: dict[str, RecordedTopic] = {}
        self._names: dict[int, str] = {}
        self._damaged = False
        try:
            with closing(self._connect()) as database:
                for number, row in self._topics(database):
                    add_topic(self.topics, row, path)
                    self._names[number] = row.name
        except (sqlite3.Error, TypeError, UnicodeDecodeError) as error:
            raise BagError(f"the bag {path} cannot be read: {error}; give the directory or the file of a bag") from None
        self.counts, self.begin, self.end = self._counted()
        journal = path.with_name(f"{path.name}-wal")
        if journal.exists() and journal.stat().st_size:
            self.notes.append(
                f"{journal.name} beside {path.name} holds messages that are not read; "
                f"`sqlite3 {path.name} 'pragma wal_checkpoint'` takes them over"
            )

    def _connect(self) -> sqlite3.Connection:
        database = sqlite3.connect(f"file:{quote(str(self.path.absolute()))}?immutable=1", uri=True)
        database.text_factory = lambda data: data.decode("utf-8", "replace")
        database.execute("PRAGMA writable_schema=ON")  # a file that is shorter than it states is read as far as it goes
        return database

    def _topics(self, database: sqlite3.Connection) -> Iterator[tuple[int, RecordedTopic]]:
        """Number and row of each topic; the columns depend on the version of rosbag2."""
        columns = {name for _, name, *_ in database.execute("PRAGMA table_info(topics)")}
        wanted = ("id", "name", "type", "serialization_format", "offered_qos_profiles", "type_description_hash")
        select = ", ".join(name if name in columns else f"'' AS {name}" for name in wanted)
        definitions: dict[str, tuple[str, str]] = {}
        if next(database.execute("SELECT 1 FROM sqlite_master WHERE name = 'message_definitions'"), None):
            definitions = {
                name: (text, encoding)
                for name, encoding, text in database.execute(
                    "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions"
                )
            }
        for number, name, kind, encoding, quality, type_hash in database.execute(f"SELECT {select} FROM topics"):  # noqa: S608 - names of ours
            text = ros2msg_text(kind, *definitions[kind]) if definitions.get(kind, ("",))[0] else text_of_known(kind)
            yield number, RecordedTopic(name, name, kind, text, type_hash, quality, "", encoding or CDR)

    def _counted(self) -> tuple[dict[str, int], int, int]:
        """Messages by topic, the earliest and the latest time; of a damaged file, of what can be read."""
        counts, times = dict.fromkeys(self.topics, 0), [0]
        try:
            with closing(self._connect()) as database:
                for number, count, earliest, latest in database.execute(
                    "SELECT topic_id, count(*), min(timestamp), max(timestamp) FROM messages GROUP BY topic_id"
                ):
                    counts[self._names.get(number, "")] = count
                    times += [earliest, latest]
        except (sqlite3.Error, TypeError):
            self._damaged = True
            for row in rows_of_pages(self.path):
                name = self._names.get(row[1], "")
                counts[name] = counts.get(name, 0) + 1
                times.append(row[2])
            self.notes.append(f"{self.path.name} holds {sum(counts.values())} messages: it was cut off or is damaged")
        unknown = counts.pop("", 0)
        if unknown:
            self.notes.append(f"{unknown} messages of {self.path.name} belong to no topic and are not read")
        return counts, min(times[1:], default=0), max(times)

    def _rows(self) -> Iterator[_Row]:
        if self._damaged:
            yield from map(_Row._make, rows_of_pages(self.path))
            return
        with closing(self._connect()) as database:
            rows: Iterator[Any] = database.execute("SELECT id, topic_id, timestamp, data FROM messages ORDER BY id")
            yield from map(_Row._make, rows)

    def messages(
        self, names: AbstractSet[str], epoch: int, damaged: Callable[[CorruptChunkError], None]
    ) -> Iterator[BagMessage]:
        """See `Part`."""
        wanted = {number: self.topics[name] for number, name in self._names.items() if name in names}
        numbers = dict.fromkeys(wanted, 0)
        try:
            for row in self._rows():
                if row.topic not in wanted:
                    continue
                topic, number, data = wanted[row.topic], numbers[row.topic], row.data
                numbers[row.topic] += 1
                if data.startswith(ZSTD_MAGIC):
                    data = unpacked(data, f"{self.path.name}: message {row.number}")
                yield BagMessage(topic.name, topic.type, row.time - epoch, data, row.time - epoch, number)
        except CorruptChunkError as error:
            damaged(error)
        except sqlite3.Error as error:
            damaged(CorruptChunkError(f"{self.path.name} is damaged: {error}", 0, 0))
