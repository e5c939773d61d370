"""Grids of pressure fields, and the road lattice whose nodes are their cells. Knows no kernels and
no schema, so that the node that sends the road starts without them.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from contact_sim_pkg.excitation.blocks import RoadLattice
from contact_sim_pkg.pressure.settings import FieldSettings, widened
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.rig import Standing, TouchedBody
from contact_sim_pkg.rigs.vehicle.field.settings import field_settings
from contact_sim_pkg.rigs.vehicle.seat.mass import occupant_mass
from contact_sim_pkg.rigs.vehicle.tire.body import TireBody, tire_body
from contact_sim_pkg.scene.resolved_scene import plain

if TYPE_CHECKING:
    from contact_sim_pkg.rigs.vehicle.seat.schema import OccupantSection
    from contact_sim_pkg.rigs.vehicle.tire.schema import TireSection

FOLLOWER_CELLS = (64, 48)  # road lattice of a tire without pressure field
FOLLOWER_REACH = 4.0  # its extent over the contact radius of a sphere with the tire's radius in that direction
SIGHT = 1.0  # of the tire's radius: how far the road is looked at beyond the pressure grids


def standing_load(tire: TireSection, occupant: OccupantSection | None) -> float:
    """Load in [N] of the tire at rest, under an occupant where it carries one."""
    if tire.mount is not None and tire.mount.load is not None:
        return float(tire.mount.load)
    mass = tire.wheel_mass + tire.body_mass
    return (mass + (0.0 if occupant is None else occupant_mass(occupant))) * GRAVITY


def tire_lattice(body: TireBody, settings: FieldSettings | None, load: float) -> RoadLattice:
    """Lattice of the road under a tire: the cells of its field, or cells that hold its footprint
    under ``load`` [N].
    """
    form = body.form
    if settings is not None:
        wide = widened(settings)
        road_rows = max(wide.rows, 2 * math.ceil(SIGHT * form.radius_rolling / settings.cell_x))
        return RoadLattice(settings.rows, settings.cols, settings.cell_x, settings.cell_y, road_rows, wide.cols)
    (rows, cols), extent = FOLLOWER_CELLS, body.extent
    if extent is None:
        spheres = ((0.75 * load * radius / body.modulus) ** (1.0 / 3.0) for radius in form[:2])
        length, width = (FOLLOWER_REACH * radius for radius in spheres)
    else:
        length, width = extent
    return RoadLattice(rows, cols, length / rows, width / cols, rows, cols)


def plain_load(scene: dict[str, Any]) -> float:
    """Load in [N] at rest of the tire of a resolved scene's plain data, with the occupant that it
    carries in a car.
    """
    occupant = plain(scene["seat"]["occupant"]) if scene["rig"] == "car" else None
    return standing_load(plain(scene["tire"]), occupant)


def standing(scene: dict[str, Any]) -> Standing:
    """Loads and masses of a resolved scene's plain data: wheel, belt, frame of the occupant."""
    loads, bodies = {}, {}
    if scene["rig"] in ("tire", "car"):
        loads["tire"] = plain_load(scene)
        wheel, ring = plain(scene["tire"]).wheel_mass, plain(scene["effects"]["tire"].get("rigid_ring"))
        belt = 0.0 if ring is None else ring.belt_mass
        bodies["wheel_z"] = TouchedBody("tire", wheel - belt)
        if ring is not None:
            bodies["belt_z"] = TouchedBody("tire", belt)
    if scene["rig"] != "tire":
        occupant = plain(scene["seat"]["occupant"])
        loads["seat"] = occupant_mass(occupant) * GRAVITY
        if occupant.frame_mass > 0.0:
            bodies["seat_frame_z"] = TouchedBody("seat", occupant.frame_mass)
    return Standing(loads, bodies)


def plain_field(scene: dict[str, Any], body: TireBody) -> FieldSettings | None:
    """Grid of the field of a resolved scene's plain data under its tire."""
    return field_settings(plain(scene["effects"]["tire"].get("contact_field")), body.modulus, body.belt)


def road_strip(scene: dict[str, Any]) -> RoadLattice:
    """The strip of road that the tire of a resolved scene's plain data needs."""
    body = tire_body(scene["effects"]["tire"])
    return tire_lattice(body, plain_field(scene, body), plain_load(scene))
