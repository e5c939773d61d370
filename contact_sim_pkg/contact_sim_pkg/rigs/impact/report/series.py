"""Messages of the impact rig, read one by one: all events, the courses of the first impacts, and
the first of each effect.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from contact_sim_pkg.bag.messages import record_of
from contact_sim_pkg.records.messages import (
    ImpactCourse,
    ImpactEvents,
    ImpactFront,
    ImpactHistory,
    ImpactPosition,
    ImpactStress,
    ImpactWave,
)
from contact_sim_pkg.report.ranges import yield_warnings
from contact_sim_pkg.report.series import FloatArray, Recording

EVENTS = "contact_msgs_defs/msg/ImpactEvents"
_KINDS: dict[str, type] = {
    f"contact_msgs_defs/msg/{kind.__name__}": kind
    for kind in (ImpactCourse, ImpactStress, ImpactWave, ImpactFront, ImpactPosition, ImpactHistory)
}
MOST_COURSES = 12
"""Impacts whose course is kept for the pictures."""


class ImpactSeries(NamedTuple):
    """The impacts of a run; what the scene does not record is None or empty."""

    events: ImpactEvents
    """of all blocks, in the order in which the impacts ended"""
    courses: list[ImpactCourse]
    """of the first impacts"""
    stress: ImpactStress | None
    wave: ImpactWave | None
    front: ImpactFront | None
    position: ImpactPosition | None
    history: ImpactHistory | None
    """of the first impact each"""


def impacts_of(recording: Recording) -> ImpactSeries | None:
    """Impacts of a recording; None where none ended."""
    return recording.series.get("impacts")


def impact_warnings(recording: Recording) -> list[str]:
    """Sentences where impacts are missing (`missing_impacts`), and where a sphere leaves the elastic
    range.
    """
    impacts = impacts_of(recording)
    return missing_impacts(impacts, recording.scene) + _yielding(impacts, recording.scene)


def _yielding(impacts: ImpactSeries | None, scene: dict[str, Any]) -> list[str]:
    strength = ((scene.get("impact") or {}).get("sample") or {}).get("yield_strength")
    if impacts is None:
        return []
    events = impacts.events
    # The law of the impact is that of Hertz for E* = k_p E'.
    pressure = hertz_pressure(events.peak_force, events.shape_factor * events.storage_modulus, events.radius)
    return yield_warnings("impact.sample.yield_strength", strength, events.start + events.peak_time, pressure)


def hertz_pressure(force: FloatArray, modulus: FloatArray, radius: FloatArray) -> FloatArray:
    """Largest pressure [Pa] under a sphere of ``radius`` [m] pressed with ``force`` [N] on a
    half-space of contact ``modulus`` E* [Pa]: ``(6 F E*^2/(pi^3 R^2))^(1/3)`` (Johnson 4.24).
    """
    return np.cbrt(6.0 * force * modulus**2 / (np.pi**3 * radius**2))


def missing_impacts(impacts: ImpactSeries | None, scene: dict[str, Any]) -> list[str]:
    """A sentence where fewer impacts took place than the scene requests: ``bounces`` of each
    release, at least one.
    """
    rig = scene.get("impact")
    if scene.get("rig") != "impact" or not isinstance(rig, dict):
        return []
    releases = len(rig["speeds"]) * len(rig["temperatures"]) * int(rig["repeats"])
    each = max(int(rig["bounces"]), 1)
    counts = np.zeros(0) if impacts is None else np.unique(impacts.events.release, return_counts=True)[1]
    done, requested = int(np.minimum(counts, each).sum()), releases * each
    if done >= requested:
        return []
    sentence = (
        f"{done} of {requested} impacts took place ({releases} releases, {each} of each): make duration or impact.period longer; "
        "a sphere that comes to rest, or does not part any more, has no further ones."
    )
    return [sentence]


class ImpactReader:
    """Reads messages in the order of the bag."""

    def __init__(self) -> None:
        """Nothing read yet."""
        self._events: list[ImpactEvents] = []
        self._courses: list[ImpactCourse] = []
        self._first: dict[type, Any] = {}

    def add(self, _time: float, type_name: str, message: Any) -> None:
        """Read a message of one of its types. Raises MessageError where its arrays do not fit."""
        if type_name == EVENTS:
            self._events.append(record_of(ImpactEvents, message))
            return
        kind: Any = _KINDS[type_name]
        if kind is ImpactCourse:
            if len(self._courses) < MOST_COURSES:
                self._courses.append(record_of(kind, message))
        elif kind not in self._first:
            self._first[kind] = record_of(kind, message)

    def finish(self) -> ImpactSeries | None:
        """What was read; None where no impact ended."""
        if not self._events:
            return None
        names = [name for name in ImpactEvents._fields if name != "block"]
        columns = {name: np.concatenate([getattr(each, name) for each in self._events]) for name in names}
        rest = (
            self._first.get(kind) for kind in (ImpactStress, ImpactWave, ImpactFront, ImpactPosition, ImpactHistory)
        )
        return ImpactSeries(ImpactEvents(block=0, **columns), self._courses, *rest)
