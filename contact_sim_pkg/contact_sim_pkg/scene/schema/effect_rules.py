"""Rules between effects: which a contact offers, what each needs, which exclude each other, by
their records.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import combinations

from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.records.registry import contacts, effects, rigs
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.scene import Scene


def effect_breaches(scene: Scene) -> Iterator[Breach]:
    """Contacts that the rig lacks or leaves without elastic force; effects without what they need,
    or that exclude.
    """
    own = rigs()[scene.rig].contacts
    for contact in contacts().values():
        where, name = f"effects.{contact.name}", contact.name
        if contact not in own:
            if getattr(scene.effects, name) is not None:
                names = " and ".join(each.name for each in own)
                yield Breach(where, f"the rig {scene.rig} has no contact {name}; it has {names}", ("rig",))
            continue
        named = [name for name, _effect in scene.effects_at(contact)]
        usual, *others = contact.carriers
        if not set(contact.carriers) & set(named):
            instead = "".join(f" or {each}" for each in others)
            sentence = f"is missing: the contact {name} carries no load without it{instead}; write {{}}"
            yield Breach(f"{where}.{usual}", sentence, ("rig", *(f"{where}.{each}" for each in contact.carriers)))
        yield from _between(where, contact, named)


def _between(where: str, contact: Contact, named: list[str]) -> Iterator[Breach]:
    records = [effect for effect in contact.effects if effect.name in named]
    for effect in records:
        for needed in contact.missing(effect, named):
            # Not where what it needs is there but faulty, or was just reported as missing.
            yield Breach(
                f"{where}.{effect.name}",
                f"{effect.name} needs {needed}, which the scene does not name; add it or remove {effect.name}",
                tuple(f"{where}.{each}" for each in contact.enough(needed)),
            )
    yield from _excluding(where, records)


def _excluding(where: str, records: list[Effect]) -> Iterator[Breach]:
    """Effects that exclude each other: one sentence for all that one of them stands in place of."""
    pairs = [
        (one.name, other.name)
        for one, other in combinations(records, 2)
        if other.name in one.excludes or one.name in other.excludes
    ]
    often, replaced = Counter(name for pair in pairs for name in pair), dict[str, list[str]]()
    for one, other in pairs:
        first, second = (other, one) if often[other] > often[one] else (one, other)
        replaced.setdefault(first, []).append(second)
    for name, others in replaced.items():
        if len(others) == 1:
            yield Breach(
                f"{where}.{others[0]}",
                f"{name} and {others[0]} exclude each other; remove one of them",
                (f"{where}.{name}",),
            )
        else:
            named = f"{', '.join(others[:-1])} and {others[-1]}"
            yield Breach(
                f"{where}.{name}", f"{name} stands in place of {named}; remove it or these",
                tuple(f"{where}.{each}" for each in others),
            )  # fmt: skip


def unavailable_effect(path: tuple[str | int, ...]) -> str:
    """The sentence for an effect that exists, but not at this contact; empty for anything else."""
    if len(path) != 3 or path[0] != "effects" or path[2] not in effects():
        return ""
    found = " and ".join(effects()[str(path[2])])
    return f"the effect {path[2]} is not available at the contact {path[1]}, only at {found}; remove it"
