"""Force of the pad and motion of the mass over it, compiled.

m z'' = -m g + F,  F = max(0, -k z - c z') for z < 0: spring k [N/m] and damper c [N s/m] side by side
(Johnson, Contact Mechanics, section 6.5).
"""

import math
from typing import NamedTuple

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry, kernel

GRAVITY = 9.80665  # [m/s^2]


class Pad(NamedTuple):
    """The pad and the mass on it, in SI units."""

    mass: float
    stiffness: float
    damping: float


@kernel
def pad_force(pad: Pad, height: float, speed: float) -> float:
    """Force [N] on the mass at a height [m] and a speed [m/s], both up."""
    return max(0.0, -pad.stiffness * height - pad.damping * speed) if height < 0.0 else 0.0


@kernel
def fly(state: Vector, time: float) -> None:
    """Free flight over a time [s], exactly."""
    state[0] += time * (state[1] - 0.5 * GRAVITY * time)
    state[1] -= GRAVITY * time


@entry
def advance(pad: Pad, state: Vector, step: float, steps: int) -> float:
    """Advance height [m], speed [m/s] and heat [J] in ``state`` by so many ``step`` [s]: flights exactly,
    up to the instant at which they end, on the pad by the midpoint rule; returns the force [N] at the end.
    """
    for _ in range(steps):
        left = step
        if state[0] >= 0.0:
            left = (state[1] + math.sqrt(state[1] ** 2 + 2.0 * GRAVITY * state[0])) / GRAVITY
            fly(state, min(left, step))
            left = step - left
        if left > 0.0:
            force = pad_force(pad, state[0], state[1])
            speed = state[1] + 0.5 * left * (force / pad.mass - GRAVITY)
            height = min(0.0, state[0] + 0.5 * left * state[1])
            force = pad_force(pad, height, speed)
            state[2] += left * (-force - pad.stiffness * height) * speed
            state[0] += left * speed
            state[1] += left * (force / pad.mass - GRAVITY)
    return pad_force(pad, state[0], state[1])
