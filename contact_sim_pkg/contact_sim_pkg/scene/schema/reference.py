"""The tables of `docs/scenes.md`: every key of the schema with unit, range, default and meaning.

`python -m contact_sim_pkg.scene.schema.reference docs/scenes.md` writes them between the two marks of that file.
"""

from __future__ import annotations

import sys
from itertools import groupby
from pathlib import Path

from contact_sim_pkg.scene.schema.accuracy import RUNGS, Contact, Rung, integration_tolerance
from contact_sim_pkg.scene.schema.catalog import Entry, Location, catalog, show
from contact_sim_pkg.scene.schema.effect_rules import EFFECT_RULES

BEGIN = "<!-- tables made from the schema: begin -->"
END = "<!-- tables made from the schema: end -->"
CONTACTS: tuple[Contact, ...] = ("tire", "seat")
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
    head = "### which effects go together\n\n| effect | contacts | needs | excludes |\n|---|---|---|---|"
    rows = [
        f"| `{name}` | {', '.join(rule.contacts)} | {', '.join(rule.needs)} | {', '.join(rule.excludes)} |"
        for name, rule in EFFECT_RULES.items()
    ]
    return "\n".join([head, *rows])


def _accuracy() -> str:
    head = (
        "### what `accuracy` stands for\n\n"
        "| requested error | fidelity level | contact | rows × cols | field tolerance | corrector passes |\n"
        "|---|---|---|---|---|---|"
    )
    rows = [_rung_row(rung, contact) for rung in RUNGS for contact in CONTACTS]
    largest, held = (integration_tolerance("realtime", impacts=impacts) for impacts in (False, True))
    note = "The relative tolerance of the time integration is a hundredth of the requested error,\n"
    note += f"at most {largest:g}; that of a rigid body at most {held:g}."
    return "\n".join([head, *rows, "", note])


def _rung_row(rung: Rung, contact: Contact) -> str:
    rows, cols = rung.cells(contact)
    tolerance, passes = rung.field_tolerance(contact), rung.passes(contact)
    return f"| {_asked(rung)} | {rung.name} | {contact} | {rows} × {cols} | {tolerance:g} | {passes} |"


def _asked(rung: Rung) -> str:
    if rung is RUNGS[0]:
        return f"from {rung.accuracy:g}, or realtime"
    return f"from {rung.accuracy:g}" if rung.accuracy else "below"


def main(arguments: list[str]) -> int:
    """Write the tables into the given document."""
    path = Path(arguments[0])
    path.write_text(with_tables(path.read_text(encoding="utf-8")), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
