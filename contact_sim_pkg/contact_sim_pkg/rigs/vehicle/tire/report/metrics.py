"""Metrics of a rolling tire: how its load varies, how it stands, what it passes on along the road."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from contact_sim_pkg.excitation.kinds import Obstacle, RoadKind, kind_known
from contact_sim_pkg.records.messages import TireStanding
from contact_sim_pkg.records.metric import EVENT, STATE, Metric
from contact_sim_pkg.report.metrics.maker import Maker, at_most, conditions_of, near
from contact_sim_pkg.report.metrics.numerical import Errors, errors_of, not_resolved
from contact_sim_pkg.report.series import ContactSeries, FieldSeries, FloatArray, Recording
from contact_sim_pkg.report.signal.confidence import spread_of_mean, spread_of_rms
from contact_sim_pkg.report.signal.roughness import roughness_index
from contact_sim_pkg.rigs.vehicle.tire.report.axle_series import AxleSeries, axle_of
from contact_sim_pkg.rigs.vehicle.tire.report.numbers import TIRE, standing_load_of
from contact_sim_pkg.rigs.vehicle.tire.report.road_series import road_of
from contact_sim_pkg.rigs.vehicle.tire.report.shear_series import shear_of
from contact_sim_pkg.rigs.vehicle.tire.report.standing_series import standing_of
from contact_sim_pkg.rigs.vehicle.tire.report.travel import wheel_travel
from contact_sim_pkg.rigs.vehicle.tire.report.work_series import LOST, work_of
from contact_sim_pkg.rigs.vehicle.travel_report import travel_metrics

SHORTEST = 8.0
"""[s] of a ride over an uneven road that says something of its load: ten periods of the body at 1.2 Hz"""
LOWEST_RINGING = 15.0
"""[Hz] below which the axle's force follows body and wheel"""
RINGING_TIME = 0.3
"""[s] behind the largest force along the road in which the belt rings"""
LARGE_SLIP = 0.05
"""from which on the bristles slide enough for their cells to leave 1 % of what they lose open"""
NAMED = 1e-3
"""Share of what is lost from which on a part of it is named"""
HOP_BAND = (5.0, 20.0)
"""[Hz] in which the wheel hops on the tire"""


class _Ride(NamedTuple):
    """What the list is made from."""

    recording: Recording
    contact: ContactSeries
    standing: float | None
    """[N]"""
    make: Any
    rough: bool
    """whether the road is uneven all along, so that a mean needs time"""
    event: bool
    """whether the road is even but for one obstacle, so that what varies is over when it is passed"""
    slips: bool
    """whether it brakes, drives, is steered or runs on a machine: the manoeuvre is what the run is for, however short"""
    errors: Errors
    """numerical ones of the run"""
    conditions: dict[str, float | str]
    """what the run is"""


def tire_metrics(recording: Recording) -> list[Metric]:
    """The list of a tire; none without one."""
    contact = recording.contacts.get(TIRE)
    if contact is None:
        return []
    window = float(contact.time[0]), float(contact.time[-1]) + contact.sample_period
    standing, conditions = standing_load_of(recording.scene), _conditions(recording)
    ride = _Ride(
        recording, contact, standing, Maker(TIRE, f"{TIRE}/force", window, conditions).make,
        str(conditions.get("road", "")).startswith("class"), one_obstacle(recording.scene) is not None,
        float(conditions["largest_slip"]) >= LARGE_SLIP or _mount_of(recording.scene) is not None, errors_of(recording), conditions,
    )  # fmt: skip
    field = recording.fields.get(TIRE)
    stands = standing_of(recording)
    upright = _load(ride) if stands is None else (*_load(ride), *_standing(ride, stands))
    if field is not None and standing is not None:
        upright = *upright, *_pressures(ride, field)
    upright = *upright, *travel_metrics(wheel_travel(recording))
    along = [*_along(ride), *_work(ride), *_lean(ride, field)]
    # Of a tire that slips, first what it slips for
    return [*along, *upright] if ride.slips else [*upright, *along]


def largest_forces(recording: Recording) -> list[Metric]:
    """Largest force of the road on the tire, and of the tire on its axle along the road, either way [N]."""
    contact, axle = recording.contacts.get(TIRE), axle_of(recording)
    if contact is None:
        return []
    window = float(contact.time[0]), float(contact.time[-1]) + contact.sample_period
    make, errors, largest = Maker(TIRE, f"{TIRE}/force", window).make, errors_of(recording), float(contact.normal.max())
    found = [make("fz_largest", "F_z of the tire, largest", largest, "N", count=contact.normal.size, basis=EVENT,
                  error=errors.largest(TIRE, "force") * largest,
                  remark=f"at {contact.time[contact.normal.argmax()]:.3f} s")]  # fmt: skip
    if axle is not None:
        along = np.abs(axle.longitudinal)
        found.append(make("fx_largest", "F_x of the tire, largest", along.max(), "N", topic=f"{TIRE}/axle", count=along.size,
                          basis=EVENT, error=errors.largest(TIRE, "force") * largest,
                          remark=f"at {axle.time[along.argmax()]:.3f} s"))  # fmt: skip
    return found


def one_obstacle(scene: Mapping[str, Any]) -> Obstacle | None:
    """The obstacle of a road that is even but for that; None of another road."""
    road = scene.get("road")
    known: RoadKind | None = kind_known("road", road) if isinstance(road, Mapping) else None
    obstacle = None if known is None else known.obstacle()
    return obstacle if obstacle is not None and obstacle.period is None else None


def _mount_of(scene: Mapping[str, Any]) -> Mapping[str, Any] | None:
    """Of the axle on a test machine; None on a quarter car."""
    mount = (scene.get(TIRE) or {}).get("mount")
    return mount if isinstance(mount, Mapping) and mount.get("kind") != "quarter_car" else None


def _conditions(recording: Recording) -> dict[str, float | str]:
    """Standing load [kN], inflation [kPa], mean speed [m/s], road, belt, largest slip."""
    found = conditions_of(recording.scene)
    effects = (recording.scene.get("effects") or {}).get(TIRE) or {}
    standing, road, shear = standing_load_of(recording.scene), road_of(recording), shear_of(recording)
    if standing is not None:
        found["load_kN"] = 1e-3 * standing
    if effects.get("inflation"):
        found["inflation_kPa"] = 1e-3 * float(effects["inflation"]["pressure"])
    found["belt"] = "yes" if effects.get("sidewall_compliance") is not None else "no"
    if road is not None and recording.duration > 0.0:
        found["speed_m_s"] = float(road.travel.distance[-1] - road.travel.distance[0]) / recording.duration
    mount = _mount_of(recording.scene)
    if mount is not None and mount.get("kind") == "drum":
        found["road"] = f"drum of {2.0 * float(mount['radius']):g} m"
    found["largest_slip"] = 0.0
    if shear is not None:
        found["largest_slip"] = float(np.hypot(shear.slip, np.tan(shear.slip_angle)).max())
    return found


def _load(ride: _Ride) -> Iterator[Metric]:
    """Of an obstacle, and of a tire that brakes or is steered, the largest and the smallest load and how long the tire is
    off the road; of any other ride the load's variation and mean over the run, and the share of it off the road.
    """
    normal, rate, count = ride.contact.normal, 1.0 / ride.contact.sample_period, ride.contact.normal.size
    # The asperities carry a share of the weight beside the contact.
    carried = normal + ride.contact.impulses if ride.contact.impulses.size else normal
    if ride.event or ride.slips:
        yield from _load_of_event(ride, carried)
        return
    broken = _short(ride)
    lifted = 100.0 * float((normal <= 0.0).mean())
    lifts = int(np.count_nonzero((normal[1:] <= 0.0) & (normal[:-1] > 0.0)))
    largest, swing = float(normal.max()), float(carried.std())
    if ride.standing is not None:
        spread = spread_of_rms(carried - carried.mean(), rate) / ride.standing
        yield ride.make("dlc", "dynamic load coefficient", swing / ride.standing, "", quantity="dynamic_load",
                        broken=broken, count=count, spread=spread,
                        error=ride.errors.of_mean(TIRE, "force", swing, largest) / ride.standing)  # fmt: skip
    yield ride.make("lift_off", "time off the road", lifted, "%", quantity="lift_off", broken=broken, count=count,
                    spread=spread_of_mean(np.where(normal <= 0.0, 100.0, 0.0), rate), error=100.0 * lifts / count,
                    remark=f"{lifts} times")  # fmt: skip
    band = None if ride.standing is None else near(ride.standing, 0.05, "weight, mean over the run")
    yield ride.make("load", "load, mean", carried.mean(), "N", band=band, broken=broken, count=count,
                    spread=spread_of_mean(carried, rate),
                    error=ride.errors.of_mean(TIRE, "force", float(carried.mean()), largest),
                    remark=f"{carried.min():.4g} to {carried.max():.4g} N")  # fmt: skip


def _load_of_event(ride: _Ride, carried: FloatArray) -> Iterator[Metric]:
    """What an obstacle does to the load, however long the run goes on behind it."""
    times, count, normal, broken = (
        ride.contact.time,
        carried.size,
        ride.contact.normal,
        _before_obstacle(ride.recording),
    )
    error = ride.errors.largest(TIRE, "force") * float(normal.max())
    for key, name, place in (
        ("load_largest", "load, largest", int(carried.argmax())),
        ("load_smallest", "load, smallest", int(carried.argmin())),
    ):
        share = "" if ride.standing is None else f"{carried[place] / ride.standing:.3g} of the standing load, "
        yield ride.make(key, name, carried[place], "N", count=count, basis=EVENT, error=error, broken=broken,
                        remark=f"{share}at {times[place]:.3f} s")  # fmt: skip
    sample = 1e3 * ride.contact.sample_period
    lifts = int(np.count_nonzero((normal[1:] <= 0.0) & (normal[:-1] > 0.0)))
    yield ride.make("off_the_road", "time off the road", sample * float(np.count_nonzero(normal <= 0.0)), "ms", count=count,
                    basis=EVENT, error=sample * max(1, lifts), broken=broken)  # fmt: skip


def _before_obstacle(recording: Recording) -> tuple[str, ...]:
    """That the run ends before its obstacle is passed; empty where it does not, or nobody knows."""
    obstacle, road = one_obstacle(recording.scene), road_of(recording)
    if obstacle is None or road is None:
        return ()
    last, reached = obstacle.position + 0.5 * obstacle.length, float(road.travel.distance.max())
    return (f"too short: ends at {reached:.3g} m, its obstacle at {last:.3g} m",) if reached < last else ()


def _short(ride: _Ride) -> tuple[str, ...]:
    """That the ride is too short for its road; empty where it is not."""
    duration = ride.contact.normal.size * ride.contact.sample_period
    rough = ride.rough and not ride.slips
    return (f"too short: {duration:.3g} s, {SHORTEST:g} s needed",) if rough and duration < SHORTEST else ()


def _standing(ride: _Ride, stands: TireStanding) -> Iterator[Metric]:
    """The tire under its standing load as the model has it, the same in every run; the frequency at which the wheel
    hops on its stiffness.
    """
    values = (
        ("stiffness", "vertical stiffness", 1e-3 * stands.stiffness, "kN/m", "of the whole tire"),
        ("length", "footprint length", 1e3 * stands.length, "mm", ""),
        ("width", "footprint width", 1e3 * stands.width, "mm", ""),
        ("area", "footprint area", 1e4 * stands.area, "cm²", ""),
        ("mean_pressure", "mean pressure", 1e-3 * stands.mean_pressure, "kPa", ""),
    )
    for key, name, value, unit, of in values:
        quantity = (
            "" if str(ride.conditions.get("road", "")).startswith("drum") else f"tire_{key}"
        )  # published on a plate
        remark = ", ".join(filter(None, (of, f"static, under {1e-3 * stands.load:.3g} kN")))
        yield ride.make(key, name, value, unit, quantity=quantity, topic=f"{TIRE}/standing", basis=STATE,
                        remark=remark)  # fmt: skip
        if key == "stiffness":
            yield from _hop(ride, stands.stiffness)


def _hop(ride: _Ride, stiffness: float) -> Iterator[Metric]:
    """The frequency at which the wheel hops on an uneven road, beside that on the ``stiffness`` [N/m] of its tire."""
    tire, motion = ride.recording.scene["tire"], ride.recording.motion
    wheel = None if motion is None else motion.acceleration.get("wheel_z")
    if motion is None or wheel is None or not ride.rough or "body_z" not in motion.acceleration:
        return
    masses = np.array([float(tire["wheel_mass"]), float(tire["body_mass"])])
    spring = float(tire["suspension_stiffness"])
    modes = np.linalg.eigvals(np.array([[stiffness + spring, -spring], [-spring, spring]]) / masses[:, None])
    expected = math.sqrt(float(modes.real.max())) / (2.0 * math.pi)
    found = _highest_line(wheel, 1.0 / motion.sample_period, *HOP_BAND)
    yield ride.make("hop", "frequency of wheel hop", found, "Hz", topic="bench/motion", count=wheel.size, broken=_short(ride),
                    error=0.5 / (wheel.size * motion.sample_period),
                    band=near(expected, 0.15, "wheel on tire and suspension, no damping"))  # fmt: skip


def _pressures(ride: _Ride, field: FieldSeries) -> Iterator[Metric]:
    """The largest pressure of the run, and that over a patch."""
    topic, of_peak = f"{TIRE}/patch", ride.errors.largest(TIRE, "peak")
    yield ride.make("peak_pressure", "peak pressure", 1e-3 * float(field.peak.max()), "kPa", quantity="tire_peak_pressure",
                    topic=topic, count=field.time.size, basis=EVENT, error=1e-3 * of_peak * float(field.peak.max()),
                    remark=f"at {field.highest_time:.3f} s")  # fmt: skip
    place = int(field.block_peak.argmax())
    yield ride.make("patch_pressure", "peak over 20 by 20 mm", 1e-3 * float(field.block_peak[place]), "kPa", topic=topic,
                    count=field.time.size, basis=EVENT,
                    remark=f"squares of a tread block, at {field.time[place]:.3f} s")  # fmt: skip


def _along(ride: _Ride) -> Iterator[Metric]:
    """Rolling resistance, friction and what rings behind an obstacle."""
    axle, shear = axle_of(ride.recording), shear_of(ride.recording)
    topic = f"{TIRE}/axle"
    # A machine that stands, or steers and brakes by a programme, measures no resistance
    slips = float(ride.conditions["largest_slip"]) >= LARGE_SLIP and _mount_of(ride.recording.scene) is not None
    rolls = ride.conditions.get("speed_m_s") != 0.0 and not slips
    if axle is not None and rolls and not ride.event:  # a mean over the run, which an obstacle is a part of
        load = float(ride.contact.normal.mean())
        resistance = -float(axle.longitudinal.mean()) / load if load > 0.0 else math.nan
        error = (
            ride.errors.of_column_mean(f"{topic}.longitudinal", axle.longitudinal) / load if load > 0.0 else math.nan
        )
        yield ride.make("resistance", "force along over load", resistance, "", quantity="tire_rolling_resistance", topic=topic,
                        count=axle.time.size, error=error, broken=not_resolved(resistance, error),
                        remark=f"{axle.longitudinal.min():.4g} to {axle.longitudinal.max():.4g} N")  # fmt: skip
    road = road_of(ride.recording)
    index = math.nan if road is None or ride.event else roughness_index(road.distance, road.middle)
    if road is not None and index > 0.0:
        yield ride.make("roughness", "IRI of the road", index, "m/km", topic="road/patch", count=road.distance.size, basis=STATE,
                        remark=f"{road.distance[-1] - road.distance[0]:.4g} m in the middle of the track")  # fmt: skip
    if shear is not None:
        pressed = np.interp(shear.time, ride.contact.time, ride.contact.normal)
        ratio = np.hypot(shear.force_x, shear.force_y) / np.maximum(pressed, 1.0)
        place = int(ratio.argmax())
        slip = math.hypot(shear.slip[place], math.tan(shear.slip_angle[place]))
        yield ride.make("friction", "largest friction over load", ratio[place], "", quantity="tire_friction", topic=f"{TIRE}/shear",
                        count=shear.time.size, basis=EVENT, remark=f"at a slip of {slip:.3g}")  # fmt: skip
    by_formula = ((ride.recording.scene.get("effects") or {}).get(TIRE) or {}).get("magic_formula") is not None
    ringing = None if axle is None or ride.rough or by_formula else ringing_of(axle)  # that has no belt
    if ringing is not None:
        yield ride.make("ringing", "force along rings at", ringing, "Hz", quantity="tire_ringing", topic=topic, basis=EVENT,
                        error=0.5 / RINGING_TIME)  # fmt: skip


def _lean(ride: _Ride, field: FieldSeries | None) -> Iterator[Metric]:
    """How far before the axle the centre of pressure of a tread with memory lies, and its moment, the rolling resistance:
    means of the run.
    """
    effects = (ride.recording.scene.get("effects") or {}).get(TIRE) or {}
    if field is None or ride.event or ride.rough or not effects.get("tread_viscoelasticity") or not field.load.any():
        return
    moment, load = float((field.load * field.centre_x).mean()), float(field.load.mean())
    topic, count = f"{TIRE}/patch", field.time.size
    yield ride.make("shift", "pressure's centre before the axle", 1e3 * moment / load, "mm", topic=topic, count=count)
    yield ride.make("rolling_moment", "moment of rolling resistance", moment, "N m", topic=topic, count=count)


def _work(ride: _Ride) -> Iterator[Metric]:
    """What belt, rim and bristles lose, part by part; what the bristles' cells leave open of it."""
    work = work_of(ride.recording)
    if work is None or work.lost <= 0.0:
        return
    topic, count, lost = f"{TIRE}/work", work.time.size, work.lost
    shares = ", ".join(
        f"{name} {100.0 * work.parts[name][-1] / lost:.3g} %" for name in LOST if work.parts[name][-1] > NAMED * lost
    )
    yield ride.make(
        "lost", "energy lost in the plane of the road", lost, "J", topic=topic, count=count, basis=EVENT, remark=shares
    )
    slip = float(ride.conditions["largest_slip"])
    open_ = 100.0 * abs(float(work.parts["sampling"][-1])) / lost
    yield ride.make("sampling", "sampling of the shear", open_, "%", topic=topic, count=count,
                    band=at_most(1.0 if slip >= LARGE_SLIP else 10.0, "cells of the bristles, of what is lost"),
                    remark="what the bristles' force takes beside their own work")  # fmt: skip


def ringing_of(axle: AxleSeries) -> float | None:
    """Highest line [Hz] of the force along behind its largest value; None where the record ends before."""
    start = int(np.abs(axle.longitudinal).argmax())
    behind = axle.longitudinal[start : start + round(RINGING_TIME / axle.sample_period)]
    if behind.size < round(0.5 * RINGING_TIME / axle.sample_period) or not behind.any():
        return None
    return _highest_line(behind, 1.0 / axle.sample_period, LOWEST_RINGING, 200.0)


def _highest_line(values: FloatArray, rate: float, low: float, high: float) -> float:
    """Frequency [Hz] of the highest line of ``values`` [samples] at a ``rate`` [Hz] between two frequencies [Hz]."""
    points = max(values.size, 16384)
    power = np.abs(np.fft.rfft((values - values.mean()) * np.hanning(values.size), points))
    lines = np.fft.rfftfreq(points, 1.0 / rate)
    inside = np.flatnonzero((lines >= low) & (lines <= high))
    return float(lines[inside[power[inside].argmax()]])
