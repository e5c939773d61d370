"""A scene's rig with point contacts, and what drives it over a time, as arrays: for studies that
leave out bag and fields.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy

from contact_sim_lab.twins.vehicle import (
    Belt,
    Law,
    Occupant,
    Quarter,
    law_by_table,
    power_law,
    states_at_segments,
)
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.results import DONE, SENTENCES
from contact_sim_pkg.integrate.dormand_prince import make_workspace
from contact_sim_pkg.laws.parameters import Contact, GeneralDissipative, NormalElastic, TabulatedElastic
from contact_sim_pkg.laws.tabulated_elastic import FORCE
from contact_sim_pkg.rigs.vehicle.model import Model, build, standing_state
from contact_sim_pkg.rigs.vehicle.motion import entries
from contact_sim_pkg.rigs.vehicle.motion.columns import FORCES
from contact_sim_pkg.rigs.vehicle.motion.parameters import Seat
from contact_sim_pkg.rigs.vehicle.motion.spring import Spring
from contact_sim_pkg.rigs.vehicle.motion.vehicle import event_count
from contact_sim_pkg.rigs.vehicle.run.drive import rate_at_start
from contact_sim_pkg.rigs.vehicle.tire.footprint import effective_heights
from contact_sim_pkg.rigs.vehicle.tire.schema import AsperityImpulsesSection
from contact_sim_pkg.run.sources import make_sources, make_travel
from contact_sim_pkg.scene.resolve import ResolvedScene
from contact_sim_pkg.scene.schema.laws import FrictionSection
from contact_sim_pkg.scene.schema.pressure_field import PressureFieldSection

__all__ = ["SceneDrive", "drive_of", "fast_run", "slow_run", "twin_laws"]

LEFT_OUT = (PressureFieldSection, FrictionSection, AsperityImpulsesSection)
"""Effects of fields, of impulses, and of what does not act on z."""


class SceneDrive(NamedTuple):
    """Drive at the ends of all segments, and the state in which the rig stands at the start."""

    model: Model
    segment: float  # [s]
    height: Vector  # [m] effective height of the road
    acceleration_x: Vector  # [m/s^2]
    acceleration_z: Vector
    start: Vector


def drive_of(scene: ResolvedScene, duration: float, builder: Callable[[ResolvedScene], Model] = build) -> SceneDrive:
    """Drive of the scene's rig, made by `builder`, with point contacts, less the effects `LEFT_OUT`,
    over `duration` [s].

    Whole blocks, one at least; the road as effective heights [m] of the footprint.
    """
    named = [each for contact in ("tire", "seat") for each in scene.effects_at(contact)]
    plain = scene.without(*(record for record, keys in named if isinstance(keys, LEFT_OUT)))
    model, sources = builder(plain), make_sources(plain)
    timing = model.timing
    blocks = max(1, min(timing.blocks, round(duration / timing.block_length)))
    steps = timing.intervals * timing.segments
    shape = blocks * steps + 1
    height, a_x, a_z = numpy.zeros(shape), numpy.zeros(shape), numpy.zeros(shape)
    travel = make_travel(plain) if model.tire_geometry is not None else None
    # Road and vibration of each block at the ends of its segments; blocks share an end.
    for block in range(blocks):
        part = slice(block * steps, (block + 1) * steps + 1)
        if travel is not None:
            positions = numpy.array([travel.position(i * timing.segment_length) for i in range(part.start, part.stop)])
            _fill_heights(model, sources["road/patch"].block(block), positions, height[part])
        if "platform/vibration" in sources:
            vibration: Any = sources["platform/vibration"].block(block)
            at = numpy.arange(steps + 1) / timing.vibration_stride
            index = numpy.arange(len(vibration.acceleration_z))
            a_x[part] = numpy.interp(at, index, vibration.acceleration_x)
            a_z[part] = numpy.interp(at, index, vibration.acceleration_z)
    rate = float(height[1] - height[0]) / timing.segment_length
    if travel is not None:
        rate = rate_at_start(model, travel, sources["road/patch"].block(0), rate, 0.0)
    return SceneDrive(model, timing.segment_length, height, a_x, a_z, standing_state(model, float(height[0]), rate))


def _fill_heights(model: Model, patch: Any, positions: Vector, out: Vector) -> None:
    geometry = model.tire_geometry
    assert geometry is not None
    slopes = numpy.empty_like(out)
    effective_heights(patch.height, patch.first_row, patch.cell_x, geometry.weights, positions, out, slopes)


def fast_run(drive: SceneDrive, scale: Vector) -> tuple[Vector, Vector]:
    """States [segments, states] and forces [segments, FORCES] at the starts of all segments, by the
    bench's kernels.

    scale: absolute tolerances [states]. Raises ArithmeticError where a kernel fails.
    """
    count, states = len(drive.height) - 1, len(drive.start)
    samples = (numpy.zeros((count, states)), numpy.zeros((count, states)), numpy.zeros((count, FORCES)))
    state, mode = drive.start.copy(), numpy.zeros(1, dtype=numpy.int64)
    rig, a_x, a_z = drive.model.rig, drive.acceleration_x, drive.acceleration_z
    work, cushion = make_workspace(states, event_count(rig)), numpy.zeros(count + 1)
    entries.start(
        rig, mode, state, work, drive.segment, drive.height[:2], cushion[:2], a_x[:2], a_z[:2], None, (None, None)
    )
    status = entries.advance(
        rig,
        mode,
        state,
        scale,
        work,
        0.0,
        drive.segment,
        drive.height,
        cushion,
        a_x,
        a_z,
        None,
        (None, None),
        1,
        0,
        *samples,
    )
    if status != DONE:
        raise ArithmeticError(SENTENCES[status])
    return samples[0], samples[2]


def slow_run(drive: SceneDrive) -> Vector:
    """Mechanical states [segments + 1, states] at the ends of all segments, by the independent
    twin.
    """
    quarter, occupant = _twins(drive.model)
    # The twin has the heights of wheel and body before their velocities.
    order = numpy.arange(len(drive.start) - 2)
    if quarter is not None:
        order[[1, 2]] = 2, 1
    found = states_at_segments(
        drive.model.rig.gravity, quarter, occupant, drive.start[order], drive.segment, drive.height,
        numpy.zeros(len(drive.height)), drive.acceleration_z,
    )  # fmt: skip
    return found[:, order]


def twin_laws(model: Model) -> tuple[Law | None, Law | None]:
    """Laws of tire and seat for the twin; None where the rig has no such part."""
    return (
        None if model.quarter is None else _law(model.tire_contact),
        None if model.rig.seat is None else _law(model.rig.seat_contact),
    )


def twin_covers(model: Model) -> bool:
    """Whether the laws of all contacts are among those that the twin has: power laws and
    tables without hysteresis, under an occupant that neither softens nor leans on a seat back.
    """
    rig = model.rig
    if rig.back is not None or (rig.seat is not None and rig.seat.softening is not None):
        return False
    present = ((model.quarter, model.tire_contact), (rig.seat, rig.seat_contact))
    return all(_is_covered(contact) for part, contact in present if part is not None)


def _is_covered(contact: Contact | None) -> bool:
    return contact is not None and _elastic_of(contact) is not None and contact.hysteresis is None


def _elastic_of(contact: Contact) -> Callable[[float], float] | None:
    """Elastic force [N] of the approach [m] for the twin; None where it has no such law."""
    if isinstance(contact.elastic, TabulatedElastic):
        return law_by_table(contact.elastic.spacing, contact.elastic.pieces[:, FORCE])
    return power_law(*contact.elastic) if isinstance(contact.elastic, NormalElastic) else None


def _law(contact: Contact | None) -> Law:
    elastic = None if contact is None or contact.hysteresis is not None else _elastic_of(contact)
    if contact is None or elastic is None:
        raise ValueError("the slow twin covers laws without hysteresis only; leave out foam and foam_hysteresis")
    loss = contact.dissipative
    if isinstance(loss, GeneralDissipative):
        powers = loss.coefficient, loss.approach_exponent, loss.rate_exponent
        return Law(elastic, 0.0, powers, loss.lowest_force)
    return Law(elastic, 0.0 if loss is None else loss.damping)


def _occupant(seat: Seat, law: Law) -> Occupant:
    return Occupant(seat.masses, seat.ends, seat.springs[0], seat.springs[1], law)


def _twins(model: Model) -> tuple[Quarter | None, Occupant | None]:
    seat, quarter = model.rig.seat, None
    if model.quarter is not None:
        wheel, body, belt, _contact, _push, sidewalls, suspension, _drive = model.quarter
        assert body is not None  # no test machine
        assert isinstance(suspension, Spring)
        on_belt = None if belt is None or sidewalls is None else Belt(belt.mass, sidewalls.stiffness, sidewalls.damping)
        quarter = Quarter(
            wheel.mass, body.mass, suspension.stiffness, suspension.damping, _law(model.tire_contact), on_belt
        )
    return quarter, None if seat is None else _occupant(seat, _law(model.rig.seat_contact))
