"""The table of masses: equations of motion and energies of coordinates on which elements act."""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import kernel_overload

__all__ = ["Mass", "accelerate", "energies_of_masses"]


class Mass(NamedTuple):
    """A coordinate with its mass: position [m] and velocity [m/s] lie side by side in the state."""

    place: int  # index of the position
    mass: float  # [kg], > 0


Masses = tuple[Mass, ...]


def accelerate(masses: Masses, field: float, state: Vector, out: Vector) -> None:
    """Turn forces [N] in the places of the accelerations into rates under a ``field`` [m/s^2]; state, out: [states]."""
    for each in masses:
        out[each.place] = state[each.place + 1]
        out[each.place + 1] = out[each.place + 1] / each.mass + field


def energies_of_masses(masses: Masses, gravity: float, state: Vector) -> tuple[float, float]:
    """Kinetic and potential energy [J] of a state [states]; gravity in [m/s^2]."""
    kinetic = sum(0.5 * each.mass * state[each.place + 1] ** 2 for each in masses)
    return kinetic, gravity * sum(each.mass * state[each.place] for each in masses)


# Each takes the first mass and leaves the others to itself: no loop over tuples.
@kernel_overload(accelerate, thin=True)
def _accelerate(masses, field, state, out):
    if not len(masses):
        return lambda masses, field, state, out: None

    def implementation(masses, field, state, out):
        place = masses[0].place
        out[place] = state[place + 1]
        out[place + 1] = out[place + 1] / masses[0].mass + field
        accelerate(masses[1:], field, state, out)

    return implementation


@kernel_overload(energies_of_masses, thin=True)
def _energies_of_masses(masses, gravity, state):
    if not len(masses):
        return lambda masses, gravity, state: (0.0, 0.0)

    def implementation(masses, gravity, state):
        place, mass = masses[0].place, masses[0].mass
        kinetic, potential = energies_of_masses(masses[1:], gravity, state)
        return kinetic + 0.5 * mass * state[place + 1] ** 2, potential + gravity * mass * state[place]

    return implementation
