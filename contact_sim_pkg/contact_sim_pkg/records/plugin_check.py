"""What a package of others brings, checked once when it is loaded: each text `module:name` names
something that is there, and each name is free.

Sections of scenes are imported, as each command does that reads one. Everything else is looked for
without being imported, in the source of its module: a simulation costs a second, and a command may
need the rigs that are just being found.
"""

from __future__ import annotations

import re
import symtable
import sys
from collections.abc import Iterable, Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any, get_args

from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.definitions import texts
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.records.rig import Rig, load
from contact_sim_pkg.records.topic import ContactTopic

__all__ = [
    "KINDS", "RESERVED", "fault_of_place", "faults_of_effects", "faults_of_kind", "faults_of_rig", "places_of_effects",
    "places_of_rig",
]  # fmt: skip

RESERVED = frozenset(
    {
        "name", "description", "rig", "duration", "seed", "pace", "block_length", "accuracy", "plugins", "travel", "road",
        "slip", "vibration", "effects", "expect", "outputs", "integrator", "limits", "bench", "platform",
    }
)  # fmt: skip
"""Names that no contact has: keys of a scene, and what the bench's own topics begin with."""
KINDS = {"road": "roads", "vibration": "vibrations"}
"""Sections of a scene that have kinds: the folder of ours in `excitation`, and the entry-point group of others'."""
_SECTION = "contact_sim_pkg.records.fields:Section"
_BASE = "contact_sim_pkg.excitation.kinds:{}Kind"
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)*")
_MADE_WHILE_IMPORTED = re.compile(r"import +\(? *\*|__getattr__|globals\(\)")
"""Names of a module that its source does not show."""


def places_of_rig(rig: Rig) -> Iterator[str]:
    """Each text ``module:name`` of a rig and its contacts, sections included."""
    yield from _places_of_rig_alone(rig)
    for contact in rig.contacts:
        yield from (contact.section, *contact.rules, *places_of_effects(contact.effects))


def _places_of_rig_alone(rig: Rig) -> Iterator[str]:
    single = (rig.simulation, rig.road_strip, rig.work, rig.other_half, rig.forecast, rig.standing, rig.events)
    measures = (each.measure for each in rig.regimes)
    return (place for place in (*single, *rig.report, *rig.rules, *measures) if place)


def places_of_effects(effects: Iterable[Effect]) -> Iterator[str]:
    """Each text ``module:name`` of effects."""
    return (place for effect in effects for place in (effect.section, effect.observer, effect.elements) if place)


def faults_of_rig(package: str, rig: Rig) -> Iterator[str]:
    """What is wrong with a rig that a package exports, a phrase each."""
    where = f"rig {rig.name}"
    yield from _faults_of_name(where, rig.name)
    yield from _faults_of_places(where, _places_of_rig_alone(rig))
    for contact in rig.contacts:
        yield from _faults_of_contact(f"{where}, contact {contact.name}", contact)
    folder = Path(str(load(package).__file__)).parent / "scenes"
    for scene in rig.scenes:
        if not (folder / f"{scene}.yaml").is_file():
            yield f"{where}: its scene {scene} is not there; put scenes/{scene}.yaml into the package_data of {package}"


def _faults_of_contact(where: str, contact: Contact) -> Iterator[str]:
    if contact.name in RESERVED:
        yield f"{where}: the bench uses this name in every scene or topic; rename the contact"
    if not contact.carriers:
        yield f"{where}: none of its effects carries the load; set carries=True in the one that does"
    yield from _faults_of_key(where, contact.name, contact.section, may_be_absent=True)
    yield from _faults_of_places(where, contact.rules)
    for topic in contact.topics:
        yield from _faults_of_topic(where, topic)
    yield from faults_of_effects(where, contact.effects)


def faults_of_effects(where: str, effects: Iterable[Effect]) -> Iterator[str]:
    """What is wrong with effects of a contact, a phrase each that begins with ``where``."""
    seen: set[str] = set()
    for effect in effects:
        here = f"{where}, effect {effect.name}"
        if effect.name in seen:
            yield f"{here}: two effects have this name; rename one"
        seen.add(effect.name)
        yield from _faults_of_key(here, effect.name, effect.section)
        yield from _faults_of_places(here, filter(None, (effect.observer, effect.elements)))
        if effect.topic is not None:
            yield from _faults_of_topic(here, effect.topic)


def faults_of_kind(section: str, name: str, place: str) -> Iterator[str]:
    """What is wrong with a kind of a ``section`` of the scene by its name, a phrase each."""
    where = f"{section} {name}"
    base: Any = load(_BASE.format(section.title()))
    yield from _faults_of_name(where, name)
    try:
        found: Any = load(place)
        if not isinstance(found, type(base)) or not issubclass(found, base):
            yield f"{where}: {place} is no class below {base.__name__}"
            return
        found.model_rebuild()
        if get_args(found.model_fields["kind"].annotation) != (name,):
            yield f'{where}: {place} needs the key kind: Literal["{name}"]'
        if missing := sorted(found.__abstractmethods__):
            yield f"{where}: {place} has no {missing[0]}"
    except (Exception, SystemExit) as error:  # noqa: BLE001 - whatever a stranger's module raises
        yield f"{where}: {place} does not load ({type(error).__name__}: {error})"


def _faults_of_topic(where: str, topic: ContactTopic) -> Iterator[str]:
    yield from _faults_of_name(f"{where}, topic {topic.name}", topic.name)
    if topic.type not in texts():
        yield f"{where}, topic {topic.name}: the bench has no message type {topic.type}"


def _faults_of_key(where: str, name: str, section: str, *, may_be_absent: bool = False) -> Iterator[str]:
    """Of a key of the scene and the class of its section; one that may be absent has defaults alone."""
    yield from _faults_of_name(where, name)
    base: Any = load(_SECTION)
    if hasattr(base, name):
        yield f"{where}: every section of a scene has a method of this name; take another name"
    try:
        found = load(section)
        if not (isinstance(found, type) and issubclass(found, base)):
            yield f"{where}: section {section} is no class below Section"
        else:
            found.model_rebuild()  # type: ignore[attr-defined]
            required = [key for key, field in found.model_fields.items() if may_be_absent and field.is_required()]  # type: ignore[attr-defined]
            yield from (f"{where}: section {section}: its key {key} needs a default" for key in required)
    except (Exception, SystemExit) as error:  # noqa: BLE001 - whatever a stranger's module raises
        yield f"{where}: section {section} does not load ({type(error).__name__}: {error})"


def _faults_of_name(where: str, name: str) -> Iterator[str]:
    if not _NAME.fullmatch(name):
        yield f"{where}: {name!r} is no name of ASCII letters, digits and single underscores between them"


def _faults_of_places(where: str, places: Iterable[str]) -> Iterator[str]:
    yield from (f"{where}: {fault}" for place in places if (fault := fault_of_place(place)))


def fault_of_place(text: str) -> str:
    """Why ``module:name``, or ``module``, names nothing; empty where it names something. The module
    is not imported, those that it lies in are.
    """
    module, _, name = text.partition(":")
    try:
        spec = find_spec(module)
    except (Exception, SystemExit) as error:  # noqa: BLE001 - whatever a stranger's module raises
        return f"{text} does not load ({type(error).__name__}: {error})"
    if spec is None:
        return f"{text} does not load (there is no module {module})"
    try:
        there = not name or _binds(module, spec.loader, name)
    except SyntaxError as error:
        return f"{text} does not load ({type(error).__name__}: {error})"
    return "" if there else f"{text} does not load (the module {module} has no {name})"


def _binds(module: str, loader: Any, name: str) -> bool:
    """Whether a module has a name, as far as its source shows; True where it does not show that."""
    if module in sys.modules and hasattr(sys.modules[module], name):
        return True
    source = loader.get_source(module) if hasattr(loader, "get_source") else None
    if source is None or _MADE_WHILE_IMPORTED.search(source):
        return True
    table = symtable.symtable(source, module, "exec")
    return name in table.get_identifiers() and (table.lookup(name).is_assigned() or table.lookup(name).is_imported())
