"""What an effect that acts in the motion of a vehicle finds there, and what it brings.

Its record names a function ``(keys, chassis) -> Acting`` (`records/effect.py`, ``elements``), which is called when the
model of a scene is made, before the run. The elements are tuples of classes registered with
`motion/elements.register_element`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from contact_sim_pkg.rigs.vehicle.motion.elements import is_registered
from contact_sim_pkg.rigs.vehicle.motion.masses import Mass
from contact_sim_pkg.scene.errors import Fault, SceneError

__all__ = ["Acting", "Chassis", "Joined", "refuse_brought", "together"]


class Chassis(NamedTuple):
    """Masses between which an element can act, by their places in the state, and what is free there."""

    gravity: float  # [m/s^2]
    wheel: Mass | None  # None without a tire, as the body; the floor is the frame of reference then
    body: Mass | None  # with the masses that effects bring; one in that frame needs a `motion/spring.ShakenMass`
    seated: float  # [kg] of the occupant; 0 without a seat
    suspension: float  # [N/m] of the spring between wheel and body; 0 without a tire
    first_state: int  # from which on the states of the effect lie: two for each mass, then its own
    first_mode: int

    @property
    def hangs(self) -> float:
        """Height [m] of the body over the wheel at rest on the suspension's spring alone."""
        return 0.0 if self.body is None else -(self.body.mass + self.seated) * self.gravity / self.suspension


class Joined(NamedTuple):
    """A mass that an effect brings, which the body's mass of the scene contains where there is a body: the load at rest
    stays the scene's. Its name ends in ``_z`` and is that of a row of ``bench/motion``.
    """

    name: str
    mass: Mass
    scale: tuple[float, float]  # [m], [m/s] size of its motion, to which the integrator's tolerance is relative


class Acting(NamedTuple):
    """What an effect brings."""

    elements: tuple[Any, ...]
    joined: tuple[Joined, ...] = ()
    states: tuple[float, ...] = ()  # sizes of its own states, to which the integrator's tolerance is relative
    modes: int = 0
    pan: int | None = None  # place of what the cushion stands on, in place of the floor
    scales: tuple[
        tuple[int, float, float], ...
    ] = ()  # place, [m], [m/s]: largest sizes of the motion of masses there are

    @property
    def mass(self) -> float:
        """[kg] of the masses that it brings."""
        return sum(joined.mass.mass for joined in self.joined)

    def own_states(self, first: int) -> list[int]:
        """Places of its own states, where all of its states lie from place ``first`` on."""
        masses = {place for joined in self.joined for place in (joined.mass.place, joined.mass.place + 1)}
        return [place for place in range(first, first + self.width) if place not in masses]

    @property
    def width(self) -> int:
        """Number of its states: two for each mass, and its own."""
        return 2 * len(self.joined) + len(self.states)


def refuse_brought(where: str, brought: Acting, chassis: Chassis, before: Sequence[Acting]) -> None:
    """SceneError for what no vehicle can hold beside what effects ``before`` have brought."""
    body, mass = chassis.body, together((*before, brought)).mass
    names = [joined.name for each in (*before, brought) for joined in each.joined]
    sentence = ""
    if unknown := [type(each).__qualname__ for each in brought.elements if not is_registered(type(each))]:
        sentence = (
            f"brings an element of the class {unknown[0]}, which is not registered; call register_element with it"
        )
    elif misnamed := [joined.name for joined in brought.joined if not joined.name.endswith("_z")]:
        sentence = f"brings a mass named {misnamed[0]}, a name that ends in _z is needed"
    elif twice := [name for name in names if names.count(name) > 1]:
        sentence = f"brings a mass named {twice[0]}, as another effect does; remove one of them, or rename its mass"
    elif brought.pan is not None and any(each.pan is not None for each in before):
        sentence = "carries the cushion, as another effect does; remove one of them"
    elif body is not None and mass >= body.mass:
        sentence = f"makes {mass:g} kg of masses that the body contains, which is {body.mass:g} kg; more is needed"
    if sentence:
        raise SceneError([Fault("scene", 0, 0, where, sentence)])


def together(found: Sequence[Acting]) -> Acting:
    """What all effects bring."""
    return Acting(
        tuple(element for each in found for element in each.elements),
        tuple(joined for each in found for joined in each.joined),
        tuple(size for each in found for size in each.states),
        sum(each.modes for each in found),
        next((each.pan for each in found if each.pan is not None), None),
        tuple(scale for each in found for scale in each.scales),
    )
