"""What a vibration does to a person: ISO 2631-1, ISO 2631-5, Directive 2002/44/EC."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

from contact_sim_pkg.records.metric import EVENT, Metric
from contact_sim_pkg.report.series import FloatArray
from contact_sim_pkg.report.signal import confidence
from contact_sim_pkg.report.signal import spine as spine_model
from contact_sim_pkg.report.signal.metrics import EXPOSURE_TIME, RideMetrics, daily_dose

__all__ = ["Exposed", "exposure_metrics", "hours_to_action"]

RATIO_OF_MTVV = 1.5
"""MTVV over a_w above which the running rms is to be read beside a_w (ISO 2631-1, 6.3.3)"""


COMFORT = ("Wk", "Wd", "Wc", "Wj", "Wb")
"""Weightings that the words of ISO 2631-1, annex C, are for."""
HEALTH = ("Wk", "Wd")
"""Weightings of Directive 2002/44/EC."""


SICKNESS = "Wf"
"""Weighting of motion sickness."""
ACTION, LIMIT = 0.5, 1.15
"""[m/s^2] of A(8), Directive 2002/44/EC"""
HOUR = 3600.0
"""[s] of exposure that the dose of motion sickness is of, whatever the length of the run"""
ESTIMATED = 1.4
"""of eVDV over a_w T^(1/4) (BS 6841, ISO 2631-1 annex B)"""


class Exposed(NamedTuple):
    """What an axis is to the person."""

    weighting: str = "Wk"
    factor: float = 1.0
    """of the axis, for health: 1.4 of x and y at the seat"""
    vertical: bool = True
    """at the seat, which ISO 2631-5 is for"""
    decides: bool = True
    """alone on A(8), no other axis being recorded"""
    unit: str = "m/s²"


VERTICAL = Exposed()


def exposure_metrics(
    make: Callable[..., Metric],
    metrics: RideMetrics,
    acceleration: FloatArray,
    rate: float,
    doubts: tuple[str, ...],
    axis: Exposed = VERTICAL,
    *,
    once: int | None = None,
) -> list[Metric]:
    """Of one axis.

    Args:
        make: of `Maker`.
        metrics: of the weighted signal.
        acceleration: [samples] in [m/s^2], not weighted.
        rate: [Hz].
        doubts: assumptions that do not hold for any of them.
        axis: what it is to the person.
        once: samples after which the excitation repeats itself, which say how sure a mean is; None: all.
    """  # fmt: skip
    count, duration = metrics.weighted.size, metrics.weighted.size / rate
    peaky = (*doubts, *confidence.peaky(metrics.crest_factor))
    spread = confidence.spread_of_rms(metrics.weighted[:once], rate)
    a_w, mtvv = metrics.weighted_rms, metrics.largest_running_rms
    comfort = "weighted_rms" if axis.weighting in COMFORT else ""
    found = [
        make(
            "a_w", f"a_w, {axis.weighting}", a_w, axis.unit, quantity=comfort, broken=peaky, spread=spread, count=count
        )
    ]
    if axis.decides:
        found.append(make("a_8", "A(8)", a_w, axis.unit, quantity="daily_exposure", broken=peaky, spread=spread, count=count,
                          remark=f"eight hours of this ride, z alone{_reached(a_w)}"))  # fmt: skip
    if axis.weighting in HEALTH:
        dose = axis.factor * daily_dose(metrics.vibration_dose, duration)
        said = f"{metrics.vibration_dose:.3g} in the run" + (f", times {axis.factor:g}" if axis.factor != 1.0 else "")
        found.append(
            make("dose", "VDV of 8 h", dose, "m/s^1.75", quantity="daily_dose", broken=doubts, count=count, remark=said)
        )
    found += [
        make(
            "mtvv",
            "MTVV, linear 1 s",
            mtvv,
            axis.unit,
            broken=doubts,
            count=count,
            basis=EVENT,
            remark=_beside(mtvv, a_w),
        ),
        make(
            "crest",
            "crest factor",
            metrics.crest_factor,
            "",
            quantity="crest_factor",
            broken=doubts,
            count=count,
            basis=EVENT,
        ),
    ]
    if axis.vertical:
        shocks = spine_model.dose(spine_model.spine_acceleration(acceleration, rate))
        stress = spine_model.stress(spine_model.daily(shocks, duration))
        said = f"S_d {stress:.3g} MPa; man of 82 kg, 240 days of 8 h a year from 20 to 64"
        found.append(make("spine_risk", "R, ISO 2631-5", spine_model.risk(stress), "", quantity="spine_risk", broken=doubts,
                          count=count, remark=said))  # fmt: skip
    return [*found, *_as_doses(make, a_w, spread, axis, (doubts, peaky), count)]


def _as_doses(
    make: Callable[..., Metric], a_w: float, spread: float, axis: Exposed, broken: tuple[tuple[str, ...], tuple[str, ...]],
    count: int,
) -> Iterator[Metric]:  # fmt: skip
    """What follows from ``a_w`` [m/s^2] and its ``spread`` alone: hours to the action value, eVDV, MSDV; ``broken``: of
    doses, and of what a crest factor above 9 breaks too.
    """
    if axis.decides and a_w > 0.0:
        yield hours_to_action(make, axis.factor * a_w, axis.factor * spread, broken[1], count)
    if axis.weighting in HEALTH:
        factor = ESTIMATED * axis.factor * EXPOSURE_TIME**0.25
        yield make("dose_estimated", "eVDV of 8 h", factor * a_w, "m/s^1.75", broken=broken[0], count=count,
                   spread=factor * spread, remark="1.4 a_w T^(1/4), for crest factors below 6")  # fmt: skip
    if axis.weighting == SICKNESS:
        factor = math.sqrt(HOUR)
        yield make("sickness", "MSDV of an hour", factor * a_w, "m/s^1.5", broken=broken[0], count=count,
                   spread=factor * spread,
                   remark=f"{factor * a_w / 3.0:.3g} % of adults may vomit (ISO 2631-1, annex D)")  # fmt: skip


def _hours(limit: float, a_w: float) -> float:
    """Time [h] after which ``a_w`` is an A(8) of ``limit``, both in [m/s^2]: 8 h (limit / a_w)^2."""
    return 8.0 * (limit / a_w) ** 2


def _reached(a_w: float) -> str:
    return f"; action value after {_hours(ACTION, a_w):.3g} h" if a_w > 0.0 else ""


def hours_to_action(
    make: Callable[..., Metric], a_w: float, spread: float, broken: tuple[str, ...], count: int
) -> Metric:
    """Time [h] of a vibration ``a_w`` [m/s^2], its factor included, after which A(8) is the action value."""
    hours = _hours(ACTION, a_w)
    return make("hours_to_action", "time to the action value", hours, "h", broken=broken, count=count,
                spread=2.0 * hours * spread / a_w, remark=f"limit value after {_hours(LIMIT, a_w):.3g} h")  # fmt: skip


def _beside(mtvv: float, a_w: float) -> str:
    """Whether the running rms is to be read beside a_w [m/s^2]."""
    ratio = mtvv / a_w if a_w > 0.0 else math.nan
    said = f"{ratio:.3g} a_w"
    return f"{said}: above {RATIO_OF_MTVV:g} read it beside a_w (ISO 2631-1, 6.3.3)" if ratio > RATIO_OF_MTVV else said
