"""Pictures of slaps: force with slaps marked, restitution and duration of each, shares of stick,
slip and lift-off.
"""

from __future__ import annotations

import numpy as np

from contact_sim_pkg.report.drawing import ACCENT, INK, MUTED, SHADE, Margins, Picture, draw_series, new_figure, picture
from contact_sim_pkg.report.figures.contact import force_numbers, force_unit, shade
from contact_sim_pkg.report.point_series import PointSeries
from contact_sim_pkg.report.series import ContactSeries, EpisodeSeries, FloatArray, Recording
from contact_sim_pkg.report.signal.episodes import durations
from contact_sim_pkg.report.signal.lift_off import lifted_intervals
from contact_sim_pkg.rigs.backrest.report.numbers import Shares, drive_period, state_shares

STATE_COLOURS = {
    "apart": SHADE,
    "carries": ACCENT,
    "sticks": "#2f7fb5",
    "slips": "#e08a2e",
}


def force_with_slaps(key: str, name: str, contact: ContactSeries, slaps: EpisodeSeries) -> Picture:
    """Normal force, friction where there is any, and approach over time; lift-off shaded, each slap
    marked.
    """
    unit, scale = force_unit(contact)
    panels = [(f"normal force, {unit}", contact.normal * scale)]
    panels += [(f"friction on back, {unit}", contact.tangential * scale)] if contact.tangential.any() else []
    panels.append(("approach, mm", contact.approach * 1e3))
    figure, axes = new_figure(1.0 + 1.45 * len(panels), len(panels), sharex=True)
    for place, (label, values) in zip(axes, panels, strict=True):
        draw_series(place, contact.time, values, color=ACCENT, linewidth=0.9)
        place.set_ylabel(label)
    shade(axes[0], lifted_intervals(contact))
    if slaps.start.size:
        axes[0].plot(
            _peak_times(contact, slaps), slaps.peak_force * scale, linestyle="", marker="v", markersize=4.5, color=INK,
            clip_on=False,
        )  # fmt: skip
    axes[0].set_ylim(bottom=0.0)
    for place in axes[1:]:
        place.axhline(0.0, color=MUTED, linewidth=0.7)
    axes[-1].set_xlabel("simulated time, s")
    axes[-1].set_xlim(contact.time[0], contact.time[-1] + contact.sample_period)
    figure.align_ylabels(axes)
    return picture(
        f"{key}-force", figure, f"Forces and approach of the {name} contact over time", _caption(contact, slaps)
    )


def _peak_times(contact: ContactSeries, slaps: EpisodeSeries) -> list[float]:
    """Instant [s] of the largest sample within each slap."""
    first, last = np.searchsorted(contact.time, slaps.start), np.searchsorted(contact.time, slaps.end)
    return [
        float(contact.time[begin + int(contact.normal[begin:end].argmax())]) if end > begin else float(start)
        for begin, end, start in zip(first, last, slaps.start, strict=True)
    ]


def _caption(contact: ContactSeries, slaps: EpisodeSeries) -> str:
    numbers, count = force_numbers(contact), slaps.start.size
    text = (
        f"Normal force between {numbers['load_min_N']:.4g} and {numbers['load_max_N']:.5g} N, mean "
        f"{numbers['load_mean_N']:.5g} N; approach between {contact.approach.min() * 1e3:.4g} and "
        f"{contact.approach.max() * 1e3:.4g} mm, positive in compression, of the deepest point. "
    )
    if not numbers["lifted_share"]:
        text += "The contact never opens. "
    else:
        text += f"Shaded: no load, {numbers['lifted_share']:.2%} of the time. "
    if count:
        text += f"{count} slap{'s' if count > 1 else ''} that ended within the run, each marked at its largest force."
    else:
        text += "No slap ended within the run."
    return text


def restitution_over_time(key: str, name: str, slaps: EpisodeSeries) -> Picture | None:
    """Restitution from the works and duration of each slap; None without slaps."""
    if not slaps.start.size:
        return None
    figure, axes = new_figure(3.9, 3, sharex=True)
    rows = (
        ("restitution e", slaps.restitution), ("duration, ms", durations(slaps) * 1e3),
        ("largest force, N", slaps.peak_force),
    )  # fmt: skip
    for place, (label, values) in zip(axes, rows, strict=True):
        place.plot(slaps.start, values, linestyle="", marker="o", markersize=3.5, color=ACCENT, clip_on=False)
        place.vlines(slaps.start, 0.0, values, color=ACCENT, linewidth=0.5, alpha=0.4)
        place.set_ylim(0.0, 1.12 * float(values.max()) or 1.0)
        place.set_ylabel(label)
    axes[-1].set_xlabel("simulated time of the touch, s")
    axes[-1].set_xlim(left=0.0)
    figure.align_ylabels(axes)
    lasted, lost = durations(slaps), slaps.compression_work + slaps.restitution_work
    caption = (
        f"Restitution e = √(W_r/−W_c) of each slap, from the works of opening and closing: {slaps.restitution.min():.4g} to "
        f"{slaps.restitution.max():.4g}, mean {slaps.restitution.mean():.4g}. In a driven contact it is not the restitution that "
        f"the scene sets for a free impact: the drive works on while it lasts. Duration from the touch to the last loss of force, "
        f"{lasted.min() * 1e3:.4g} to {lasted.max() * 1e3:.4g} ms. The slaps dissipated {-lost.sum():.4g} J in all."
    )
    return picture(f"{key}-restitution", figure, f"Restitution and duration of each slap of the {name}", caption)


def share_over_time(key: str, name: str, recording: Recording) -> Picture | None:
    """Shares of the states over the cycles of the drive; None without points, and where they all do
    the same throughout.
    """
    points = recording.points
    if points is None:
        return None
    period = drive_period(recording.scene)
    shares = state_shares(points, period)
    bands = [(label, values) for label, values in zip(STATE_COLOURS, shares[1:], strict=True) if values.any()]
    if len(bands) < 2:
        return None
    figure, (axes,) = new_figure(2.4, margins=Margins(right=0.85))
    # Stacked bands, the last state at the bottom.
    base: FloatArray = np.zeros(shares.apart.size)
    for label, values in reversed(bands):
        axes.stairs(
            base + values,
            shares.edges,
            baseline=base,
            fill=True,
            color=STATE_COLOURS[label],
            label=label,
            linewidth=0.0,
        )
        base = base + values
    carried = 1.0 - float(shares.apart.min())
    axes.set_ylim(0.0, 1.0 if points.points == 1 else min(1.0, max(1.3 * carried, 0.02)))
    axes.set_xlim(shares.edges[0], shares.edges[-1])
    axes.set_xlabel("simulated time, s")
    axes.set_ylabel("share")
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], labels[::-1], loc="center left", bbox_to_anchor=(1.0, 0.5), handlelength=1.0)
    return picture(
        f"{key}-share",
        figure,
        f"Stick, slip and lift-off of the {name} over time",
        _share_caption(points, shares, period),
    )


def _share_caption(points: PointSeries, shares: Shares, period: float | None) -> str:
    total = points.time.size * points.points
    columns = (points.apart, points.touching, points.sticking, points.slipping)
    found = [
        f"{label} {float(column.sum()) / total:.2%}"
        for label, column in zip(STATE_COLOURS, columns, strict=True)
        if column.any()
    ]
    over = "cycle of the drive" if period is not None else f"{(shares.edges[1] - shares.edges[0]) * 1e3:.3g} ms"
    of = "of the time" if points.points == 1 else f"of the time of {points.points} points"
    return f"What the contact does, in parts {of}, over each {over}. In all: {', '.join(found)}; counted at the rate of the fields."
