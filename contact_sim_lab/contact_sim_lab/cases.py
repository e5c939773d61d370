"""Where the studies find their cases: modules of the bench's own rigs, of no rig, and of plug-ins.

A plug-in brings its own by an entry point of the group `contact_sim_pkg.studies`, which names a
mapping of rig -> `RigStudies`.
"""

from __future__ import annotations

import logging
from collections.abc import Iterable, Mapping
from functools import cache
from typing import Any, NamedTuple

from contact_sim_pkg.records.plugins import plugins
from contact_sim_pkg.records.rig import load

__all__ = ["GOALS", "HARD_CASES", "RigStudies", "modules_of_rigs", "objects", "rig_studies"]

_log = logging.getLogger(__name__)
_LAB = "contact_sim_lab"
_RIGS = f"{_LAB}.rigs"


class RigStudies(NamedTuple):
    """Modules that hold what is measured of a rig.

    Attributes:
        accuracy: their `ACCURACY` holds `records.accuracy.AccuracyStudy`: `bench accuracy SCENE
            --parts`.
        work_precision: their `WORK_PRECISION` holds `records.work_precision.WorkPrecision`, those of
            papers on the rig included: `bench accuracy RIG`.
        goals: their `GOALS` holds `records.goal.GoalPart`: `bench goals`.
        hard_cases: their `CASES` holds `records.hard_case.HardCase`: `bench hard`.
        validation: their `VALIDATION` holds `records.metric.Published`: `bench validation`.
        curves: their `CURVES` holds `records.published_curve.PublishedCurve`: the same command.
    """

    accuracy: tuple[str, ...] = ()
    work_precision: tuple[str, ...] = ()
    goals: tuple[str, ...] = ()
    hard_cases: tuple[str, ...] = ()
    validation: tuple[str, ...] = ()
    curves: tuple[str, ...] = ()


def _of(rig: str, *names: str) -> tuple[str, ...]:
    return tuple(f"{_RIGS}.{rig}.{name}" for name in names)


_OURS: dict[str, RigStudies] = {
    "tire": RigStudies(
        accuracy=_of("vehicle", "accuracy"),
        work_precision=_of("vehicle.work_precision", "elliptic", "force", "smooth", "rough", "area", "exponent", "road"),
        hard_cases=_of("vehicle.hard_cases", "tire", "inflation", "rolling", "obstacles", "scenes", "occupant"),
        validation=_of("vehicle", "validation_tire"),
        curves=_of("vehicle", "curves_tire"),
    ),
    "seat": RigStudies(
        accuracy=_of("vehicle", "accuracy"),
        work_precision=(
            f"{_LAB}.laws.work_precision_restitution",
            f"{_LAB}.papers.cnoidal.work_precision_periodic",
            f"{_LAB}.papers.cnoidal.work_precision_modes",
            *_of("backrest", "work_precision_shell"),
            f"{_LAB}.papers.distance.work_precision",
        ),
        hard_cases=_of("vehicle.hard_cases", "cushion"),
        validation=_of("vehicle", "validation_occupant", "validation_seat"),
        curves=_of("vehicle", "curves_seat"),
    ),
    "car": RigStudies(accuracy=_of("vehicle", "accuracy"), goals=_of("vehicle", "goals")),
    "backrest": RigStudies(
        accuracy=_of("backrest", "accuracy"),
        hard_cases=_of("backrest", "hard_cases_shell", "hard_cases", "hard_cases_surface"),
    ),
    "occupant": RigStudies(accuracy=_of("occupant", "accuracy")),
    "impact": RigStudies(
        accuracy=_of("impact", "accuracy"),
        work_precision=_of("impact", "work_precision", "work_precision_material", "work_precision_memory"),
        goals=_of("impact", "goals"),
        hard_cases=_of("impact", "hard_cases_sphere", "hard_cases"),
    ),
    "block": RigStudies(
        accuracy=_of("body", "accuracy"),
        work_precision=(*_of("body", "work_precision"), f"{_LAB}.identify.work_precision"),
        goals=_of("body", "goals"),
        hard_cases=_of("body", "hard_cases_contact", "hard_cases_motion", "hard_cases"),
    ),
    "roller": RigStudies(
        accuracy=_of("roller", "accuracy"),
        work_precision=(
            *_of("vehicle.work_precision", "elliptic"), *_of("roller", "work_precision", "work_precision_interval"),
        ),
        goals=_of("roller", "goals"),
        hard_cases=_of("roller", "hard_cases"),
    ),
}  # fmt: skip

HARD_CASES = (
    *(f"{_LAB}.laws.{name}" for name in (
        "hard_cases_law", "hard_cases_general_law", "hard_cases_impact", "hard_cases_friction", "hard_cases_foam",
    )),
    *(f"{_LAB}.field.{name}" for name in ("hard_cases_geometry", "hard_cases_field", "hard_cases_entries")),
    *(f"{_LAB}.papers.{name}.hard_cases" for name in ("distance", "cnoidal")),
    f"{_LAB}.identify.hard_cases",
)  # fmt: skip
"""Modules of hard cases of no rig."""

GOALS = (*(f"{_LAB}.goals.{name}" for name in ("runs", "laws")), f"{_LAB}.identify.goals")
"""Modules of goals of no rig."""


@cache
def rig_studies() -> dict[str, RigStudies]:
    """By rig: ours, then those that plug-ins bring."""
    brought: dict[str, RigStudies] = {}
    for plugin in plugins():
        for place in plugin.studies:
            try:
                named: Mapping[str, RigStudies] = load(place)
            except Exception as error:  # noqa: BLE001 - whatever the import of a stranger's module raises
                _log.warning("studies of plug-in %s are left out: %s does not load (%s)", plugin, place, error)
                continue
            brought |= {rig: studies for rig, studies in named.items() if rig not in _OURS}
    return {**_OURS, **brought}


def modules_of_rigs(field: str) -> tuple[str, ...]:
    """Modules that the studies of the rigs name in a field, each once."""
    return tuple(dict.fromkeys(name for studies in rig_studies().values() for name in getattr(studies, field)))


def objects(modules: Iterable[str], constant: str) -> list[Any]:
    """What modules list in a constant, one after the other. Raises what their import raises."""
    return [each for module in modules for each in load(f"{module}:{constant}")]
