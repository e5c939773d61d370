"""The table of topics: name, type, quality of service, and whether it is recorded.

Names are relative (a namespace puts itself in front) except `/clock` and `/diagnostics`, which ROS
shares between all nodes. The topics of a contact are declared in its record, the bench's own here.
The rank is the position in the table; at equal stamps, a bag holds the messages of a block in order
of rank. `docs/interfaces.md` shows the table, made by `pages/interface_reference.py` of the laboratory.
"""

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.records.registry import contact_topics
from contact_sim_pkg.records.topic import BLOCK, Kind, Topic, recorded_topic


def _latched(name: str, type_name: str, kind: Kind, rate: str, *, recorded: bool = False) -> Topic:
    return Topic(
        name, type_name, rank=0, reliability="reliable", durability="transient_local", depth=1, recorded=recorded,
        wall_time=not recorded, kind=kind, rate=rate,
    )  # fmt: skip


_TABLE = (
    _latched("bench/scene", "std_msgs/msg/String", "scene", "once", recorded=True),
    recorded_topic("road/patch", "contact_msgs_defs/msg/RoadPatch", BLOCK, kind="excitation"),
    recorded_topic(
        "platform/vibration",
        "contact_msgs_defs/msg/VibrationBlock",
        "every `block_length`, samples at `vibration.sample_rate`",
        kind="excitation",
    ),
    recorded_topic(
        "bench/steering", "contact_msgs_defs/msg/ParameterChange", "a block before which a parameter changed"
    ),
    *contact_topics(),
    recorded_topic("bench/episodes", "contact_msgs_defs/msg/ContactEpisodes", "a block in which an episode ended"),
    recorded_topic("bench/motion", "contact_msgs_defs/msg/BodyMotion"),
    recorded_topic("bench/energy", "contact_msgs_defs/msg/EnergyLedger", BLOCK),
    recorded_topic("bench/cost", "contact_msgs_defs/msg/SolverCost", BLOCK, kind="cost", wall_time=True),
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
    """The name as the ROS graph and a bag show it: `tire/force` in namespace `rig2` is
    `/rig2/tire/force`.
    """
    if name.startswith("/"):
        return name
    prefix = namespace.strip("/")
    return f"/{prefix}/{name}" if prefix else f"/{name}"


_FOREVER = "{sec: 9223372036, nsec: 854775807}"


def offered_qos(topic: Topic) -> str:
    """The quality of service of a topic as rosbag2 stores it: a YAML list of one profile, names for
    the policies.
    """
    return (
        f"- history: keep_last\n  depth: {topic.depth}\n"
        f"  reliability: {topic.reliability}\n  durability: {topic.durability}\n"
        f"  deadline: {_FOREVER}\n  lifespan: {_FOREVER}\n  liveliness: automatic\n"
        f"  liveliness_lease_duration: {_FOREVER}\n  avoid_ros_namespace_conventions: false"
    )
