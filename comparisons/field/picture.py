"""Error over time of every solver, one panel a problem."""

from __future__ import annotations

from pathlib import Path

import matplotlib
import numpy

from comparisons.field.measure import Row
from comparisons.field.solver import OURS
from contact_sim_pkg.files import new_file

matplotlib.use("Agg")

from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.ticker import LogFormatter

__all__ = ["draw"]

COLORS = {OURS: "#0b6e4f", "ASPHER": "#c1440e", "tamaas": "#3d5a98"}
MARKS = {OURS: "o", "ASPHER": "s", "tamaas": "^"}
COLUMNS = 3


def draw(rows: list[Row], path: Path, *, overwrite: bool = False) -> None:
    """Write the picture as PNG; medians over the seeds."""
    tasks = list(dict.fromkeys(row.task for row in rows))
    lines = -(-len(tasks) // COLUMNS)
    figure, axes = pyplot.subplots(lines, COLUMNS, figsize=(4.2 * COLUMNS, 3.4 * lines), squeeze=False)
    for place, panel in enumerate(axes.flat):
        if place < len(tasks):
            _panel(panel, tasks[place], [row for row in rows if row.task == tasks[place]])
        else:
            panel.set_axis_off()
    handles = [Line2D([], [], color=COLORS[name], marker=MARKS[name], label=name) for name in COLORS]
    figure.legend(handles=handles, loc="upper center", ncols=len(handles), frameon=False)
    figure.tight_layout(rect=(0.0, 0.0, 1.0, 0.96))
    with new_file(path, overwrite=overwrite) as file:
        figure.savefig(file, format="png", dpi=110)
    pyplot.close(figure)


def _panel(panel: Axes, task: str, rows: list[Row]) -> None:
    for name, color in COLORS.items():
        points = _points([row for row in rows if row.solver == name])
        if len(points):
            panel.loglog(points[:, 0], points[:, 1], marker=MARKS[name], markersize=4, linewidth=1.2, color=color)
    panel.set_title(task, fontsize=9)
    panel.set_xlabel("ms a solve", fontsize=8)
    panel.set_ylabel("error of the field, L2", fontsize=8)
    panel.tick_params(labelsize=7, which="both")
    for formatter in (panel.xaxis.set_major_formatter, panel.xaxis.set_minor_formatter):
        formatter(LogFormatter(minor_thresholds=(2.0, 0.5)))
    panel.grid(visible=True, which="major", linewidth=0.3)


def _points(rows: list[Row]) -> numpy.ndarray[tuple[int, ...], numpy.dtype[numpy.float64]]:
    tolerances = sorted({row.tolerance for row in rows}, reverse=True)
    those = [[row for row in rows if row.tolerance == tolerance] for tolerance in tolerances]
    return numpy.array(
        [[numpy.median([row.ms for row in some]), numpy.median([row.counted_error for row in some])] for some in those]
    )
