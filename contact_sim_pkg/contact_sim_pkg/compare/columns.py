"""Columns of a run that accuracy bounds: those whose message definition states a kind."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.definitions import Field, definition_of

__all__ = ["Column", "Key", "columns_of", "judged_topics", "kind_of", "not_judged", "paired"]

NANOSECONDS = 1e9
PLACES = ("cell_", "origin_")
"""Names of columns that say where cells lie."""
Instants = NDArray[numpy.int64]


class Key(NamedTuple):
    """Name of a column: a field of a topic, of one body where it has several."""

    topic: str
    field: str
    body: str = ""  # coordinate of `bench/motion`

    @property
    def place(self) -> str:
        """The contact, or the coordinate of a body."""
        return self.body or self.topic.partition("/")[0]

    @property
    def label(self) -> str:
        """For a person: `normal`, of another topic than `force` with its name: `axle longitudinal`."""
        topic = self.topic.partition("/")[2]
        return self.field if self.body or topic in ("force", "patch", "contact") else f"{topic} {self.field}"


class Column(NamedTuple):
    """One column over a run."""

    kind: str
    unit: str
    instants: Instants  # [samples] [ns], simulated time
    values: Vector  # [samples]
    period: float  # [s] between samples; 0 where each message has one value


def judged_topics(topics: Iterable[str]) -> list[str]:
    """Those of the topics with a judged column."""
    return [topic for topic in topics if topic in TOPICS and _judged(TOPICS[topic].type)]


def kind_of(key: Key) -> str:
    """Kind of a column; empty where it is not judged."""
    fields = {field.name: field.kind for field in _judged(TOPICS[key.topic].type)}
    return fields.get(key.field, "")


def not_judged(topics: Iterable[str]) -> list[str]:
    """What has no kind: topics, or of a topic with judged columns its other columns of real numbers."""
    found = []
    for topic in topics:
        type_name = TOPICS[topic].type
        judged = {field.name for field in _judged(type_name)}
        others = [field.name for field in _reals(type_name) if field.name not in judged]
        if not judged:
            found.append(topic)
        elif others:
            found.append(f"{topic} {', '.join(others)}")
    return found


def columns_of(outputs: Iterable[Output]) -> dict[Key, Column]:
    """Judged columns of the outputs of a run, in the order of their appearance."""
    parts: dict[Key, list[tuple[Instants, Vector]]] = {}
    fields: dict[Key, tuple[Field, float]] = {}
    for output in outputs:
        for field in _judged(TOPICS[output.topic].type):
            period = _period(output.record) if field.is_array else 0.0
            for body, values in _rows(output.record, field):
                key = Key(output.topic, field.name, body)
                fields[key] = field, period
                parts.setdefault(key, []).append((_instants(output.stamp, period, len(values)), values))
    return {
        key: Column(
            fields[key][0].kind, fields[key][0].unit, numpy.concatenate([at for at, _ in found]),
            numpy.concatenate([values for _, values in found]), fields[key][1],
        )
        for key, found in parts.items()
    }  # fmt: skip


def paired(column: Column, other: Column) -> tuple[Instants, Vector, Vector]:
    """Instants [ns] that both columns have, and the values of both there."""
    instants, first, second = numpy.intersect1d(column.instants, other.instants, return_indices=True)
    return instants, column.values[first], other.values[second]


@cache
def _judged(type_name: str) -> tuple[Field, ...]:
    return tuple(field for field in _record_fields(type_name) if field.kind)


def _reals(type_name: str) -> tuple[Field, ...]:
    """Columns of real numbers, without times and the places of cells."""
    fields = (field for field in _record_fields(type_name) if field.type.startswith("float") and field.unit != "s")
    return tuple(field for field in fields if not field.name.startswith(PLACES))


def _record_fields(type_name: str) -> tuple[Field, ...]:
    return definition_of(type_name.rpartition("/")[2]).record_fields


def _period(record: Any) -> float:
    return float(record.sample_period if hasattr(record, "sample_period") else record.period)


def _instants(stamp: int, period: float, samples: int) -> Instants:
    return numpy.asarray(stamp + numpy.rint(numpy.arange(samples) * (period * NANOSECONDS)), dtype=numpy.int64)


def _rows(record: Any, field: Field) -> list[tuple[str, Vector]]:
    """Values of a field by body; an empty array has none."""
    values = numpy.atleast_1d(numpy.asarray(getattr(record, field.name), dtype=numpy.float64))
    if not values.size:
        return []
    bodies = getattr(record, "bodies", None)
    if bodies is None or not field.is_array:
        return [("", values.ravel())]
    return list(zip(bodies, values.reshape(len(bodies), -1), strict=True))
