"""E' and tan(beta) from the impacts of a run, over temperature or speed, beside what the scene put
in.
"""

from __future__ import annotations

import numpy as np

from contact_sim_pkg.report.drawing import ACCENT, MUTED, Picture, new_figure, picture
from contact_sim_pkg.rigs.impact.material.estimate import EstimatedValue, MaterialEstimate
from contact_sim_pkg.rigs.impact.material.report import MaterialReport
from contact_sim_pkg.rigs.impact.report.series import ImpactSeries

SPEEDS = ("o", "s", "^", "D", "v", "P", "X")


def material_picture(impacts: ImpactSeries, report: MaterialReport | None) -> Picture | None:
    """Groups of repeats with their intervals; grey: what the law of each impact had."""
    if report is None:
        return None
    over_temperature = len({round(t, 6) for t in impacts.events.temperature}) > 1
    e = impacts.events
    truth = e.temperature if over_temperature else e.speed
    figure, (upper, lower) = new_figure(4.4, 2, sharex=True)
    upper.plot(truth, e.storage_modulus, linestyle="", marker="_", color=MUTED, markersize=9, label="put in")
    lower.plot(truth, e.loss_tangent, linestyle="", marker="_", color=MUTED, markersize=9)
    # Over temperature, one series for each impact speed.
    speeds = sorted({_round(each.speed) for each in report.estimates}) if over_temperature else []
    for number, speed in enumerate(speeds or [None]):
        chosen = [each for each in report.estimates if speed is None or _round(each.speed) == speed]
        places = [(each.temperature or 0.0) if over_temperature else each.speed for each in chosen]
        label = "from the impacts" if speed is None else f"at {speed:g} m/s"
        style = {
            "marker": SPEEDS[number % len(SPEEDS)],
            "label": label,
            "alpha": 1.0 - 0.6 * number / max(len(speeds), 1),
        }
        _points(upper, places, [each.storage_modulus for each in chosen], style)
        _points(lower, places, [each.loss_tangent for each in chosen], style)
    # A logarithmic scale only where the values spread.
    if e.storage_modulus.max() > 2.0 * e.storage_modulus.min():
        upper.set_yscale("log")
    else:
        upper.set_ylim(0.0, 1.25 * float(e.storage_modulus.max()))
    upper.set_ylabel("E′, Pa")
    lower.set_ylabel("tan β")
    lower.set_ylim(
        0.0, 1.12 * max(float(e.loss_tangent.max()), *(each.loss_tangent.value for each in report.estimates)) or 1.0
    )
    lower.set_xlabel("temperature, K" if over_temperature else "impact speed V₀, m/s")
    if not over_temperature and e.speed.max() > 3.0 * e.speed.min():
        lower.set_xscale("log")
    upper.legend(loc="best", ncols=2)
    figure.align_ylabels([upper, lower])
    return picture("impact-material", figure, "E′ and tan β from the impacts", _caption(report, over_temperature))


def _caption(report: MaterialReport, over_temperature: bool) -> str:
    groups = report.estimates
    text = (
        f"E′ and tan β as bench material reads them from the measured speed, contact time and restitution of "
        f"{len(report.rows)} impacts in {len(groups)} groups of repeats, with {report.options.confidence:.0%} intervals where a "
        "group has several. Grey: what the law of each impact had. "
    )
    moduli = [each.storage_modulus.value for each in groups]
    tangents = [each.loss_tangent.value for each in groups]
    text += f"E′ {min(moduli):.4g} to {max(moduli):.4g} Pa, tan β {min(tangents):.4g} to {max(tangents):.4g}"
    if over_temperature:
        softest: MaterialEstimate = max(groups, key=lambda each: each.loss_tangent.value)
        text += f", largest at {softest.temperature or 0.0:.4g} K and {softest.speed:.3g} m/s"
    notes = f" {'; '.join(report.impacts.notes)}." if report.impacts.notes else ""
    return f"{text}.{notes}"


def _points(axes, places: list[float], values: list[EstimatedValue], style: dict[str, object]) -> None:  # type: ignore[no-untyped-def]
    centre = np.array([value.value for value in values])
    low = np.array([value.value if value.low is None else value.low for value in values])
    high = np.array([value.value if value.high is None else value.high for value in values])
    axes.errorbar(
        places, centre, yerr=[centre - low, high - centre], linestyle="", color=ACCENT, markersize=4, capsize=2,
        linewidth=0.9, **style,
    )  # fmt: skip


def _round(speed: float) -> float:
    return float(f"{speed:.1g}")
