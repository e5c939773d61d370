"""Pictures of a rigid body's run: its way over the ground, its motion, the states of its contacts,
what they pushed.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from contact_sim_pkg.report.drawing import ACCENT, INK, MUTED, RULE, Picture, new_figure, picture
from contact_sim_pkg.report.point_series import PointSeries
from contact_sim_pkg.report.series import ContactSeries
from contact_sim_pkg.report.signal.decimate import envelope
from contact_sim_pkg.rigs.body.report.pose import BlockPoses, FloatArray, chosen, ground_line, mark, outline

OTHER, THIRD = "#e08a2e", "#5b9a4b"
COLOURS = (ACCENT, OTHER, THIRD)
WIDEST, TALLEST = 7.0, 4.6  # [inch] of the picture of the way
NARROW = 0.3  # of a way's height: narrower is drawn beside time


def way(poses: BlockPoses) -> Picture:
    """Outlines of the body on its way, seen from the side; beside each other in time where it only
    goes up and down.
    """
    samples = chosen(poses)
    shapes = [outline(poses, int(sample)) for sample in samples]
    every = np.vstack(shapes)
    low, high = every.min(axis=0), every.max(axis=0)
    width, height = high - low
    # a body that only goes up and down is drawn over time
    spread = width < NARROW * height
    figure, (axis,) = new_figure(float(np.clip(6.6 * height / max(width, 1e-9) + 0.9, 2.0, TALLEST)))
    if spread:
        _beside_time(axis, poses)
    else:
        _outlines(axis, poses, samples, shapes, (low[0], high[0]))
    axis.set_ylabel("z, m")
    moved = float(np.linalg.norm(poses.centre[-1] - poses.centre[0]))
    seen = (
        "height" if spread else f"way from the side at {len(samples)} instants, light to dark; the dot is fixed to it"
    )
    caption = f"The body's {seen}. Its centre of mass ends {moved:.5g} m from where it began."
    return picture("block-way", figure, "Way of the body over the ground", caption)


def _outlines(
    axis: Axes, poses: BlockPoses, samples: NDArray[np.int64], shapes: list[FloatArray], ends: tuple[float, float]
) -> None:
    room = 0.05 * (ends[1] - ends[0])
    axis.plot(*ground_line(poses, ends[0] - room, ends[1] + room), color=INK, linewidth=1.4)
    axis.plot(poses.centre[:, 0], poses.centre[:, 2], color=MUTED, linewidth=0.8, linestyle=(0, (3, 2)))
    for place, (sample, shape) in enumerate(zip(samples, shapes, strict=True)):
        part = (place + 1) / len(shapes)
        axis.plot(shape[:, 0], shape[:, 1], color=ACCENT, linewidth=1.0, alpha=0.25 + 0.75 * part)
        axis.plot(*mark(poses, int(sample)), "o", color=OTHER, markersize=2.6, alpha=0.25 + 0.75 * part)
    axis.set_aspect("equal")
    axis.xaxis.set_major_locator(MaxNLocator(5))
    axis.set_xlabel("x, m")


def _beside_time(axis: Axes, poses: BlockPoses) -> None:
    axis.plot(*envelope(poses.time, poses.centre[:, 2]), color=ACCENT)
    _x, heights = ground_line(poses, float(poses.centre[0, 0]), float(poses.centre[0, 0]) + 1e-9)
    axis.axhline(float(heights[0]), color=INK, linewidth=1.4)
    axis.set_xlabel("simulated time, s")


def motion(poses: BlockPoses) -> Picture:
    """Velocity of the centre of mass and spin over time."""
    rows = [(poses.velocity, "v", "velocity, m/s"), (poses.spin, "ω", "spin, rad/s")]
    # components that stay 0 are not drawn
    rows = [row for row in rows if np.any(row[0])] or rows[:1]
    figure, axes = new_figure(0.6 + 1.5 * len(rows), len(rows), sharex=True)
    for axis, (values, letter, label) in zip(axes, rows, strict=True):
        for column, name in enumerate("xyz"):
            if np.any(values[:, column]):
                axis.plot(
                    *envelope(poses.time, values[:, column]),
                    color=COLOURS[column],
                    linewidth=0.9,
                    label=f"{letter} {name}",
                )
        if axis.get_legend_handles_labels()[0]:
            axis.legend(loc="upper right", ncols=3)
        axis.set_ylabel(label)
    axes[-1].set_xlabel("simulated time, s")
    figure.align_ylabels(axes)
    speed = np.linalg.norm(poses.velocity, axis=1)
    caption = f"Largest speed {speed.max():.5g} m/s; at the end {speed[-1]:.3g} m/s and {np.abs(poses.spin[-1]).max():.3g} rad/s."
    return picture("block-motion", figure, "Velocity and spin of the body over time", caption)


def modes(points: PointSeries) -> Picture:
    """How many points of the body stick and slip."""
    figure, (axis,) = new_figure(2.0)
    sticking, slipping = points.sticking + points.touching, points.slipping
    axis.fill_between(points.time, sticking, step="post", color=ACCENT, linewidth=0.0, label="stick")
    axis.fill_between(points.time, sticking, sticking + slipping, step="post", color=OTHER, linewidth=0.0, label="slip")
    axis.set_ylim(0.0, max(1.0, float((sticking + slipping).max())) * 1.25)
    axis.yaxis.set_major_locator(MaxNLocator(integer=True))
    axis.set_ylabel("points in contact")
    axis.set_xlabel("simulated time, s")
    axis.set_facecolor("none")
    axis.grid(color=RULE)
    axis.legend(loc="upper left", ncols=2)
    caption = (
        "Points that stick and points that slip, each interval by what they did in it; none: the body is in the air. "
        f"In contact in {100.0 * np.mean(points.apart < points.points):.3g} % of the intervals, slipping in "
        f"{100.0 * np.mean(slipping > 0):.3g} %."
    )
    return picture("block-modes", figure, "Points in contact over time, sticking and slipping", caption)


def impulses(contact: ContactSeries) -> Picture:
    """Impulse of the ground on the body since the start, normal and along it."""
    figure, (axis,) = new_figure(2.4)
    for values, colour, label in (
        (contact.normal, ACCENT, "normal"), (contact.tangential, OTHER, "along the ground"),
    ):  # fmt: skip
        axis.plot(
            *envelope(contact.time + contact.sample_period, np.cumsum(values) * contact.sample_period),
            color=colour,
            label=label,
        )
    axis.legend(loc="upper left", ncols=2)
    axis.set_ylabel("impulse, N s")
    axis.set_xlabel("simulated time, s")
    total = float(contact.normal.sum()) * contact.sample_period
    caption = (
        f"Impulse since the start: a jump is an impact, a slope a force that lasts. Normal {total:.6g} N s in all."
    )
    return picture("block-impulse", figure, "Impulse of the ground on the body over time", caption)
