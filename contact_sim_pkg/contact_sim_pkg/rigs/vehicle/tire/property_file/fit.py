"""Sidewall angle and tread modulus of an inflated tire fitted to stiffness and contact of a property
file.

Both enter stiffness and contact: inflation carries most of the load, so a contact 1 % shorter takes
a modulus 6 % higher, and a stiffness 1 % higher an angle 0.06 rad smaller. The fit puts stiffness
before contact; what the tire cannot be is left as a difference.
"""

from __future__ import annotations

import math

import numpy
from numpy.typing import NDArray
from scipy.optimize import least_squares

from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.rigs.vehicle.contact_field import FieldError, PressureField
from contact_sim_pkg.rigs.vehicle.tire.body import tire_body
from contact_sim_pkg.rigs.vehicle.tire.force_table import COLS, ITERATIONS, ROWS, TOLERANCE, gap_over_level_road
from contact_sim_pkg.rigs.vehicle.tire.property_file.magic_formula import StandingTire
from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation
from contact_sim_pkg.rigs.vehicle.tire.size import read_size
from contact_sim_pkg.scene.schema.catalog import catalog
from contact_sim_pkg.scene.schema.fields import given

__all__ = ["allowed", "angles", "fitted", "standing_on_belt"]

Field = NDArray[numpy.float64]
LOAD_STEP = 0.02  # of the load, either way, for the stiffness
CLOSENESS = numpy.array([5e-3, 0.05, 0.05])
"""Relative standard deviations of the fit: stiffness, length and width of the contact."""
WEAKLY = 1.0
"""Standard deviation of the angle [rad] and of the logarithm of the modulus about their usual
values, which decide where the file has no contact.
"""
MODULI = (5e5, 5e7)  # [Pa] of the fit
STEPS = numpy.array([0.03, 0.05])
"""Of angle [rad] and logarithm of the modulus for a derivative: the contact's edge moves by a part
of a cell.
"""
USUAL = Inflation()
FAR = 1e3  # residual of a tire that cannot be solved


def fitted(inflation: Inflation, aim: StandingTire) -> Inflation:
    """The tire whose stiffness, and contact where the file has one, are nearest to `aim`.

    Only angle and modulus change. Raises FieldError where no such tire carries the load.
    """
    usual = numpy.array([USUAL.sidewall_angle, math.log(USUAL.tread_modulus)])
    low, high = (numpy.array([angle, math.log(each)]) for angle, each in zip(angles(inflation), MODULI, strict=True))

    def missed(unknown: Field) -> Field:
        """Stiffness, length and width, then angle and modulus, in standard deviations."""
        try:
            found = standing_on_belt(_with(inflation, unknown), aim.load)
        except FieldError:
            return numpy.full(5, FAR)
        pairs = zip((found.stiffness, found.length, found.width), (aim.stiffness, aim.length, aim.width), strict=True)
        relative = [0.0 if not (have and wanted) else math.log(have / wanted) for have, wanted in pairs]
        return numpy.array([*(numpy.array(relative) / CLOSENESS), *((unknown - usual) / WEAKLY)])

    solution = least_squares(
        missed, usual, "3-point", (low, high), ftol=1e-4, xtol=1e-5, x_scale=(0.1, 0.3), diff_step=STEPS / usual
    )
    return _with(inflation, solution.x)


def angles(inflation: Inflation) -> tuple[float, float]:
    """Sidewall angles [rad] of the fit: those of a scene at which the belt carries a part of the inflation."""
    size = read_size(inflation.size)
    low, high = allowed("sidewall_angle")
    return max(low, math.atan(size.sidewall_chord / size.belt_width) + 0.02), high


def allowed(key: str) -> tuple[float, float]:
    """Range of a number of `effects.tire.inflation` in a scene."""
    entry = catalog()["effects", "tire", "inflation", key]
    return given(entry.low), given(entry.high)


def _with(inflation: Inflation, unknown: Field) -> Inflation:
    angle, modulus = float(unknown[0]), math.exp(unknown[1])
    return inflation.model_copy(update={"sidewall_angle": angle, "tread_modulus": modulus})


def standing_on_belt(inflation: Inflation, load: float) -> StandingTire:
    """The inflated tire under a `load` [N] on a level road, on the cells of its force table.

    Stiffness: of the loads 2 % below and above. The contact's edge lies between two cells, where the
    square of the pressure, straight near an edge, comes to zero. Raises FieldError where the load
    is more than the tire carries.
    """
    size = read_size(inflation.size)
    chord, width = inflation.sidewall_chord or size.sidewall_chord, inflation.belt_width or size.belt_width
    body = tire_body({"inflation": {**inflation.model_dump(), "sidewall_chord": chord, "belt_width": width}})
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
