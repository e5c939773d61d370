"""Settings of the dangerous volumes, as a scene gives them."""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.records.fields import given
from contact_sim_pkg.rigs.roller.model import RollerModel

__all__ = ["VolumeSettings", "volume_settings"]


class VolumeSettings(NamedTuple):
    """As `dangerous_volumes` takes them."""

    limits: tuple[float, float]  # [Pa] normal, shear
    cells: tuple[int, int, int]
    bending: None
    traction: tuple[float, float]


def volume_settings(model: RollerModel, body: str = "shaft") -> VolumeSettings:
    """Of the effect `subsurface`, which the scene has, with the limits of a body."""
    below = given(model.subsurface)
    limits = (below.normal_limit, below.shear_limit)
    if body == "roller":
        limits = (below.roller_normal_limit, below.roller_shear_limit)
    return VolumeSettings(limits, (below.cells_x, below.cells_y, below.cells_z), None, model.traction)
