"""The rows of a rig's ladders as a person reads them: a section a ladder and case, one line a rung."""

from __future__ import annotations

from contact_sim_pkg.records.table import Section
from contact_sim_pkg.records.work_precision import Row

__all__ = ["ROUNDING", "sections"]

ROUNDING = 1e-11
"""A quantity that is given comes back to rounding; beside another it has no column."""

COST = "ms a call"


def sections(rows: list[Row]) -> list[Section]:
    """In the order of the study; where every line is a grid, the error's two parts stand beside each other."""
    found = []
    for part, case in dict.fromkeys((row["part"], row["case"]) for row in rows):
        chosen = [row for row in rows if (row["part"], row["case"]) == (part, case)]
        found.append(Section(f"{part}: {case}", _lines(chosen), f"error against: {chosen[0]['reference']}"))
    return found


def _lines(rows: list[Row]) -> list[Row]:
    """One line a rung, grid and tolerance: errors by quantity, whole or as solver and grid, then the time."""
    names = list(dict.fromkeys(row["quantity"] for row in rows))
    shown = [name for name in names if any(row["error"] > ROUNDING for row in rows if row["quantity"] == name)] or names
    divided = all(row["solver_error"] is not None for row in rows)
    on_grids = any(row["grid"] is not None for row in rows)
    lines: dict[tuple[object, ...], Row] = {}
    times: dict[tuple[object, ...], Row] = {}
    for row in rows:
        key = (row["rung"], row["grid"], row["tolerance"])
        head = {"rung": row["rung"], **({"grid": row["grid"], "tolerance": row["tolerance"]} if on_grids else {})}
        line = lines.setdefault(key, head)
        times[key] = {COST: row["ms_per_call"]}
        name = row["quantity"]
        if name in shown and divided:
            line[f"{name}: solver"], line[f"{name}: grid"] = row["solver_error"], row["grid_error"]
        elif name in shown:
            line[name] = row["error"]
    return [{**line, **times[key]} for key, line in lines.items()]
