"""Message definitions: ours from the package data, the standard ones of ROS 2 Jazzy from rosbags.

Nothing here needs ROS to be installed. A bag carries its definitions, so a reader builds its store from the bag
(`store_of_definition`); only what this version writes comes from the installed definitions.
"""

from functools import cache
from importlib.resources import files

from rosbags.typesys import Stores, TypesysError, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from .errors import BagError

PACKAGE = "contact_msgs_defs"
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
    """The standard types of ROS 2 Jazzy and ours."""
    store = get_typestore(Stores.ROS2_JAZZY)
    types = {}
    for name, text in _own_texts().items():
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
        store.register(get_types_from_msg(text, type_name))
        store.get_msgdef(type_name)
    except (TypesysError, KeyError) as error:
        reason = f"{error.args[0]} is missing" if isinstance(error, KeyError) else error
        raise BagError(f"the bag's definition of {type_name} cannot be used: {reason}") from None
    return store
