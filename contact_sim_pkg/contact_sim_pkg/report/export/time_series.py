"""A topic as arrays over time, as the library and a bench that is stepped give it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

from contact_sim_pkg.records.table import table_html
from contact_sim_pkg.report.export.table import TopicTable

__all__ = ["Series", "series_of"]


@dataclass(frozen=True)
class Series:
    """A topic of a bag, one row a sample.

    Attributes:
        topic: its full name.
        time: of each row [s].
        columns: arrays [rows] by name.
        units: by name of the column; empty where there is none.
    """

    topic: str
    time: NDArray[Any]
    columns: dict[str, NDArray[Any]]
    units: dict[str, str]

    def __getitem__(self, column: str) -> NDArray[Any]:
        """A column. Raises KeyError, which names those that are there."""
        if column not in self.columns:
            raise KeyError(f"{self.topic} has no column {column!r}; it has {', '.join(self.columns)}")
        return self.columns[column]

    def __iter__(self) -> Iterator[str]:
        """Names of the columns."""
        return iter(self.columns)

    def __len__(self) -> int:
        """Number of rows."""
        return len(self.time)

    def _repr_html_(self) -> str:
        numbers = [name for name in self.columns if self.columns[name].dtype.kind in "biuf" and len(self)]
        rows = [
            {"column": name, "unit": self.units[name], "smallest": f"{self[name].min():.6g}",
             "largest": f"{self[name].max():.6g}"}
            for name in numbers
        ]  # fmt: skip
        span = f", {self.time[0]:.6g} to {self.time[-1]:.6g} s" if len(self) else ""
        return table_html(rows, f"{self.topic}: {len(self)} rows{span}")

    def to_pandas(self) -> Any:
        """A pandas DataFrame, its index the time [s]. Raises ImportError where pandas is not
        installed.
        """
        import pandas

        return pandas.DataFrame(self.columns, index=pandas.Index(self.time, name="time"))


def series_of(table: TopicTable) -> Series:
    """The columns of a topic whose first one is the time."""
    time, *columns = table.columns
    return Series(
        table.topic,
        time.values,
        {each.name: each.values for each in columns},
        {each.name: each.unit for each in columns},
    )
