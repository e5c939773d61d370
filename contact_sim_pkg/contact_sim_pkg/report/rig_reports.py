"""What the rigs of a recording add to its numbers; found through the registry. Loads no drawing of
pictures.
"""

from __future__ import annotations

import re

from contact_sim_pkg.records.registry import contact_reports, rigs
from contact_sim_pkg.records.report import ContactReport, LedgerScope, SeriesReader
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.signal.loops import vibration_period
from contact_sim_pkg.report.sketch import Part, parts_of_scene

ANSWER_KEY = re.compile(r"{(\w+)(:remark)?}")
"""A metric in a phrase of `ContactReport.answer`."""


def series_readers() -> dict[str, SeriesReader]:
    """Reader of each message type that only one rig records."""
    return {kind: each for report in contact_reports().values() for each in report.series for kind in each.types}


def reports_of(recording: Recording) -> list[ContactReport]:
    """Reports of the contacts that the bag holds, that its rig has, or of which it holds a
    series.
    """
    rig = rigs().get(str(recording.scene.get("rig")))
    contacts = {*recording.contacts, *(contact.name for contact in (rig.contacts if rig is not None else ()))}
    return [
        each
        for each in contact_reports().values()
        if each.contact in contacts or any(series.name in recording.series for series in each.series)
    ]


def rig_warnings(recording: Recording) -> list[str]:
    """Sentences of the rigs that stand before the numbers."""
    return [text for each in reports_of(recording) if each.warnings for text in load(each.warnings)(recording)]


def answered(recording: Recording) -> set[str]:
    """Keys of the metrics that the rigs' answers name: what a reader looks for first."""
    return {
        f"{report.contact}.{key}" for report in reports_of(recording) for phrase in report.answer
        for key, _remark in ANSWER_KEY.findall(phrase)
    }  # fmt: skip


def parts_of(recording: Recording) -> list[Part]:
    """Parts of the rig's drawing, from the ground upwards; of a rig that lists none what its scene shows."""
    scene = recording.scene
    named = [each.parts for each in reports_of(recording) if each.parts and each.contact in scene]
    found = [part for name in named for part in load(name)(scene)]
    return found or parts_of_scene(scene)


def ledger_scope(recording: Recording) -> LedgerScope | None:
    """What the energy ledger is of; None for the whole rig."""
    named = next((each.ledger for each in reports_of(recording) if each.ledger), "")
    scope: LedgerScope | None = load(named)(recording) if named else None
    return scope


def drive_period(recording: Recording) -> float | None:
    """Period [s] of the drive of a run, that of a rig or of the vibration; None for one without
    cycles.
    """
    for each in reports_of(recording):
        period: float | None = load(each.drive_period)(recording.scene) if each.drive_period else None
        if period is not None:
            return period
    return vibration_period(recording.scene)
