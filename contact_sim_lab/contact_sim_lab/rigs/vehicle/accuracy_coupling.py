"""Accuracy and cost of the coupling: the error that is allowed between two solutions of the
pressure fields.

The error is that of the normal force at every sample of the run, against a run that allows 1e-5 and
may make its coupling steps a quarter as long. `error` is the largest over the largest force; the
quantity ending in `(rms)` is relative to the mean force.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable
from typing import Any

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.pressure_field import PressureFieldSection

__all__ = ["coupling_rows"]

DURATION = 2.0  # [s] of the scene
TOLERANCES = (1.0, 1e-1, 1e-2, 1e-3)
FINEST, FINER_RATE = 1e-5, 4
PART = "coupling"


def coupling_rows(scene_name: str, scene: ResolvedScene, notify: Callable[[str], None]) -> list[dict[str, Any]]:
    """Rows of each contact with a field, at the grids of the scene; none where it has no
    field.
    """
    fields = _fields(scene)
    if not fields:
        return []
    notify(f"coupling: reference, tolerance {FINEST:.0e}")
    exact, every = _reference(scene_name, scene)
    rows = []
    for tolerance in TOLERANCES:
        notify(f"coupling: tolerance {tolerance:.0e}")
        forces, cost = simulate(load_resolved(scene_name, f"integrator.coupling_tolerance={tolerance}"), DURATION)
        for contact, (_name, field) in fields.items():
            reference = exact[contact][::every]
            missed = forces[contact] - reference
            errors = {
                "": float(numpy.abs(missed).max() / reference.max()),
                " (rms)": float(missed.std() / reference.mean()),
            }
            rows += [
                {
                    "quantity": f"{contact} force{kind}", "part": PART, "level": "", "grid": f"{field.rows}x{field.cols}",
                    "tolerance": tolerance, "error": error, "reference": f"own code, tolerance {FINEST:.0e}",
                    "ms_per_simulated_s": cost,
                }
                for kind, error in errors.items()
            ]  # fmt: skip
    return rows


def _reference(scene_name: str, scene: ResolvedScene) -> tuple[dict[str, Vector], int]:
    """Forces of the finest run, and how many of its samples make one of the scene's."""
    finest = f"integrator.coupling_tolerance={FINEST}"
    passes = [f"effects.{contact}.{name}.corrector_passes=8" for contact, (name, _field) in _fields(scene).items()]
    rate = float(scene.data["outputs"]["force_rate"])
    try:
        finer = load_resolved(scene_name, finest, *passes, f"outputs.force_rate={FINER_RATE * rate:.12g}")
    except SceneError:  # no whole number of nanoseconds
        return simulate(load_resolved(scene_name, finest, *passes), DURATION)[0], 1
    return simulate(finer, DURATION)[0], FINER_RATE


def _fields(scene: ResolvedScene) -> dict[str, tuple[str, PressureFieldSection]]:
    """Contact -> name and keys of its pressure field."""
    return {
        contact: (record.name, keys)
        for contact in scene.data["effects"]
        for record, keys in scene.effects_at(contact)
        if isinstance(keys, PressureFieldSection)
    }


def simulate(scene: ResolvedScene, duration: float) -> tuple[dict[str, Vector], float]:
    """Normal force [N] of each contact over `duration` [s], [samples], and the cost of the
    simulation alone.

    Cost in ms per simulated second; arrays are one for each contact.
    """
    sources, simulation = make_sources(scene), make_simulation(scene)
    simulation.prepare()
    length = float(scene.data["block_length"])
    # Forces of all blocks, and the wall time of each.
    forces: dict[str, list[Vector]] = {}
    walls = []
    for block in range(min(simulation.blocks, round(duration / length))):
        result = simulation.advance(block, {topic: source.block(block) for topic, source in sources.items()})
        walls.append(result.wall_time)
        for output in result.outputs:
            contact, _, kind = output.topic.partition("/")
            if kind == "force":
                forces.setdefault(contact, []).append(output.record.normal)
    joined = {contact: numpy.concatenate(parts) for contact, parts in forces.items()}
    return joined, 1e3 * statistics.median(walls) / length
