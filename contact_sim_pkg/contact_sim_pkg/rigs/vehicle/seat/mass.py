"""Mass of an occupant by a scene's section or its plain data. Knows no schema, as the node that sends the road."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from contact_sim_pkg.rigs.vehicle.seat.schema import OccupantSection


def occupant_mass(occupant: OccupantSection) -> float:
    """Mass of the whole occupant in [kg]."""
    # A resolved scene leaves neither open.
    assert occupant.frame_mass is not None
    assert occupant.masses is not None
    return occupant.frame_mass + sum(occupant.masses)
