"""Publishers of a replay: quality of service and message definition as the bag has stored them."""

from __future__ import annotations

from typing import Any

from rclpy.exceptions import InvalidTopicNameException
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.validate_full_topic_name import validate_full_topic_name

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.metadata import CDR, RecordedTopic
from contact_sim_pkg.bag.texts import values_of_text
from contact_sim_pkg.bag.typestore import store_of_definition
from contact_sim_pkg.nodes.protocol.endpoints import message_type
from contact_sim_pkg.nodes.protocol.states import REFUSED, NodeError

DEEPEST = 1_000_000  # messages kept


def profile_of_recorded(text: str) -> QoSProfile:
    """The first profile of a rosbag2 list of offered profiles; reliable, volatile and 10 deep where
    nothing is stored.
    """
    try:
        profiles = (values_of_text(text, "quality of service") if text.strip() else None) or [{}]
        stored: dict[str, Any] = dict(profiles[0])
        depth = int(stored.get("depth", 10))
        if depth > DEEPEST:
            raise ValueError(f"depth {depth} is above {DEEPEST}")
        return QoSProfile(
            history=HistoryPolicy.KEEP_ALL if stored.get("history") == "keep_all" else HistoryPolicy.KEEP_LAST,
            depth=max(1, depth),
            reliability=ReliabilityPolicy[str(stored.get("reliability", "reliable")).upper()],
            durability=DurabilityPolicy[str(stored.get("durability", "volatile")).upper()],
        )
    except (BagError, KeyError, ValueError, TypeError, IndexError, OverflowError) as error:
        raise NodeError(f"the stored quality of service {text[:100]!r} cannot be used: {error}", REFUSED) from None


def recorded_publisher(node: Node, row: RecordedTopic, least_depth: int) -> Publisher:
    """A publisher of `node` for a topic of a bag, in the node's namespace.

    A volatile topic keeps at least `least_depth` messages. Raises NodeError (refused) where its name
    is none of ROS, its messages are not CDR, or the topic was recorded with another definition of
    its type than the installed one; BagError where the bag does not say with which.
    """
    _refuse_foreign(row)
    profile, name = profile_of_recorded(row.offered_qos), row.name.lstrip("/")
    if profile.durability != DurabilityPolicy.TRANSIENT_LOCAL:
        profile.depth = max(profile.depth, least_depth)
    made = node.create_publisher(message_type(row.type), name, profile)
    for info in node.get_publishers_info_by_topic(name):
        installed = str(info.topic_type_hash)
        if info.node_name == node.get_name() and (others := _recorded_hashes(row) - {installed}):
            raise NodeError(
                f"{row.name} was recorded with another definition of {info.topic_type} than the installed one "
                f"({', '.join(others)}, {installed}); replay it with the package that it was recorded with",
                REFUSED,
            )
    return made


def _recorded_hashes(row: RecordedTopic) -> set[str]:
    """Hash of the type as the bag states it, and as follows from the definition in the bag.

    One is enough: older recorders state none, and a definition in IDL is not read. BagError without
    either.
    """
    stated = {row.type_hash} - {""}
    try:
        return stated | {store_of_definition(row.type, row.definition).hash_rihs01(row.type)}
    except BagError:
        if not stated:
            raise
        return stated


def _refuse_foreign(row: RecordedTopic) -> None:
    """Refuse what another recorder may keep in a bag, and ROS cannot carry."""
    others = "leave it out: give the others with --topics"
    if row.encoding != CDR:
        raise NodeError(
            f"the messages of {row.name} are encoded as {row.encoding!r:.20}, and ROS carries {CDR}; {others}", REFUSED
        )
    try:
        validate_full_topic_name(row.name if row.name.startswith("/") else f"/{row.name}")
    except InvalidTopicNameException as error:
        reason = str(error).splitlines()[0].partition(": ")[2]
        raise NodeError(f"{row.name!r} is no name of a topic of ROS: {reason}; {others}", REFUSED) from None
