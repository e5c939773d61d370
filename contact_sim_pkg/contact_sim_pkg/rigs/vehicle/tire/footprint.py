"""The height that a smooth tire sees: the road averaged with the weights of the footprint.

In contact ``K p = d - g + h``, with the approach d and a small roughness h(x, y). Both raise the
load in the same way, ``dF = sum K^-1 1 (dd + dh)`` over the cells in contact, so at a constant load
the height changes by ``sum w h``, ``w = dp/dF``: exact to first order in h. These are not the
pressures p themselves, with which a roughness changes the elastic energy. A tire takes more load by
a longer footprint, so the weights lie at its ends: the two-point follower of Pacejka, Tire and
Vehicle Dynamics, 4.2.

Instead of the derivative the difference of two footprints is taken, at approaches `RANGE` more and
less than the standing one: a road moves the ends of the footprint as far as that. They come from
the table of an inflated tire, or from Hertz. The height drives the point contact everywhere, and
between two field instants it determines how the effective height changes with the travel; at the
instants the pressure field itself decides.
"""

from __future__ import annotations

import math

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.held import Held
from contact_sim_pkg.compiled.jit import borrowing_kernel, entry, kernel
from contact_sim_pkg.pressure.field.outside import total_of_row
from contact_sim_pkg.pressure.field.window import Part
from contact_sim_pkg.rigs.vehicle.tire.body import TireForm

Heights = NDArray[numpy.float32]
Pressures = NDArray[numpy.float64]

RANGE = 0.2
"""Of the standing approach: footprints at so much more and less make the weights."""


def hertz_weights(semi_axis_x: float, semi_axis_y: float, cell_x: float, cell_y: float, cols: int) -> Pressures:
    """Weights of a Hertz contact on the nodes of a road around its middle, [odd rows, cols], of sum 1:
    differences of ``sqrt(d (d/d0 - (x/a)^2 - (y/b)^2))`` between two approaches d.

    semi_axis_x, semi_axis_y: a, b of the footprint [m] at the approach d0; cell_x, cell_y: spacing of
    the nodes [m].
    """
    reach = int(math.sqrt(1.0 + RANGE) * semi_axis_x / cell_x) + 1
    u = (numpy.arange(2 * reach + 1) - reach) * cell_x / semi_axis_x
    v = (numpy.arange(cols) - 0.5 * (cols - 1)) * cell_y / semi_axis_y
    place = u[:, None] ** 2 + v[None, :] ** 2
    more, less = (numpy.sqrt(numpy.maximum(0.0, ratio - place)) for ratio in (1.0 + RANGE, 1.0 - RANGE))
    return numpy.asarray((more - less) / (more - less).sum())


@entry
def effective_heights(
    height: Heights, first_row: int, cell_x: float, weights: Pressures, travel: Vector, out: Vector, slopes: Vector
) -> bool:
    """Weighted mean height in [m] for each wheel position ``travel`` [m], written into ``out``, and
    its slope along the travel [1], into ``slopes``.

    ``height`` [rows, cols] in [m] on the road lattice (node (i, j) at x = (first_row + i) cell_x, y
    = (j - (cols-1)/2) cell_y); ``weights`` [odd rows, cols] of sum 1, the wheel over the middle. The
    mean is taken with the wheel over a node and laid as a cubic with continuous slope (Catmull-Rom)
    between the nodes: there the steep edge of the weights would cross the nodes one by one, and each
    would show as a jerk. Returns False where the lattice does not hold the footprint.
    """
    reach = weights.shape[0] // 2
    sides = _weighted_columns(weights)
    # At the node before the one behind the wheel, at that, and at the two ahead
    means, line = numpy.zeros(4), numpy.zeros(height.shape[1])
    place, known = 0, False
    for k in range(travel.shape[0]):
        node = int(math.floor(travel[k] / cell_x))  # noqa: RUF046  # a float in compiled code
        if node - reach < first_row or node + 1 + reach >= first_row + height.shape[0]:
            return False
        if not (known and node == place):
            kept = 3 if known and node == place + 1 else 0
            for i in range(kept):
                means[i] = means[i + 1]
            for i in range(kept, 4):
                first = min(max(node - 1 + i - reach - first_row, 0), height.shape[0] - weights.shape[0])
                means[i] = _mean(height, weights, sides, first, line)
            place, known = node, True
        out[k], slope = _cubic(means, travel[k] / cell_x - node)
        slopes[k] = slope / cell_x
    return True


@kernel
def _cubic(means: Vector, part: float) -> tuple[float, float]:
    """Between the second and the third of four equal steps, with the slopes of their neighbours:
    height, and slope a step.
    """
    slope, slope_end = 0.5 * (means[2] - means[0]), 0.5 * (means[3] - means[1])
    rise = means[2] - means[1]
    square, cube = 3.0 * rise - 2.0 * slope - slope_end, slope + slope_end - 2.0 * rise
    place = means[1] + part * (slope + part * (square + part * cube))
    return place, slope + part * (2.0 * square + part * 3.0 * cube)


@borrowing_kernel
def _weighted_columns(weights: Pressures) -> tuple[int, int]:
    """First and end column with a weight other than 0: a road is wider than the footprint."""
    first, end = weights.shape[1], 0
    for i in range(weights.shape[0]):
        for j in range(weights.shape[1]):
            if weights[i, j] != 0.0:
                first, end = min(first, j), max(end, j + 1)
    return first, end


@borrowing_kernel
def _mean(height: Heights, weights: Pressures, sides: tuple[int, int], first: int, line: Vector) -> float:
    """Mean [m] of the rows from ``first`` on, over the columns between ``sides``; ``line`` [cols] is
    scratch.
    """
    left, right = sides
    for j in range(right - left):
        line[j] = 0.0
    # Sums of columns first: those run along memory
    for i in range(weights.shape[0]):
        row, under = weights[i, left:right], height[first + i, left:right]
        for j in range(len(row)):
            line[j] += row[j] * under[j]
    total = 0.0
    for j in range(right - left):
        total += line[j]
    return total


@entry
def tire_gap(
    height: Heights,
    first_row: int,
    cell_x: float,
    cell_y: float,
    form: TireForm,
    first: int,
    travel: float,
    times: int,
    out: Vector,
) -> bool:
    """Undeformed gap in [m] of the tire whose lowest point stands at height 0 over the road,
    written into ``out`` [rows, cols], on every node, or on every second one where ``times`` is 2, and so on.

    Height of the ``form`` minus that of the road; row 0 of ``out`` is lattice row ``first``, x
    counts from ``travel`` [m]. Cells coincide with road nodes, so no height is interpolated; the
    road may be wider than ``out`` by an even number of columns. Returns False where the lattice
    does not hold the grid.
    """
    rows, cols, last = out.shape[0], times * out.shape[1], first + times * out.shape[0]
    if first < first_row or last > first_row + height.shape[0] or cols > height.shape[1]:
        return False
    # The middle columns of road and grid are the same.
    margin = (height.shape[1] - cols) // 2
    middle, across = 0.5 * (cols - 1), numpy.empty(out.shape[1])
    for j in range(len(across)):
        across[j] = height_across(form, (times * j - middle) * cell_y)
    for i in range(rows):
        along = height_along(form, (first + times * i) * cell_x - travel)
        row, road = out[i], height[first + times * i - first_row, margin : margin + cols : times]
        for j in range(len(across)):
            row[j] = along + across[j] - road[j]
    return True


@kernel
def height_along(form: TireForm, x: float) -> float:
    """Height of the tire in [m] over the road, or the drum, at ``x`` [m] before its lowest point; that of its centre
    beyond its radius.
    """
    radius = form.radius_rolling
    height = radius - math.sqrt(max(radius * radius - x * x, 0.0)) if form.circular else 0.5 * x * x / radius
    if form.drum > 0.0:
        height += x * x * form.drum / (1.0 + math.sqrt(max(1.0 - (form.drum * x) ** 2, 0.0)))
    return height


@kernel
def slope_along(form: TireForm, x: float) -> float:
    """Slope dz/dx [1] of that height at ``x`` [m] before the lowest point."""
    radius = form.radius_rolling
    slope = x / math.sqrt(max(radius * radius - x * x, 1e-6 * radius * radius)) if form.circular else x / radius
    if form.drum > 0.0:
        slope += form.drum * x / math.sqrt(max(1.0 - (form.drum * x) ** 2, 1e-6))
    return slope


@entry
def mean_slope(form: TireForm, pressure: Pressures, origin: float, cell_x: float) -> float:
    """Mean slope [1] of the tire under a ``pressure`` [rows, cols] [Pa], which is its weight; 0 without
    one. Row 0 lies ``origin`` [m] before the lowest point.
    """
    total, climb = 0.0, 0.0
    for i in range(pressure.shape[0]):
        line = total_of_row(pressure[i])
        total += line
        climb += line * slope_along(form, origin + i * cell_x)
    return climb / total if total > 0.0 else 0.0


@entry
def level_under(height: Heights, first: int, margin: int, pressure: Pressures) -> float:
    """Height [m] of the road under all loaded cells and beside them, where it is the same; else NaN.

    ``pressure`` [rows, cols] lies on the nodes of ``height`` from row ``first`` and column ``margin`` on.
    Nodes beside count: at an edge the contact would go on where the road does not.
    """
    rows, cols = pressure.shape
    # Two cells in the middle of the contact decide on most roads.
    i, j = rows // 2, cols // 2
    rises = height[first + i, margin + j] != height[first + i + 1, margin + j]
    if rises and pressure[i, j] > 0.0 and pressure[i + 1, j] > 0.0:
        return math.nan
    top, bottom, left, right = rows, -1, cols, -1
    for i in range(rows):
        for j in range(cols):
            if pressure[i, j] > 0.0:
                top, bottom, left, right = min(top, i), i, min(left, j), max(right, j)
    if bottom < 0:
        return math.nan
    top, left = max(first + top - 1, 0), max(margin + left - 1, 0)
    for i in range(top, min(first + bottom + 2, height.shape[0])):
        for j in range(left, min(margin + right + 2, height.shape[1])):
            if height[i, j] != height[top, left]:
                return math.nan
    return float(height[top, left])


@kernel
def height_across(form: TireForm, y: float) -> float:
    """Height of the tire in [m] at ``y`` [m] beside its lowest point."""
    crown = 0.5 * y * y / form.radius_lateral
    if form.shoulder > 0.0:
        return crown + form.shoulder * (y / form.half_width) ** 6
    return crown


@entry
def touches_beyond(
    height: Heights, first_row: int, form: TireForm, first: int, travel: float, approach: float, modulus: float,
    cell_x: float, cell_y: float, pressure: Pressures, rows: int, cols: int,
) -> bool:  # fmt: skip
    """Whether the road touches the tire outside the grid of ``pressure`` [Pa], on a larger one of
    ``rows`` x ``cols`` cells.

    A cell outside touches where its gap (``tire_gap``) is less than ``approach`` [m] minus the
    displacement ``sum(p cell_x cell_y / (pi E* r))`` that the pressure causes there; ``modulus`` is
    E* [Pa]. The larger grid has the same cells and the same middle; its row 0 is lattice row
    ``first``. Cells that the lattice does not hold are taken not to touch. A belt yields further
    and leaves more room, so with one this may say that a cell touches which does not.
    """
    own_rows, own_cols = pressure.shape
    top, left = rows // 2 - own_rows // 2, (cols - own_cols) // 2
    margin = (height.shape[1] - cols) // 2
    middle = 0.5 * (cols - 1)
    # Rows and columns of the larger grid that the lattice holds.
    for i in range(max(0, first_row - first), min(rows, first_row + height.shape[0] - first)):
        x = (first + i) * cell_x - travel
        free = approach - height_along(form, x)
        row, start, end = first + i - first_row, max(0, -margin), min(cols, height.shape[1] - margin)
        # Beside the grid, or all across where it has ended.
        left_end, right_start = (left, left + own_cols) if top <= i < top + own_rows else (end, end)
        for first_col, end_col in ((start, min(left_end, end)), (max(right_start, start), end)):
            for j in range(first_col, end_col):
                # Few nodes of the road stand above the lowest line of the tire there.
                if free + height[row, margin + j] <= 0.0:
                    continue
                depth = free - height_across(form, (j - middle) * cell_y) + height[row, margin + j]
                if depth > 0.0 and depth > _sunk(pressure, i - top, j - left, modulus, cell_x, cell_y):
                    return True
    return False


@kernel
def _sunk(pressure: Pressures, row: int, col: int, modulus: float, cell_x: float, cell_y: float) -> float:
    """Displacement in [m] at a cell outside the loaded ones, from point forces at their centres."""
    total = 0.0
    for i in range(pressure.shape[0]):
        for j in range(pressure.shape[1]):
            if pressure[i, j] > 0.0:
                total += pressure[i, j] / math.hypot((row - i) * cell_x, (col - j) * cell_y)
    return total * cell_x * cell_y / (math.pi * modulus)


@entry
def clear_beyond(
    whole: Held[Part], opened: Vector, height: Heights, first_row: int, form: TireForm, first: int, travel: float,
    approach: float, pressure: Pressures, rows: int,
) -> bool:  # fmt: skip
    """Whether a bound says that the road does not touch the tire outside the grid of ``pressure`` [Pa]:
    on the columns of the ``whole`` grid, whose rows the lattice must hold, and on ``rows`` rows.

    A row of cells of the ``whole`` grid is ``opened`` [m] by softening sidewalls. It is displaced by the
    belt, and by each line of the pressure as if all of it lay as far across as a cell can. The rest as in `touches_beyond`.
    """
    half_space, own_rows, own_cols = whole.value.half_space, pressure.shape[0], pressure.shape[1]
    cols, reach = half_space.cols, rows // 2 - half_space.rows // 2
    top, margin, middle = rows // 2 - own_rows // 2, (height.shape[1] - cols) // 2, 0.5 * (cols - 1)
    last_row = first_row + height.shape[0]
    if first + reach < first_row or first + reach + half_space.rows > last_row or margin < 0:
        return False
    lines, left = numpy.empty(own_rows), (cols - own_cols) // 2
    for k in range(own_rows):
        lines[k] = total_of_row(pressure[k])
    across, beside = numpy.empty(cols), numpy.empty(cols)
    for j in range(cols):
        across[j] = height_across(form, (j - middle) * half_space.cell_y)
        beside[j] = numpy.inf if left <= j < left + own_cols else across[j]
    for i in range(max(0, first_row - first), min(rows, last_row - first)):
        free, row = approach - height_along(form, (first + i) * half_space.cell_x - travel), i - top
        if 0 <= i - reach < half_space.rows:
            free -= opened[i - reach]
        road, crown = height[first + i - first_row, margin : margin + cols], beside if 0 <= row < own_rows else across
        if not _any_deeper(road, crown, free):
            continue
        if max(row, own_rows - 1 - row) >= half_space.rows:
            return False
        # Most of what is below lies above the belt
        belt = _displaced(lines, half_space.along, row)
        if not _any_deeper(road, crown, free - belt):
            continue
        depth, far = _deepest(road, crown, free - belt, (left, left + own_cols - 1))
        if depth + belt > _displaced(lines, half_space.influence[:, far], row):
            return False
    return True


@borrowing_kernel
def _any_deeper(road: Heights, crown: Vector, free: float) -> bool:
    """Whether any of a row of cells [cols] is below the road, ``free`` [m] nearer than its ``crown`` [m]."""
    below = 0
    for j in range(len(road)):
        below += 1 if free - crown[j] + road[j] > 0.0 else 0
    return below > 0


@borrowing_kernel
def _deepest(road: Heights, crown: Vector, free: float, loaded: tuple[int, int]) -> tuple[float, int]:
    """Largest depth [m] of such a row, 0 at least, and columns from the outermost cell below the road to
    the farthest of the ``loaded`` ones, first and last.
    """
    deepest, far = 0.0, 0
    for j in range(len(road)):
        depth = free - crown[j] + road[j]
        if depth > 0.0:
            deepest, far = max(deepest, depth), max(far, j - loaded[0], loaded[1] - j)
    return deepest, far


@borrowing_kernel
def _displaced(lines: Vector, influence: Vector, row: int) -> float:
    """Displacement [m] of a row of cells by sums across [Pa] of rows from 0 on."""
    even, odd, whole = 0.0, 0.0, len(lines) - len(lines) % 2
    for k in range(0, whole, 2):
        even += lines[k] * influence[abs(row - k)]
        odd += lines[k + 1] * influence[abs(row - k - 1)]
    for k in range(whole, len(lines)):
        even += lines[k] * influence[abs(row - k)]
    return even + odd
