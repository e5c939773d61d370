"""Picture of `bench growth`: time of a simulated second over each axis, both logarithmic."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from contact_sim_pkg.studies.accuracy.panels import write_panels

__all__ = ["write_plot"]


def write_plot(rows: list[dict[str, Any]], path: str | Path, *, overwrite: bool = False) -> Path:
    """Draw the rows of `growth.study`; the ending of ``path`` names the format."""
    names = dict.fromkeys(row["axis"] for row in rows)
    panels = {f"{name}": [row for row in rows if row["axis"] == name] for name in names}
    return write_panels(panels, _panel, path, columns=3, size=(4.2, 3.4), dpi=80, overwrite=overwrite)


def _panel(axis: Any, rows: list[dict[str, Any]]) -> None:
    values = [row["value"] for row in rows]
    axis.plot(values, [row["seconds"] for row in rows], "o-", label=f"run, slope {rows[0]['slope']:.2f}")
    if any(row["floor"] > 0.0 for row in rows):
        axis.plot(values, [row["floor"] or float("nan") for row in rows], "s--", color="0.5", label="counted floor")
    axis.axhline(1.0, color="0.8", linewidth=0.8)
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xticks(values, [f"{value:g}" for value in values])
    axis.minorticks_off()
    axis.set_xlabel(rows[0]["unit"])
    axis.set_ylabel("s a simulated second")
    axis.grid(visible=True, alpha=0.4)
    axis.legend(fontsize=7)
