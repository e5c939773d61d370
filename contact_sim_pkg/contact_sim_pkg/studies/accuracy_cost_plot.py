"""Work-precision plot of an accuracy study: error over time, both logarithmic."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

__all__ = ["plot", "write_plot"]

PANELS = (("integrator", "time integration"), ("corrector", "corrector passes"), ("field", "pressure field"))
SPAN = 10.0  # the time axis shows at least this ratio, so that noise does not look like a trend


def plot(rows: list[dict[str, Any]], path: str | Path) -> Path:
    """Draw the rows of `accuracy_cost.study`, one panel a part that is there; the ending of `path` names the format."""
    panels = [(key, title) for key, title in PANELS if any(row["part"].startswith(key) for row in rows)]
    figure, axes = pyplot.subplots(
        1, len(panels), figsize=(5.2 * len(panels), 4.8), squeeze=False, layout="constrained"
    )
    for axis, (key, title) in zip(axes[0], panels, strict=True):
        _panel(axis, [row for row in rows if row["part"].startswith(key)])
        axis.set_title(title)
    axes[0][0].set_ylabel("relative error")
    figure.savefig(path, dpi=120)
    pyplot.close(figure)
    return Path(path)


def _panel(axis: Any, rows: list[dict[str, Any]]) -> None:
    for name in dict.fromkeys(_series(row) for row in rows):
        chosen = sorted((row for row in rows if _series(row) == name), key=lambda row: -row["tolerance"])
        chosen = [row for row in chosen if row["error"] > 0.0]  # no error at all has no place on a logarithmic axis
        times, errors = [row["ms_per_simulated_s"] for row in chosen], [row["error"] for row in chosen]
        dashed = "(grid)" in name
        axis.plot(times, errors, "--s" if dashed else "-o", markersize=4, linewidth=1.2, label=name)
    axis.set_xscale("log")
    axis.set_yscale("log")
    times = [row["ms_per_simulated_s"] for row in rows]
    middle, half = (min(times) * max(times)) ** 0.5, max(SPAN, 1.2 * max(times) / min(times)) ** 0.5
    axis.set_xlim(middle / half, middle * half)
    axis.set_xlabel("ms per simulated second")
    axis.grid(visible=True, which="both", alpha=0.25)
    axis.legend(fontsize=7)


def _series(row: dict[str, Any]) -> str:
    """Rows of one line: the same quantity, and for fields the same kind of error."""
    if row["part"] == "corrector":
        return str(row["quantity"]).split(",")[0]
    kind = {"field grid": " (grid)", "field solver": " (solver)"}.get(row["part"], "")
    check = ", against NNLS" if row["rung"] == "check" else ""
    return f"{row['quantity']}{kind}{check}"


write_plot = plot
