"""The rows of an accuracy study as a person reads them: one line a tolerance, grid or rung, its errors side by side."""

from __future__ import annotations

from typing import Any

from contact_sim_pkg.records.table import Section
from contact_sim_pkg.rigs.roller.studies.accuracy import PARTS as ROLLER_PARTS

__all__ = ["sections"]

Row = dict[str, Any]
COST = "ms per simulated s"


def sections(rows: list[Row]) -> list[Section]:
    """Parts of the table, in the order of the study: integrator, coupling, modes, ways to an impact, those of a rigid body and
    of the roller, then each contact's field.
    """
    found = [_integrator(rows), _coupling(rows), _modes(rows), _ways(rows), *_of_block(rows)]
    found += [_by_rung(f"{part}: error", part, "way", rows) for part in ROLLER_PARTS]
    for contact in ("tire", "seat"):
        of_contact = [row for row in rows if row["part"].startswith("field") and row["quantity"].startswith(contact)]
        on_rungs = [row for row in of_contact if row["rung"] != "check"]
        solver = [row for row in on_rungs if row["part"] == "field solver"]
        grid = [row for row in on_rungs if row["part"] == "field grid"]
        check = [row for row in of_contact if row["rung"] == "check"]
        found.append(_field(f"{contact} field, error of the solver", contact, solver))
        found.append(_field(f"{contact} field, error of the grid", contact, grid))
        found.append(_field(f"{contact} field, started from nothing, against another code", contact, check))
    return [section for section in found if section.rows] + [_start_up(rows)]


def _integrator(rows: list[Row]) -> Section:
    return _by_tolerance("time integration, point contacts: error", "integrator", rows)


def _coupling(rows: list[Row]) -> Section:
    return _by_tolerance("coupling of bodies and pressure fields: error", "coupling", rows)


def _modes(rows: list[Row]) -> Section:
    return _by_rung("modes of the shell: error", "modes", "modes", rows)


def _ways(rows: list[Row]) -> Section:
    return _by_rung("first impact of the scene: error", "first impact", "way", rows)


def _of_block(rows: list[Row]) -> list[Section]:
    return [
        _by_rung("scheme in time: distance over the body's size, turn in rad", "scheme in time", "scheme", rows),
        _by_tolerance(
            "body that turns on held contacts: distance over that from the corner", "turning on held contacts", rows
        ),
        _by_rung("friction cone: the same", "friction cone", "cone", rows),
        _by_rung("contact model: difference of the two, the same", "contact model", "contact", rows),
    ]


def _by_rung(title: str, part: str, name: str, rows: list[Row]) -> Section:
    """One line a rung, the errors of its quantities side by side; its tolerance where it has one."""
    chosen = [row for row in rows if row["part"] == part]
    lines: dict[str, Row] = {}
    for row in chosen:
        head = {name: row["rung"]} if row["tolerance"] is None else {name: row["rung"], "tolerance": row["tolerance"]}
        line = lines.setdefault(row["rung"], head)
        line[row["quantity"]] = row["error"]
    for row in chosen:
        lines[row["rung"]][COST] = row["ms_per_simulated_s"]
    return Section(title, list(lines.values()), _against(chosen))


def _by_tolerance(title: str, part: str, rows: list[Row]) -> Section:
    """One line a tolerance, the errors of its quantities side by side."""
    chosen = [row for row in rows if row["part"] == part]
    lines: dict[float, Row] = {}
    for row in chosen:
        line = lines.setdefault(row["tolerance"], {"tolerance": row["tolerance"]})
        line[row["quantity"]] = row["error"]
    for row in chosen:
        lines[row["tolerance"]][COST] = row["ms_per_simulated_s"]
    return Section(title, list(lines.values()), _against(chosen))


def _field(title: str, contact: str, chosen: list[Row]) -> Section:
    lines: dict[tuple[str, float], Row] = {}
    for row in chosen:
        head = {"rung": row["rung"], "grid": row["grid"], "tolerance": row["tolerance"]}
        line = lines.setdefault((row["grid"], row["tolerance"]), head)
        line[row["quantity"].removeprefix(f"{contact} ")] = row["error"]
    for row in chosen:
        lines[row["grid"], row["tolerance"]][COST] = row["ms_per_simulated_s"]
    return Section(title, list(lines.values()), _against(chosen))


def _against(rows: list[Row]) -> str:
    """What the errors are against; where not all are against the same, which are."""
    quantities: dict[str, list[str]] = {}
    for row in rows:
        named = quantities.setdefault(row["reference"], [])
        named += [row["quantity"]] if row["quantity"] not in named else []
    if len(quantities) < 2:
        return f"against: {rows[0]['reference']}" if rows else ""
    return "against: " + "; ".join(f"{reference} ({', '.join(named)})" for reference, named in quantities.items())


def _start_up(rows: list[Row]) -> Section:
    lines: dict[str, Row] = {}
    for row in rows:
        what = "first field solve" if row["part"].startswith("field") else "first block of the scene"
        lines[what] = {"until": what, "compiled anew [s]": row["first_call_s"], "from disk [s]": row["next_start_s"]}
    return Section("start in a new process", list(lines.values()))
