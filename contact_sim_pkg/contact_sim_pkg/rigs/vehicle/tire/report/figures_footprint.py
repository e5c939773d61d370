"""Pictures of the footprint through its heaviest moment."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from contact_sim_pkg.report.drawing import MULTIPLES, MUTED, PRESSURE_COLOURS, WIDTH, Picture, new_figure, picture
from contact_sim_pkg.report.figures.maps import common_window, draw_map, extension, robust_limits, set_window
from contact_sim_pkg.report.series import FieldSeries, Snapshot
from contact_sim_pkg.rigs.vehicle.tire.report.road_series import WheelTravel

STAGES = 8
COLUMNS = 4
REACH = 0.5
"""[m] of travel before and after the largest load that the stages span"""


def chosen_stages(field: FieldSeries, travel: WheelTravel | None) -> list[Snapshot]:
    """At most `STAGES` fields around the largest load, evenly among those within `REACH` of it, the
    heaviest included.
    """
    event, heaviest = field.event, field.heaviest
    middle = next(number for number, each in enumerate(event) if each is heaviest)
    reach = len(event)
    if travel is not None:
        way = np.abs(travel.at(np.array([each.time for each in event])) - travel.at(np.array([heaviest.time])))
        reach = int(np.count_nonzero(way <= REACH)) // 2
    stride = max(1, round(2 * reach / STAGES))
    before = (STAGES - 1) // 2
    numbers = [middle + stride * step for step in range(-before, STAGES - before)]
    return [event[number] for number in numbers if 0 <= number < len(event)]


def footprint_stages(key: str, name: str, field: FieldSeries, travel: WheelTravel | None) -> Picture:
    """Maps of the footprint at several instants, one colour scale."""
    stages = chosen_stages(field, travel)
    window = common_window([each.field for each in stages])
    rows = -(-len(stages) // COLUMNS)
    height = float(np.clip(window.aspect * 0.2 * WIDTH, 0.5, 2.6)) + 0.34
    figure, axes = new_figure(rows * height + 0.5, rows, COLUMNS, MULTIPLES, sharex=True, sharey=True)
    # One colour scale that a few peaks do not widen.
    pressures = np.concatenate([each.field.pressure.ravel() for each in stages]) * 1e-3
    limits = robust_limits(pressures, 0.02)
    for place, each in zip(axes, stages, strict=False):
        _draw_stage(place, each, travel, limits)
        set_window(place, window)
    for place in axes[len(stages) :]:
        place.set_axis_off()
    arrow = extension(pressures, limits)
    scale = ScalarMappable(limits, PRESSURE_COLOURS)
    bar = figure.colorbar(scale, ax=axes, label="pressure, kPa", pad=0.01, aspect=30, extend=arrow)
    bar.ax.spines["outline"].set_visible(False)
    figure.supxlabel("← left, y, mm")
    figure.supylabel("forward, x, mm →", x=0.004)
    cut = f" One cell in 50 lies above the scale, at most {pressures.max():.4g} kPa." if arrow == "max" else ""
    caption = (
        f"Footprint of the {name} before and after its largest load, {field.heaviest.load:.5g} N at "
        f"{field.heaviest.time:.3f} s; cells without pressure are blank, one colour scale for all.{cut} The maps move with "
        "the wheel: x = 0 lies below its centre."
    )
    return picture(f"{key}-stages", figure, f"Footprint of the {name} at several instants", caption)


def _draw_stage(axes: Axes, stage: Snapshot, travel: WheelTravel | None, limits: Normalize) -> None:
    pressure = stage.field.pressure
    draw_map(axes, stage.field, np.where(pressure > 0.0, pressure * 1e-3, np.nan), PRESSURE_COLOURS, limits)
    axes.set_title(_stage_title(stage, travel))
    if stage.load <= 0.0:
        axes.text(0.5, 0.5, "no contact", transform=axes.transAxes, ha="center", va="center", color=MUTED)


def _stage_title(each: Snapshot, travel: WheelTravel | None) -> str:
    load = f"{each.load * 1e-3:.2f} kN" if each.load >= 1000.0 else f"{each.load:.0f} N"
    if travel is None:
        return f"{each.time:.3f} s, {load}"
    return f"{float(travel.at(np.array([each.time]))[0]):.2f} m, {load}"
