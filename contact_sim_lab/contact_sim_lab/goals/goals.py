"""`bench goals`: what the bench is to reach, measured in one run on this machine.

Times are medians of warm calls on one thread with no Python inside the loop of our side; scipy's
right-hand sides are Python, which is most of its time. Runs on nodes start as a user starts them
and are recorded. A goal that is missed is shown, no more.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import partial
from typing import Any

from contact_sim_lab import cases
from contact_sim_lab.goals import runs
from contact_sim_lab.records.goal import GoalPart, Measured
from contact_sim_pkg.records.table import Section

__all__ = ["parts", "sections", "study"]

BUSY, QUIET = "load average of the machine at the start", 0.7


def _machine() -> list[Measured]:
    return [Measured(BUSY, os.getloadavg()[0], "")]


def parts() -> list[GoalPart]:
    """The machine, the parts of no rig, and those of the rigs."""
    modules = (*cases.GOALS, *cases.modules_of_rigs("goals"))
    return [GoalPart("machine", _machine), *cases.objects(modules, "GOALS")]


def study(progress: Callable[[str], None] | None = None, latency: float | None = None) -> list[dict[str, Any]]:
    """Rows: part, what, measured (null where it could not be), unit, goal, reached (null: no goal,
    or not measured), note.

    ``latency``: only that of the full bench, over a run of this length, [s]. All of them take three
    to four minutes.
    """
    latencies = [GoalPart("machine", _machine), GoalPart("latency", partial(runs.latency, latency or 0.0))]
    rows = []
    for part, measure in parts() if latency is None else latencies:
        if progress is not None:
            progress(part)
        for found in measure():
            head = {"part": part, "what": found.what, "measured": found.value, "unit": found.unit}
            rows.append({**head, "goal": found.goal, "reached": found.reached, "note": found.note})
    return rows


def sections(rows: list[dict[str, Any]]) -> list[Section]:
    """The same rows as a person reads them: those with a goal, then the rest."""
    names = ("what", "measured", "unit", "goal")
    with_goal = [row for row in rows if row["goal"]]
    reached = {True: "yes", False: "NO", None: "not measured"}
    judged = [{**{name: row[name] for name in names}, "reached": reached[row["reached"]]} for row in with_goal]
    others = [{**{name: row[name] for name in names[:3]}, "note": row["note"]} for row in rows if not row["goal"]]
    missed = [row for row in with_goal if row["reached"] is not True]
    notes = [f"{row['what']}: {row['note']}" for row in missed if row["note"]]
    count = f"{len(with_goal) - len(missed)} of {len(with_goal)} goals reached"
    busy = next(row["measured"] for row in rows if row["what"] == BUSY)
    if busy > QUIET:
        notes.append(f"The machine had other work at the start (load average {busy:.2g}): times count for less.")
    return [Section("goals", judged, "\n".join([count, *notes])), Section("measured beside them", others)]
