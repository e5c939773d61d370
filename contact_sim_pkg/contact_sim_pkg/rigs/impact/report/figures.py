"""Pictures of impacts in time: bounces, force over time, force over depth, front speeds, position
of the contact surface.
"""

from __future__ import annotations

import numpy as np
from scipy.integrate import trapezoid

from contact_sim_pkg.report.drawing import ACCENT, INK, MUTED, Margins, Picture, new_figure, picture
from contact_sim_pkg.report.series import FloatArray, MotionSeries
from contact_sim_pkg.report.signal.decimate import envelope
from contact_sim_pkg.rigs.impact.report.series import ImpactSeries

VISCOUS = "#e08a2e"
HEIGHT = "sphere_z"


def bounces(impacts: ImpactSeries, motion: MotionSeries | None) -> Picture:
    """Height of the sphere; speed, contact time and restitution of each impact."""
    e = impacts.events
    rows = (("V₀, m/s", e.speed), ("contact time, ms", e.duration * 1e3), ("restitution k", e.restitution))
    height = None if motion is None else motion.position.get(HEIGHT)
    figure, axes = new_figure(
        1.0 + 1.2 * (len(rows) + (height is not None)), len(rows) + (height is not None), sharex=True
    )
    if height is not None and motion is not None:
        axes[0].plot(*envelope(motion.time, height * 1e3), color=ACCENT, linewidth=0.9)
        axes[0].axhline(0.0, color=MUTED, linewidth=0.7)
        axes[0].set_ylabel("height, mm")
    # One point for each impact.
    for place, (label, values) in zip(axes[-len(rows) :], rows, strict=True):
        place.plot(e.start, values, linestyle="", marker="o", markersize=3.2, color=ACCENT, clip_on=False)
        place.set_ylabel(label)
        place.set_ylim(0.0, 1.12 * float(values.max()))
    axes[-1].set_xlabel("simulated time, s")
    axes[-1].set_xlim(left=0.0)
    figure.align_ylabels(axes)
    caption = (
        f"Height of the sphere's lowest point above the sample, and its {len(e.number)} impacts: speed {e.speed.min():.4g} to "
        f"{e.speed.max():.4g} m/s, contact {e.duration.min() * 1e3:.4g} to {e.duration.max() * 1e3:.4g} ms, restitution "
        f"{e.restitution.min():.4g} to {e.restitution.max():.4g}. Of a free impact restitution does not depend on speed; where it "
        "falls for slow ones, the weight acts during the contact, or the material is another at another speed."
    )
    return picture(
        "impact-bounces", figure, "Height of the sphere, speed, contact time and restitution of its impacts", caption
    )


def force_over_time(impacts: ImpactSeries) -> Picture | None:
    """Forces over the first impact, and the form of the total force of all kept ones: the paper's
    figs 4 and 5.
    """
    if not impacts.courses:
        return None
    course = impacts.courses[0]
    total = course.elastic_force + course.viscous_force
    figure, (left, right) = new_figure(3.1, 1, 2, Margins(top=0.52))
    time = course.time * 1e3
    amplitude = np.hypot(course.elastic_force, course.viscous_force)
    for values, colour, label, dash in (
        (total, INK, "F_c + F_b", "-"), (course.elastic_force, ACCENT, "elastic F_c", "-"),
        (course.viscous_force, VISCOUS, "viscous F_b", "-"), (amplitude, MUTED, "√(F_c² + F_b²)", "--"),
    ):  # fmt: skip
        left.plot(time, values, color=colour, label=label, linestyle=dash)
    left.axhline(0.0, color=MUTED, linewidth=0.7)
    left.set_xlabel("time from the touch, ms")
    left.set_ylabel("force, N")
    left.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)
    for number, each in enumerate(impacts.courses):
        force = each.elastic_force + each.viscous_force
        shade = 1.0 - 0.75 * number / max(len(impacts.courses), 1)
        right.plot(each.time / each.time[-1], force / max(float(force.max()), 1e-300), color=ACCENT, alpha=shade)
    right.set_xlabel("time over contact time")
    right.set_ylabel("force over its peak")
    right.set_ylim(bottom=min(0.0, right.get_ylim()[0]))
    e = impacts.events
    first = int(np.flatnonzero(e.number == course.number)[0])
    caption = (
        f"Left: impact {course.number} at {e.speed[first]:.4g} m/s: largest force {e.peak_force[first]:.5g} N after "
        f"{e.peak_time[first] * 1e3:.4g} ms, turning point after {e.compression_time[first] * 1e3:.4g} ms at "
        f"{e.depth[first] * 1e3:.4g} mm, contact {e.duration[first] * 1e3:.4g} ms. The viscous force leads and pulls back on the "
        "way out; with the end rule force the contact ends where the sum is 0. Dashed: amplitude of the complex force, no force at "
        f"an instant. Right: the form of the first {len(impacts.courses)} impacts, the first the darkest."
    )
    return picture("impact-force", figure, "Elastic, viscous and total force over an impact", caption)


def force_over_depth(impacts: ImpactSeries) -> Picture | None:
    """Loops of the first impacts; beside them the depth that the hereditary integral gives under
    the first one's force.
    """
    if not impacts.courses:
        return None
    figure, (axes,) = new_figure(2.9)
    for number, course in enumerate(impacts.courses):
        shade = 1.0 - 0.75 * number / max(len(impacts.courses), 1)
        total = course.elastic_force + course.viscous_force
        axes.plot(course.depth * 1e3, total, color=ACCENT, alpha=shade, label="impacts" if number == 0 else None)
    first, history = impacts.courses[0], impacts.history
    axes.plot(first.depth * 1e3, first.elastic_force, color=MUTED, linestyle="--", label="elastic part of the first")
    # The loop of the first impact is the work on the sample.
    lost = float(trapezoid(first.elastic_force + first.viscous_force, first.depth))
    caption = (
        f"Force over indentation of the first {len(impacts.courses)} impacts. The area of the first loop, {lost:.4g} J, is the "
        "work on the sample up to the loss of force; part of it is still stored then, and becomes heat without pushing. "
    )
    if history is not None and history.number == first.number:
        # The hereditary depth under the same force.
        force = np.interp(history.time, first.time, first.elastic_force + first.viscous_force)
        valid = history.valid == 1
        axes.plot(history.depth[valid] * 1e3, force[valid], color=VISCOUS, label=f"hereditary, {history.model}")
        axes.plot(history.depth[~valid] * 1e3, force[~valid], color=VISCOUS, linestyle=":")
        caption += (
            f"Orange: depth by the hereditary integral ({history.model.replace('_', '–')} with the impact's E′ and tan β) under "
            "the same force; dotted where the contact shrinks and the integral does not hold."
        )
    axes.set_xlabel("indentation, mm")
    axes.set_ylabel("force, N")
    axes.set_xlim(left=0.0)
    axes.legend(loc="upper left")
    return picture("impact-indentation", figure, "Force over indentation of the impacts", caption)


def front_over_time(impacts: ImpactSeries) -> Picture | None:
    """Speed of the contact's border and of the wave front in the first impact."""
    front = impacts.front
    if front is None:
        return None
    figure, (axes,) = new_figure(2.4)
    time = front.time * 1e3
    axes.plot(time, front.front_speed, color=ACCENT, label="wave front")
    axes.plot(time, front.border_speed, color=INK, label="border of the contact")
    # The front starts faster than the shear wave; t_s is the instant when it no longer is.
    axes.axhline(front.shear_speed, color=MUTED, linestyle="--", label="shear wave")
    axes.axvline(front.front_time * 1e3, color=VISCOUS, linewidth=0.9)
    axes.set_xlabel("time from the touch, ms")
    axes.set_ylabel("speed, m/s")
    axes.legend(loc="center right")
    caption = (
        f"Impact {front.number}: until t_s = {front.front_time * 1e6:.4g} µs (orange), at a depth of {front.front_depth * 1e6:.4g} "
        f"µm, the front is faster than the shear wave ({front.shear_speed:.4g} m/s) and its speed is held at that; by then the "
        f"viscous force has turned {front.front_heat:.3g} J into heat. Negative: the contact shrinks."
    )
    return picture("impact-front", figure, "Speed of the contact's border and of the wave front", caption)


def position_over_time(impacts: ImpactSeries) -> Picture | None:
    """Depth of the contact surface and volumes in the first impact."""
    position = impacts.position
    if position is None:
        return None
    figure, (left, right) = new_figure(2.6, 1, 2, Margins(top=0.48))
    time = position.time * 1e3
    left.plot(time, position.surface_depth * 1e3, color=ACCENT, label="contact surface h_x")
    course = next((each for each in impacts.courses if each.number == position.number), None)
    if course is not None:
        left.plot(course.time * 1e3, course.depth * 1e3, color=MUTED, linestyle="--", label="approach x")
    left.set_ylabel("depth, mm")
    left.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)
    columns: list[tuple[FloatArray, str, str]] = [
        (position.volume, ACCENT, "deformed V_x1"), (position.compression_volume, INK, "compressed V_c1"),
        (position.heating_volume, VISCOUS, "by heating ΔV_T"),
    ]  # fmt: skip
    for values, colour, label in columns:
        right.plot(time, values * 1e9, color=colour, label=label)
    right.set_ylabel("volume, mm³")
    right.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, handlelength=1.2, columnspacing=1.0)
    for place in (left, right):
        place.set_xlabel("time from the touch, ms")
    caption = (
        f"Impact {position.number}, variant {position.variant}: contact surface down to {position.surface_depth.max() * 1e3:.4g} "
        f"mm; compression takes up to {position.compression.max():.3g} of the depth."
    )
    return picture("impact-position", figure, "Depth of the contact surface and volumes over an impact", caption)
