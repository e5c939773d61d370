"""System *inertia*: the ten inertial parameters of a body from its accelerations and the wrench on it,
by batch and by recursive least squares (Identifiability eq 1).
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from contact_sim_lab.papers.identifiability.regressor import (
    NAMES,
    UNITS,
    BodyMotion,
    InertiaFit,
    batch,
    recursive,
)
from contact_sim_lab.papers.inputs import is_bag, read_table
from contact_sim_lab.records.paper import PaperError, SystemResult, Values
from contact_sim_pkg.bag.encoding import SECOND
from contact_sim_pkg.bag.reader import Bag, open_bag
from contact_sim_pkg.identify.readers.stamped import all_messages, chosen, stamp, vectors
from contact_sim_pkg.identify.readers.wrenches import WRENCH

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas

__all__ = ["inertia"]

Array = NDArray[numpy.float64]

COLUMNS = tuple(f"{name}{axis}" for name in ("s", "w", "al", "f", "t") for axis in "xyz")
IMU, ACCEL = "sensor_msgs/msg/Imu", "geometry_msgs/msg/AccelStamped"
FEWEST = 4
PANELS = (("mass, kg", (0,)), ("first moment, kg m", (1, 2, 3)), ("moments of inertia, kg m²", (4, 5, 6)),
          ("products of inertia, kg m²", (7, 8, 9)))  # fmt: skip
COLOURS = ("#136f96", "#e08a2e", "#6b6b66")


def inertia(path: Path | None, values: Values) -> SystemResult:
    """Parameters from a CSV file, or from a bag with Imu and WrenchStamped in body axes.

    Raises PaperError and BagError for an input that does not hold them.
    """
    assert path is not None
    motion = _motion_of_bag(open_bag(path, skip_bad=True)) if is_bag(path) else _motion_of_table(path)
    found, course = batch(motion), recursive(motion)
    last = course[-1]
    rows = [
        {"parameter": name, "unit": unit, "batch": _or_none(found.parameters[place], found.deviations[place]),
         "deviation": _or_none(found.deviations[place], found.deviations[place]),
         "recursive": None if numpy.isnan(last[place]) else float(last[place])}
        for place, (name, unit) in enumerate(zip(NAMES, UNITS, strict=True))
    ]  # fmt: skip
    note = f"rank {found.rank} of 10 from {len(motion.spin)} samples; {found.residual:.2g} of the wrench is left"
    if found.hidden:
        note += f"\nnot identified, alone or together: {', '.join(found.hidden)}"
    if found.rank == 10:
        scale = numpy.maximum(numpy.abs(found.parameters), found.deviations)
        note += f"; batch and recursive differ by {float(numpy.max(numpy.abs(last - found.parameters) / scale)):.2g} at most"
        note += _impossible(found.parameters)
    draw = (lambda canvas: _draw(canvas, found, course)) if found.rank == 10 else None
    return SystemResult(rows, draw, note)


def _or_none(value: float, deviation: float) -> float | None:
    return float(value) if numpy.isfinite(deviation) else None


def _impossible(parameters: Array) -> str:
    """A line where no body has such parameters: of a body the second moments are not negative."""
    mass, first = float(parameters[0]), parameters[1:4]
    xx, yy, zz, xy, xz, yz = parameters[4:]
    matrix = numpy.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    pseudo = numpy.zeros((4, 4))
    pseudo[:3, :3] = 0.5 * numpy.trace(matrix) * numpy.eye(3) - matrix
    pseudo[:3, 3], pseudo[3, :3], pseudo[3, 3] = first, first, mass
    return (
        ""
        if numpy.linalg.eigvalsh(pseudo).min() > 0.0
        else "\nno body has these parameters: a second moment is negative"
    )


def _motion_of_table(path: Path) -> BodyMotion:
    table = read_table(path, COLUMNS, fewest=FEWEST)
    parts = numpy.stack([table[name] for name in COLUMNS], axis=1)
    return BodyMotion(*(parts[:, first : first + 3] for first in range(0, 15, 3)))


def _motion_of_bag(bag: Bag) -> BodyMotion:
    """Samples at the stamps of the Imu, within the time of the wrench; the spin's rate from AccelStamped where there is
    one, else from a spline through the spin.
    """
    name = chosen(bag, None, (IMU,), "one topic of it")
    imu = _once(all_messages(bag, name))
    force_time, force = _series(bag, (WRENCH,), lambda message: (message.wrench.force, message.wrench.torque))
    time = _times(imu, force_time[0])
    inside = (time >= 0.0) & (time <= _seconds(force_time))
    if inside.sum() < FEWEST:
        raise PaperError(
            f"{bag.path}: {int(inside.sum())} samples of {name} lie within the time of the wrench; {FEWEST} are needed"
        )
    spin = vectors([message.angular_velocity for message in imu])
    rate = CubicSpline(time, spin).derivative()(time)
    if any(row.type == ACCEL for row in bag.topics.values()):
        accel_time, accel = _series(bag, (ACCEL,), lambda message: (message.accel.angular,))
        rate = _at(time, (accel_time - force_time[0]) / SECOND, accel)
    wrench = _at(time, (force_time - force_time[0]) / SECOND, force)
    specific = vectors([message.linear_acceleration for message in imu])
    return BodyMotion(*(part[inside] for part in (specific, spin, rate, wrench[:, :3], wrench[:, 3:])))


def _series(bag: Bag, types: tuple[str, ...], parts: Any) -> tuple[NDArray[numpy.int64], Array]:
    """Stamps [n] [ns] and values [n, 3 k] of the only topic of some types."""
    messages = _once(all_messages(bag, chosen(bag, None, types, "one topic of it")))
    columns = zip(*(parts(message) for message in messages), strict=True)
    return numpy.array([stamp(message) for message in messages]), numpy.concatenate(
        [vectors(list(column)) for column in columns], axis=1
    )


def _once(messages: list[Any]) -> list[Any]:
    """The first message of each stamp, in the order of time."""
    of_stamp = {stamp(message): message for message in reversed(messages)}
    return [of_stamp[key] for key in sorted(of_stamp)]


def _times(messages: list[Any], origin: int) -> Array:
    return numpy.array([(stamp(message) - origin) / SECOND for message in messages])


def _seconds(stamps: NDArray[numpy.int64]) -> float:
    return float(stamps[-1] - stamps[0]) / SECOND


def _at(time: Array, known: Array, values: Array) -> Array:
    return numpy.stack([numpy.interp(time, known, column) for column in values.T], axis=1)


def _draw(canvas: Canvas, found: InertiaFit, course: Array) -> None:
    """Recursive parameters over the samples, the batch dashed."""
    axes = canvas.subplots(2, 2, sharex=True).ravel()
    samples = numpy.arange(1, len(course) + 1)
    for place, (label, numbers) in zip(axes, PANELS, strict=True):
        for colour, number in zip(COLOURS, numbers, strict=False):
            place.plot(samples, course[:, number], color=colour, label=NAMES[number])
            place.axhline(found.parameters[number], color=colour, linestyle=":", linewidth=0.8)
            # The first samples identify little: the panel shows where it settles.
        wanted = found.parameters[list(numbers)]
        room = 0.5 * max(float(numpy.ptp(wanted)), 0.4 * float(numpy.abs(wanted).max()))
        place.set_ylim(float(wanted.min()) - room, float(wanted.max()) + room)
        place.set_ylabel(label)
        place.legend(fontsize=7.5)
    for place in axes[2:]:
        place.set_xlabel("samples")
