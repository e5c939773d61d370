"""The tables of `docs/scenes.md`: every key of the schema with unit, range, default and meaning.

`python -m contact_sim_lab.pages.scene_reference docs/scenes.md` writes them between the two marks
of that file.
"""

from __future__ import annotations

import sys
import textwrap
from collections.abc import Mapping
from itertools import groupby
from pathlib import Path

from contact_sim_pkg.records.contact import LOOSEST_INTEGRATION, Contact
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.records.registry import contacts, effects
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.scene.schema.accuracy import FASTEST, LEVELS, Level
from contact_sim_pkg.scene.schema.catalog import Entry, Location, catalog, show
from contact_sim_pkg.scene.schema.pressure_field import LOOSER, PressureFieldSection

BEGIN = "<!-- tables made from the schema: begin -->"
END = "<!-- tables made from the schema: end -->"
HEAD = "| key | unit | allowed | default | meaning |\n|---|---|---|---|---|"


def reference() -> str:
    """All tables, as Markdown."""
    sections = groupby(
        sorted(catalog().values(), key=lambda entry: _order(entry.location[:-1])), lambda entry: entry.location[:-1]
    )
    tables = [_section(location, list(entries)) for location, entries in sections]
    return "\n\n".join([*tables, _effects(), _accuracy()])


def with_tables(document: str) -> str:
    """The document with its tables made anew.

    Raises:
        ValueError: one of the two marks is missing.
    """
    before, begin, rest = document.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise ValueError(f"the document needs the lines {BEGIN!r} and {END!r}")
    return f"{before}{BEGIN}\n\n{reference()}\n\n{END}{after}"


def _order(location: Location) -> tuple[int, ...]:
    """Sections in the order of the schema, the root first."""
    places = {where: index for index, where in enumerate(catalog())}
    return tuple(places.get(location[:length], length) for length in range(1, len(location) + 1))


def _section(location: Location, entries: list[Entry]) -> str:
    if not location:
        title = "### the scene"
    elif location in catalog():
        title = f"### `{'.'.join(location)}`\n\n{catalog()[location].help}"
    else:
        title = f"### `{location[0]}` of `kind: {location[1]}`"
    rows = [_row(entry) for entry in entries if entry.location[-1] != "kind"]
    return "\n".join([title, "", HEAD, *rows] if rows else [title, "", "No further key."])


def _row(entry: Entry) -> str:
    cells = (f"`{entry.location[-1]}`", entry.unit, _allowed(entry), _default(entry), entry.help)
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _allowed(entry: Entry) -> str:
    if entry.kind == "kinds":
        return "mapping, `kind`: " + ", ".join(entry.words)
    if entry.kind == "section":
        return "mapping"
    if entry.kind == "text":
        return "text"
    return entry.allowed.removesuffix(f" {entry.unit}") if not entry.allowed_text else entry.allowed


def _default(entry: Entry) -> str:
    if entry.location == ("name",):
        return "name of the file"
    if entry.required:
        return "required"
    if entry.kind in ("section", "kinds"):
        return "" if entry.default is None else "defaults"
    if entry.default is None or entry.default == "":
        return ""
    if isinstance(entry.default, bool):
        return str(entry.default).lower()
    return str(entry.default) if isinstance(entry.default, list) else show(entry.default)


def _effects() -> str:
    carried = _by_contact({name: [" or ".join(contact.carriers)] for name, contact in contacts().items()}, "; ")
    head = f"### which effects go together\n\n{textwrap.fill(f'The load is carried by {carried}.', 100)}\n\n"
    head += "| effect | contacts | needs | excludes |\n|---|---|---|---|"
    rows = []
    for name, records in effects().items():
        needs = _by_contact({contact: _needed(contacts()[contact], each) for contact, each in records.items()})
        excludes = _by_contact({contact: _excluded(contacts()[contact], each) for contact, each in records.items()})
        rows.append(f"| `{name}` | {', '.join(records)} | {needs} | {excludes} |")
    return "\n".join([head, *rows])


def _by_contact(said: Mapping[str, list[str]], between: str = ", ") -> str:
    """What is said of contacts, each with the contacts that it holds at, unless at all."""
    found: dict[str, list[str]] = {}
    for contact, phrases in said.items():
        for phrase in phrases:
            found.setdefault(phrase, []).append(contact)
    return between.join(
        phrase if len(where) == len(said) else f"{phrase} ({', '.join(where)})" for phrase, where in found.items()
    )


def _needed(contact: Contact, effect: Effect) -> list[str]:
    """What the effect needs at a contact: each need with all that meet it beside the effect."""
    excluded = _excluded(contact, effect)
    return [" or ".join(name for name in contact.enough(needed) if name not in excluded) for needed in effect.needs]


def _excluded(contact: Contact, effect: Effect) -> list[str]:
    """Effects of a contact beside which the effect cannot act, whichever of the two says so."""
    return [each.name for each in contact.effects if each.name in effect.excludes or effect.name in each.excludes]


def _accuracy() -> str:
    head = (
        "### what `accuracy` stands for\n\n"
        "| requested error | fidelity level | contact | rows × cols | field tolerance | corrector passes |\n"
        "|---|---|---|---|---|---|"
    )
    fields = {
        contact: section
        for records in effects().values()
        for contact, record in records.items()
        if issubclass(section := load(record.section), PressureFieldSection)
    }
    rows = [
        f"| {_requested(level)} | {level.name} | {contact} | {grid.rows} × {grid.cols} | {grid.tolerance:g} "
        f"| {grid.corrector_passes} |"
        for place, level in enumerate(LEVELS)
        for contact, grid in ((contact, field.levels[place]) for contact, field in fields.items())
    ]
    loosest = {contact.name: contact.loosest_integration({}) for contact in contacts().values()}
    note = f"With {FASTEST:g} or realtime the field tolerance is {LOOSER:g} times that of the first rows.\n\n"
    note += "The relative tolerance of the time integration is a hundredth of the requested error,\n"
    note += f"at most {LOOSEST_INTEGRATION:g}; that of a rigid body at most {min(loosest.values()):g}."
    return "\n".join([head, *rows, "", note])


def _requested(level: Level) -> str:
    if level is LEVELS[0]:
        return f"from {level.accuracy:g}, or realtime"
    return f"from {level.accuracy:g}" if level.accuracy else "below"


def main(arguments: list[str]) -> int:
    """Write the tables into the given document."""
    path = Path(arguments[0])
    path.write_text(with_tables(path.read_text(encoding="utf-8")), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
