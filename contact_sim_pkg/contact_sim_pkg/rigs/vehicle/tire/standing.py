"""The tire as it stands under its standing load on a level road: what it is, whatever the run.

Of an inflated tire by its force table, of a half-space on the road by Hertz's closed form, of one under a belt by
two solutions of its field. The compliance of a rigid ring's sidewalls stands in series.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.laws.elastic_law import approach_of_force
from contact_sim_pkg.laws.parameters import ElasticLaw, NormalElastic
from contact_sim_pkg.pressure.closed_form.hertz import hertz_contact, power_law
from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.rigs.vehicle.field.contact_field import TANGENT_TOLERANCE, FieldError, FieldGrids, fit_tangent
from contact_sim_pkg.rigs.vehicle.motion.spring import Spring
from contact_sim_pkg.rigs.vehicle.tire.body import TireBody, TireForm
from contact_sim_pkg.rigs.vehicle.tire.force_table import Footprint, TireTable, footprint_of, gap_over_level_road
from contact_sim_pkg.rigs.vehicle.tire.static_stiffness import tire_stiffness

__all__ = ["TireAtRest", "crown_of", "hertz_law", "hertz_semi_axes", "of_field", "of_half_space", "of_table"]


class TireAtRest(NamedTuple):
    """Columns of `TireStanding.msg`."""

    load: float  # [N]
    deflection: float  # [m] of the axle
    stiffness: float  # [N/m] of the whole tire
    length: float  # [m] along the travel
    width: float  # [m] across
    area: float  # [m^2]
    mean_pressure: float  # [Pa]


def of_table(table: TireTable, sidewalls: Spring | None, load: float) -> TireAtRest | None:
    """An inflated tire under a ``load`` [N]; None beyond its ``table``."""
    return None if load > table.force[-1] else _at_rest(table.law(), table.footprint_at(load), sidewalls, load)


def of_half_space(body: TireBody, sidewalls: Spring | None, load: float) -> TireAtRest:
    """A half-space without belt under a ``load`` [N], in closed form (Johnson, Contact Mechanics, 4.2), also where
    the run has a field of it.
    """
    along, across = hertz_semi_axes(body, load)
    footprint = Footprint(2.0 * along, 2.0 * across, math.pi * along * across)
    return _at_rest(hertz_law(body), footprint, sidewalls, load)


def of_field(grids: FieldGrids, form: TireForm, sidewalls: Spring | None, load: float) -> TireAtRest | None:
    """A tire whose field is solved on ``grids`` under a ``load`` [N] and 5 % more; None where neither grid holds it."""
    for field in grids.both():
        gap, settings = crown_of(form, field.settings), field.settings
        try:
            law = fit_tangent(field, gap, load)
            field.solve_load(gap, load, min(TANGENT_TOLERANCE, settings.tolerance))
        except FieldError:
            continue
        return _at_rest(law, footprint_of(field.pressure, settings.cell_x, settings.cell_y), sidewalls, load)
    return None


def hertz_semi_axes(body: TireBody, load: float) -> tuple[float, float]:
    """Semi-axes [m] along and across of a half-space on a level road under a ``load`` [N]."""
    form = body.form
    hertz = hertz_contact(0.5 / form.radius_rolling, 0.5 / form.radius_lateral, body.modulus, load)
    return (hertz.b, hertz.a) if form.radius_lateral >= form.radius_rolling else (hertz.a, hertz.b)


def hertz_law(body: TireBody) -> NormalElastic:
    """Hertz's law of a half-space on a level road."""
    return NormalElastic(
        float(power_law(0.5 / body.form.radius_rolling, 0.5 / body.form.radius_lateral, body.modulus)), 1.5
    )


def crown_of(form: TireForm, grid: FieldSettings) -> NDArray[numpy.float64]:
    """Gap of the tire over a level road in [m], on the cells [rows, cols] of a grid."""
    x = (numpy.arange(grid.rows) - grid.rows // 2) * grid.cell_x
    y = (numpy.arange(grid.cols) - 0.5 * (grid.cols - 1)) * grid.cell_y
    return gap_over_level_road(form, x, y)


def _at_rest(law: ElasticLaw, footprint: Footprint, sidewalls: Spring | None, load: float) -> TireAtRest:
    beside = 0.0 if sidewalls is None else load / sidewalls.stiffness
    deflection = float(approach_of_force(law, load)) + beside
    return TireAtRest(load, deflection, tire_stiffness(law, sidewalls, load), *footprint, load / footprint.area)
