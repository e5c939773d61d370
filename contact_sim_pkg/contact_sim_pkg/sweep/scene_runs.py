"""The runs of a fit: what a scene gives at places of its free keys, by cases over processes, each place once."""

from __future__ import annotations

import copy
import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.run.tables_between import STRESSES, KeyRange
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.sweep.case import FINISHED, Row, Task, scene_of, sources_hash
from contact_sim_pkg.sweep.measured import Measured, MeasuredResponse, Points, Series
from contact_sim_pkg.sweep.pool import Workers
from contact_sim_pkg.sweep.sensor import FILTER, is_of_sensor, low_passed
from contact_sim_pkg.sweep.sweep import Notify, texts_of
from contact_sim_pkg.sweep.variation import SweepError, Values, Variation

__all__ = ["Runs", "SceneRuns"]

Field = NDArray[numpy.float64]
CUSHION_KEY = re.compile(r"effects\.(seat)\.cushion\.(\w+)")


class Runs(Protocol):
    """What the scene gives at places in [0, 1], each parameter between its bounds."""

    free: Sequence[Variation]
    count: int
    """runs so far"""
    accuracy: float
    """that the runs request"""
    is_held: bool
    """whether that stays"""
    end: float | None
    """[s] to which a run is needed; None: all of it"""

    def __call__(self, places: Sequence[Field]) -> list[Field]:
        """Of each place, of points the metrics [cases, metrics], of a series its times and values [2, samples], of a
        transmissibility frequencies, magnitudes and their spreads [3, lines].
        """

    def values_at(self, place: Field) -> Values:
        """What a place sets."""

    def without(self, effect: str) -> Runs | None:
        """Those of the scene without an effect, over the other keys; None where it cannot be left out."""


class SceneRuns:
    """What the scene gives at parameters, by cases."""

    def __init__(
        self, scene: str, to: Measured, cases: Sequence[Values], free: Sequence[Variation], folder: Path,
        workers: Workers, notify: Notify, sensor: Values | None = None,
    ) -> None:  # fmt: skip
        self._scene, self._to, self._cases, self.free = scene, to, cases, free
        self._folder, self._workers, self._notify = folder, workers, notify
        self._sensor = sensor or {}
        self.count = 0
        self.accuracy, self.is_held = 0.0, True
        self.end: float | None = None
        block = scene_of(scene, texts_of(cases[0])).data
        self._whole, self._block = float(block["duration"]), float(block["block_length"])
        self._known: dict[tuple[KeyRange | None, tuple[str, ...]], Field] = {}
        self._accuracies: set[float] = set()
        self._over = _tables_over(free, cases, block)

    def __call__(self, places: Sequence[Field]) -> list[Field]:
        cases, settings = self._cases, self._settings()
        series = self._to.name if isinstance(self._to, Series) else ""
        is_response = isinstance(self._to, MeasuredResponse)
        named = [texts_of({**self.values_at(place), **settings}) for place in places]
        tables = self._tables(len(set(named)))
        new = [texts for texts in dict.fromkeys(named) if (tables, texts) not in self._known]
        tasks = [
            Task(len(cases) * i + j, self._scene, (*texts_of(case), *texts), str(self._folder.absolute()), False,
                 sources_hash(), series, is_response, tables)
            for i, texts in enumerate(new) for j, case in enumerate(cases)
        ]  # fmt: skip
        rows: dict[int, Row] = {}
        for row in self._workers.run(tasks):
            if row["outcome"] != FINISHED:
                raise SweepError(f"{' '.join(tasks[row['number']].values)} did not finish: {row['sentence']}")
            rows[row["number"]] = row
            self._notify(f"{self.count + len(rows)} runs", 0.0)
        self.count += len(tasks)
        for i, texts in enumerate(new):
            self._known[tables, texts] = self._given([rows[len(cases) * i + j] for j in range(len(cases))])
        return [self._sensed(self._known[tables, texts], place) for texts, place in zip(named, places, strict=True)]

    def _sensed(self, given: Field, place: Field) -> Field:
        """What a run gives behind the sensor."""
        found = {each.key: each.at(float(part)) for each, part in zip(self.free, place, strict=True)}
        frequency = {**self._sensor, **found}.get(FILTER)
        return given if frequency is None else low_passed(given, float(frequency))

    def values_at(self, place: Field) -> Values:
        """What a place sets of the scene."""
        both = zip(self.free, place, strict=True)
        return {each.key: each.at(float(part)) for each, part in both if not is_of_sensor(each.key)}

    def without(self, effect: str) -> Runs | None:
        """Those of the scene without an effect, over the other keys; None where it cannot be left out."""
        found = copy.copy(self)
        found.free = [each for each in self.free if not each.key.startswith(f"{effect}.")]
        found._cases = [{**case, effect: "null"} for case in self._cases]
        found._known, found.count = {}, 0
        middle = {each.key: each.at(0.5) for each in found.free if not is_of_sensor(each.key)}
        try:
            block = scene_of(self._scene, texts_of({**found._cases[0], **middle})).data
        except SceneError:
            return None
        found._over = _tables_over(found.free, found._cases, block)
        return found

    def _tables(self, places: int) -> KeyRange | None:
        """Between which tables the next runs take their cushion's. One that is only looked at, at an accuracy of smaller cells,
        has its own: the others would be for nothing.
        """
        if self._over is not None and self.accuracy not in self._accuracies and places == 1:
            return self._over._replace(is_own=True)
        self._accuracies.add(self.accuracy)
        return self._over

    def _settings(self) -> Values:
        """Accuracy and duration where they are not those of the scene."""
        found: Values = {} if self.is_held else {"accuracy": f"{self.accuracy:.6g}"}
        blocks = math.inf if self.end is None else math.ceil(self.end / self._block) + 2
        if blocks * self._block < self._whole:
            found["duration"] = f"{blocks * self._block:.9g}"
        return found

    def _given(self, rows: Sequence[Row]) -> Field:
        if isinstance(self._to, Points):
            return numpy.array(
                [[_metric(row, each, self._to.units.get(each)) for each in self._to.metrics] for row in rows]
            )
        names = ("x", "y", "spread") if isinstance(self._to, MeasuredResponse) else ("time", "values")
        return numpy.array([rows[0][name] for name in names])


def _tables_over(free: Sequence[Variation], cases: Sequence[Values], data: Mapping[str, Any]) -> KeyRange | None:
    """The range between whose tables runs take their cushion's: of the only free key of a seat's cushion, whose maps are not
    recorded; None where there is no such key.
    """
    set_by_cases = {key for case in cases for key in case if len({each.get(key) for each in cases}) > 1}
    found = [(each, match) for each in free if (match := CUSHION_KEY.fullmatch(each.key))]
    if len(found) != 1 or any(each.startswith("effects") for each in set_by_cases):
        return None
    ((variation, match),) = found
    contact, key = match.groups()
    if (
        key not in STRESSES
        or (data["effects"].get(contact) or {}).get("contact_field") is not None
        or not variation.low > 0.0
    ):
        return None
    return KeyRange(contact, key, variation.low, variation.high)


def _metric(row: Row, key: str, unit: str | None) -> float:
    for each in row["metrics"]:
        if each["key"] == key:
            if unit is not None and unit != each["unit"]:
                raise SweepError(f"{key} was measured in {unit}, the metric is in {each['unit'] or '1'}")
            return math.nan if each["value"] is None else float(each["value"])
    raise SweepError(f"the run has no metric {key}; it has {', '.join(each['key'] for each in row['metrics'])}")
