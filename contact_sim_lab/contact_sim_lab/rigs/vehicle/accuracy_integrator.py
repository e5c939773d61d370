"""Accuracy and cost of the time integration, with point contacts: the requested tolerance."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy

from contact_sim_lab.rigs.vehicle.scene_drive import (
    SceneDrive,
    drive_of,
    fast_run,
    slow_run,
    twin_covers,
    twin_laws,
)
from contact_sim_lab.twins.vehicle import normal_force
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigs.vehicle.model import Model, build
from contact_sim_pkg.rigs.vehicle.motion import columns
from contact_sim_pkg.rigs.vehicle.motion.ends import base_of
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["tolerance_rows"]

DURATION = 2.0  # [s] of the scene
TOLERANCES = tuple(10.0**-power for power in range(3, 11))
TIGHT = 1e-13
REPEATS = 9
TWIN = "scipy DOP853, no shared code"


def tolerance_rows(
    scene: ResolvedScene, notify: Callable[[str], None], builder: Callable[[ResolvedScene], Model] = build
) -> list[dict[str, Any]]:
    """Motion and normal forces of the scene's rig with point contacts, for each tolerance of the
    integrator; ``builder`` makes its model.
    """
    drive = drive_of(scene, DURATION, builder)
    notify(f"integrator: reference for {DURATION:g} s")
    requested = float(scene.data["integrator"]["relative_tolerance"])
    # One reference for all tolerances.
    exact, exact_forces, reference = _reference(drive, requested)
    rows = []
    for tolerance in TOLERANCES:
        notify(f"integrator: tolerance {tolerance:.0e}")
        scale = drive.model.scale * (tolerance / requested)
        states, forces = fast_run(drive, scale)
        # ms per simulated second.
        cost = 1e3 * _timed(partial(fast_run, drive, scale)) / (len(drive.height) - 1) / drive.segment
        errors = {
            "motion": _motion_error(states[:, :-2], exact),
            "normal force": _largest(_normal(drive, forces), exact_forces),
        }
        rows += [_row(name, "integrator", "", tolerance, error, reference, cost) for name, error in errors.items()]
    return rows


def _reference(drive: SceneDrive, requested: float) -> tuple[Vector, list[Vector], str]:
    """States, normal forces and where they come from: scipy where its twin covers the laws of the
    contacts, own code else.
    """
    if twin_covers(drive.model):
        states = slow_run(drive)[:-1]
        return states, _forces(drive, states), TWIN
    states, forces = fast_run(drive, drive.model.scale * (TIGHT / requested))
    return states[:, :-2], _normal(drive, forces), f"own code, tolerance {TIGHT:.0e}"


def _row(
    quantity: str, part: str, grid: str, tolerance: float, error: float, reference: str, cost: float
) -> dict[str, Any]:
    return {
        "quantity": quantity, "part": part, "level": "", "grid": grid, "tolerance": tolerance, "error": error,
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
    """Largest error of a state over the largest excursion of that state from its start, over all
    samples.
    """
    excursion = numpy.abs(exact - exact[0]).max(axis=0)
    moving = excursion > 1e-9 * excursion.max()
    return float((numpy.abs(found - exact).max(axis=0)[moving] / excursion[moving]).max())


def _largest(found: list[Vector], exact: list[Vector]) -> float:
    """Largest error over the largest value, worst of some signals."""
    pairs = zip(found, exact, strict=True)
    return max(float(numpy.abs(one - other).max() / numpy.abs(other).max()) for one, other in pairs)


def _normal(drive: SceneDrive, forces: Vector) -> list[Vector]:
    rig = drive.model.rig
    chosen = (
        (drive.model.quarter, columns.TIRE_NORMAL),
        (rig.seat, columns.SEAT_NORMAL),
        (rig.back, columns.BACK_NORMAL),
    )
    return [forces[:, column] for part, column in chosen if part is not None]


def _forces(drive: SceneDrive, states: Vector) -> list[Vector]:
    """Normal forces from the twin's states, by the twin's law; seen from the right of each instant,
    as the samples are.
    """
    rig, height = drive.model.rig, drive.height
    rate = numpy.diff(height) / drive.segment
    tire_law, seat_law = twin_laws(drive.model)
    quarter = drive.model.quarter
    found = []
    if tire_law is not None and quarter is not None:
        tread = quarter.tread.place
        approach, speed = height[:-1] - states[:, tread], rate - states[:, tread + 1]
        found.append(numpy.array([normal_force(tire_law, x, v) for x, v in zip(approach, speed, strict=True)]))
    if seat_law is not None and rig.seat is not None:
        first = rig.seat.offset
        second = first + len(rig.seat.masses)
        base = base_of(rig.seat.floor)
        floor = (0.0, 0.0) if base is None else (states[:, base], states[:, base + 1])
        approach, speed = floor[0] - states[:, first], floor[1] - states[:, second]
        found.append(numpy.array([normal_force(seat_law, x, v) for x, v in zip(approach, speed, strict=True)]))
    return found
