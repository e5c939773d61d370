"""Pressure maps of two runs or more on one scale, and of two their difference on its own."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from contact_sim_pkg.report.comparison.figures import Run
from contact_sim_pkg.report.drawing import MULTIPLES, PRESSURE_COLOURS, Picture, new_figure, picture
from contact_sim_pkg.report.figures.maps import FROM_ABOVE, Window, draw_map, loaded_window, set_window
from contact_sim_pkg.report.series import FloatArray, PressureMap

DIFFERENCE_COLOURS = "RdBu_r"
MOST_RUNS = 4
"""Maps in one row."""
LEAST_SCALE = 0.01
"""end of the colours of a difference, of the largest pressure: what is less is rounding"""
ROOM = MULTIPLES._replace(left=0.78, right=0.75, bottom=0.55, top=0.5)
"""Margins beside two colour bars."""


def map_comparison(key: str, name: str, runs: list[Run]) -> Picture | None:
    """Mean maps of the runs that have one, and of two B - A on its own scale; None where no run has one."""
    fields = [(run.label, run.recording.fields.get(name)) for run in runs[:MOST_RUNS]]
    found = [
        (label, each.average) for label, each in fields if each is not None and (each.average.pressure > 0.0).any()
    ]
    if not found:
        return None
    labels, maps = zip(*found, strict=True)
    difference = on_grid(maps[1], maps[0]) - maps[0].pressure if len(runs) == len(maps) == 2 else None
    figure, text = figure_of_maps(labels, maps, difference)
    without = [label for label, _ in fields if label not in labels]
    lacking = f" No map in {', '.join(without)}." if without else ""
    caption = f"Mean pressure of the {name} over each run, one scale.{text}{lacking} {FROM_ABOVE.seen}"
    return picture(f"{key}-maps", figure, f"Mean pressure maps of the {name} in every run", caption)


def figure_of_maps(
    labels: Sequence[str], maps: Sequence[PressureMap], difference: FloatArray | None
) -> tuple[Figure, str]:
    """Maps in a row on one scale, and a ``difference`` of the second one from the first [Pa] on its own, on the cells of
    the first; with a sentence on it. Call inside `style()`.
    """
    windows = [loaded_window(each) for each in maps]
    window = Window(
        *(choose(values) for choose, values in zip((min, max, min, max), zip(*windows, strict=True), strict=False))
    )
    shown = [each.pressure * 1e-3 for each in maps]
    top = max(float(each.max()) for each in shown)
    pair = difference is not None
    width = (7.4 - 1.5) / (len(maps) + pair)
    height = float(np.clip(window.aspect * width, 1.0, 4.5)) + 1.1
    figure, axes = new_figure(height, 1, len(maps) + pair, ROOM, sharex=True, sharey=True)
    limits = Normalize(0.0, top)
    for place, label, grid, values in zip(axes, labels, maps, shown, strict=False):
        draw_map(place, grid, np.where(values > 0.0, values, np.nan), PRESSURE_COLOURS, limits)
        place.set_title(label)
        set_window(place, window)
    text = ""
    if difference is not None:
        kilo = difference * 1e-3
        end = max(float(np.abs(kilo).max()), LEAST_SCALE * top)
        signed = Normalize(-end, end)
        draw_map(axes[-1], maps[0], np.where(kilo != 0.0, kilo, np.nan), DIFFERENCE_COLOURS, signed)
        axes[-1].set_title("B − A")
        set_window(axes[-1], window)
        figure.colorbar(ScalarMappable(signed, DIFFERENCE_COLOURS), cax=axes[-1].inset_axes((1.06, 0.0, 0.06, 0.47)))
        text = f" B − A on its own scale, from {kilo.min():.3g} to {kilo.max():.3g} kPa, red where B presses more."
    bar = axes[-1].inset_axes((1.06, 0.53 if pair else 0.0, 0.06, 0.47 if pair else 1.0))
    figure.colorbar(ScalarMappable(limits, PRESSURE_COLOURS), cax=bar, label="kPa")
    figure.supxlabel("← left, y, mm")
    axes[0].set_ylabel("forward, x, mm →")
    return figure, text


def on_grid(source: PressureMap, target: PressureMap) -> FloatArray:
    """Pressure [Pa] of ``source`` at the cells of ``target`` [rows, cols], of the nearest cell; 0 outside."""
    places = []
    for axis, (cell, origin, own_cell, own_origin) in enumerate((
        (target.cell_x, target.origin_x, source.cell_x, source.origin_x),
        (target.cell_y, target.origin_y, source.cell_y, source.origin_y),
    )):  # fmt: skip
        at = origin + cell * np.arange(target.pressure.shape[axis])
        places.append(np.rint((at - own_origin) / own_cell).astype(int))
    rows, cols = places
    inside = np.outer((rows >= 0) & (rows < source.pressure.shape[0]), (cols >= 0) & (cols < source.pressure.shape[1]))
    clipped = np.ix_(np.clip(rows, 0, source.pressure.shape[0] - 1), np.clip(cols, 0, source.pressure.shape[1] - 1))
    return np.where(inside, source.pressure[clipped], 0.0)
