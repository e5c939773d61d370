"""Pictures of one contact: load and approach over time, load over approach, pressure maps, peak and area.

`key` is an identifier on the page, `name` what the contact is called in texts.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from numpy.typing import NDArray

from .decimate import envelope
from .drawing import ACCENT, INK, MUTED, PRESSURE_COLOURS, SHADE, WIDTH, Picture, new_figure, picture
from .series import ContactSeries, FieldSeries, PressureMap
from .summary import field_numbers, force_numbers

LOOP_POINTS = 4000
"""Most points of the curve of load over approach."""


class Window(NamedTuple):
    """Part of the contact plane that maps show, [mm]."""

    low_x: float
    high_x: float
    low_y: float
    high_y: float


def lifted_intervals(contact: ContactSeries) -> NDArray[np.float64]:
    """Start and end [s] of each stretch without load, [stretches, 2]; it ends at the first sample with load again."""
    apart = np.concatenate([[False], contact.normal <= 0.0, [False]])
    changes = np.flatnonzero(apart[1:] != apart[:-1]).reshape(-1, 2)
    ends = np.append(contact.time, contact.time[-1] + contact.sample_period)
    intervals: NDArray[np.float64] = ends[changes]
    return intervals


def load_over_time(key: str, name: str, contact: ContactSeries) -> Picture:
    """Normal force with lift-off shaded, friction force where there is any, approach; common time axis."""
    with_friction = bool(np.any(contact.tangential))
    rows = 3 if with_friction else 2
    figure, axes = new_figure(1.0 + 1.45 * rows, rows, sharex=True)
    unit, scale = force_unit(contact)
    _line(axes[0], contact.time, contact.normal * scale, f"normal force, {unit}")
    _shade(axes[0], lifted_intervals(contact))
    axes[0].axhline(contact.normal.mean() * scale, color=INK, linewidth=0.9, linestyle=(0, (4, 3)))
    axes[0].set_ylim(bottom=0.0)
    if with_friction:
        _line(axes[1], contact.time, contact.tangential * scale, f"friction force, {unit}")
    _line(axes[-1], contact.time, contact.approach * 1e3, "approach, mm")
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
        f"Normal force between {numbers['load_min_N']:.4g} and {numbers['load_max_N']:.4g} N, mean "
        f"{numbers['load_mean_N']:.4g} N (dashed). Approach between {contact.approach.min() * 1e3:.3g} and "
        f"{contact.approach.max() * 1e3:.3g} mm, positive in compression. "
    )
    if not numbers["lifted_share"]:
        return text + "The contact never opens."
    times = "once" if numbers["lift_offs"] == 1 else f"{numbers['lift_offs']} times"
    return text + f"It lifts off {times}; {numbers['lifted_share']:.2%} of the time (shaded) it carries no load."


def force_unit(contact: ContactSeries) -> tuple[str, float]:
    """Unit for an axis of forces, and the factor from [N] to it."""
    return ("kN", 1e-3) if contact.normal.max() >= 2000.0 else ("N", 1.0)


def load_over_approach(key: str, name: str, contact: ContactSeries) -> Picture:
    """Load-deflection curve of the whole run; its opening is the loss."""
    figure, (axes,) = new_figure(3.1)
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
        "even ground; loops are losses, a band is uneven ground at the same approach."
    )
    return picture(f"{key}-loop", figure, f"Normal force of the {name} contact over its approach", caption)


def pressure_maps(key: str, name: str, field: FieldSeries) -> Picture:
    """The map with the largest peak and the mean map, one colour scale each, cells as they are."""
    window = _loaded_window(field.average)
    figure, axes = new_figure(_map_height(window), 1, 2)
    _map(axes[0], field.highest, window, f"largest peak, t = {field.highest_time:.3f} s")
    _mark_peak(axes[0], field.highest)
    _map(axes[1], field.average, window, "mean over the run")
    rows, cols = field.highest.pressure.shape
    caption = (
        f"Pressure of the cells ({rows} × {cols} of {field.highest.cell_x * 1e3:.3g} × "
        f"{field.highest.cell_y * 1e3:.3g} mm), not interpolated; cells without pressure are blank, the grid is cut to "
        f"what was ever loaded. Left: the largest peak of the run, {field.highest.pressure.max() * 1e-3:.4g} kPa "
        f"(cross) at {field.highest_time:.3f} s. Right: the mean of {field.time.size} fields, at most "
        f"{field.average.pressure.max() * 1e-3:.4g} kPa. Seen from above, forward is up."
    )
    return picture(f"{key}-map", figure, f"Pressure maps of the {name} contact", caption)


def peak_and_area(key: str, name: str, field: FieldSeries) -> Picture:
    """Largest pressure and contact area over time."""
    figure, axes = new_figure(3.4, 2, sharex=True)
    _line(axes[0], field.time, field.peak * 1e-3, "peak pressure, kPa")
    _line(axes[1], field.time, field.area * 1e4, "contact area, cm²")
    axes[0].plot(
        [field.highest_time], [field.peak.max() * 1e-3], marker="x", color=INK, markersize=6, linestyle="none",
        clip_on=False,
    )  # fmt: skip
    for each in axes:
        each.set_ylim(bottom=0.0)
    axes[1].set_xlabel("simulated time, s")
    axes[1].set_xlim(field.time[0], max(field.time[-1], field.time[0] + 1e-3))
    numbers = field_numbers(field)
    caption = (
        f"Peak pressure up to {numbers['peak_pressure_Pa'] * 1e-3:.4g} kPa (cross, at {field.highest_time:.3f} s). "
        f"Contact area {field.area.min() * 1e4:.4g} to {field.area.max() * 1e4:.4g} cm², mean "
        f"{numbers['contact_area_mean_m2'] * 1e4:.4g} cm²: all cells with a pressure above 0."
    )
    return picture(f"{key}-area", figure, f"Peak pressure and contact area of the {name} contact over time", caption)


def _line(axes: Axes, time: NDArray[np.float64], values: NDArray[np.float64], label: str) -> None:
    axes.plot(*envelope(time, values), color=ACCENT, linewidth=0.9)
    axes.set_ylabel(label)


def _shade(axes: Axes, intervals: NDArray[np.float64]) -> None:
    """Bands over the whole height, all in one path."""
    corners = [[(start, 0.0), (start, 1.0), (end, 1.0), (end, 0.0)] for start, end in intervals]
    bands = PolyCollection(
        corners, transform=axes.get_xaxis_transform(), facecolor=SHADE, edgecolor=SHADE, linewidth=0.5, zorder=0
    )
    axes.add_collection(bands, autolim=False)


def _map(axes: Axes, field: PressureMap, window: Window, title: str) -> None:
    """Forward (x) up, left (y) to the left: as seen from above, facing forward."""
    rows, cols = field.pressure.shape
    low_x, low_y = field.origin_x - field.cell_x / 2, field.origin_y - field.cell_y / 2
    extent = np.array([low_y, low_y + cols * field.cell_y, low_x, low_x + rows * field.cell_x]) * 1e3
    loaded = np.where(field.pressure > 0.0, field.pressure * 1e-3, np.nan)
    image = axes.imshow(
        loaded, origin="lower", extent=tuple(extent), cmap=PRESSURE_COLOURS, vmin=0.0, interpolation="nearest",
        aspect="equal",
    )  # fmt: skip
    axes.set_xlim(window.high_y, window.low_y)
    axes.set_ylim(window.low_x, window.high_x)
    axes.grid(visible=False)
    axes.set_title(title)
    axes.set_xlabel("← left, y, mm")
    axes.set_ylabel("forward, x, mm →")
    bar = axes.figure.colorbar(image, cax=axes.inset_axes((1.04, 0.0, 0.045, 1.0)), label="kPa")
    bar.ax.spines["outline"].set_visible(False)


def _mark_peak(axes: Axes, field: PressureMap) -> None:
    row, col = np.unravel_index(int(field.pressure.argmax()), field.pressure.shape)
    x, y = field.origin_x + row * field.cell_x, field.origin_y + col * field.cell_y
    axes.plot([y * 1e3], [x * 1e3], marker="x", color="#ffffff", markersize=7, markeredgewidth=2.6, linestyle="")
    axes.plot([y * 1e3], [x * 1e3], marker="x", color="#b3202c", markersize=6.4, markeredgewidth=1.3, linestyle="")


def _loaded_window(average: PressureMap) -> Window:
    """The cells that were ever loaded with two cells around them; the whole grid where none was."""
    rows, cols = (np.flatnonzero(average.pressure.any(axis=axis)) for axis in (1, 0))
    if not rows.size:
        rows, cols = (np.arange(size) for size in average.pressure.shape)
    low_x, high_x = (
        average.origin_x + (row + side) * average.cell_x for row, side in ((rows[0], -2.5), (rows[-1], 2.5))
    )
    low_y, high_y = (
        average.origin_y + (col + side) * average.cell_y for col, side in ((cols[0], -2.5), (cols[-1], 2.5))
    )
    return Window(low_x * 1e3, high_x * 1e3, low_y * 1e3, high_y * 1e3)


def _map_height(window: Window) -> float:
    """[inch] that two maps side by side need at equal aspect."""
    aspect = (window.high_x - window.low_x) / (window.high_y - window.low_y)
    return float(np.clip(0.85 + aspect * 0.34 * WIDTH, 2.0, 5.5))
