"""Whether rotation and spin of the flights belong together, and turn as inertia and the known torque say.

What `found` leaves of them is measured minus model, in world axes: small rotations r and spins s. Where an angular acceleration a
is missing in the model, r and s are `c0 + c1 t + a t^2 / 2` and `c1 + a t`, as for position and velocity (`free_fall.py`). Where
the spin is told 1/k times too fast, the rate of r along the spin less s is `(k - 1) w`, whatever the model has made of both: in
space to first order in k - 1, of a spin whose axis hardly turns within a flight.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from .free_fall import FEWEST, extra_acceleration
from .noise import first_guess
from .problem import Problem
from .rotation import Array, logarithm
from .stacked import Estimate
from .states import BodyStates

__all__ = ["Misfit", "missing_spin_rate", "rate_of_turn", "spin_scale"]

ROUGH = 5.0  # times the noise of neighbouring samples: what flights leave beyond that is no noise
SIGNIFICANT = 20.0  # times its noise: a spin that tells a rate of turn


class Misfit(NamedTuple):
    """A quantity that is missing in the model."""

    value: Array  # [3] or [1]
    deviation: float  # of a component; infinite where no flight tells
    longest: float  # [s], of the flights


def missing_spin_rate(found: Estimate, problem: Problem) -> Misfit:
    """Angular acceleration of all flights beyond that of the model, [rad/s^2], world axes."""
    spreads, total, weights, longest = _spreads(problem), numpy.zeros(3), 0.0, 0.0
    for time, rest, _spin in _flights(found, problem):
        value, weight = extra_acceleration(time, rest[:, 6:9], rest[:, 9:], *spreads)
        total, weights, longest = total + weight * value, weights + weight, max(longest, float(time[-1]))
    if weights == 0.0:
        return Misfit(numpy.zeros(3), numpy.inf, 0.0)
    return Misfit(total / weights, 1.0 / float(numpy.sqrt(weights)), longest)


def spin_scale(found: Estimate, problem: Problem) -> Misfit:
    """k - 1, where the rotations of the flights turn k times as fast as the spin says."""
    (turn_noise, spin_noise), total, weights, longest = _spreads(problem), 0.0, 0.0, 0.0
    for time, rest, spin in _flights(found, problem):
        speed = numpy.linalg.norm(spin, axis=1)
        if not (speed > 0.0).all():
            continue
        along, centred = spin / speed[:, None], time - time.mean()
        lever = float(centred @ centred)
        rate = float(centred @ numpy.einsum("ni,ni->n", rest[:, 6:9], along)) / lever
        excess = rate - float(numpy.einsum("ni,ni->n", rest[:, 9:], along).mean())
        weight = 1.0 / (turn_noise**2 / lever + spin_noise**2 / len(time))
        size = float(speed.mean())
        total, weights, longest = (
            total + weight * size * excess,
            weights + weight * size**2,
            max(longest, float(time[-1])),
        )
    if weights == 0.0:
        return Misfit(numpy.zeros(1), numpy.inf, 0.0)
    return Misfit(numpy.array([total / weights]), 1.0 / float(numpy.sqrt(weights)), longest)


def rate_of_turn(states: BodyStates) -> float | None:
    """How many times as fast as the spin says the rotations turn: a median over the intervals; None where that is open.

    Before any flight is known: for spins in another unit. It asks for spins of SIGNIFICANT times their noise, and a radian in all.
    """
    if len(states.time) < FEWEST:
        return None
    steps, spin = numpy.diff(states.time), 0.5 * (states.angular_velocity[1:] + states.angular_velocity[:-1])
    speed = numpy.linalg.norm(spin, axis=1)
    told = float(speed @ steps)
    if told < 1.0 or float(numpy.median(speed)) < SIGNIFICANT * first_guess(states).angular_velocity:
        return None
    turns = logarithm(states.rotation[1:] @ numpy.swapaxes(states.rotation[:-1], -1, -2))
    fast = speed >= numpy.median(speed)
    shares = numpy.einsum("ni,ni->n", turns, spin)[fast] / (speed[fast] ** 2 * steps[fast])
    return float(numpy.median(shares))


def _spreads(problem: Problem) -> tuple[float, float]:
    """Noise of rotation and spin: of the flights, but no more than ROUGH times that of neighbours, which no misfit raises."""
    rough = first_guess(problem.states)
    return (
        min(problem.noise.rotation, ROUGH * rough.rotation),
        min(problem.noise.angular_velocity, ROUGH * rough.angular_velocity),
    )


def _flights(found: Estimate, problem: Problem) -> list[tuple[Array, Array, Array]]:
    """Of each flight that is long enough: time from its start [n], what is left [n, 12], spin of the model [n, 3]."""
    chosen, states = [], problem.states
    for (first, last), rest in zip(problem.flights, found.residuals, strict=True):
        if last - first + 1 >= FEWEST:
            run = slice(first, last + 1)
            chosen.append((states.time[run] - states.time[first], rest, states.angular_velocity[run] - rest[:, 9:]))
    return chosen
