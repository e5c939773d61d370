"""The quality of service that a bag has stored for a topic, as rclpy's profile."""

from __future__ import annotations

from typing import Any

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.texts import values_of_text
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
