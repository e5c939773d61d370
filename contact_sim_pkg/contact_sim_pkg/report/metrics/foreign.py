"""Vibration metrics of a bag of anybody: `Imu`, `AccelStamped`, `WrenchStamped`.

What unit and axes of an acceleration are is judged by `excitation/judge.py`. Gravity is removed by the mean; an
axis with an unknown sample has no value.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.metadata import IMPORTED_FROM, RecordedTopic
from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.judge import Cures, Judgement, judge_acceleration, judge_stamps, unknown_samples
from contact_sim_pkg.records.metric import Metric
from contact_sim_pkg.report.metrics.exposure import Exposed, exposure_metrics, hours_to_action
from contact_sim_pkg.report.metrics.maker import Maker
from contact_sim_pkg.report.series import FloatArray
from contact_sim_pkg.report.signal import confidence
from contact_sim_pkg.report.signal.metrics import HORIZONTAL_FACTOR, RideMetrics, ride_metrics
from contact_sim_pkg.report.signal.weighting import WD, WEIGHTINGS, WK, Weighting

__all__ = ["ForeignOptions", "axes_of", "foreign_metrics"]

ACCELERATIONS = {
    "sensor_msgs/msg/Imu": ("linear_acceleration", "angular_velocity"),
    "geometry_msgs/msg/AccelStamped": ("accel.linear", "accel.angular"),
}
"""By type: fields of the acceleration, and of rotation; a velocity is differentiated"""
WRENCH = "geometry_msgs/msg/WrenchStamped"
OF_AXIS = {"x": WD, "y": WD, "z": WK}
ROTATIONS = dict.fromkeys(("rx", "ry", "rz"), WEIGHTINGS["We"])
FEWEST = 16
"""samples"""
COVARIANCE = {
    "linear_acceleration": "linear_acceleration_covariance",
    "angular_velocity": "angular_velocity_covariance",
}
"""By field of an Imu; -1 in its first place: not measured (REP 145)"""
CURES = Cures("--unit {}", "--up {}", "the stamps of the messages must be seconds and nanoseconds")


class ForeignOptions(NamedTuple):
    """What is known of a bag of anybody."""

    axis: str | None = None
    """`x`, `y` or `z`, a rotation `rx`, `ry` or `rz`, a weighting as `Wc`, or both as `y:Wd`; None: the vertical axis with Wk, the
    others with Wd"""
    topic: str | None = None
    """the one to take; None: all"""
    unit: str | None = None
    """of the accelerations; None: m/s^2, refused where gravity says otherwise"""
    up: str | None = None
    """axis that points up, `-y` where y points down; None: by gravity, else z"""


class _Chosen(NamedTuple):
    """What is weighted of a topic."""

    axis: str
    weighting: Weighting


def foreign_metrics(bag: Bag, options: ForeignOptions = ForeignOptions()) -> tuple[list[Metric], list[str]]:  # noqa: B008 - immutable
    """Metrics of each topic that holds an acceleration or a force, and notes on them.

    Raises:
        BagError: nothing to measure, no such topic, axis or weighting, too few samples, or values in another unit than
            m/s^2.
    """
    topic = options.topic
    known, wanted = (*ACCELERATIONS, WRENCH), axes_of(options.axis)
    rows = [bag.topic(topic)] if topic is not None else [row for row in bag.topics.values() if row.type in known]
    rows = [row for row in rows if row.type in known and bag.count(row.name)]
    if not rows:
        where = f"{bag.path} holds" if topic is None else f"the topic {topic} of {bag.path} holds"
        raise BagError(f"{where} no Imu, AccelStamped or WrenchStamped: there is nothing to weight")
    given = [f"--{name}" for name in ("axis", "unit", "up") if getattr(options, name) is not None]
    if given and all(row.type == WRENCH for row in rows):
        raise BagError(f"{', '.join(given)}: for accelerations, {bag.path} has forces: leave it out")
    found: list[Metric] = []
    notes: list[str] = []
    for row in rows:
        if row.type == WRENCH:
            found += _forces(bag, row.name)
            continue
        metrics, said = _accelerations(bag, row, wanted, options)
        found += metrics
        notes += said
    if len(rows) > 1:  # lists of equal names
        found = [each._replace(name=f"/{each.topic}: {each.name}") for each in found]
    return found, notes


def axes_of(axis: str | None) -> list[_Chosen]:
    """Axes and their weightings, none where all three are to be taken; BagError for what is neither."""
    if axis is None:
        return []
    first, _, second = axis.partition(":")
    axes = OF_AXIS | ROTATIONS
    name, weighting = (first, second) if first in axes else ("z", first)
    weighting = weighting or axes[name].name
    if weighting not in WEIGHTINGS or (second and first not in axes):
        allowed = f"{', '.join(axes)}, {', '.join(WEIGHTINGS)}, or both as y:Wd"
        raise BagError(f"--axis {axis}: is neither axis nor weighting; allowed are {allowed}")
    return [_Chosen(name, WEIGHTINGS[weighting])]


def _accelerations(
    bag: Bag, row: RecordedTopic, wanted: list[_Chosen], options: ForeignOptions
) -> tuple[list[Metric], list[str]]:
    """Metrics of each axis chosen of a topic, those of all three together, and what was assumed and removed."""
    name = f"{bag.path.name}, {row.name}"
    linear = {axis: _field(row.type, axis) for axis in OF_AXIS}
    turning = {each.axis: _field(row.type, each.axis) for each in wanted if each.axis in ROTATIONS}
    fields = [*linear.values(), *turning.values()]
    covariances = {COVARIANCE[field.partition(".")[0]] for field in fields if field.partition(".")[0] in COVARIANCE}
    columns = bag.columns(row.name, ("stamp", *fields, *covariances))
    time, rate, faults = sampled(bag, row.name, columns)
    values = {axis: np.asarray(columns[field], dtype=np.float64) for axis, field in (linear | turning).items()}
    absent = [axis for axis in OF_AXIS if np.isnan(values[axis]).all()]  # an axis of NaN alone was not recorded
    present = {axis: values[axis] for axis in OF_AXIS if axis not in absent}
    if not present or any(each.axis in absent for each in wanted):
        raise BagError(f"{name}: of {', '.join(absent)} every sample is NaN: not recorded")
    stated = "m/s^2" if IMPORTED_FROM in bag.metadata else None  # settled when it was imported
    try:
        judged = judge_acceleration(
            {axis: values[axis] for axis in OF_AXIS}, rate, name, CURES, unit=options.unit or stated, up=options.up
        )
    except ExcitationError as error:
        raise BagError(str(error)) from None
    unknown = _not_measured(columns, linear | turning) or {
        **judged.unknown, **{axis: said for axis in turning if (said := unknown_samples(values[axis]))}
    }  # fmt: skip
    vertical = judged.up.removeprefix("-") or "z"
    chosen = wanted or [_Chosen(axis, WK if axis == vertical else WD) for axis in present]
    key, topic = row.name.strip("/").replace("/", "_"), row.name.lstrip("/")
    window = float(time[0]), float(time[-1]) + 1.0 / rate
    alone = len(chosen) == 1
    found: list[Metric] = []
    health = []
    all_faults = (*faults, *(() if alone and chosen[0].axis in ROTATIONS else judged.faults))
    # A sample that is unknown in one axis is a warning about the sensor, and so about all of them
    all_faults += tuple(f"{axis}: {said}" for axis, said in unknown.items())
    for each in chosen:
        maker = Maker(key if alone else f"{key}.{each.axis}", topic, window)
        if each.axis in unknown:
            of_axis, a_w = [_without_value(maker, each, all_faults)], math.nan
        else:
            signal = _signal(values[each.axis], each.axis, rate, judged)
            metrics = ride_metrics(signal, rate, each.weighting)
            exposed = _Axis(each, each.axis == vertical and each.weighting is WK, _factor(each, vertical), alone)
            of_axis, a_w = _axis_metrics(maker, metrics, signal, rate, all_faults, exposed), metrics.weighted_rms
        found += of_axis if alone else [metric._replace(name=f"{each.axis}: {metric.name}") for metric in of_axis]
        health.append((a_w * _factor(each, vertical), each.axis))
    if not alone:
        found += _together(Maker(key, topic, window), health, found, unknown)
    means = ", ".join(f"{each.axis} {judged.factor * np.nanmean(values[each.axis]):.3g}" for each in chosen)
    removed = f"mean of each axis removed, gravity with it ({means})"
    assumed = [f"{row.name}: {said}" for said in judged.assumed]
    assumed += [f"{row.name}: {', '.join(absent)} not recorded"] if absent else []
    return found, [*assumed, f"{row.name}: {time.size} samples at {rate:.6g} Hz; {removed}"]


def _not_measured(columns: dict[str, Any], fields: dict[str, str]) -> dict[str, str]:
    """Axes that the publisher says are not measured (REP 145: the first covariance is -1), and why."""
    found = {}
    for axis, field in fields.items():
        covariance = columns.get(COVARIANCE.get(field.partition(".")[0], ""))
        if covariance is not None and bool((np.asarray(covariance)[:, 0] == -1.0).any()):
            found[axis] = "not measured: its covariance begins with -1 (REP 145)"
    return found


def _signal(values: FloatArray, axis: str, rate: float, judged: Judgement) -> FloatArray:
    """Acceleration of an axis [m/s^2], upwards where it is the vertical one, or angular acceleration [rad/s^2]."""
    if axis in ROTATIONS:
        return np.asarray(np.gradient(values, 1.0 / rate))
    return values * (-judged.factor if judged.up == f"-{axis}" else judged.factor)


class _Axis(NamedTuple):
    """An axis as it is shown."""

    chosen: _Chosen
    vertical: bool
    factor: float
    """for health"""
    alone: bool


def _without_value(maker: Maker, chosen: _Chosen, faults: tuple[str, ...]) -> Metric:
    unit = "rad/s²" if chosen.axis in ROTATIONS else "m/s²"
    return maker.make("a_w", f"a_w, {chosen.weighting.name}", math.nan, unit, remark="no value", broken=faults)


def _axis_metrics(
    maker: Maker, metrics: RideMetrics, values: FloatArray, rate: float, faults: tuple[str, ...], axis: _Axis
) -> list[Metric]:
    """Metrics of one axis and what is doubtful about it."""
    chosen = axis.chosen
    doubts = (
        *faults, *confidence.short(values.size, rate), *confidence.slow(rate),
        *confidence.clipped(confidence.clipped_share(values)),
    )  # fmt: skip
    unit = "rad/s²" if chosen.axis in ROTATIONS else "m/s²"
    exposed = Exposed(chosen.weighting.name, axis.factor, axis.vertical, axis.vertical and axis.alone, unit)
    return exposure_metrics(maker.make, metrics, values, rate, doubts, exposed)


def _field(kind: str, axis: str) -> str:
    """Column of an axis or a rotation."""
    linear, turning = ACCELERATIONS[kind]
    return f"{turning if axis in ROTATIONS else linear}.{axis[-1]}"


def _factor(chosen: _Chosen, vertical: str) -> float:
    horizontal = chosen.axis in OF_AXIS and chosen.axis != vertical
    return HORIZONTAL_FACTOR if horizontal and chosen.weighting is WD else 1.0


def _together(
    maker: Maker, health: list[tuple[float, str]], found: list[Metric], unknown: dict[str, str]
) -> list[Metric]:
    """A(8) by the highest axis, 1.4, 1.4, 1; vector sum for comfort, 1, 1, 1. Neither has a value where an axis has none."""
    worst, axis = max(health)
    said = f"{axis} decides; eight hours of this, 1.4 horizontally, 1 upwards"
    if unknown:
        worst, said = math.nan, f"no value without {', '.join(unknown)}"
    doubts = tuple(dict.fromkeys(text for each in found for text in each.broken))
    total = float(np.sqrt(sum(each.value**2 for each in found if each.key.endswith(".a_w"))))
    reached = [hours_to_action(maker.make, worst, math.nan, doubts, 0)] if worst > 0.0 else []
    return [
        maker.make("a_8", "A(8), highest axis", worst, "m/s²", quantity="daily_exposure", broken=doubts, remark=said),
        maker.make("a_v", "a_v, vector sum", total, "m/s²", quantity="weighted_rms", broken=doubts),
        *reached,
    ]


def _forces(bag: Bag, topic: str) -> list[Metric]:
    """Mean, largest and smallest of the vertical force."""
    columns = bag.columns(topic, ("stamp", "wrench.force.z"))
    time, rate, faults = sampled(bag, topic, columns)
    force = np.asarray(columns["wrench.force.z"], dtype=np.float64)[: time.size]
    make = Maker(
        topic.strip("/").replace("/", "_"), topic.lstrip("/"), (float(time[0]), float(time[-1]) + 1.0 / rate)
    ).make
    wrong = int((~np.isfinite(force)).sum())
    if wrong:
        doubts = (*faults, f"{wrong} of {force.size} samples unknown, the first {int(np.argmin(np.isfinite(force)))}")
        return [make("force", "force z, mean", math.nan, "N", remark="no value", broken=doubts, count=force.size)]
    doubts = (*faults, *confidence.clipped(confidence.clipped_share(force) if force.min() < force.max() else 0.0))
    variation = float(force.std() / abs(force.mean())) if force.mean() else float("nan")
    return [
        make("force", "force z, mean", force.mean(), "N", broken=doubts, count=force.size,
             spread=confidence.spread_of_mean(force, rate), remark=f"{force.min():.5g} to {force.max():.5g} N"),
        make("variation", "its standard deviation over the mean", variation, "", broken=doubts, count=force.size),
    ]  # fmt: skip


def sampled(bag: Bag, topic: str, columns: dict[str, Any]) -> tuple[FloatArray, float, tuple[str, ...]]:
    """Times [s] of a topic, its rate [Hz] by the mean step, and what is wrong with its stamps.

    Raises BagError for too few samples, stamps that do not ascend, or a rate that no vibration has.
    """
    stamps = np.asarray(columns["stamp"], dtype=np.int64)
    # Differences in whole nanoseconds: seconds since 1970 have 2e-7 s as numbers
    time: FloatArray = (stamps - stamps[:1]).astype(np.float64) * 1e-9
    if time.size < FEWEST:
        raise BagError(f"{bag.path}: {topic} has {time.size} samples; at least {FEWEST} are needed to weight them")
    try:
        judged = judge_stamps(time, f"{bag.path.name}, {topic}", CURES.time)
    except ExcitationError as error:
        raise BagError(str(error)) from None
    return time + float(stamps[0]) * 1e-9, judged.rate, judged.faults
