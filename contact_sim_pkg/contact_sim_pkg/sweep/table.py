"""The table of a sweep: a row a case, in the order of the cases, whatever order they ended in."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import IO, Any, NamedTuple

import numpy

from contact_sim_pkg.records.table import table_html
from contact_sim_pkg.sweep.case import FINISHED, Row
from contact_sim_pkg.sweep.variation import Values

__all__ = ["MetricRange", "SweepTable"]

AFTER = ("verdict", "error", "spread")
TIMES = ("wall_s", "cpu_s")


class MetricRange(NamedTuple):
    """What a metric does over the cases."""

    metric: str
    unit: str
    smallest: float
    largest: float
    smallest_in: int
    """number of the case"""
    largest_in: int
    moved_by: str
    """key that it follows most, and the rank correlation"""


class SweepTable(Sequence[Mapping[str, Any]]):
    """The cases of a sweep and what they gave. In a notebook it is a table; ``to_pandas`` where pandas is installed.

    Attributes:
        keys: that vary.
        cases: values and row of each, in their order.
        columns: of a row: `number`, the keys, `outcome`, `sentence`, each metric with `[unit]`, its verdict, numerical error
            and spread; `wall_s`, `cpu_s`, `case`, `machine`.
    """

    def __init__(self, values: Sequence[Values], rows: Sequence[Row]) -> None:
        """Of the ``values`` of all cases and the ``rows`` of those that ended, in any order."""
        self.keys = list(dict.fromkeys(key for each in values for key in each))
        by_number = {row["number"]: row for row in rows}
        self.cases = [(values[number], by_number[number]) for number in sorted(by_number)]
        self._units = {each["key"]: each["unit"] for _, row in self.cases for each in row["metrics"]}
        self.columns = [
            "number", *self.keys, "outcome", "sentence",
            *(name for key in self._units for name in (self._column(key), *(f"{key} {after}" for after in AFTER))),
            *TIMES, "case", "machine",
        ]  # fmt: skip
        self._rows = [self._row(given, row) for given, row in self.cases]

    def __len__(self) -> int:
        return len(self._rows)

    def __getitem__(self, place: Any) -> Any:
        """The row at a place, or the column of a name [cases]."""
        if isinstance(place, str):
            name = self._column(place) if place in self._units else place
            if name not in self.columns:
                raise KeyError(f"there is no column {place!r}; there are {', '.join(self.columns)}")
            return numpy.array([row[name] for row in self._rows])
        return self._rows[place]

    @property
    def failed(self) -> list[Mapping[str, Any]]:
        """Rows of cases that did not finish."""
        return [row for row in self._rows if row["outcome"] != FINISHED]

    def ranges(self) -> list[MetricRange]:
        """What each metric does over the cases that finished; one that is a number in none is left out."""
        found = []
        for key, unit in self._units.items():
            column = self[key].astype(numpy.float64)
            known = numpy.flatnonzero(numpy.isfinite(column))
            if known.size:
                low, high = known[column[known].argmin()], known[column[known].argmax()]
                least, most = (self._rows[place]["number"] for place in (low, high))
                found.append(
                    MetricRange(
                        key, unit, float(column[low]), float(column[high]), least, most, self._moved_by(column, known)
                    )
                )
        return found

    def csv(self) -> str:
        """All of it as CSV."""
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(self.columns)
        writer.writerows([_text(row[name]) for name in self.columns] for row in self._rows)
        return text.getvalue()

    def write_parquet(self, stream: IO[bytes]) -> None:
        """The same as Apache Parquet: numbers as such, what is unknown as null. Raises ImportError without pyarrow."""
        pyarrow, parquet = import_module("pyarrow"), import_module("pyarrow.parquet")
        arrays = [pyarrow.array(_of_one_type([row[name] for row in self._rows])) for name in self.columns]
        parquet.write_table(pyarrow.Table.from_arrays(arrays, names=self.columns), stream, compression="zstd")

    def to_pandas(self) -> Any:
        """A pandas DataFrame. Raises ImportError where pandas is not installed."""
        import pandas

        return pandas.DataFrame(self._rows, columns=self.columns)

    def _repr_html_(self) -> str:
        shown = ["number", *self.keys, "outcome", *(self._column(key) for key in self._units)]
        said = f"{len(self)} cases, {len(self.failed)} did not finish"
        return table_html([{name: row[name] for name in shown} for row in self._rows], said)

    def _column(self, key: str) -> str:
        return f"{key} [{self._units[key]}]" if self._units[key] else key

    def _row(self, given: Values, row: Row) -> dict[str, Any]:
        found: dict[str, Any] = dict.fromkeys(self.columns, math.nan)
        found.update({key: _number(given.get(key, "")) for key in self.keys})
        found.update({name: row.get(name, "") for name in ("number", "outcome", "sentence", "case", "machine")})
        found.update(wall_s=row.get("wall", math.nan), cpu_s=row.get("cpu", math.nan))
        found.update({f"{key} verdict": "" for key in self._units})
        for metric in row["metrics"]:
            key = metric["key"]
            found[f"{key} verdict"] = "doubtful" if metric["broken"] else metric["verdict"]
            for name, column in (("value", self._column(key)), ("error", f"{key} error"), ("spread", f"{key} spread")):
                if metric[name] is not None:
                    found[column] = metric[name]
        return found

    def _moved_by(self, column: Any, known: Any) -> str:
        """The key whose ranks go most with those of a metric: Spearman's correlation, of keys that are numbers."""
        from scipy.stats import spearmanr

        best, name = 0.0, ""
        for key in self.keys:
            given = [self._rows[place][key] for place in known]
            if len(given) < 3 or any(isinstance(each, str) for each in given) or len(set(given)) < 2:
                continue
            if numpy.ptp(column[known]) > 0.0:
                found = float(spearmanr(given, column[known]).statistic)
                if abs(found) > abs(best):
                    best, name = found, key
        return f"{name} ({best:+.2f})" if name else ""


def _number(text: str) -> float | str:
    """A value as a number where it is one."""
    try:
        return float(text)
    except ValueError:
        return text


def _of_one_type(column: Sequence[Any]) -> list[Any]:
    """A column of numbers, nan as None, or of texts where one of them is a text."""
    if any(isinstance(each, str) for each in column):
        return [_text(each) for each in column]
    return [None if isinstance(each, float) and math.isnan(each) else each for each in column]


def _text(value: Any) -> str:
    """A cell: of a number its shortest text that reads back to the same bits, of what is unknown nothing."""
    if isinstance(value, float):
        return "" if math.isnan(value) else repr(value)
    return str(value)
