"""Publishers and subscriptions of the table of topics, on encoded bytes, and the entries of the ROS
graph about them.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from functools import cache, partial
from importlib import import_module
from typing import Any

from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.subscription import Subscription
from rclpy.topic_endpoint_info import TopicEndpointInfo
from rclpy.wait_for_message import wait_for_message

from contact_sim_pkg.bag.topics import topic_of
from contact_sim_pkg.nodes.protocol.states import REFUSED, NodeError
from contact_sim_pkg.records.topic import Topic

KEPT = "error_of_a_subscription"  # attribute of a node
UNKNOWN = "_NODE_NAME_UNKNOWN_"  # in the graph until the node's name has arrived
NUMBER = "publication_sequence_number"  # key in the info that rclpy adds to a message


@cache
def message_type(type_name: str) -> Any:
    """The Python class of `package/msg/Type`; NodeError where the package is not installed."""
    try:
        package, _, name = type_name.split("/")
        return getattr(import_module(f"{package}.msg"), name)
    except (ImportError, AttributeError, ValueError) as error:
        raise NodeError(
            f"message type {type_name} cannot be imported ({error}); build and source its package", REFUSED
        ) from None


def profile_of(topic: Topic, least_depth: int = 0) -> QoSProfile:
    """The quality of service of a row of the table; deeper where the scene sends many messages a
    block.
    """
    latched = topic.durability == "transient_local"
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=topic.depth if latched else max(topic.depth, least_depth),
        reliability=ReliabilityPolicy.RELIABLE if topic.reliability == "reliable" else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )


def publisher(node: Node, name: str, least_depth: int = 0) -> Publisher:
    """A publisher for encoded bytes on a topic of the table."""
    topic = topic_of(name)
    return node.create_publisher(message_type(topic.type), name, profile_of(topic, least_depth))


def subscription(node: Node, name: str, callback: Callable[[bytes], None], least_depth: int = 0) -> Subscription:
    """A subscription on a topic of the table that hands on the received bytes.

    What `callback` raises is kept until `raise_kept`: the executor would print it before it passes
    it on.
    """

    def receive(data: bytes) -> None:
        _call(node, callback, data)

    return _subscribe(node, name, receive, least_depth)


def numbered_subscription(
    node: Node, name: str, callback: Callable[[bytes, int | None], None], least_depth: int = 0
) -> Subscription:
    """As `subscription`, with the number that the publisher gave the message; None where the
    middleware does not number.
    """
    return informed_subscription(node, name, lambda data, info: callback(data, info.get(NUMBER)), least_depth)


def informed_subscription(
    node: Node, name: str, callback: Callable[[bytes, dict[str, Any]], None], least_depth: int = 0
) -> Subscription:
    """As `subscription`, with what rclpy knows of the message: number, times of sending and arrival
    (`source_timestamp`, `received_timestamp`, [ns] of the system clock).
    """

    def receive(*parts: Any) -> None:
        data, info = parts if len(parts) == 2 else parts[0]  # rclpy 7.1: EventsExecutor hands on both as one tuple
        _call(node, callback, data, info)

    receive.__signature__ = _DATA_AND_INFO  # type: ignore[attr-defined]  # by which rclpy sees that the number is wanted
    return _subscribe(node, name, receive, least_depth)


def viewing_subscription(node: Node, name: str, callback: Callable[[bytes], None], depth: int = 1) -> Subscription:
    """As `subscription`, of the ``depth`` newest messages alone, which no publisher keeps or repeats for it; a latched
    topic as it is.
    """
    topic = topic_of(name)
    if topic.durability != "transient_local":
        topic = topic._replace(reliability="best_effort", depth=depth)
    return node.create_subscription(
        message_type(topic.type), name, partial(_call, node, callback), profile_of(topic), raw=True
    )


_DATA_AND_INFO = inspect.Signature(
    [inspect.Parameter(name, inspect.Parameter.POSITIONAL_ONLY) for name in ("data", "info")]
)


def _subscribe(node: Node, name: str, receive: Callable[..., None], least_depth: int) -> Subscription:
    topic = topic_of(name)
    return node.create_subscription(message_type(topic.type), name, receive, profile_of(topic, least_depth), raw=True)


def _call(node: Node, callback: Callable[..., None], *given: Any) -> None:
    try:
        callback(*given)
    except Exception as error:  # noqa: BLE001  # raised again outside of the executor
        if getattr(node, KEPT, None) is None:
            setattr(node, KEPT, error)


def newest(node: Node, name: str, seconds: float) -> Any:
    """The newest message of a latched topic of the table, waited for within a callback, [s]; None where none came."""
    topic = topic_of(name)
    _, message = wait_for_message(
        message_type(topic.type), node, name, qos_profile=profile_of(topic), time_to_wait=seconds
    )
    return message


def raise_kept(node: Node) -> None:
    """Raise the first exception of the node's subscriptions since the last call, if any."""
    error = getattr(node, KEPT, None)
    if error is not None:
        setattr(node, KEPT, None)
        raise error


def refuse_strangers(node: Node, name: str, *, unnamed: bool = True) -> bool:
    """Compare who publishes on a topic with what the bench allows: one publisher, of our message
    definition.

    Args:
        node: a node that has its own publisher or subscription of the topic.
        name: name of the topic.
        unnamed: refuse also where the graph does not know yet what the nodes are called.

    Returns:
        False where a refusal waits for the nodes' names, which the graph learns a moment after
        their publishers.

    Raises:
        NodeError: (refused) names the nodes where there are several, and both hashes where the
        definitions differ: the
            wire matches topics by name alone, and would misread the bytes.
    """
    publishers = node.get_publishers_info_by_topic(name)
    ours = {_hash(info) for info in node.get_subscriptions_info_by_topic(name) if info.node_name == node.get_name()}
    # both checks wait for names, so that a refusal can name the nodes
    others = [info for info in publishers if ours and _hash(info) not in ours]
    if (others or len(publishers) > 1) and not unnamed and any(UNKNOWN in info.node_name for info in publishers):
        return False
    if len(publishers) > 1:
        names = ", ".join(sorted(describe_endpoint(info) for info in publishers))
        raise NodeError(
            f"{name} has {len(publishers)} publishers ({names}), one is allowed: another bench or node is on the same "
            "topics; end it, or give this one a ROS_DOMAIN_ID of its own (the launch file also takes a namespace)",
            REFUSED,
        )
    for info in others:
        raise NodeError(
            f"{describe_endpoint(info)} publishes {name} with another definition of "
            f"{info.topic_type} ({_hash(info)}, ours is {', '.join(ours)}); build both from the same contact_msgs_defs",
            REFUSED,
        )
    return True


def publisher_ids(node: Node, name: str) -> dict[bytes, str]:
    """The publishers of a topic: the middleware's own name of each -> name of its node, empty where
    it is not known yet.
    """
    return {
        bytes(info.endpoint_gid): "" if UNKNOWN in info.node_name else describe_endpoint(info)
        for info in node.get_publishers_info_by_topic(name)
    }


def _hash(info: TopicEndpointInfo) -> str:
    return str(info.topic_type_hash)


def describe_endpoint(info: TopicEndpointInfo) -> str:
    """Full name of the node that has this publisher or subscription."""
    if UNKNOWN in info.node_name:
        return "a node whose name is not known"
    return f"{info.node_namespace.rstrip('/')}/{info.node_name}"


def why_not_served(offered: QoSProfile, wanted: QoSProfile) -> str:
    """Why a subscription cannot be served; empty where it can. (The deadlines in the graph are
    not those requested.)
    """
    if wanted.reliability == ReliabilityPolicy.RELIABLE and offered.reliability == ReliabilityPolicy.BEST_EFFORT:
        return "it asks for reliable delivery, the topic was recorded as best effort"
    if wanted.durability == DurabilityPolicy.TRANSIENT_LOCAL and offered.durability == DurabilityPolicy.VOLATILE:
        return "it asks for a transient-local topic, the topic was recorded as volatile"
    return ""
