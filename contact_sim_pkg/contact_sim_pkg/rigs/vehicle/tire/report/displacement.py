"""Displacement of the surface under a recorded pressure field."""

from __future__ import annotations

import numpy as np

from contact_sim_pkg.pressure.field.halfspace import displacement, make_buffers, make_half_space
from contact_sim_pkg.pressure.settings import BeltSettings
from contact_sim_pkg.report.series import FloatArray, PressureMap
from contact_sim_pkg.rigs.vehicle.tire.envelopment import belt_influence


def surface_displacement(field: PressureMap, modulus: float, belt: BeltSettings | None = None) -> FloatArray:
    """Displacement u(x, y) [m] = 1/(pi E*) integral of p / distance on the cells of the field,
    [rows, cols].

    Positive into the body. With a ``belt`` its deflection is added.

    Args:
        field: its pressure is all that acts.
        modulus: contact modulus E* [Pa] of the half-space.

    Raises:
        ValueError: cells or modulus are not positive and finite.
    """
    rows, cols = field.pressure.shape
    size = (rows, cols, field.cell_x, field.cell_y)
    half_space = make_half_space(*size, modulus, None if belt is None else belt_influence(belt, *size))
    result = np.zeros((rows, cols))
    displacement(half_space, make_buffers(half_space), np.ascontiguousarray(field.pressure), result)
    return result
