"""The message definitions for rosbags: types, texts for a bag, hashes.

rosbags knows all of Jazzy, but making its classes takes 0.4 s in each process; the few that are
needed stand in `records/definitions.py`, and a test compares their hashes with those of rosbags.

Nothing here needs ROS to be installed. A bag carries its definitions, so a reader builds its store
from the bag (`store_of_definition`); only what this version writes comes from the installed
definitions.
"""

from functools import cache

from rosbags.typesys import Stores, get_types_from_idl, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from contact_sim_pkg.bag.errors import UnreadableTypeError
from contact_sim_pkg.records.definitions import PACKAGE, texts

LONGEST_DEFINITION = 1 << 18  # characters of a definition with all that it contains
HEADER = "std_msgs/msg/Header"
IDL = "ros2idl"  # encoding of a definition that was written in IDL
_SEPARATOR = "=" * 80 + "\n"


@cache
def installed_types() -> Typestore:
    """The standard types that the bench uses, and ours."""
    store = get_typestore(Stores.EMPTY)
    types = {}
    for name, text in texts().items():
        types.update(get_types_from_msg(text, name))
    store.register(types)
    return store


@cache
def definition(type_name: str) -> str:
    """The `ros2msg` text of a type: its definition, then each dependency after a line of `=` and
    `MSG: package/Type`.

    Ours are given with their comments, which state unit, frame and order of each field.
    """
    generated, _ = installed_types().generate_msgdef(type_name, ros_version=2)
    head, *dependencies = generated.split(_SEPARATOR)
    own = texts()[type_name] if type_name.startswith(PACKAGE) else head
    return _SEPARATOR.join([own, *dependencies])


@cache
def type_hash(type_name: str) -> str:
    """The hash `RIHS01_…` of a type, equal to the one that a running graph reports."""
    return installed_types().hash_rihs01(type_name)


def store_of_definition(type_name: str, text: str) -> Typestore:
    """A store that knows one type, from its `ros2msg` text with dependencies, and nothing
    installed.

    Raises UnreadableTypeError where the text is no definition, or one of its dependencies is missing.
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
        raise UnreadableTypeError(
            f"the bag's definition of {type_name[:100]!r} cannot be used: {reason:.300}"
        ) from None
    return store


def ros2msg_text(type_name: str, text: str, encoding: str) -> str:
    """The `ros2msg` text of a definition; that of one in IDL is made from it, and is empty where it cannot be."""
    if encoding != IDL or len(text) > LONGEST_DEFINITION:
        return text
    store, types = get_typestore(Stores.EMPTY), {}
    try:
        for part in text.split(_SEPARATOR):
            head, _, body = part.partition("\n")
            types.update(get_types_from_idl(body if head.startswith("IDL: ") else part))
        store.register(types)
        return store.generate_msgdef(type_name, ros_version=2)[0]
    except Exception:  # noqa: BLE001 - the parser of foreign definitions raises errors of many kinds
        return ""


def text_of_known(type_name: str) -> str:
    """The `ros2msg` text of a type that a bag names without its definition: ours, or one of Jazzy; empty for others."""
    if type_name in texts():
        return definition(type_name)
    store = get_typestore(Stores.ROS2_JAZZY)
    return store.generate_msgdef(type_name, ros_version=2)[0] if type_name in store.fielddefs else ""
