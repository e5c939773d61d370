"""The subscribers of a replay: those that are there when it begins are matched before the first
message.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.topic_endpoint_info import TopicEndpointInfo

from contact_sim_pkg.nodes.protocol.endpoints import UNKNOWN, describe_endpoint, why_not_served

QUIET_SECONDS = 0.5  # without news of the graph before it counts as known
BUSY_SECONDS = 0.2  # between two looks: the machine is busy, and others may not have answered yet
NOBODY_SECONDS = 3.0  # for the first subscriber: the period at which DDS announces a process again
LONGEST_SECONDS = 10.0  # for the subscribers that are known to be matched


class Audience:
    """The subscriptions of some topics, as the graph shows them and as the publishers are matched
    with them.
    """

    def __init__(self, node: Node, publishers: Mapping[str, Publisher], delay: float) -> None:
        """Look from `node`; `delay` is the least time to wait, [s]."""
        self._node, self._publishers, self._delay = node, publishers, delay
        self._seen: Any = None
        self._changed_at = self._began = self._looked = float("-inf")
        self._unfit: set[str] = set()

    def is_complete(self, now: float) -> bool:
        """Whether the graph has been quiet for a while and everybody in it that can be matched is;
        `now`: steady clock, [s].
        """
        if self._seen is None:
            self._began = now
        busy, self._looked = now - self._looked > BUSY_SECONDS, now
        wanted = {name: len(self._fitting(name)) for name in self._publishers}
        matched = {name: entry.get_subscription_count() for name, entry in self._publishers.items()}
        seen = (sorted(self._node.get_node_names_and_namespaces()), wanted, matched)
        if busy or seen != self._seen:
            self._seen, self._changed_at = seen, now
        lacking = [name for name, count in wanted.items() if matched[name] < count]
        if now - self._began > self._delay + LONGEST_SECONDS:
            if lacking:
                self._node.get_logger().warning(f"begins without some subscribers of {', '.join(lacking)}")
            return True
        least = self._delay if any(matched.values()) else max(self._delay, NOBODY_SECONDS)
        return now - self._began >= least and now - self._changed_at >= QUIET_SECONDS and not lacking

    def count(self) -> tuple[int, int]:
        """Subscriptions that are matched, and topics that have one."""
        matched = [entry.get_subscription_count() for entry in self._publishers.values()]
        return sum(matched), sum(count > 0 for count in matched)

    def _fitting(self, name: str) -> list[TopicEndpointInfo]:
        """Subscriptions that this quality of service can serve; the others are named once."""
        entry = self._publishers[name]
        fitting = []
        for info in self._node.get_subscriptions_info_by_topic(entry.topic_name):
            reason = why_not_served(entry.qos_profile, info.qos_profile)
            if not reason:
                fitting.append(info)
            elif UNKNOWN not in info.node_name:
                sentence = f"{describe_endpoint(info)} gets nothing of {entry.topic_name}: {reason}"
                if sentence not in self._unfit:
                    self._unfit.add(sentence)
                    self._node.get_logger().warning(sentence)
        return fitting
