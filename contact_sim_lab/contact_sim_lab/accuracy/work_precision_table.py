"""The rows of a rig's work-precision studies as a person reads them: a table a study and case."""

from __future__ import annotations

from contact_sim_lab.accuracy.lines import error_lines
from contact_sim_lab.records.work_precision import Row
from contact_sim_pkg.records.table import Section

__all__ = ["ROUNDING", "sections"]

ROUNDING = 1e-11
"""A quantity that is given comes back to rounding; beside another it has no column."""

COST = ("ms_per_call", "ms a call")


def sections(rows: list[Row]) -> list[Section]:
    """In the order of the study; where every line is a grid, the error's two parts stand beside
    each other.
    """
    found = []
    for part, case in dict.fromkeys((row["part"], row["case"]) for row in rows):
        chosen = [row for row in rows if (row["part"], row["case"]) == (part, case)]
        found.append(Section(f"{part}: {case}", _lines(chosen), f"error against: {chosen[0]['reference']}"))
    return found


def _lines(rows: list[Row]) -> list[Row]:
    """One line a fidelity level, grid and tolerance: errors by quantity, whole or as solver and
    grid, then the time.
    """
    names = list(dict.fromkeys(row["quantity"] for row in rows))
    shown = [name for name in names if any(row["error"] > ROUNDING for row in rows if row["quantity"] == name)] or names
    divided = all(row["solver_error"] is not None for row in rows)
    on_grids = any(row["grid"] is not None for row in rows)

    def errors(row: Row) -> Row:
        name = row["quantity"]
        if name not in shown:
            return {}
        if divided:
            return {f"{name}: solver": row["solver_error"], f"{name}: grid": row["grid_error"]}
        return {name: row["error"]}

    key = ("level", "grid", "tolerance")
    return error_lines(rows, {name: name for name in (key if on_grids else key[:1])}, key, errors, COST)
