"""`bench accuracy SCENE` at first look: one table of what was requested, delivered and paid.

Columns of a row: `scene`, `requested`, delivered `force`, `motion`, `peak`, `area` (largest error over
the scale of its kind, null where the scene has none), `estimated` by the run itself,
`cpu_s_per_s`, `own` (what the scene requests), `held` (force and motion), `cheapest_for` (requests
that no cheaper run holds), `not_resolved` (by contact and component, error over its own largest
value), `largest` (by kind, where the error is largest), `agrees_until_s` (where the run parts from
the finer one), and of all rows `start_s`, `end_s`, `reference`, `same` (dials that no request
moves).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from contact_sim_pkg.compare.first_look import FirstLook, Request, cheapest_for, first_look
from contact_sim_pkg.compare.judgement import Judgement
from contact_sim_pkg.compare.sentences import MODEL, SAME_BITS
from contact_sim_pkg.records.definitions import KINDS
from contact_sim_pkg.records.table import Section, number_of
from contact_sim_pkg.studies.accuracy.first_look_plot import write_plot

__all__ = ["rows_of", "sections", "study", "write_plot"]

Row = dict[str, Any]
EXPLAINED = "largest errors over the scale of their kind; 0: less than 1e-15; !: more than requested"


def study(scene_names: Sequence[str], progress: Callable[[str], None], *, deep: bool = False) -> list[Row]:
    """Rows of each scene, by name or path, coarsest request first. Raises what a bad scene raises."""
    return [row for name in scene_names for row in rows_of(first_look(name, progress, deep=deep))]


def rows_of(look: FirstLook) -> list[Row]:
    """Flat rows of one scene."""
    cheapest: dict[float, list[float]] = {}
    for request in look.requests:
        found = cheapest_for(look.requests, request.requested)
        if found is not None:
            cheapest.setdefault(found.requested, []).append(request.requested)
    return [_row(look, request, cheapest.get(request.requested, [])) for request in look.requests]


def sections(rows: list[Row]) -> list[Section]:
    """The table of one scene; of several one table, and how many of them hold each request."""
    groups = [[row for row in rows if row["scene"] == name] for name in dict.fromkeys(row["scene"] for row in rows)]
    if len(groups) == 1:
        return [Section(groups[0][0]["scene"], _lines(rows), _note(rows))]
    named: list[dict[str, str]] = []
    for group in groups:
        names = [group[0]["scene"], *("" for _ in group[1:])]
        named += [{"scene": name, **line} for name, line in zip(names, _lines(group), strict=True)]
    return [Section(f"{len(groups)} scenes", named, f"{EXPLAINED}; {MODEL}"), _held(groups)]


def _held(groups: list[list[Row]]) -> Section:
    """At each request: how many scenes hold it in force and motion, and which do not."""
    lines = []
    for request in sorted({row["requested"] for group in groups for row in group}, reverse=True):
        at_request = [row for group in groups for row in group if row["requested"] == request]
        lost = [row["scene"] for row in at_request if not row["held"]]
        held = f"{len(at_request) - len(lost)} of {len(at_request)}"
        lines.append({"requested": number_of(request), "held": held, "not held": ", ".join(lost)})
    return Section("force and motion", lines)


def _row(look: FirstLook, request: Request, cheapest: list[float]) -> Row:
    return {
        "scene": look.scene,
        "requested": request.requested,
        **{kind: request.errors.get(kind) for kind in KINDS},
        "estimated": request.estimated,
        "cpu_s_per_s": request.cost,
        "own": request.own,
        "held": request.holds(request.requested),
        "cheapest_for": cheapest,
        "not_resolved": {
            f"{each.place} {lost.column}": lost.share for each in request.judgements for lost in each.unresolved
        },
        "largest": {
            kind: _largest([each for each in request.judgements if each.kind == kind]) for kind in request.errors
        },
        "agrees_until_s": request.agrees_until,
        "start_s": look.start,
        "end_s": look.end,
        "reference": look.reference,
        "reference_cpu_s_per_s": look.reference_cost,
        "same": look.same,
    }


def _largest(judgements: list[Judgement]) -> dict[str, Any]:
    """Where the error of a kind is largest."""
    worst = max(judgements, key=lambda each: each.error)
    return {"place": worst.place, "column": worst.column, "time_s": worst.time}


def _lines(rows: list[Row]) -> list[dict[str, str]]:
    lines = [
        {
            "requested": number_of(row["requested"]),
            **{kind: _error(row[kind], row["requested"]) for kind in KINDS},
            "estimated": number_of(row["estimated"]["force"]) if "force" in row["estimated"] else "-",
            "CPU s/s": f"{row['cpu_s_per_s']:.2g}",
            "": _marks(row),
            "not resolved": ", ".join(f"{what} ({100.0 * share:.0f} %)" for what, share in row["not_resolved"].items()),
        }
        for row in rows
    ]
    if not any(line["not resolved"] for line in lines):
        lines = [{key: value for key, value in line.items() if key != "not resolved"} for line in lines]
    return lines


def _note(rows: list[Row]) -> str:
    """What the errors of one scene are, and what they leave out."""
    first = rows[0]
    note = (
        f"{EXPLAINED}; {first['start_s']:g} to {first['end_s']:g} s, against the scene at {number_of(first['reference'])} "
        f"({first['reference_cpu_s_per_s']:.2g} CPU s/s), itself only estimated; {MODEL}"
    )
    if not any(row[kind] for row in rows for kind in KINDS):
        note += f"; {SAME_BITS}"
    if first["same"]:
        note += f"; no request moves {', '.join(first['same'])}"
    return note


def _error(error: float | None, requested: float) -> str:
    if error is None:
        return "-"
    return number_of(error) + (" !" if error > requested else "")


def _marks(row: Row) -> str:
    marks = ["<- this scene"] if row["own"] else []
    if row["cheapest_for"]:
        marks.append(f"cheapest for {', '.join(map(number_of, row['cheapest_for']))}")
    if row["agrees_until_s"] is not None:
        marks.append(f"agrees until {row['agrees_until_s']:.3g} s")
    return "; ".join(marks)
