"""Numerical error of a run by kind, as `accuracy` bounds it: largest difference from a finer run
over the scale of the kind at that contact or body.

Scales, each the largest over the run, never below its floor:

* force: magnitude of the force vector of a topic; floor: the standing load of the contact,
* position: excursion; floor: free fall during a sample, ``g T^2 / 2``,
* velocity: its magnitude; floor: ``g T``,
* acceleration: contact force over mass of the body, which never is less than ``g``; of a body that
  no contact touches its own magnitude; floor: ``g``,
* peak pressure, contact area: themselves; floor of the area: a cell.

Angles have the floors of a point 1 m away. The error of the model is no part of it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

import numpy

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.compare.columns import NANOSECONDS, Column, Key, paired
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.definitions import KINDS, RESOLVED
from contact_sim_pkg.records.messages import ContactPatch
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.records.rig import Standing, load
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = [
    "Judgement",
    "Scale",
    "Unresolved",
    "cell_of",
    "judged",
    "larger_scales",
    "largest_by_kind",
    "scales_of",
    "standing_of",
]

LEAST_COMPONENT = 1e-4
"""Of the scale of its kind: a component below it is zero by symmetry, and not judged by noise."""
USUAL_PERIOD = 1e-3  # [s] of a sample where a column has none


class Unresolved(NamedTuple):
    """A component of a force that the run does not resolve."""

    column: str
    share: float  # error over its own largest value


class Scale(NamedTuple):
    """What the error of a column is held against, in its unit."""

    scale: float  # of its kind, at its contact or body
    own: float  # its own largest value


class Judgement(NamedTuple):
    """Error of one kind at one contact or body."""

    place: str  # contact, or coordinate of a body
    kind: str
    error: float  # over the scale
    column: str  # the one that errs most
    time: float  # [s] of the largest error
    unresolved: tuple[Unresolved, ...] = ()


def standing_of(scene: ResolvedScene) -> Standing:
    """Loads and masses of a resolved scene; empty where its rig states none."""
    named = rigs()[scene.rig].standing
    found: Standing = load(named)(scene.data) if named else Standing({}, {})
    return found


def cell_of(outputs: Iterable[Output]) -> dict[str, float]:
    """Area of a cell [m^2] of each topic with a pressure field."""
    return {
        each.topic: float(each.record.cell_x * each.record.cell_y)
        for each in outputs
        if isinstance(each.record, ContactPatch)
    }


def scales_of(
    columns: Mapping[Key, Column], standing: Standing, cells: Mapping[str, float] | None = None
) -> dict[Key, Scale]:
    """Scale of each column over the run that it belongs to; ``cells`` are the floors of areas
    [m^2] by topic.
    """
    forces = _largest_forces(columns, standing)
    found = {}
    for key, column in columns.items():
        own = _largest(column.values)
        if column.kind == "force":
            scale = forces[key.topic]
        elif column.kind == "motion":
            scale = _motion_scale(key, column, standing, forces)
        else:
            scale = max(own, (cells or {}).get(key.topic, 0.0) if column.kind == "area" else 0.0)
        found[key] = Scale(scale, own)
    return found


def larger_scales(scales: Mapping[Key, Scale], others: Mapping[Key, Scale]) -> dict[Key, Scale]:
    """Of each column the larger scale and the larger own value of two runs."""
    none = Scale(0.0, 0.0)
    pairs = {key: (scales.get(key, none), others.get(key, none)) for key in (*scales, *others)}
    return {key: Scale(*map(max, zip(*pair, strict=True))) for key, pair in pairs.items()}


def judged(
    run: Mapping[Key, Column], finer: Mapping[Key, Column], scales: Mapping[Key, Scale], factor: float = 1.0
) -> list[Judgement]:
    """Errors of a run against a finer one, by place and kind in order of appearance.

    ``factor`` raises each difference to the error: 1 / (1 - share of the finer run). Columns
    that only one of the runs has, and those whose scale is zero, are left out.
    """
    groups: dict[tuple[str, str], list[_Error]] = {}
    for key, column in run.items():
        if key in finer and key in scales and scales[key].scale > 0.0:
            groups.setdefault((key.place, column.kind), []).append(_error(key, column, finer[key], scales[key], factor))
    found = []
    for (place, kind), errors in groups.items():
        worst = max(errors, key=lambda error: error.error)
        lost = [Unresolved(each.key.label, each.own) for each in errors if kind == "force" and each.own > RESOLVED]
        found.append(Judgement(place, kind, worst.error, worst.key.label, worst.time, tuple(lost)))
    return found


def largest_by_kind(judgements: Iterable[Judgement]) -> dict[str, float]:
    """Largest error of each kind that is there, in the order of `KINDS`."""
    judgements = list(judgements)
    return {
        kind: max(each.error for each in judgements if each.kind == kind)
        for kind in KINDS
        if any(each.kind == kind for each in judgements)
    }


class _Error(NamedTuple):
    key: Key
    error: float  # over the scale
    own: float  # over its own largest value; 0 where that is zero beside the scale
    time: float  # [s]


def _error(key: Key, column: Column, finer: Column, scale: Scale, factor: float) -> _Error:
    instants, values, others = paired(column, finer)
    if not len(instants):
        return _Error(key, 0.0, 0.0, 0.0)
    difference = factor * numpy.abs(values - others)
    place = int(numpy.argmax(difference))
    largest = float(difference[place])
    share = largest / scale.own if scale.own > LEAST_COMPONENT * scale.scale else 0.0
    return _Error(key, largest / scale.scale, share, float(instants[place]) / NANOSECONDS)


def _largest(values: Vector) -> float:
    return float(numpy.abs(values).max(initial=0.0))


def _largest_forces(columns: Mapping[Key, Column], standing: Standing) -> dict[str, float]:
    """Largest magnitude [N] of the force vector of each topic that has one."""
    squares: dict[str, Vector] = {}
    for key, column in columns.items():
        if column.kind == "force":
            before = squares.setdefault(key.topic, numpy.zeros_like(column.values))
            # A component that some blocks leave out is no part of the vector
            squares[key.topic] = before + column.values**2 if before.shape == column.values.shape else before
    return {
        topic: max(float(numpy.sqrt(square.max())), standing.loads.get(topic.partition("/")[0], 0.0))
        for topic, square in squares.items()
    }


def _motion_scale(key: Key, column: Column, standing: Standing, forces: Mapping[str, float]) -> float:
    """Scale of a position, a velocity or an acceleration, by its unit."""
    period = column.period or USUAL_PERIOD
    if column.unit.endswith("/s^2"):
        touched = standing.bodies.get(key.body)
        largest = max(
            (force for topic, force in forces.items() if touched and _at(topic, touched.contact)), default=0.0
        )
        by_force = largest / touched.mass if touched else _largest(column.values)
        return max(by_force, GRAVITY)
    if column.unit.endswith("/s"):
        return max(_largest(column.values), GRAVITY * period)
    return max(float(numpy.ptp(column.values)), 0.5 * GRAVITY * period**2)


def _at(topic: str, contact: str) -> bool:
    return topic.partition("/")[0] == contact
