"""The standard topics that the topics of a run can be shown as.

Names are relative, below `view/`, but for `/tf`, which every tool of ROS takes from there.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import NamedTuple

from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.records.topic import Topic
from contact_sim_pkg.standard.motion import IMU_BODIES

MOTION, ROAD, SCENE = "bench/motion", "road/patch", "bench/scene"
TF = "/tf"
MARKERS = "view/markers"
RATE = 20.0
"""[Hz] of the messages of a topic at most, unless asked for more."""


class StandardTopic(NamedTuple):
    """A topic of standard messages."""

    name: str
    type: str  # package/msg/Type
    source: str  # the topic of the bench whose messages it is made from
    content: str  # for the docs: what a message holds, unit and frame
    field: str = ""  # of the source, for a scalar
    also: tuple[str, ...] = ()  # further topics that it is made from, the scene apart
    places: bool = False  # whether it needs the scene

    @property
    def sources(self) -> tuple[str, ...]:
        """Every topic of the bench that it is made from."""
        return (self.source, *self.also, *([SCENE] if self.places else []))

    @property
    def row(self) -> Topic:
        """As a row of the table of topics, for its quality of service."""
        return Topic(
            self.name, self.type, rank=0, reliability="reliable", durability="volatile", depth=10, recorded=False,
            wall_time=False, kind="result", rate="",
        )  # fmt: skip


def standard_topics(present: Collection[str]) -> dict[str, StandardTopic]:
    """By name, what can be shown of a run or bag that has these topics of the bench."""
    found: list[StandardTopic] = []
    for name in (name for name in TOPICS if name in present):
        contact, _, _kind = name.partition("/")
        kind = TOPICS[name].type.rpartition("/")[2]
        if kind == "ContactPatch":
            found += _of_patch(contact, name)
        elif kind == "ContactForce":
            found.append(_scalar(contact, name, "load", "normal", "normal force [N] on the upper body"))
            found.append(_scalar(contact, name, "approach", "approach", "approach [m], positive in compression"))
        elif kind == "AxleForce":
            text = "force [N] and moment [N m] of the tire on its axle"
            found.append(StandardTopic(f"view/{name}", "geometry_msgs/msg/WrenchStamped", name, text))
    if MOTION in present:
        found += _of_motion(present)
    return {topic.name: topic for topic in found}


def wrench_topics(present: Collection[str]) -> dict[str, str]:
    """The wrench topics of the contacts, which are standard already, by contact."""
    names = [name for name in TOPICS if name in present and TOPICS[name].type == "geometry_msgs/msg/WrenchStamped"]
    return {name.partition("/")[0]: name for name in names}


def _of_patch(contact: str, source: str) -> list[StandardTopic]:
    image = "pressure [Pa] of each cell as `32FC1` from above, front on top; sum times cell area is the load"
    return [
        StandardTopic(f"view/{contact}/pressure", "sensor_msgs/msg/Image", source, image),
        StandardTopic(
            f"view/{contact}/cloud", "sensor_msgs/msg/PointCloud2", source,
            "loaded cells: `x`, `y`, `z` [m] in the frame of the contact, `pressure` [Pa]",
        ),
        _scalar(contact, source, "peak_pressure", "peak", "largest pressure [Pa]"),
        _scalar(contact, source, "area", "area", "contact area [m^2]"),
    ]  # fmt: skip


def _scalar(contact: str, source: str, name: str, field: str, text: str) -> StandardTopic:
    return StandardTopic(f"view/{contact}/{name}", "std_msgs/msg/Float64", source, text, field)


def _of_motion(present: Collection[str]) -> list[StandardTopic]:
    carried = {"axle": "tire/force", "seat": "seat/force", "floor": "seat/force"}
    force = "specific force [m/s^2], gravity included: +9.81 up at rest; orientation not given (REP 145)"
    road = (ROAD,) if ROAD in present else ()
    return [
        *(
            StandardTopic(f"view/imu/{place}", "sensor_msgs/msg/Imu", MOTION, f"{force}; of the {place}")
            for place in IMU_BODIES
            if carried[place] in present
        ),
        StandardTopic("view/joints", "sensor_msgs/msg/JointState", MOTION, "position [m] and velocity [m/s] of each coordinate"),
        StandardTopic(
            MARKERS, "visualization_msgs/msg/MarkerArray", MOTION, "road, tire, seat, occupant, an arrow a force (1 m: 5 kN)",
            also=(*road, *wrench_topics(present).values()), places=True,
        ),
        StandardTopic(TF, "tf2_msgs/msg/TFMessage", MOTION, "`bench`, `base_link`, the bodies, the contacts", places=True),
    ]  # fmt: skip
