"""One publisher a topic: messages of a second one are recognised by their numbers, and its node by
the graph. Without ROS.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from contact_sim_pkg.nodes.protocol.states import FAULT, NodeError

NAME_SECONDS = 1.0  # for the graph to learn the name of a node that has sent a message
SILENT_SECONDS = 3.0  # that a second publisher may stay without a message: a second bench leaves within a second


class SingleSource:
    """Separates the messages of a run's publisher from those of another one.

    A publisher numbers its own messages 1, 2, 3, …, whatever their content, and reliable delivery
    keeps their order. So the messages of one publisher rise by one each. Those of a second one
    repeat numbers, fall behind, or leap; a leap is also what lost messages look like, and then the
    graph decides: it knows a publisher before its first message is delivered. A second one that
    sends as many as the run before the run is ended for it bears the next number once, and that
    message passes for the run's.
    """

    def __init__(self) -> None:
        """No message yet."""
        self._last = 0

    def accept(self, number: int | None, count: Callable[[], int]) -> bool:
        """Whether a message is of the run's publisher.

        Args:
            number: the publisher's own number of the message, from 1; None where the middleware
                does not number.
            count: number of publishers of the topic in the graph now, 0 where the publisher has
                left meanwhile; called where the number alone does not decide.
        """
        if number is None:
            return count() <= 1
        follows = self._last > 0 and number == self._last + 1
        if not follows and (number <= self._last or count() > 1):
            return False
        self._last = number
        return True


class SourceWatch:
    """Ends a run whose topics get a second publisher: at its first message, or when it stays.

    No block counts meanwhile.
    """

    def __init__(
        self, names: Mapping[str, str], count: Callable[[str], int], publishers: Callable[[str], Mapping[bytes, str]],
        *, interval: float = 0.0,
    ) -> None:  # fmt: skip
        """No message yet.

        Args:
            names: topic -> its name in the graph.
            count: number of publishers of a topic in the graph; called at every look.
            publishers: publishers of a topic as `endpoints.publisher_ids` returns them; called
                where there are two.
            interval: least time between two looks at the graph, [s].
        """
        self._in_graph = dict(names)
        self._sources = {topic: SingleSource() for topic in names}
        self._count, self._publishers = count, publishers
        self._own: dict[str, set[bytes]] = {}
        self._names = dict.fromkeys(self._sources, "")
        self._sent: dict[str, float] = {}  # topic -> when a second publisher's first message came
        self._seen: dict[str, float] = {}  # topic -> since when a second publisher is there
        self._interval, self._looked = interval, float("-inf")

    def store_own(self) -> None:
        """Store the publishers that are in the graph now as those of the run."""
        self._own = {topic: set(self._publishers(name)) for topic, name in self._in_graph.items()}

    def accept(self, topic: str, number: int | None, now: float) -> bool:
        """Whether a message is of the run's publisher; `number` as the publisher gave it, `now` the
        steady clock, [s].
        """
        if self._sources[topic].accept(number, lambda: self._count(self._in_graph[topic])):
            return True
        self._sent.setdefault(topic, now)
        self._learn_name(topic)
        return False

    def alone(self, now: float) -> bool:
        """Whether the next block may count: every topic has one publisher, and nobody else has sent
        anything; `now`: steady clock, [s].

        Raises:
            NodeError: (fault) a second publisher has sent a message, or stays; its node and the
                topic are named.
        """
        if now - self._looked < self._interval:
            return not self._sent and not self._seen
        self._looked = now
        # a second publisher in the graph is forgiven where it leaves again without a message
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
