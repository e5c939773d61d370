"""Keys of a seat suspension."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.rigs.vehicle.effects.travel_stops import StopKeys
from contact_sim_pkg.rigs.vehicle.seat.schema import SeatSection
from contact_sim_pkg.rigs.vehicle.tire.schema import TireSection
from contact_sim_pkg.run.integrator_work import Link
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.fields import number

if TYPE_CHECKING:
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene
    from contact_sim_pkg.scene.schema.scene import Scene

__all__ = ["SuspensionSection", "suspension_breaches"]


class SuspensionSection(StopKeys):
    """Seat suspension below the cushion: spring with preload, damper and dry friction between two end stops."""

    upper_mass: float = number(
        1.0, 100.0, "kg", "what moves with the cushion; in a car a part of tire.body_mass", default=15.0
    )
    stiffness: float = number(100.0, 1e6, "N/m", "spring; 4500 is 1.3 Hz under 50.8 kg", default=4500.0)
    damping: float = number(0.0, 1e5, "N s/m", "damper; 320 is a ratio of 0.29 under 50.8 kg", default=320.0)
    preload: float | None = number(
        0.0,
        1e5,
        "N",
        "force of the spring at mid-travel; by default it carries the occupant and upper_mass there",
        default=None,
    )
    friction: float = number(0.0, 1e4, "N", "dry friction; below it the suspension is locked; 0: none", default=30.0)
    presliding: float = number(
        1e-5, 0.01, "m", "travel over which friction holds as a spring before it slides", default=2e-4
    )
    travel: float = number(0.005, 1.0, "m", "from one end stop to the other, mid-travel between", default=0.1)

    def open_values(self, scene: Scene) -> dict[str, Any]:
        seated = sum(scene.section(SeatSection).occupant.model_of().masses)
        return {"preload": (seated + self.upper_mass) * GRAVITY}

    def links(self, scene: ResolvedScene) -> Iterator[Link]:
        """For the estimate of work."""
        holds = self.friction / self.presliding
        yield Link("suspension", self.upper_mass, self.stiffness + holds, self.damping)
        yield self.stop_link("suspension.travel", self.upper_mass)


def suspension_breaches(scene: Scene) -> Iterator[Breach]:
    """A suspension under a seat back, which stands on the floor; an upper part heavier than the body."""
    keys, where = scene.effect("seat", SuspensionSection), "effects.seat.suspension"
    if keys is None:
        return
    if scene.rig == "occupant":
        yield Breach(where, "the seat back of the rig occupant stands on the floor; remove it", ("rig",))
    if scene.rig == "car" and keys.upper_mass >= scene.section(TireSection).body_mass:
        yield Breach(f"{where}.upper_mass", "is a part of tire.body_mass and not below it", ("tire.body_mass",))
