"""The rigs that a scene can name: their contacts, and the sections of a scene that each of them needs or takes.

A new rig is a row here, a row in `run/rigs.py`, its section in `scene/schema/scene.py` and its
contact in `scene/schema/effects.py` and `scene/schema/effect_rules.py`; nothing else asks which rig
it is.
"""

from __future__ import annotations

from typing import Literal, NamedTuple, TypeAlias

RigName: TypeAlias = Literal["tire", "seat", "car", "backrest", "occupant", "impact", "block", "roller"]


class RigRule(NamedTuple):
    """What holds for one rig. A section that another rig needs or takes, and this one does not, is refused."""

    contacts: tuple[str, ...]  # each needs an elastic force; a contact's own section of the scene has its name
    needs: tuple[str, ...]  # sections that the scene must have
    takes: tuple[str, ...]  # sections that it may have; those of the contacts are defaults where absent


RIGS: dict[RigName, RigRule] = {
    "tire": RigRule(("tire",), ("travel", "road"), ("slip", "tire")),
    "seat": RigRule(("seat",), ("vibration",), ("seat",)),
    "car": RigRule(("tire", "seat"), ("travel", "road"), ("slip", "vibration", "tire", "seat")),
    "backrest": RigRule(("backrest",), ("vibration",), ("backrest",)),
    "occupant": RigRule(("seat", "backrest"), ("vibration",), ("seat", "backrest")),
    "impact": RigRule(("impact",), (), ("impact",)),
    "block": RigRule(("block",), (), ("block",)),
    "roller": RigRule(("roller",), (), ("roller", "road")),
}

CONTACTS: tuple[str, ...] = tuple(dict.fromkeys(name for rule in RIGS.values() for name in rule.contacts))
"""Contacts of all rigs."""


def refused_sections(rig: RigName) -> tuple[str, ...]:
    """Sections that have no meaning for a rig."""
    own = {*RIGS[rig].needs, *RIGS[rig].takes}
    others = dict.fromkeys(name for rule in RIGS.values() for name in (*rule.needs, *rule.takes))
    return tuple(name for name in others if name not in own)
