"""What the library answers of bags: metrics with their verdicts, and two bags side by side."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from typing import Any, Protocol, TypeVar

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.compare.estimated import Above, above_request, accuracy_numbers
from contact_sim_pkg.compare.side_by_side import ComparedMetric, side_by_side
from contact_sim_pkg.records.metric import Metric
from contact_sim_pkg.records.table import table_html
from contact_sim_pkg.report.comparison.curves import compared
from contact_sim_pkg.report.comparison.rows import table_rows
from contact_sim_pkg.report.comparison.runs import distinct_names
from contact_sim_pkg.report.metrics.foreign import ForeignOptions, foreign_metrics
from contact_sim_pkg.report.metrics.listing import metrics_of
from contact_sim_pkg.report.metrics.of_bag import is_ours, recording_of
from contact_sim_pkg.report.metrics.views import lines_of, rows_of, value_text, verdict_line, verdict_text
from contact_sim_pkg.report.reading import refuse_other_rigs, rig_of_bag

__all__ = ["Answers", "compare", "metrics"]


class Keyed(Protocol):
    """What has a stable name."""

    @property
    def key(self) -> str:
        """`seat.SEAT`."""


Record = TypeVar("Record", bound=Keyed)


class Answers(Sequence[Record]):
    """Records in their order, each by its key as well: ``bag.metrics()["seat.SEAT"].value``. In a notebook it is a table.

    Attributes:
        rows: what is shown, a dict a record.
        sentence: all of it in one line; empty where there is none.
    """

    def __init__(self, records: Sequence[Record], rows: Sequence[Mapping[str, Any]], text: str, sentence: str) -> None:
        """Take the records and how they are shown."""
        self._records, self.rows, self._text, self.sentence = tuple(records), list(rows), text, sentence

    def keys(self) -> list[str]:
        """Keys of the records."""
        return [each.key for each in self._records]

    def __getitem__(self, key: Any) -> Any:
        """The record of a key, or at a place. Raises KeyError with the keys that are nearest, IndexError."""
        if not isinstance(key, str):
            return self._records[key]
        for each in self._records:
            if each.key == key:
                return each
        raise KeyError(f"there is no {key!r}; nearest are {', '.join(get_close_matches(key, self.keys(), 3, 0.0))}")

    def __len__(self) -> int:
        return len(self._records)

    def __str__(self) -> str:
        return self._text

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return table_html(self.rows, self.sentence)

    def to_pandas(self) -> Any:
        """The rows as a pandas DataFrame. Raises ImportError where pandas is not installed."""
        import pandas

        return pandas.DataFrame(self.rows)


def metrics(bag: Bag) -> Answers[Metric]:
    """The metrics of a bag of the bench; of a bag of anybody what its vibration gives. Raises BagError where there is
    nothing to measure.
    """
    recording = recording_of(bag) if is_ours(bag) else None
    found = foreign_metrics(bag, ForeignOptions())[0] if recording is None else metrics_of(recording)
    above = Above() if recording is None else above_request(accuracy_numbers(recording))
    rows, sentence = rows_of(found), verdict_line(rows_of(found), above)
    shown = [
        {"key": each.key, "metric": each.name, "value": value_text(each), "verdict": verdict_text(each),
         "band": "" if each.band is None else each.band.text}
        for each in found
    ]  # fmt: skip
    return Answers(found, shown, "\n".join([*lines_of(rows), sentence]), sentence)


def compare(*bags: Bag) -> Answers[ComparedMetric]:
    """The metrics of bags of one rig side by side, what moved most first: those of `bench compare`.

    Raises BagError where they are of different rigs, or have no metrics.
    """
    refuse_other_rigs([rig_of_bag(each) for each in bags])
    recordings = [recording_of(each) for each in bags]
    names = distinct_names(recordings)
    sides = side_by_side([compared(name, each) for name, each in zip(names, recordings, strict=True)])
    if not sides:
        raise BagError(f"{', '.join(names)} have no metrics: there is nothing to compare")
    rows = [{"key": side.key, **row} for side, row in zip(sides, table_rows(names, sides), strict=True)]
    widths = {name: max(len(name), *(len(str(row[name])) for row in rows)) for name in rows[0]}
    lines = ["  ".join(str(row[name]).ljust(widths[name]) for name in widths).rstrip()
             for row in ({name: name for name in widths}, *rows)]  # fmt: skip
    return Answers(sides, rows, "\n".join(lines), "")
