"""Radii and load of the roller's programme over time: the paper's figure 9."""

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
    """Load pressed on, and the radii of the contact where they change; None without a programme
    that changes anything.
    """
    programme = build_roller(ResolvedScene(scene)).programme
    if not programme.turns_bodies and float(np.ptp(programme.load)) == 0.0:
        return None
    times = np.linspace(0.0, roller.time[-1], POINTS)
    figure, axes = new_figure(3.4 if programme.turns_bodies else 1.9, 2 if programme.turns_bodies else 1, sharex=True)
    if programme.turns_bodies:
        for (name, colour), curvature in zip(RADII, programme.curvatures_over(times).T, strict=True):
            # A straight side has no radius.
            if (curvature > 0.0).all():
                axes[0].plot(times, 1e3 / curvature, color=colour, label=name)
        axes[0].legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4, fontsize=7.5)
        axes[0].set_ylabel("radius, mm")
    axes[-1].plot(times, programme.loads(times), color=ACCENT)
    axes[-1].set_ylabel("F_N, N")
    axes[-1].set_xlabel("simulated time, s")
    figure.align_ylabels(axes)
    names = ""
    if programme.turns_bodies:
        names = " In the paper's figures 9 to 14 the radius along y is R11, that along x R21. What stays straight is not drawn."
    caption = f"What the programme gives: {'radii of the contact and ' if names else ''}the load pressed on.{names}"
    return picture("roller-programme", figure, "Radii and load of the programme over time", caption)
