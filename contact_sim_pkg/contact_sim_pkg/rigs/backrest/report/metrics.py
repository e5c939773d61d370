"""Metrics of a back against its seat back: its slaps, its friction, how it is carried."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from contact_sim_pkg.records.metric import EVENT, USUAL_RANGE, Band, Metric
from contact_sim_pkg.report.metrics.maker import Maker, at_most, near
from contact_sim_pkg.report.series import ContactSeries, FieldSeries, Recording
from contact_sim_pkg.report.signal.confidence import half_interval
from contact_sim_pkg.report.signal.episodes import durations, slaps_of
from contact_sim_pkg.report.signal.loops import area_ratio, steady_start
from contact_sim_pkg.rigs.backrest.report.numbers import BACKREST, back_load, drive_period

WHOLE_CYCLES = 4


def backrest_metrics(recording: Recording) -> list[Metric]:
    """The list of a backrest; none without one."""
    contact = recording.contacts.get(BACKREST)
    if contact is None:
        return []
    window = float(contact.time[0]), float(contact.time[-1]) + contact.sample_period
    make = Maker(BACKREST, f"{BACKREST}/force", window).make
    found = [*_slaps(make, recording, contact), *_load(make, recording, contact)]
    field = recording.fields.get(BACKREST)
    found += [*_friction(make, recording, contact), *(_map(make, recording, field) if field is not None else ())]
    return found


def _slaps(make: Any, recording: Recording, contact: ContactSeries) -> Iterator[Metric]:
    """Number, restitution, duration and force of the slaps."""
    slaps, ledger, period = slaps_of(recording.episodes), recording.ledger, drive_period(recording.scene)
    count, topic = slaps.start.size, "bench/episodes"
    yield make("slaps", "slaps", count, "", topic=topic, basis=EVENT)
    lifted = 100.0 * float((contact.normal <= 0.0).mean())
    yield make("lift_off", "time without load", lifted, "%", count=contact.normal.size)
    if not count:
        return
    if period is not None and count > 2:
        between = float(np.diff(slaps.start).mean())
        whole = max(1, round(between / period)) * period
        yield make("interval", "time from slap to slap", 1e3 * between, "ms", topic=topic, count=count - 1,
                   band=near(1e3 * whole, 0.02, "whole cycles of the drive"))  # fmt: skip
    yield make("restitution", "restitution e, mean", slaps.restitution.mean(), "", topic=topic, count=count, basis=EVENT,
               spread=half_interval(slaps.restitution), band=Band(0.0, 1.0, USUAL_RANGE, "no slap gains energy"),
               remark=f"{slaps.restitution.min():.3g} to {slaps.restitution.max():.3g}")  # fmt: skip
    lasted = 1e3 * durations(slaps)
    yield make("duration", "duration of a slap, mean", lasted.mean(), "ms", topic=topic, count=count, basis=EVENT,
               spread=half_interval(lasted), remark=f"{lasted.min():.4g} to {lasted.max():.4g}")  # fmt: skip
    lost = -float((slaps.compression_work + slaps.restitution_work).sum())
    band = None if ledger is None else at_most(float(ledger.dissipated[-1]), "dissipated in the run, bench/energy")
    yield make("loss", "energy lost in slaps", lost, "J", topic=topic, count=count, band=band, basis=EVENT)


def _load(make: Any, recording: Recording, contact: ContactSeries) -> Iterator[Metric]:
    """Mean load over whole cycles of the drive, which is the preload, and the largest one."""
    period, backrest = drive_period(recording.scene), recording.scene.get("backrest") or {}
    start = steady_start(recording.duration, period, WHOLE_CYCLES)
    steady = contact.normal[contact.time >= start - 0.5 * contact.sample_period]
    preload = backrest.get("preload") if period is not None else None
    band = None if not preload else near(float(preload), 0.02, "preload, mean over whole cycles")
    yield make("load", "load, mean", steady.mean(), "N", band=band, count=steady.size)
    deepest = int(contact.approach.argmax())
    law = _law(recording, float(contact.approach[deepest]))
    band = None if law is None else near(law, 0.05, "A δⁿ, where the approach turns")
    yield make(
        "load_deepest",
        "load at the largest approach",
        contact.normal[deepest],
        "N",
        band=band,
        count=steady.size,
        basis=EVENT,
    )


def _law(recording: Recording, approach: float) -> float | None:
    """Elastic force [N] at an ``approach`` [m]; None where more than the law of one point carries."""
    effects = (recording.scene.get("effects") or {}).get(BACKREST) or {}
    keys = effects.get("normal_elastic")
    if (
        not keys
        or "coefficient" not in keys
        or effects.get("shell_modes") is not None
        or effects.get("cushion") is not None
    ):
        return None
    return float(keys["coefficient"]) * max(approach, 0.0) ** float(keys["exponent"])


def _friction(make: Any, recording: Recording, contact: ContactSeries) -> Iterator[Metric]:
    """Friction over load, and its work."""
    keys = ((recording.scene.get("effects") or {}).get(BACKREST) or {}).get("friction")
    if not keys or not contact.tangential.any():
        return
    pressed = contact.normal > 0.01 * contact.normal.max()
    largest = float(np.abs(contact.tangential[pressed] / contact.normal[pressed]).max())
    coefficient = max(float(keys["coefficient_static"]), float(keys["coefficient_kinetic"]))
    yield make("friction", "friction over load, largest", largest, "", count=int(pressed.sum()), basis=EVENT,
               band=at_most(coefficient * (1.0 + 1e-3), f"Coulomb, µ {coefficient:g}"))  # fmt: skip
    points = recording.points
    if points is not None and points.points == 1 and points.time.size > 1:
        slipping = 100.0 * float(points.slipping.mean())
        yield make("slip", "time in which it slips", slipping, "%", topic=f"{BACKREST}/points", count=points.time.size)


def _map(make: Any, recording: Recording, field: FieldSeries) -> Iterator[Metric]:
    """Pressures and area of the map; where a cushion carries."""
    carries, topic = field.load > 0.0, f"{BACKREST}/patch"
    if not carries.any():
        return
    kept = "kept" if carries.all() else "opens"
    conditions: dict[str, float | str] = {"contact": kept, "load_N": float(field.load.mean())}
    make = make.__self__._replace(conditions=conditions).make
    count = int(carries.sum())
    yield make("mean_pressure", "mean pressure", 1e-3 * field.mean[carries].mean(), "kPa", quantity="back_mean_pressure",
               topic=topic, count=count)  # fmt: skip
    yield make("peak_pressure", "peak pressure", 1e-3 * float(field.peak.max()), "kPa", topic=topic, count=field.time.size,
               basis=EVENT, remark=f"at {field.highest_time:.3f} s")  # fmt: skip
    areas = area_ratio(field)
    if areas is not None:
        yield make(
            "area_ratio",
            "largest area over that at rest",
            areas.ratio.max(),
            "",
            topic=topic,
            count=field.time.size,
            basis=EVENT,
        )
    back = back_load(recording)
    if back is not None:
        yield make("lumbar", "load within 60 mm of the lumbar height", 100.0 * back.lumbar_share, "%", topic=topic,
                   remark=f"centre of pressure {1e3 * back.centre_height:.3g} mm above the lower edge")  # fmt: skip
