"""Estimated numerical error of a run beside what its scene requested.

The contract is that of `docs/accuracy.md`: an error is the largest of the run over the largest force
of its contact, the largest peak pressure, the largest area. Bodies move by the forces of their
contacts, and err by no more of theirs: motion has the error of the force that errs most.
"""

from __future__ import annotations

from typing import Any

from contact_sim_pkg.records.definitions import definition_of
from contact_sim_pkg.report.series import Estimate, Recording
from contact_sim_pkg.scene.schema.accuracy import requested

__all__ = ["above", "accuracy_lines", "accuracy_numbers", "short"]

RESOLVED = 0.1
"""Error of a component of a force over its own largest value above which it is not resolved."""

WORDS = {"force": "force", "motion": "motion", "peak": "peak pressure", "area": "area"}


def accuracy_numbers(recording: Recording) -> dict[str, Any]:
    """Section ``accuracy`` of the summary; empty for a bag without a scene, or without a contact.

    ``requested`` [1]; ``estimated``: of each contact, and of the ``motion`` of the bodies, largest
    estimated error [1] by kind, None where it is not estimated; ``not_resolved``: components of
    forces by column, with their error over their own largest value.
    """
    asked = recording.scene.get("accuracy")
    if asked is None or not recording.contacts:
        return {}
    types = {topic.name.lstrip("/"): topic.type.rpartition("/")[2] for topic in recording.topics}
    by_kind: dict[str, dict[str, list[Estimate]]] = {name: {"force": []} for name in recording.contacts}
    for name in recording.fields:
        by_kind.setdefault(name, {}).update({"peak": [], "area": []})
    for estimate in recording.estimates:
        contact = estimate.column.partition("/")[0]
        by_kind.setdefault(contact, {}).setdefault(_kind_of(estimate.column, types), []).append(estimate)
    estimated = {
        contact: {kind: _over_scale(found) for kind, found in kinds.items()} for contact, kinds in by_kind.items()
    }
    forces = [error for kinds in estimated.values() if (error := kinds.get("force")) is not None]
    if recording.motion is not None:
        estimated["motion"] = {"motion": max(forces) if forces else None}
    lost = {
        each.column: each.error / each.largest for kinds in by_kind.values() for each in kinds.get("force", [])
        if each.largest > 0.0 and each.error > RESOLVED * each.largest
    }  # fmt: skip
    return {"requested": requested(asked), "estimated": estimated, "not_resolved": lost}


def above(numbers: dict[str, Any]) -> list[str]:
    """What is estimated to err by more than requested, as ``tire force 1.4e-2``."""
    return [
        f"{_named(place, kind)} {short(error)}" for place, kinds in numbers["estimated"].items()
        for kind, error in kinds.items() if error is not None and error > numbers["requested"]
    ]  # fmt: skip


def accuracy_lines(numbers: dict[str, Any]) -> list[str]:
    """A line for each contact, and for the motion: what was requested, what is estimated."""
    asked, lines = numbers["requested"], []
    for place, kinds in numbers["estimated"].items():
        first, *others = kinds
        parts = [f"{_named(place, first)}: requested {short(asked)}, {_said(kinds[first], asked)}"]
        parts += [
            f"{column.partition('.')[2]} not resolved ({100.0 * share:.0f} % of its own)"
            for column, share in numbers["not_resolved"].items() if column.startswith(f"{place}/")
        ]  # fmt: skip
        parts += [f"{WORDS[kind]}: {_said(kinds[kind], asked)}" for kind in others]
        lines.append("; ".join(parts))
    return lines


def short(number: float) -> str:
    """A number in two digits, without zeros that say nothing: 1e-2, 1.4e-2."""
    mantissa, _e, exponent = f"{number:.1e}".partition("e")
    return f"{mantissa.removesuffix('.0')}e{int(exponent)}"


def _named(place: str, kind: str) -> str:
    return place if place == kind else f"{place} {WORDS[kind]}"


def _said(error: float | None, asked: float) -> str:
    if error is None:
        return "not estimated"
    return f"estimated {short(error)}{' (above)' if error > asked else ''}"


def _kind_of(column: str, types: dict[str, str]) -> str:
    topic, _dot, name = column.partition(".")
    fields = {field.name: field.kind for field in definition_of(types[topic]).fields}
    return fields[name]


def _over_scale(estimates: list[Estimate]) -> float | None:
    """Largest error over the largest value of all components."""
    scale = max((each.largest for each in estimates), default=0.0)
    return max(each.error for each in estimates) / scale if scale > 0.0 else None
