"""Accuracy and cost of the block rig: facets of the friction cone, and the contact model.

*path* is the largest distance of the centre of mass from where the reference has it at the same
instant, over the size of the body; *end* is that distance at the end; *turn* is the angle between
the two orientations at the end, in [rad]. The reference is the scene's own rigid contact with
located events. Against it the compliant contact shows a difference of two models, not an error:
they meet as the stiffness grows only where slip neither stops nor reverses within an impact. A way
that ends without an answer has no row, and the study says why as it goes.
"""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy

from contact_sim_lab.records.accuracy import AccuracyPart, AccuracyStudy
from contact_sim_lab.records.work_precision import milliseconds
from contact_sim_lab.rigs.body.tipping_body import REFERENCE, tip, tip_error, tipping
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.laws.parameters import NormalElastic
from contact_sim_pkg.rigid.bodies.body import Motion
from contact_sim_pkg.rigid.motion.compliant import compliant_contact
from contact_sim_pkg.rigid.problem import PLANE
from contact_sim_pkg.rigs.body.model import BlockModel, build_block
from contact_sim_pkg.rigs.body.simulation import body_of, move
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["ACCURACY",
    "COMPLIANT_PART", "CONE_PART", "TURN_PART", "contact_rows", "facet_rows", "turn_rows",
]  # fmt: skip

CONE_PART, COMPLIANT_PART, TURN_PART = (
    "friction cone", "contact model", "turning on active contacts",
)  # fmt: skip
TOLERANCES = (1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
LONGEST = 1.0  # [s] of the scene
TICK = 1e-3  # [s]
FACETS = (4, 8, 16)
STIFFNESSES = (1e4, 1e5, 1e6, 1e7, 1e8)  # [N/m]
OWN = "own code, located events, the true cone"
RIGID = "the rigid contact of the scene: a difference of models"
REPEATS = 3
Row = dict[str, Any]
Notify = Callable[[str], None]


def facet_rows(_scene_name: str, scene: ResolvedScene, notify: Notify) -> list[Row]:
    """Polygons in place of the cone, in space."""
    model = _rigid(scene)
    if model.body.width == PLANE:
        return []
    exact, cost = _path(model, scene)
    rows = []
    for facets in FACETS:
        notify(f"friction cone: {facets} facets")
        way = dataclasses.replace(model, facets=facets)
        rows += _compared(CONE_PART, f"{facets} facets", OWN, way, scene, exact, notify)
    return rows + _rows(CONE_PART, "true cone", cost, OWN, exact, exact, model)


def turn_rows(_scene_name: str, scene: ResolvedScene, notify: Notify) -> list[Row]:
    """The body of the scene, tipping over on a corner or an edge that holds, by tolerance; that of
    the scene is one of them.
    """
    case = tipping(_rigid(scene).body)
    if case is None:
        return []
    rows: list[Row] = []
    for tolerance in sorted({*TOLERANCES, float(scene.data["integrator"]["relative_tolerance"])}, reverse=True):
        notify(f"turning on active contacts: tolerance {tolerance:g}")
        try:
            error = tip_error(case, tolerance)
        except ArithmeticError as failure:
            notify(f"{TURN_PART}: tolerance {tolerance:g} has no answer: {failure}")
            continue
        cost = milliseconds(lambda tolerance=tolerance: tip(case, tolerance)) / case.duration  # type: ignore[misc]
        rows.append({
            "quantity": "position", "part": TURN_PART, "level": f"{tolerance:g}", "grid": "", "tolerance": tolerance,
            "error": error, "reference": REFERENCE, "ms_per_simulated_s": cost,
        })  # fmt: skip
    return rows


def contact_rows(_scene_name: str, scene: ResolvedScene, notify: Notify) -> list[Row]:
    """The compliant twin by stiffness, its friction spring as stiff, against the rigid contact."""
    model = _rigid(scene)
    exact, cost = _path(model, scene)
    rows = []
    for stiffness in STIFFNESSES:
        notify(f"contact model: {stiffness:.0e} N/m")
        contact = compliant_contact(model.body, NormalElastic(stiffness, 1.0), stiffness)
        way = dataclasses.replace(model, contact=contact)
        rows += _compared(COMPLIANT_PART, f"compliant, {stiffness:.0e} N/m", RIGID, way, scene, exact, notify)
    return rows + _rows(COMPLIANT_PART, "rigid", cost, RIGID, exact, exact, model)


def _compared(
    part: str, level: str, reference: str, way: BlockModel, scene: ResolvedScene, exact: tuple[Vector, Vector], notify: Notify
) -> list[Row]:  # fmt: skip
    try:
        found, cost = _path(way, scene)
    except RunError as error:
        notify(f"{part}: {level} has no answer: {error}")
        return []
    return _rows(part, level, cost, reference, found, exact, way)


def _rigid(scene: ResolvedScene) -> BlockModel:
    return dataclasses.replace(build_block(scene), contact=None, facets=0)


def _path(model: BlockModel, scene: ResolvedScene) -> tuple[tuple[Vector, Vector], float]:
    """Positions [ticks, width] with the orientation at the end, and the least time [ms] per
    simulated second.
    """
    duration = min(LONGEST, float(scene.data["duration"]))
    costs: list[float] = []
    found: tuple[Vector, Vector] = (numpy.zeros((0, 0)), numpy.zeros((0, 0)))
    for _ in range(REPEATS + 1):  # the first compiles
        motion = Motion(*(numpy.array(part) for part in model.start))
        began = time.process_time()
        positions = numpy.array(list(_positions(model, motion, round(duration / TICK))))
        costs.append(time.process_time() - began)
        found = (positions, numpy.asarray(motion.rotation))
        if sum(costs[1:]) > duration:
            break
    return found, 1e3 * min(costs[1:]) / duration


def _positions(model: BlockModel, motion: Motion, ticks: int) -> Iterator[Vector]:
    body = body_of(model, motion)
    for _ in range(ticks):
        move(body, model, TICK)
        yield motion.position.copy()


def _rows(
    part: str, level: str, cost: float, reference: str, found: tuple[Vector, Vector], exact: tuple[Vector, Vector],
    model: BlockModel,
) -> list[Row]:  # fmt: skip
    points = numpy.linalg.norm(model.body.points, axis=1)
    apart = numpy.linalg.norm(found[0] - exact[0], axis=1) / (points.max() + model.body.radius)
    values = {"path": apart.max(), "end": apart[-1], "turn": _angle(found[1].T @ exact[1])}
    head = {
        "part": part, "level": level, "grid": "", "tolerance": None, "reference": reference, "ms_per_simulated_s": cost
    }  # fmt: skip
    return [{"quantity": quantity, "error": float(error), **head} for quantity, error in values.items()]


def _angle(turn: Vector) -> float:
    """Of a rotation matrix, from its skew part: exact for small angles."""
    sine = float(numpy.linalg.norm(turn - turn.T)) / (8.0**0.5)
    cosine = (float(numpy.trace(turn)) - (1.0 if len(turn) == 3 else 0.0)) / 2.0
    return float(numpy.arctan2(sine, cosine))


ACCURACY = tuple(
    AccuracyStudy(rows, (AccuracyPart(part, heading, panel, level),))
    for rows, part, heading, panel, level in (
        (
            turn_rows, TURN_PART, "body that turns on active contacts: distance over that from the corner",
            "body that turns on active contacts", "",
        ),
        (
            facet_rows, CONE_PART, "friction cone: distance over the body's size, turn in rad",
            "rigid contact, friction cone", "cone",
        ),
        (
            contact_rows, COMPLIANT_PART, "contact model: difference of the two, the same", "compliant against rigid contact",
            "contact",
        ),
    )
)  # fmt: skip
