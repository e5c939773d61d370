"""What an effect changes of the outputs it feeds: for each topic the field that changes most.

The change of a field is the root mean square of its difference between the run with the effect and
the one without it, over the larger root mean square of the two: 0 where nothing changes, 1.4 where
they have nothing to do with each other. A field that is zero, or rounding, in one of the two runs
has no relative change: its root mean square in the other is reported, with its unit. What is
rounding in both is no change.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy

from contact_sim_pkg.bag.columns import stacked
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.bag.typestore import definition, installed_types
from contact_sim_pkg.compiled.arrays import Vector

__all__ = ["Change", "changes_of", "unit_of"]

Messages = list[tuple[str, int, bytes]]

NOT_PHYSICS = ("time", "log_time", "stamp")
ROUNDING = 1e-15  # in SI units: a root mean square below it is rounding, of the middle of a symmetric map for instance


ZERO = 1e-6  # of the root mean square of the other run: a field below it is zero beside it
TURNS = (" of block_pitch", " of block_rotation")  # in the names of coordinates
NAMED = 3  # most fields of another length that are named
NONE = numpy.zeros((0, 0))


class Change(NamedTuple):
    """Of a topic's field that changes most; `change` None where no ratio says it: `field` then has
    the reason.

    The topic is in one run alone; or its fields have other lengths (points, bodies, events), and
    those that can be compared do not differ. Or the field is zero in one of the runs: `size` is its
    root mean square in the other, `unit` as the message says.
    """

    topic: str
    field: str
    change: float | None
    size: float | None = None
    unit: str = ""


def changes_of(with_it: Messages, without_it: Messages, topics: Iterable[str]) -> list[Change]:
    """One for each of the topics that is in one of the runs, as named."""
    found = []
    for topic in topics:
        sides = [[(stamp, data) for name, stamp, data in run if name == topic] for run in (with_it, without_it)]
        if all(sides):
            found += _of_topic(topic, *(_fields(topic, side) for side in sides))
        elif any(sides):
            found.append(Change(topic, "only with it" if sides[0] else "only without it", None))
    return found


def _of_topic(topic: str, fields: dict[str, Vector], others: dict[str, Vector]) -> list[Change]:
    """The field that changes most by ratio, then at most `NAMED` of those that are zero in one run,
    or what no number says.
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
    """Relative change, and the root mean square of the one run where the field is zero in the
    other.
    """
    known = numpy.isfinite(values) & numpy.isfinite(others)
    values, others = values[known], others[known]
    small, large = sorted(float(numpy.linalg.norm(each)) for each in (values, others))
    if not large > ROUNDING * values.size**0.5:
        return 0.0, None
    if small <= ZERO * large:
        return 0.0, large / values.size**0.5
    return float(numpy.linalg.norm(values - others)) / large, None


def unit_of(topic: str, field: str) -> str:
    """Of a field of a topic in the first brackets of its line in the message, in rad for a turn;
    "SI" where there are none.
    """
    name = field.split(" of ")[0]
    if name.startswith("wrench."):
        return "N m" if "torque" in name else "N"
    for line in definition(TOPICS[topic].type).splitlines():
        code, _, comment = line.partition("#")
        if code.split()[-1:] == [name.split(".")[0]] and "[" in comment:
            unit = comment[comment.index("[") + 1 :].split("]")[0].split(",")[0]
            return unit.replace("m", "rad", 1) if any(turn in field for turn in TURNS) else unit
    return "SI"


def _fields(topic: str, messages: list[tuple[int, bytes]]) -> dict[str, Vector]:
    """Real numbers of all messages by field, each body's on their own."""
    store, type_name = installed_types(), TOPICS[topic].type
    decoded = [(stamp, store.deserialize_cdr(data, type_name)) for stamp, data in messages]
    columns = stacked(decoded, store, type_name, None)
    fields: dict[str, Vector] = {}
    for name, column in columns.items():
        if name in NOT_PHYSICS:
            continue
        rows = [numpy.atleast_1d(numpy.asarray(row)) for row in column]
        if not all(numpy.issubdtype(row.dtype, numpy.floating) for row in rows):
            continue
        if "bodies" in columns and rows[0].size > 1:
            fields.update(_by_body(name, columns["bodies"], rows))
        else:
            fields[name] = numpy.concatenate(rows).astype(numpy.float64)
    return fields


def _by_body(name: str, bodies: Any, rows: list[Any]) -> dict[str, Vector]:
    names = [str(each) for each in bodies[0]]
    table = numpy.concatenate([row.reshape(len(names), -1) for row in rows], axis=1).astype(numpy.float64)
    return {f"{name} of {body}": table[place] for place, body in enumerate(names)}
