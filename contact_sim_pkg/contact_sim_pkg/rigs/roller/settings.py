"""Settings of the dangerous volumes, as a scene gives them."""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.rigs.roller.model import RollerModel

__all__ = ["VolumeSettings", "volume_settings"]


class VolumeSettings(NamedTuple):
    """As `dangerous_volumes` takes them."""

    limits: tuple[float, float]  # [Pa] normal, shear
    cells: tuple[int, int, int]
    bending: None
    traction: tuple[float, float]


def volume_settings(model: RollerModel, prefix: str = "") -> VolumeSettings:
    """Of the effect `subsurface`, which the scene has; prefix: of a body's limits."""
    below = model.effects["subsurface"]
    limits = (float(below[f"{prefix}normal_limit"]), float(below[f"{prefix}shear_limit"]))
    cells = (int(below["cells_x"]), int(below["cells_y"]), int(below["cells_z"]))
    return VolumeSettings(limits, cells, None, model.traction)
