"""Backrest rigs for tests, driven by a sine."""

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.results import DONE
from contact_sim_pkg.integrate.dormand_prince import make_workspace
from contact_sim_pkg.laws.parameters import Contact, FoamHysteresis, Friction, NormalDissipative, NormalElastic
from contact_sim_pkg.rigs.backrest import entries
from contact_sim_pkg.rigs.backrest.model import resting_state
from contact_sim_pkg.rigs.backrest.motion import event_count, memory_offset
from contact_sim_pkg.rigs.backrest.parameters import (
    CARRIED,
    CLOSING_WORK,
    DEEPEST,
    ENDED,
    OPENING_WORK,
    PLACE,
    START,
    TOUCHED,
    Backrest,
    BackrestSamples,
    Shaking,
    make_mode,
)

MASS, GRAVITY = 45.6, 9.81
LAW = NormalElastic(2.457e5, 1.5)
LOSS = NormalDissipative(1.949743421626532)
FRICTION = Friction(3.19e4, 619.0, 0.4, 0.4)


class Driven(NamedTuple):
    """A run."""

    states: numpy.ndarray
    forces: numpy.ndarray  # [samples, entries.FORCES]
    points: numpy.ndarray
    residual: float  # [J] of the energy ledger
    supplied: float  # [J]
    episodes: dict  # of the whole contact, by column
    end: numpy.ndarray


def one_mass(elastic=LAW, loss=LOSS, friction=None, amplitude=0.0, frequency=5.25, preload=MASS * GRAVITY, memory=None):
    modal = numpy.array([[MASS], [0.0], [0.0], [preload], [MASS]])
    coupling, places = numpy.array([[[1.0]], [[0.0]]]), numpy.array([[0.0], [1.0]])
    remembering = None if memory is None else FoamHysteresis(memory_offset(1, 1), *memory)
    contact = Contact(elastic, loss, friction, remembering)
    return Backrest(modal, coupling, places, contact, amplitude, 2.0 * math.pi * frequency)


def driven(rig, acceleration, duration, tolerance=1e-9, start=None, size=0.015, rate=1000, sample_every=1):
    """The run of a rig under `acceleration`(t), straight between `rate` samples a second."""
    state = resting_state(rig) if start is None else start.copy()
    points, modes = len(rig.gaps), len(rig.mass)
    mode, work = make_mode(points), make_workspace(len(state), event_count(points))
    scale = numpy.full(len(state), float(rig.preload.sum() + 1.0) * size * tolerance)
    scale[:modes], scale[modes : 2 * modes] = size * tolerance, 30.0 * size * tolerance
    scale[2 * modes : 2 * modes + points] = size * tolerance
    scale[memory_offset(modes, points) : -2] = tolerance
    count = round(duration * rate)
    samples = count // sample_every
    room = (
        numpy.zeros((samples, len(state))), numpy.zeros((samples, len(state))), numpy.zeros((samples, entries.FORCES)),
        numpy.zeros((samples, points, entries.POINT_COLUMNS)),
    )  # fmt: skip
    entries.start(rig, mode, state, work)
    before = numpy.array(entries.energies(rig, mode, 0.0, state))
    values = numpy.array([acceleration(i / rate) for i in range(count + 1)], dtype=float)
    shaking, outputs = Shaking(0.0, 1.0 / rate, values), BackrestSamples(sample_every, *room)
    status = entries.advance(rig, mode, state, scale, work, shaking, outputs)
    assert status == DONE
    change = numpy.array(entries.energies(rig, mode, duration, state)) - before
    rows = mode.ended[: mode.counts[ENDED]]
    rows = rows[rows[:, PLACE] == points]
    names = {"start": START, "end": CARRIED, "closing": CLOSING_WORK, "opening": OPENING_WORK, "deepest": DEEPEST}
    episodes = {name: rows[:, column] for name, column in {**names, "touched": TOUCHED}.items()}
    residual = change[3] - change[0] - change[1] - change[2] - change[4]
    return Driven(room[0], room[2], room[3], residual, change[3], episodes, state)


def sine(amplitude, frequency):
    return lambda t: amplitude * math.sin(2.0 * math.pi * frequency * t)
