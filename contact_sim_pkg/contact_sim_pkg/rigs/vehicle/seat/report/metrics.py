"""Metrics of a seat: what it passes on of the floor's vibration (ISO 2631-1, ISO 10326-1), what that is for
the sitter's day, and how the cushion carries him.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from contact_sim_pkg.bag.texts import excitation_of_text
from contact_sim_pkg.excitation.kinds import VibrationKind, kind_known
from contact_sim_pkg.pressure.cushion import valid_strain
from contact_sim_pkg.records.metric import EVENT, LIMIT, STATE, USUAL_RANGE, Metric
from contact_sim_pkg.report.metrics.exposure import Exposed, exposure_metrics
from contact_sim_pkg.report.metrics.maker import Maker, at_most, conditions_of
from contact_sim_pkg.report.metrics.numerical import Errors, errors_of
from contact_sim_pkg.report.rows import number
from contact_sim_pkg.report.series import FieldSeries, Recording
from contact_sim_pkg.report.signal import confidence
from contact_sim_pkg.report.signal.metrics import ride_metrics, seat_factor
from contact_sim_pkg.report.signal.spectrum import transmissibility
from contact_sim_pkg.report.signal.weighting import WK, Weighting
from contact_sim_pkg.rigs.vehicle.seat.occupants import H_POINT
from contact_sim_pkg.rigs.vehicle.seat.report.occupant import apparent_mass_of, occupant_signals, seat_to_head_of
from contact_sim_pkg.rigs.vehicle.seat.report.response import peak_of, trusted_part
from contact_sim_pkg.rigs.vehicle.seat.report.ride import RideSignals, ride_signals
from contact_sim_pkg.rigs.vehicle.seat.report.travel import seat_travel
from contact_sim_pkg.rigs.vehicle.travel_report import travel_metrics
from contact_sim_pkg.run.bag_content import EXCITATION_KEY

SEAT = "seat"
HARD_SEAT = "hard_seat"
"""Kind of a map under tissue, of which no bands are published: those of `cushion` are of car seats."""
FOLLOW = (".hours_to_action", ".dose_estimated")


def seat_metrics(recording: Recording) -> list[Metric]:
    """The list of a seat; none without one."""
    signals = ride_signals(recording.motion)
    contact = recording.contacts.get(SEAT)
    errors = errors_of(recording)
    shock, found = _is_shock(recording.scene), []
    if signals is not None and shock:
        found = shock_metrics(signals, errors.largest("motion", "motion"))
    elif signals is not None:
        found = vibration_metrics(signals, recorded_faults(recording), errors, distinct_time(recording))
    found[1:1] = travel_metrics(seat_travel(recording))
    if contact is None:
        return found
    window = float(contact.time[0]), float(contact.time[-1]) + contact.sample_period
    make = Maker(SEAT, f"{SEAT}/force", window, conditions_of(recording.scene))
    field = recording.fields.get(SEAT)
    found += (
        largest_of_map(field, make, errors) if shock and field is not None else cushion_metrics(recording, make, errors)
    )
    lifted = contact.normal <= 0.0
    if shock:
        sample = 1e3 * contact.sample_period
        lasted = make.make("off_the_seat", "time without load", sample * float(lifted.sum()), "ms", count=lifted.size,
                           basis=EVENT, error=sample * max(1, int(np.count_nonzero(lifted[1:] & ~lifted[:-1]))))  # fmt: skip
        return [*found, lasted]
    share = 100.0 * float(lifted.mean())
    lifts = make.make(
        "lift_off",
        "time without load",
        share,
        "%",
        band=at_most(0.0, "contact is kept", LIMIT),
        count=contact.normal.size,
    )
    found += [lifts, *occupant_metrics(recording, make.make)]
    return sorted(found, key=lambda each: each.key.endswith(FOLLOW))  # what only says A(8) anew stands behind


def _is_shock(scene: Mapping[str, Any]) -> bool:
    """Whether all that shakes the seat of a scene is one shock."""
    known: VibrationKind | None = kind_known("vibration", scene.get("vibration"))
    return known is not None and known.is_shock and scene.get("road") is None


def shock_metrics(signals: RideSignals, error: float = math.nan) -> list[Metric]:
    """What one shock of the floor does, however long the run goes on behind it; ``error``: numerical one of the
    motion over its largest value.

    Largest accelerations less gravity [m/s²], their ratio, and the largest running rms and the dose VDV
    (int a_w^4 dt)^(1/4) of the seat with Wk (ISO 2631-1, 6.3).
    """
    floor, seat = (np.abs(each - each[0]) for each in (signals.floor, signals.seat))
    weighted = ride_metrics(signals.seat, signals.sample_rate)
    window = float(signals.time[0]), float(signals.time[0]) + signals.time.size / signals.sample_rate
    make = Maker(SEAT, "bench/motion", window, basis=EVENT).make
    count, largest = signals.time.size, (float(floor.max()), float(seat.max()))
    over, place = error * max(largest), int(seat.argmax())
    found = [
        make("floor_peak", "acceleration of the floor, largest", largest[0], "m/s²", count=count, error=over,
             remark=f"at {signals.time[int(floor.argmax())]:.3f} s"),
        make("seat_peak", "acceleration of the seat, largest", largest[1], "m/s²", count=count, error=over,
             remark=f"at {signals.time[place]:.3f} s"),
    ]  # fmt: skip
    if largest[0] > 0.0:
        ratio = largest[1] / largest[0]
        found.append(make("shock_ratio", "seat over floor, largest", ratio, "", count=count, error=error * ratio))
    for key, name, value, unit in (
        ("mtvv", "MTVV, linear 1 s", weighted.largest_running_rms, "m/s²"),
        ("dose_of_shock", "VDV of the shock", weighted.vibration_dose, "m/s^1.75"),
    ):
        found.append(make(key, name, value, unit, count=count, error=error * value))
    return found


def vibration_metrics(
    signals: RideSignals, faults: tuple[str, ...] = (), errors: Errors | None = None, distinct: float = math.inf
) -> list[Metric]:
    """SEAT, exposure and the peak of the way from floor to seat; ``faults`` of the recording that drives the
    floor hold for all of them; ``errors``: numerical ones of the run; ``distinct``: [s] after which the floor repeats
    itself, which makes no number more certain."""
    rate, length = signals.sample_rate, signals.time.size
    once = min(length, round(min(distinct, length / rate) * rate))
    floor, seat = (ride_metrics(each, rate) for each in (signals.floor, signals.seat))
    window = float(signals.time[0]), float(signals.time[0]) + length / rate
    make = Maker(SEAT, "bench/motion", window).make
    doubts = (*confidence.short(once, rate, repeated=once < length), *confidence.slow(rate), *faults)
    peaky = (*doubts, *confidence.peaky(seat.crest_factor))
    factor = seat_factor(seat.weighted_rms, floor.weighted_rms)
    spread = 100.0 * confidence.spread_of_ratio(seat.weighted[:once], floor.weighted[:once], rate)
    # Over the rms, of which the largest value is crest factor times as much.
    of_rms = math.nan if errors is None else errors.of_mean("motion", "motion", 1.0, seat.crest_factor)
    found = [
        make("factor", "SEAT", factor, "%", quantity="seat_factor", broken=peaky, spread=spread, count=length,
             error=of_rms * factor, remark=f"floor {floor.weighted_rms:.3g} m/s²"),
    ]  # fmt: skip
    found += _way_to_seat(make, signals, doubts)
    for each in exposure_metrics(make, seat, signals.seat, rate, doubts, once=once):
        power = (
            0.0
            if each.key.endswith((".crest", ".spine_risk"))
            else 2.0
            if each.key.endswith(".hours_to_action")
            else 1.0
        )
        found.append(each._replace(error=power * of_rms * each.value) if power else each)  # fmt: skip
    dose = seat_factor(seat.vibration_dose, floor.vibration_dose)
    return [*found, make("factor_dose", "SEAT by VDV", dose, "%", quantity="seat_factor", broken=doubts, count=length,
                         error=of_rms * dose)]  # fmt: skip


def weighted_metrics(recording: Recording, weighting: Weighting) -> list[Metric]:
    """SEAT and exposure of the seat surface by another weighting; none without a seat."""
    signals = ride_signals(recording.motion)
    if signals is None:
        return []
    rate, length = signals.sample_rate, signals.time.size
    once = min(length, round(min(distinct_time(recording), length / rate) * rate))
    floor, seat = (ride_metrics(each, rate, weighting) for each in (signals.floor, signals.seat))
    window = float(signals.time[0]), float(signals.time[0]) + length / rate
    make = Maker(SEAT, "bench/motion", window).make
    broken = (
        *confidence.short(once, rate, repeated=once < length),
        *confidence.slow(rate),
        *recorded_faults(recording),
    )
    factor = seat_factor(seat.weighted_rms, floor.weighted_rms)
    spread = 100.0 * confidence.spread_of_ratio(seat.weighted[:once], floor.weighted[:once], rate)
    vertical = weighting.name == WK.name
    return [
        make("factor", f"SEAT, {weighting.name}", factor, "%", broken=broken, spread=spread, count=length,
             remark=f"floor {floor.weighted_rms:.3g} m/s²"),
        *exposure_metrics(
            make, seat, signals.seat, rate, broken, Exposed(weighting.name, vertical=vertical, decides=vertical), once=once
        ),
    ]  # fmt: skip


def _way_to_seat(make: Callable[..., Metric], signals: RideSignals, doubts: tuple[str, ...]) -> list[Metric]:
    """Height and frequency of the peak of T(f) where it can be read."""
    way = transmissibility(signals.floor, signals.seat, signals.sample_rate)
    trusted = trusted_part(way, signals.floor, signals.sample_rate)
    peak = None if trusted is None else peak_of(way, trusted)
    if peak is None:
        return []
    place = int(np.argmin(np.abs(way.frequency - peak[1])))
    coherence, error = float(way.coherence[place]), peak[0] * float(way.spread[place])
    return [
        make("peak", "T(f) at its peak", peak[0], "", quantity="seat_peak", broken=doubts, count=way.segments,
             spread=confidence.TWO_SIDED * error, remark=f"coherence {coherence:.3g}"),
        make("peak_frequency", "frequency of the peak", peak[1], "Hz", quantity="seat_peak_frequency", broken=doubts,
             count=way.segments, error=0.5 * float(way.frequency[1])),
    ]  # fmt: skip


def cushion_metrics(recording: Recording, maker: Maker, errors: Errors) -> list[Metric]:
    """How the cushion carries: pressures and area of its map, or how deep the sitter sinks."""
    field, contact, keys = recording.fields.get(SEAT), recording.contacts[SEAT], _cushion_keys(recording)
    if field is not None:
        return map_metrics(SEAT, field, maker, HARD_SEAT if "tissue" in keys else "cushion", errors)
    deepest = 1e3 * float(contact.approach.max())
    law = "range of the foam's law"
    valid = valid_strain((keys.get("curve") or {}).get("points"))
    # With tissue the approach is that of both.
    band = None if not keys or "tissue" in keys else at_most(1e3 * valid * float(keys["thickness"]), law, USUAL_RANGE)
    return [maker.make("sink", "deepest sink", deepest, "mm", band=band, count=contact.approach.size, basis=EVENT)]


def _cushion_keys(recording: Recording) -> Mapping[str, Any]:
    """Keys of the cushion; empty without one."""
    return ((recording.scene.get("effects") or {}).get(SEAT) or {}).get("cushion") or {}


def occupant_metrics(recording: Recording, make: Callable[..., Metric]) -> list[Metric]:
    """Height of the H-point, peaks of the apparent mass and of the way to the head where they can be read."""
    signals = occupant_signals(recording)
    if signals is None:
        return []
    found, touching = [], signals.force > 0.0
    if touching.any() and "tissue" not in _cushion_keys(recording):
        height = 1e3 * (H_POINT - float(signals.approach[touching].mean()))
        found.append(
            make("h_point", "H-point over the unloaded cushion", height, "mm", count=int(touching.sum()), basis=STATE)
        )
    ways = (
        ("apparent_mass", "apparent mass", "kg", apparent_mass_of(signals)),
        ("to_head", "head over seat", "", seat_to_head_of(signals)),
    )
    for key, name, unit, way in ways:
        trusted = None if way is None else trusted_part(way, signals.seat, signals.sample_rate)
        peak = None if way is None or trusted is None else peak_of(way, trusted)
        if way is not None and peak is not None:
            found += [
                make(
                    key,
                    f"{name} at its peak",
                    peak[0],
                    unit,
                    count=way.segments,
                    topic="bench/motion",
                    remark=signals.name,
                ),
                make(
                    f"{key}_frequency",
                    f"frequency of that peak, {name}",
                    peak[1],
                    "Hz",
                    count=way.segments,
                    error=0.5 * float(way.frequency[1]),
                    topic="bench/motion",
                ),
            ]
    return found


def map_metrics(contact: str, field: FieldSeries, maker: Maker, kind: str, errors: Errors) -> list[Metric]:
    """Pressures and area of the maps of a run, mean over those that carry; ``kind`` names their bands."""
    carries = field.load > 0.0
    if not carries.any():
        return []
    topic, count = f"{contact}/patch", int(carries.sum())
    rows = (
        ("mean_pressure", "mean pressure", 1e-3 * field.mean[carries], "kPa", "area"),
        ("peak_pressure", "peak pressure", 1e-3 * field.peak[carries], "kPa", "peak"),
        ("area", "loaded area", 1e4 * field.area[carries], "cm²", "area"),
    )
    return [
        maker.make(key, name, values.mean(), unit, quantity=f"{kind}_{key}", count=count, topic=topic,
                   error=errors.largest(contact, of) * float(values.max()),
                   remark=f"{number(values.min())} to {number(values.max())}")
        for key, name, values, unit, of in rows
    ]  # fmt: skip


def largest_of_map(field: FieldSeries, maker: Maker, errors: Errors) -> list[Metric]:
    """Largest pressure and area of the maps of a shock."""
    rows = (
        ("peak_pressure_largest", "peak pressure, largest", 1e-3 * field.peak, "kPa", "peak"),
        ("area_largest", "loaded area, largest", 1e4 * field.area, "cm²", "area"),
    )
    return [
        maker.make(key, name, values.max(), unit, count=values.size, topic=f"{SEAT}/patch", basis=EVENT,
                   error=errors.largest(SEAT, of) * float(values.max()))
        for key, name, values, unit, of in rows
    ]  # fmt: skip


def recorded_faults(recording: Recording) -> tuple[str, ...]:
    """What is wrong with the recording that drives the floor: samples at full scale, a low rate."""
    return tuple(fault for values in _described(recording).values() for fault in faults_of(values))


def distinct_time(recording: Recording) -> float:
    """Time after which the recording that drives the floor repeats itself, [s]; infinite where it does not, and where
    something else drives the floor too.
    """
    described = _described(recording)
    once = [values.get("duration_s") for values in described.values() if values.get("beyond_the_recording") == "repeat"]
    lasts = [float(each) for each in once if isinstance(each, int | float) and each > 0.0]
    return max(lasts) if lasts and len(lasts) == len(described) else math.inf


def _described(recording: Recording) -> dict[str, dict[str, Any]]:
    return excitation_of_text(recording.metadata.get(EXCITATION_KEY), f"excitation of {recording.name}")


def faults_of(described: Mapping[str, Any]) -> tuple[str, ...]:
    """Faults of one excitation by its description."""
    axes, rate = described.get("axes"), described.get("rate_Hz", described.get("rate"))
    upward = axes.get("z") if isinstance(axes, Mapping) else None
    if not isinstance(upward, Mapping):  # it has no sensor
        return ()
    samples = float(described.get("samples") or described.get("duration_s", 0.0) * float(rate or 0.0))
    share = float(upward.get("clipped_samples") or 0) / samples if samples > 0.0 else 0.0
    return (*confidence.clipped(share), *(confidence.slow(float(rate)) if rate else ()))
