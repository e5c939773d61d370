"""The differences of several runs: the values in which their scenes differ."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from contact_sim_pkg.report.rows import scene_value
from contact_sim_pkg.scene.resolved_scene import leaves_of

UNIMPORTANT = ("description",)
LAST = ("duration", "block_length", "seed", "pace", "accuracy", "integrator", "outputs", "limits", "name")
"""How a scene is run rather than what it is: distinguishes runs only where nothing else does."""
ABSENT = "–"


class Difference(NamedTuple):
    """One value in which the scenes differ."""

    key: str
    """`vibration.frequency`"""
    values: tuple[str, ...]
    """with unit, one a run"""


def differences(scenes: Sequence[dict[str, Any]]) -> list[Difference]:
    """Values that are not the same in all scenes, in the order of the first scene that has them; how it is run comes
    last. A section that a scene lacks is one line.
    """
    flat = [{key: "on" if value == {} else value for key, value in leaves_of(scene)} for scene in scenes]
    for section in _lacked(flat):
        for each in flat:
            inside = [each.pop(key) for key in list(each) if key[: len(section)] == section]
            if any(value is not None for value in inside):
                each[section] = "on"
    keys = dict.fromkeys(key for each in flat for key in each)
    found = []
    for key in sorted(keys, key=lambda key: LAST.index(key[0]) + 1 if key[0] in LAST else 0):
        values = tuple(scene_value(each[key], key) if each.get(key) is not None else ABSENT for each in flat)
        if len(set(values)) > 1 and key[0] not in UNIMPORTANT:
            found.append(Difference(".".join(key), values))
    return found


def _lacked(flat: Sequence[dict[tuple[str, ...], Any]]) -> list[tuple[str, ...]]:
    """The outermost sections that one scene has and another leaves out."""
    sections = [{key[:depth] for key in each for depth in range(1, len(key))} for each in flat]
    found: list[tuple[str, ...]] = []
    for section in sorted(set().union(*sections), key=len):
        lacking = any(
            section not in own and each.get(section) is None for each, own in zip(flat, sections, strict=True)
        )
        if lacking and not any(section[: len(each)] == each for each in found):
            found.append(section)
    return found
