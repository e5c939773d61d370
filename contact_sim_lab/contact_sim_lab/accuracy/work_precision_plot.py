"""Error over time of a rig's work-precision studies: one panel a study, both axes logarithmic."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from matplotlib import ticker

from contact_sim_lab.accuracy.work_precision_table import ROUNDING
from contact_sim_lab.records.work_precision import Row
from contact_sim_pkg.studies.accuracy.panels import write_panels

__all__ = ["write_plot"]

FLOOR = 1e-9
"""Errors below are drawn here: what is exact must not squeeze the rest."""

MARKERS = "osD^vP*X<>hd"
STYLES = ("-", "--", ":", "-.", (0, (5, 1, 1, 1, 1, 1)))


def write_plot(rows: list[Row], path: str | Path, *, overwrite: bool = False) -> Path:
    """Draw the rows of `work_precision.study`; the ending of `path` names the format."""
    panels = {part: [row for row in rows if row["part"] == part] for part in _distinct(row["part"] for row in rows)}
    return write_panels(panels, _panel, path, columns=3, size=(6.2, 6.0), dpi=80, overwrite=overwrite)


def _panel(axis: Any, rows: list[Row]) -> None:
    """Colour: quantity; line: case; marker: level and grid."""
    rows = [row for row in rows if not _given(row, rows)]
    quantities, cases, levels = (_distinct(map(name, rows)) for name in (_quantity, _case, _level))
    for quantity in quantities:
        for case in cases:
            chosen = [row for row in rows if _quantity(row) == quantity and _case(row) == case]
            _lines(axis, chosen, f"C{quantities.index(quantity)}", STYLES[cases.index(case) % len(STYLES)], levels)
    for quantity in quantities:
        axis.plot([], [], "-", linewidth=3, color=f"C{quantities.index(quantity)}", label=quantity)
    for case in cases:
        axis.plot([], [], color="0.3", linestyle=STYLES[cases.index(case) % len(STYLES)], label=case)
    for level in levels:
        axis.plot([], [], MARKERS[levels.index(level) % len(MARKERS)], color="0.3", label=level)
    # Legend entries above have no data: colour, line and marker each stand alone
    axis.set_xscale("log")
    axis.set_yscale("log")
    for side in (axis.xaxis, axis.yaxis):
        side.set_minor_formatter(ticker.LogFormatterSciNotation(minor_thresholds=(1.5, 0.5)))
    axis.set_xlabel("ms a call")
    below = any(row["error"] < FLOOR for row in rows)
    axis.set_ylabel(f"relative error{f' (below {FLOOR:g} drawn there)' if below else ''}")
    axis.grid(visible=True, which="major", alpha=0.4)
    axis.legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=3, frameon=False)


def _lines(axis: Any, rows: list[Row], colour: str, style: Any, levels: list[str]) -> None:
    """One line through the levels by time; where a grid has several tolerances, one a grid."""
    several = len({(row["level"], row["grid"]) for row in rows}) < len(rows)
    for grid in _distinct(row["grid"] if several else None for row in rows):
        chosen = sorted((row for row in rows if not several or row["grid"] == grid), key=lambda row: row["ms_per_call"])
        points = [(row["ms_per_call"], max(row["error"], FLOOR)) for row in chosen]
        axis.plot(*zip(*points, strict=True), color=colour, linestyle=style, linewidth=0.8, alpha=0.6)
        for row, point in zip(chosen, points, strict=True):
            marker = MARKERS[levels.index(_level(row)) % len(MARKERS)]
            axis.plot(*point, marker, color=colour, markersize=5, alpha=0.8)


def _given(row: Row, rows: list[Row]) -> bool:
    """Whether the quantity is what was requested, and so comes back to rounding on every level of
    the case.
    """
    return all(
        other["error"] <= ROUNDING for other in rows if (_case(other), _quantity(other)) == (_case(row), _quantity(row))
    )


def _distinct(names: Any) -> list[Any]:
    return list(dict.fromkeys(names))


def _quantity(row: Row) -> str:
    return str(row["quantity"])


def _case(row: Row) -> str:
    return str(row["case"])


def _level(row: Row) -> str:
    """A level; solved grids differ by their cells, their levels are not named."""
    if row["grid"] is None:
        return str(row["level"])
    name = str(row["level"]) if row["solver_error"] is None else str(row["level"]).split()[0]
    return f"{name} {row['grid']}"
