"""The other nodes of a run: who must be in the graph before block 0 may be sent, and who must not,
then or later.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.subscription import Subscription
from rclpy.topic_endpoint_info import TopicEndpointInfo

from contact_sim_pkg.nodes.protocol.endpoints import publisher_ids, refuse_strangers, why_not_served
from contact_sim_pkg.nodes.protocol.single_source import SourceWatch

NAME_SECONDS = 3.0  # for the graph to learn a stranger's name before it is refused without one
REPORT_SECONDS = 5.0  # between two log lines about who is missing
RESULTS_SECONDS = 0.05  # between two looks for other publishers of our results: 4 us a topic, and the logger sees them


class Peers:
    """The simulator's view of the other nodes of its run."""

    def __init__(
        self,
        node: Node,
        inputs: Mapping[str, Subscription],
        outputs: Mapping[str, Publisher],
        progress: Publisher,
        recorded: Subscription | None,
        *,
        supervised: bool,
    ) -> None:
        """Look from `node` at its own subscriptions and publishers; `recorded` is None where
        nothing is recorded.

        A supervisor (`supervised`) must follow the progress too, or it would take a short run for
        a silent one.
        """
        self._node, self._inputs, self._outputs = node, inputs, outputs
        self._progress, self._recorded = progress, recorded
        self._began = self._reported = float("-inf")  # before the first look
        self._followers = len(inputs) + (recorded is not None) + supervised
        watch = partial(SourceWatch, count=node.count_publishers, publishers=partial(publisher_ids, node))
        self.sources = watch({topic: entry.topic_name for topic, entry in inputs.items()})
        self._results = watch({topic: entry.topic_name for topic, entry in outputs.items()}, interval=RESULTS_SECONDS)

    def complete(self, now: float) -> bool:
        """Whether everybody is there at `now` of the steady clock, [s]; the log names who is
        missing.

        The publishers that are there are then those of the run.

        Raises:
            NodeError: (refused) a second publisher on an input or an output, a second bench, or
                another message definition.
        """
        # names are waited for from the first look: the compilation before it may last minutes
        if self._began < 0.0:
            self._began = self._reported = now
        absent = self._missing(unnamed=now - self._began > NAME_SECONDS)
        if not absent:
            self.sources.store_own()
            self._results.store_own()
        elif now - self._reported > REPORT_SECONDS:
            self._reported = now
            self._node.get_logger().info(f"waiting for {', '.join(absent)}")
        return not absent

    def _missing(self, *, unnamed: bool) -> list[str]:
        """Phrases for what is not matched yet; `unnamed`: refuse strangers without a name too."""
        checked = [
            *self._inputs,
            *self._outputs,
            "bench/progress",
            *([] if self._recorded is None else ["bench/recorded"]),
        ]
        absent = [
            f"the names of {t}'s publishers" for t in checked if not refuse_strangers(self._node, t, unnamed=unnamed)
        ]
        # matched publishers of the inputs, followers of the progress, then logger and its
        # subscriptions
        absent += [
            f"a publisher of {topic}" for topic, entry in self._inputs.items() if _publishers(self._node, entry) < 1
        ]
        if self._progress.get_subscription_count() < self._followers:
            absent.append(f"{self._followers} subscribers of bench/progress")
        if self._recorded is not None:
            absent += [] if _publishers(self._node, self._recorded) else ["a publisher of bench/recorded (bag_logger)"]
            loggers = {_node_of(info) for info in self._node.get_publishers_info_by_topic("bench/recorded")}
            absent += [
                f"a recorder of {topic}"
                for topic, entry in self._outputs.items()
                if entry.get_subscription_count() < 1 or not (unnamed or self._is_recorded(entry, loggers))
            ]
        return absent

    def _is_recorded(self, entry: Publisher, loggers: set[tuple[str, str]]) -> bool:
        """Whether the logger is among the subscribers, and everybody who can be served is matched: a viewer that was
        there before is no recorder.
        """
        infos = self._node.get_subscriptions_info_by_topic(entry.topic_name)
        served = [info for info in infos if not why_not_served(entry.qos_profile, info.qos_profile)]
        return any(_node_of(info) in loggers for info in served) and entry.get_subscription_count() >= len(served)

    def alone(self, now: float) -> bool:
        """Whether nobody else publishes results or inputs of the run at `now` of the steady clock,
        [s].

        Raises NodeError (fault) as `SourceWatch.alone`.
        """
        return self._results.alone(now) and self.sources.alone(now)


def _node_of(info: TopicEndpointInfo) -> tuple[str, str]:
    return info.node_name, info.node_namespace


def _publishers(node: Node, subscription: Subscription) -> int:
    return int(node.count_publishers(subscription.topic_name))
