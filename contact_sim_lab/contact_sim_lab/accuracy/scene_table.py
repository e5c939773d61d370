"""The rows of an accuracy study as a person reads them: a table a part, one line a tolerance, grid
or fidelity level.
"""

from __future__ import annotations

from contact_sim_lab.accuracy.lines import Row, against, error_lines, parts_of_rigs
from contact_sim_lab.records.accuracy import AccuracyPart
from contact_sim_pkg.records.table import Section

__all__ = ["sections"]

COST = ("ms_per_simulated_s", "ms per simulated s")


def sections(rows: list[Row]) -> list[Section]:
    """Tables in the order of the rigs and their parts, those without rows left out; then the start
    in a new process.
    """
    found = [_table(part, [row for row in rows if part.holds(row)]) for part in parts_of_rigs()]
    return [section for section in found if section.rows] + [_start_up(rows)]


def _table(part: AccuracyPart, rows: list[Row]) -> Section:
    if part.contact:
        head = {name: name for name in ("level", "grid", "tolerance")}
        key: tuple[str, ...] = ("grid", "tolerance")
    elif part.level:
        head, key = {"level": part.level, "tolerance": "tolerance"}, ("level",)
    else:
        head, key = {"tolerance": "tolerance"}, ("tolerance",)
    prefix = f"{part.contact} " if part.contact else ""
    lines = error_lines(rows, head, key, lambda row: {row["quantity"].removeprefix(prefix): row["error"]}, COST)
    return Section(part.heading, lines, against(rows))


def _start_up(rows: list[Row]) -> Section:
    lines: dict[str, Row] = {}
    for row in rows:
        what = "first field solve" if row["part"].startswith("field") else "first block of the scene"
        lines[what] = {"until": what, "compiled anew [s]": row["first_call_s"], "from disk [s]": row["next_start_s"]}
    return Section("start in a new process", list(lines.values()))
