"""Loops of a backrest: normal force over approach, friction over tangential displacement (Driver
and Seat, figures 4 to 6).
"""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes

from contact_sim_pkg.report.drawing import ACCENT, MUTED, Picture, new_figure, picture
from contact_sim_pkg.report.point_series import PointSeries
from contact_sim_pkg.report.series import ContactSeries, Recording
from contact_sim_pkg.report.signal.loops import (
    Loop,
    loop_work,
    normal_loop,
    point_loop,
    steady_start,
    tangential_loop,
)
from contact_sim_pkg.rigs.backrest.report.numbers import drive_period

LOOP_POINTS = 4000
"""Most points of the curve of a whole run."""


def force_loops(key: str, name: str, recording: Recording) -> Picture:
    """Figures 4 to 6: normal force over approach of point 1 and of the whole back, friction over
    tangential displacement.
    """
    contact, points = recording.contacts[name], recording.points
    panels = [("approach, mm", "normal force, N", "whole contact", normal_loop(contact))]
    if points is not None and points.points > 1:
        panels.insert(0, ("approach, mm", "normal force, N", "point 1", point_loop(points)))
    elif points is not None:
        panels = [("approach, mm", "normal force, N", "point 1, the whole contact", normal_loop(contact))]
    if points is not None and contact.tangential.any():
        label = "point 1, friction"
        panels.append(("tangential displacement, mm", "friction force, N", label, tangential_loop(contact, points)))
    figure, axes = new_figure(3.1, 1, len(panels))
    # The steady part is drawn in colour: its loops are the work of a cycle.
    period = drive_period(recording.scene)
    begin = steady_start(float(contact.time[-1]) + contact.sample_period, period)
    for place, (across, along, title, loop) in zip(axes, panels, strict=True):
        _draw_loop(place, loop, begin)
        place.set_xlabel(across)
        place.set_ylabel(along)
        place.set_title(title)
    friction = panels[-1][3].since(begin) if panels[-1][1].startswith("friction") else None
    caption = _caption(contact, friction, begin, period, points)
    return picture(f"{key}-loops", figure, f"Force loops of the {name} contact", caption)


def _draw_loop(axes: Axes, loop: Loop, begin: float) -> None:
    """The whole run in grey, its steady end in colour; all in colour where it has none."""
    stride = max(1, loop.force.size // LOOP_POINTS)
    shown, dots = loop.steady(begin)
    style: dict[str, Any] = {"linestyle": "", "marker": "."} if dots else {}
    if begin > 0.0:
        axes.plot(
            loop.displacement[::stride] * 1e3, loop.force[::stride], color=MUTED, linewidth=0.5, markersize=2.0, alpha=0.5,
            **style,
        )  # fmt: skip
    stride = max(1, shown.force.size // LOOP_POINTS)
    axes.plot(
        shown.displacement[::stride] * 1e3, shown.force[::stride], color=ACCENT, linewidth=1.2, markersize=3.5, **style
    )
    axes.axhline(0.0, color=MUTED, linewidth=0.7)
    axes.axvline(0.0, color=MUTED, linewidth=0.7)


def _caption(
    contact: ContactSeries, friction: Loop | None, begin: float, period: float | None, points: PointSeries | None
) -> str:
    text = (
        "Forces over the displacements they work on; positive approach is compression. The normal force "
        f"reaches {contact.normal.max():.4g} N at approaches up to {contact.approach.max() * 1e3:.4g} mm."
    )
    many = points is not None and points.points > 1
    # Work of a cycle only where the force is recorded often enough.
    if period is not None and begin > 0.0:
        cycles = (float(contact.time[-1]) + contact.sample_period - begin) / period
        text += f" Grey: the whole run. In colour: the last {cycles:.0f} cycles of {1.0 / period:.4g} Hz"
        if not many:
            text += (
                f", in which the contact takes {loop_work(normal_loop(contact).since(begin)) / cycles:.4g} J a cycle"
            )
        if friction is not None and not many:
            text += f" and friction {loop_work(friction) / cycles:.4g} J"
        text += "."
    if friction is not None:
        text += " Friction acts on the seat back, along the displacement of the back."
    if many:
        text += (
            " Forces of point 1 are recorded at the rate of the fields, which outputs.field_rate sets; dots, where these are few, "
            "are in colour over the second half of the run."
        )
    return text
