"""Accuracy and cost of the time integration: the asked tolerance, and the corrector passes between field instants."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy

from contact_sim_pkg.bag.messages import decode_contact_force
from contact_sim_pkg.core.parameters import Vector
from contact_sim_pkg.core.rigs import advance as columns
from contact_sim_pkg.reference.vehicle import normal_force
from contact_sim_pkg.run.simulation import Simulation
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.studies.scene_drive import SceneDrive, drive_of, fast_run, load_resolved, slow_run, twin_laws

__all__ = ["corrector_rows", "simulate", "tolerance_rows"]

DURATION = 2.0  # [s] of the scene
TOLERANCES = tuple(10.0**-power for power in range(3, 11))
PASSES, REFERENCE_PASSES = range(4), 8
REPEATS = 9
TWIN = "scipy DOP853, no shared code"


def tolerance_rows(scene: ResolvedScene, tell: Callable[[str], None]) -> list[dict[str, Any]]:
    """Motion and normal forces of the scene's rig with point contacts, for each tolerance of the integrator."""
    drive = drive_of(scene, DURATION)
    tell(f"integrator: reference for {DURATION:g} s by scipy")
    exact = slow_run(drive)[:-1]
    exact_forces = _forces(drive, exact)
    asked = float(scene.data["integrator"]["relative_tolerance"])
    rows = []
    for tolerance in TOLERANCES:
        tell(f"integrator: tolerance {tolerance:.0e}")
        scale = drive.model.scale * (tolerance / asked)
        states, forces = fast_run(drive, scale)
        cost = 1e3 * _timed(partial(fast_run, drive, scale)) / (len(drive.height) - 1) / drive.segment
        errors = {
            "motion": _motion_error(states[:, :-2], exact),
            "normal force": _largest(_normal(drive, forces), exact_forces),
        }
        rows += [_row(name, "integrator", "", tolerance, error, TWIN, cost) for name, error in errors.items()]
    return rows


def corrector_rows(scene_name: str, scene: ResolvedScene, tell: Callable[[str], None]) -> list[dict[str, Any]]:
    """Normal force of each contact with a field for 0 to 3 corrector passes, at the grids that the scene asks for."""
    contacts = [name for name, effects in scene.data["effects"].items() if effects and effects.get("contact_field")]
    if not contacts:
        return []
    runs = {}
    for passes in (*PASSES, REFERENCE_PASSES):
        tell(f"corrector: {passes} passes")
        values = [f"effects.{contact}.contact_field.corrector_passes={passes}" for contact in contacts]
        runs[passes] = simulate(load_resolved(scene_name, *values), DURATION)
    exact, _cost = runs[REFERENCE_PASSES]
    rows = []
    for contact in contacts:
        field = scene.data["effects"][contact]["contact_field"]
        grid, reference = f"{field['rows']}x{field['cols']}", f"own code, {REFERENCE_PASSES} passes"
        for passes in PASSES:
            forces, cost = runs[passes]
            error = _largest([forces[contact]], [exact[contact]])
            row = _row(f"{contact} force", "corrector", grid, float(field["tolerance"]), error, reference, cost)
            rows.append({**row, "passes": passes})
    return rows


def simulate(scene: ResolvedScene, duration: float) -> tuple[dict[str, Vector], float]:
    """Normal force [N] of each contact over `duration` [s], and ms per simulated second of the simulation alone."""
    sources, simulation = make_sources(scene), Simulation(scene)
    simulation.prepare()
    length = simulation.model.timing.block_length
    forces: dict[str, list[Vector]] = {"tire": [], "seat": []}
    walls = []
    for block in range(min(simulation.blocks, round(duration / length))):
        result = simulation.advance(block, {topic: source.block(block) for topic, source in sources.items()})
        walls.append(result.wall_time)
        for topic, _stamp, data in result.messages:
            contact, _, kind = topic.partition("/")
            if kind == "force":
                forces[contact].append(decode_contact_force(data).normal)
    joined = {contact: numpy.concatenate(parts) for contact, parts in forces.items() if parts}
    return joined, 1e3 * statistics.median(walls) / length


def _row(
    quantity: str, part: str, grid: str, tolerance: float, error: float, reference: str, cost: float
) -> dict[str, Any]:
    return {
        "quantity": quantity, "part": part, "rung": "", "grid": grid, "tolerance": tolerance, "error": error,
        "reference": reference, "ms_per_simulated_s": cost,
    }  # fmt: skip


def _timed(call: Callable[[], object]) -> float:
    """Shortest wall time [s] of some calls: what else the machine does only ever adds."""
    walls = []
    for _ in range(REPEATS):
        began = time.perf_counter()
        call()
        walls.append(time.perf_counter() - began)
    return min(walls)


def _motion_error(found: Vector, exact: Vector) -> float:
    """Largest error of a state over the largest excursion of that state from its start, over all samples."""
    excursion = numpy.abs(exact - exact[0]).max(axis=0)
    moving = excursion > 1e-9 * excursion.max()
    return float((numpy.abs(found - exact).max(axis=0)[moving] / excursion[moving]).max())


def _largest(found: list[Vector], exact: list[Vector]) -> float:
    """Largest error over the largest value, worst of some signals."""
    pairs = zip(found, exact, strict=True)
    return max(float(numpy.abs(one - other).max() / numpy.abs(other).max()) for one, other in pairs)


def _normal(drive: SceneDrive, forces: Vector) -> list[Vector]:
    rig = drive.model.rig
    chosen = ((rig.tire, columns.TIRE_NORMAL), (rig.seat, columns.SEAT_NORMAL))
    return [forces[:, column] for part, column in chosen if part is not None]


def _forces(drive: SceneDrive, states: Vector) -> list[Vector]:
    """Normal forces from the twin's states, by the twin's law; seen from the right of each instant, as the samples are."""
    rig, height = drive.model.rig, drive.height
    rate = numpy.diff(height) / drive.segment
    tire_law, seat_law = twin_laws(rig)
    found = []
    if tire_law is not None:
        approach, speed = height[:-1] - states[:, 0], rate - states[:, 2]
        found.append(numpy.array([normal_force(tire_law, x, v) for x, v in zip(approach, speed, strict=True)]))
    if seat_law is not None and rig.seat is not None:
        first = rig.seat.offset
        second = first + 1 + len(rig.seat.masses)
        floor = (0.0, 0.0) if rig.tire is None else (states[:, 1], states[:, 3])
        approach, speed = floor[0] - states[:, first], floor[1] - states[:, second]
        found.append(numpy.array([normal_force(seat_law, x, v) for x, v in zip(approach, speed, strict=True)]))
    return found
