"""Error over time of every engine, one panel a problem."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import matplotlib

from comparisons.dynamics.problems import PROBLEMS
from contact_sim_pkg.files import new_file

matplotlib.use("Agg")

from matplotlib import pyplot

__all__ = ["draw"]

STYLES = {"this project": ("#0b6e4f", "o"), "MuJoCo": ("#c1440e", "s"), "PyBullet": ("#3d5a98", "^")}
FLOOR = 1e-17  # errors of 0 are drawn here


def draw(rows: list[dict[str, Any]], path: Path, *, overwrite: bool = False) -> None:
    """Write the picture as PNG."""
    figure, axes = pyplot.subplots(2, 3, figsize=(12.6, 7.2))
    for panel, problem in zip(axes.flat, PROBLEMS, strict=True):
        unit = ""
        for name, (color, mark) in STYLES.items():
            those = [
                row
                for row in rows
                if (row["problem"], row["solver"]) == (problem, name) and math.isfinite(row["error"])
            ]
            unit = those[0]["unit"] if those else unit
            points = [(row["ms_per_simulated_s"], max(row["error"], FLOOR)) for row in those]
            if points:
                panel.loglog(
                    *zip(*points, strict=True), color=color, marker=mark, markersize=5, linewidth=1.2, label=name
                )
        panel.set_title(problem, fontsize=10)
        panel.set_xlabel("ms a simulated second", fontsize=8)
        panel.set_ylabel(f"error, {unit} (0 drawn at {FLOOR:g})", fontsize=8)
        panel.tick_params(labelsize=7)
        panel.grid(visible=True, which="major", linewidth=0.3)
    handles, labels = axes.flat[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncols=3, frameon=False)
    figure.tight_layout(rect=(0.0, 0.0, 1.0, 0.95))
    with new_file(path, overwrite=overwrite) as file:
        figure.savefig(file, format="png", dpi=110)
    pyplot.close(figure)
