"""Whether a run shows the regime that its scene expects."""

from __future__ import annotations

import math

from contact_sim_pkg.records.metric import NO_BAND, OUTSIDE, Band, Metric, judged
from contact_sim_pkg.records.regime import Figure, Regime
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.report.metrics.views import value_text
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.signal.lift_off import lifted_intervals

__all__ = ["EXPECTED", "expected", "line_of", "longest_flight", "longest_flight_between"]

EXPECTED = "expected"
"""Kind of its band."""


def expected(recording: Recording) -> Metric | None:
    """The figure of the regime that the recorded scene expects, with its band; None where it expects none, or
    its rig has no such regime any more.
    """
    given = recording.scene.get("expect")
    rig = rigs().get(str(recording.scene.get("rig")))
    named = given.get("regime") if isinstance(given, dict) else None
    regime = next((each for each in rig.regimes if each.name == named), None) if rig is not None else None
    if regime is None or not isinstance(given, dict):
        return None
    figure: Figure = load(regime.measure)(recording)
    band = band_of(regime, given.get("at_least"), given.get("at_most"))
    # without a value there is no verdict of a band: the regime is missed all the same
    verdict = judged(figure.value, band)
    return Metric(
        f"expect.{regime.name}", regime.help, figure.value, regime.unit,
        OUTSIDE if verdict == NO_BAND else verdict, band, remark=figure.remark, window=(0.0, recording.duration),
    )  # fmt: skip


def band_of(regime: Regime, at_least: float | None, at_most: float | None) -> Band:
    """Band of a regime with the ends that a scene gives, in the regime's unit; its own where the scene gives none."""
    if at_least is None and at_most is None:
        return Band(regime.at_least, regime.at_most, EXPECTED, "regime")
    low, high = (-math.inf if at_least is None else at_least), (math.inf if at_most is None else at_most)
    return Band(low, high, EXPECTED, "scene")


def line_of(metric: Metric) -> str:
    """`jams: met, 0.00014 (at most 0.01); REMARK`."""
    regime = metric.key.partition(".")[2]
    verdict = "MISSED" if metric.verdict == OUTSIDE else "met"
    band = "" if metric.band is None else f" ({metric.band.text})"
    remark = f"; {metric.remark}" if metric.remark else ""
    return f"{regime}: {verdict}, {metric.name} {value_text(metric)}{band}{remark}"


def longest_flight(recording: Recording) -> Figure:
    """Longest time [s] that a contact carries no load; 0 where all carry one all along."""
    return _longest(recording, between=False)


def longest_flight_between(recording: Recording) -> Figure:
    """Longest time [s] that a contact carries no load, between two loads: what has never touched or never comes back
    is left out.
    """
    return _longest(recording, between=True)


def _longest(recording: Recording, *, between: bool) -> Figure:
    found = [
        (float(end - start), name, float(start))
        for name, contact in recording.contacts.items()
        for start, end in lifted_intervals(contact)
        if not between or (start > contact.time[0] and end <= contact.time[-1])
    ]
    if not recording.contacts:
        return Figure(math.nan, "no contact was recorded")
    length, name, start = max(found, default=(0.0, "", 0.0))
    return Figure(length, f"{name}, from {start:.4g} s" if name else "every contact carries a load all along")
