"""A recorded bag as a new one of standard messages, which every tool of ROS reads."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from heapq import heappop, heappush
from pathlib import Path
from typing import Any, NamedTuple

from contact_sim_pkg.bag.encoding import SECOND
from contact_sim_pkg.bag.errors import BagError, MessageError
from contact_sim_pkg.bag.messages import decode, record_of
from contact_sim_pkg.bag.metadata import RecordedTopic
from contact_sim_pkg.bag.names import refuse_wrong_name
from contact_sim_pkg.bag.reader import Bag, BagMessage
from contact_sim_pkg.bag.texts import scene_of_text
from contact_sim_pkg.bag.topics import TOPICS, full_name, offered_qos
from contact_sim_pkg.bag.writer import BagSummary, BagWriter
from contact_sim_pkg.records.definitions import PACKAGE
from contact_sim_pkg.standard.convert import Converter, has_samples, record_type, sample_stamps
from contact_sim_pkg.standard.messages import definition, encoded, type_hash
from contact_sim_pkg.standard.topics import RATE, StandardTopic, wrench_topics

__all__ = ["export_standard"]

SOURCE_KEY = "exported_from"
"""Of the texts in the bag: name of the recorded one."""


def export_standard(
    bag: Bag, directory: Path, *, rate: float = RATE, texts: Mapping[str, str] | None = None
) -> BagSummary:
    """Write the standard messages of a bag into a new one; wrenches of contacts, which are standard, are copied.

    Args:
        bag: to read; its namespace is kept.
        directory: of the new bag, which must not exist.
        rate: messages of a topic a simulated second at most, [Hz].
        texts: to keep in the bag.

    Raises BagError where there is nothing to show, or the directory cannot be made.
    """
    names = {name: bag.topic(name).name for name in TOPICS if name in bag and bag.count(name)}
    converter = Converter(names, scene_of_text(bag.scene, f"the scene of {bag.path}"))
    if not converter.topics:
        raise BagError(
            f"{bag.path} has no topic that a standard message shows; it has {', '.join(bag.topics) or 'none'}"
        )
    namespace = next(full.removesuffix(name).strip("/") for name, full in names.items())
    copied = [names[name] for name in wrench_topics(names).values()]
    refuse_wrong_name(directory)
    topics = [
        *(_recorded(topic, namespace) for topic in converter.topics.values()),
        *(bag.topics[name] for name in copied),
    ]
    with BagWriter(directory, topics, {SOURCE_KEY: bag.path.parent.name, **(texts or {})}) as writer:
        shown = _Shown(bag, converter, {full: name for name, full in names.items()}, copied, rate)
        for each in shown.in_order():
            writer.write(each.topic, each.stamp, each.data)
        return writer.close()


class _Written(NamedTuple):
    stamp: int
    number: int  # keeps the order of equal stamps
    topic: str
    data: bytes


class _Shown:
    """The standard messages of a bag in the order of their stamps."""

    def __init__(self, bag: Bag, converter: Converter, sources: dict[str, str], copied: list[str], rate: float) -> None:
        self._bag, self._converter, self._sources, self._copied, self._rate = bag, converter, sources, copied, rate
        self._shown_period: dict[str, int] = {}
        self._pending: list[_Written] = []
        self._number = 0

    def in_order(self) -> Iterator[_Written]:
        """A block's samples are held back until the bag has come to their stamps."""
        for message in self._bag.messages():
            while self._pending and self._pending[0].stamp <= message.log_time:
                yield heappop(self._pending)
            if message.topic in self._copied:
                self._add(message.log_time, message.topic, message.data)
            if message.topic in self._sources:
                self._convert(self._sources[message.topic], message)
        while self._pending:
            yield heappop(self._pending)

    def _convert(self, source: str, message: BagMessage) -> None:
        wanted = [name for name, topic in self._converter.topics.items() if source in topic.sources]
        if not wanted or (not has_samples(source) and not self._is_due(source, message.log_time)):
            return
        record = _record(self._bag, source, message)
        samples = [
            place for place, stamp in enumerate(sample_stamps(record, message.log_time)) if self._is_due(source, stamp)
        ] if has_samples(source) else [0]  # fmt: skip
        for shown in self._converter.convert(source, message.log_time, record, wanted, samples):
            self._add(shown.stamp, shown.topic, encoded(shown.message))

    def _is_due(self, source: str, stamp: int) -> bool:
        """Whether nothing of a source has been shown yet in the period of 1/rate that a stamp [ns] lies in."""
        period = int(stamp * self._rate // SECOND)
        is_due = period > self._shown_period.get(source, -1)
        self._shown_period[source] = max(period, self._shown_period.get(source, -1))
        return is_due

    def _add(self, stamp: int, topic: str, data: bytes) -> None:
        self._number += 1
        heappush(self._pending, _Written(stamp, self._number, topic, data))


def _record(bag: Bag, source: str, message: BagMessage) -> Any:
    """By the bag's own definition; of a standard type, which has but one, by ours."""
    kind = record_type(source)
    if not TOPICS[source].type.startswith(PACKAGE):
        return decode(kind, message.data)
    try:
        return record_of(kind, bag.decode(message))
    except AttributeError as error:
        raise MessageError(f"{bag.path}: {message.topic} was recorded by another definition: {error}") from None


def _recorded(topic: StandardTopic, namespace: str) -> RecordedTopic:
    return RecordedTopic(
        topic.name,
        full_name(topic.name, namespace),
        topic.type,
        definition(topic.type),
        type_hash(topic.type),
        offered_qos(topic.row),
    )
