"""Pictures of the contact domain of a backrest: contact points with the fitted Lamé curve, maps
through a slap, area ratio.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.image import AxesImage

from contact_sim_pkg.pressure.closed_form.lame import LameFit, fit_patch
from contact_sim_pkg.report.drawing import (
    ACCENT,
    MULTIPLES,
    MUTED,
    PRESSURE_COLOURS,
    WIDTH,
    WITH_BARS,
    Picture,
    new_figure,
    picture,
)
from contact_sim_pkg.report.figures.maps import View, Window, common_window, draw_map, draw_outline, set_window
from contact_sim_pkg.report.point_series import APART, SLIPS, STICKS, TOUCHES, PointSeries, PointSnapshot
from contact_sim_pkg.report.series import EpisodeSeries, FieldSeries, FloatArray, PressureMap, Snapshot
from contact_sim_pkg.report.signal.decimate import envelope
from contact_sim_pkg.report.signal.loops import area_ratio
from contact_sim_pkg.rigs.backrest.report.numbers import ends_of_back, heaviest_slap

CURVE = "#d5402b"
AT_BACKREST = View("← left, y, mm", "up, x, mm →", "Seen from the front, as one looks at the seat back.")
STATES = {TOUCHES: ("carries", "#ffffff"), STICKS: ("sticks", "#7fc4ee"), SLIPS: ("slips", "#f2a03d")}
STAGES, COLUMNS = 8, 4
CURVE_POINTS = 361


def lame_curve(fit: LameFit) -> tuple[FloatArray, FloatArray]:
    """x and y [m], [points], along the curve |x/a|^n + |y/b|^n = 1 about its centre (Driver and
    Seat, eq 5).
    """
    angle = np.linspace(0.0, 2.0 * np.pi, CURVE_POINTS)
    power = 2.0 / fit.exponent
    x = fit.centre_x + fit.a * np.sign(np.cos(angle)) * np.abs(np.cos(angle)) ** power
    y = fit.centre_y + fit.b * np.sign(np.sin(angle)) * np.abs(np.sin(angle)) ** power
    return x, y


def fit_of(field: PressureMap) -> LameFit:
    """Lamé curve through the boundary of the cells under pressure."""
    fit: LameFit = fit_patch(
        np.ascontiguousarray(field.pressure), field.cell_x, field.cell_y, field.origin_x, field.origin_y
    )
    return fit


def contact_domain(key: str, name: str, field: FieldSeries, points: PointSeries | None) -> Picture:
    """Figure 3: contact points on the domain at first touch and at the largest force, with the
    fitted curve.
    """
    pairs = [(field.touch or field.first, points.touch if points else None)]
    pairs.append((field.heaviest, points.heaviest if points else None))
    # One window for both instants.
    window = common_window([shown.field for shown, _ in pairs])
    height = float(np.clip(0.75 + window.aspect * 0.31 * WIDTH, 2.4, 5.2))
    figure, axes = new_figure(height, 1, 2, WITH_BARS)
    first = "first touch" if field.touch is not None else "start"
    for place, (shown, snapshot), label in zip(axes, pairs, (first, "largest force"), strict=True):
        _draw_with_scale(place, shown, snapshot, window)
        place.set_title(f"{label}, t = {shown.time:.3f} s, {shown.load:.4g} N")
    if points is not None:
        for place in axes:
            _mark_first(place, points)
    parts = [
        _curve_sentence(label, shown.field)
        for label, (shown, _) in zip((f"At the {first}", "at the largest force"), pairs, strict=True)
    ]
    caption = (
        f"Contact domain on the pressure map, cells not interpolated; black: its edge. Red: the Lamé curve |x/a|ⁿ + |y/b|ⁿ = 1 "
        f"through the boundary of the cells under pressure. {'; '.join(parts)}.{_cut(field)}{_points_sentence(points)} "
        f"{AT_BACKREST.seen}"
    )
    return picture(f"{key}-domain", figure, f"Contact points on the contact domain of the {name}", caption)


def _draw_with_scale(axes: Axes, shown: Snapshot, points: PointSnapshot | None, window: Window) -> None:
    image = draw_domain(axes, shown.field, points, window, Normalize(0.0, highest_kilopascals([shown.field])))
    axes.set_xlabel(AT_BACKREST.across)
    axes.set_ylabel(AT_BACKREST.along)
    bar = axes.figure.colorbar(image, cax=axes.inset_axes((1.04, 0.0, 0.045, 1.0)), label="kPa")
    bar.ax.spines["outline"].set_visible(False)


def highest_kilopascals(fields: list[PressureMap]) -> float:
    """[kPa] largest pressure of all fields; 1 where none carries."""
    return max(float(field.pressure.max()) for field in fields) * 1e-3 or 1.0


def draw_domain(
    axes: Axes, field: PressureMap, points: PointSnapshot | None, window: Window, limits: Normalize
) -> AxesImage:
    """Pressure [kPa] of the loaded cells, their edge, the Lamé curve through it, and the points
    that carry.
    """
    loaded = np.where(field.pressure > 0.0, field.pressure * 1e-3, np.nan)
    image = draw_map(axes, field, loaded, PRESSURE_COLOURS, limits)
    draw_outline(axes, field)
    if np.isfinite(loaded).any():
        x, y = lame_curve(fit_of(field))
        axes.plot(y * 1e3, x * 1e3, color=CURVE, linewidth=1.4)
    if points is not None and points.x.size > 1:
        for state, (label, colour) in STATES.items():
            these = points.state == state
            axes.plot(
                points.y[these] * 1e3, points.x[these] * 1e3, linestyle="", marker="o", markersize=2.6, color=colour,
                markeredgecolor="#000000", markeredgewidth=0.35, label=label if these.any() else None,
            )  # fmt: skip
    set_window(axes, window)
    return image


def _mark_first(axes: Axes, points: PointSeries) -> None:
    place = (points.first_y * 1e3, points.first_x * 1e3)
    axes.plot(*place, marker="+", color=CURVE, markersize=8, markeredgewidth=1.6)
    axes.annotate("1", place, xytext=(4, 4), textcoords="offset points", color=CURVE, fontweight="bold")


def _curve_sentence(label: str, field: PressureMap) -> str:
    if not field.pressure.any():
        return f"{label} there is no contact"
    fit = fit_of(field)
    shape = f"a = {fit.a * 1e3:.4g} mm (up), b = {fit.b * 1e3:.4g} mm (across)"
    if not fit.fitted:
        return f"{label} {shape}: fewer than 8 cells, not fitted"
    return f"{label} {shape}, n = {fit.exponent:.3g}, rms deviation {fit.deviation:.1%}"


def _cut(field: FieldSeries) -> str:
    cut = ends_of_back(field.heaviest.field)
    return f" At the largest force {cut}." if cut else ""


def _points_sentence(points: PointSeries | None) -> str:
    if points is None:
        return ""
    if points.points == 1:
        return " One mass has one contact point, 1; the map has the same force."
    counts = [int(np.count_nonzero(each.state != APART)) for each in (points.touch, points.heaviest)]
    kinds = {int(state) for each in (points.touch, points.heaviest) for state in each.state} - {APART, TOUCHES}
    colours = " Dots: points that carry; blue sticks, orange slips." if kinds else " Dots: points that carry."
    return f"{colours} {counts[0]} and {counts[1]} of {points.points} points carry; 1 marks the one that the loops are drawn for."


def slap_stages(key: str, name: str, field: FieldSeries) -> Picture:
    """Pressure maps at up to eight instants of the contact around the largest force, one colour
    scale.
    """
    stages = chosen_stages(field)
    window = common_window([each.field for each in stages])
    rows = -(-len(stages) // COLUMNS)
    height = float(np.clip(window.aspect * 0.2 * WIDTH, 0.5, 2.6)) + 0.34
    figure, axes = new_figure(rows * height + 0.5, rows, COLUMNS, MULTIPLES, sharex=True, sharey=True)
    highest = max(float(each.field.pressure.max()) for each in stages) * 1e-3
    limits = Normalize(0.0, highest or 1.0)
    # Cells without pressure are blank.
    for place, each in zip(axes, stages, strict=False):
        pressure = each.field.pressure * 1e-3
        draw_map(place, each.field, np.where(pressure > 0.0, pressure, np.nan), PRESSURE_COLOURS, limits)
        place.set_title(f"{each.time:.3f} s, {each.load:.4g} N")
        set_window(place, window)
    for place in axes[len(stages) :]:
        place.set_axis_off()
    bar = figure.colorbar(ScalarMappable(limits, PRESSURE_COLOURS), ax=axes, label="pressure, kPa", pad=0.01, aspect=30)
    bar.ax.spines["outline"].set_visible(False)
    figure.supxlabel(AT_BACKREST.across)
    figure.supylabel(AT_BACKREST.along, x=0.004)
    caption = (
        f"Pressure of the {name} while it touches around its largest force, {field.heaviest.load:.4g} N at "
        f"{field.heaviest.time:.3f} s; cells without pressure are blank, one colour scale for all.{_cut(field)} "
        f"{AT_BACKREST.seen}"
    )
    return picture(f"{key}-stages", figure, f"Pressure of the {name} at several instants", caption)


def chosen_stages(field: FieldSeries) -> list[Snapshot]:
    """At most `STAGES` of the fields with load in a row around the largest one, evenly spread, that
    one among them.
    """
    middle = next(number for number, each in enumerate(field.event) if each is field.heaviest)
    first = last = middle
    while first > 0 and field.event[first - 1].load > 0.0:
        first -= 1
    while last + 1 < len(field.event) and field.event[last + 1].load > 0.0:
        last += 1
    count = min(STAGES, last - first + 1)
    numbers = [round(number) for number in np.linspace(first, last, count)]
    numbers[min(range(count), key=lambda place: abs(numbers[place] - middle))] = middle
    return [field.event[number] for number in numbers]


def area_over_time(key: str, name: str, field: FieldSeries, slaps: EpisodeSeries) -> Picture | None:
    """Figure 7: S(t)/S_ref over the run and over one impact; None where the bag does not hold the
    contact at rest.
    """
    area = area_ratio(field)
    if area is None:
        return None
    chosen = heaviest_slap(slaps)
    widths = [1] if chosen is None else [3, 2]
    figure, axes = new_figure(2.7, 1, len(widths), width_ratios=widths)
    axes[0].plot(*envelope(area.time, area.ratio), color=ACCENT, linewidth=0.9)
    axes[0].axhline(1.0, color=MUTED, linewidth=0.7)
    axes[0].set_xlabel("simulated time, s")
    axes[0].set_ylabel("S / S_ref")
    caption = (
        f"Area of the contact domain over S_ref = {area.reference * 1e4:.4g} cm², the area under the largest static load (the "
        f"contact at rest, at the start). It lies between {area.ratio.min():.3g} and {area.ratio.max():.3g}, mean "
        f"{area.ratio.mean():.3g}; its edge lies between cells."
    )
    # Every slap from its first touch, the heaviest in colour.
    if chosen is not None:
        for start, end in zip(slaps.start, slaps.end, strict=True):
            during = (area.time >= start) & (area.time <= end)
            axes[1].plot((area.time[during] - start) * 1e3, area.ratio[during], color=MUTED, linewidth=0.5, alpha=0.6)
        start, end = float(slaps.start[chosen]), float(slaps.end[chosen])
        during = (area.time >= start) & (area.time <= end)
        axes[1].plot((area.time[during] - start) * 1e3, area.ratio[during], color=ACCENT, marker=".", markersize=3.5)
        axes[1].axhline(1.0, color=MUTED, linewidth=0.7)
        axes[1].set_xlabel("time since touch, ms")
        caption += f" Right: every slap from its touch on; in colour the one with the largest force, at {start:.3f} s."
    for place in axes:
        place.set_ylim(bottom=0.0)
    return picture(f"{key}-ratio", figure, f"Area of the contact domain of the {name} over time", caption)
