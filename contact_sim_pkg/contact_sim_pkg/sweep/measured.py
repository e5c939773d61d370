"""What a fit is compared with: points, a row of a table each, or a series over time."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.files import BAG_ENDINGS
from contact_sim_pkg.report.export.table import table_of
from contact_sim_pkg.sweep.variation import SweepError, Values, read_rows

__all__ = ["Points", "Series", "read_points", "read_series"]

Field = NDArray[numpy.float64]
FEWEST_SAMPLES = 50
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
    if path.is_dir() or path.suffix in BAG_ENDINGS:
        topic, _, column = name.rpartition(".")
        time, *columns = table_of(open_bag(path), topic).columns
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
    return Series(name, *found)


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
