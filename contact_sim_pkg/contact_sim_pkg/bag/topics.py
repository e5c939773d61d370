"""The table of topics: name, type, quality of service, and whether it is recorded.

Names are relative (a namespace puts itself in front) except `/clock` and `/diagnostics`, which ROS shares between all
nodes. The rank is the position in the table; at equal stamps, a bag holds the messages of a block in order of rank.
"""

from typing import Literal, NamedTuple

from .errors import BagError

Kind = Literal["scene", "excitation", "result", "cost", "state", "clock", "health"]


class Topic(NamedTuple):
    """One topic of the bench; the same quality of service at both ends."""

    name: str
    type: str
    rank: int
    reliability: Literal["reliable", "best_effort"]
    durability: Literal["volatile", "transient_local"]
    depth: int
    recorded: bool
    wall_time: bool  # reports wall time: differs from run to run, so it is excepted from bit identity
    kind: Kind


def _latched(name: str, type_name: str, kind: Kind, *, recorded: bool = False, wall_time: bool = False) -> Topic:
    return Topic(name, type_name, 0, "reliable", "transient_local", 1, recorded, wall_time, kind)


def _samples(name: str, type_name: str, kind: Kind = "result", *, wall_time: bool = False) -> Topic:
    return Topic(name, type_name, 0, "reliable", "volatile", 10, True, wall_time, kind)


_TABLE = (
    _latched("bench/scene", "std_msgs/msg/String", "scene", recorded=True),
    _samples("road/patch", "contact_msgs_defs/msg/RoadPatch", "excitation"),
    _samples("platform/vibration", "contact_msgs_defs/msg/VibrationBlock", "excitation"),
    _samples("tire/force", "contact_msgs_defs/msg/ContactForce"),
    _samples("seat/force", "contact_msgs_defs/msg/ContactForce"),
    _samples("backrest/force", "contact_msgs_defs/msg/ContactForce"),
    _samples("impact/force", "contact_msgs_defs/msg/ContactForce"),
    _samples("block/force", "contact_msgs_defs/msg/ContactForce"),
    _samples("roller/force", "contact_msgs_defs/msg/ContactForce"),
    _samples("tire/wrench", "geometry_msgs/msg/WrenchStamped"),
    _samples("seat/wrench", "geometry_msgs/msg/WrenchStamped"),
    _samples("backrest/wrench", "geometry_msgs/msg/WrenchStamped"),
    _samples("impact/wrench", "geometry_msgs/msg/WrenchStamped"),
    _samples("block/wrench", "geometry_msgs/msg/WrenchStamped"),
    _samples("tire/patch", "contact_msgs_defs/msg/ContactPatch"),
    _samples("seat/patch", "contact_msgs_defs/msg/ContactPatch"),
    _samples("backrest/patch", "contact_msgs_defs/msg/ContactPatch"),
    _samples("backrest/points", "contact_msgs_defs/msg/ContactPoints"),
    _samples("block/points", "contact_msgs_defs/msg/ContactPoints"),
    _samples("tire/shear", "contact_msgs_defs/msg/ContactShear"),
    _samples("impact/events", "contact_msgs_defs/msg/ImpactEvents"),
    _samples("impact/course", "contact_msgs_defs/msg/ImpactCourse"),
    _samples("impact/stress", "contact_msgs_defs/msg/ImpactStress"),
    _samples("impact/wave", "contact_msgs_defs/msg/ImpactWave"),
    _samples("impact/front", "contact_msgs_defs/msg/ImpactFront"),
    _samples("impact/position", "contact_msgs_defs/msg/ImpactPosition"),
    _samples("impact/history", "contact_msgs_defs/msg/ImpactHistory"),
    _samples("roller/stability", "contact_msgs_defs/msg/RollerStability"),
    _samples("roller/contact", "contact_msgs_defs/msg/RollerContact"),
    _samples("roller/track", "contact_msgs_defs/msg/RollerTrack"),
    _samples("roller/volumes", "contact_msgs_defs/msg/RollerVolumes"),
    _samples("bench/episodes", "contact_msgs_defs/msg/ContactEpisodes"),
    _samples("bench/motion", "contact_msgs_defs/msg/BodyMotion"),
    _samples("bench/energy", "contact_msgs_defs/msg/EnergyLedger"),
    _samples("bench/cost", "contact_msgs_defs/msg/SolverCost", "cost", wall_time=True),
    _latched("bench/progress", "contact_msgs_defs/msg/BenchProgress", "state", wall_time=True),
    _latched("bench/recorded", "contact_msgs_defs/msg/BenchRecorded", "state", wall_time=True),
    Topic("/clock", "rosgraph_msgs/msg/Clock", 0, "best_effort", "volatile", 1, False, False, "clock"),
    Topic("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", 0, "reliable", "volatile", 10, False, True, "health"),
)

TOPICS: dict[str, Topic] = {topic.name: topic._replace(rank=rank) for rank, topic in enumerate(_TABLE)}
RECORDED: tuple[str, ...] = tuple(name for name, topic in TOPICS.items() if topic.recorded)


def topic_of(name: str) -> Topic:
    """The row of the table with this name; BagError where there is none."""
    try:
        return TOPICS[name]
    except KeyError:
        raise BagError(f"no topic is called {name!r}; the bench has {', '.join(TOPICS)}") from None


def full_name(name: str, namespace: str = "") -> str:
    """The name as the ROS graph and a bag show it: `tire/force` in namespace `rig2` is `/rig2/tire/force`."""
    if name.startswith("/"):
        return name
    prefix = namespace.strip("/")
    return f"/{prefix}/{name}" if prefix else f"/{name}"


_FOREVER = "{sec: 9223372036, nsec: 854775807}"


def offered_qos(topic: Topic) -> str:
    """The quality of service of a topic as rosbag2 stores it: a YAML list of one profile, names for the policies."""
    return (
        f"- history: keep_last\n  depth: {topic.depth}\n"
        f"  reliability: {topic.reliability}\n  durability: {topic.durability}\n"
        f"  deadline: {_FOREVER}\n  lifespan: {_FOREVER}\n  liveliness: automatic\n"
        f"  liveliness_lease_duration: {_FOREVER}\n  avoid_ros_namespace_conventions: false"
    )
