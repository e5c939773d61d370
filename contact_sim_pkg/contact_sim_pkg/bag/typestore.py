"""Message definitions: ours from the package data, and the few standard ones of ROS 2 Jazzy that the bench uses.

rosbags knows all of Jazzy, but making its classes takes 0.4 s in each process; the few that are needed stand here, and a
test compares their hashes with those of rosbags.

Nothing here needs ROS to be installed. A bag carries its definitions, so a reader builds its store from the bag
(`store_of_definition`); only what this version writes comes from the installed definitions.
"""

from functools import cache
from importlib.resources import files

from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from contact_sim_pkg.bag.errors import BagError

PACKAGE = "contact_msgs_defs"
STANDARD = {
    "builtin_interfaces/msg/Time": "int32 sec\nuint32 nanosec\n",
    "std_msgs/msg/Header": "builtin_interfaces/Time stamp\nstring frame_id\n",
    "std_msgs/msg/String": "string data\n",
    "geometry_msgs/msg/Vector3": "float64 x\nfloat64 y\nfloat64 z\n",
    "geometry_msgs/msg/Wrench": "Vector3 force\nVector3 torque\n",
    "geometry_msgs/msg/WrenchStamped": "std_msgs/Header header\nWrench wrench\n",
    "rosgraph_msgs/msg/Clock": "builtin_interfaces/Time clock\n",
    "diagnostic_msgs/msg/KeyValue": "string key\nstring value\n",
    "diagnostic_msgs/msg/DiagnosticStatus": (
        "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\n"
        "byte level\nstring name\nstring message\nstring hardware_id\nKeyValue[] values\n"
    ),
    "diagnostic_msgs/msg/DiagnosticArray": "std_msgs/Header header\nDiagnosticStatus[] status\n",
}
"""Definitions of the standard types, without comments."""
LONGEST_DEFINITION = 1 << 18  # characters of a definition with all that it contains
_SEPARATOR = "=" * 80 + "\n"


@cache
def _own_texts() -> dict[str, str]:
    """The text of each of our `.msg` files by type name, comments included."""
    folder = files("contact_sim_pkg") / "msg"
    texts = {
        f"{PACKAGE}/msg/{entry.name[:-4]}": entry.read_text(encoding="utf-8")
        for entry in (folder.iterdir() if folder.is_dir() else ())
        if entry.name.endswith(".msg")
    }
    if not texts:
        raise BagError(f"the message definitions are missing in {folder}; install the package with its data again")
    return texts


@cache
def installed_types() -> Typestore:
    """The standard types that the bench uses, and ours."""
    store = get_typestore(Stores.EMPTY)
    types = {}
    for name, text in {**STANDARD, **_own_texts()}.items():
        types.update(get_types_from_msg(text, name))
    store.register(types)
    return store


@cache
def definition(type_name: str) -> str:
    """The `ros2msg` text of a type: its definition, then each dependency after a line of `=` and `MSG: package/Type`.

    Ours are given with their comments, which hold unit, frame and order of each field.
    """
    generated, _ = installed_types().generate_msgdef(type_name, ros_version=2)
    head, *dependencies = generated.split(_SEPARATOR)
    return _SEPARATOR.join([_own_texts().get(type_name, head), *dependencies])


@cache
def type_hash(type_name: str) -> str:
    """The hash `RIHS01_…` of a type, equal to the one that a running graph reports."""
    return installed_types().hash_rihs01(type_name)


def store_of_definition(type_name: str, text: str) -> Typestore:
    """A store that knows one type, from its `ros2msg` text with dependencies, and nothing installed.

    Raises BagError where the text is no definition, or one of its dependencies is missing.
    """
    store = get_typestore(Stores.EMPTY)
    try:
        if len(text) > LONGEST_DEFINITION:
            raise ValueError(f"it has {len(text)} characters, limit {LONGEST_DEFINITION}")
        store.register(get_types_from_msg(text, type_name))
        store.get_msgdef(type_name)
    except Exception as error:  # noqa: BLE001 - the parser and the generator of foreign definitions raise errors of many kinds
        known = {KeyError: f"{error.args[0] if error.args else error} is missing", RecursionError: "it contains itself"}
        reason = " ".join(str(known.get(type(error), error)).split()) or type(error).__name__
        raise BagError(f"the bag's definition of {type_name[:100]!r} cannot be used: {reason:.300}") from None
    return store
