"""Vibration metrics of a bag of anybody: `Imu`, `AccelStamped`, `WrenchStamped`.

Gravity is removed by the mean, and that is said: a sensor that turns in the run keeps some of it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.metadata import RecordedTopic
from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.records.metric import Metric
from contact_sim_pkg.report.metrics.exposure import Exposed, exposure_metrics
from contact_sim_pkg.report.metrics.maker import Maker
from contact_sim_pkg.report.series import FloatArray
from contact_sim_pkg.report.signal import confidence
from contact_sim_pkg.report.signal.metrics import HORIZONTAL_FACTOR, RideMetrics, ride_metrics
from contact_sim_pkg.report.signal.weighting import WD, WEIGHTINGS, WK, Weighting

__all__ = ["foreign_metrics"]

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


class _Chosen(NamedTuple):
    """What is weighted of a topic."""

    axis: str
    weighting: Weighting


def foreign_metrics(bag: Bag, axis: str | None = None, topic: str | None = None) -> tuple[list[Metric], list[str]]:
    """Metrics of each topic that holds an acceleration or a force, and notes on them.

    Args:
        bag: of anybody.
        axis: `x`, `y` or `z`, a rotation `rx`, `ry` or `rz`, a weighting as `Wc`, or both as `y:Wd`; None: x, y and
            z with Wd, Wd, Wk.
        topic: the one to take; None: all.

    Raises:
        BagError: nothing to measure, no such topic, axis or weighting, too few samples.
    """
    known, wanted = (*ACCELERATIONS, WRENCH), _chosen(axis)
    rows = [bag.topic(topic)] if topic is not None else [row for row in bag.topics.values() if row.type in known]
    rows = [row for row in rows if row.type in known and bag.count(row.name)]
    if not rows:
        where = f"{bag.path} holds" if topic is None else f"the topic {topic} of {bag.path} holds"
        raise BagError(f"{where} no Imu, AccelStamped or WrenchStamped: there is nothing to weight")
    found: list[Metric] = []
    notes: list[str] = []
    for row in rows:
        if row.type == WRENCH:
            found += _forces(bag, row.name)
            continue
        metrics, said = _accelerations(bag, row, wanted)
        found += metrics
        notes.append(said)
    if len(rows) > 1:  # lists of equal names
        found = [each._replace(name=f"/{each.topic}: {each.name}") for each in found]
    return found, notes


def _chosen(axis: str | None) -> list[_Chosen]:
    """Axes and their weightings; BagError for what is neither."""
    if axis is None:
        return [_Chosen(name, weighting) for name, weighting in OF_AXIS.items()]
    first, _, second = axis.partition(":")
    axes = OF_AXIS | ROTATIONS
    name, weighting = (first, second) if first in axes else ("z", first)
    weighting = weighting or axes[name].name
    if weighting not in WEIGHTINGS or (second and first not in axes):
        allowed = f"{', '.join(axes)}, {', '.join(WEIGHTINGS)}, or both as y:Wd"
        raise BagError(f"--axis {axis}: is neither axis nor weighting; allowed are {allowed}")
    return [_Chosen(name, WEIGHTINGS[weighting])]


def _accelerations(bag: Bag, row: RecordedTopic, chosen: list[_Chosen]) -> tuple[list[Metric], str]:
    """Metrics of each axis chosen of a topic, those of all three together, and what was removed."""
    names = [_field(row.type, each.axis) for each in chosen]
    columns = bag.columns(row.name, ("time", *names))
    time, rate, faults = sampled(bag, row.name, columns)
    key = row.name.strip("/").replace("/", "_")
    window = float(time[0]), float(time[-1]) + 1.0 / rate
    found: list[Metric] = []
    health, means = [], []
    for each, name in zip(chosen, names, strict=True):
        values = np.asarray(columns[name], dtype=np.float64)
        means.append(f"{each.axis} {values.mean():.3g}")
        if name.startswith("angular_velocity"):
            values = np.gradient(values, 1.0 / rate)
        maker = Maker(f"{key}.{each.axis}" if len(chosen) > 1 else key, row.name.lstrip("/"), window)
        metrics = ride_metrics(values, rate, each.weighting)
        of_axis = _axis_metrics(maker, metrics, values, rate, faults, each, len(chosen) == 1)
        found += (
            [metric._replace(name=f"{each.axis}: {metric.name}") for metric in of_axis] if len(chosen) > 1 else of_axis
        )
        health.append((metrics.weighted_rms * _factor(each), each.axis))
    if len(chosen) > 1:
        found += _together(Maker(key, row.name.lstrip("/"), window), health, found)
    removed = f"mean of each axis removed, gravity with it ({', '.join(means)})"
    return found, f"{row.name}: {time.size} samples at {rate:.6g} Hz; {removed}"


def _axis_metrics(
    maker: Maker,
    metrics: RideMetrics,
    values: FloatArray,
    rate: float,
    faults: tuple[str, ...],
    chosen: _Chosen,
    alone: bool,
) -> list[Metric]:
    """Metrics of one axis and what is doubtful about it."""
    turns, vertical = chosen.axis in ROTATIONS, chosen.axis == "z" and chosen.weighting is WK
    doubts = (
        *faults, *confidence.short(values.size, rate), *confidence.slow(rate),
        *(() if turns else confidence.tilted(float(values.mean()))), *confidence.clipped(confidence.clipped_share(values)),
    )  # fmt: skip
    unit = "rad/s²" if turns else "m/s²"
    exposed = Exposed(chosen.weighting.name, _factor(chosen), vertical, vertical and alone, unit)
    return exposure_metrics(maker.make, metrics, values, rate, doubts, exposed)


def _field(kind: str, axis: str) -> str:
    """Column of an axis or a rotation."""
    linear, turning = ACCELERATIONS[kind]
    return f"{turning if axis in ROTATIONS else linear}.{axis[-1]}"


def _factor(chosen: _Chosen) -> float:
    return HORIZONTAL_FACTOR if chosen.axis in ("x", "y") and chosen.weighting is WD else 1.0


def _together(maker: Maker, health: list[tuple[float, str]], found: list[Metric]) -> list[Metric]:
    """A(8) by the highest axis, 1.4, 1.4, 1; vector sum for comfort, 1, 1, 1."""
    worst, axis = max(health)
    doubts = tuple(dict.fromkeys(text for each in found for text in each.broken))
    total = float(np.sqrt(sum(each.value**2 for each in found if each.key.endswith(".a_w"))))
    return [
        maker.make("a_8", "A(8), highest axis", worst, "m/s²", quantity="daily_exposure", broken=doubts,
                   remark=f"{axis} decides; eight hours of this, 1.4 x, 1.4 y, z"),
        maker.make("a_v", "a_v, vector sum", total, "m/s²", quantity="weighted_rms", broken=doubts),
    ]  # fmt: skip


def _forces(bag: Bag, topic: str) -> list[Metric]:
    """Mean, largest and smallest of the vertical force."""
    columns = bag.columns(topic, ("time", "wrench.force.z"))
    time, rate, faults = sampled(bag, topic, columns)
    force = np.asarray(columns["wrench.force.z"], dtype=np.float64)[: time.size]
    make = Maker(
        topic.strip("/").replace("/", "_"), topic.lstrip("/"), (float(time[0]), float(time[-1]) + 1.0 / rate)
    ).make
    doubts = (*faults, *confidence.clipped(confidence.clipped_share(force) if force.min() < force.max() else 0.0))
    variation = float(force.std() / abs(force.mean())) if force.mean() else float("nan")
    return [
        make("force", "force z, mean", force.mean(), "N", broken=doubts, count=force.size,
             spread=confidence.spread_of_mean(force, rate), remark=f"{force.min():.5g} to {force.max():.5g} N"),
        make("variation", "its standard deviation over the mean", variation, "", broken=doubts, count=force.size),
    ]  # fmt: skip


def sampled(bag: Bag, topic: str, columns: dict[str, object]) -> tuple[FloatArray, float, tuple[str, ...]]:
    """Times [s] of a topic, its rate [Hz] by the median step, and what is wrong with its stamps.

    Raises BagError for too few samples, or stamps that do not ascend.
    """
    time = np.asarray(columns["time"], dtype=np.float64)
    if time.size < FEWEST:
        raise BagError(f"{bag.path}: {topic} has {time.size} samples; at least {FEWEST} are needed to weight them")
    steps = np.diff(time)
    step = float(np.median(steps))
    if step <= 0.0:
        raise BagError(
            f"{bag.path}: the stamps of {topic} do not ascend, so its rate is unknown and it cannot be weighted"
        )
    rate = (time.size - 1) / float(time[-1] - time[0]) if time[-1] > time[0] else 1.0 / step
    scatter = float(np.median(np.abs(steps - step))) / step
    gaps = int((steps > 1.5 * step).sum())
    faults = (
        [f"wrong rate: stamps scatter by {100.0 * scatter:.2g} % of the step"] if scatter > confidence.UNEVEN else []
    )
    if gaps or steps.min() <= 0.0:
        faults.append(f"wrong rate: {gaps} gaps in the stamps")
    return time, rate, tuple(faults)
