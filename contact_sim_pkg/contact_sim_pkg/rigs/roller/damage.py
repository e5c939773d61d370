"""What a load wears: the dangerous share of the working volume over the load, measured before the
run.

Under a load F stress grows as F^(1/3) and the box below the contact as F, so the share over F is a
smooth function of F^(1/3): 0 up to the load at which the largest stress meets its limit, then
rising. It is measured at even places of F^(1/3) and laid through them by a monotone cubic (Fritsch
and Carlson, 1980), so that no wear is read where nothing is dangerous.
"""

from __future__ import annotations

import numpy
import scipy  # its parts are imported on use: they take 0.1 to 0.3 s

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigs.roller.model import RollerModel
from contact_sim_pkg.rigs.roller.settings import volume_settings
from contact_sim_pkg.rigs.roller.theory.ellipse import RollingContact
from contact_sim_pkg.rigs.roller.theory.volumes import box_volume, dangerous_volumes, largest_ratio

__all__ = ["Table", "damage_table"]

Table = tuple[Vector, Vector]

FINER = 32
"""Rows of the table that is read, over those that are measured: straight between them errs by 1e-4
of a share.
"""


def damage_table(model: RollerModel, body: str = "shaft") -> Table:
    """Loads [N] from 0, and the dangerous share of the working volume under each; zeros where
    nothing wears.

    body: "shaft" or "roller", whose limits count.
    """
    damage = model.damage
    if damage is None or model.subsurface is None:
        return numpy.array([0.0, 1.0]), numpy.zeros(2)
    largest, rows = damage.largest_load * model.largest_load, damage.table_rows
    first = _first_dangerous_load(model, body)
    if not first < largest:
        return numpy.array([0.0, largest]), numpy.zeros(2)
    places = numpy.linspace(numpy.cbrt(first), numpy.cbrt(largest), rows)
    shares = numpy.array([0.0, *(_share(model, body, float(place**3)) for place in places[1:])])
    fine = numpy.linspace(places[0], places[-1], FINER * (rows - 1) + 1)
    read = numpy.maximum(scipy.interpolate.PchipInterpolator(places, shares / places**3)(fine), 0.0) * fine**3
    return numpy.append(0.0, fine**3), numpy.append(0.0, read)


def _first_dangerous_load(model: RollerModel, body: str) -> float:
    """[N] at which the largest stress of the cells meets its limit."""
    limits, cells, bending, traction = volume_settings(model, body)
    ratio = largest_ratio(_contact(model, 1.0), model.poisson_ratio, limits, cells, bending, traction)
    return float(ratio**-3)


def _share(model: RollerModel, body: str, load: float) -> float:
    volumes = dangerous_volumes(_contact(model, load), model.poisson_ratio, *volume_settings(model, body))
    return volumes.any / box_volume(_contact(model, float(model.programme.load[0])))


def _contact(model: RollerModel, load: float) -> RollingContact:
    """At the start of the run, at the yaw that is held."""
    return model.contact(load, model.held_yaw, model.programme.curvatures_at(0.0))
