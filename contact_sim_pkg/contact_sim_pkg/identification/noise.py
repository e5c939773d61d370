"""Noise of the samples, from the samples."""

from __future__ import annotations

from collections.abc import Sequence

import numpy

from .rotation import Array, logarithm
from .segments import MEDIAN_OF_GAUSS
from .states import BodyStates, Noise

__all__ = ["first_guess", "from_residuals", "limited"]

FLOOR = 1e-13  # of the largest value of a channel: rounding
SECOND = numpy.sqrt(6.0)  # noise of a second difference over that of a value


def first_guess(states: BodyStates) -> Noise:
    """From medians of second differences, which impacts do not move; smooth motion adds to it."""
    if len(states.time) < 5:
        return limited(Noise(0.0, 0.0, 0.0, 0.0), states)
    turns = logarithm(states.rotation[1:] @ numpy.swapaxes(states.rotation[:-1], -1, -2))
    channels = (
        numpy.diff(states.position, n=2, axis=0), numpy.diff(turns, axis=0), numpy.diff(states.velocity, n=2, axis=0),
        numpy.diff(states.angular_velocity, n=2, axis=0),
    )  # fmt: skip
    return limited(Noise(*(_spread(channel) for channel in channels)), states)


def from_residuals(residuals: Sequence[Array], states: BodyStates) -> Noise:
    """From what flights leave of their samples: [n, 12] a flight, in the order dx, dv, rotation, dw."""
    spreads = []
    for channel in range(4):
        parts = [rest[:, 3 * channel : 3 * channel + 3] for rest in residuals]
        free = sum(3.0 * max(len(part) - 1.0, 0.0) for part in parts)
        total = sum(float(numpy.sum(part**2)) for part in parts)
        spreads.append(float(numpy.sqrt(total / free)) if free else 0.0)
    position, velocity, rotation, angular_velocity = spreads
    return limited(Noise(position, rotation, velocity, angular_velocity), states)


def limited(noise: Noise, states: BodyStates, floor: float = FLOOR) -> Noise:
    """Not below `floor` times the largest value of each channel: that of rounding."""
    largest = (
        float(abs(states.position).max()), 1.0, float(abs(states.velocity).max()),
        float(abs(states.angular_velocity).max()) + 1e-3,
    )  # fmt: skip
    return Noise(*(max(value, floor * (size + 1e-3)) for value, size in zip(noise, largest, strict=True)))


def _spread(differences: Array) -> float:
    centred = abs(differences - numpy.median(differences, axis=0))
    return float(numpy.median(centred, axis=0).max() / MEDIAN_OF_GAUSS / SECOND)
