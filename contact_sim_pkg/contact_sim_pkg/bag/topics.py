"""The table of topics: name, type, quality of service, and whether it is recorded.

Names are relative (a namespace puts itself in front) except `/clock` and `/diagnostics`, which ROS shares between all
nodes. The rank is the position in the table; at equal stamps, a bag holds the messages of a block in order of rank.
`docs/interfaces.md` shows the table, made by `nodes/processes/interface_reference.py`.
"""

from typing import Literal, NamedTuple

from contact_sim_pkg.bag.errors import BagError

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
    rate: str  # when a message comes; keys of the scene between backticks

    @property
    def frame(self) -> str:
        """The frame of its messages: that of the contact that the topic is named after, else the bench's fixed frame."""
        first = self.name.partition("/")[0]
        return f"{first}_contact" if self.kind == "result" and first != "bench" else "bench"


BLOCK = "every `block_length`"
SAMPLES = "every `block_length`, samples at `outputs.force_rate`"
DISPLAY = "`outputs.display_rate`"
FIELD = "`outputs.field_rate`"
IMPACT = "an impact"


def _latched(name: str, type_name: str, kind: Kind, rate: str, *, recorded: bool = False) -> Topic:
    return Topic(
        name, type_name, rank=0, reliability="reliable", durability="transient_local", depth=1, recorded=recorded,
        wall_time=not recorded, kind=kind, rate=rate,
    )  # fmt: skip


def _samples(
    name: str, type_name: str, rate: str = SAMPLES, *, kind: Kind = "result", wall_time: bool = False
) -> Topic:
    return Topic(
        name, type_name, rank=0, reliability="reliable", durability="volatile", depth=10, recorded=True,
        wall_time=wall_time, kind=kind, rate=rate,
    )  # fmt: skip


_TABLE = (
    _latched("bench/scene", "std_msgs/msg/String", "scene", "once", recorded=True),
    _samples("road/patch", "contact_msgs_defs/msg/RoadPatch", BLOCK, kind="excitation"),
    _samples(
        "platform/vibration",
        "contact_msgs_defs/msg/VibrationBlock",
        "every `block_length`, samples at `vibration.sample_rate`",
        kind="excitation",
    ),
    _samples("tire/force", "contact_msgs_defs/msg/ContactForce"),
    _samples("seat/force", "contact_msgs_defs/msg/ContactForce"),
    _samples("backrest/force", "contact_msgs_defs/msg/ContactForce"),
    _samples("impact/force", "contact_msgs_defs/msg/ContactForce"),
    _samples("block/force", "contact_msgs_defs/msg/ContactForce"),
    _samples("roller/force", "contact_msgs_defs/msg/ContactForce"),
    _samples("tire/wrench", "geometry_msgs/msg/WrenchStamped", DISPLAY),
    _samples("seat/wrench", "geometry_msgs/msg/WrenchStamped", DISPLAY),
    _samples("backrest/wrench", "geometry_msgs/msg/WrenchStamped", DISPLAY),
    _samples("impact/wrench", "geometry_msgs/msg/WrenchStamped", DISPLAY),
    _samples("block/wrench", "geometry_msgs/msg/WrenchStamped", DISPLAY),
    _samples("tire/patch", "contact_msgs_defs/msg/ContactPatch", FIELD),
    _samples("seat/patch", "contact_msgs_defs/msg/ContactPatch", FIELD),
    _samples("backrest/patch", "contact_msgs_defs/msg/ContactPatch", FIELD),
    _samples("backrest/points", "contact_msgs_defs/msg/ContactPoints", FIELD),
    _samples("block/points", "contact_msgs_defs/msg/ContactPoints", FIELD),
    _samples("tire/shear", "contact_msgs_defs/msg/ContactShear", FIELD),
    _samples("impact/events", "contact_msgs_defs/msg/ImpactEvents", "a block in which an impact ended"),
    _samples("impact/course", "contact_msgs_defs/msg/ImpactCourse", IMPACT),
    _samples("impact/stress", "contact_msgs_defs/msg/ImpactStress", IMPACT),
    _samples("impact/wave", "contact_msgs_defs/msg/ImpactWave", IMPACT),
    _samples("impact/front", "contact_msgs_defs/msg/ImpactFront", IMPACT),
    _samples("impact/position", "contact_msgs_defs/msg/ImpactPosition", IMPACT),
    _samples("impact/history", "contact_msgs_defs/msg/ImpactHistory", IMPACT),
    _samples(
        "roller/stability",
        "contact_msgs_defs/msg/RollerStability",
        "the first block, and each in which the load changed",
    ),
    _samples("roller/contact", "contact_msgs_defs/msg/RollerContact"),
    _samples("roller/track", "contact_msgs_defs/msg/RollerTrack", BLOCK),
    _samples("roller/volumes", "contact_msgs_defs/msg/RollerVolumes", "`effects.roller.subsurface.instants`"),
    _samples("bench/episodes", "contact_msgs_defs/msg/ContactEpisodes", "a block in which an episode ended"),
    _samples("bench/motion", "contact_msgs_defs/msg/BodyMotion"),
    _samples("bench/energy", "contact_msgs_defs/msg/EnergyLedger", BLOCK),
    _samples("bench/cost", "contact_msgs_defs/msg/SolverCost", BLOCK, kind="cost", wall_time=True),
    _latched("bench/progress", "contact_msgs_defs/msg/BenchProgress", "state", "a block, and a change of state"),
    _latched("bench/recorded", "contact_msgs_defs/msg/BenchRecorded", "state", "a block, and the end"),
    Topic(
        "/clock", "rosgraph_msgs/msg/Clock", rank=0, reliability="best_effort", durability="volatile", depth=1,
        recorded=False, wall_time=False, kind="clock", rate=BLOCK,
    ),
    Topic(
        "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", rank=0, reliability="reliable", durability="volatile",
        depth=10, recorded=False, wall_time=True, kind="health", rate="1 Hz, and a change of state",
    ),
)  # fmt: skip

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
