"""Inertia of a body that tumbles freely, up to its size: where the search in space starts.

In flight the angular momentum over the mass is `R S R^T w = L0 + kappa int tau dt`, linear in the
six numbers of S = I0/m and in kappa = 1/m. What is left of it about its mean over each flight is
made least at a fixed trace of S, weighted by the noise, with the guess as it is where the motion
does not identify it: five numbers of a body that tumbles in all directions.

Source: Identifiability eqs 19 to 31 without an impulse.
"""

from __future__ import annotations

import numpy

from contact_sim_pkg.identify.motion.flight import FlightModel
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.motion.segments import SHORTEST_FLIGHT
from contact_sim_pkg.identify.motion.states import BodyStates, SampleNoise

__all__ = ["tumbling_start"]

MOST = 200  # samples of a flight that are used
SLACK = 1e-6  # of the trace: second moment below zero that counts as zero
SHAPES = numpy.array([  # changes of (xx, yy, zz, xy, xz, yz) that leave the trace as it is
    [1.0, -1.0, 0.0, 0.0, 0.0, 0.0], [1.0, 1.0, -2.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
])  # fmt: skip


def tumbling_start(
    states: BodyStates, flights: list[tuple[int, int]], model: FlightModel, noise: SampleNoise, guess: Array
) -> Array | None:
    """Parameters to begin with, [parameters]; None where no body has such an inertia, or no flight
    is long enough.

    Args:
        states: the motion.
        flights: first and last sample of each.
        model: in space.
        noise: of the samples.
        guess: parameters of which the trace is kept, and all that the flights do not identify, [p].
    """
    blocks = [
        _about_the_mean(states, flight, model) for flight in flights if flight[1] - flight[0] + 1 >= SHORTEST_FLIGHT
    ]
    if not blocks:
        return None
    rows = numpy.concatenate(blocks)
    size = float(guess[:3].sum()) / 3.0
    fastest = float(numpy.linalg.norm(states.angular_velocity, axis=1).max())
    spread = size * (noise.angular_velocity + fastest * noise.rotation)
    # Unknowns: the shape of the inertia at a given size, and 1/m
    free = numpy.zeros((len(SHAPES) + model.with_mass, len(guess)))
    free[: len(SHAPES), :6] = size * SHAPES
    if model.with_mass:
        free[-1, -1] = guess[-1]
    # Least squares, regularised towards the guess
    system = numpy.concatenate([rows @ free.T / spread, numpy.eye(len(free))])
    right = numpy.concatenate([-rows @ guess / spread, numpy.zeros(len(free))])
    found: Array = guess + numpy.linalg.lstsq(system, right)[0] @ free
    # A body has no negative second moment
    inertia = model.inertia(found)
    trace = float(numpy.trace(inertia))
    moments = numpy.linalg.eigvalsh(0.5 * trace * numpy.eye(3) - inertia)
    return found if moments.min() >= -SLACK * trace else None


def _about_the_mean(states: BodyStates, flight: tuple[int, int], model: FlightModel) -> Array:
    """What each parameter makes of the angular momentum of a flight less its mean and the impulse
    of the torque, [3 n, p].
    """
    first, last = flight
    chosen = numpy.unique(numpy.linspace(first, last, min(MOST, last - first + 1)).round().astype(int))
    turns, spins = states.rotation[chosen], states.angular_velocity[chosen]
    columns = [numpy.einsum("nij,jk,nlk,nl->ni", turns, part, turns, spins) for part in model.basis]
    if model.with_mass:
        columns.append(-model.wrench.twist(float(states.time[first]), states.time[chosen]))
    rows: Array = numpy.stack(columns, axis=2)
    centred: Array = (rows - rows.mean(axis=0)).reshape(-1, rows.shape[2])
    return centred
