"""Whether rotation and spin of the flights belong together, and turn as inertia and the known
torque say.

What `found` leaves of them is measured minus model, in world axes: small rotations r and spins s.
Where an angular acceleration a is missing in the model, r and s are `c0 + c1 t + a t^2 / 2` and `c1
+ a t`, as for position and velocity (`identify/motion/free_fall.py`). Where the spin is recorded
1/k times too fast, the rate of r along the spin less s is `(k - 1) w`, whatever the model has made
of both: in space to first order in k - 1, of a spin whose axis hardly turns within a flight.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.contact.stacked import ParameterEstimate
from contact_sim_pkg.identify.diagnostics.noise import first_guess, sample_noise
from contact_sim_pkg.identify.motion.free_fall import FEWEST, MissingAcceleration, long_flights, mean_over_flights
from contact_sim_pkg.identify.motion.rotation import logarithm
from contact_sim_pkg.identify.motion.states import BodyStates, SampleNoise
from contact_sim_pkg.identify.problem import IdentificationProblem

__all__ = ["SpinScale", "missing_spin_rate", "rate_of_turn", "spin_scale"]

ROUGH = 5.0  # times the noise of neighbouring samples: what flights leave beyond that is no noise
SIGNIFICANT = 20.0  # times its noise: a spin that identifies a rate of rotation
TURN = 0.2  # [rad] by the spin, over which rotations are compared
ROTATION = 6  # column of what is left, of 12


class SpinScale(NamedTuple):
    """By how much faster than the spin says the rotations turn."""

    excess: float  # k - 1
    deviation: float  # standard deviation; infinite where no flight identifies it


def missing_spin_rate(found: ParameterEstimate, problem: IdentificationProblem) -> MissingAcceleration:
    """Angular acceleration of all flights beyond that of the model, [rad/s^2], world axes."""
    return mean_over_flights(found, problem, ROTATION, _noise(problem))


def spin_scale(found: ParameterEstimate, problem: IdentificationProblem) -> SpinScale:
    """k - 1, where the rotations of the flights turn k times as fast as the spin says."""
    noise, total, weights = _noise(problem), 0.0, 0.0
    for run, rest in long_flights(found, problem):
        turns, spins = rest[:, ROTATION : ROTATION + 3], rest[:, ROTATION + 3 :]
        spin = problem.states.angular_velocity[run] - spins
        speed = numpy.linalg.norm(spin, axis=1)
        if not (speed > 0.0).all():
            continue
        along, time = spin / speed[:, None], problem.states.time[run]
        centred, size = time - time.mean(), float(speed.mean())
        lever = float(centred @ centred)
        # Rate at which the rotations run ahead of the spin, along the spin
        rate = float(centred @ numpy.einsum("ni,ni->n", turns, along)) / lever
        excess = rate - float(numpy.einsum("ni,ni->n", spins, along).mean())
        spin_noise = float(sample_noise(noise, problem.rounding, problem.states, run)[ROTATION + 3 :].max())
        weight = 1.0 / (noise.rotation**2 / lever + spin_noise**2 / len(time))
        total, weights = total + weight * size * excess, weights + weight * size**2
    if weights == 0.0:
        return SpinScale(0.0, numpy.inf)
    return SpinScale(total / weights, 1.0 / float(numpy.sqrt(weights)))


def rate_of_turn(states: BodyStates, noise: float) -> float | None:
    """How many times as fast as the spin says the rotations turn: a median over spans of TURN; None
    where that is open.

    Before any flight is known: for spins in another unit. It needs spins of SIGNIFICANT times their
    `noise` [rad/s], and a radian in all. Spans of a turn that shows beside rounded rotations.
    """
    if len(states.time) < FEWEST:
        return None
    steps, spin = numpy.diff(states.time), 0.5 * (states.angular_velocity[1:] + states.angular_velocity[:-1])
    speed = numpy.linalg.norm(spin, axis=1)
    usual, total = float(numpy.median(speed)), float(speed @ steps)
    if total < 1.0 or usual < SIGNIFICANT * noise:
        return None
    span = min(max(1, round(TURN * len(steps) / total)), len(steps) // 2)
    # Rotation over each span: by the spins, and by the rotations
    recorded = numpy.concatenate([numpy.zeros((1, 3)), numpy.cumsum(spin * steps[:, None], axis=0)])
    recorded = recorded[span:] - recorded[:-span]
    turns = logarithm(states.rotation[span:] @ numpy.swapaxes(states.rotation[:-span], -1, -2))
    squares = numpy.einsum("ni,ni->n", recorded, recorded)
    fast = squares >= numpy.median(squares)
    return float(numpy.median(numpy.einsum("ni,ni->n", turns, recorded)[fast] / squares[fast]))


def _noise(problem: IdentificationProblem) -> SampleNoise:
    """Of rotation and spin that of the flights, but no more than ROUGH times that of neighbours,
    which no misfit raises.
    """
    rough, noise = first_guess(problem.states), problem.noise
    return noise._replace(
        rotation=min(noise.rotation, ROUGH * rough.rotation),
        angular_velocity=min(noise.angular_velocity, ROUGH * rough.angular_velocity),
    )
