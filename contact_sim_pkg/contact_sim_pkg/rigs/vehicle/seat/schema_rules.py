"""Rules that tie keys of the occupant together."""

from __future__ import annotations

from collections.abc import Iterator

from contact_sim_pkg.rigs.vehicle.seat.schema import SeatSection
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.scene import Scene


def occupant_breaches(scene: Scene) -> Iterator[Breach]:
    """Springs and dampers that do not belong to a mass."""
    occupant = scene.section(SeatSection).occupant
    for name, values in (("stiffness", occupant.stiffness), ("damping", occupant.damping)):
        if len(values) != len(occupant.masses):
            sentence = f"has {len(values)} values, masses has {len(occupant.masses)}; each mass needs one"
            yield Breach(f"seat.occupant.{name}", sentence, ("seat.occupant.masses",))
