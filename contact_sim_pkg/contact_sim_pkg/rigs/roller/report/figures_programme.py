"""Radii and loads of the roller's programme over time: the paper's figure 9."""

from __future__ import annotations

from typing import Any

import numpy as np

from contact_sim_pkg.report.drawing import ACCENT, INK, MUTED, Picture, new_figure, picture
from contact_sim_pkg.rigs.roller.model import build_roller
from contact_sim_pkg.rigs.roller.report.series import RollerSeries
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

OTHER = "#e08a2e"
POINTS = 2000
RADII = (
    ("roller along x", ACCENT), ("roller along y (rolling)", MUTED), ("shaft along y (rolling)", OTHER), ("shaft along x", INK),
)  # fmt: skip
"""Names and colours of the columns of `Curvatures`."""


def programme_over_time(roller: RollerSeries, scene: dict[str, Any]) -> Picture | None:
    """Load pressed on, that of the shaft and the radii of the contact where they change; None
    without a programme that changes anything.
    """
    programme = build_roller(ResolvedScene(scene)).programme
    bends = programme.bends_shaft
    if not programme.turns_bodies and not bends and float(np.ptp(programme.load)) == 0.0:
        return None
    times = np.linspace(0.0, roller.time[-1], POINTS)
    rows = 1 + bends + programme.turns_bodies
    figure, axes = new_figure(0.4 + 1.5 * rows, rows, sharex=True)
    if programme.turns_bodies:
        for (name, colour), curvature in zip(RADII, programme.curvatures_over(times).T, strict=True):
            # A straight side has no radius.
            if (curvature > 0.0).all():
                axes[0].plot(times, 1e3 / curvature, color=colour, label=name)
        axes[0].legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4)
        axes[0].set_ylabel("radius, mm")
    axes[rows - 1 - bends].plot(times, programme.loads(times), color=ACCENT)
    axes[rows - 1 - bends].set_ylabel("F_N, N")
    if bends:
        axes[-1].plot(times, [programme.bending_load_at(float(time), 0.0) for time in times], color=ACCENT)
        axes[-1].set_ylabel("Q, N")
    axes[-1].set_xlabel("simulated time, s")
    figure.align_ylabels(axes)
    names = ""
    if programme.turns_bodies:
        names = " In the paper's figures 9 to 14 the radius along y is R11, that along x R21. What stays straight is not drawn."
    radii, bent = "radii of the contact, " if names else "", ", Q, which bends the shaft" if bends else ""
    caption = f"What the programme gives: {radii}the load pressed on{bent}.{names}"
    return picture("roller-programme", figure, "Radii and loads of the programme over time", caption)
