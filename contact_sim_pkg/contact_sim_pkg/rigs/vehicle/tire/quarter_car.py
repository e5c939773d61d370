"""Masses and elements of a quarter car: wheel and body on their suspension, and the belt on its sidewalls where a
rigid ring is called for. On a test machine there is no body: the wheel is held, or slides under a load.
"""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.laws.parameters import Contact
from contact_sim_pkg.rigs.vehicle.motion.masses import Mass
from contact_sim_pkg.rigs.vehicle.motion.mount import HeldAxle, Slide
from contact_sim_pkg.rigs.vehicle.motion.parameters import Element
from contact_sim_pkg.rigs.vehicle.motion.road import AsperityPush, RoadContact
from contact_sim_pkg.rigs.vehicle.motion.spring import DriveLine, Spring
from contact_sim_pkg.rigs.vehicle.tire.mount import Mounted
from contact_sim_pkg.rigs.vehicle.tire.schema import RigidRingSection, TireSection
from contact_sim_pkg.scene.schema.fields import given

__all__ = ["QuarterCar", "quarter_car"]

WHEEL, BODY, BELT = 0, 2, 4
"""In the state, where a quarter car comes first."""


class QuarterCar(NamedTuple):
    """Parts of a quarter car by name; an effect that the scene does not call for is None."""

    wheel: Mass
    body: Mass | None  # None on a test machine
    belt: Mass | None  # without load as high as the wheel
    contact: RoadContact
    push: AsperityPush | None
    sidewalls: Spring | None  # between belt and wheel
    suspension: Spring | Slide | None  # of a test machine the slide, None where the axle is held
    drive_line: DriveLine | HeldAxle  # of the body, of a test machine the servo or what holds the axle

    @property
    def masses(self) -> tuple[Mass, ...]:
        """Those that there are."""
        return tuple(each for each in (self.wheel, self.body, self.belt) if each is not None)

    @property
    def elements(self) -> tuple[Element, ...]:
        """Those that there are, from the road up."""
        chain = (self.contact, self.push, self.sidewalls, self.suspension, self.drive_line)
        return tuple(each for each in chain if each is not None)

    @property
    def tread(self) -> Mass:
        """What touches the road."""
        return self.wheel if self.belt is None else self.belt

    @property
    def states(self) -> int:
        """Number of states."""
        return 2 * len(self.masses)

    @property
    def beside(self) -> float:
        """Stiffness [N/m] of the spring that holds what touches the road."""
        spring = self.sidewalls or self.suspension
        return spring.stiffness if isinstance(spring, Spring) else 0.0

    def lightened(self, mass: float) -> QuarterCar:
        """The same with ``mass`` [kg] taken from the body: what moves on its own there."""
        assert self.body is not None
        body = self.body._replace(mass=self.body.mass - mass)
        return self._replace(body=body, drive_line=DriveLine(body.place, body.mass))


def quarter_car(
    section: TireSection, ring: RigidRingSection | None, law: Contact, machine: Mounted | None, *, pushed: bool
) -> QuarterCar:
    """The quarter car of a scene on a contact ``law``, or its axle on a test ``machine``; ``pushed``: by the road's
    asperities.
    """
    belt = None if ring is None else Mass(BELT if machine is None else BODY, ring.belt_mass)
    wheel = Mass(WHEEL, section.wheel_mass - (0.0 if belt is None else belt.mass))
    tread = WHEEL if belt is None else belt.place
    sidewalls = None if ring is None else Spring(tread, WHEEL, given(ring.stiffness), given(ring.damping))
    contact, push = RoadContact(tread, law), AsperityPush(tread) if pushed else None
    if machine is not None:
        slide = None if machine.is_held else Slide(WHEEL, machine.damping)
        gives = HeldAxle(WHEEL) if machine.is_held else DriveLine(WHEEL, wheel.mass)
        return QuarterCar(wheel, None, belt, contact, push, sidewalls, slide, gives)
    body = Mass(BODY, section.body_mass)
    return QuarterCar(
        wheel, body, belt, contact, push, sidewalls,
        Spring(WHEEL, BODY, section.suspension_stiffness, section.suspension_damping), DriveLine(BODY, body.mass),
    )  # fmt: skip
