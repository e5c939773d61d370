"""Pictures that lay several runs of one rig over each other: forces over time, loops, area,
slaps.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from contact_sim_pkg.report.drawing import MUTED, Margins, Picture, new_figure, picture
from contact_sim_pkg.report.figures.contact import force_unit
from contact_sim_pkg.report.rig_reports import drive_period
from contact_sim_pkg.report.series import FloatArray, Recording
from contact_sim_pkg.report.signal.decimate import envelope
from contact_sim_pkg.report.signal.episodes import durations, slaps_of
from contact_sim_pkg.report.signal.loops import (
    Loop,
    area_ratio,
    loop_work,
    normal_loop,
    point_loop,
    steady_start,
    tangential_loop,
)

COLOURS = ("#2f7fb5", "#e08a2e", "#3f9b63", "#b4508f", "#8a6d3b", "#6a6fd0")
"""Of the runs in their order; seen on light and on dark ground."""
BELOW_LEGEND = Margins(top=0.85, right=0.24)
"""Room for the legend of up to six runs."""
LOOP_POINTS = 3000
"""Most points of the curve of one run."""


class Run(NamedTuple):
    """One of the runs that are compared."""

    label: str
    colour: str
    recording: Recording

    def steady(self) -> tuple[float, float | None]:
        """Start [s] of the last cycles of the drive, and its period [s]; 0 and None for a drive
        without cycles.
        """
        period = drive_period(self.recording)
        return steady_start(self.recording.duration, period), period


def make_runs(names: Sequence[str], recordings: Sequence[Recording]) -> list[Run]:
    """A colour for each, of as many as there are."""
    return [Run(*each) for each in zip(names, COLOURS, recordings, strict=False)]


def force_comparison(key: str, name: str, runs: list[Run], title: str) -> Picture:
    """Normal force: over the last cycles of the drive where every run has one, else over time."""
    cyclic = all(run.steady()[1] is not None for run in runs)
    contacts = [run.recording.contacts[name] for run in runs]
    unit, scale = max((force_unit(each) for each in contacts), key=lambda found: -found[1])
    figure, (axes,) = new_figure(3.1, margins=BELOW_LEGEND)
    for run, contact in zip(runs, contacts, strict=True):
        time, force = _over_cycles(run, contact.time, contact.normal) if cyclic else (contact.time, contact.normal)
        axes.plot(*envelope(time, force * scale), color=run.colour, linewidth=1.0, label=run.label)
    axes.set_ylim(bottom=0.0)
    axes.set_ylabel(f"normal force, {unit}")
    axes.set_xlabel("cycles of the drive, to the end of the run" if cyclic else "simulated time, s")
    legend(figure, axes, title)
    parts = [
        f"{run.label}: {each.normal.max():.4g} N, mean {each.normal.mean():.4g} N"
        for run, each in zip(runs, contacts, strict=True)
    ]
    caption = f"Normal force of the {name} contact. Largest and mean of the whole run: {'; '.join(parts)}."
    return picture(f"{key}-force", figure, f"Normal force of the {name} contact in every run", caption)


def _over_cycles(run: Run, time: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The last cycles, in cycles from their start."""
    begin, period = run.steady()
    chosen = time >= begin
    return (time[chosen] - begin) / (period or 1.0), values[chosen]


def loop_comparison(key: str, name: str, runs: list[Run], title: str) -> Picture:
    """Normal force over approach, of point 1 too where there are many, and friction over tangential
    displacement.
    """
    panels: list[tuple[str, str, str, Callable[[Recording], Loop | None]]] = [
        ("normal force, N", "approach, mm", "whole contact", lambda each: normal_loop(each.contacts[name]))
    ]
    if any(run.recording.points is not None and run.recording.points.points > 1 for run in runs):
        panels.insert(0, ("normal force, N", "approach, mm", "point 1", _point_loop))
    if any(_friction_loop(name, run.recording) is not None for run in runs):
        label = "point 1, friction"
        panels.append(
            ("friction force, N", "tangential displacement, mm", label, lambda each: _friction_loop(name, each))
        )
    # One panel a loop, all runs in it
    figure, axes = new_figure(3.7, 1, len(panels), BELOW_LEGEND)
    for place, (along, across, label, loop_of) in zip(axes, panels, strict=True):
        for run in runs:
            _draw_loop(place, run, loop_of(run.recording))
        place.set_xlabel(across)
        place.set_ylabel(along)
        place.set_title(label)
        place.axhline(0.0, color=MUTED, linewidth=0.7)
    legend(figure, axes[0], title)
    caption = (
        "Forces over the displacements they work on; positive approach is compression. "
        f"{_loop_part(runs)}{_loop_works(name, runs, friction=panels[-1][0].startswith('friction'))}"
    )
    return picture(f"{key}-loops", figure, f"Force loops of the {name} contact in every run", caption)


def _point_loop(recording: Recording) -> Loop | None:
    return None if recording.points is None else point_loop(recording.points)


def _friction_loop(name: str, recording: Recording) -> Loop | None:
    contact, points = recording.contacts[name], recording.points
    return tangential_loop(contact, points) if points is not None and contact.tangential.any() else None


def _draw_loop(axes: Axes, run: Run, loop: Loop | None) -> None:
    if loop is None:
        return
    shown, dots = loop.steady(run.steady()[0])
    style: dict[str, Any] = {"linestyle": "", "marker": "."} if dots else {}
    stride = max(1, shown.force.size // LOOP_POINTS)
    axes.plot(
        shown.displacement[::stride] * 1e3, shown.force[::stride], color=run.colour, linewidth=0.9, markersize=3.0,
        label=run.label, **style,
    )  # fmt: skip


def _loop_part(runs: list[Run]) -> str:
    text = "The last two cycles of the drive. " if all(run.steady()[1] for run in runs) else "The whole run. "
    if all(run.recording.points is None or run.recording.points.points == 1 for run in runs):
        return text
    return (
        f"{text}Point 1 at the rate of the fields; dots, where these are few, are those of the second half of the run. "
    )


def _loop_works(name: str, runs: list[Run], *, friction: bool) -> str:
    """Work a cycle, where one loop is all that the contact does."""
    if not all(run.steady()[1] and run.recording.points and run.recording.points.points == 1 for run in runs):
        return ""
    parts = []
    for run in runs:
        begin, period = run.steady()
        cycles = (run.recording.duration - begin) / (period or 1.0)
        text = f"{run.label}: {loop_work(normal_loop(run.recording.contacts[name]).since(begin)) / cycles:.4g} J"
        loop = _friction_loop(name, run.recording) if friction else None
        parts.append(text if loop is None else f"{text} and {loop_work(loop.since(begin)) / cycles:.4g} J")
    return f"Work that the contact takes a cycle{', and friction' if friction else ''}: {'; '.join(parts)}."


def area_comparison(key: str, name: str, runs: list[Run], title: str) -> Picture | None:
    """Figure 7: area over S_ref through one impact and over the last cycles; None where a run lacks
    it.
    """
    fields = [run.recording.fields.get(name) for run in runs]
    areas = [None if field is None else area_ratio(field) for field in fields]
    drawn = [(run, area) for run, area in zip(runs, areas, strict=True) if area is not None]
    if not drawn:
        return None
    slapping = [(run, area, slap) for run, area in drawn if (slap := _last_slap(run)) is not None]
    cyclic = all(run.steady()[1] for run, _ in drawn)
    figure, axes = new_figure(3.2, 1, 2 if slapping else 1, BELOW_LEGEND)
    # Left: through one impact
    for run, area, (start, end) in slapping:
        during = (area.time >= start) & (area.time <= end)
        axes[0].plot((area.time[during] - start) * 1e3, area.ratio[during], color=run.colour, label=run.label)
    if slapping:
        axes[0].set_xlabel("time since the touch, ms")
    # Right, or alone: over the last cycles of the drive
    for run, area in drawn:
        time, ratio = _over_cycles(run, area.time, area.ratio) if cyclic else (area.time, area.ratio)
        axes[-1].plot(*envelope(time, ratio), color=run.colour, linewidth=0.9, label=run.label)
    axes[-1].set_xlabel("cycles of the drive, to the end of the run" if cyclic else "simulated time, s")
    for place in axes:
        place.set_ylim(bottom=0.0)
        place.axhline(1.0, color=MUTED, linewidth=0.7)
    axes[0].set_ylabel("S / S_ref")
    legend(figure, axes[-1], title)
    parts = [f"{run.label}: up to {area.ratio.max():.3g}, mean {area.ratio.mean():.3g}" for run, area in drawn]
    first = "Left: the last whole slap of each run. " if slapping else ""
    caption = (
        f"Area of the contact domain over S_ref, the area of the same run at rest under its largest static load. {first}"
        f"Whole run: {'; '.join(parts)}."
    )
    return picture(f"{key}-ratio", figure, f"Area of the contact domain of the {name} in every run", caption)


def _last_slap(run: Run) -> tuple[float, float] | None:
    slaps = slaps_of(run.recording.episodes)
    return (float(slaps.start[-1]), float(slaps.end[-1])) if slaps.start.size else None


def slap_comparison(key: str, name: str, runs: list[Run], title: str) -> Picture | None:
    """Restitution and duration of every slap; None where no run has one."""
    found = [(run, slaps_of(run.recording.episodes)) for run in runs]
    found = [(run, slaps) for run, slaps in found if slaps.start.size]
    if not found:
        return None
    figure, axes = new_figure(3.8, 2, margins=BELOW_LEGEND, sharex=True)
    for run, slaps in found:
        style: dict[str, Any] = {
            "linestyle": "-",
            "linewidth": 0.6,
            "marker": "o",
            "markersize": 3.2,
            "color": run.colour,
            "label": run.label,
        }
        axes[0].plot(slaps.start, slaps.restitution, **style)
        axes[1].plot(slaps.start, durations(slaps) * 1e3, **style)
    axes[0].set_ylabel("restitution e")
    axes[1].set_ylabel("duration, ms")
    axes[1].set_xlabel("simulated time of the touch, s")
    axes[1].set_xlim(left=0.0)
    # Axes from zero, with room above the largest value
    tops = (
        max(float(slaps.restitution.max()) for _, slaps in found),
        max(float(durations(each).max()) for _, each in found) * 1e3,
    )
    for place, top in zip(axes, tops, strict=True):
        place.set_ylim(0.0, 1.12 * top or 1.0)
    figure.align_ylabels(axes)
    legend(figure, axes[0], title)
    caption = (
        "Restitution e = √(W_r/−W_c) from the works of opening and closing, and time from the touch to the last loss of force, of "
        "every slap that ended within its run."
    )
    return picture(f"{key}-slaps", figure, f"Restitution and duration of the slaps of the {name} in every run", caption)


def over_legend(height: float, cols: int) -> tuple[Figure, list[Axes]]:
    """A figure of `height` [in] with room for `legend` above its axes."""
    return new_figure(height + 0.5, 1, cols, BELOW_LEGEND)


def legend(figure: Figure, axes: Axes, title: str) -> None:
    """One legend above all panels."""
    handles, names = axes.get_legend_handles_labels()
    figure.legend(handles, names, title=title, loc="upper left", ncols=4, alignment="left")
