"""Metrics of a roller on its shaft: pressure and ellipse beside Hertz, dangerous volume, stability, track."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from contact_sim_pkg.records.metric import EVENT, STATE, STATIONARY, Metric
from contact_sim_pkg.report.metrics.maker import Maker, at_most, near
from contact_sim_pkg.report.ranges import FIRST_YIELD
from contact_sim_pkg.report.rows import number
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.roller.report.series import RollerSeries, roller_of
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

ROLLER = "roller"


def roller_metrics(recording: Recording) -> list[Metric]:
    """The list of a roller; none where the bag holds no state of it."""
    roller = roller_of(recording)
    if roller is None:
        return []
    make = Maker(ROLLER, f"{ROLLER}/contact", (0.0, recording.duration), basis=STATE).make
    return [
        *_contact(make, roller, recording.scene),
        *_volumes(make, roller),
        *_stability(make, roller),
        *_track(make, roller),
    ]


def _contact(make: Any, roller: RollerSeries, scene: dict[str, Any]) -> Iterator[Metric]:
    """Pressure, ellipse and approach under the largest pressure, beside the closed form of Hertz."""
    contact, count = roller.contact, roller.time.size
    place = int(contact.peak_pressure.argmax())
    pressure, load = float(contact.peak_pressure[place]), float(contact.load[place])
    semi = float(contact.along_x[place]), float(contact.along_y[place])
    if load <= 0.0:
        yield make("pressure", "p₀, largest", 0.0, "MPa", broken=("no load in the run",), count=count)
        return
    mean = 1.5e-6 * load / (math.pi * semi[0] * semi[1])
    yield make("pressure", "p₀, largest", 1e-6 * pressure, "MPa", count=count,
               band=near(mean, 1e-3, "3 F / (2 π a b)"),
               remark=f"from {1e-6 * contact.peak_pressure.min():.4g}, largest at {roller.time[place]:.3g} s")  # fmt: skip
    strength = (scene.get(ROLLER) or {}).get("yield_strength")
    if strength:
        yield make(
            "yield_share", "p₀ over first yield", pressure / (FIRST_YIELD * float(strength)), "", quantity="yield_share"
        )
    names = ("semi-axis along the shaft", "semi-axis along rolling")
    expected = _hertz(scene, roller, place)
    for key, name, value, closed in zip(("along_x", "along_y"), names, semi, expected[:2], strict=True):
        band = None if closed is None else near(1e6 * closed, 0.02, "Hertz, radii of the scene")
        yield make(key, name, 1e6 * value, "µm", band=band, count=count)
    band = None if expected[2] is None else near(1e6 * expected[2], 0.02, "Hertz, radii of the scene")
    yield make("approach", "approach", 1e6 * float(contact.approach[place]), "µm", band=band, count=count)
    yield make("load", "load, mean", contact.load.mean(), "N", count=count, basis=STATIONARY,
               remark=f"{contact.load.min():.4g} to {contact.load.max():.4g}")  # fmt: skip
    tilt = max(float(np.abs(contact.tilt).max()), float(np.abs(contact.yaw).max()))
    yield make("tilt", "tilt or yaw, largest", 1e3 * tilt, "mrad", count=count, basis=EVENT)


def _hertz(scene: dict[str, Any], roller: RollerSeries, place: int) -> tuple[float | None, float | None, float | None]:
    """Semi-axes along x and y and approach [m] of Hertz's contact of the scene's radii at an instant; None where
    tilt or track change them."""
    from contact_sim_pkg.pressure.closed_form.hertz import HertzError, hertz_contact
    from contact_sim_pkg.rigs.roller.model import build_roller

    nothing = None, None, None
    if roller.tracks or abs(roller.contact.tilt[place]) + abs(roller.contact.yaw[place]) > 1e-6:
        return nothing
    model = build_roller(ResolvedScene(scene))
    gap = model.programme.curvatures_at(float(roller.time[place]))
    along_x, along_y = gap.roller_axial + gap.shaft_axial, gap.roller_rolling + gap.shaft_rolling
    try:
        found = hertz_contact(0.5 * along_x, 0.5 * along_y, model.modulus, float(roller.contact.load[place]))
    except HertzError:
        return nothing
    a, b = (found.a, found.b) if along_x <= along_y else (found.b, found.a)
    return a, b, found.approach


def _volumes(make: Any, roller: RollerSeries) -> Iterator[Metric]:
    """The largest dangerous volume of any stress."""
    if not roller.volumes:
        return
    volumes = roller.dangerous_volumes()
    place = int(np.argmax(volumes))
    share = 100.0 * volumes[place] / roller.volumes[place].working_volume
    yield make("volume", "dangerous volume, largest", 1e9 * volumes[place], "mm³", topic=f"{ROLLER}/volumes",
               count=len(volumes), basis=EVENT,
               remark=f"{number(share)} % of the working volume, at {roller.volumes[place].time:.3g} s")  # fmt: skip
    limit = roller.volumes[place].normal_limit
    depth = roller.volumes[place]
    if depth.peak_pressure > limit:
        reach = math.sqrt((depth.peak_pressure / limit) ** 2 - 1.0) * min(depth.along_x, depth.along_y)
        yield make("depth", "depth with σ_zz above its limit, at most", 1e6 * reach, "µm", topic=f"{ROLLER}/volumes",
                   remark="line contact: b √((p₀/σ)² − 1)")  # fmt: skip


def _stability(make: Any, roller: RollerSeries) -> Iterator[Metric]:
    """Growth of tilt and yaw, and the load beyond which they grow."""
    if not roller.stability:
        return
    worst = max(roller.stability, key=lambda each: each.growth_rate)
    yield make("growth", "growth rate of tilt and yaw", worst.growth_rate, "1/s", quantity="growth_rate",
               topic=f"{ROLLER}/stability", count=len(roller.stability),
               remark=f"at {worst.frequency:.4g} Hz, {worst.load:.4g} N")  # fmt: skip
    if math.isfinite(worst.critical_load):
        yield make("critical_load", "smallest load with growth", worst.critical_load, "N", topic=f"{ROLLER}/stability")


def _track(make: Any, roller: RollerSeries) -> Iterator[Metric]:
    """Cycles, waves and wear of the track, and the error of the time acceleration."""
    if not roller.tracks:
        return
    last, topic = roller.tracks[-1], f"{ROLLER}/track"
    yield make("cycles", "cycles", last.cycles, "", topic=topic)
    yield make("range", "height of the waves", 1e6 * last.range, "µm", topic=topic, remark=last.body)
    yield make("lowered", "mean wear", 1e6 * last.lowered, "µm", topic=topic,
               band=at_most(0.05e6 * last.radius, "0.05 of the radius, which stays that of the scene"))  # fmt: skip
    errors = [each.check_error for each in roller.tracks if each.checked > 0.0 and math.isfinite(each.check_error)]
    if errors:
        yield make("acceleration_error", "error of the time acceleration", max(errors), "", quantity="acceleration_error",
                   topic=topic, count=len(errors))  # fmt: skip
