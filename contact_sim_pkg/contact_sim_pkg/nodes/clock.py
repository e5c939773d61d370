"""The simulator's `/clock`: one source on the graph, for several give jumps back to whoever listens."""

from __future__ import annotations

from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.topic_endpoint_info import TopicEndpointInfo

from contact_sim_pkg.bag.messages import encode_clock

from .endpoints import UNKNOWN, describe_endpoint, publisher

CLOCK = "/clock"
LOOK_SECONDS = 0.5  # between two looks at the graph


class SimulatedClock:
    """Publishes simulated time as long as nobody else publishes a clock; says once that it does not, and why.

    Whoever comes second gives way. Of two simulators that began at the same moment the one with the smaller identifier stays;
    a clock from elsewhere (a replay, another simulator) stays in any case.
    """

    def __init__(self, node: Node, *, wanted: bool) -> None:
        """Nothing is published before `start`."""
        self._node, self._wanted = node, wanted
        self._publisher: Publisher | None = None
        self._looked = 0.0

    def start(self) -> None:
        """Begin, unless somebody publishes a clock already."""
        others = self._node.get_publishers_info_by_topic(CLOCK) if self._wanted else []
        if others:
            self._give_way(others)
        elif self._wanted:
            self._publisher = publisher(self._node, CLOCK)

    def publish(self, now: float, time_ns: int) -> None:
        """Send the simulated time, [ns]; `now` is the steady clock, [s]."""
        if self._publisher is not None and now - self._looked > LOOK_SECONDS:
            self._looked = now
            found = self._node.get_publishers_info_by_topic(CLOCK)
            own = [info for info in found if self._is_own(info)]
            others = [info for info in found if not self._is_own(info) and UNKNOWN not in info.node_name]
            if any(info.node_name != self._node.get_name() or _before(info, own) for info in others):
                self._give_way(others)
        if self._publisher is not None:
            self._publisher.publish(encode_clock(time_ns))

    def _is_own(self, info: TopicEndpointInfo) -> bool:
        return (info.node_name, info.node_namespace) == (self._node.get_name(), self._node.get_namespace())

    def _give_way(self, others: list[TopicEndpointInfo]) -> None:
        if self._publisher is not None:
            self._node.destroy_publisher(self._publisher)
            self._publisher = None
        names = ", ".join(sorted(describe_endpoint(info) for info in others))
        self._node.get_logger().warning(
            f"{CLOCK} comes from {names}; this run publishes none (its stamps are simulated time all the same). "
            f"To have two: -r {CLOCK}:=clock; to have it so without this line: publish_clock:=false"
        )


def _before(info: TopicEndpointInfo, own: list[TopicEndpointInfo]) -> bool:
    return any(list(info.endpoint_gid) < list(mine.endpoint_gid) for mine in own)
