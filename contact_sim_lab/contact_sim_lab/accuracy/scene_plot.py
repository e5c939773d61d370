"""Work-precision plot of an accuracy study: error over time, both logarithmic."""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Any

from matplotlib import ticker

from contact_sim_lab.accuracy.lines import parts_of_rigs
from contact_sim_lab.records.accuracy import CHECK
from contact_sim_pkg.studies.accuracy.panels import write_panels

__all__ = ["write_plot"]

SPAN = 10.0  # the time axis shows at least this ratio, so that noise does not look like a trend


def write_plot(rows: list[dict[str, Any]], path: str | Path, *, overwrite: bool = False) -> Path:
    """Draw the rows of `scene_study.study`, one panel a part that is there; the ending of `path`
    names the format.
    """
    panels: dict[str, list[dict[str, Any]]] = {}
    for title in dict.fromkeys(part.panel for part in parts_of_rigs()):
        of_panel = [part for part in parts_of_rigs() if part.panel == title]
        members = [row for row in rows if any(part.holds(row) for part in of_panel)]
        if members:
            panels[title] = members
    return write_panels(panels, _panel, path, columns=2, size=(6.2, 5.2), dpi=120, overwrite=overwrite)


def _drawable(rows: list[dict[str, Any]]) -> tuple[list[dict[str, Any]], str]:
    """The rows that logarithmic axes can show, and in words what became of the others.

    An error of 0 is drawn at a power of ten below the smallest one; a row without an error or a
    time is left out.
    """
    known = [row for row in rows if row["error"] is not None and math.isfinite(row["error"])]
    known = [row for row in known if row["error"] >= 0.0 and (row["ms_per_simulated_s"] or 0.0) > 0.0]
    smallest = min((row["error"] for row in known if row["error"] > 0.0), default=sys.float_info.epsilon)
    floor = 10.0 ** (math.floor(math.log10(smallest)) - 1)
    notes = [f"0 drawn at {floor:.0e}"] if any(row["error"] == 0.0 for row in known) else []
    notes += [f"{len(rows) - len(known)} without a number left out"] if len(known) < len(rows) else []
    return [
        {**row, "error": row["error"] or floor, "exact": row["error"] == 0.0} for row in known
    ], f" ({', '.join(notes)})" if notes else ""


def _panel(axis: Any, rows: list[dict[str, Any]]) -> None:
    rows, note = _drawable(rows)
    axis.set_ylabel(f"relative error{note}")
    if not rows:
        return
    names = list(dict.fromkeys(row["quantity"] for row in rows))
    for label in dict.fromkeys(_series(row) for row in rows):
        chosen = sorted((row for row in rows if _series(row) == label), key=_finer)
        first = next(row for row in rows if _series(row) == label)
        style = "--s" if first["part"] == "field grid" else ":^" if first["level"] == CHECK else "-o"
        colour = f"C{names.index(first['quantity'])}"
        name: str | None = label
        for exact, line in ((False, style), (True, style[-1])):  # no line leads to an error of 0
            points = [(row["ms_per_simulated_s"], row["error"]) for row in chosen if row["exact"] is exact]
            if points:
                axis.plot(*zip(*points, strict=True), line, color=colour, markersize=4, linewidth=1.3, label=name)
                name = None
    _name_points(axis, rows)
    axis.set_xscale("log")
    axis.set_yscale("log")
    times = [row["ms_per_simulated_s"] for row in rows]
    middle, half = (min(times) * max(times)) ** 0.5, max(SPAN, 2.0 * max(times) / min(times)) ** 0.5
    axis.set_xlim(middle / half, 2.6 * middle * half)  # room for the names of the last points
    axis.xaxis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.xaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _place: f"{value:g}"))
    axis.xaxis.set_minor_formatter(ticker.NullFormatter())
    axis.yaxis.set_minor_formatter(ticker.NullFormatter())
    lowest, highest = axis.get_ylim()
    if highest < 100.0 * lowest:
        axis.set_ylim(10.0 ** math.floor(math.log10(lowest)), 10.0 ** math.ceil(math.log10(highest)))
    axis.set_xlabel("ms per simulated second")
    axis.grid(visible=True, which="major", alpha=0.4)
    axis.grid(visible=True, which="minor", alpha=0.12)
    axis.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=2, frameon=False)


def _finer(row: dict[str, Any]) -> float:
    return -float(row["tolerance"] or 0.0)


def _name_points(axis: Any, rows: list[dict[str, Any]]) -> None:
    """Write what was requested at the points of the first line of each part: tolerance or level."""
    for part in dict.fromkeys((row["part"], row["level"] == CHECK) for row in rows):
        if part[0] == "field grid":
            continue  # the same levels as those of the solver
        members = [row for row in rows if (row["part"], row["level"] == CHECK) == part]
        line: dict[str, dict[str, Any]] = {}
        for row in sorted(members, key=lambda row: row["error"]):
            line[_requested(row)] = row  # the highest point of each
        last = (0.0, 0.0)
        for text, row in line.items():
            place = (row["ms_per_simulated_s"], row["error"])
            if not 0.9 < place[0] / max(last[0], 1e-300) < 1.1 or not 0.7 < place[1] / last[1] < 1.4:
                axis.annotate(
                    text, place, xytext=(5, 5), textcoords="offset points", fontsize=7, color="0.3", clip_on=True
                )
            last = place


def _requested(row: dict[str, Any]) -> str:
    by_tolerance = {part.part for part in parts_of_rigs() if not (part.level or part.contact)}
    if row["part"] in by_tolerance or row["level"] == CHECK:
        return f"{row['tolerance']:.0e}"
    return f"{row['level']} {row['grid'] or ''}".strip()


def _series(row: dict[str, Any]) -> str:
    """Rows of one line: the same quantity, and for fields the same kind of error."""
    kind = {"field grid": ", grid", "field solver": ", solver"}.get(row["part"], "")
    if row["level"] == CHECK:
        kind = f" on {row['grid']}, against NNLS"
    return f"{row['quantity']}{kind}"
