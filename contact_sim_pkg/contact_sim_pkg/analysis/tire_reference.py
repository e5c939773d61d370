"""The state that a tire's contact is compared with: at rest on a flat road, in closed form."""

from __future__ import annotations

from typing import Any, NamedTuple

from contact_sim_pkg.core.hertz import HertzError, hertz_contact
from contact_sim_pkg.scene.lattice import contact_modulus

from .tire_numbers import standing_load_of


class TireReference(NamedTuple):
    """Elliptic Hertz contact of the scene's radii and modulus under the standing load."""

    load: float
    """[N]"""
    modulus: float
    """[Pa] contact modulus E*"""
    poisson_ratio: float
    radius_rolling: float
    radius_lateral: float
    """[m]"""
    semi_axis_x: float
    semi_axis_y: float
    """[m] of the footprint, along and across"""
    peak_pressure: float
    """[Pa]"""
    approach: float
    """[m]"""


def tire_reference(scene: dict[str, Any]) -> TireReference | None:
    """Reference of a resolved scene; None where the scene has no tire or its numbers make no elliptic contact."""
    tire, load = scene.get("tire"), standing_load_of(scene)
    if not isinstance(tire, dict) or load is None:
        return None
    try:
        radius_x, radius_y = float(tire["radius_rolling"]), float(tire["radius_lateral"])
        modulus, poisson = contact_modulus(tire), float(tire["poisson_ratio"])
        contact = hertz_contact(0.5 / radius_x, 0.5 / radius_y, modulus, load)
    except (KeyError, TypeError, ZeroDivisionError, HertzError, ValueError):
        return None  # a scene that this version does not know: nothing to compare with
    semi_x, semi_y = (contact.b, contact.a) if radius_y >= radius_x else (contact.a, contact.b)
    return TireReference(
        load, modulus, poisson, radius_x, radius_y, semi_x, semi_y, contact.peak_pressure, contact.approach
    )
