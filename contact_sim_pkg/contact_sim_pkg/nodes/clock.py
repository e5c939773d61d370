"""The simulator's `/clock`: one source in the graph, since several give jumps back in time."""

from __future__ import annotations

from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.topic_endpoint_info import TopicEndpointInfo

from contact_sim_pkg.bag.encoding import SECOND
from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.nodes.protocol.endpoints import UNKNOWN, describe_endpoint, publisher
from contact_sim_pkg.records.messages import Clock, Time

CLOCK = "/clock"
LOOK_SECONDS = 0.5  # between two looks at the graph
CLAIM_SECONDS = 0.3  # for two simulators to hear of each other's publisher before the first time is sent
NAME_SECONDS = 3.0  # for the graph to learn the name of who else publishes


def clock_message(time_ns: int) -> bytes:
    """The bytes of `/clock` at a simulated time, [ns]."""
    return encode(Clock(clock=Time(sec=time_ns // SECOND, nanosec=time_ns % SECOND)))


class SimulatedClock:
    """Publishes simulated time as long as nobody else publishes a clock; warns once that it does
    not, and why.

    The second one gives way. Of two simulators that began at the same moment the one with the
    smaller identifier stays; a clock from elsewhere (a replay, another simulator) stays in any
    case.
    """

    def __init__(self, node: Node, *, wanted: bool) -> None:
        """Nothing is published before `start`, and nothing announced before `claim`."""
        self._node = node
        self._publisher: Publisher | None = None
        self._undecided = wanted  # until the warning about another clock
        self._looked = self._began = 0.0

    def claim(self, now: float) -> bool:
        """Announce a publisher, unless somebody publishes a clock already; whether `start` may follow at `now` of the
        steady clock, [s].

        Where another simulator is in the graph it may not at once: two that begin at the same moment first hear of each
        other's publisher.
        """
        if not self._began:
            self._began = now
            self._look(now)
        return not self._undecided or now - self._began >= CLAIM_SECONDS or not self._other_simulators()

    def start(self, now: float) -> None:
        """Begin, or give way; `now` is the steady clock, [s]."""
        self._look(now)

    def publish(self, now: float, time_ns: int) -> None:
        """Send the simulated time, [ns]; `now` is the steady clock, [s]."""
        if now - self._looked > LOOK_SECONDS:
            self._look(now)
        if self._publisher is not None:
            self._publisher.publish(clock_message(time_ns))

    def _look(self, now: float) -> None:
        """Give way to another clock; warn as soon as the graph knows its node's name."""
        self._looked = now
        if not self._undecided:
            return
        found = self._node.get_publishers_info_by_topic(CLOCK)
        own = [info for info in found if self._is_own(info)]
        others = [info for info in found if not self._is_own(info)]
        named = [info for info in others if UNKNOWN not in info.node_name]
        if self._publisher is None and not others:
            self._publisher = publisher(self._node, CLOCK)
        elif self._publisher is not None and any(self._stays(info, own) for info in named):
            self._node.destroy_publisher(self._publisher)
            self._publisher = None
        if self._publisher is None and (named or (others and now - self._began > NAME_SECONDS)):
            self._warn(others)

    def _other_simulators(self) -> bool:
        name, own = self._node.get_name(), self._node.get_namespace()
        return any(entry[0] == name and entry[1] != own for entry in self._node.get_node_names_and_namespaces())

    def _is_own(self, info: TopicEndpointInfo) -> bool:
        return (info.node_name, info.node_namespace) == (self._node.get_name(), self._node.get_namespace())

    def _stays(self, other: TopicEndpointInfo, own: list[TopicEndpointInfo]) -> bool:
        before = any(list(other.endpoint_gid) < list(mine.endpoint_gid) for mine in own)
        return before or other.node_name != self._node.get_name()

    def _warn(self, others: list[TopicEndpointInfo]) -> None:
        self._undecided = False
        names = ", ".join(sorted(describe_endpoint(info) for info in others))
        self._node.get_logger().warning(
            f"{CLOCK} comes from {names}; this run publishes none (its stamps are simulated time all the same). "
            f"To have two: -r {CLOCK}:=clock; to have it so without this line: publish_clock:=false"
        )
