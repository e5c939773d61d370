"""A recording as a bag, with where it came from: accelerations as `Imu`, a pressure mat as `ContactPatch`, all else as `Series`."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from rosbags.typesys.stores.ros2_jazzy import sensor_msgs__msg__Imu as Imu

from contact_sim_pkg.bag.encoding import LAST_STAMP, SECOND
from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import IMPORTED_FROM, RecordedTopic
from contact_sim_pkg.bag.typestore import definition as our_definition
from contact_sim_pkg.bag.typestore import type_hash as our_type_hash
from contact_sim_pkg.bag.writer import BagSummary, BagWriter
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.judge import Cures, judge_acceleration, judge_stamps
from contact_sim_pkg.excitation.recorded_csv import TIME_NAMES, RecordedTable
from contact_sim_pkg.excitation.table_files import read_recording
from contact_sim_pkg.excitation.table_words import UNITS, bare_name
from contact_sim_pkg.records.messages import Series
from contact_sim_pkg.standard.mat_files import PRESSURE_UNITS, is_mat
from contact_sim_pkg.standard.messages import Quaternion, definition, encoded, header, type_hash, vector
from contact_sim_pkg.standard.motion import NOT_GIVEN

__all__ = ["ImportChoice", "import_recording"]

IMU, SERIES = "sensor_msgs/msg/Imu", "contact_msgs_defs/msg/Series"
ACCELERATION, REST = "acceleration", "series"
"""topics"""
SAMPLES = 1000
"""of one message of a series"""
NAMES = {
    "x": ("x", "ax", "a_x", "acc_x", "accx", "acc x"), "y": ("y", "ay", "a_y", "acc_y", "accy", "acc y"),
    "z": ("z", "az", "a_z", "acc_z", "accz", "acc z"),
}  # fmt: skip
"""usual names of the axes"""
CURES = Cures("--unit {}", "--up {}", "give --time-unit ms, us or ns")

Array = NDArray[numpy.float64]


class ImportChoice(NamedTuple):
    """What is known of a recording."""

    rate: float | None = None
    """[Hz] of a file without times"""
    time: str | None = None
    time_unit: str | None = None
    header_line: int | None = None
    axes: Mapping[str, str] = {}
    """`x`, `y`, `z` -> column of the acceleration, with a minus sign where it points the other way; else by usual names"""
    unit: str | None = None
    """of accelerations, or of a mat's pressures, whose unit the file does not state"""
    scale: float | None = None
    """[m/s^2] of full scale, of a `.wav`"""
    frame: str = "sensor"
    pitch: float | None = None
    """[m] from cell to cell of a mat whose file does not state it"""
    front: str | None = None
    """side of a mat's map that points forward, one of `FRONTS`; None: as usual on its contact"""
    contact: str = "seat"
    """that a mat lies on"""


OF_MATS = ("rate", "unit", "pitch", "front", "contact")
ONLY_OF_MATS = ("pitch", "front", "contact")


def import_recording(source: Path, target: Path, choice: ImportChoice = ImportChoice()) -> tuple[BagSummary, list[str]]:  # noqa: B008
    """Write a bag of what a recording holds; stamps count from its first sample.

    Returns:
        Summary of the bag, and what was found and assumed, a sentence each.

    Raises:
        BagError: the recording cannot be used, its rate or unit is not known, or the bag exists.
    """
    mat = is_mat(source)
    _refuse_unused(source, choice, mat)
    if mat:
        from contact_sim_pkg.standard.imported_mats import import_mat  # computes boundaries by a compiled kernel

        return import_mat(source, target, **{name: getattr(choice, name) for name in OF_MATS})
    try:
        table = read_recording(source, choice.header_line)
        time, said = table.time(choice.time, choice.time_unit)
        time, notes = _times(table, time, choice.rate)
        axes, columns, more = _axes(table, choice, (len(time) - 1) / float(time[-1] - time[0]))
    except ExcitationError as error:
        raise BagError(str(error)) from None
    notes = [*table.notes, *([said] if said else []), *notes, *more]
    stamps = numpy.round((time - time[0]) * SECOND).astype(numpy.int64)
    if stamps[-1] > LAST_STAMP:
        raise BagError(f"{source}: it spans {stamps[-1] / SECOND:.4g} s, more than a stamp can hold; {CURES.time}")
    used = columns | _time_columns(table, choice) | table.texts
    rest = {name: column for name, column in table.columns.items() if name not in used}
    topics = [_topic(ACCELERATION, IMU)] if axes else []
    topics += [_topic(REST, SERIES)] if rest else []
    if not topics:
        raise BagError(f"{source}: it holds nothing but times; name the columns of the acceleration (--axes z=NAME)")
    provenance = {
        IMPORTED_FROM: source.name, "imported_sha256": hashlib.sha256(source.read_bytes()).hexdigest(),
        "imported_as": "; ".join(notes) or "as written",
    }  # fmt: skip
    with BagWriter(target, topics, provenance) as writer:
        for stamp, topic, data in _messages(axes, rest, stamps, table.units, choice.frame):
            writer.write(topic, stamp, data)
        return writer.close(), notes


def _refuse_unused(source: Path, choice: ImportChoice, mat: bool) -> None:
    """Raises BagError for an option that says nothing about a file of this kind."""
    usual = ImportChoice()
    given = [name for name in ImportChoice._fields if getattr(choice, name) != getattr(usual, name)]
    unused = [name for name in given if (name not in OF_MATS if mat else name in ONLY_OF_MATS)]
    kind = "a pressure mat" if mat else "no pressure mat"
    if unused:
        raise BagError(f"{source} is {kind}: --{unused[0].replace('_', '-')} does not apply to it; leave it out")
    if choice.unit is not None and (choice.unit in PRESSURE_UNITS) != mat:
        raise BagError(f"{source} is {kind}: --unit {choice.unit} is no unit of what it holds; state another or none")


def _times(table: RecordedTable, time: Array | None, rate: float | None) -> tuple[Array, list[str]]:
    """Times of the samples [s]; by a rate [Hz] where the file has none."""
    count = len(table.lines)
    if time is None:
        rate = rate or table.nominal_rate
        if rate is None:
            raise ExcitationError(
                f"{table.file}: the file has no time column, so its sampling rate must be stated (--rate); it is never guessed"
            )
        return numpy.arange(count) / rate, [f"The rate of {rate:g} Hz is as stated."]
    stamps = judge_stamps(time, table.file, CURES.time)
    if rate is not None and abs(rate - stamps.rate) > 0.01 * stamps.rate:
        raise ExcitationError(
            f"{table.file}: --rate is {rate:g} Hz, the time column says {stamps.rate:.6g} Hz; leave one out"
        )
    if stamps.back:
        raise ExcitationError(
            f"{table.file}, line {table.lines[stamps.first_wrong]}: the time goes back; cut the recording there"
        )
    return time, [f"{stamps.rate:.6g} Hz by the time column.", *(f"{fault}." for fault in stamps.faults)]


def _axes(table: RecordedTable, choice: ImportChoice, rate: float) -> tuple[dict[str, Array], set[str], list[str]]:
    """Values [m/s^2] of the axes that there are, their columns, and what was assumed."""
    found: dict[str, str] = {}
    for axis, usual in NAMES.items():
        if axis in choice.axes:
            found[axis] = choice.axes[axis]
        elif not choice.axes:
            fitting = [name for name in usual if name in table.columns and table.units.get(name, "m/s^2") == "m/s^2"]
            found |= {axis: fitting[0]} if fitting else {}
    values = {}
    for axis, name in found.items():
        column = table.column(name.removeprefix("-"))
        own = bare_name(name.removeprefix("-")) in table.with_unit
        factor = choice.scale or (1.0 if own or choice.unit is None else UNITS[choice.unit])
        values[axis] = (-column if name.startswith("-") else column) * factor
    if not values:
        return {}, set(), ["No column was taken as an acceleration; --axes z=COLUMN names it."]
    stated = all(bare_name(name.removeprefix("-")) in table.with_unit for name in found.values())
    known = "m/s^2" if stated or choice.unit or choice.scale else None
    judged = judge_acceleration(values, rate, table.file, CURES, unit=known)
    notes = [f"{said[0].upper()}{said[1:]}." for said in (*judged.assumed, *judged.faults)]
    return values, {bare_name(name.removeprefix("-")) for name in found.values()}, notes


def _time_columns(table: RecordedTable, choice: ImportChoice) -> set[str]:
    if choice.time is not None:
        return {bare_name(part) for part in choice.time.split("+")}
    return {next((name for name in TIME_NAMES if name in table.columns), "")}


def _topic(name: str, kind: str) -> RecordedTopic:
    text, hashed = (
        (our_definition(kind), our_type_hash(kind)) if kind == SERIES else (definition(kind), type_hash(kind))
    )
    return RecordedTopic(name, f"/{name}", kind, text, hashed, "")


def _messages(
    axes: Mapping[str, Array],
    rest: Mapping[str, Array],
    stamps: NDArray[numpy.int64],
    units: Mapping[str, str],
    frame: str,
) -> Iterator[tuple[int, str, bytes]]:
    """Stamp, topic and bytes of each message, in the order of time."""
    for first in range(0, len(stamps), SAMPLES):
        part = slice(first, min(first + SAMPLES, len(stamps)))
        if rest:
            yield int(stamps[first]), REST, _series(rest, part, stamps, units, frame)
        if axes:
            for place in range(part.start, part.stop):
                yield int(stamps[place]), ACCELERATION, _imu(axes, place, int(stamps[place]), frame)


def _series(
    rest: Mapping[str, Array], part: slice, stamps: NDArray[numpy.int64], units: Mapping[str, str], frame: str
) -> bytes:
    count = part.stop - part.start
    period = float(stamps[part.stop - 1] - stamps[part.start]) / SECOND / max(count - 1, 1)
    series = Series(
        block=part.start // SAMPLES, sample_period=period, names=tuple(rest),
        units=tuple(units.get(name, "") for name in rest), values=numpy.stack([column[part] for column in rest.values()]),
    )  # fmt: skip
    return encode(series, int(stamps[part.start]), frame)


def _imu(axes: Mapping[str, Array], place: int, stamp: int, frame: str) -> bytes:
    """A sample; an axis that was not recorded is NaN, orientation and angular velocity are not given (REP 145)."""
    not_given = numpy.zeros(9)
    not_given[0] = NOT_GIVEN
    x, y, z = (float(axes[axis][place]) if axis in axes else numpy.nan for axis in "xyz")
    return encoded(
        Imu(
            header=header(stamp, frame),
            orientation=Quaternion(x=0.0, y=0.0, z=0.0, w=1.0), orientation_covariance=not_given,
            angular_velocity=vector(), angular_velocity_covariance=not_given,
            linear_acceleration=vector(x, y, z), linear_acceleration_covariance=numpy.zeros(9),
        )
    )  # fmt: skip
