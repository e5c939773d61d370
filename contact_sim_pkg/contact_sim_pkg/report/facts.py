"""What was run, as rows of text for the page: scene, effects, grids, tolerances, excitation,
versions.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from contact_sim_pkg.bag.texts import excitation_of_text
from contact_sim_pkg.records.metric import MET, SELF_CHECK, Metric
from contact_sim_pkg.records.registry import effects
from contact_sim_pkg.report.rig_reports import rig_warnings
from contact_sim_pkg.report.rows import Row, described_rows, number, plain_name, scene_rows
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.run.bag_content import EXCITATION_KEY, PUBLISHED_BY

CONSTANT = 1e-3
"""of the largest value: what varies by less has no instant of it"""
OUTCOME_KEYS = ("ended", "failure", "blocks_done", "wall_s", "stopped")


class ExcitationFacts(NamedTuple):
    """One excitation: where it acts, its parameters, and what was found and done."""

    topic: str
    rows: list[Row]
    notes: list[str]


def run_rows(recording: Recording) -> list[Row]:
    """Rig, times, accuracy, tolerances and rates of the run, as far as the bag has them."""
    rows = [Row("simulated time", f"{recording.duration:.6g} s")]
    for key in ("rig", "block_length", "accuracy", "seed", "integrator", "outputs", "travel"):
        value = recording.scene.get(key)
        rows += scene_rows(value, (key,), shown_from=1 if isinstance(value, dict) and key != "integrator" else 0)
    return rows


def effect_rows(recording: Recording) -> dict[str, list[Row]]:
    """By contact: each effect that acts, with its parameters, grids and tolerances."""
    of_contacts = recording.scene.get("effects")
    if not isinstance(of_contacts, dict):
        return {}
    return {
        str(contact): [
            _effect_row(str(contact), str(name), values) for name, values in named.items() if values is not None
        ]
        for contact, named in of_contacts.items()
        if isinstance(named, dict)
    }


def excitation_facts(recording: Recording) -> list[ExcitationFacts]:
    """By topic: parameters and notes, such as clipped samples of a recorded signal."""
    described = excitation_of_text(recording.metadata.get(EXCITATION_KEY), f"excitation of {recording.name}")
    return [
        ExcitationFacts(
            str(topic),
            described_rows({key: value for key, value in values.items() if key != "notes"}),
            _sentences(values.get("notes")),
        )
        for topic, values in described.items()
        if isinstance(values, dict)
    ]


def version_rows(recording: Recording) -> list[Row]:
    """Versions of what the numbers depend on."""
    other = (EXCITATION_KEY, *OUTCOME_KEYS)
    return [Row(plain_name(key), text) for key, text in recording.metadata.items() if key not in other]


def warnings(recording: Recording) -> list[str]:
    """What a reader must know before the numbers: an unfinished bag, a run that failed or was
    stopped, those of the rig.
    """
    return [*recording.notes, *warnings_of(recording), *rig_warnings(recording)]


def warnings_of(recording: Recording) -> list[str]:
    """What every view names first: how a run ended early, and excitation that is not its scene's."""
    return [*ended_early(recording), *_strange_sources(recording), *_changed_parameters(recording)]


def _changed_parameters(recording: Recording) -> list[str]:
    """What changed in the run, and from when on."""
    length = float(recording.scene.get("block_length", 0.0))
    made = [f"{each.key} {each.value:.6g} from {each.block * length:.3f} s" for each in recording.changes]
    if not made:
        return []
    return [f"Parameters changed in the run: {'; '.join(made)}. Figures that need the scene are of its start."]


def ended_early(recording: Recording) -> list[str]:
    """That the run failed or was stopped, and why; empty where it went to its end."""
    found = []
    ended = recording.metadata.get("ended", "finished")
    if ended != "finished":
        reason = recording.metadata.get("failure", "")
        found.append(f"The run ended before its last block: {ended}{'; ' + reason if reason else '.'}")
    elif recording.scene and recording.notes and "ended" not in recording.metadata:
        found.append("The recording has no end: the run was killed, or its disk was full.")
    if recording.metadata.get("stopped"):
        found.append(recording.metadata["stopped"])
    return found


def largest_values(recording: Recording) -> str:
    """Largest force and pressure of each contact, and when: `Largest as sampled: tire 4902 N at 4.840 s, 1019 kPa at
    4.290 s`; of a force that is the same all along, that it is.
    """
    found = []
    for name, contact in recording.contacts.items():
        force, field = contact.normal, recording.fields.get(name)
        if not np.any(force > 0.0):
            continue
        constant = np.ptp(force) <= CONSTANT * force.max()
        instant = "all along" if constant else f"at {contact.time[force.argmax()]:.3f} s"
        found.append(f"{name} {number(float(force.max()))} N {instant}")
        if field is not None and np.any(field.peak > 0.0):
            found[-1] += f", {number(1e-3 * float(field.peak.max()))} kPa at {field.time[field.peak.argmax()]:.3f} s"
    return f"Largest as sampled: {'; '.join(found)}" if found else ""


def without_error(metrics: Sequence[Metric]) -> str:
    """That no number of the run has an uncertainty, and what speaks for them instead; empty where one has."""
    if not metrics or any(math.isfinite(each.error) or math.isfinite(each.spread) for each in metrics):
        return ""
    checks = [each for each in metrics if each.basis == SELF_CHECK]
    met = sum(each.verdict == MET for each in checks)
    return "Numerical error not estimated" + (f": {met} of {len(checks)} self-checks met" if checks else "")


def _strange_sources(recording: Recording) -> list[str]:
    """Excitations that no node of the bench published."""
    described = excitation_of_text(recording.metadata.get(EXCITATION_KEY), f"excitation of {recording.name}")
    return [
        f"{topic}: {_sentences(values.get('notes'))[0]}"
        for topic, values in described.items()
        if set(values) == {PUBLISHED_BY, "notes"} and values["notes"]
    ]


def _effect_row(contact: str, name: str, values: Any) -> Row:
    given = {key: value for key, value in values.items() if value != []}
    settings = scene_rows(given, ("effects", contact, name), shown_from=3) if given else []
    text = ", ".join(f"{row.label} {row.value}".strip() for row in settings)
    record = effects().get(name, {}).get(contact)
    return Row(plain_name(name) if record is None else record.help, text or "on")


def _sentences(notes: Any) -> list[str]:
    return [str(note) for note in notes] if isinstance(notes, list) else [str(notes)] if notes else []
