"""Which effects a contact offers, what each effect needs, and which exclude each other: one table."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import NamedTuple

from contact_sim_pkg.records.registry import contacts, rigs
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.scene import Scene


class EffectRule(NamedTuple):
    """What holds for one effect."""

    contacts: tuple[str, ...]
    needs: tuple[str, ...] = ()
    excludes: tuple[str, ...] = ()


EFFECT_RULES: dict[str, EffectRule] = {
    "normal_elastic": EffectRule(("tire", "seat", "backrest", "impact", "roller")),
    "normal_dissipative": EffectRule(("tire", "seat", "backrest", "impact"), needs=("normal_elastic",)),
    "general_dissipative": EffectRule(
        ("seat", "backrest"), needs=("normal_elastic",), excludes=("normal_dissipative",)
    ),
    "foam": EffectRule(("seat", "backrest"), needs=("normal_elastic",), excludes=("contact_field",)),
    "foam_hysteresis": EffectRule(("seat", "backrest"), needs=("normal_elastic",), excludes=("contact_field",)),
    "friction": EffectRule(("seat", "backrest"), needs=("normal_elastic",)),
    "contact_field": EffectRule(("tire", "seat"), needs=("normal_elastic",)),
    "pressure_mat": EffectRule(("seat",), needs=("normal_elastic",), excludes=("contact_field",)),
    "shell_modes": EffectRule(("backrest",), needs=("normal_elastic",)),
    "contact_search": EffectRule(("backrest",), needs=("shell_modes",)),
    "carcass": EffectRule(("tire",), needs=("normal_elastic",)),
    "envelopment": EffectRule(("tire",), needs=("contact_field",)),
    "tread_viscoelasticity": EffectRule(("tire",), needs=("contact_field",)),
    "brush": EffectRule(("tire",), needs=("contact_field",)),
    "asperity_impulses": EffectRule(("tire",), needs=("normal_elastic",)),
    "shift": EffectRule(("impact",), needs=("normal_elastic",)),
    "contact_stress": EffectRule(("impact",), needs=("normal_elastic",)),
    "surface_waves": EffectRule(("impact",), needs=("normal_elastic", "normal_dissipative")),
    "micro_front": EffectRule(("impact",), needs=("normal_elastic",)),
    "thermal_volume": EffectRule(("impact",), needs=("normal_elastic",)),
    "history": EffectRule(("impact",), needs=("normal_elastic", "normal_dissipative")),
    "gauge_noise": EffectRule(("impact",), needs=("normal_elastic",)),
    "rigid_contact": EffectRule(("block",)),
    "compliant_contact": EffectRule(("block",), needs=("rigid_contact",)),
    "tilt_yaw": EffectRule(("roller",), needs=("normal_elastic",)),
    "gyroscope": EffectRule(("roller",), needs=("tilt_yaw",)),
    "rolling_friction": EffectRule(("roller",), needs=("tilt_yaw",)),
    "shaft_bending": EffectRule(("roller",), needs=("normal_elastic",)),
    "track_waves": EffectRule(("roller",), needs=("normal_elastic",)),
    "subsurface": EffectRule(("roller",), needs=("normal_elastic",)),
    "damage": EffectRule(("roller",), needs=("track_waves", "subsurface")),
}

CARRIERS: dict[str, str] = {"block": "rigid_contact"}
"""The effect that carries the load of a contact, where it is not `normal_elastic`."""


def carrier_of(contact: str) -> str:
    """The effect without which a contact carries no load."""
    return CARRIERS.get(contact, "normal_elastic")


def dependents_of(effect: str) -> set[str]:
    """Effects that cannot act without ``effect``, those that need them included."""
    found: set[str] = set()
    for name, rule in EFFECT_RULES.items():
        if effect in rule.needs:
            found |= {name} | dependents_of(name)
    return found


def effects_of(scene: Scene, contact: str) -> list[str]:
    """Names of the effects that a scene calls for at a contact, in the order of the table."""
    section = getattr(scene.effects, contact)
    return [name for name in EFFECT_RULES if getattr(section, name, None) is not None]


def effect_breaches(scene: Scene) -> Iterator[Breach]:
    """Contacts that the rig lacks or leaves without elastic force; effects without what they need, or that exclude."""
    own = rigs()[scene.rig].contacts
    for contact in contacts():
        where = f"effects.{contact}"
        if contact not in own:
            if getattr(scene.effects, contact) is not None:
                yield Breach(
                    where, f"the rig {scene.rig} has no contact {contact}; it has {' and '.join(own)}", ("rig",)
                )
            continue
        named = effects_of(scene, contact)
        if carrier_of(contact) not in named:
            yield Breach(
                f"{where}.{carrier_of(contact)}",
                f"is missing: the contact {contact} carries no load without it; write {{}}",
                ("rig",),
            )
        yield from _between(where, named)


def _between(where: str, named: list[str]) -> Iterator[Breach]:
    for name in named:
        for needed in EFFECT_RULES[name].needs:
            if needed not in named:
                yield Breach(
                    f"{where}.{name}", f"{name} needs {needed}, which the scene does not name; add it or remove {name}"
                )
    for one, other in combinations(named, 2):
        if other in EFFECT_RULES[one].excludes or one in EFFECT_RULES[other].excludes:
            yield Breach(
                f"{where}.{other}", f"{one} and {other} exclude each other; remove one of them", (f"{where}.{one}",)
            )


def unavailable_effect(path: tuple[str | int, ...]) -> str:
    """The sentence for an effect that exists, but not at this contact; empty for anything else."""
    if len(path) != 3 or path[0] != "effects" or path[2] not in EFFECT_RULES:
        return ""
    contacts = EFFECT_RULES[str(path[2])].contacts
    return (
        f"the effect {path[2]} is not available at the contact {path[1]}, only at {' and '.join(contacts)}; remove it"
    )
