"""Accuracy and cost of the impact rig: the first impact of a scene by each way to it, against
scipy.

No tolerance acts on this rig: its series are at rounding. What costs accuracy is the way: closed
forms, equivalent constants, the table, the free impact without weight, and the run's own contact
under weight. A way that has no answer has no row.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy

from contact_sim_lab.records.accuracy import AccuracyPart, AccuracyStudy
from contact_sim_lab.rigs.impact.twins.weighted_impact import impact_under_weight
from contact_sim_pkg.rigs.impact.model import FirstContact, ImpactModel, build_impact
from contact_sim_pkg.rigs.impact.motion import ImpactMotion
from contact_sim_pkg.rigs.impact.theory.closed_form.force import elastic_force
from contact_sim_pkg.rigs.impact.theory.closed_form.scalings import (
    closed_duration,
    closed_restitution,
    damped_sine,
    depth_of_restitution,
)
from contact_sim_pkg.rigs.impact.theory.contact import touch
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.motion import solve_impact
from contact_sim_pkg.rigs.impact.theory.table import look_up
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["ACCURACY", "way_rows"]

QUANTITIES = ("restitution", "contact time", "depth", "peak force")
TWIN = "scipy DOP853 under weight, no shared code"
LONGEST = 5.0  # [s] of the scene in which impacts are counted
REPEATS = 21
Answer = tuple[float, float, float, float]


def way_rows(_scene_name: str, scene: ResolvedScene, notify: Callable[[str], None]) -> list[dict[str, Any]]:
    """Restitution, contact time, depth and peak force of the first impact by each way."""
    model = build_impact(scene)
    release = model.releases[0]
    found = model.touch(release.speed, release.temperature)
    law = found.law
    notify("impact: reference")
    exact = impact_under_weight(law.mass, law.gravity, law.elastic, law.viscous, release.speed, law.end == "gap")
    # Impacts per simulated second, for the cost.
    span = min(LONGEST, float(scene.data["duration"]))
    rate = len(ImpactMotion(model).pop_ended(span)) / span
    rows = []
    for name, way in _ways(model, found).items():
        notify(f"impact: {name}")
        # A closed form that does not reach this material has no row.
        try:
            answer = way()
        except ImpactError:
            continue
        head: dict[str, Any] = {"part": "first impact", "level": name, "grid": "", "tolerance": None, "reference": TWIN}
        head["ms_per_simulated_s"] = _milliseconds(way) * rate
        rows += [
            {"quantity": quantity, "error": abs(value / true - 1.0), **head}
            for quantity, value, true in zip(QUANTITIES, answer, exact, strict=True)
        ]
    return rows


def _ways(model: ImpactModel, found: FirstContact) -> dict[str, Callable[[], Answer]]:
    return {
        "closed forms": partial(_closed, found),
        "equivalent constants": partial(_constants, found),
        "table": partial(_table, found),
        "free impact": partial(_free, found),
        "as it is run, under weight": partial(_run, model),
    }


def _closed(found: FirstContact) -> Answer:
    free = found.impact
    modulus = free.material.storage_modulus
    k = closed_restitution(free.material.loss_tangent)
    depth = depth_of_restitution(free.sphere, modulus, free.speed, k)
    return (
        k,
        closed_duration(free.sphere, modulus, free.speed, k, "corrected"),
        depth,
        elastic_force(free.elastic, depth),
    )


def _constants(found: FirstContact) -> Answer:
    sine = damped_sine(found.impact.sphere, found.impact.material, found.impact.speed, "corrected")
    return sine.restitution, sine.duration, sine.depth, sine.peak_force


def _table(found: FirstContact) -> Answer:
    free = found.impact
    entry = look_up(free.material.loss_tangent, free.end)
    force = free.sphere.mass * free.speed**2 / free.length
    return (
        entry.restitution,
        entry.duration * free.length / free.speed,
        entry.depth * free.length,
        entry.peak_force * force,
    )


def _free(found: FirstContact) -> Answer:
    free = found.impact
    shape = "small" if free.shape == math.sqrt(2.0) else "iterate"
    again = solve_impact(free.sphere, free.material, free.speed, free.end, shape)
    return again.restitution, again.duration, again.depth, again.peak_force


def _run(model: ImpactModel) -> Answer:
    """Law of the touch, and the contact by it."""
    speed, temperature = model.releases[0].speed, model.releases[0].temperature
    phase = touch(model.touch(speed, temperature).law, speed)
    assert phase.turns is not None
    return -phase.last_speed / speed, phase.duration, phase.turns.depth, phase.turns.peak_force


def _milliseconds(way: Callable[[], Answer]) -> float:
    """Median processor time of a call."""
    times = []
    for _ in range(REPEATS):
        began = time.thread_time()
        way()
        times.append(time.thread_time() - began)
    return 1e3 * float(numpy.median(times))


_IMPACT = AccuracyPart("first impact", "first impact of the scene: error", "first impact of the scene", "way")

ACCURACY = (AccuracyStudy(way_rows, (_IMPACT,)),)
