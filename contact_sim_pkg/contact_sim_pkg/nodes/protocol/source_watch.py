"""The simulator's look at who publishes beside it while it runs: one publisher a topic, the one
that was there at *ready*.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from contact_sim_pkg.nodes.protocol.single_source import SingleSource
from contact_sim_pkg.nodes.protocol.states import FAULT, NodeError

NAME_SECONDS = 1.0  # for the graph to learn the name of a node that has sent a message
SILENT_SECONDS = 3.0  # that a second publisher may stay without a message: a second bench leaves within a second


class SourceWatch:
    """No block counts while a topic has a second publisher; what that one sends ends the run, and
    so does its staying.
    """

    def __init__(
        self, names: Mapping[str, str], count: Callable[[str], int], publishers: Callable[[str], Mapping[bytes, str]]
    ) -> None:
        """Nothing heard.

        Args:
            names: topic of an input -> its name in the graph. count: how many publishers of a topic
            the graph shows; asked for each block. publishers: the publishers of a topic, as
            `endpoints.publisher_ids` gives them; asked for when there are two.
        """
        self._in_graph = dict(names)
        self._sources = {topic: SingleSource() for topic in names}
        self._count, self._publishers = count, publishers
        self._own: dict[str, set[bytes]] = {}
        self._names = dict.fromkeys(self._sources, "")
        self._sent: dict[str, float] = {}  # topic -> when a second publisher's first message came
        self._seen: dict[str, float] = {}  # topic -> since when a second publisher is there

    def remember(self) -> None:
        """The publishers that are there now are those of the run."""
        self._own = {topic: set(self._publishers(name)) for topic, name in self._in_graph.items()}

    def accept(self, topic: str, number: int | None, now: float) -> bool:
        """Whether a message is of the run's publisher; `number` as the publisher gave it, `now` the
        steady clock, [s].
        """
        if self._sources[topic].accept(number, self._count(self._in_graph[topic])):
            return True
        self._sent.setdefault(topic, now)
        self._learn_name(topic)
        return False

    def alone(self, now: float) -> bool:
        """Whether the next block may count: every topic has one publisher, and nobody else has sent
        anything.

        Raises:
            NodeError: (fault) a second publisher has sent a message, or stays; its node and the
            topic are named.
        """
        for topic in self._sources:
            if self._count(self._in_graph[topic]) > 1:
                self._seen.setdefault(topic, now)
                self._learn_name(topic)
            elif topic not in self._sent:
                self._seen.pop(topic, None)
                self._names[topic] = ""
            self._refuse(topic, now)
        return not self._sent and not self._seen

    def _refuse(self, topic: str, now: float) -> None:
        sent = topic in self._sent and (self._names[topic] or now - self._sent[topic] > NAME_SECONDS)
        if sent or now - self._seen.get(topic, now) > SILENT_SECONDS:
            who = self._names[topic] or "a node whose name is not known"
            raise NodeError(
                f"{who} publishes {self._in_graph[topic]} beside the source of this run; one publisher is allowed, and "
                "nothing of the other one was taken. End it, or give this bench a ROS_DOMAIN_ID of its own",
                FAULT,
            )

    def _learn_name(self, topic: str) -> None:
        if not self._names[topic]:
            own = self._own.get(topic, set())
            strangers = {
                name for gid, name in self._publishers(self._in_graph[topic]).items() if gid not in own and name
            }
            self._names[topic] = ", ".join(sorted(strangers))
