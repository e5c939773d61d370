"""Outputs of the impact rig: columns of the messages of one block."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from typing import Any

import numpy

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.records.messages import BodyMotion, ContactForce, EnergyLedger, ImpactCourse, ImpactEvents
from contact_sim_pkg.rigs.impact.effect_outputs import effect_outputs, gauge_readings
from contact_sim_pkg.rigs.impact.model import ImpactModel
from contact_sim_pkg.rigs.impact.motion import FinishedImpact, SphereState, course_of
from contact_sim_pkg.run.outputs import BlockStamps, contact_outputs, energy_ledger, solver_cost


def block_outputs(
    model: ImpactModel, block: int, state: SphereState, ended: list[FinishedImpact], segments: int, began: float
) -> list[Output]:
    """Outputs of a block of ``segments`` of motion; ``began``: start of its work on the performance
    counter [s].
    """
    stamps = BlockStamps(block, model.timing)
    events = [Output("impact/events", stamps.start, _events(model, block, ended))] if ended else []
    outputs = [
        *contact_outputs("impact", stamps, _force(model, stamps, state)), *events,
        *(output for impact in ended for output in impact_outputs(model, stamps, impact)),
        Output("bench/motion", stamps.start, _motion(stamps, state)),
        Output("bench/energy", stamps.start, _ledger(model, block, state)),
    ]  # fmt: skip
    cost = solver_cost(stamps, time.perf_counter() - began, steps=segments, events=len(ended))
    return [*outputs, Output("bench/cost", stamps.start, cost)]


def _force(model: ImpactModel, stamps: BlockStamps, state: SphereState) -> ContactForce:
    normal, still = numpy.maximum(state.elastic + state.viscous, _lowest(model)), numpy.zeros(len(state.depth))
    return ContactForce(
        block=stamps.block, sample_period=stamps.period, normal=normal, tangential=still, approach=state.depth,
        effective_height=still,
    )  # fmt: skip


def _lowest(model: ImpactModel) -> float:
    """The end rule `force` never pulls; rounding at the loss of force would."""
    return 0.0 if model.end == "force" else -math.inf


def _events(model: ImpactModel, block: int, ended: list[FinishedImpact]) -> ImpactEvents:
    rows = [_event(model, impact) for impact in ended]
    columns = {
        name: numpy.array([row[name] for row in rows], dtype=numpy.int32 if name in ("number", "release") else None)
        for name in ImpactEvents._fields
        if name != "block"
    }
    return ImpactEvents(block=block, **columns)


def _event(model: ImpactModel, impact: FinishedImpact) -> dict[str, Any]:
    law, turns, free = impact.touch.law, impact.phases[0].turns, impact.touch.impact
    assert turns is not None
    restitution = -impact.loss_speed / impact.speed
    closing = -0.5 * law.mass * impact.speed**2 - law.mass * law.gravity * turns.depth
    opening = 0.5 * law.mass * impact.loss_speed**2 + law.mass * law.gravity * (turns.depth - impact.loss_depth)
    measured = gauge_readings(model, impact.number, impact.speed, impact.duration, restitution)
    return {
        "number": impact.number, "release": impact.release, "start": impact.start, "end": impact.start + impact.duration,
        "mass": law.mass, "radius": model.sphere.radius, "temperature": impact.temperature, "speed": impact.speed,
        "duration": impact.duration, "restitution": restitution, "measured_speed": measured[0],
        "measured_duration": measured[1], "measured_restitution": measured[2], "depth": turns.depth,
        "compression_time": turns.compression_time, "peak_force": turns.peak_force, "peak_time": turns.peak_time,
        "compression_work": closing, "restitution_work": opening, "storage_modulus": free.material.storage_modulus,
        "loss_tangent": free.material.loss_tangent, "shape_factor": free.shape, "gravity": law.gravity,
    }  # fmt: skip


def impact_outputs(model: ImpactModel, stamps: BlockStamps, impact: FinishedImpact) -> Iterator[Output]:
    """Course of an impact, and the outputs of the scene's effects."""
    if model.course_samples:
        times, depth, speed, elastic, viscous = course_of(impact, max(2, model.course_samples))
        course = ImpactCourse(
            block=stamps.block, number=impact.number, start=impact.start, time=times, depth=depth, speed=speed,
            elastic_force=elastic, viscous_force=viscous,
        )  # fmt: skip
        yield Output("impact/course", stamps.start, course)
    for topic, record in effect_outputs(model, stamps.block, impact):
        yield Output(f"impact/{topic}", stamps.start, record)


def _motion(stamps: BlockStamps, state: SphereState) -> BodyMotion:
    """Height of the sphere's lowest point above the sample, along the blow."""
    return BodyMotion(
        block=stamps.block, sample_period=stamps.period, bodies=("sphere_z",), position=-state.depth[None, :],
        velocity=-state.speed[None, :], acceleration=-state.acceleration[None, :],
    )  # fmt: skip


def _ledger(model: ImpactModel, block: int, state: SphereState) -> EnergyLedger:
    start = 0.5 * model.sphere.mass * model.releases[0].speed ** 2
    kinetic, potential, held, heat, supplied = (
        float(column[0]) for column in (state.kinetic, state.potential, state.stored, state.heat, state.supplied)
    )
    return energy_ledger(
        block, kinetic=kinetic, potential=potential - start, stored=held, dissipated=heat, supplied=supplied
    )
