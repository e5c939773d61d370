"""Estimated numerical error of a run beside what its scene requested.

The contract is that of `docs/accuracy.md`: an error is the largest of the run over the largest force
of its contact, the largest peak pressure, the largest area. Bodies move by the forces of their
contacts, and err by no more of theirs: motion has the error of the force that errs most.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, Protocol

from contact_sim_pkg.compare.least_errors import least_errors
from contact_sim_pkg.records.definitions import RESOLVED, definition_of
from contact_sim_pkg.records.table import number_of
from contact_sim_pkg.run.outputs import Estimate
from contact_sim_pkg.scene.schema.accuracy import requested

__all__ = ["MOTION", "Above", "above", "above_request", "accuracy_lines", "accuracy_numbers"]

MOTION = "motion"
FAR = 10.0
"""times what was requested: who requests so much less than a model can does not know its error"""
WORDS = {"force": "force", "motion": "motion", "peak": "peak pressure", "area": "area"}


class NamedTopic(Protocol):
    """A topic of a recording."""

    @property
    def name(self) -> str:
        """Its name."""

    @property
    def type(self) -> str:
        """package/msg/Type."""


class RunRecording(Protocol):
    """What is needed of a recording."""

    @property
    def scene(self) -> Mapping[str, Any]:
        """Resolved scene; empty for a bag without one."""

    @property
    def contacts(self) -> Mapping[str, Any]:
        """By name."""

    @property
    def fields(self) -> Mapping[str, Any]:
        """Contacts with a pressure field."""

    @property
    def motion(self) -> Any:
        """None where no motion is recorded."""

    @property
    def topics(self) -> Sequence[NamedTopic]:
        """Of the bag."""

    @property
    def estimates(self) -> Sequence[Estimate]:
        """The largest of the run."""


def accuracy_numbers(recording: RunRecording) -> dict[str, Any]:
    """Section ``accuracy`` of the summary; empty for a bag without a scene, or without a contact.

    ``requested`` [1]; ``estimated``: of each contact, and of the ``motion`` of the bodies, largest
    estimated error [1] by kind, None where it is not estimated; ``not_below``: the same, an error
    that no request makes smaller, with the effect that has it; ``not_resolved``: components of
    forces by column, with their error over their own largest value.
    """
    asked = recording.scene.get("accuracy")
    if asked is None or not recording.contacts:
        return {}
    found = _by_kind(recording)
    estimated = {place: {kind: _over_scale(each) for kind, each in kinds.items()} for place, kinds in found.items()}
    for kinds in estimated.values():  # pressure and area err with the force that makes them
        force = kinds.get("force") or 0.0
        kinds |= {
            kind: max(error, force) for kind, error in kinds.items() if kind in ("peak", "area") and error is not None
        }
    forces = [error for kinds in estimated.values() if (error := kinds.get("force")) is not None]
    if recording.motion is not None:
        # A body that no estimate names moves by the forces on it
        speeds = [error] if (error := estimated.get(MOTION, {}).get(MOTION)) is not None else []
        estimated[MOTION] = {MOTION: max([*forces, *speeds], default=None)}
    lost = {
        each.column: each.error / each.largest for kinds in found.values() for each in kinds.get("force", [])
        if each.largest > 0.0 and each.error > RESOLVED * each.largest
    }  # fmt: skip
    return {
        "requested": requested(asked), "estimated": estimated, "not_below": _not_below(recording, estimated),
        "not_resolved": lost,
    }  # fmt: skip


def _by_kind(recording: RunRecording) -> dict[str, dict[str, list[Estimate]]]:
    """Estimates of each contact, and of the motion, by kind."""
    types = {topic.name.lstrip("/"): topic.type.rpartition("/")[2] for topic in recording.topics}
    found: dict[str, dict[str, list[Estimate]]] = {name: {"force": []} for name in recording.contacts}
    for name in recording.fields:
        found.setdefault(name, {}).update({"peak": [], "area": []})
    for estimate in recording.estimates:
        kind = _kind_of(estimate.column, types)
        place = MOTION if kind == MOTION else estimate.column.partition("/")[0]
        found.setdefault(place, {}).setdefault(kind, []).append(estimate)
    return found


def _not_below(recording: RunRecording, estimated: Mapping[str, Mapping[str, Any]]) -> dict[str, dict[str, list[Any]]]:
    """Largest error by place and kind that no request makes smaller, and its effect."""
    found = {
        place: {kind: [*least] for kind, least in kinds.items() if kind in estimated.get(place, {})}
        for place, kinds in least_errors(recording.scene).items()
    }
    return {place: kinds for place, kinds in found.items() if kinds}


def above(numbers: Mapping[str, Any]) -> list[str]:
    """What is estimated to err by more than requested, as ``tire force 1.4e-2``, or cannot err by so
    little.
    """
    asked, found = numbers["requested"], []
    for place, kinds in numbers["estimated"].items():
        for kind, error in kinds.items():
            least, effect = numbers["not_below"].get(place, {}).get(kind, (0.0, ""))
            if least > max(asked, error or 0.0):
                found.append(f"{_named(place, kind)}, not below {number_of(least)} with {effect}")
            elif error is not None and error > asked:
                found.append(f"{_named(place, kind)} {number_of(error)}")
    return found


class Above(NamedTuple):
    """What errs by more than requested."""

    text: str = ""
    """``estimated above the requested 1e-2: tire force 1.4e-2``; empty where nothing does"""
    is_doubtful: bool = False
    """whether a run can be more accurate, by a smaller request or without a limit on its steps; where the model of an effect
    errs by so much at any request, whether that is ten times the request"""


def above_request(numbers: Mapping[str, Any]) -> Above:
    """`above` in a sentence; ``numbers`` may be empty."""
    named = above(numbers) if numbers else []
    if not named:
        return Above()
    asked = numbers["requested"]
    floors = {
        (place, kind): least[0]
        for place, kinds in numbers["not_below"].items()
        for kind, least in kinds.items()
        if least[0] > asked
    }
    beyond = {
        (place, kind) for place, kinds in numbers["estimated"].items() for kind, error in kinds.items()
        if error is not None and error > asked
    }  # fmt: skip
    is_doubtful = bool(beyond - floors.keys()) or max(floors.values(), default=0.0) >= FAR * asked
    return Above(f"estimated above the requested {number_of(asked)}: {', '.join(named)}", is_doubtful)


def accuracy_lines(numbers: dict[str, Any]) -> list[str]:
    """A line for each contact, and for the motion: what was requested, what is estimated."""
    lines = []
    for place, kinds in numbers["estimated"].items():
        first, *others = kinds
        parts = [f"{_named(place, first)}: requested {number_of(numbers['requested'])}, {_said(numbers, place, first)}"]
        parts += [
            f"{column.partition('.')[2]} not resolved ({100.0 * share:.0f} % of its own)"
            for column, share in numbers["not_resolved"].items() if column.startswith(f"{place}/")
        ]  # fmt: skip
        parts += [f"{WORDS[kind]}: {_said(numbers, place, kind)}" for kind in others]
        lines.append("; ".join(parts))
    return lines


def _named(place: str, kind: str) -> str:
    return place if place == kind else f"{place} {WORDS[kind]}"


def _said(numbers: dict[str, Any], place: str, kind: str) -> str:
    error, asked = numbers["estimated"][place][kind], numbers["requested"]
    least, effect = numbers["not_below"].get(place, {}).get(kind, (0.0, ""))
    if error is not None:
        said = f"estimated {number_of(error)}{' (above)' if error > asked else ''}"
        return f"{said}, not below {number_of(least)} with {effect}" if least > error else said
    return f"not below {number_of(least)} with {effect}" if least else "not estimated"


def _kind_of(column: str, types: dict[str, str]) -> str:
    topic, _dot, field = column.partition(".")
    name = field.partition(" of ")[0]
    fields = {field.name: field.kind for field in definition_of(types[topic]).fields}
    return fields[name]


def _over_scale(estimates: list[Estimate]) -> float | None:
    """Largest error over the largest value of all components."""
    scale = max((each.largest for each in estimates), default=0.0)
    return max(each.error for each in estimates) / scale if scale > 0.0 else None
