"""Texts that stand in a bag, or in a file given beside one, read as data within the limits of
`scene/yaml/document.py`: whoever made them is a stranger.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.files import read_regular_file
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.renamed_keys import with_new_names
from contact_sim_pkg.scene.yaml.document import parse_json, parse_plain

MOST_VALUES = 30_000  # of a `metadata.yaml`, which may list many topics

LARGEST_TABLE = 100_000
"""[bytes] of a file of tolerances or requirements"""

__all__ = ["excitation_of_text", "scene_of_text", "table_of_file", "values_of_text"]


def values_of_text(text: str, where: str, read: Callable[..., Any] = parse_plain, **limits: int) -> Any:
    """Values of a YAML text (JSON with `read=parse_json`); BagError, with `where` it stands,
    beyond what is allowed.
    """
    try:
        return read(text, where, **limits)
    except SceneError as error:
        raise BagError(str(error.faults[0])) from None


def table_of_file(path: Path, of: str, cure: str) -> dict[str, Any]:
    """Key and value of each line of a YAML file of tolerances, or of what else it is a table ``of``.

    Raises:
        BagError: the file is no such table, with the ``cure``. FileRefusedError: it cannot be read.
    """
    content = read_regular_file(path, LARGEST_TABLE, f"it is no file of {of}")
    given = values_of_text(content.decode("utf-8", "replace"), str(path))
    if not isinstance(given, dict) or not given:
        raise BagError(f"{path}: holds no {of}; {cure}")
    return {str(key): value for key, value in given.items()}


def scene_of_text(text: str | None, where: str) -> dict[str, Any]:
    """The mapping of a recorded scene, its values unchecked, keys that were renamed since under
    their new names.

    Empty where there is no text. BagError: no mapping.
    """
    scene = {} if text is None else values_of_text(text, where)
    if not isinstance(scene, dict):
        raise BagError(f"{where}: holds {_kind(scene)}, not the keys and values of a scene")
    return with_new_names(scene)


def excitation_of_text(text: str | None, where: str) -> dict[str, dict[str, Any]]:
    """Description of each excitation, by topic, with its `notes` as a list of texts. BagError:
    anything else.
    """
    found = {} if text is None else values_of_text(text, where, parse_json)
    if not isinstance(found, dict) or not all(isinstance(each, dict) for each in found.values()):
        raise BagError(f"{where}: is no JSON object of objects, one a topic")
    for topic, each in found.items():
        notes = each.get("notes", [])
        if not isinstance(notes, list) or not all(isinstance(note, str) for note in notes):
            raise BagError(f"{where}: the notes of {topic} are {_kind(notes)}, not a list of texts")
    return found


def _kind(value: Any) -> str:
    return {dict: "a mapping", list: "a list", type(None): "nothing"}.get(type(value), f"the value {value!r:.40}")
