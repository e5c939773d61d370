"""The node of the view: what RViz, Foxglove, PlotJuggler and rqt show, made while somebody reads it."""

from __future__ import annotations

import sys
import time
from collections import Counter
from functools import partial

from rclpy.event_handler import PublisherEventCallbacks
from rclpy.publisher import Publisher
from rclpy.subscription import Subscription

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.messages import decode, stamp_of
from contact_sim_pkg.bag.texts import scene_of_text
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.nodes.bench_node import LifecycleBenchNode
from contact_sim_pkg.nodes.parameters import declare
from contact_sim_pkg.nodes.processes.process import run
from contact_sim_pkg.nodes.protocol.endpoints import message_type, profile_of, viewing_subscription
from contact_sim_pkg.nodes.protocol.pacing import RateLimit
from contact_sim_pkg.nodes.protocol.states import MALFORMED, NodeError
from contact_sim_pkg.records.messages import String
from contact_sim_pkg.standard.convert import Converter, record_type
from contact_sim_pkg.standard.messages import encoded
from contact_sim_pkg.standard.topics import RATE, SCENE, StandardTopic, standard_topics

LOOK_SECONDS = 1.0  # between two looks at the graph for topics of a run
LONGEST_GATHER = 0.05  # [s]; signals are looked at as often
RATE_TEXT = "Messages of a topic a second of the steady clock, at most."


class BenchViewNode(LifecycleBenchNode):
    """Publishes `view/…` and `/tf` below its namespace, of runs and of replays, one after the other.

    A topic of the bench is subscribed to while a topic made from it has a reader, and only its newest
    message is taken. Nobody waits for this node, and the simulator's deliveries to it are best effort.
    """

    def __init__(self) -> None:
        """Declare the parameters."""
        super().__init__("bench_view")
        self._rate = declare(self, "rate", RATE, RATE_TEXT, (0.1, 100.0))
        self.gather = min(1.0 / self._rate, LONGEST_GATHER)
        self._forget()

    def _forget(self) -> None:
        self._present: set[str] = set()
        self._offered: dict[str, Publisher] = {}
        self._without: set[str] = set()  # standard topics whose type is not installed
        self._read: set[str] = set()  # standard topics with a reader
        self._sources: dict[str, Subscription] = {}
        self._dropped = Counter[str]()
        self._limit = RateLimit(self._rate, 0.5 * self.gather)
        self._converter = Converter(())
        self._changed = self._knows_scene = False
        self._looked = float("-inf")

    def configure(self) -> None:
        """Begin without a topic: the graph says which there are."""
        self._forget()

    def close(self) -> None:
        """Forget the publishers and subscriptions, which are destroyed next."""
        self._forget()

    def tick(self, now: float) -> float:
        """Offer what the topics in the graph can be shown as; follow those that are read."""
        if self.active and now - self._looked > LOOK_SECONDS:
            self._looked = now
            self._offer_what_is_there()
        if self._changed:
            self._changed = False
            self._follow_what_is_read()
        return LONGEST_GATHER

    def _offer_what_is_there(self) -> None:
        names = {name for name, _types in self.get_topic_names_and_types()}
        present = {
            name for name in TOPICS
            if TOPICS[name].recorded and self.resolve_topic_name(name) in names and self.count_publishers(name)
        } | self._present  # fmt: skip
        if present == self._present:
            return
        self._present = present
        self._converter.offer(present)
        for topic in standard_topics(present).values():
            if topic.name not in self._offered and topic.name not in self._without:
                self._offer(topic)
        self._changed = True  # a source of a topic that is read already may be new

    def _offer(self, topic: StandardTopic) -> None:
        events = PublisherEventCallbacks(matched=partial(self._on_matched, topic.name), use_default_callbacks=False)
        try:
            kind = message_type(topic.type)
        except NodeError as error:
            self.get_logger().warning(f"{topic.name} is left out: {error}")
            self._without.add(topic.name)
            return
        self._offered[topic.name] = self.create_publisher(
            kind, topic.name, profile_of(topic.row), event_callbacks=events
        )

    def _on_matched(self, name: str, status: object) -> None:
        """A reader has come or gone."""
        is_read = getattr(status, "current_count") > 0  # noqa: B009  # the status has no type
        (self._read.add if is_read else self._read.discard)(name)
        self._changed = True

    def _follow_what_is_read(self) -> None:
        """Subscribe to what the topics that are read are made from, and to nothing else."""
        topics = self._converter.topics
        wanted = {source for name in self._read if name in topics for source in topics[name].sources} & self._present
        for source in [source for source in self._sources if source not in wanted]:
            self.destroy_subscription(self._sources.pop(source))
        for source in wanted - self._sources.keys():
            receive = self._on_scene if source == SCENE else partial(self._on_message, source)
            self._sources[source] = viewing_subscription(self, source, receive)
        self._knows_scene = self._knows_scene and SCENE in self._sources

    def _on_scene(self, data: bytes) -> None:
        """Where the bodies are; a scene that cannot be read leaves them at the origin."""
        try:
            self._converter.take_scene(scene_of_text(decode(String, data).data, "the scene of the run"))
        except BagError as error:
            self.get_logger().warning(f"frames rest at the origin, the scene cannot be used: {error}")
        self._knows_scene = True

    def _on_message(self, source: str, data: bytes) -> None:
        """Show one message, unless one of its topic was shown a moment ago; drop and count a malformed one."""
        if not self.active or not self._limit.passes(source, time.monotonic()):
            return
        wanted = [
            name for name in self._read
            if name in self._converter.topics and (self._knows_scene or not self._converter.topics[name].places)
        ]  # fmt: skip
        try:
            record = decode(record_type(source), data)
            for shown in self._converter.convert(source, stamp_of(data), record, wanted):
                self._offered[shown.topic].publish(encoded(shown.message))
        except MALFORMED as error:
            self._dropped[source] += 1
            self.get_logger().warning(
                f"{source}: {error}; dropped ({self._dropped[source]} so far)", throttle_duration_sec=1.0
            )


def main() -> int:
    """Run the node; returns the exit status."""
    return run(BenchViewNode)


if __name__ == "__main__":
    sys.exit(main())
