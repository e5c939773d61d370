"""What one block of the impact simulation says, as encoded messages in canonical order."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

import numpy

from contact_sim_pkg.bag.messages import (
    IMPACT_FRAME,
    ContactForceBlock,
    Cost,
    Energy,
    ImpactCourse,
    ImpactEvents,
    MotionBlock,
    Wrench,
    encode_contact_force,
    encode_cost,
    encode_energy,
    encode_impact,
    encode_impact_events,
    encode_motion,
    encode_wrench,
)
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.rigs.impact.effects import EFFECT_MESSAGES
from contact_sim_pkg.rigs.impact.model import ImpactModel
from contact_sim_pkg.rigs.impact.motion import Ended, State, course_of

NANOSECONDS = 1_000_000_000
Messages = list[tuple[str, int, bytes]]


def encode_block(
    model: ImpactModel, block: int, state: State, ended: list[Ended], pieces: int, began: float
) -> Messages:
    """Messages of a block; ``pieces`` of motion were made for it, work on it began at ``began`` on the performance counter."""
    stamp = block * round(model.timing.block_length * NANOSECONDS)
    messages = _force(model, block, stamp, state)
    if ended:
        events = encode_impact_events(_events(model, block, ended), stamp)
        messages.append(("impact/events", stamp, events))
    for impact in ended:
        messages += encode_impact_messages(model, block, stamp, impact)
    messages.append(("bench/motion", stamp, encode_motion(_motion(model, block, state), stamp)))
    messages.append(("bench/energy", stamp, encode_energy(_ledger(model, block, state), stamp)))
    wall = time.perf_counter() - began
    cost = Cost(block, wall, model.timing.block_length / wall, pieces, 0, len(ended), 0, 0.0, 0.0, 0, 0, 0.0)
    messages.append(("bench/cost", stamp, encode_cost(cost, stamp)))
    messages.sort(key=lambda message: (message[1], TOPICS[message[0]].rank))
    return messages


def _force(model: ImpactModel, block: int, stamp: int, state: State) -> Messages:
    normal, still = numpy.maximum(state.elastic + state.viscous, _lowest(model)), numpy.zeros(len(state.depth))
    period = model.timing.block_length / model.timing.samples
    value = ContactForceBlock(block, period, normal, still, state.depth, still)
    messages: Messages = [("impact/force", stamp, encode_contact_force(value, stamp, IMPACT_FRAME))]
    for i in range(model.timing.displays):
        place = i * model.timing.samples // model.timing.displays
        at = stamp + place * round(model.timing.block_length * NANOSECONDS) // model.timing.samples
        wrench = Wrench((0.0, 0.0, float(normal[place])), (0.0, 0.0, 0.0))
        messages.append(("impact/wrench", at, encode_wrench(wrench, at, IMPACT_FRAME)))
    return messages


def _lowest(model: ImpactModel) -> float:
    """The end rule `force` never pulls; rounding at the loss of force would."""
    return 0.0 if model.end == "force" else -math.inf


def _events(model: ImpactModel, block: int, ended: list[Ended]) -> ImpactEvents:
    rows = [_event(model, impact) for impact in ended]
    columns = {
        name: numpy.array([row[name] for row in rows], dtype=numpy.int32 if name in ("number", "release") else None)
        for name in ImpactEvents._fields[1:]
    }
    return ImpactEvents(block, **columns)


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
        course = ImpactCourse(block, impact.number, impact.start, *course_of(impact, max(2, model.course_samples)))
        messages.append(("impact/course", stamp, encode_impact(course, stamp)))
    for effect, (topic, make) in EFFECT_MESSAGES.items():
        if model.effects.get(effect) is not None:
            message: Callable[..., Any] = make
            found = message(model, model.effects[effect], block, impact)
            messages.append((f"impact/{topic}", stamp, encode_impact(found, stamp)))
    return messages


def _motion(model: ImpactModel, block: int, state: State) -> MotionBlock:
    """Height of the sphere's lowest point above the sample, along the blow."""
    period = model.timing.block_length / model.timing.samples
    rows = (-state.depth[None, :], -state.speed[None, :], -state.acceleration[None, :])
    return MotionBlock(block, period, ("sphere_z",), *rows)


def _ledger(model: ImpactModel, block: int, state: State) -> Energy:
    start = 0.5 * model.sphere.mass * model.releases[0].speed ** 2
    kinetic, potential, held, heat, supplied = (
        float(column[0]) for column in (state.kinetic, state.potential, state.stored, state.heat, state.supplied)
    )
    residual = supplied - kinetic - (potential - start) - held - heat
    return Energy(block, kinetic, potential - start, held, heat, supplied, residual)
