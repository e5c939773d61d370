"""The state that a tire's contact is compared with: at rest on a flat road, in closed form; with a
belt, by its field.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from contact_sim_pkg.pressure.closed_form.hertz import HertzError, hertz_contact
from contact_sim_pkg.pressure.closed_form.lame import fit_patch, lame_area
from contact_sim_pkg.pressure.settings import BeltSettings, widened
from contact_sim_pkg.rigs.vehicle.contact_field import FieldError, PressureField
from contact_sim_pkg.rigs.vehicle.lattice import contact_modulus, plain_field
from contact_sim_pkg.rigs.vehicle.tire.report.numbers import standing_load_of
from contact_sim_pkg.scene.resolved_scene import plain

REFERENCE_TOLERANCE = 1e-6
"""Of the field at rest: what a run is measured by must not carry the error of the run's own
tolerance.
"""


class TireReference(NamedTuple):
    """Contact of the scene's radii and modulus under the standing load: elliptic Hertz, or the
    field of tread and belt.
    """

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
    area: float
    """[m^2]"""
    belt: BeltSettings | None = None
    """what yields beside the tread; with it the contact is no ellipse, its semi-axes are those of
    the fitted curve
    """

    @property
    def how(self) -> str:
        """How the contact at rest was found."""
        return "elliptic Hertz contact" if self.belt is None else "pressure field of tread and belt"


def tire_reference(scene: dict[str, Any]) -> TireReference | None:
    """Reference of a resolved scene; None where the scene has no tire or its numbers make no
    elliptic contact.
    """
    tire, load = scene.get("tire"), standing_load_of(scene)
    if not isinstance(tire, dict) or load is None:
        return None
    try:
        radius_x, radius_y = float(tire["radius_rolling"]), float(tire["radius_lateral"])
        modulus, poisson = contact_modulus(plain(tire)), float(tire["poisson_ratio"])
        contact = hertz_contact(0.5 / radius_x, 0.5 / radius_y, modulus, load)
    except (KeyError, TypeError, ZeroDivisionError, HertzError, ValueError):
        return None  # a scene that this version does not know: nothing to compare with
    semi_x, semi_y = (contact.b, contact.a) if radius_y >= radius_x else (contact.a, contact.b)
    reference = TireReference(
        load,
        modulus,
        poisson,
        radius_x,
        radius_y,
        semi_x,
        semi_y,
        contact.peak_pressure,
        contact.approach,
        math.pi * semi_x * semi_y,
    )
    return _on_belt(scene, reference)


def _on_belt(scene: dict[str, Any], reference: TireReference) -> TireReference | None:
    """The reference of a tire whose belt yields beside the tread; as it was without a belt, None
    where no grid holds it.
    """
    effects = (scene.get("effects") or {}).get("tire") or {}
    if not effects.get("envelopment"):
        return reference
    settings = plain_field(scene, reference.modulus)
    if settings is None:
        return None
    grid = widened(settings)._replace(tolerance=REFERENCE_TOLERANCE)
    x = (np.arange(grid.rows) - 0.5 * (grid.rows - 1)) * grid.cell_x
    y = (np.arange(grid.cols) - 0.5 * (grid.cols - 1)) * grid.cell_y
    gap = 0.5 * (x[:, None] ** 2 / reference.radius_rolling + y[None, :] ** 2 / reference.radius_lateral)
    field = PressureField(grid, "tire")
    try:
        approach = field.solve_load(gap, reference.load)
    except FieldError:
        return None
    curve = fit_patch(field.pressure, grid.cell_x, grid.cell_y, float(x[0]), float(y[0]))
    return reference._replace(
        semi_axis_x=curve.a, semi_axis_y=curve.b, peak_pressure=float(field.pressure.max()), approach=approach,
        area=lame_area(curve.a, curve.b, curve.exponent), belt=grid.belt,
    )  # fmt: skip
