"""Accuracy and cost of the roller rig: ellipse, tilt and yaw, heave, dangerous volumes, time
acceleration of a scene.

Each part is measured where the scene has its effect. References: 50 digits (ellipse), scipy
(motions; the moments and loads are own code), three times finer cells (volumes), every turn ridden
(time acceleration).
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

import numpy
from scipy.integrate import solve_ivp

from contact_sim_lab.records.accuracy import AccuracyPart, AccuracyStudy
from contact_sim_lab.records.work_precision import milliseconds, timed_once
from contact_sim_lab.twins import hertz as reference
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigs.roller.block_motion import TiltYaw
from contact_sim_pkg.rigs.roller.model import RollerModel, build_roller
from contact_sim_pkg.rigs.roller.ride import TrackRide
from contact_sim_pkg.rigs.roller.settings import volume_settings
from contact_sim_pkg.rigs.roller.theory.ellipse import EXACT, POLYNOMIAL, contact_of_rollers, principal_curvatures
from contact_sim_pkg.rigs.roller.theory.heave import Heave, Path, ride
from contact_sim_pkg.rigs.roller.theory.load_split import load_of_approach
from contact_sim_pkg.rigs.roller.theory.moments import moments
from contact_sim_pkg.rigs.roller.theory.motion import gauss_rule, integrate_tilt_yaw
from contact_sim_pkg.rigs.roller.theory.volumes import INTERPOLATED, Volumes, dangerous_volumes
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["ACCURACY", "PARTS", "rows"]

PARTS = ("ellipse", "tilt and yaw", "heave", "dangerous volume", "time acceleration")

Rows = list[dict[str, Any]]

MOST_INSTANTS = 9
SPAN = 0.02  # [s] of tilt and yaw
VOLUME_CELLS = ((0.25, "a quarter"), (0.5, "half"), (1.0, "as it is run"), (2.0, "twice"))
FINER = 3.0
ACCELERATIONS = (0.1, 1.0, 10.0)


def rows(_scene_name: str, scene: ResolvedScene, notify: Callable[[str], None]) -> Rows:
    """All parts that the scene has."""
    model = build_roller(scene)
    found: Rows = []
    for part, measure in zip(PARTS, (_ellipse, _tilt_yaw, _heave, _volumes, _acceleration), strict=True):
        notify(f"roller: {part}")
        found += [{"part": part, **row} for row in measure(model)]
    return found


def _row(quantity: str, fidelity: str, error: float, against: str, cost: float, grid: str = "") -> dict[str, Any]:
    return {
        "quantity": quantity, "level": fidelity, "grid": grid, "tolerance": None, "error": error, "reference": against,
        "ms_per_simulated_s": cost,
    }  # fmt: skip


def _ellipse(model: RollerModel) -> Rows:
    """Worst over the instants of the programme."""
    programme = model.programme
    times = programme.time[:: max(1, len(programme.time) // MOST_INSTANTS)]
    cases = []
    for at in times:
        curvatures, load = programme.curvatures_at(float(at)), float(programme.loads(numpy.array([at]))[0])
        cases.append((curvatures, model.start[1], model.modulus, model.contact_load(load, curvatures)))
    right = [_reference(*case) for case in cases]
    rate = model.timing.samples / model.timing.block_length
    found = []
    for name, kind in (("polynomial (eq 10)", POLYNOMIAL), ("AGM and Newton", EXACT)):
        got = [contact_of_rollers(*case, kind) for case in cases]
        values = [(max(c[:2]), min(c[:2]), c.peak_pressure, c.approach) for c in got]
        errors = numpy.abs(numpy.array(values) / numpy.array(right) - 1.0).max(axis=0)
        cost = milliseconds(lambda kind=kind: contact_of_rollers(*cases[0], kind)) * rate  # type: ignore[misc]
        for quantity, error in zip(("larger axis", "smaller axis", "peak pressure", "approach"), errors, strict=True):
            found.append(_row(quantity, name, float(error), "mpmath, 50 digits, no shared code", cost))
    return found


def _reference(curvatures: Any, yaw: float, modulus: float, load: float) -> tuple[float, float, float, float]:
    smaller, larger = sorted(principal_curvatures(curvatures, yaw)[:2])
    exact = reference.contact_at_load(smaller, larger, modulus, load)
    return exact.a, exact.b, exact.peak_pressure, exact.approach


def _tilt_yaw(model: RollerModel) -> Rows:
    """From the start of the scene under its first load, with a tilt of 1 mrad beside."""
    if not model.turns:
        return []
    curvatures, roller = model.programme.curvatures_at(0.0), model.roller
    load = model.contact_load(float(model.programme.load[0]), curvatures)
    begun = TiltYaw(model, load)
    start = begun.state[:4] + numpy.array([1e-3, 0.0, 0.0, 0.0])
    # The linear part of the equations for scipy; the moments are those of the bench.
    inertia = numpy.array([[roller.inertia_tilt, roller.inertia_product], [roller.inertia_product, roller.inertia_yaw]])
    gyro = roller.inertia_spin * roller.spin
    damping = numpy.array([[roller.damping_tilt, gyro], [-gyro, roller.damping_yaw]])
    springs = numpy.array([roller.stiffness_tilt, roller.stiffness_yaw])

    def slope(_t: float, y: Vector) -> Vector:
        pushed = numpy.array(moments(roller, curvatures, model.bending, model.modulus, load, float(y[0]), float(y[1])))
        return numpy.concatenate([y[2:], numpy.linalg.solve(inertia, pushed - springs * y[:2] - damping @ y[2:])])

    right = solve_ivp(slope, (0.0, SPAN), start, method="DOP853", rtol=1e-13, atol=1e-17).y[:2, -1]
    found = []
    for phase, stages in ((0.6, 1), (0.6, 2), (0.15, 2), (0.6, 3), (0.15, 3)):
        # Steps by the phase of the fastest motion.
        steps = math.ceil(begun.fastest * SPAN / phase)
        state, record = start.copy(), numpy.empty((2, 4))
        loads, rule = numpy.full(steps + 1, load), gauss_rule(stages)

        def run(
            state: Vector = state, record: Any = record, loads: Vector = loads, rule: Any = rule, n: int = steps
        ) -> None:
            integrate_tilt_yaw(roller, curvatures, model.bending, model.modulus, loads, SPAN / n, rule, state, record)

        integrate_tilt_yaw(
            roller, curvatures, model.bending, model.modulus, loads[:2], SPAN / steps, rule, state.copy(), record
        )
        _, cost = timed_once(run)
        error = float(abs(state[:2] - right).max() / abs(start[:2]).max())
        name = f"order {2 * stages}, {2.0 * math.pi / phase:.3g} steps a period"
        found.append(_row("angles", name, error, "scipy DOP853; moments by own code", cost / SPAN))
    return found


def _heave(model: RollerModel) -> Rows:
    """The first interval of the scene, from rest."""
    if model.track_waves is None:
        return []
    track = TrackRide(model, None)
    heave, path, cell_time = track.heave, track._path(), track.interval_time / track.cells
    size = max(float(numpy.ptp(path.height)), 1e-12)
    right = _ridden_by_scipy(heave, path, cell_time)
    state, loads, motion = numpy.zeros(2), numpy.zeros(track.cells), numpy.zeros((track.cells, 2))
    ride(heave, path, cell_time, 1, state, loads, motion)
    error = abs(float(state[0]) - right) / size
    cost = milliseconds(lambda: ride(heave, path, cell_time, 1, numpy.zeros(2), loads, motion)) / track.interval_time
    against = "scipy DOP853 cell by cell; the law of the load by own code"
    return [_row("heave over the track's range", "as it is run, order 4", error, against, cost, f"{track.cells} cells")]


def _ridden_by_scipy(heave: Heave, path: Path, cell_time: float) -> float:
    rest = heave.contact_coefficient * heave.load ** (2.0 / 3.0) + heave.bending_compliance * heave.load
    soft = 2.0 / 3.0 * heave.contact_coefficient / heave.load ** (1.0 / 3.0) + heave.bending_compliance
    drag = 2.0 * heave.damping_ratio / math.sqrt(heave.mass * soft)
    y = numpy.zeros(2)
    for j in range(len(path.height) - 1):
        rise, soften = path.height[j + 1] - path.height[j], path.coefficient[j + 1] - path.coefficient[j]

        def slope(t: float, y: Vector, j: int = j, rise: float = rise, soften: float = soften) -> list[float]:
            share = t / cell_time
            approach = rest + path.height[j] + rise * share - float(y[0])
            load = load_of_approach(path.coefficient[j] + soften * share, heave.bending_compliance, approach)
            return [float(y[1]), (load - heave.load) / heave.mass - drag * float(y[1])]

        y = solve_ivp(slope, (0.0, cell_time), y, method="DOP853", rtol=1e-11, atol=1e-18).y[:, -1]
    return float(y[0])


def _volumes(model: RollerModel) -> Rows:
    """At the first instant of the scene; the cost is that of all its instants."""
    below = model.subsurface
    if below is None:
        return []
    at = below.instants[0]
    curvatures = model.programme.curvatures_at(at)
    load = model.contact_load(float(model.programme.loads(numpy.array([at]))[0]), curvatures)
    contact = model.contact(load, model.start[1], curvatures)
    limits, cells, _none, traction = volume_settings(model)

    def measure(share: float) -> Volumes:
        cut = tuple(max(2, round(share * number)) for number in cells)
        return dangerous_volumes(
            contact, model.poisson_ratio, limits, (cut[0], cut[1], cut[2]), None, traction, INTERPOLATED
        )

    measure(0.01)
    right = measure(FINER).any
    found = []
    duration = model.timing.blocks * model.timing.block_length
    for share, name in VOLUME_CELLS:
        value, cost = timed_once(lambda share=share: measure(share))  # type: ignore[misc]
        error = abs(value.any / right - 1.0) if right > 0.0 else abs(value.any)
        grid = "x".join(str(max(2, round(share * number))) for number in cells)
        cost *= len(below.instants) / duration
        found.append(_row("V_T", name, error, f"own code, {FINER:g} times as many cells each way", cost, grid))
    return found


def _acceleration(model: RollerModel) -> Rows:
    """From the start of the scene, cost of a second of the rig."""
    if model.damage is None or model.acceleration == 1.0:
        return []
    begun = TrackRide(model, None)
    # Let the wear settle before it is accelerated.
    for _ in range(20):
        begun.advance()
    found = []
    for share in ACCELERATIONS:
        ride_on = begun.copy()
        ride_on.accelerate(max(2.0, share * model.acceleration))
        checked = ride_on.check()
        if checked is None or math.isnan(checked.error):
            continue
        # Cost of one accelerated interval.
        began = time.thread_time()
        ride_on.advance()
        cost = 1e3 * (time.thread_time() - began) / (ride_on.interval_time * ride_on.acceleration)
        against = f"own code, every one of {checked.intervals} turns ridden"
        found.append(
            _row(
                "change of the track from its start, a second of the rig",
                f"a turn stands for {ride_on.acceleration:g}",
                checked.error,
                against,
                cost,
            )
        )
    return found


ACCURACY = (AccuracyStudy(rows, tuple(AccuracyPart(part, f"{part}: error", part, "way") for part in PARTS)),)
