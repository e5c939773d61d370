"""The quality of service that a bag has stored for a topic, as rclpy's profile."""

from __future__ import annotations

from typing import Any

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError

from .protocol import REFUSED, NodeError


def profile_of_recorded(text: str) -> QoSProfile:
    """The first profile of a rosbag2 list of offered profiles; reliable, volatile and 10 deep where nothing is stored."""
    try:
        profiles = YAML(typ="safe", pure=True).load(text) or [{}]
        stored: dict[str, Any] = dict(profiles[0])
        return QoSProfile(
            history=HistoryPolicy.KEEP_ALL if stored.get("history") == "keep_all" else HistoryPolicy.KEEP_LAST,
            depth=max(1, int(stored.get("depth", 10))),
            reliability=ReliabilityPolicy[str(stored.get("reliability", "reliable")).upper()],
            durability=DurabilityPolicy[str(stored.get("durability", "volatile")).upper()],
        )
    except (YAMLError, KeyError, ValueError, TypeError, IndexError) as error:
        raise NodeError(f"the stored quality of service {text!r} cannot be used: {error}", REFUSED) from None
