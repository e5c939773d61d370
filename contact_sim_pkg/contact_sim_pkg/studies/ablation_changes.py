"""What an effect changes of the outputs it feeds: for each topic the field that changes most.

The change of a field is the root mean square of its difference between the run with the effect and the one without it, over the
larger root mean square of the two: 0 where nothing changes, 1 where one of them is zero throughout, 1.4 where they have nothing
to do with each other. What is rounding in both is no change.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy

from contact_sim_pkg.bag.columns import stacked
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.bag.typestore import installed_types
from contact_sim_pkg.core.parameters import Vector

__all__ = ["Change", "changes_of"]

Messages = list[tuple[str, int, bytes]]

NOT_PHYSICS = ("time", "log_time", "stamp")
ROUNDING = 1e-15  # in SI units: a root mean square below it is rounding, of the middle of a symmetric map for instance


NAMED = 3  # most fields of another length that are named
NONE = numpy.zeros((0, 0))


class Change(NamedTuple):
    """Of a topic's field that changes most; `change` None where no number says it: `field` then has the reason.

    The topic is in one run alone; or its fields have other lengths (points, bodies, events), and those that can be compared do
    not differ.
    """

    topic: str
    field: str
    change: float | None


def changes_of(with_it: Messages, without_it: Messages, topics: Iterable[str]) -> list[Change]:
    """One for each of the topics that is in one of the runs, as named."""
    found = []
    for topic in topics:
        sides = [[(stamp, data) for name, stamp, data in run if name == topic] for run in (with_it, without_it)]
        if all(sides):
            found.append(_largest(topic, *(_fields(topic, side) for side in sides)))
        elif any(sides):
            found.append(Change(topic, "only with it" if sides[0] else "only without it", None))
    return found


def _largest(topic: str, fields: dict[str, Vector], others: dict[str, Vector]) -> Change:
    largest = Change(topic, "unchanged", 0.0)
    other = [name for name in {**fields, **others} if fields.get(name, NONE).shape != others.get(name, NONE).shape]
    for name in fields.keys() - set(other):
        change = _relative(fields[name], others[name])
        if change > (largest.change or 0.0):
            largest = Change(topic, name, change)
    if largest.change == 0.0 and other:
        further = f" and {len(other) - NAMED} more" if len(other) > NAMED else ""
        return Change(topic, f"of another length: {', '.join(other[:NAMED])}{further}", None)
    return largest


def _relative(values: Vector, others: Vector) -> float:
    known = numpy.isfinite(values) & numpy.isfinite(others)
    values, others = values[known], others[known]
    size = max(float(numpy.linalg.norm(values)), float(numpy.linalg.norm(others)))
    return float(numpy.linalg.norm(values - others)) / size if size > ROUNDING * values.size**0.5 else 0.0


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
