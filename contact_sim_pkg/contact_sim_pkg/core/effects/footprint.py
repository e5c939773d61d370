"""The height that a smooth tire sees: the road averaged with the pressure of the footprint.

By the reciprocal theorem (Betti) a small roughness h(x, y) under a contact of fixed pressure p changes the approach by
``integral(p h) / integral(p)``: exact to first order in h. The weights are the Hertz pressure ``sqrt(1 - (x/a)^2 - (y/b)^2)`` of
the standing load. It drives the point contact everywhere, and between two field instants it tells how the effective
height changes with the travel; at the instants the pressure field itself decides.
"""

from __future__ import annotations

import math

import numpy
from numpy.typing import NDArray

from ..jit import entry
from ..parameters import Vector

Heights = NDArray[numpy.float32]


@entry
def effective_heights(
    height: Heights, first_row: int, cell_x: float, cell_y: float, semi_axis_x: float, semi_axis_y: float,
    travel: Vector, out: Vector,
) -> bool:  # fmt: skip
    """Weighted mean height in [m] for each wheel position ``travel`` [m], written into ``out``.

    ``height`` [rows, cols] in [m] on the road lattice (node (i, j) at x = (first_row + i) cell_x, y = (j - (cols-1)/2) cell_y);
    ``semi_axis_x``, ``semi_axis_y`` [m] of the footprint. Returns False where the lattice does not hold the footprint.
    """
    rows, cols = height.shape
    middle = 0.5 * (cols - 1)
    reach = int(semi_axis_x / cell_x) + 1
    for k in range(travel.shape[0]):
        centre = int(round(travel[k] / cell_x))  # noqa: RUF046  # a float in compiled code
        if centre - reach < first_row or centre + reach >= first_row + rows:
            return False
        total = 0.0
        weight_sum = 0.0
        for i in range(centre - reach, centre + reach + 1):
            u = (i * cell_x - travel[k]) / semi_axis_x
            left = 1.0 - u * u
            if left <= 0.0:
                continue
            for j in range(cols):
                v = (j - middle) * cell_y / semi_axis_y
                inside = left - v * v
                if inside > 0.0:
                    weight = math.sqrt(inside)
                    weight_sum += weight
                    total += weight * height[i - first_row, j]
        out[k] = total / weight_sum
    return True


@entry
def tire_gap(
    height: Heights, first_row: int, cell_x: float, cell_y: float, radius_rolling: float, radius_lateral: float,
    first: int, travel: float, out: Vector,
) -> bool:  # fmt: skip
    """Undeformed gap in [m] of the tire whose lowest point stands at height 0 over the road, written into ``out`` [rows, cols].

    ``g = x^2/(2 R_rolling) + y^2/(2 R_lateral) - h``; row 0 of ``out`` is lattice row ``first``, x counts from ``travel`` [m].
    Cells coincide with road nodes, so no height is interpolated; the road may be wider than ``out`` by an even number of
    columns. Returns False where the lattice does not hold the grid.
    """
    rows, cols = out.shape
    if first < first_row or first + rows > first_row + height.shape[0] or cols > height.shape[1]:
        return False
    margin = (height.shape[1] - cols) // 2
    middle = 0.5 * (cols - 1)
    for i in range(rows):
        x = (first + i) * cell_x - travel
        crown = 0.5 * x * x / radius_rolling
        for j in range(cols):
            y = (j - middle) * cell_y
            out[i, j] = crown + 0.5 * y * y / radius_lateral - height[first + i - first_row, margin + j]
    return True


@entry
def effective_between(smooth: Vector, offset: float, offset_end: float, out: Vector) -> None:
    """Effective height of the road in [m] from one field to the next, written into ``out``: ``smooth`` [m] and an offset [m].

    The offset goes straight to its end. At an edge the smooth height falls in a curve where the offset rises straight, and their
    sum would stand out far above the heights at both ends. So it keeps between them, but for what the smooth height itself
    stands out over its own ends.
    """
    last = smooth.shape[0] - 1
    highest, lowest = max(smooth[0], smooth[last]), min(smooth[0], smooth[last])
    over, under = 0.0, 0.0
    for i in range(1, last):
        over = max(over, smooth[i] - highest)
        under = max(under, lowest - smooth[i])
    start, end = smooth[0] + offset, smooth[last] + offset_end
    low, high = min(start, end) - under, max(start, end) + over
    for i in range(last + 1):
        out[i] = min(max(smooth[i] + offset + (offset_end - offset) * (i / last), low), high)
