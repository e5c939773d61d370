"""What an effect that acts in the motion of a vehicle finds there, and what it brings.

Its record names a function ``(keys, chassis) -> Acting`` (`records/effect.py`, ``elements``), which is called when the
model of a scene is made, before the run. The elements are tuples of classes registered with
`motion/elements.register_element`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from contact_sim_pkg.rigs.vehicle.motion.masses import Mass

__all__ = ["Acting", "Chassis", "Joined"]


class Chassis(NamedTuple):
    """Masses between which an element can act, by their places in the state, and what is free there."""

    gravity: float  # [m/s^2]
    wheel: Mass | None  # None without a tire, as the body; the floor is the frame of reference then
    body: Mass | None  # a mass in that frame needs a `motion/spring.ShakenMass` beside it
    seated: float  # [kg] of the occupant; 0 without a seat
    suspension: float  # [N/m] of the spring between wheel and body; 0 without a tire
    first_state: int  # from which on the states of the effect lie: two for each mass, then its own
    first_mode: int

    @property
    def hangs(self) -> float:
        """Height [m] of the body over the wheel at rest on the suspension's spring alone."""
        return 0.0 if self.body is None else -(self.body.mass + self.seated) * self.gravity / self.suspension


class Joined(NamedTuple):
    """A mass that an effect brings; its name ends in ``_z`` and is that of a row of ``bench/motion``."""

    name: str
    mass: Mass
    scale: tuple[float, float]  # [m], [m/s] size of its motion, to which the integrator's tolerance is relative


class Acting(NamedTuple):
    """What an effect brings."""

    elements: tuple[Any, ...]
    joined: tuple[Joined, ...] = ()
    states: tuple[float, ...] = ()  # sizes of its own states, to which the integrator's tolerance is relative
    modes: int = 0
    of_body: float = 0.0  # [kg] of its masses that the body's mass of the scene contains
    pan: int | None = None  # place of what the cushion stands on, in place of the floor
    scales: tuple[
        tuple[int, float, float], ...
    ] = ()  # place, [m], [m/s]: largest sizes of the motion of masses there are
