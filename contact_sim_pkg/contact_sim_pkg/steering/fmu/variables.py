"""The variables of a unit: one output a column of the scene's topics, and its vibration as inputs."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

from contact_sim_pkg.bag.columns import own_name
from contact_sim_pkg.bag.topics import topic_of
from contact_sim_pkg.records.definitions import Field, definition_of
from contact_sim_pkg.report.export.table import UNITS_OF_NAMES, is_flat, sorted_fields
from contact_sim_pkg.run.bag_content import result_names
from contact_sim_pkg.steering.contact_bench import VIBRATION, ContactBench

__all__ = ["TIME", "Variable", "inputs_of", "outputs_of", "variable_name"]

TIME = "time"
LEFT_OUT = "bench/cost"  # wall time, which is not that of the simulation
INPUTS = {
    "acceleration_x": "of the floor or seat back, forward positive, constant over a step",
    "acceleration_z": "of the floor or platform, up positive, constant over a step",
}


class Variable(NamedTuple):
    """One scalar of the unit."""

    topic: str
    column: str
    """as in the tables of `bench export`"""
    unit: str
    text: str
    """what it is"""

    @property
    def name(self) -> str:
        """Such as ``tire.force.normal``, in the structured naming of FMI."""
        return variable_name(self.topic, self.column)


def variable_name(topic: str, column: str) -> str:
    """The name of a column: parts of its topic and itself with dots between, those that are no plain name in quotes."""
    parts = [part for each in (*topic.split("/"), *column.split(".")) if (part := each)]
    return ".".join(each if re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", each) else _quoted(each) for each in parts)


def outputs_of(bench: ContactBench) -> list[Variable]:
    """Outputs of a bench before its first block, which is stepped for names and arrays that only a message has.

    The time of the row is the first of each topic. Maps and their sizes, texts, messages within messages, and arrays that the
    scene leaves empty are no outputs.
    """
    first = {each.topic: each.record for each in bench.step().outputs}
    bench.reset()
    found: list[Variable] = []
    for topic in result_names(bench.scene):
        fields = definition_of(topic_of(topic).type.rpartition("/")[2]).record_fields
        if topic != LEFT_OUT and is_flat(fields):
            found += _of_topic(topic, list(fields), first.get(topic))
    return found


def inputs_of(bench: ContactBench) -> list[Variable]:
    """The accelerations that can take the place of the scene's vibration; none where it has none."""
    known = INPUTS.items() if VIBRATION in bench.inputs else ()
    return [Variable(VIBRATION, column, "m/s^2", text) for column, text in known]


def _of_topic(topic: str, every: list[Field], record: Any) -> list[Variable]:
    """Outputs of a topic, of which there is a ``record``, or None."""
    fields = sorted_fields(every)
    plain = [field for field in fields.scalars if field.type != "string"]
    plain += [
        field for field in fields.arrays if field.type != "string" and not (
            field.may_be_empty and record is not None and not len(getattr(record, field.name))
        )
    ]  # fmt: skip
    found = [Variable(topic, TIME, "s", "time of the row that the outputs of this topic hold; -1 before the first one")]
    found += [Variable(topic, own_name(field.name), field.unit, field.comment) for field in plain]
    for field in fields.named if record is not None else ():
        names = [str(each) for each in getattr(record, field.shape[0])]
        units = getattr(record, UNITS_OF_NAMES, [field.unit] * len(names))
        found += [
            Variable(topic, f"{field.name}.{name}", str(unit), field.comment)
            for name, unit in zip(names, units, strict=True)
        ]
    return found


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace("'", "\\'")
    return f"'{escaped}'"
