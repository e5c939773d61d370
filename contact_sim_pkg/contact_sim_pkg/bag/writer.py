"""A bag under construction: one MCAP file in a new directory, and `metadata.yaml` beside it when it
is closed.

A chunk is closed 0.1 s (steady clock) after its first message or at 4 MiB, and handed to the
operating system at once, so `kill -9` loses at most 0.2 s of recording. The disk is synced at most
once a second, outside the lock, by a thread of the writer's own, which also guards the disk's
reserve; a caller that is busy with a block loses nothing by it.
"""

import threading
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import NamedTuple

from contact_sim_pkg.bag.errors import BagError, BagWriteError, RecordingStoppedError
from contact_sim_pkg.bag.mcap.append_file import AppendFile, create_directory, create_file, free_bytes_at, write_whole
from contact_sim_pkg.bag.mcap.chunked_file import ChunkedFile
from contact_sim_pkg.bag.mcap.layout import counts_on_disk
from contact_sim_pkg.bag.metadata import (
    OUTCOME,
    RECORD,
    RELATIVE_NAME,
    ROSBAG2,
    Extent,
    RecordedTopic,
    metadata_text,
    recorded_topics,
    sealed,
    serialized_metadata,
    wall_time_of,
)
from contact_sim_pkg.bag.names import file_name, refuse_wrong_name

CHUNK_SECONDS = 0.1  # age at which a chunk is closed
SYNC_SECONDS = 1.0  # between two syncs, and two looks at the free space
RESERVE_BYTES = 500_000_000
LIBRARY = "contact_bench"


class BagSummary(NamedTuple):
    """Content of a closed bag; `sentence` names what is missing, and is empty where nothing is."""

    path: Path
    messages: int
    counts: dict[str, int]
    complete: bool
    sentence: str


class BagWriter:
    """Writes encoded messages in the order in which they are given; may be used from several
    threads.
    """

    def __init__(
        self,
        directory: Path,
        topics: Sequence[RecordedTopic] | None = None,
        attachments: Mapping[str, str] | None = None,
        *,
        reserve_bytes: int = RESERVE_BYTES,
        clock: Callable[[], float] = time.monotonic,
        free_bytes: Callable[[], int] | None = None,
        background: bool = True,
    ) -> None:
        """Create the bag.

        Args:
            directory: the bag's directory, which must not exist.
            topics: what will be recorded; every recorded topic of the table, without a namespace,
                where it is None.
            attachments: texts kept in the bag and in `metadata.yaml`: scene, versions. With the key `wall_time` all
                times are stored that much later.
            reserve_bytes: free space of the disk, [bytes], below which the recording is closed.
            clock: steady clock, [s].
            free_bytes: free space of the disk, [bytes]; from the operating system where it is None.
            background: run `maintain` every 0.05 s in a thread; without it the caller does.

        Raises:
            BagError: the directory exists, cannot be created or have its name, or less than the reserve is free;
                nothing is left.
        """
        refuse_wrong_name(directory)
        free = free_bytes() if free_bytes else free_bytes_at(directory)
        if free < reserve_bytes:
            raise BagError(
                f"{_mega(free)} are free for {directory}, below the reserve of {_mega(reserve_bytes)}; "
                "free some space, or record to another disk"
            )
        self._topics = tuple(recorded_topics() if topics is None else topics)
        self._attachments = dict(attachments or {})
        self._epoch = wall_time_of(self._attachments)
        self._reserve, self._clock = reserve_bytes, clock
        create_directory(directory)
        self.path = directory
        self._name = file_name(directory)
        self._file: AppendFile = create_file(directory, self._name)
        self._free_bytes = free_bytes or self._file.free_bytes
        self._lock = threading.Lock()
        self._counts = {topic.key: 0 for topic in self._topics}
        self._chunk_opened: float | None = None
        self._looked = clock()
        self._fault: BagError | None = None
        self._summary: BagSummary | None = None
        self._content, self._channels = self._begin_or_remove()
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._maintain_until_closed, name="bag writer", daemon=True)
        if background:
            self._thread.start()

    def _begin_or_remove(self) -> tuple[ChunkedFile, dict[str, int]]:
        """Begin the file; where the disk refuses even that, leave nothing behind."""
        try:
            return self._begin()
        except BagWriteError:
            self._file.close()
            (self.path / self._name).unlink()
            self.path.rmdir()
            raise

    def _begin(self) -> tuple[ChunkedFile, dict[str, int]]:
        """Header, attachments, schemas and channels; the attachments stand in front, so a cut bag
        has them.
        """
        content = ChunkedFile(self._file, LIBRARY)
        if self._attachments:
            content.add_metadata(RECORD, sealed(self._attachments))
        return content, {topic.key: self._add_channel(content, topic) for topic in self._topics}

    @staticmethod
    def _add_channel(content: ChunkedFile, topic: RecordedTopic) -> int:
        kept = {"offered_qos_profiles": topic.offered_qos, "topic_type_hash": topic.type_hash}
        if topic.relative_name:
            kept[RELATIVE_NAME] = topic.relative_name
        return content.add_channel(topic.name, topic.encoding, topic.type, topic.definition, kept)

    def add_topic(self, topic: RecordedTopic) -> None:
        """Record another topic from now on; one that is recorded already stays as it is."""
        with self._lock:
            if topic.key not in self._channels:
                self._topics = (*self._topics, topic)
                self._counts[topic.key] = 0
                self._channels[topic.key] = self._add_channel(self._content, topic)

    @property
    def messages(self) -> int:
        """Messages written so far."""
        return sum(self._counts.values())

    @property
    def counts(self) -> dict[str, int]:
        """Messages written so far, by topic."""
        return dict(self._counts)

    def write(
        self, topic: str, log_time: int, data: bytes, *, publish_time: int | None = None, sequence: int | None = None
    ) -> None:
        """Append one message.

        Args:
            topic: key of the topic (`tire/force`).
            log_time: time of the record, [ns], from 0; the stamp of the message.
            data: encoded message.
            publish_time: [ns]; the log time where it is None.
            sequence: number of the message on its topic; counted from 0 where it is None.

        Raises:
            BagError: the topic is not of this bag, or the bag is closed.
            RecordingStoppedError: the disk went below its reserve; the bag was closed properly.
            BagWriteError: the disk refused a write; the bag ends with its last whole chunk.
        """
        with self._lock:
            self._append([(topic, log_time, data)], publish_time, sequence)

    def write_all(self, messages: Iterable[tuple[str, int, bytes]]) -> None:
        """Append messages: of each its topic, log time and data. Raises as `write`."""
        with self._lock:
            self._append(messages)

    def _append(
        self, messages: Iterable[tuple[str, int, bytes]], publish_time: int | None = None, sequence: int | None = None
    ) -> None:
        """Append messages, under the lock; counts grow only once the file has accepted a message."""
        self._refuse_if_ended()
        self._chunk_opened = self._clock() if self._chunk_opened is None else self._chunk_opened
        try:
            for topic, log_time, data in messages:
                channel = self._channels.get(topic)
                if channel is None:
                    raise BagError(
                        f"topic {topic!r} is not recorded in {self.path}; recorded are {', '.join(self._channels)}"
                    )
                number = self._counts[topic] if sequence is None else sequence
                logged = self._epoch + log_time
                published = logged if publish_time is None else self._epoch + publish_time
                self._content.add_message(channel, number, logged, published, data)
                self._counts[topic] += 1
            self._close_chunk_if_due()
        except BagWriteError as error:
            self._fault = error
            raise

    def maintain(self) -> None:
        """Close the chunk, sync the disk and look at its free space, each if it is due."""
        with self._lock:
            if self._fault or self._summary:
                return
            try:
                self._close_chunk_if_due()
                if self._clock() - self._looked < SYNC_SECONDS:
                    return
                self._looked = self._clock()
                self._stop_if_below_reserve()
            except BagWriteError as error:
                self._fault = error
                return
        try:
            self._file.sync()  # outside the lock: a slow disk must not hold up `write`
        except BagWriteError as error:
            self._fault = error

    def close(self, outcome: Mapping[str, str] | None = None) -> BagSummary:
        """End the bag and check it: the file is opened again and its counts compared with those
        kept here.

        Args:
            outcome: texts to keep beside the attachments: how the run ended, what was dropped.

        Returns:
            Content of the bag. `complete` is False where a write failed, the disk's reserve was
            reached, or the file does not hold what was written; `sentence` names it. A second
            call returns the same.
        """
        self._closing.set()
        if self._thread.is_alive():
            self._thread.join()
        with self._lock:
            if self._summary is None:
                self._finish(dict(outcome or {}))
            assert self._summary is not None
            return self._summary

    def __enter__(self) -> "BagWriter":
        """The writer itself."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close the bag, also after an error."""
        self.close()

    def _maintain_until_closed(self) -> None:
        while not self._closing.wait(CHUNK_SECONDS / 2):
            self.maintain()

    def _refuse_if_ended(self) -> None:
        if self._fault is not None:
            raise type(self._fault)(str(self._fault))
        if self._summary is not None:
            raise BagError(f"{self.path} is closed; nothing can be added")

    def _close_chunk_if_due(self) -> None:
        if self._chunk_opened is not None and self._clock() - self._chunk_opened >= CHUNK_SECONDS:
            self._content.end_chunk()
            self._chunk_opened = None

    def _stop_if_below_reserve(self) -> None:
        free = self._free_bytes()
        if free < self._reserve:
            sentence = f"recording stopped: disk: {_mega(free)} are free, below the reserve of {_mega(self._reserve)}"
            self._finish({"stopped": sentence}, sentence)
            self._fault = RecordingStoppedError(sentence)

    def _finish(self, outcome: dict[str, str], stopped: str = "") -> None:
        """Write the end, close the file, compare its content with the counts; called once, under
        the lock.
        """
        reasons = [stopped, str(self._fault) if self._fault else self._write_end(outcome)]
        try:
            self._file.sync()
            self._file.close()
        except BagWriteError as error:
            reasons.append(str(error))
        names = {topic.name: topic.key for topic in self._topics}
        found, whole = counts_on_disk(self.path / self._name)
        counts = {key: found.get(name, 0) for name, key in names.items()}
        if counts != self._counts or not whole:
            ending = "" if whole else " and is not whole"
            reasons.append(f"the bag holds {sum(counts.values())} of {self.messages} messages{ending}")
        sentence = "; ".join(dict.fromkeys(reason for reason in reasons if reason))
        self._summary = BagSummary(self.path, sum(counts.values()), counts, not sentence, sentence)

    def _write_end(self, outcome: dict[str, str]) -> str:
        """Summary of the file and `metadata.yaml`; the sentence of a failure, or an empty one."""
        custom = {**self._attachments, **outcome}
        try:
            self._content.end_chunk()
            content = (self._name, self._topics, self._counts, Extent(*self._content.extent), custom)
            if outcome:
                self._content.add_metadata(OUTCOME, sealed(outcome))
            self._content.add_metadata(ROSBAG2, serialized_metadata(*content))
            self._content.finish()
            self._file.sync()
            write_whole(self.path, "metadata.yaml", metadata_text(*content))
        except BagWriteError as error:
            return str(error)
        return ""


def _mega(size: int) -> str:
    return f"{size / 1e6:.0f} MB"
