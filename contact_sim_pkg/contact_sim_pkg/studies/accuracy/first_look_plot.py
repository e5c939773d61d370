"""Plot of a first look: requested to delivered with its diagonal, and cost to delivered."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from contact_sim_pkg.compare.sentences import number_of
from contact_sim_pkg.records.definitions import KINDS
from contact_sim_pkg.studies.accuracy.panels import write_panels

__all__ = ["write_plot"]

REQUESTED, COST = "asked", "cpu_s_per_s"
TITLES = {"requested and delivered": REQUESTED, "cost and delivered": COST}
LEAST = 1e-12
"""Errors below it are drawn there."""

Row = dict[str, Any]


def write_plot(rows: list[Row], path: str | Path, *, overwrite: bool = False) -> Path:
    """Draw the rows of `first_look_table.study`; the ending of ``path`` names the format.

    One scene has a line a kind, several have one line each: their force.
    """
    panels = {title: [{**row, "across": row[name], "by": name} for row in rows] for title, name in TITLES.items()}
    return write_panels(panels, _panel, path, columns=2, size=(5.6, 4.6), dpi=120, overwrite=overwrite)


def _panel(axis: Any, rows: list[Row]) -> None:
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    kinds = KINDS if len(scenes) == 1 else KINDS[:1]
    for number, (scene, kind) in enumerate((scene, kind) for scene in scenes for kind in kinds):
        points = [row for row in rows if row["scene"] == scene and row[kind] is not None]
        if points:
            _line(axis, points, kind, f"C{number}", kind if len(scenes) == 1 else scene)
    axis.set_xscale("log")
    axis.set_yscale("log")
    if rows[0]["by"] == REQUESTED:
        asked = sorted(row[REQUESTED] for row in rows)
        axis.plot([asked[0], asked[-1]], [asked[0], asked[-1]], "k--", linewidth=1.3, label="delivered = requested")
        axis.invert_xaxis()
        axis.set_xlabel("requested")
    else:
        axis.set_xlabel("CPU s per simulated s")
        costs = [row[COST] for row in rows]
        axis.set_xlim(0.7 * min(costs), 4.0 * max(costs))  # room for the names of the last points
    axis.set_ylabel("delivered" if len(scenes) == 1 else "delivered, force")
    axis.grid(visible=True, which="major", alpha=0.4)
    axis.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=2, frameon=False)


def _line(axis: Any, rows: list[Row], kind: str, colour: str, label: str) -> None:
    """A line from request to request; a ring round the scene's own, a star where it is cheapest for
    that request.
    """
    across, errors = [row["across"] for row in rows], [max(row[kind], LEAST) for row in rows]
    axis.plot(across, errors, "-o", color=colour, markersize=5, linewidth=1.3, label=label)
    for row, x, y in zip(rows, across, errors, strict=True):
        if row["own"]:
            axis.plot([x], [y], "o", markersize=12, markerfacecolor="none", markeredgecolor=colour, markeredgewidth=1.6)
            if kind == KINDS[0]:
                axis.annotate("this scene", (x, y), xytext=(8, 8), textcoords="offset points", fontsize=8, color="0.3")
        if row["cheapest_for"] and row["by"] == COST and kind == KINDS[0]:
            names = ", ".join(map(number_of, row["cheapest_for"]))
            axis.annotate(
                f"cheapest for {names}", (x, y), xytext=(6, -12), textcoords="offset points", fontsize=7, color="0.3"
            )
