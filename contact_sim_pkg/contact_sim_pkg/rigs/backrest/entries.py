"""Compiled entries of the backrest rig: start, advance over a row of segments with samples,
energies of a state.
"""

from __future__ import annotations

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel, entry
from contact_sim_pkg.compiled.results import DONE
from contact_sim_pkg.compiled.vectors import copy_row
from contact_sim_pkg.integrate.dormand_prince import DormandPrinceWorkspace, integrate
from contact_sim_pkg.integrate.interface import rate
from contact_sim_pkg.laws.elastic_law import elastic_energy
from contact_sim_pkg.laws.foam_hysteresis import hysteresis_energy
from contact_sim_pkg.laws.friction import SEPARATED as UNLOADED
from contact_sim_pkg.laws.friction import STICK, following_deflection, stick_event
from contact_sim_pkg.rigs.backrest import motion as backrest
from contact_sim_pkg.rigs.backrest.contact_search import move_point, place_of
from contact_sim_pkg.rigs.backrest.episodes import open_episode
from contact_sim_pkg.rigs.backrest.parameters import (
    APART,
    CLOSING,
    CONTACT,
    DEEPEST,
    FRICTION,
    MASS,
    OVERLAPPING,
    PRELOAD,
    SHARE,
    SLOPE,
    STIFFNESS,
    Backrest,
    BackrestDrive,
    BackrestMode,
    BackrestSamples,
    Shaking,
)

NORMAL, TANGENTIAL, APPROACH, FORCES = 0, 1, 2, 3  # columns of the whole contact
POINT_APPROACH, POINT_NORMAL, POINT_TANGENTIAL, POINT_DISPLACEMENT, POINT_STATE = 0, 1, 2, 3, 4
POINT_UP, POINT_ACROSS, POINT_COLUMNS = 5, 6, 7  # how far a moving point is from the shell's middle [m]
NO_CONTACT, FRICTIONLESS, STICKS, SLIPS = 0, 1, 2, 3  # values of POINT_STATE


@borrowing_kernel
def _first_friction(friction, rig, mode, point, normal, state):
    """Slip from the start where the sliding already exceeds what sticking can hold."""
    if friction is None:
        return
    velocity = backrest.tangential_velocity(rig, 0.0, state, point)
    if stick_event(friction, normal, 0.0, velocity) < 0.0:
        mode.doing[FRICTION, point] = 1 if velocity > 0.0 else -1


@entry
def start(rig: Backrest, mode: BackrestMode, state: Vector, work: DormandPrinceWorkspace) -> None:
    """Set the discrete state that belongs to ``state`` [states] at the start of a run, time 0."""
    points = rig.places.shape[1]
    mode.counts[OVERLAPPING] = 0
    move_point(rig.search, rig, state)
    # Points that overlap are in contact, and stick unless they slide.
    for c in range(points):
        approach, approach_rate = backrest.approach_of(rig, state, c)
        mode.doing[CONTACT, c] = CLOSING if approach > 0.0 else APART
        mode.doing[FRICTION, c] = STICK if approach > 0.0 else UNLOADED
        open_episode(rig, mode, c, 0.0, approach, state, 0.0)
        if approach > 0.0:
            mode.counts[OVERLAPPING] += 1
            normal = backrest.unit_normal(rig, mode, c, approach, approach_rate, state)
            _first_friction(rig.contact.friction, rig, mode, c, normal, state)
    open_episode(rig, mode, points, 0.0, 0.0, state, 0.0)
    for c in range(points):
        mode.lasting[points, DEEPEST] = max(mode.lasting[points, DEEPEST], mode.lasting[c, DEEPEST])
    # Every event function starts on the positive side.
    for j in range(work.event_direction.shape[0]):
        work.event_direction[j] = 1.0
    work.last_event[0] = -numpy.inf


@entry
def find_point(rig: Backrest, state: Vector) -> None:
    """Set the moving point of ``rig`` by ``state`` [states]."""
    move_point(rig.search, rig, state)


@borrowing_kernel
def _state_of(friction, mode, point, normal):
    if not normal > 0.0:
        return NO_CONTACT
    if friction is None:
        return FRICTIONLESS
    return STICKS if mode.doing[FRICTION, point] == STICK else SLIPS


@borrowing_kernel
def _displacement_of(rig, time, state, point):
    """Displacement of the back's face along the seat in [m], from rest."""
    displacement, _velocity, _acceleration = backrest.slide_of(rig, time)
    for i in range(rig.modal.shape[1]):
        displacement -= rig.coupling[SLOPE, point, i] * state[i]
    return displacement


@borrowing_kernel
def _observe(rig, mode, time, state, whole, by_point):
    """Forces of the whole contact and of every point, seen from the right."""
    friction = rig.contact.friction
    whole[NORMAL] = 0.0
    whole[TANGENTIAL] = 0.0
    whole[APPROACH] = -numpy.inf
    move_point(rig.search, rig, state)
    across, up = place_of(rig.search, state)
    # Forces per unit of the reference surface times the share of each point; friction as it acts on
    # the seat back.
    for c in range(rig.places.shape[1]):
        approach, approach_rate = backrest.approach_of(rig, state, c)
        normal = backrest.unit_normal(rig, mode, c, approach, approach_rate, state)
        tangential, _velocity = backrest.unit_friction(friction, rig, mode, c, time, normal, state)
        row = by_point[c]
        row[POINT_APPROACH] = approach
        row[POINT_NORMAL] = rig.places[SHARE, c] * normal
        row[POINT_TANGENTIAL] = -rig.places[SHARE, c] * tangential
        row[POINT_DISPLACEMENT] = _displacement_of(rig, time, state, c)
        row[POINT_UP] = up
        row[POINT_ACROSS] = across
        row[POINT_STATE] = _state_of(friction, mode, c, normal)
        whole[NORMAL] += row[POINT_NORMAL]
        whole[TANGENTIAL] += row[POINT_TANGENTIAL]
        whole[APPROACH] = max(whole[APPROACH], approach)


@entry
def advance(
    rig: Backrest, mode: BackrestMode, state: Vector, scale: Vector, work: DormandPrinceWorkspace, shaking: Shaking,
    samples: BackrestSamples,
) -> int:  # fmt: skip
    """Advance ``state`` [states] over the segments of ``shaking``, and fill ``samples`` on the way.

    ``scale`` [states]: error allowed per step. Returns a status of ``compiled/results.py``;
    ``mode``, ``state``, ``work`` and ``samples`` change in place.
    """
    row, begin, length, acceleration = 0, shaking.begin, shaking.segment_length, shaking.acceleration
    for i in range(acceleration.shape[0] - 1):
        drive = BackrestDrive(begin + i * length, length, acceleration[i], acceleration[i + 1])
        # Sample the start of the segment, then integrate to its end.
        if i % samples.every == 0:
            copy_row(state, samples.states[row])
            rate(rig, drive, mode, drive.start, state, samples.rates[row])
            _observe(rig, mode, drive.start, state, samples.forces[row], samples.points[row])
            row += 1
        status = integrate(rig, drive, mode, begin + (i + 1) * length, state, scale, work)
        if status != DONE:
            return status
    return DONE


@borrowing_kernel
def _spring_energy(friction, rig, mode, point, time, approach, approach_rate, state):
    """Energy in [J] of a point's friction spring, for the whole law."""
    if friction is None:
        return 0.0
    doing = mode.doing[FRICTION, point]
    if doing == UNLOADED:
        return 0.0
    deflection = state[2 * rig.modal.shape[1] + point]
    if doing != STICK:
        normal = backrest.unit_normal(rig, mode, point, approach, approach_rate, state)
        deflection = following_deflection(
            friction, doing, normal, backrest.tangential_velocity(rig, time, state, point)
        )
    return 0.5 * friction.stiffness * deflection**2


@entry
def energies(rig: Backrest, mode: BackrestMode, time: float, state: Vector) -> tuple[float, float, float, float, float]:
    """Kinetic, potential (of the preload) and stored energy, work supplied and dissipated [J], of
    ``state`` [states].

    time: [s].
    """
    modes = rig.modal.shape[1]
    move_point(rig.search, rig, state)
    kinetic, potential, stored, returned = 0.0, 0.0, 0.0, 0.0
    for i in range(modes):
        kinetic += 0.5 * rig.modal[MASS, i] * state[modes + i] ** 2
        potential -= rig.modal[PRELOAD, i] * state[i]
        stored += 0.5 * rig.modal[STIFFNESS, i] * state[i] ** 2
    for c in range(rig.places.shape[1]):
        share = rig.places[SHARE, c]
        stored_here = hysteresis_energy(rig.contact.hysteresis, state, c)
        if mode.doing[CONTACT, c] != APART:
            approach, approach_rate = backrest.approach_of(rig, state, c)
            stored_here += _spring_energy(
                rig.contact.friction,
                rig,
                mode,
                point=c,
                time=time,
                approach=approach,
                approach_rate=approach_rate,
                state=state,
            )
            stored += share * elastic_energy(rig.contact.elastic, approach)
        stored += share * stored_here
        returned += share * stored_here  # counted as dissipated when it was put in
    last = state.shape[0]
    return kinetic, potential, stored, state[last - 2], state[last - 1] - returned
