"""Stress below the surface under a recorded pressure field, in the plane along the rolling
direction.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from contact_sim_pkg.pressure.closed_form.subsurface import SurfaceGrid, max_shear, subsurface_stress, von_mises
from contact_sim_pkg.pressure.field.patch import summarise
from contact_sim_pkg.report.series import FloatArray, PressureMap

COLUMNS, DEPTHS = 81, 49
"""Points of the plane along x and z."""
REACH = 1.5
"""Half length of the plane over that of the loaded cells."""
MOST_TERMS = 2e7
"""Points times cells: 2 s of work. A larger field is averaged over 2 x 2 cells, as often as it
takes.
"""


class StressPlane(NamedTuple):
    """Equivalent stresses in the plane y = centre of pressure, z into the body; no friction."""

    x: FloatArray
    """[m] [COLUMNS]"""
    z: FloatArray
    """[m] [DEPTHS] depth, closer together near the surface, not at it"""
    y: float
    """[m] where the plane lies"""
    von_mises: FloatArray
    """[Pa] [DEPTHS, COLUMNS]"""
    max_shear: FloatArray
    """[Pa] [DEPTHS, COLUMNS] half of the largest less the smallest principal stress"""
    normal: FloatArray
    """[Pa] [DEPTHS, COLUMNS] stress along z, negative in compression"""


def stress_plane(field: PressureMap, poisson_ratio: float) -> StressPlane | None:
    """Stresses [Pa] under a pressure field, [depths, columns]; None for a field without load.

    The plane is `REACH` times as long as the loaded cells, and as deep as the loaded cells are long
    or wide, whichever is less. Its first row lies one cell deep: above, the steps between the cells
    are seen rather than the field.

    Args:
        poisson_ratio: of the body, dimensionless.

    Raises:
        ValueError: Poisson's ratio is not within -1 (excluded) and 0.5.
    """
    field = _coarse_enough(field)
    rows, cols = (np.flatnonzero(field.pressure.any(axis=axis)) for axis in (1, 0))
    if not rows.size:
        return None
    centre = summarise(field.pressure, field.cell_x, field.cell_y, field.origin_x, field.origin_y)
    # Extent of the loaded cells.
    half_x = 0.5 * (rows[-1] - rows[0] + 1) * field.cell_x
    half_y = 0.5 * (cols[-1] - cols[0] + 1) * field.cell_y
    middle = field.origin_x + 0.5 * (rows[0] + rows[-1]) * field.cell_x
    first, depth = min(field.cell_x, field.cell_y), 2.0 * min(half_x, half_y)
    # Depths are denser near the surface, where stresses change fastest.
    x = middle + np.linspace(-REACH, REACH, COLUMNS) * half_x
    z = first + (depth - first) * np.linspace(0.0, 1.0, DEPTHS) ** 2
    along, down = np.meshgrid(x, z)
    points = np.column_stack([along.ravel(), np.full(along.size, centre.centre_y), down.ravel()])
    grid = SurfaceGrid(field.cell_x, field.cell_y, field.origin_x, field.origin_y)
    stress = subsurface_stress(grid, poisson_ratio, points, field.pressure)
    mises, shear, normal = (
        values.reshape(along.shape) for values in (von_mises(stress), max_shear(stress), stress[:, 2])
    )
    return StressPlane(x, z, float(centre.centre_y), mises, shear, normal)


def _coarse_enough(field: PressureMap) -> PressureMap:
    while np.count_nonzero(field.pressure) * COLUMNS * DEPTHS > MOST_TERMS:
        rows, cols = field.pressure.shape
        even = np.pad(field.pressure, ((0, rows % 2), (0, cols % 2)))
        mean = even.reshape(even.shape[0] // 2, 2, even.shape[1] // 2, 2).mean(axis=(1, 3))
        field = PressureMap(
            mean, 2.0 * field.cell_x, 2.0 * field.cell_y,
            field.origin_x + 0.5 * field.cell_x, field.origin_y + 0.5 * field.cell_y,
        )  # fmt: skip
    return field
