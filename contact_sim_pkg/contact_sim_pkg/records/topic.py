"""A topic as everyone else sees it: a row of the table of topics, and what a rig declares of one.

The bench's own topics and the table are in `bag/topics.py`.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

__all__ = [
    "BLOCK", "COMMON", "DISPLAY", "FIELD", "FORCE", "PATCH", "POINTS", "SAMPLES", "WRENCH", "ContactTopic", "Kind", "Topic",
    "recorded_topic",
]  # fmt: skip

Kind = Literal["scene", "excitation", "result", "cost", "state", "clock", "health"]

BLOCK = "every `block_length`"
SAMPLES = "every `block_length`, samples at `outputs.force_rate`"
DISPLAY = "`outputs.display_rate`"
FIELD = "`outputs.field_rate`"
"""When a message comes; keys of the scene between backticks."""


class Topic(NamedTuple):
    """One row of the table of topics; the same quality of service at both ends."""

    name: str
    type: str
    rank: int
    reliability: Literal["reliable", "best_effort"]
    durability: Literal["volatile", "transient_local"]
    depth: int
    recorded: bool
    wall_time: bool  # reports wall time: differs from run to run, so it is excepted from bit identity
    kind: Kind
    rate: str  # when a message comes; keys of the scene between backticks

    @property
    def frame(self) -> str:
        """The frame of its messages: that of the contact that the topic is named after, else the
        bench's fixed frame.
        """
        first = self.name.partition("/")[0]
        return f"{first}_contact" if self.kind == "result" and first != "bench" else "bench"


def recorded_topic(
    name: str, type_name: str, rate: str = SAMPLES, *, kind: Kind = "result", wall_time: bool = False
) -> Topic:
    """A topic that every bag of its scene holds, reliable and volatile; its rank follows in the
    table.
    """
    return Topic(
        name, type_name, rank=0, reliability="reliable", durability="volatile", depth=10, recorded=True,
        wall_time=wall_time, kind=kind, rate=rate,
    )  # fmt: skip


class ContactTopic(NamedTuple):
    """One recorded topic of a contact.

    It is there in every run of the rig, unless it needs a key, or an effect names it in
    `publishes`.
    """

    name: str  # below that of the contact
    type: str  # package/msg/Type
    rate: str = SAMPLES
    key: str = ""  # of the contact's section, which switches it on; empty: none


FORCE = ContactTopic("force", "contact_msgs_defs/msg/ContactForce")
WRENCH = ContactTopic("wrench", "geometry_msgs/msg/WrenchStamped", DISPLAY)
PATCH = ContactTopic("patch", "contact_msgs_defs/msg/ContactPatch", FIELD)
POINTS = ContactTopic("points", "contact_msgs_defs/msg/ContactPoints", FIELD)
COMMON = (FORCE, WRENCH, PATCH, POINTS)
"""Topics that several contacts have. In a bag those of all contacts come first, in this order."""
