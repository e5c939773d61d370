"""What one block of the impact simulation says, as encoded messages in canonical order."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

import numpy

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.records.messages import (
    BodyMotion,
    ContactForce,
    EnergyLedger,
    ImpactCourse,
    ImpactEvents,
    SolverCost,
)
from contact_sim_pkg.rigs.impact.effects import EFFECT_MESSAGES
from contact_sim_pkg.rigs.impact.model import ImpactModel
from contact_sim_pkg.rigs.impact.motion import Ended, State, course_of
from contact_sim_pkg.run.wrench import wrench_of

NANOSECONDS = 1_000_000_000
Messages = list[tuple[str, int, bytes]]


def encode_block(
    model: ImpactModel, block: int, state: State, ended: list[Ended], pieces: int, began: float
) -> Messages:
    """Messages of a block; ``pieces`` of motion were made for it, work on it began at ``began`` on the performance counter."""
    stamp = block * round(model.timing.block_length * NANOSECONDS)
    messages = _force(model, block, stamp, state)
    if ended:
        events = encode(_events(model, block, ended), stamp, "impact_contact")
        messages.append(("impact/events", stamp, events))
    for impact in ended:
        messages += encode_impact_messages(model, block, stamp, impact)
    messages.append(("bench/motion", stamp, encode(_motion(model, block, state), stamp)))
    messages.append(("bench/energy", stamp, encode(_ledger(model, block, state), stamp)))
    wall = time.perf_counter() - began
    cost = SolverCost(
        block=block,
        wall_time=wall,
        real_time_factor=model.timing.block_length / wall,
        steps=pieces,
        events=len(ended),
    )
    messages.append(("bench/cost", stamp, encode(cost, stamp)))
    messages.sort(key=lambda message: (message[1], TOPICS[message[0]].rank))
    return messages


def _force(model: ImpactModel, block: int, stamp: int, state: State) -> Messages:
    normal, still = numpy.maximum(state.elastic + state.viscous, _lowest(model)), numpy.zeros(len(state.depth))
    period = model.timing.block_length / model.timing.samples
    value = ContactForce(
        block=block, sample_period=period, normal=normal, tangential=still, approach=state.depth, effective_height=still
    )
    messages: Messages = [("impact/force", stamp, encode(value, stamp, "impact_contact"))]
    for i in range(model.timing.displays):
        place = i * model.timing.samples // model.timing.displays
        at = stamp + place * round(model.timing.block_length * NANOSECONDS) // model.timing.samples
        wrench = wrench_of((0.0, 0.0, float(normal[place])), (0.0, 0.0, 0.0))
        messages.append(("impact/wrench", at, encode(wrench, at, "impact_contact")))
    return messages


def _lowest(model: ImpactModel) -> float:
    """The end rule `force` never pulls; rounding at the loss of force would."""
    return 0.0 if model.end == "force" else -math.inf


def _events(model: ImpactModel, block: int, ended: list[Ended]) -> ImpactEvents:
    rows = [_event(model, impact) for impact in ended]
    columns = {
        name: numpy.array([row[name] for row in rows], dtype=numpy.int32 if name in ("number", "release") else None)
        for name in ImpactEvents._fields
        if name != "block"
    }
    return ImpactEvents(block=block, **columns)


def _event(model: ImpactModel, impact: Ended) -> dict[str, Any]:
    law, turns, free = impact.touch.law, impact.stretches[0].turns, impact.touch.impact
    assert turns is not None
    restitution = -impact.loss_speed / impact.speed
    closing = -0.5 * law.mass * impact.speed**2 - law.mass * law.gravity * turns.depth
    opening = 0.5 * law.mass * impact.loss_speed**2 + law.mass * law.gravity * (turns.depth - impact.loss_depth)
    measured = _measured(model, impact.number, impact.speed, impact.duration, restitution)
    return {
        "number": impact.number, "release": impact.release, "start": impact.start, "end": impact.start + impact.duration,
        "mass": law.mass, "radius": model.sphere.radius, "temperature": impact.temperature, "speed": impact.speed,
        "duration": impact.duration, "restitution": restitution, "measured_speed": measured[0],
        "measured_duration": measured[1], "measured_restitution": measured[2], "depth": turns.depth,
        "compression_time": turns.compression_time, "peak_force": turns.peak_force, "peak_time": turns.peak_time,
        "compression_work": closing, "restitution_work": opening, "storage_modulus": free.material.storage_modulus,
        "loss_tangent": free.material.loss_tangent, "shape_factor": free.shape, "gravity": law.gravity,
    }  # fmt: skip


def _measured(model: ImpactModel, number: int, *values: float) -> list[float]:
    """The values with the noise of the gauges: of the scene's seed and the impact's number, so the same in every run."""
    noise = model.effects.get("gauge_noise")
    if noise is None:
        return list(values)
    spread = numpy.array([noise["speed"], noise["duration"], noise["restitution"]])
    drawn = numpy.random.Generator(numpy.random.Philox(key=[model.seed, number])).standard_normal(3)
    return [float(v) for v in numpy.array(values) * numpy.maximum(1.0 + spread * drawn, 1.0e-3)]


def encode_impact_messages(model: ImpactModel, block: int, stamp: int, impact: Ended) -> Messages:
    """Course of an impact, and what the scene's effects say of it."""
    messages: Messages = []
    if model.course_samples:
        times, depth, speed, elastic, viscous = course_of(impact, max(2, model.course_samples))
        course = ImpactCourse(
            block=block, number=impact.number, start=impact.start, time=times, depth=depth, speed=speed,
            elastic_force=elastic, viscous_force=viscous,
        )  # fmt: skip
        messages.append(("impact/course", stamp, encode(course, stamp, "impact_contact")))
    for effect, (topic, make) in EFFECT_MESSAGES.items():
        if model.effects.get(effect) is not None:
            message: Callable[..., Any] = make
            found = message(model, model.effects[effect], block, impact)
            messages.append((f"impact/{topic}", stamp, encode(found, stamp, "impact_contact")))
    return messages


def _motion(model: ImpactModel, block: int, state: State) -> BodyMotion:
    """Height of the sphere's lowest point above the sample, along the blow."""
    period = model.timing.block_length / model.timing.samples
    return BodyMotion(
        block=block, sample_period=period, bodies=("sphere_z",), position=-state.depth[None, :],
        velocity=-state.speed[None, :], acceleration=-state.acceleration[None, :],
    )  # fmt: skip


def _ledger(model: ImpactModel, block: int, state: State) -> EnergyLedger:
    start = 0.5 * model.sphere.mass * model.releases[0].speed ** 2
    kinetic, potential, held, heat, supplied = (
        float(column[0]) for column in (state.kinetic, state.potential, state.stored, state.heat, state.supplied)
    )
    residual = supplied - kinetic - (potential - start) - held - heat
    return EnergyLedger(
        block=block,
        kinetic=kinetic,
        potential=potential - start,
        stored=held,
        dissipated=heat,
        supplied=supplied,
        residual=residual,
    )
