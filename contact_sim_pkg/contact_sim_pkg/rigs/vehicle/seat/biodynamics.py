"""Frequency responses of a seated occupant in closed form: apparent mass and seat-to-head
transmissibility, and the transmissibility of a linear seat under it.

With mass, damping and stiffness matrices M, C, K of all nodes and the dynamic stiffness
``D(w) = K + i w C - w^2 M``, motion ``u_0`` of the seat interface moves the others by ``D_uu u_u =
-D_u0 u_0``. The force on the interface over its acceleration, the apparent mass (Fairley and Griffin
1989), is ``sum_i m_i u_i / u_0``, since no other force acts; the seat-to-head transmissibility is
``u_head / u_0``. A massless interface needs nothing of its own.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, TypeAlias

import numpy
from numpy.typing import ArrayLike, NDArray

from contact_sim_pkg.rigs.vehicle.seat.occupants import OccupantModel

__all__ = [
    "Matrices", "apparent_mass", "matrices", "natural_frequencies", "rest_deflections", "seat_to_head",
    "seat_transmissibility",
]  # fmt: skip

Array: TypeAlias = NDArray[numpy.float64]
Response: TypeAlias = NDArray[numpy.complex128]


RINGING = 0.1
"""of the rate of samples: ten in a period"""
DIES_OUT = 0.1
"""of the critical damping: a tenth is left after four periods"""


class Matrices(NamedTuple):
    """Matrices [nodes, nodes] of a model that hangs in space."""

    mass: Array  # [kg]
    damping: Array  # [N s/m]
    stiffness: Array  # [N/m]


def matrices(model: OccupantModel) -> Matrices:
    """Mass, damping and stiffness matrices; node 0 is the seat interface."""
    count = len(model.masses)
    damping, stiffness = numpy.zeros((count, count)), numpy.zeros((count, count))
    for link in model.links:
        ends = numpy.zeros(count)
        ends[link.lower], ends[link.upper] = -1.0, 1.0
        between = numpy.outer(ends, ends)
        stiffness += link.stiffness * between
        damping += link.damping * between
    return Matrices(numpy.diag(numpy.array(model.masses, dtype=float)), damping, stiffness)


def apparent_mass(model: OccupantModel, frequency: ArrayLike) -> Response:
    """Force on the seat interface over its acceleration [kg], at each ``frequency`` [Hz], above 0."""
    return _motion(model, frequency) @ numpy.array(model.masses, dtype=float)


def seat_to_head(model: OccupantModel, frequency: ArrayLike) -> Response:
    """Motion of the head over that of the seat interface [1], at each ``frequency`` [Hz], above 0.

    Raises ValueError for a model without a head.
    """
    if model.head is None:
        raise ValueError(f"a model without a head ({model.source}) has no seat-to-head transmissibility")
    return _motion(model, frequency)[:, model.head]


def seat_transmissibility(model: OccupantModel, frequency: ArrayLike, stiffness: float, damping: float) -> Response:
    """Motion of the seat interface over that of the floor [1], on a linear cushion of ``stiffness``
    [N/m] and ``damping`` [N s/m]: ``T = S / (S - w^2 M(w))``, ``S = k + i w c``.
    """
    w = 2.0 * numpy.pi * numpy.atleast_1d(numpy.asarray(frequency, dtype=float))
    cushion = stiffness + 1j * w * damping
    return numpy.asarray(cushion / (cushion - w**2 * apparent_mass(model, frequency)))


def natural_frequencies(model: OccupantModel) -> Array:
    """Undamped natural frequencies [masses] [Hz] of the masses on a seat that stands still, from
    the lowest up.
    """
    mass, _damping, stiffness = matrices(model)
    squares = numpy.linalg.eigvals(numpy.linalg.solve(mass[1:, 1:], stiffness[1:, 1:]))
    return numpy.asarray(numpy.sort(numpy.sqrt(squares.real)) / (2.0 * numpy.pi))


def ringing_of(model: OccupantModel) -> tuple[float, float]:
    """Highest frequency [Hz] of a vibration of the masses that a seat leaves free, and its share of critical damping:
    the poles ``w`` of ``det(w^2 M + w C + K) = 0``; 0 and 1 without any. A seat interface without mass stands still.
    """
    free = slice(0 if model.masses[0] > 0.0 else 1, None)
    mass, damping, stiffness = (part[free, free] for part in matrices(model))
    count = len(mass)
    system = numpy.block(
        [
            [numpy.zeros((count, count)), numpy.eye(count)],
            [-numpy.linalg.solve(mass, stiffness), -numpy.linalg.solve(mass, damping)],
        ]
    )
    poles = [pole for pole in numpy.linalg.eigvals(system) if abs(pole.imag) > 1e-6 * abs(pole)]
    worst = max(poles, key=abs, default=None)
    return (0.0, 1.0) if worst is None else (float(abs(worst) / (2.0 * numpy.pi)), float(-worst.real / abs(worst)))


def ringing_cautions(model: OccupantModel, sample_rate: float) -> tuple[str, ...]:
    """A sentence where a link rings so fast and so long that samples at a rate [Hz] do not follow it."""
    frequency, damped = ringing_of(model)
    if frequency < RINGING * sample_rate or damped > DIES_OUT:
        return ()
    sentence = (
        f"seat: a link of the occupant rings at {frequency:.3g} Hz with {damped:.2g} of its critical damping, and its motion and "
        f"that of the seat frame are not determined at {sample_rate:g} samples a second: 0.1 of the largest acceleration may be "
        "wrong; give it damping, or make it softer"
    )
    return (sentence,)


def rest_deflections(model: OccupantModel, gravity: float, lifted: Mapping[int, float] | None = None) -> Array:
    """Heights [nodes] [m] of the nodes over the seat interface at rest under ``gravity`` [m/s^2].

    ``lifted``: node -> force [N] upwards that holds it beside its links.
    """
    mass, _damping, stiffness = matrices(model)
    force = -gravity * numpy.diag(mass)
    for node, lift in (lifted or {}).items():
        force[node] += lift
    heights = numpy.zeros(len(model.masses))
    heights[1:] = numpy.linalg.solve(stiffness[1:, 1:], force[1:])
    return heights


def _motion(model: OccupantModel, frequency: ArrayLike) -> Response:
    """Motion [frequencies, nodes] under a unit motion of the seat interface."""
    w = 2.0 * numpy.pi * numpy.atleast_1d(numpy.asarray(frequency, dtype=float))
    mass, damping, stiffness = matrices(model)
    at = w[:, None, None]
    dynamic = stiffness + 1j * at * damping - at**2 * mass
    motion = numpy.ones((len(w), len(model.masses)), dtype=complex)
    motion[:, 1:] = numpy.linalg.solve(dynamic[:, 1:, 1:], -dynamic[:, 1:, :1])[:, :, 0]
    return motion
