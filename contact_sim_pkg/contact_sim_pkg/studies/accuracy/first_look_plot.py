"""Plot of a first look: requested to delivered with its diagonal, and cost to delivered."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from contact_sim_pkg.records.definitions import KINDS
from contact_sim_pkg.records.table import number_of
from contact_sim_pkg.studies.accuracy.panels import write_panels

__all__ = ["write_plot"]

REQUESTED, COST = "requested", "cpu_s_per_s"
TITLES = {"requested and delivered": REQUESTED, "cost and delivered": COST}
LEAST = 1e-12
"""Errors below it are drawn there."""
COLOURS = 10  # of lines, before their style changes

Row = dict[str, Any]


def write_plot(rows: list[Row], path: str | Path, *, overwrite: bool = False) -> Path:
    """Draw the rows of `first_look_table.study`; the ending of ``path`` names the format.

    One scene has a line a kind, several have one line each: their force.
    """
    panels = {title: [{**row, "across": row[name], "by": name} for row in rows] for title, name in TITLES.items()}
    return write_panels(panels, _panel, path, columns=2, size=(5.6, 4.6), dpi=120, overwrite=overwrite)


def _panel(axis: Any, rows: list[Row]) -> None:
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    alone = len(scenes) == 1
    for number, (scene, kind) in enumerate(
        (scene, kind) for scene in scenes for kind in (KINDS if alone else KINDS[:1])
    ):
        points = [row for row in rows if row["scene"] == scene and row[kind] is not None]
        if points:
            _line(axis, points, kind, number, kind if alone else scene)
    if alone:
        _name_points(axis, rows)
    axis.plot(
        [], [], "o", markersize=12, markerfacecolor="none", markeredgecolor="0.3", label="what the scene requests"
    )
    axis.set_xscale("log")
    axis.set_yscale("log")
    if rows[0]["by"] == REQUESTED:
        ends = sorted(row[REQUESTED] for row in rows)
        axis.plot([ends[0], ends[-1]], [ends[0], ends[-1]], "k--", linewidth=1.3, label="delivered = requested")
        axis.invert_xaxis()
        axis.set_xlabel("requested")
    else:
        axis.set_xlabel("CPU s per simulated s")
        costs = [row[COST] for row in rows]
        axis.set_xlim(0.7 * min(costs), (4.0 if alone else 1.4) * max(costs))  # room for the names of the last points
    drawn = [row[kind] for row in rows for kind in (KINDS if alone else KINDS[:1]) if row[kind] is not None]
    exact = min(drawn, default=1.0) < LEAST
    axis.set_ylabel(
        ("delivered" if alone else "delivered, force") + (f" (below {LEAST:.0e} drawn there)" if exact else "")
    )
    axis.grid(visible=True, which="major", alpha=0.4)
    axis.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.17), ncols=2, frameon=False)


def _line(axis: Any, rows: list[Row], kind: str, number: int, label: str) -> None:
    """A line from request to request, a ring round what the scene itself requests."""
    across, errors = [row["across"] for row in rows], [max(row[kind], LEAST) for row in rows]
    style, colour = ("-o", "--s")[number // COLOURS % 2], f"C{number % COLOURS}"
    axis.plot(across, errors, style, color=colour, markersize=5, linewidth=1.3, label=label)
    for row, x, y in zip(rows, across, errors, strict=True):
        if row["own"]:
            axis.plot([x], [y], "o", markersize=12, markerfacecolor="none", markeredgecolor=colour, markeredgewidth=1.6)


def _name_points(axis: Any, rows: list[Row]) -> None:
    """At the forces of one scene: for which request a run is the cheapest."""
    for row in rows:
        if row["cheapest_for"] and row["by"] == COST and row[KINDS[0]] is not None:
            text = f"cheapest for {', '.join(map(number_of, row['cheapest_for']))}"
            place = (row["across"], max(row[KINDS[0]], LEAST))
            axis.annotate(text, place, xytext=(8, -12), textcoords="offset points", fontsize=7, color="0.3")
