"""Pictures of one contact: load and approach over time, load over approach, pressure maps, peak and
area.

`key` is an identifier on the page, `name` what the contact is called in texts.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from numpy.typing import NDArray

from contact_sim_pkg.pressure.closed_form import FIT_EXPONENTS
from contact_sim_pkg.report.drawing import (
    ACCENT,
    BAND,
    INK,
    MUTED,
    PRESSURE_COLOURS,
    SHADE,
    WIDTH,
    WITH_BARS,
    Picture,
    draw_series,
    legend_above,
    new_figure,
    picture,
)
from contact_sim_pkg.report.figures.maps import FROM_ABOVE, View, Window, draw_map, loaded_window, set_window
from contact_sim_pkg.report.page import Section
from contact_sim_pkg.report.series import ContactSeries, FieldSeries, PressureMap, Recording
from contact_sim_pkg.report.signal.decimate import BANDS, envelope
from contact_sim_pkg.report.signal.lift_off import lifted_intervals

LOOP_POINTS = 4000
"""Most points of the curve of load over approach."""


LEAST_APPROACH = 1e-9
"""[m]: a contact that never yields more is rigid."""


def force_numbers(contact: ContactSeries) -> dict[str, Any]:
    """Load in [N], share of the time without contact (0 .. 1), number of lift-offs: from a load to
    none.
    """
    separated = contact.normal <= 0.0
    return {
        "load_mean_N": float(contact.normal.mean()),
        "load_min_N": float(contact.normal.min()),
        "load_max_N": float(contact.normal.max()),
        "lifted_share": float(separated.mean()),
        "lift_offs": int(np.count_nonzero(separated[1:] & ~separated[:-1])),
    }


def field_numbers(field: FieldSeries) -> dict[str, Any]:
    """Largest pressure and when, mean contact area over all recorded instants."""
    return {
        "peak_pressure_Pa": float(field.peak.max()),
        "peak_pressure_time_s": field.highest_time,
        "contact_area_mean_m2": float(field.area.mean()),
    }


def contact_section(number: int, name: str, recording: Recording) -> Section:
    """Load and approach over time, the pressure field where the bag has one, load over approach.

    Args:
        number: of the contact in the recording, part of the keys of its pictures.
        name: of the contact.
        recording: with a contact of that name.
    """
    contact, field = recording.contacts[name], recording.fields.get(name)
    key = f"contact-{number}"
    pictures = [load_over_time(key, name, contact)]
    if field is not None:
        pictures.append(pressure_maps(key, name, field))
    if field is not None and field.time.size > 1:
        pictures.append(footprint_over_time(key, name, field))
    curve = load_over_approach(key, name, contact)
    pictures += [] if curve is None else [curve]
    return Section(key, f"{name.capitalize()} contact", pictures)


def load_over_time(key: str, name: str, contact: ContactSeries) -> Picture:
    """Normal force with lift-off shaded, other forces where there are any, approach; common time
    axis.
    """
    unit, scale = force_unit(contact)
    others = [(f"friction force, {unit}", contact.tangential * scale)] if np.any(contact.tangential) else []
    if contact.impulses.size == contact.time.size:
        others.append(("asperities, N", contact.impulses))
    rows = 2 + len(others)
    figure, axes = new_figure(1.0 + 1.45 * rows, rows, sharex=True)
    _line(axes[0], contact.time, contact.normal * scale, f"normal force, {unit}")
    shade(axes[0], lifted_intervals(contact))
    axes[0].axhline(contact.normal.mean() * scale, color=INK, linewidth=0.9, linestyle=(0, (4, 3)))
    axes[0].set_ylim(bottom=0.0)
    for place, (label, values) in zip(axes[1:-1], others, strict=True):
        _line(place, contact.time, values, label)
    _line(axes[-1], contact.time, contact.approach * 1e3, "approach, mm")
    # A line at zero where contact is lost
    if contact.approach.min() <= 0.0:
        axes[-1].axhline(0.0, color=MUTED, linewidth=0.7)
    axes[-1].set_xlabel("simulated time, s")
    axes[-1].set_xlim(contact.time[0], contact.time[-1] + contact.sample_period)
    return picture(
        f"{key}-load", figure, f"Normal force and approach of the {name} contact over time", _load_caption(contact)
    )


def _load_caption(contact: ContactSeries) -> str:
    numbers = force_numbers(contact)
    text = (
        f"Normal force between {numbers['load_min_N']:.5g} and {numbers['load_max_N']:.5g} N, mean "
        f"{numbers['load_mean_N']:.5g} N (dashed). Approach between {contact.approach.min() * 1e3:.3g} and "
        f"{contact.approach.max() * 1e3:.3g} mm, positive in compression. "
    )
    if contact.impulses.size:
        text += f"The road's asperities push with up to {contact.impulses.max():.4g} N beside it. "
    text += BAND.lstrip() + " " if contact.time.size > 2 * BANDS else ""
    if not numbers["lifted_share"]:
        return text + "The contact never opens."
    times = "once" if numbers["lift_offs"] == 1 else f"{numbers['lift_offs']} times"
    return text + f"It lifts off {times}; {numbers['lifted_share']:.2%} of the time (shaded) it carries no load."


def force_unit(contact: ContactSeries) -> tuple[str, float]:
    """Unit for an axis of forces, and the factor from [N] to it."""
    return ("kN", 1e-3) if contact.normal.max() >= 2000.0 else ("N", 1.0)


def load_over_approach(key: str, name: str, contact: ContactSeries) -> Picture | None:
    """Load-deflection curve of the whole run; its opening is the dissipation. None where nothing
    yields: the contact is rigid.
    """
    if contact.approach.max() <= LEAST_APPROACH:
        return None
    figure, (axes,) = new_figure(3.1)
    # A path of few points is enough for the eye, and keeps the page small
    stride = max(1, contact.normal.size // LOOP_POINTS)
    unit, scale = force_unit(contact)
    axes.plot(
        contact.approach[::stride] * 1e3, contact.normal[::stride] * scale, color=ACCENT, linewidth=0.6, alpha=0.6
    )
    axes.set_xlabel("approach, mm")
    axes.set_ylabel(f"normal force, {unit}")
    axes.set_ylim(bottom=0.0)
    sampled = f" One in {stride} is drawn." if stride > 1 else ""
    caption = (
        f"Normal force over approach, {contact.normal.size} samples.{sampled} One curve is an elastic contact on "
        "even ground; loops are dissipation, a band is uneven ground at the same approach."
    )
    return picture(f"{key}-loop", figure, f"Normal force of the {name} contact over its approach", caption)


def pressure_maps(key: str, name: str, field: FieldSeries, view: View = FROM_ABOVE) -> Picture:
    """The map with the largest peak and the mean map, one colour scale each, cells as they are."""
    window = loaded_window(field.average)
    figure, axes = new_figure(_map_height(window), 1, 2, WITH_BARS)
    _map(axes[0], field.highest, window, f"largest peak, t = {field.highest_time:.3f} s", view)
    _mark_peak(axes[0], field.highest)
    _map(axes[1], field.average, window, "mean over the run", view)
    rows, cols = field.highest.pressure.shape
    caption = (
        f"Pressure of the cells ({rows} × {cols} of {field.highest.cell_x * 1e3:.3g} × "
        f"{field.highest.cell_y * 1e3:.3g} mm), not interpolated; cells without pressure are blank, the grid is cut to "
        f"what was ever loaded. Left: the largest peak of the run, {field.highest.pressure.max() * 1e-3:.4g} kPa "
        f"(cross) at {field.highest_time:.3f} s. Right: the mean of {field.time.size} fields, at most "
        f"{field.average.pressure.max() * 1e-3:.4g} kPa. {view.seen}"
    )
    return picture(f"{key}-map", figure, f"Pressure maps of the {name} contact", caption)


def footprint_over_time(key: str, name: str, field: FieldSeries) -> Picture:
    """Largest pressure, contact area, semi-axes and exponent of the contact's outline over time."""
    figure, axes = new_figure(5.6, 4, sharex=True)
    touching = field.area > 0.0
    _line(axes[0], field.time, field.peak * 1e-3, "peak, kPa")
    _line(axes[1], field.time, field.area * 1e4, "area, cm²")
    for values, colour, label in ((field.lame_a, ACCENT, "a, along"), (field.lame_b, INK, "b, across")):
        axes[2].plot(*_with_gaps(field.time, values * 1e3, touching), color=colour, linewidth=0.9, label=label)
    axes[2].set_ylabel("semi-axes, mm")
    legend_above(axes[2])
    usual = float(np.percentile([field.lame_a, field.lame_b], 99.0))
    axes[2].set_ylim(top=1.5e3 * max(usual, 1e-3))
    axes[3].plot(*_with_gaps(field.time, field.lame_n, touching), color=ACCENT, linewidth=0.9)
    axes[3].axhline(2.0, color=MUTED, linewidth=0.7)
    axes[3].set_ylabel("exponent n")
    axes[0].plot(
        [field.highest_time], [field.peak.max() * 1e-3], marker="x", color=INK, markersize=6, linestyle="none",
        clip_on=False,
    )  # fmt: skip
    for each in axes[:3]:
        each.set_ylim(bottom=0.0)
    _exponent_axis(axes[3])
    axes[-1].set_xlabel("simulated time, s")
    axes[-1].set_xlim(field.time[0], max(field.time[-1], field.time[0] + 1e-3))
    figure.align_ylabels(axes)
    numbers = field_numbers(field)
    caption = (
        f"Peak pressure up to {numbers['peak_pressure_Pa'] * 1e-3:.4g} kPa (cross, at {field.highest_time:.3f} s). "
        f"Contact area {field.area.min() * 1e4:.4g} to {field.area.max() * 1e4:.4g} cm², mean "
        f"{numbers['contact_area_mean_m2'] * 1e4:.4g} cm²: its edge between cells. Semi-axes and exponent of the "
        "Lamé curve |x/a|ⁿ + |y/b|ⁿ = 1 through the boundary of the loaded cells; n = 2 is an ellipse, larger is more like a "
        "rectangle. A contact in several parts has no such outline: its values jump. Gaps: no contact."
        + _at_a_bound(field)
    )
    return picture(f"{key}-area", figure, f"Peak pressure, area and shape of the {name} contact over time", caption)


def _at_a_bound(field: FieldSeries) -> str:
    """What the exponent says where the fit stands at the end of its range: no Lamé curve lies along
    that boundary.
    """
    touching = field.area > 0.0
    low, high = FIT_EXPONENTS
    exponent = field.lame_n[touching]
    share = float(np.mean((exponent <= 1.001 * low) | (exponent >= 0.999 * high))) if touching.any() else 0.0
    if share == 0.0:
        return ""
    return (
        f" In {share:.1%} of the fields n stands at an end of its range ({low:g} to {high:g}): there no Lamé curve fits, as of "
        "a contact in several parts, and n, a and b say nothing."
    )


def _exponent_axis(axes: Axes) -> None:
    """Exponents of the fit lie within `FIT_EXPONENTS`."""
    axes.set_yscale("log")
    low, high = axes.get_ylim()
    ticks = [0.5, 1, 2, 5, 10, 20]
    axes.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.set_ylim(min(low, 0.9), max(high, 5.5))


def _with_gaps(
    time: NDArray[np.float64], values: NDArray[np.float64], there: NDArray[np.bool_]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The envelope of values, nan where they are not there."""
    times, drawn = envelope(time, np.where(there, values, 0.0))
    present = np.interp(times, time, there.astype(np.float64)) > 0.5
    return times, np.where(present, drawn, np.nan)


def _line(axes: Axes, time: NDArray[np.float64], values: NDArray[np.float64], label: str) -> None:
    draw_series(axes, time, values, color=ACCENT, linewidth=0.9)
    axes.set_ylabel(label)


def shade(axes: Axes, intervals: NDArray[np.float64]) -> None:
    """Shade intervals [intervals, 2] of time [s] over the whole height, all in one path."""
    corners = [[(start, 0.0), (start, 1.0), (end, 1.0), (end, 0.0)] for start, end in intervals]
    bands = PolyCollection(
        corners, transform=axes.get_xaxis_transform(), facecolor=SHADE, edgecolor=SHADE, linewidth=0.5, zorder=0
    )
    axes.add_collection(bands, autolim=False)


def _map(axes: Axes, field: PressureMap, window: Window, title: str, view: View) -> None:
    loaded = np.where(field.pressure > 0.0, field.pressure * 1e-3, np.nan)
    highest = float(field.pressure.max()) * 1e-3
    image = draw_map(axes, field, loaded, PRESSURE_COLOURS, Normalize(0.0, highest or 1.0))
    set_window(axes, window)
    axes.set_title(title)
    axes.set_xlabel(view.across)
    axes.set_ylabel(view.along)
    bar = axes.figure.colorbar(image, cax=axes.inset_axes((1.04, 0.0, 0.045, 1.0)), label="kPa")
    bar.ax.spines["outline"].set_visible(False)


def _mark_peak(axes: Axes, field: PressureMap) -> None:
    row, col = np.unravel_index(int(field.pressure.argmax()), field.pressure.shape)
    x, y = field.origin_x + row * field.cell_x, field.origin_y + col * field.cell_y
    axes.plot([y * 1e3], [x * 1e3], marker="x", color="#ffffff", markersize=7, markeredgewidth=2.6, linestyle="")
    axes.plot([y * 1e3], [x * 1e3], marker="x", color="#b3202c", markersize=6.4, markeredgewidth=1.3, linestyle="")


def _map_height(window: Window) -> float:
    """[inch] that two maps side by side need at equal aspect."""
    return float(np.clip(0.85 + window.aspect * 0.34 * WIDTH, 2.0, 5.5))
