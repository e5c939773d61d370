"""The state that a tire's contact is compared with: at rest on a flat road, in closed form; with a
belt, by its field.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from contact_sim_pkg.pressure.closed_form.hertz import HertzError, hertz_contact
from contact_sim_pkg.pressure.closed_form.lame import fit_patch, lame_area
from contact_sim_pkg.pressure.settings import widened
from contact_sim_pkg.rigs.vehicle.field.contact_field import FieldError, PressureField
from contact_sim_pkg.rigs.vehicle.tire.body import TireBody, tire_body
from contact_sim_pkg.rigs.vehicle.tire.force_table import gap_over_level_road
from contact_sim_pkg.rigs.vehicle.tire.lattice import plain_field
from contact_sim_pkg.rigs.vehicle.tire.report.numbers import standing_load_of

REFERENCE_TOLERANCE = 1e-6
"""Of the field at rest: what a run is measured by must not carry the error of the run's own
tolerance.
"""


class TireReference(NamedTuple):
    """Contact of the scene's tire under the standing load on a level road: elliptic Hertz, or the
    field of tread and belt.
    """

    load: float
    """[N]"""
    body: TireBody
    semi_axis_x: float
    semi_axis_y: float
    """[m] of the footprint, along and across; of the fitted curve where a belt makes it no ellipse"""
    peak_pressure: float
    """[Pa]"""
    approach: float
    """[m]"""
    area: float
    """[m^2]"""

    @property
    def how(self) -> str:
        """How the contact at rest was found."""
        return "elliptic Hertz contact" if self.body.belt is None else "pressure field of tread and belt"


def tire_reference(scene: dict[str, Any]) -> TireReference | None:
    """Reference of a resolved scene; None where the scene has no tire or its numbers make no
    contact.
    """
    load = standing_load_of(scene)
    if load is None:
        return None
    try:
        body = tire_body(scene["effects"]["tire"])
        return _hertz(body, load) if body.belt is None else _on_belt(scene, body, load)
    except (KeyError, TypeError, ZeroDivisionError, HertzError, ValueError):
        return None  # a scene that this version does not know: nothing to compare with


def _hertz(body: TireBody, load: float) -> TireReference:
    radius_x, radius_y = body.form.radius_rolling, body.form.radius_lateral
    contact = hertz_contact(0.5 / radius_x, 0.5 / radius_y, body.modulus, load)
    semi_x, semi_y = (contact.b, contact.a) if radius_y >= radius_x else (contact.a, contact.b)
    area = math.pi * semi_x * semi_y
    return TireReference(load, body, semi_x, semi_y, contact.peak_pressure, contact.approach, area)


def _on_belt(scene: dict[str, Any], body: TireBody, load: float) -> TireReference | None:
    """The reference of a tire whose belt yields beside the tread; None where no grid holds it."""
    settings = plain_field(scene, body)
    if settings is None:
        return None
    grid = widened(settings)._replace(tolerance=REFERENCE_TOLERANCE)
    x = (np.arange(grid.rows) - 0.5 * (grid.rows - 1)) * grid.cell_x
    y = (np.arange(grid.cols) - 0.5 * (grid.cols - 1)) * grid.cell_y
    field = PressureField(grid, "tire")
    try:
        approach = field.solve_load(gap_over_level_road(body.form, x, y), load)
    except FieldError:
        return None
    curve = fit_patch(field.pressure, grid.cell_x, grid.cell_y, float(x[0]), float(y[0]))
    area = lame_area(curve.a, curve.b, curve.exponent)
    return TireReference(load, body, curve.a, curve.b, float(field.pressure.max()), approach, area)
