"""Pictures over the distance travelled: force, footprint, road."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from numpy.typing import NDArray

from contact_sim_pkg.report.drawing import (
    ACCENT,
    INK,
    MUTED,
    PRESSURE_COLOURS,
    SHADE,
    Margins,
    Picture,
    draw_series,
    legend_above,
    new_figure,
    picture,
)
from contact_sim_pkg.report.figures.maps import extension, robust_limits
from contact_sim_pkg.report.series import ContactSeries, FieldSeries, FloatArray
from contact_sim_pkg.report.signal.decimate import envelope
from contact_sim_pkg.report.signal.lift_off import lifted_intervals
from contact_sim_pkg.report.signal.low_pass import low_pass
from contact_sim_pkg.rigs.vehicle.tire.report.axle_series import AxleSeries
from contact_sim_pkg.rigs.vehicle.tire.report.closed_form import TireReference
from contact_sim_pkg.rigs.vehicle.tire.report.road_series import RoadSeries

BEFORE, AFTER = (0.7, 0.1), (2.0, 0.3)
"""[m], [s] shown at least before and after the largest load"""


LEAST_WAY = 0.01
"""[m] that the wheel must travel for a picture over distance"""


class RoadSection(NamedTuple):
    """Part of the road, [m]."""

    start: float
    end: float


class Rolling(NamedTuple):
    """What is drawn over distance."""

    contact: ContactSeries
    field: FieldSeries | None
    road: RoadSeries
    reference: TireReference | None
    axle: AxleSeries | None = None


def whole_way(rolling: Rolling) -> RoadSection | None:
    """All of the way; None where the wheel stands."""
    start, end = (float(end) for end in rolling.road.travel.at(rolling.contact.time[[0, -1]]))
    return RoadSection(start, end) if end - start >= LEAST_WAY else None


def near_largest_load(rolling: Rolling, whole: RoadSection) -> RoadSection:
    """The section around the largest load (of a field, where there are any); the whole way where that is not much longer."""
    time = _focus(rolling)
    way, behind, ahead = rolling.road.travel.at(np.array([time, time - BEFORE[1], time + AFTER[1]]))
    start, end = min(way - BEFORE[0], behind), max(way + AFTER[0], ahead)
    near = RoadSection(max(float(start), whole.start), min(float(end), whole.end))
    return whole if near.end - near.start > 0.6 * (whole.end - whole.start) else near


def _focus(rolling: Rolling) -> float:
    """[s] of the largest load."""
    if rolling.field is not None:
        return rolling.field.heaviest.time
    return float(rolling.contact.time[int(rolling.contact.normal.argmax())])


def along_the_road(key: str, name: str, rolling: Rolling, section: RoadSection) -> Picture:
    """Normal force raw and filtered, the footprint's line load, and the road below, on one axis of
    distance.
    """
    ratios = [3.0, *([1.6] if rolling.axle is not None else []), *([2.2] if rolling.field is not None else []), 2.0]
    figure, axes = new_figure(
        0.5 + 0.7 * sum(ratios),
        len(ratios),
        margins=Margins(left=1.0, right=0.8, shared=0.28),
        sharex=True,
        height_ratios=ratios,
    )
    band = _draw_force(axes[0], rolling, section)
    if rolling.axle is not None:
        _draw_longitudinal(axes[1], rolling.axle, rolling.road, section)
    if rolling.field is not None:
        _draw_line_load(figure, axes[-2], rolling.field, rolling.road, section)
    _draw_road(axes[-1], rolling, section)
    axes[-1].set_xlim(section.start, section.end)
    axes[-1].set_xlabel("distance travelled, m")
    figure.align_ylabels(axes)
    return picture(
        f"{key}-road-{section.start:.0f}-{section.end:.0f}", figure,
        f"Force, footprint and road of the {name} from {section.start:.2f} to {section.end:.2f} m",
        _caption(rolling, section) + band,
    )  # fmt: skip


def force_over_road(key: str, name: str, rolling: Rolling, section: RoadSection) -> Picture:
    """Normal force raw and filtered over the distance, and the road below."""
    figure, axes = new_figure(2.6, 2, margins=Margins(shared=0.28), sharex=True, height_ratios=[3.0, 2.0])
    band = _draw_force(axes[0], rolling, section)
    _draw_road(axes[1], rolling, section)
    axes[0].set_ylabel("force, kN")
    axes[1].set_xlim(section.start, section.end)
    axes[1].set_xlabel("distance travelled, m")
    figure.align_ylabels(axes)
    return picture(
        f"{key}-way",
        figure,
        f"Force and road of the {name} over the whole way",
        _force_sentence(rolling, section) + band,
    )


def _draw_force(axes: Axes, rolling: Rolling, section: RoadSection) -> str:
    """Returns the sentence of the caption on a long series, which is drawn as a band."""
    contact, travel = rolling.contact, rolling.road.travel
    distance = travel.at(contact.time)
    inside = _inside(distance, section)
    filtered = low_pass(contact.normal, 1.0 / contact.sample_period)
    raw = "raw" if filtered is not None else "normal force"
    band = draw_series(axes, distance[inside], contact.normal[inside] * 1e-3, color=MUTED, linewidth=0.8, label=raw)
    if filtered is not None:
        draw_series(axes, distance[inside], filtered[inside] * 1e-3, color=ACCENT, linewidth=1.2, label="100 Hz")
    if rolling.reference is not None:
        load = rolling.reference.load * 1e-3
        axes.axhline(load, color=INK, linewidth=0.8, linestyle=(0, (4, 3)), label="at rest")
    intervals = lifted_intervals(contact)
    lifted = np.column_stack([travel.at(intervals[:, 0]), travel.at(intervals[:, 1])])
    lifted = lifted[(lifted[:, 1] >= section.start) & (lifted[:, 0] <= section.end)]
    corners = [[(start, 0.0), (start, 1.0), (end, 1.0), (end, 0.0)] for start, end in lifted]
    label = "lift-off" if corners else None
    bands = PolyCollection(
        corners, transform=axes.get_xaxis_transform(), facecolor=SHADE, edgecolor=SHADE, linewidth=0.5, zorder=0,
        label=label,
    )  # fmt: skip
    axes.add_collection(bands, autolim=False)
    axes.set_ylim(0.0, 1.05 * float(contact.normal[inside].max(initial=1.0)) * 1e-3)
    axes.set_ylabel("normal force, kN")
    legend_above(axes)
    return band


def _draw_longitudinal(axes: Axes, axle: AxleSeries, road: RoadSeries, section: RoadSection) -> None:
    """Force along the road on the axle, through the same filter as the normal force."""
    distance = road.travel.at(axle.time)
    inside = _inside(distance, section)
    filtered = low_pass(axle.longitudinal, 1.0 / axle.sample_period)
    if filtered is not None:
        draw_series(axes, distance[inside], axle.longitudinal[inside], color=MUTED, linewidth=0.8)
    shown = axle.longitudinal if filtered is None else filtered
    draw_series(axes, distance[inside], shown[inside], color=ACCENT, linewidth=1.2)
    axes.axhline(0.0, color=INK, linewidth=0.8, linestyle=(0, (4, 3)))
    axes.set_ylabel("force along,\nN")


def _draw_line_load(figure: Figure, axes: Axes, field: FieldSeries, road: RoadSeries, section: RoadSection) -> None:
    """Every field a column at its place, as wide as the way to its neighbours."""
    distance = road.travel.at(field.history_time)
    moving = np.concatenate([[True], np.diff(distance) > 0.0]) & _inside(distance, section)
    if np.count_nonzero(moving) < 2:
        axes.text(0.5, 0.5, "the wheel does not move", transform=axes.transAxes, ha="center", color=MUTED)
        return
    average = field.average
    x = (average.origin_x + np.arange(average.pressure.shape[0]) * average.cell_x) * 1e3
    loaded = np.flatnonzero(field.history[moving].any(axis=0))
    kept = slice(max(loaded[0] - 2, 0), loaded[-1] + 3) if loaded.size else slice(None)
    values = field.history[moving][:, kept].T * 1e-3
    limits = robust_limits(values, 0.005)
    mesh = axes.pcolormesh(
        distance[moving], x[kept], np.where(values > 0.0, values, np.nan), cmap=PRESSURE_COLOURS, norm=limits,
        shading="nearest", rasterized=True,
    )  # fmt: skip
    axes.grid(visible=False)
    axes.set_ylabel("in the footprint,\nx, mm")
    bar = figure.colorbar(
        mesh, cax=axes.inset_axes((1.01, 0.0, 0.014, 1.0)), label="line load,\nN/mm", extend=extension(values, limits)
    )
    bar.ax.spines["outline"].set_visible(False)


def _draw_road(axes: Axes, rolling: Rolling, section: RoadSection) -> None:
    road, contact = rolling.road, rolling.contact
    inside = _inside(road.distance, section)
    distance = road.distance[inside]
    if np.any(road.high[inside] - road.low[inside] > 1e-6):
        low, high = envelope(distance, road.low[inside] * 1e3), envelope(distance, road.high[inside] * 1e3)
        axes.fill_between(
            high[0], np.interp(high[0], *low), high[1], color=SHADE, linewidth=0.0, label="strip of 0.1 m"
        )
    axes.plot(*envelope(distance, road.middle[inside] * 1e3), color=INK, linewidth=0.9, label="road")
    # The effective height only where the tire is in contact.
    way = road.travel.at(contact.time)
    shown = _inside(way, section) & (contact.normal > 0.0)
    followed = np.where(shown, contact.effective_height * 1e3, np.nan)[_inside(way, section)]
    stride = max(1, followed.size // 4000)
    axes.plot(
        way[_inside(way, section)][::stride],
        followed[::stride],
        color=ACCENT,
        linewidth=0.9,
        label="as the tire feels it",
    )
    axes.set_ylabel("height, mm")
    legend_above(axes)


def _force_sentence(rolling: Rolling, section: RoadSection) -> str:
    """Largest force, and whether the contact opens."""
    contact, travel = rolling.contact, rolling.road.travel
    distance = travel.at(contact.time)
    inside = _inside(distance, section)
    place = int(np.flatnonzero(inside)[contact.normal[inside].argmax()])
    lifted = float((contact.normal[inside] <= 0.0).mean())
    text = f"Grey as sampled, blue through the 100 Hz filter. Largest: {contact.normal[place]:.5g} N at {distance[place]:.3f} m. "
    return text + (
        f"Without load (shaded) for {lifted:.2%} of the time." if lifted else "The contact never opens here."
    )


def _caption(rolling: Rolling, section: RoadSection) -> str:
    text, travel = f"{_force_sentence(rolling, section)} ", rolling.road.travel
    if rolling.axle is not None:
        along = rolling.axle.longitudinal[_inside(travel.at(rolling.axle.time), section)]
        text += f"Below it: force of the road along the travel, forward positive, from {along.min():.4g} to {along.max():.4g} N. "
    # The pressure history is drawn across the footprint; its scale follows from Hertz at rest.
    if rolling.field is not None:
        group = rolling.field.history_group
        text += "Middle: pressure integrated across the width, along the footprint (forward up), one column a field"
        text += f" (mean of {group})" if group > 1 else ""
        if rolling.reference is not None:
            across = 2e3 * rolling.reference.semi_axis_y
            text += f"; over the {across:.0f} mm of the footprint at rest, 10 N/mm are {1e4 / across:.0f} kPa"
        text += ". "
    return text + (
        "Below: height of the road in the middle of the track and, in blue, of the even ground that would give the same "
        "force: the road as the footprint envelops it."
    )


def _inside(distance: FloatArray, section: RoadSection) -> NDArray[np.bool_]:
    return np.asarray((distance >= section.start) & (distance <= section.end))
