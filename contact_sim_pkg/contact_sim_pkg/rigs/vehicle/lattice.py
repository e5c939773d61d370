"""Grids of a resolved scene: pressure fields, and the road lattice whose nodes are their cells. Knows no kernels, so that the
node that sends the road starts without them.
"""

from __future__ import annotations

import math
from typing import Any

from contact_sim_pkg.excitation.blocks import RoadLattice
from contact_sim_pkg.pressure.settings import BeltSettings, FieldSettings, widened
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.scene.resolved_scene import effects_at

FIELD_ITERATIONS = 400
FOLLOWER_CELLS = (64, 48)  # road lattice of a tire without pressure field
FOLLOWER_REACH = 4.0  # its extent over the contact radius of a sphere with the tire's radius in that direction


SIGHT = 1.0  # of the tire's radius: how far the road is looked at beyond the pressure grids


def field_settings(scene: dict[str, Any], contact: str, modulus: float) -> FieldSettings | None:
    """Grid and accuracy of the field of a contact; None where the scene calls for none."""
    effects = effects_at(scene, contact)
    field, bend = effects.get("contact_field"), effects.get("envelopment")
    if field is None:
        return None
    rows, cols = int(field["rows"]), int(field["cols"])
    belt = None if bend is None else BeltSettings(float(bend["tension"]), float(bend["foundation"]))
    return FieldSettings(
        rows, cols, float(field["length"]) / rows, float(field["width"]) / cols, modulus, float(field["tolerance"]),
        FIELD_ITERATIONS, int(field["corrector_passes"]), belt,
    )  # fmt: skip


def occupant_mass(scene: dict[str, Any]) -> float:
    """Mass of the whole occupant in [kg]."""
    occupant = scene["seat"]["occupant"]
    return float(occupant["frame_mass"] + sum(occupant["masses"]))


def contact_modulus(tire: dict[str, Any]) -> float:
    """Plane-strain modulus E / (1 - nu^2) in [Pa] of the tire on a rigid road."""
    return float(tire["young_modulus"] / (1.0 - tire["poisson_ratio"] ** 2))


def standing_load(scene: dict[str, Any]) -> float:
    """Load in [N] of the tire at rest."""
    mass = scene["tire"]["wheel_mass"] + scene["tire"]["body_mass"]
    return float((mass + (occupant_mass(scene) if scene["rig"] == "car" else 0.0)) * GRAVITY)


def tire_lattice(scene: dict[str, Any]) -> RoadLattice:
    """Lattice of a resolved scene's road: the cells of the tire's field, or cells that hold its footprint."""
    tire = scene["tire"]
    modulus = contact_modulus(tire)
    settings = field_settings(scene, "tire", modulus)
    if settings is not None:
        wide = widened(settings)
        road_rows = max(wide.rows, 2 * math.ceil(SIGHT * float(tire["radius_rolling"]) / settings.cell_x))
        return RoadLattice(settings.rows, settings.cols, settings.cell_x, settings.cell_y, road_rows, wide.cols)
    rows, cols = FOLLOWER_CELLS
    radius_x, radius_y = (
        (0.75 * standing_load(scene) * tire[key] / modulus) ** (1.0 / 3.0)
        for key in ("radius_rolling", "radius_lateral")
    )
    return RoadLattice(rows, cols, FOLLOWER_REACH * radius_x / rows, FOLLOWER_REACH * radius_y / cols, rows, cols)
