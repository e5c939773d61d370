"""Compiled entries of the vehicle rig: advance over a row of segments with samples, and the
energies of a state.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy

from contact_sim_pkg.compiled.arrays import Modes, Vector
from contact_sim_pkg.compiled.held import Held
from contact_sim_pkg.compiled.jit import borrowing_kernel, entry, kernel
from contact_sim_pkg.compiled.results import DONE
from contact_sim_pkg.compiled.vectors import copy_row
from contact_sim_pkg.integrate.dormand_prince import DormandPrinceWorkspace, integrate, set_event_directions
from contact_sim_pkg.integrate.drive import Drive
from contact_sim_pkg.integrate.interface import rate
from contact_sim_pkg.rigs.vehicle.motion import vehicle  # noqa: F401 - registers the rig
from contact_sim_pkg.rigs.vehicle.motion.columns import TIRE_SLOPE
from contact_sim_pkg.rigs.vehicle.motion.elements import act, observe
from contact_sim_pkg.rigs.vehicle.motion.elements import energies as energies_beside
from contact_sim_pkg.rigs.vehicle.motion.ground import Ground, ground_at
from contact_sim_pkg.rigs.vehicle.motion.heights import effective_between
from contact_sim_pkg.rigs.vehicle.motion.masses import energies_of_masses
from contact_sim_pkg.rigs.vehicle.motion.parameters import Vehicle

Rates: TypeAlias = "tuple[Vector | None, Vector | None]"
"""Of the heights of road and cushion [m/s]."""


class Moving(NamedTuple):
    """Bodies of a run, the heights that they move on, and their samples."""

    rig: Vehicle
    mode: Modes
    state: Vector  # [states]
    scale: Vector  # [states]
    work: DormandPrinceWorkspace
    height: Vector  # [points] [m] of the road, with what the field adds; and so on
    height_rate: Vector  # [m/s]
    cushion: Vector
    cushion_rate: Vector
    level: Vector  # [points] zeros: the cushion without what its field adds
    states: Vector  # [samples, states]
    rates: Vector  # [samples, states]
    forces: Vector  # [samples, FORCES]


class Course(NamedTuple):
    """A way in time: of whole segments, to points where samples may lie."""

    start: float  # [s]
    segment_length: float  # [s]
    segments: int  # to move over; the heights may reach further
    sample_every: int  # segments
    behind_sample: int  # segments since the last sample
    row: int  # of the next sample


@borrowing_kernel
def _value(values, i):
    if values is None:
        return None
    return values[i]


@borrowing_kernel
def _segment(start, length, i, height, cushion, acceleration_x, acceleration_z, push, rates):
    height_rate, cushion_rate = rates
    return Drive(
        start + i * length, length, height[i], height[i + 1], cushion[i], cushion[i + 1],
        acceleration_x[i], acceleration_x[i + 1], acceleration_z[i], acceleration_z[i + 1],
        _value(push, i), _value(push, i + 1), _value(height_rate, i), _value(height_rate, i + 1),
        _value(cushion_rate, i), _value(cushion_rate, i + 1),
    )  # fmt: skip


@borrowing_kernel
def _observe(rig, drive, mode, state, out):
    """The columns of all elements at the start of the segment."""
    observe(rig.elements, ground_at(drive, drive.start, rig.gravity), mode, state, out)


@entry
def start(
    rig: Vehicle, mode: Modes, state: Vector, work: DormandPrinceWorkspace, segment_length: float, height: Vector, cushion: Vector,
    acceleration_x: Vector, acceleration_z: Vector, push: Vector | None, rates: Rates,
) -> None:  # fmt: skip
    """Set the event directions at the start of a run.

    Arrays hold the ends of the first segment, [2]: ``height``, ``cushion`` [m], accelerations
    [m/s^2], ``push`` [N], ``rates`` as of ``advance``; ``state``: [states]; ``segment_length`` in
    [s].
    """
    drive = _segment(0.0, segment_length, 0, height, cushion, acceleration_x, acceleration_z, push, rates)
    set_event_directions(rig, drive, mode, 0.0, state, work)


@entry
def advance(
    rig: Vehicle, mode: Modes, state: Vector, scale: Vector, work: DormandPrinceWorkspace, start: float, segment_length: float,
    height: Vector, cushion: Vector, acceleration_x: Vector, acceleration_z: Vector, push: Vector | None, rates: Rates,
    sample_every: int, behind_sample: int, sampled_states: Vector, sampled_rates: Vector, sampled_forces: Vector,
) -> int:  # fmt: skip
    """Advance ``state`` over ``len(height) - 1`` segments of ``segment_length`` [s] from time
    ``start`` [s].

    ``height``, ``cushion`` [m], ``acceleration_x``, ``acceleration_z`` [m/s^2], ``push`` [N] (None:
    none): [segments + 1] values at the ends of the segments, linear between. ``rates``: of heights
    and cushion at the same instants [m/s], with which they are cubics between; None: linear. Every
    ``sample_every``-th segment's start is sampled, the first segment lying ``behind_sample``
    segments behind one: state and rates [samples, states] (rates from the right), forces [samples,
    FORCES] in the columns of ``motion/columns.py``. Returns a status of ``compiled/results.py``;
    ``mode``, ``state`` and ``work`` change in place.
    """
    return _advance(
        rig, mode, state, scale, work, start, segment_length, height, cushion, acceleration_x, acceleration_z, push,
        rates, sample_every, behind_sample, sampled_states, sampled_rates, sampled_forces,
    )  # fmt: skip


@entry
def move(
    moving: Held[Moving], course: Course, smooth: Vector, smooth_rate: Vector, acceleration_x: Vector,
    acceleration_z: Vector, push: Vector | None, tire: tuple[float, float, float], seat: tuple[float, float, float],
) -> int:  # fmt: skip
    """Advance bodies over a course, on the effective heights between two fields.

    ``smooth`` [m], ``smooth_rate`` [m/s] and the rest: [segments + 1] from one field to the next.
    ``tire``, ``seat``: corrections [m] at both ends, and four times their sagitta [m]. The rest as
    ``effective_between`` and ``advance``.
    """
    bodies, points = moving.value, smooth.shape[0]
    height, height_rate = bodies.height[:points], bodies.height_rate[:points]
    cushion, cushion_rate = bodies.cushion[:points], bodies.cushion_rate[:points]
    level, duration = bodies.level[:points], (points - 1) * course.segment_length
    effective_between(smooth, smooth_rate, tire, duration, height, height_rate)
    effective_between(level, level, seat, duration, cushion, cushion_rate)
    moved, row = course.segments + 1, course.row
    return _advance(
        bodies.rig, bodies.mode, bodies.state, bodies.scale, bodies.work, course.start, course.segment_length,
        height[:moved], cushion[:moved], acceleration_x, acceleration_z, push, (height_rate, cushion_rate),
        course.sample_every, course.behind_sample, bodies.states[row:], bodies.rates[row:], bodies.forces[row:],
    )  # fmt: skip


@kernel
def _advance(
    rig, mode, state, scale, work, start, segment_length, height, cushion, acceleration_x, acceleration_z, push, rates,
    sample_every, behind_sample, sampled_states, sampled_rates, sampled_forces,
):  # fmt: skip
    """See ``advance``."""
    row = 0
    for i in range(height.shape[0] - 1):
        drive = _segment(start, segment_length, i, height, cushion, acceleration_x, acceleration_z, push, rates)
        # Samples lie at the starts of segments.
        if (i + behind_sample) % sample_every == 0:
            copy_row(state, sampled_states[row])
            rate(rig, drive, mode, drive.start, state, sampled_rates[row])
            _observe(rig, drive, mode, state, sampled_forces[row])
            row += 1
        status = integrate(rig, drive, mode, start + (i + 1) * segment_length, state, scale, work)
        if status != DONE:
            return status
    return DONE


@entry
def forces_of_elements(
    rig: Vehicle, mode: Modes, state: Vector, height: float, height_rate: float, out: Vector
) -> None:
    """Write the forces [N] of all elements on the masses into the places of their accelerations in ``out`` [states].

    ``height`` [m] of the road and its rate [m/s]; the floor is at rest.
    """
    ground = Ground(height, height_rate, 0.0, 0.0, 0.0, 0.0, 0.0, rig.gravity)
    out[:] = 0.0
    act(rig.elements, ground, mode, state, out)


@entry
def lay_slopes(
    forces: Vector, row: int, behind_sample: int, sample_every: int, segments: int, slope: float, end: float
) -> None:
    """Write a slope [1] from ``slope`` to ``end`` of so many ``segments`` into their samples, which are
    ``forces`` [samples, FORCES] from ``row`` on; the rest as of ``Course``.
    """
    for i in range(-behind_sample % sample_every, segments, sample_every):
        forces[row, TIRE_SLOPE] = slope + (end - slope) * i / segments
        row += 1


@entry
def raise_to(largest: Vector, forces: Vector) -> None:
    """Raise what was ``largest`` so far, [FORCES], to the samples of an interval, [samples, FORCES]."""
    for i in range(forces.shape[0]):
        for j in range(forces.shape[1]):
            largest[j] = max(largest[j], forces[i, j])


@entry
def energies_of(moving: Held[Moving], height: float, cushion: float) -> tuple[float, float, float, float, float]:
    """See ``energies``."""
    return _energies(moving.value.rig, moving.value.mode, moving.value.state, height, cushion)


@entry
def energies(
    rig: Vehicle, mode: Modes, state: Vector, height: float, cushion: float
) -> tuple[float, float, float, float, float]:
    """Kinetic, potential, stored energy, work supplied and dissipated [J] of ``state`` [states].

    ``height`` [m] of the road, ``cushion`` [m] of the cushion.
    """
    return _energies(rig, mode, state, height, cushion)


@kernel
def _energies(rig, mode, state, height, cushion):
    """See ``energies``."""
    ground = Ground(height, 0.0, cushion, 0.0, 0.0, 0.0, 0.0, rig.gravity)
    kinetic, potential = energies_of_masses(rig.masses, rig.gravity, state)
    beside = energies_beside(rig.elements, rig.gravity, state)
    _lost, _brought, stored, kept = act(rig.elements, ground, mode, state, numpy.zeros_like(state))
    # The last two states are the works supplied and dissipated; what is still stored is no loss
    # yet.
    last = state.shape[0]
    return kinetic + beside[0], potential + beside[1], stored, state[last - 2], state[last - 1] - kept
