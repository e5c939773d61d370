"""What an effect changes of the outputs it feeds: for each topic the field that changes most.

The change of a field is the root mean square of its difference between the run with the effect and
the one without it, over the larger root mean square of the two: 0 where nothing changes, 1.4 where
they have nothing to do with each other. A field that is zero, or rounding, in one of the two runs
has no relative change: its root mean square in the other is reported, with its unit. What is
rounding in both is no change.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

import numpy

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.bag.typestore import definition
from contact_sim_pkg.compiled.arrays import Vector

__all__ = ["Change", "changes_of", "unit_of"]

TIME = "time"  # instants of samples are no physics
ROUNDING = 1e-15  # in SI units: a root mean square below it is rounding, of the middle of a symmetric map for instance
ZERO = 1e-6  # of the root mean square of the other run: a field below it is zero beside it
ANGULAR = (" of block_pitch", " of block_rotation")  # in the names of coordinates
NAMED = 3  # most fields of another length that are named
NONE = numpy.zeros((0, 0))


class Change(NamedTuple):
    """Change of the field of a topic that changes most, in ratio to its larger root mean square.

    `change` is None where there is no ratio. `field` has the reason: the topic is in one run alone;
    or its fields have other lengths (points, bodies, events), and those of equal lengths are equal.
    Or the field is zero in one of the runs: `size` is its root mean square in the other, in `unit`.
    """

    topic: str
    field: str
    change: float | None
    size: float | None = None
    unit: str = ""


def changes_of(with_it: list[Output], without_it: list[Output], topics: Iterable[str]) -> list[Change]:
    """Changes between the outputs of two runs: for each topic those of one field or of a few."""
    found = []
    for topic in topics:
        sides = [[each.record for each in run if each.topic == topic] for run in (with_it, without_it)]
        if all(sides):
            found += _of_topic(topic, *(_fields(side) for side in sides))
        elif any(sides):
            found.append(Change(topic, "only with it" if sides[0] else "only without it", None))
    return found


def _of_topic(topic: str, fields: dict[str, Vector], others: dict[str, Vector]) -> list[Change]:
    """The field that changes most by ratio, then at most `NAMED` of those that are zero in one run.

    Where neither exists, the fields of other lengths by name.
    """
    largest, alone = Change(topic, "unchanged", 0.0), []
    other = [name for name in {**fields, **others} if fields.get(name, NONE).shape != others.get(name, NONE).shape]
    for name in sorted(fields.keys() - set(other)):
        change, size = _compared(fields[name], others[name])
        if size is not None:
            alone.append(Change(topic, name, None, size, unit_of(topic, name)))
        elif change > (largest.change or 0.0):
            largest = Change(topic, name, change)
    if largest.change or not (alone or other):
        return [largest, *alone[:NAMED]]
    if alone:
        return alone[:NAMED]
    further = f" and {len(other) - NAMED} more" if len(other) > NAMED else ""
    return [Change(topic, f"of another length: {', '.join(other[:NAMED])}{further}", None)]


def _compared(values: Vector, others: Vector) -> tuple[float, float | None]:
    """Relative change; where the field is zero in one run, its root mean square in the other."""
    finite = numpy.isfinite(values) & numpy.isfinite(others)
    values, others = values[finite], others[finite]
    small, large = sorted(float(numpy.linalg.norm(each)) for each in (values, others))
    if not large > ROUNDING * values.size**0.5:
        return 0.0, None
    if small <= ZERO * large:
        return 0.0, large / values.size**0.5
    return float(numpy.linalg.norm(values - others)) / large, None


def unit_of(topic: str, field: str) -> str:
    """Unit of a field of a topic: in the first brackets of its line in the message definition.

    [rad] in place of [m] for an angular coordinate; "SI" where the line has no brackets.
    """
    name = field.split(" of ")[0]
    if name.startswith("wrench."):
        return "N m" if "torque" in name else "N"
    for line in definition(TOPICS[topic].type).splitlines():
        code, _, comment = line.partition("#")
        if code.split()[-1:] == [name.split(".")[0]] and "[" in comment:
            unit = comment[comment.index("[") + 1 :].split("]")[0].split(",")[0]
            return unit.replace("m", "rad", 1) if any(each in field for each in ANGULAR) else unit
    return "SI"


def _fields(records: list[Any]) -> dict[str, Vector]:
    """Real numbers of all records of a topic by field, each body's on their own."""
    rows: dict[str, list[Any]] = {}
    for record in records:
        for name, value in _leaves(record):
            rows.setdefault(name, []).append(numpy.atleast_1d(value))
    bodies = getattr(records[0], "bodies", None)
    fields: dict[str, Vector] = {}
    for name, parts in rows.items():
        if name == TIME or not all(numpy.issubdtype(part.dtype, numpy.floating) for part in parts):
            continue
        if bodies is not None and parts[0].size > 1:
            table = numpy.concatenate([part.reshape(len(bodies), -1) for part in parts], axis=1, dtype=numpy.float64)
            fields |= {f"{name} of {body}": row for body, row in zip(bodies, table, strict=True)}
        else:
            fields[name] = numpy.concatenate([part.ravel() for part in parts], dtype=numpy.float64)
    return fields


def _leaves(record: Any, prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Fields of a record by dotted name, those of the records in it included."""
    for name, value in zip(record._fields, record, strict=True):
        if hasattr(value, "_fields"):
            yield from _leaves(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", value
