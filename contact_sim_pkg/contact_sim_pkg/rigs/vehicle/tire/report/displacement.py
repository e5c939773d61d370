"""Displacement of the surface under a recorded pressure field."""

from __future__ import annotations

import numpy as np

from contact_sim_pkg.pressure.field.halfspace import displacement, make_buffers, make_half_space
from contact_sim_pkg.report.series import FloatArray, PressureMap
from contact_sim_pkg.rigs.vehicle.field.envelopment import yielding_of
from contact_sim_pkg.rigs.vehicle.tire.body import TireBody


def surface_displacement(field: PressureMap, body: TireBody) -> FloatArray:
    """Displacement u(x, y) [m] of a tire's surface on the cells of the field, [rows, cols], positive
    into the tire: ``1/(pi E*) integral of p / distance`` of its tread, and its belt's deflection.

    field: its pressure is all that acts. Raises ValueError where cells or modulus are not positive
    and finite.
    """
    rows, cols = field.pressure.shape
    size = (rows, cols, field.cell_x, field.cell_y)
    half_space = make_half_space(*size, body.modulus, yielding_of(body.belt, *size))
    result = np.zeros((rows, cols))
    displacement(half_space, make_buffers(half_space), np.ascontiguousarray(field.pressure), result)
    return result
