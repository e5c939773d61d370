"""Grids of pressure fields, and the road lattice whose nodes are their cells. Knows no kernels and
no schema, so that the node that sends the road starts without them.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from contact_sim_pkg.excitation.blocks import RoadLattice
from contact_sim_pkg.pressure.settings import BeltSettings, FieldSettings, widened
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.scene.resolved_scene import plain

if TYPE_CHECKING:
    from contact_sim_pkg.rigs.vehicle.seat.schema import OccupantSection
    from contact_sim_pkg.rigs.vehicle.tire.schema import Envelopment, TireSection
    from contact_sim_pkg.scene.schema.pressure_field import PressureFieldSection

FIELD_ITERATIONS = 400
FOLLOWER_CELLS = (64, 48)  # road lattice of a tire without pressure field
FOLLOWER_REACH = 4.0  # its extent over the contact radius of a sphere with the tire's radius in that direction
SIGHT = 1.0  # of the tire's radius: how far the road is looked at beyond the pressure grids


def field_settings(
    field: PressureFieldSection | None, modulus: float, envelopment: Envelopment | None = None
) -> FieldSettings | None:
    """Grid and accuracy of a resolved pressure field over a ``modulus`` [Pa]; None where the scene
    calls for none.
    """
    if field is None:
        return None
    # A resolved scene leaves none of these open.
    rows, cols, tolerance, passes = field.rows, field.cols, field.tolerance, field.corrector_passes
    assert rows is not None
    assert cols is not None
    assert tolerance is not None
    assert passes is not None
    belt = None if envelopment is None else BeltSettings(envelopment.tension, envelopment.foundation)
    return FieldSettings(
        rows=rows,
        cols=cols,
        cell_x=field.length / rows,
        cell_y=field.width / cols,
        modulus=modulus,
        tolerance=tolerance,
        maximum_iterations=FIELD_ITERATIONS,
        corrector_passes=passes,
        belt=belt,
    )


def occupant_mass(occupant: OccupantSection) -> float:
    """Mass of the whole occupant in [kg]."""
    # A resolved scene leaves neither open.
    assert occupant.frame_mass is not None
    assert occupant.masses is not None
    return occupant.frame_mass + sum(occupant.masses)


def contact_modulus(tire: TireSection) -> float:
    """Plane-strain modulus E / (1 - nu^2) in [Pa] of the tire on a rigid road."""
    return tire.young_modulus / (1.0 - tire.poisson_ratio**2)


def standing_load(tire: TireSection, occupant: OccupantSection | None) -> float:
    """Load in [N] of the tire at rest, under an occupant where it carries one."""
    mass = tire.wheel_mass + tire.body_mass
    return (mass + (0.0 if occupant is None else occupant_mass(occupant))) * GRAVITY


def tire_lattice(tire: TireSection, settings: FieldSettings | None, load: float) -> RoadLattice:
    """Lattice of the road under a tire: the cells of its field, or cells that hold its footprint
    under ``load`` [N].
    """
    if settings is not None:
        wide = widened(settings)
        road_rows = max(wide.rows, 2 * math.ceil(SIGHT * tire.radius_rolling / settings.cell_x))
        return RoadLattice(settings.rows, settings.cols, settings.cell_x, settings.cell_y, road_rows, wide.cols)
    rows, cols = FOLLOWER_CELLS
    modulus = contact_modulus(tire)
    radius_x, radius_y = (
        (0.75 * load * radius / modulus) ** (1.0 / 3.0) for radius in (tire.radius_rolling, tire.radius_lateral)
    )
    return RoadLattice(rows, cols, FOLLOWER_REACH * radius_x / rows, FOLLOWER_REACH * radius_y / cols, rows, cols)


def plain_tire(scene: dict[str, Any]) -> tuple[TireSection, OccupantSection | None]:
    """The tire of a resolved scene's plain data, and the occupant that it carries in a car."""
    tire: TireSection = plain(scene["tire"])
    return tire, plain(scene["seat"]["occupant"]) if scene["rig"] == "car" else None


def plain_field(scene: dict[str, Any], modulus: float) -> FieldSettings | None:
    """Grid of the tire's field of a resolved scene's plain data over a ``modulus`` [Pa]."""
    effects = scene["effects"].get("tire") or {}
    return field_settings(plain(effects.get("contact_field")), modulus, plain(effects.get("envelopment")))


def road_strip(scene: dict[str, Any]) -> RoadLattice:
    """The strip of road that the tire of a resolved scene's plain data needs."""
    tire, occupant = plain_tire(scene)
    return tire_lattice(tire, plain_field(scene, contact_modulus(tire)), standing_load(tire, occupant))
