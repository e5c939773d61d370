"""What was run, as rows of text for the page: scene, effects, grids, tolerances, excitation, versions."""

from __future__ import annotations

from typing import Any, NamedTuple

from .reading import parse_mapping
from .series import Recording

EXCITATION_KEY = "excitation"
OUTCOME_KEYS = ("ended", "failure", "blocks_done", "wall_s", "stopped")
KNOWN_EFFECTS = {
    "normal_elastic": "elastic normal force",
    "normal_dissipative": "loss in the normal direction",
    "friction": "friction with true stick",
    "contact_field": "pressure field",
}


class Fact(NamedTuple):
    """One row: what it is, and its value."""

    label: str
    value: str


class ExcitationFacts(NamedTuple):
    """One excitation: where it acts, its parameters, and what was found and done."""

    topic: str
    facts: list[Fact]
    notes: list[str]


def run_facts(recording: Recording) -> list[Fact]:
    """Rig, times and accuracy of the run, as far as the bag tells."""
    scene = recording.scene
    facts = [Fact("rig", plain(scene["rig"]))] if "rig" in scene else []
    facts.append(Fact("simulated time", f"{recording.duration:.6g} s"))
    if "block_length" in scene:
        facts.append(Fact("block length", f"{plain(scene['block_length'])} s"))
    facts += [Fact(label, plain(scene[label])) for label in ("accuracy", "seed") if label in scene]
    for section in ("integrator", "outputs"):
        facts += flat(scene.get(section), section)
    return facts + flat(scene.get("travel"), "travel")


def effect_facts(recording: Recording) -> dict[str, list[Fact]]:
    """By contact: each effect that acts, with its parameters, grids and tolerances."""
    effects = recording.scene.get("effects")
    if not isinstance(effects, dict):
        return {}
    return {
        str(contact): [
            Fact(KNOWN_EFFECTS.get(str(name), str(name)), ", ".join(f"{row.label} {row.value}" for row in flat(values)) or "on")
            for name, values in named.items()
            if values is not None
        ]
        for contact, named in effects.items()
        if isinstance(named, dict)
    }


def excitation_facts(recording: Recording) -> list[ExcitationFacts]:
    """By topic: parameters and notes, such as clipped samples of a recorded signal."""
    described = parse_mapping(recording.metadata.get(EXCITATION_KEY, ""))
    return [
        ExcitationFacts(
            str(topic),
            flat({key: value for key, value in values.items() if key != "notes"}),
            _sentences(values.get("notes")),
        )
        for topic, values in described.items()
        if isinstance(values, dict)
    ]


def version_facts(recording: Recording) -> list[Fact]:
    """Versions of what the numbers depend on."""
    other = (EXCITATION_KEY, *OUTCOME_KEYS)
    return [Fact(plain_name(key), text) for key, text in recording.metadata.items() if key not in other]


def warnings(recording: Recording) -> list[str]:
    """What a reader must know before the numbers: an unfinished bag, a run that failed or was stopped."""
    found = list(recording.notes)
    ended = recording.metadata.get("ended", "finished")
    if ended != "finished":
        reason = recording.metadata.get("failure", "")
        found.append(f"The run ended early ({ended}){': ' + reason if reason else ''}.")
    if recording.metadata.get("stopped"):
        found.append(recording.metadata["stopped"])
    return found


def flat(value: Any, prefix: str = "") -> list[Fact]:
    """Nested mappings as rows with dotted labels; None is left out."""
    if value is None:
        return []
    if not isinstance(value, dict):
        return [Fact(plain_name(prefix), plain(value))]
    return [row for key, item in value.items() for row in flat(item, f"{prefix}.{key}" if prefix else str(key))]


def plain(value: Any) -> str:
    """A value as a person writes it: 6 digits, yes and no, lists with commas."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, (list, tuple)):
        return ", ".join(plain(item) for item in value)
    return str(value)


def plain_name(key: str) -> str:
    """`kernel_fingerprint` -> `kernel fingerprint`."""
    return key.replace("_", " ")


def _sentences(notes: Any) -> list[str]:
    return [str(note) for note in notes] if isinstance(notes, list) else [str(notes)] if notes else []
