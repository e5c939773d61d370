"""What a fit is compared with: points, a row of a table each, a series over time, or a transmissibility over frequency."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from ruamel.yaml import YAML
from scipy import interpolate

from contact_sim_pkg.bag.reader import Bag, open_bag
from contact_sim_pkg.files import BAG_ENDINGS
from contact_sim_pkg.report.export.table import table_of
from contact_sim_pkg.report.metrics.of_bag import recording_of
from contact_sim_pkg.report.signal.spectrum import magnitude_spread
from contact_sim_pkg.rigs.vehicle.seat.report.response import TRUSTED_COHERENCE, transmissibility_curve
from contact_sim_pkg.rigs.vehicle.seat.report.ride import RideSignals, ride_signals
from contact_sim_pkg.scene.schema.accuracy import requested
from contact_sim_pkg.sweep.variation import SweepError, Values, read_rows

__all__ = ["BY", "Measured", "MeasuredResponse", "Points", "Series", "read_measured", "read_points", "read_response",
           "read_series"]  # fmt: skip

Field = NDArray[numpy.float64]
SERIES, SPECTRUM, TRANSMISSIBILITY = BY = "series", "spectrum", "transmissibility"
"""What of a recording is compared."""
FEWEST_SAMPLES, FEWEST_POINTS = 50, 3
UNIT = re.compile(r"(?P<name>.*?)\s*\[(?P<unit>[^\]]*)\]")


class Points(NamedTuple):
    """Measured metrics of several cases."""

    values: list[Values]
    """what each case sets"""
    metrics: list[str]
    """keys of `bench metrics`"""
    units: dict[str, str]
    """of those whose column has one"""
    measured: Field
    """[cases, metrics]; nan where a cell is empty"""
    scatter: Field | None
    """standard deviation of each, so too; None where no column has one"""


class Series(NamedTuple):
    """A measured column over time."""

    name: str
    """`topic.column`"""
    time: Field
    """[s], increasing"""
    values: Field
    request: float = 0.0
    """accuracy that the run requested which a bag of the bench holds, whose own numerical error it carries; 0: none"""


class MeasuredResponse(NamedTuple):
    """A measured transmissibility from floor to seat."""

    frequency: Field
    """[Hz], increasing"""
    magnitude: Field
    """> 0"""
    spread: Field | None
    """standard deviation of the magnitude by chance, over the magnitude; None where it is not known"""
    request: float = 0.0
    """accuracy that a run requested which a bag of the bench holds; 0: none"""


Measured = Points | Series | MeasuredResponse


def read_measured(path: Path, metrics: Sequence[str], series: Sequence[str], by: str) -> Measured:
    """What `bench fit` compares with.

    Args:
        path: of the table or bag.
        metrics: columns of a table of points; none of a recording.
        series: `topic.column` of a recording; of a transmissibility the accelerations of floor and seat, or none.
        by: one of `BY`.

    Raises:
        SweepError, BagError: these do not go together, or the file does not hold them.
    """
    if by not in BY:
        raise SweepError(f"by {by!r}: is none of {', '.join(BY)}")
    if by == TRANSMISSIBILITY:
        if metrics or len(series) not in (0, 2):
            raise SweepError(
                "--by transmissibility takes a table over frequency or a bag of the bench as it is, or --series of the "
                "floor's and --series of the seat's acceleration in a recording"
            )
        return read_response(path, series)
    if bool(metrics) == bool(series) or len(series) > 1:
        raise SweepError("give --metric NAME for a table of points, or one --series TOPIC.COLUMN for a recording")
    return read_series(path, series[0]) if series else read_points(path, [*metrics])


def read_points(path: Path, metrics: list[str]) -> Points:
    """A CSV table: columns named as ``metrics`` (with ` [unit]` behind, if any) hold what was measured, those named
    ``METRIC scatter`` its standard deviation, the others keys of the scene. A row is a case. So is the table of a sweep,
    of which columns that are neither key nor metric are left out.

    Raises SweepError for a table that has none of the metrics, or no numbers.
    """
    if not path.is_file():
        raise SweepError(
            f"{path}: there is no such file; --to is a table of points, or with --by TOPIC.COLUMN a recording"
        )
    rows = read_rows(path)
    if len(rows) < 2:
        raise SweepError(f"{path}: needs a header and a row a case")
    named = [_name_and_unit(each) for each in rows[0]]
    header, units = [name for name, _ in named], {name: unit for name, unit in named if unit}
    missing = [each for each in metrics if each not in header]
    if missing:
        raise SweepError(f"{path}: has no column {missing[0]}; it has {', '.join(header)}")
    keys = [name for name in header if "." in name and not _is_of_metric(name, header, metrics)]
    table = [dict(zip(header, row, strict=False)) for row in rows[1:]]
    values = [{key: row[key] for key in keys if row.get(key)} for row in table]
    measured = numpy.array([[_number(path, row.get(each, "")) for each in metrics] for row in table])
    names = [f"{each} scatter" for each in metrics]
    scatter = None
    if all(name in header for name in names):
        scatter = numpy.array([[_number(path, row.get(each, "")) for each in names] for row in table])
        if not (scatter[numpy.isfinite(measured)] > 0.0).all():
            raise SweepError(f"{path}: a scatter is not above 0; leave the column out where it is not known")
    if not numpy.isfinite(measured).any():
        raise SweepError(f"{path}: holds no number of {', '.join(metrics)}")
    return Points(values, metrics, {each: units[each] for each in metrics if each in units}, measured, scatter)


def _name_and_unit(title: str) -> tuple[str, str]:
    """Of `tire.stiffness [kN/m]`."""
    found = UNIT.fullmatch(title)
    return (title, "") if found is None else (found["name"], found["unit"])


def _is_of_metric(name: str, header: list[str], metrics: list[str]) -> bool:
    """Whether a column is a metric, asked for or not, or says something of one: the table of a sweep has a verdict for
    each.
    """
    metric = name.rpartition(" ")[0] if name.endswith((" verdict", " error", " spread", " scatter")) else name
    return metric in metrics or f"{metric} verdict" in header or metric != name


def _number(path: Path, text: str) -> float:
    try:
        return float(text) if text else numpy.nan
    except ValueError:
        raise SweepError(f"{path}: {text!r:.40} is no number") from None


def read_series(path: Path, name: str) -> Series:
    """The column ``topic.column`` of a bag, or the last part of that name in a CSV table whose first column is the time.

    Raises SweepError, BagError where there is none, or its time does not increase.
    """
    request = 0.0
    if path.is_dir() or path.suffix in BAG_ENDINGS:
        topic, _, column = name.rpartition(".")
        bag = open_bag(path)
        request = _request_of(bag)
        time, *columns = table_of(bag, topic).columns
        by_name = {each.name: each.values for each in columns}
        if column not in by_name:
            raise SweepError(f"{path}: {topic} has no column {column!r}; it has {', '.join(by_name)}")
        found = numpy.asarray(time.values, float), numpy.asarray(by_name[column], float)
    else:
        found = _columns_of_csv(path, name)
    if len(found[0]) < FEWEST_SAMPLES or not (numpy.diff(found[0]) > 0.0).all():
        raise SweepError(f"{path}: {name} needs {FEWEST_SAMPLES} samples or more, whose time increases")
    if not numpy.isfinite(found).all():
        raise SweepError(f"{path}: {name} has a sample that is no number")
    return Series(name, *found, request)


def _request_of(bag: Bag) -> float:
    """Accuracy that the run of a bag requested; 0 where no run of the bench made it."""
    if bag.scene is None:
        return 0.0
    scene = YAML(typ="safe").load(bag.scene)
    return requested(scene.get("accuracy", 0.0)) if isinstance(scene, dict) else 0.0


def _columns_of_csv(path: Path, name: str) -> tuple[Field, Field]:
    if not path.is_file():
        raise SweepError(f"{path}: there is no such file")
    rows = read_rows(path)
    header = [_name_and_unit(each)[0] for each in rows[0]] if rows else []
    column = next((each for each in (name, name.rpartition(".")[2]) if each in header[1:]), None)
    if column is None:
        raise SweepError(f"{path}: has no column {name.rpartition('.')[2]} behind its time; it has {', '.join(header)}")
    place = header.index(column)
    short = next((number for number, row in enumerate(rows[1:], 2) if len(row) <= place), None)
    if short is not None:
        raise SweepError(f"{path}: row {short} has no value of {column}")
    found = numpy.array([[_number(path, row[each]) for each in (0, place)] for row in rows[1:]]).reshape(-1, 2)
    return found[:, 0], found[:, 1]


def read_response(path: Path, series: Sequence[str] = ()) -> MeasuredResponse:
    """T(f) of a CSV table with the columns `frequency` and `magnitude`, of a bag of the bench, or of a recording with the
    accelerations of floor and seat as two ``series``.

    The spread of a line follows from its coherence and the segments averaged (`magnitude_spread`); in a table these
    are the columns `coherence` and `segments`. Lines that are not coherent are left out.

    Raises SweepError, BagError where there is none.
    """
    if not series and not (path.is_dir() or path.suffix in BAG_ENDINGS):
        return _response_of_table(path)
    is_bag = path.is_dir() or path.suffix in BAG_ENDINGS
    signals = _two_accelerations(path, series) if series else ride_signals(recording_of(open_bag(path)).motion)
    if signals is None:
        raise SweepError(
            f"{path}: holds no motion of a seat on its floor; name two accelerations: --series of the floor, --series of the "
            "seat"
        )
    curve = transmissibility_curve(signals)
    known = None if curve is None else numpy.isfinite(curve.y) & (curve.y > 0.0)
    if curve is None or curve.spread is None or known is None or known.sum() < FEWEST_POINTS:
        raise SweepError(
            f"{path}: the seat does not follow the floor: the coherence of T(f) is below {TRUSTED_COHERENCE}"
        )
    request = _request_of(open_bag(path)) if is_bag else 0.0
    return MeasuredResponse(curve.x[known], curve.y[known], curve.spread[known], request)


def _two_accelerations(path: Path, series: Sequence[str]) -> RideSignals:
    """Floor and seat at the times of the slower of two series, as long as both are there."""
    floor, seat = (read_series(path, each) for each in series)
    period = max(float(numpy.median(numpy.diff(each.time))) for each in (floor, seat))
    begin, end = max(floor.time[0], seat.time[0]), min(floor.time[-1], seat.time[-1])
    count = int((end - begin) / period + 1e-6) + 1 if end > begin else 0
    if count < FEWEST_SAMPLES:
        raise SweepError(
            f"{path}: {series[0]} and {series[1]} have {count} samples in common, {FEWEST_SAMPLES} are needed"
        )
    time = numpy.minimum(begin + period * numpy.arange(count), end)
    paths = (interpolate.Akima1DInterpolator(each.time, each.values, method="makima") for each in (floor, seat))
    return RideSignals(time, 1.0 / period, *(numpy.asarray(each(time)) for each in paths))


def _response_of_table(path: Path) -> MeasuredResponse:
    if not path.is_file():
        raise SweepError(f"{path}: there is no such file")
    rows = read_rows(path)
    header = [_name_and_unit(each)[0] for each in rows[0]] if rows else []
    missing = [each for each in ("frequency", "magnitude") if each not in header]
    if missing:
        raise SweepError(
            f"{path}: has no column {missing[0]}; T(f) has frequency [Hz] and magnitude, and coherence and segments where "
            "they are known"
        )
    if ("coherence" in header) != ("segments" in header):
        raise SweepError(f"{path}: coherence says what T(f) is known to only beside segments, the number averaged")
    table = [dict(zip(header, row, strict=False)) for row in rows[1:]]
    named = ["frequency", "magnitude", *(["coherence", "segments"] if "coherence" in header else [])]
    columns = {name: numpy.array([_number(path, row.get(name, "")) for row in table]) for name in named}
    inside = columns.get("coherence", numpy.ones(len(table))) >= TRUSTED_COHERENCE
    frequency, magnitude = (columns[name][inside] for name in ("frequency", "magnitude"))
    is_curve = bool((numpy.diff(frequency) > 0.0).all() and (magnitude > 0.0).all() and (frequency > 0.0).all())
    if frequency.size < FEWEST_POINTS or not is_curve:
        raise SweepError(
            f"{path}: T(f) needs {FEWEST_POINTS} rows or more with a magnitude above 0, a coherence of {TRUSTED_COHERENCE} "
            "at least, and a frequency that increases"
        )
    if "coherence" not in columns:
        return MeasuredResponse(frequency, magnitude, None)
    coherence, segments = (columns[name][inside] for name in ("coherence", "segments"))
    if not ((coherence <= 1.0) & (segments >= 2.0)).all():
        raise SweepError(f"{path}: a coherence is at most 1, of 2 segments or more")
    return MeasuredResponse(frequency, magnitude, magnitude_spread(coherence, segments))
