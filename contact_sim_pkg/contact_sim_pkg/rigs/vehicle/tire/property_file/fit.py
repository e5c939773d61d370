"""Inflated tire fitted to stiffness, deflection and contact of a property file.

Sidewall angle, tread modulus, structural stiffness, crown radius and rigid ring change; where the
file has the ring this is held back, and the bending of the belt changes too. Stiffness and
deflection count alike, before the contact, and what the tire cannot be is left as a difference.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from scipy.optimize import least_squares

from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.rigs.vehicle.field.contact_field import FieldError, PressureField
from contact_sim_pkg.rigs.vehicle.tire.body import TireBody, tire_body
from contact_sim_pkg.rigs.vehicle.tire.force_table import COLS, ITERATIONS, ROWS, TOLERANCE, gap_over_level_road
from contact_sim_pkg.rigs.vehicle.tire.property_file.magic_formula import (
    USUAL_COEFFICIENTS,
    StandingTire,
    contact_of,
)
from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation
from contact_sim_pkg.rigs.vehicle.tire.size import read_size
from contact_sim_pkg.scene.schema.catalog import catalog
from contact_sim_pkg.scene.schema.fields import given

__all__ = ["allowed", "angles", "fitted", "standing_on_belt"]

Field = NDArray[numpy.float64]
LOAD_STEP = 0.02  # of the load, either way, for the stiffness
CLOSE, CLOSE_CONTACT, USUAL_CONTACT = 0.0175, 0.05, 0.15
"""Relative standard deviations of the fit: stiffness and deflection; length and width of the contact
of the file; those of a usual contact where it has none.
"""


class Unknown(NamedTuple):
    """A key of the inflation that the fit changes, or its logarithm."""

    key: str
    low: float
    high: float
    step: float  # for a derivative: the contact's edge moves by a part of a cell
    weakly: float = 1.0  # standard deviation about the usual value, which decides where the file has no contact
    logarithm: bool = True


UNKNOWNS = (
    Unknown("tread_modulus", 5e5, 5e7, 0.05), Unknown("structure", 1e4, 2e6, 0.3, weakly=4.0),
    Unknown("crown_radius", 0.1, 10.0, 0.2),
)  # fmt: skip
RING = Unknown("ring_stiffness", 1e5, 1e8, 0.05)
BOUND_RING = RING._replace(weakly=0.15)
"""The rigid ring, and that of a file that has one."""
BENDING = Unknown("bending", 1.0, 10.0, 0.1)
USUAL = Inflation()
TINY = 1e-3  # [m] extent of a contact that is less than two cells
FAR = 1e3  # residual of a tire that cannot be solved


def fitted(inflation: Inflation, aim: StandingTire, ring: bool) -> Inflation:
    """The tire whose stiffness and deflection are nearest to `aim`, and the contact to its, or to a usual
    one where it has none.

    ring: whether the rigid ring is free; otherwise that of `inflation` is held back, as the file's.

    Raises FieldError where no such tire carries the load.
    """
    angle = Unknown("sidewall_angle", *angles(inflation), step=0.03, logarithm=False)
    unknowns = (angle, *UNKNOWNS, *((RING,) if ring else (BOUND_RING, BENDING)))
    size = read_size(inflation.size, inflation.radius)
    usual_contact = contact_of(USUAL_COEFFICIENTS, size.radius, size.width, aim.load / (aim.stiffness * size.radius))
    extents = [own or max(TINY, usual) for own, usual in zip((aim.length, aim.width), usual_contact, strict=True)]
    wanted = numpy.array([aim.stiffness, aim.deflection, *extents])
    closeness = [CLOSE, CLOSE, *(CLOSE_CONTACT if each else USUAL_CONTACT for each in (aim.length, aim.width))]

    def column(values: Iterable[float]) -> Field:
        return numpy.array([math.log(v) if u.logarithm else v for u, v in zip(unknowns, values, strict=True)])

    low, high = column(each.low for each in unknowns), column(each.high for each in unknowns)
    usual = numpy.clip(
        column(max(getattr(inflation, each.key), each.low) for each in unknowns), low + 1e-3, high - 1e-3
    )
    step, weakly = (numpy.array([getattr(each, name) for each in unknowns]) for name in ("step", "weakly"))

    def tire(unknown: Field) -> Inflation:
        values = {u.key: float(math.exp(v) if u.logarithm else v) for u, v in zip(unknowns, unknown, strict=True)}
        return inflation.model_copy(update=values)

    def missed(unknown: Field) -> Field:
        """Stiffness, deflection, length and width, then the unknowns, in standard deviations."""
        try:
            found = standing_on_belt(tire(unknown), aim.load)
        except FieldError:
            return numpy.full(len(wanted) + len(unknowns), FAR)
        have = numpy.array([found.stiffness, found.deflection, found.length or TINY, found.width or TINY])
        return numpy.array([*(numpy.log(have / wanted) / closeness), *((unknown - usual) / weakly)])

    solution = least_squares(
        missed, usual, "2-point", (low, high), ftol=1e-4, xtol=1e-4, x_scale=6.0 * step, diff_step=step / abs(usual)
    )
    return tire(solution.x)


def angles(inflation: Inflation) -> tuple[float, float]:
    """Sidewall angles [rad] of the fit: those of a scene at which the belt carries a part of the inflation."""
    size = read_size(inflation.size, inflation.radius)
    low, high = allowed("sidewall_angle")
    return max(low, math.atan(size.sidewall_chord / size.belt_width) + 0.02), high


def allowed(key: str) -> tuple[float, float]:
    """Range of a number of `effects.tire.inflation` in a scene."""
    entry = catalog()["effects", "tire", "inflation", key]
    return given(entry.low), given(entry.high)


def standing_on_belt(inflation: Inflation, load: float) -> StandingTire:
    """The inflated tire of a scene's section under a `load` [N], as `standing_of_body`."""
    size = read_size(inflation.size, inflation.radius)
    chord, width = inflation.sidewall_chord or size.sidewall_chord, inflation.belt_width or size.belt_width
    body = tire_body({"inflation": {**inflation.model_dump(), "sidewall_chord": chord, "belt_width": width}})
    return standing_of_body(body, load)


def standing_of_body(body: TireBody, load: float) -> StandingTire:
    """A tire whose contact has an extent, as the inflated one, under a `load` [N] on a level road, on the cells of its
    force table.

    Stiffness: of the loads 2 % below and above. The contact's edge lies between two cells, where the
    square of the pressure, straight near an edge, comes to zero. Raises FieldError where the load
    is more than the tire carries.
    """
    assert body.extent is not None
    cell_x, cell_y = body.extent[0] / ROWS, body.extent[1] / COLS
    rows, cols = ROWS + ROWS // 2, COLS + COLS // 2
    x, y = (numpy.arange(rows) - rows // 2) * cell_x, (numpy.arange(cols) - 0.5 * (cols - 1)) * cell_y
    gap = gap_over_level_road(body.form, x, y)
    settings = FieldSettings(rows, cols, cell_x, cell_y, body.modulus, TOLERANCE, ITERATIONS, 0, body.belt)
    field = PressureField(settings, "tire")
    below, above, there = (field.solve_load(gap, load * step) for step in (1.0 - LOAD_STEP, 1.0 + LOAD_STEP, 1.0))
    length, across = cell_x * _longest(field.pressure), cell_y * _longest(field.pressure.T)
    return StandingTire(load, 2.0 * LOAD_STEP * load / (above - below), there, length, across)


def _longest(pressure: Field) -> float:
    """Extent of the contact along the first axis, in cells."""
    longest = 0.0
    for line in pressure.T:
        loaded = numpy.flatnonzero(line)
        if len(loaded) < 2:
            continue
        first, last = loaded[0], loaded[-1]
        edges = _beyond(line[first], line[first + 1]) + _beyond(line[last], line[last - 1])
        longest = max(longest, last - first + edges)
    return float(longest)


def _beyond(outer: float, inner: float) -> float:
    """Cells from the middle of the outermost loaded cell to the edge."""
    return 1.0 if inner <= math.sqrt(2.0) * outer else outer**2 / (inner**2 - outer**2)
