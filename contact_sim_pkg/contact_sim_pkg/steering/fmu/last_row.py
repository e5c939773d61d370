"""The last row of a topic's table, without the table: a unit needs no more of a step."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.bag.columns import own_name
from contact_sim_pkg.bag.topics import topic_of
from contact_sim_pkg.records.definitions import definition_of
from contact_sim_pkg.report.export.table import PERIODS, sorted_fields
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.steering.fmu.variables import TIME

__all__ = ["BEFORE", "LastRows"]

NANOSECONDS = 1_000_000_000
BEFORE = -1.0
"""Time of a topic's row before there is one; its other values are 0."""

Values = NDArray[numpy.float64]


class LastRows:
    """Values of columns, kept up to date step by step."""

    def __init__(self, columns: Sequence[tuple[str, str]]) -> None:
        """Of columns by topic and name, in this order. Raises RunError for a column that the bench does not have."""
        self.values: Values = numpy.zeros(len(columns))
        by_topic: dict[str, dict[str, int]] = {}
        for place, (topic, column) in enumerate(columns):
            by_topic.setdefault(topic, {})[column] = place
        self._topics = {topic: _Row(topic, places) for topic, places in by_topic.items()}
        self.clear()

    def clear(self) -> None:
        """Go back to before the first row."""
        self.values[:] = 0.0
        for row in self._topics.values():
            self.values[row.time] = BEFORE

    def take(self, outputs: list[Output]) -> None:
        """Take the last row of each topic of a step."""
        waiting = dict(self._topics)
        for each in reversed(outputs):
            row = waiting.get(each.topic)
            if row is not None and row.take(each, self.values):
                del waiting[each.topic]
                if not waiting:
                    break


class _Row:
    """The columns of one topic."""

    def __init__(self, topic: str, places: dict[str, int]) -> None:
        left = dict(places)
        definition = definition_of(topic_of(topic).type.rpartition("/")[2])
        fields = sorted_fields(list(definition.record_fields))
        self.time = left.pop(TIME)
        self._scalars = [
            (field.name, left.pop(name)) for field in fields.scalars if (name := own_name(field.name)) in left
        ]
        self._arrays = [
            (field.name, left.pop(name)) for field in fields.arrays if (name := own_name(field.name)) in left
        ]
        self._named = [
            _Named(
                field.name,
                field.shape[0],
                {name: left.pop(name) for name in [*left] if name.startswith(f"{field.name}.")},
            )
            for field in fields.named
        ]
        if left:
            raise RunError(
                f"{topic} has no column {', '.join(left)}, which the unit was exported with; export it again"
            )
        known = {field.name for field in definition.record_fields}
        self._period = next((name for name in PERIODS if name in known), "")

    def take(self, output: Output, values: Values) -> bool:
        """Write the last row of a record; False where it has none."""
        record = output.record
        arrays = [(getattr(record, name), place) for name, place in self._arrays]
        named = [(each, each.rows(record)) for each in self._named if each.places.size]
        # as many rows as the longest array; one where the topic has none
        sizes = [*(len(array) for array, _ in arrays), *(part.shape[1] for _, part in named)]
        rows = max(sizes, default=1)
        if rows == 0:
            return False
        period = float(getattr(record, self._period)) if self._period else 0.0
        values[self.time] = output.stamp / NANOSECONDS + (rows - 1) * period
        for name, place in self._scalars:
            values[place] = getattr(record, name)
        for array, place in arrays:
            values[place] = array[-1] if len(array) == rows else numpy.nan
        for each, part in named:
            values[each.places] = part[each.order, -1] if part.shape[1] == rows else numpy.nan
        return True


class _Named:
    """Columns of one field with a row for each name, such as the positions of bodies."""

    def __init__(self, field: str, sides: str, places: dict[str, int]) -> None:
        self.places = numpy.array([*places.values()], dtype=numpy.int64)
        self.order: NDArray[numpy.int64] = self.places
        """Rows of the columns in the record that came last."""
        self._field, self._sides = field, sides
        self._columns = [name.removeprefix(f"{field}.") for name in places]
        self._names: list[str] = []

    def rows(self, record: Any) -> Values:
        """[names, samples]. Raises RunError where a name is gone."""
        names = list(getattr(record, self._sides))
        if names != self._names:
            if missing := set(self._columns) - set(names):
                raise RunError(
                    f"{self._field} has no {', '.join(sorted(missing))} here, which the unit was exported with"
                )
            self._names, self.order = (
                names,
                numpy.array([names.index(name) for name in self._columns], dtype=numpy.int64),
            )
        found: Values = numpy.asarray(getattr(record, self._field)).reshape(len(names), -1)
        return found
