"""Noise of the samples, from the samples.

Findings about single contacts, and their sentences.
"""

from __future__ import annotations

import enum
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.motion.rotation import Array, logarithm
from contact_sim_pkg.identify.motion.segments import MEDIAN_OF_GAUSS, SHORTEST_FLIGHT
from contact_sim_pkg.identify.motion.states import BodyStates, SampleNoise

__all__ = [
    "FREE_MOTION_MISSING",
    "SENTENCES",
    "ContactNote",
    "NoteKind",
    "cure_without_flights",
    "first_guess",
    "from_residuals",
    "limited",
    "roundings",
    "sample_noise",
    "shared_rounding",
]


FLOOR = 1e-13  # of the largest value of a channel: rounding
BESIDE = 1e-6  # of the largest relative noise of a channel: no other counts as more exact than that
ROUNDED = float(numpy.sqrt(12.0))  # step of a rounding over its standard deviation
STEPS = 10.0 ** numpy.arange(0.0, -10.0, -1.0)  # decimals that samples are rounded to
NEARLY = 1e-6  # of a step
CONSTANT = 0.1  # of the noisiest component: less noise is that of a component that was not measured, as across a plane
FEWEST = 3  # different values that are multiples, such as the spins of three flights: by chance they are not
SECOND = numpy.sqrt(6.0)  # noise of a second difference over that of a value


def first_guess(states: BodyStates) -> SampleNoise:
    """From medians of second differences, which impacts do not move; smooth motion adds to it."""
    if len(states.time) < 5:
        return limited(SampleNoise(0.0, 0.0, 0.0, 0.0), states)
    turns = logarithm(states.rotation[1:] @ numpy.swapaxes(states.rotation[:-1], -1, -2))
    channels = (
        numpy.diff(states.position, n=2, axis=0), numpy.diff(turns, axis=0), numpy.diff(states.velocity, n=2, axis=0),
        numpy.diff(states.angular_velocity, n=2, axis=0),
    )  # fmt: skip
    steps = (_step(states.position), 0.0, _step(states.velocity), _step(states.angular_velocity))
    spreads = [max(_spread(channel), step / ROUNDED) for channel, step in zip(channels, steps, strict=True)]
    return limited(SampleNoise(*spreads), states)


def from_residuals(residuals: Sequence[Array], states: BodyStates) -> SampleNoise:
    """From what flights leave of their samples, [n, 12] in the order dx, dv, rotation, dw, and not
    less than their rounding.

    A component without noise of its own, as those out of a plane that a camera films, is not
    counted; nor are the single samples of a contact that lasts: what its steps leave is the error
    of their rule (`identify/contact/lasting.py`).
    """
    flights = [rest for rest in residuals if len(rest) >= SHORTEST_FLIGHT]
    spreads, steps = [], (_step(states.position), _step(states.velocity), 0.0, _step(states.angular_velocity))
    for channel in range(4):
        parts = [rest[:, 3 * channel : 3 * channel + 3] for rest in flights]
        free = sum(len(part) - 1.0 for part in parts)
        total = sum((numpy.sum(part**2, axis=0) for part in parts), start=numpy.zeros(3))
        noisy = total > CONSTANT**2 * total.max()
        spread = float(numpy.sqrt(total[noisy].mean() / free)) if free and noisy.any() else 0.0
        spreads.append(max(spread, steps[channel] / ROUNDED))
    position, velocity, rotation, angular_velocity = spreads
    return limited(SampleNoise(position, rotation, velocity, angular_velocity), states)


def limited(noise: SampleNoise, states: BodyStates, floor: float = FLOOR) -> SampleNoise:
    """Not below `floor` [1] times the largest value of each channel, that of rounding, nor below
    BESIDE the noise of the roughest.

    Rotations that are exact beside rounded spins would identify the ratios of the inertia so well
    that its size, from the spins, would count as not identified.
    """
    largest = (
        float(abs(states.position).max()), 1.0, float(abs(states.velocity).max()),
        float(abs(states.angular_velocity).max()) + 1e-3,
    )  # fmt: skip
    sizes = [size + 1e-3 for size in largest]
    least = max(floor, BESIDE * max(value / size for value, size in zip(noise, sizes, strict=True)))
    return SampleNoise(*(max(value, least * size) for value, size in zip(noise, sizes, strict=True)))


def roundings(states: BodyStates) -> SampleNoise:
    """Standard deviations of the rounding of samples that are stored with few decimals or in single
    precision; 0 otherwise.

    Of rotations, which come from rounded quaternions, it is not seen.
    """
    channels = (states.position, states.velocity, states.angular_velocity)
    position, velocity, angular_velocity = (_step(values) / ROUNDED for values in channels)
    return SampleNoise(position, 0.0, velocity, angular_velocity)


def sample_noise(noise: SampleNoise, rounding: SampleNoise, states: BodyStates, run: slice) -> Array:
    """Standard deviations of each sample of a flight in the order dx, dv, rotation, dw: [channels],
    12 in [m], [m/s], [rad], [rad/s].

    `noise`, or rounding where the samples share more.
    """
    place, speed, spin = (
        numpy.maximum(getattr(noise, name), shared_rounding(getattr(states, name)[run], getattr(rounding, name)))
        for name in ("position", "velocity", "angular_velocity")
    )
    return numpy.concatenate([place, speed, numpy.full(3, noise.rotation), spin])


def shared_rounding(values: Array, rounding: float) -> Array:
    """Deviation [columns] to use for each of the samples [samples, columns] of a flight so that
    their mean is as uncertain as rounding leaves it.

    Errors of rounding differ from sample to sample only where the increments of the rounded values
    do. A spin that is constant, or a velocity that falls by whole steps, keeps one error for all n
    samples, r = 1: `rounding sqrt(n / r)`, r - 1 changes of the increment. `rounding` and result in
    the unit of the values: [m], [m/s] or [rad/s].
    """
    if rounding == 0.0:
        return numpy.zeros(values.shape[1])
    changes = abs(numpy.diff(values, n=2, axis=0)) > 0.5 * ROUNDED * rounding
    return numpy.asarray(rounding * numpy.sqrt(len(values) / (1.0 + changes.sum(axis=0))))


def _step(values: Array) -> float:
    """Step of which all values are multiples: a power of ten, or that of single precision; 0 where
    there is none.

    A channel counts that takes FEWEST values or more: of a constant anything is a multiple.
    """
    found = 0.0
    for channel in values.T:
        if len(numpy.unique(channel)) < FEWEST:
            continue
        if (channel == channel.astype(numpy.float32)).all():
            found = max(found, float(numpy.spacing(numpy.float32(abs(channel).max()))))
        for step in STEPS:
            places = numpy.round(channel / step)
            near = abs(channel / step - places) <= NEARLY * numpy.maximum(1.0, 1e-9 * abs(places))
            if near.all() and len(numpy.unique(places)) >= FEWEST:
                found = max(found, step)
                break
    return found


def _spread(differences: Array) -> float:
    centred = abs(differences - numpy.median(differences, axis=0))
    return float(numpy.median(centred, axis=0).max() / MEDIAN_OF_GAUSS / SECOND)


class NoteKind(enum.Enum):
    """Why a contact is not used, or what a lasting one does."""

    NO_FLIGHT_BESIDE = enum.auto()
    FLIGHT_TOO_SHORT = enum.auto()
    NOTHING_TOUCHED = enum.auto()
    SEVERAL_CORNERS = enum.auto()
    FLIGHTS_MISS = enum.auto()
    DOUBLE_IMPACT = enum.auto()
    CONTRADICTS = enum.auto()
    LASTING = enum.auto()
    PRESSED_IN = enum.auto()
    BELOW_GROUND = enum.auto()
    ABOVE_GROUND = enum.auto()


SENTENCES = {
    NoteKind.NO_FLIGHT_BESIDE: "no flight of {samples} samples before or after it",
    NoteKind.FLIGHT_TOO_SHORT: "the flight before does not come down: too short to locate the contact",
    NoteKind.NOTHING_TOUCHED: "touches no known surface: the lowest point is {gap:.3g} m above the ground there",
    NoteKind.SEVERAL_CORNERS: "touches with {corners} corners at once: where its impulse acts is not known",
    NoteKind.FLIGHTS_MISS: "the flights before and after miss each other by {miss:.2g} m, and between them more than "
    "one corner touches, or one more than once",
    NoteKind.DOUBLE_IMPACT: "the flights before and after miss each other: more than one impact in between",
    NoteKind.CONTRADICTS: "contradicts the other contacts by more than noise explains: more than one impact in between?",
    NoteKind.LASTING: "lasting contact{depth}, {motion}",
    NoteKind.PRESSED_IN: "lasting contact, presses into the ground",
    NoteKind.BELOW_GROUND: "no free motion, {depth:.3g} m below the ground: check the shape, its axes, and the ground",
    NoteKind.ABOVE_GROUND: "no free motion, up to {height:.3g} m above the ground: check gravity, wrench, axes of the "
    "twist, and shape",
}
FREE_MOTION_MISSING = (NoteKind.BELOW_GROUND, NoteKind.ABOVE_GROUND)  # of what cannot be a contact


class ContactNote(NamedTuple):
    """One finding, with the values of its sentence."""

    kind: NoteKind
    values: Mapping[str, str | int | float] = {}

    @property
    def sentence(self) -> str:
        """The finding in words."""
        return SENTENCES[self.kind].format(**self.values)


def cure_without_flights(*, no_friction: bool, no_force: bool) -> str:
    """What to change where neither a flight nor a slide identifies anything.

    Args:
        no_friction: the friction coefficient of a slide is not known.
        no_force: the force during a slide is not known.
    """
    record = "record faster, or a motion that leaves the ground"
    unknown = [
        name for name, lacks in (("the friction coefficient", no_friction), ("the known force", no_force)) if lacks
    ]
    if unknown:
        return f"{record}, or give {' and '.join(unknown)} of a slide"
    return f"{record}; no slide of the body on the given ground was found either: check the shape, its axes, and the ground"
