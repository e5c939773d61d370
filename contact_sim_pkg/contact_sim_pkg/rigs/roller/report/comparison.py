"""Pressure of several rollers over each other."""

from __future__ import annotations

from contact_sim_pkg.compare.side_by_side import Curve
from contact_sim_pkg.report.comparison.figures import Run, legend, over_legend
from contact_sim_pkg.report.drawing import Picture, draw_series, picture
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.roller.report.series import roller_of


def roller_curves(recording: Recording) -> dict[str, Curve]:
    """`roller.pressure` over time, in [MPa]; none where the bag holds no state of the roller."""
    roller = roller_of(recording)
    return {} if roller is None else {"roller.pressure": Curve("s", roller.time, 1e-6 * roller.contact.peak_pressure)}


def roller_comparison(key: str, _contact: str, runs: list[Run]) -> list[Picture]:
    """p0 over time; none where a run has none."""
    curves = [roller_curves(run.recording).get("roller.pressure") for run in runs]
    figure, (axes,) = over_legend(3.0, 1)
    for run, curve in zip(runs, curves, strict=True):
        if curve is None:
            return []
        draw_series(axes, curve.x, curve.y, color=run.colour, label=run.label)
    axes.set_ylabel("p₀, MPa")
    axes.set_xlabel("simulated time, s")
    legend(figure, axes, "run")
    return [
        picture(
            f"{key}-pressure", figure, "Largest pressure over time in every run", "Largest pressure of the contact."
        )
    ]
