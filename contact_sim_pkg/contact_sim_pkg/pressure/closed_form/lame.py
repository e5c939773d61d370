"""Lame curves (superellipses) `|x/a|^n + |y/b|^n = 1`: area, second moments, and the fit to a
contact patch.

n = 2 is the ellipse, n = 1 the rhombus, n -> infinity the rectangle. The radial variable
`rho = (|x/a|^n + |y/b|^n)^(1/n)` is computed through logarithms, so no power under- or overflows.

Source: Driver and Seat eqs 4 and 5; Tire/Road Contact eqs 5 and 6.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import borrowing_kernel, entry, kernel
from contact_sim_pkg.pressure.closed_form import FIT_EXPONENTS

__all__ = [
    "LameFit",
    "fit_boundary",
    "fit_centred",
    "fit_patch",
    "lame_area",
    "lame_moment",
    "refuse_axes",
    "refuse_exponent",
]

Field = NDArray[numpy.float64]
Places = NDArray[numpy.int64]

SMALLEST_EXPONENT = 0.1
"""Below it the curve is a cross of four needles."""

LARGEST_POWER = 100.0
LARGEST_LOGARITHM = 600.0

FEWEST_CELLS = 8
"""A patch of fewer cells says nothing about its exponent."""

FIT_STEPS = 20
SMALLEST_STEP = 1e-4
"""Sum of the changes of ln a, ln b and ln n after which the fit has converged."""

_TINY = 1e-300


class LameFit(NamedTuple):
    a: float  # [m] along x
    b: float  # [m] along y
    exponent: float  # [1] n; 2 when not fitted
    centre_x: float  # [m] mean of the boundary points
    centre_y: float  # [m]
    deviation: float  # [1] root mean square of rho - 1 over the boundary
    fitted: bool  # False: fewer than 8 cells; half extents and n = 2


def lame_area(a: float, b: float, exponent: float) -> float:
    """`4 a b Gamma(1 + 1/n)^2 / Gamma(1 + 2/n)` [m^2]; raises `ValueError` for n < 0.1 and axes
    outside 1e-100 to 1e100 m.
    """
    refuse_axes(a, b)
    refuse_exponent(exponent)
    return 4.0 * a * b * math.exp(2.0 * math.lgamma(1.0 + 1.0 / exponent) - math.lgamma(1.0 + 2.0 / exponent))


def lame_moment(a: float, b: float, exponent: float, power_x: float, power_y: float) -> float:
    """Integral of `|x|^i |y|^j` over the domain, powers i, j above -1, to 100 (Dirichlet's
    integral); i = j = 0 is the area.

    `4 a^(i+1) b^(j+1) / ((i+1) (j+1)) Gamma(u+1) Gamma(v+1) / Gamma(u+v+1)`, u = (i+1)/n, v =
    (j+1)/n [m^(i+j+2)].

    a, b: half axes [m]; exponent n, powers i and j: [1]. Raises `ValueError` for n < 0.1, powers
    and axes outside their range, and an integral that is no double.
    """
    refuse_axes(a, b)
    refuse_exponent(exponent)
    logarithm = math.log(4.0)
    for name, axis, power in (("i", a, power_x), ("j", b, power_y)):
        if not -1.0 < power <= LARGEST_POWER:
            raise ValueError(f"Lame curve: power {name} = {power}, it must be above -1, at most {LARGEST_POWER:g}")
        logarithm += (power + 1.0) * math.log(axis)
    if abs(logarithm) > LARGEST_LOGARITHM:
        raise ValueError(f"Lame curve: the moment is of the order exp({logarithm:.4g}), outside the range of numbers")
    # Range checked above by the logarithm; now the powers themselves
    u, v = (power_x + 1.0) / exponent, (power_y + 1.0) / exponent
    gammas = math.exp(math.lgamma(u + 1.0) + math.lgamma(v + 1.0) - math.lgamma(u + v + 1.0))
    scale = math.pow(a, power_x + 1.0) / (power_x + 1.0) * (math.pow(b, power_y + 1.0) / (power_y + 1.0))
    return 4.0 * scale * gammas


def refuse_axes(a: float, b: float) -> None:
    """Raises `ValueError` for half axes a, b [m] outside 1e-100 to 1e100 m."""
    for name, value in (("a", a), ("b", b)):
        if not 1e-100 <= value <= 1e100:
            raise ValueError(f"Lame curve: half axis {name} = {value} m, it must be a number from 1e-100 to 1e100")


def refuse_exponent(exponent: float) -> None:
    """Raises `ValueError` for an exponent n [1] below 0.1."""
    if not exponent >= SMALLEST_EXPONENT:
        raise ValueError(f"Lame curve: exponent n = {exponent}, allowed from {SMALLEST_EXPONENT}")


@entry
def fit_patch(pressure: Field, cell_x: float, cell_y: float, origin_x: float, origin_y: float) -> LameFit:
    """Lame curve through the boundary of the cells under pressure.

    pressure: float64 [rows, cols], rows along x; cell_x, cell_y [m]; origin_x, origin_y: centre of
    cell (0, 0) [m]. The boundary points are the midpoints of the outermost edges of each row and
    each column: holes inside the contact, as on texture, do not count. Zeros without contact.
    """
    rows, cols = pressure.shape
    in_rows, in_cols = numpy.empty((rows, 2), numpy.int64), numpy.empty((cols, 2), numpy.int64)
    cells = find_outermost(pressure, in_rows, in_cols)
    # No contact.
    if cells == 0:
        centre_x, centre_y = origin_x + 0.5 * (rows - 1) * cell_x, origin_y + 0.5 * (cols - 1) * cell_y
        return LameFit(0.0, 0.0, 2.0, centre_x, centre_y, 0.0, False)
    # Rectangle around the contact; too few cells have no shape.
    low_row, high_row, lines = extent_of(in_rows)
    low_col, high_col, columns = extent_of(in_cols)
    half_x = 0.5 * (high_row - low_row + 1) * cell_x
    half_y = 0.5 * (high_col - low_col + 1) * cell_y
    if cells < FEWEST_CELLS:
        centre_x = origin_x + 0.5 * (low_row + high_row) * cell_x
        centre_y = origin_y + 0.5 * (low_col + high_col) * cell_y
        return LameFit(half_x, half_y, 2.0, centre_x, centre_y, 0.0, False)
    # Curve through the boundary.
    points = 2 * (lines + columns)
    x, y = numpy.empty(points), numpy.empty(points)
    lay_points(in_rows, cell_y, cell_x, y[: 2 * lines], x[: 2 * lines])
    lay_points(in_cols, cell_x, cell_y, x[2 * lines :], y[2 * lines :])
    fit = fit_boundary(x, y, half_x, half_y)
    return LameFit(
        fit.a,
        fit.b,
        fit.exponent,
        fit.centre_x + origin_x,
        fit.centre_y + origin_y,
        fit.deviation,
        True,
    )


@entry
def fit_boundary(x: Field, y: Field, half_x: float, half_y: float) -> LameFit:
    """Minimise `sum (rho - 1)^2` over ln a, ln b, ln n for points about their mean; `x`, `y` [m]
    are overwritten.

    Damped Gauss-Newton steps from the half extents [m] and n = 2, n kept within 0.3 to 20.
    """
    return fit_centred(x, y, half_x, half_y, mean_of(x), mean_of(y))


@entry
def fit_centred(x: Field, y: Field, half_x: float, half_y: float, centre_x: float, centre_y: float) -> LameFit:
    """`fit_boundary` about a centre that is known [m]."""
    take_logarithms(x, y, centre_x, centre_y)
    # Start: the ellipse in the rectangle.
    log_a, log_b, log_n = math.log(half_x), math.log(half_y), math.log(2.0)
    normal, trial, radial = numpy.empty((3, 4)), numpy.empty((3, 4)), numpy.empty((3, x.size))
    cost = normal_equations(x, y, log_a, log_b, log_n, normal, radial)
    damping = 1e-3
    for _ in range(FIT_STEPS):
        # Levenberg-Marquardt on the logarithms.
        step_a, step_b, step_n = damped_step(normal, damping)
        trial_n = min(max(log_n + step_n, math.log(FIT_EXPONENTS[0])), math.log(FIT_EXPONENTS[1]))
        trial_cost = normal_equations(x, y, log_a + step_a, log_b + step_b, trial_n, trial, radial)
        if not trial_cost <= cost:
            damping *= 8.0
            if damping > 1e8:
                break
            continue
        moved = abs(step_a) + abs(step_b) + abs(trial_n - log_n)
        log_a, log_b, log_n, cost = log_a + step_a, log_b + step_b, trial_n, trial_cost
        normal, trial = trial, normal
        damping *= 0.2
        if moved < SMALLEST_STEP:
            break
    return LameFit(
        math.exp(log_a), math.exp(log_b), math.exp(log_n), centre_x, centre_y, math.sqrt(cost / x.size), True
    )


@kernel
def mean_of(values: Field) -> float:
    """Mean of the values [points] [m]."""
    total = 0.0
    for k in range(values.size):
        total += values[k]
    return total / values.size


@kernel
def take_logarithms(x: Field, y: Field, centre_x: float, centre_y: float) -> None:
    """Replace the coordinates by the logarithms of their distances from the centre.

    x, y: [n] [m], overwritten with ln(m).
    """
    for k in range(x.size):
        x[k] = math.log(max(abs(x[k] - centre_x), _TINY))
        y[k] = math.log(max(abs(y[k] - centre_y), _TINY))


@borrowing_kernel
def find_outermost(pressure: Field, in_rows: Places, in_cols: Places) -> int:
    """Write the first and last cell in contact of each row into ``in_rows`` [rows, 2], of each column
    into ``in_cols`` [cols, 2], (-1, -1) where there is none; returns the number of cells in contact.

    pressure: [rows, cols] [Pa].
    """
    rows, cols = pressure.shape
    cells = 0
    for j in range(cols):
        in_cols[j, 0], in_cols[j, 1] = -1, -1
    for i in range(rows):
        in_rows[i, 0], in_rows[i, 1] = -1, -1
        for j in range(cols):
            if pressure[i, j] > 0.0:
                cells += 1
                if in_rows[i, 0] < 0:
                    in_rows[i, 0] = j
                if in_cols[j, 0] < 0:
                    in_cols[j, 0] = i
                in_rows[i, 1], in_cols[j, 1] = j, i
    return cells


@borrowing_kernel
def extent_of(outermost: Places) -> tuple[int, int, int]:
    """First and last line with contact, and the number of lines with contact; outermost: [lines, 2]."""
    first, last, count = -1, -1, 0
    for k in range(outermost.shape[0]):
        if outermost[k, 0] >= 0:
            first, last, count = (k if first < 0 else first), k, count + 1
    return first, last, count


@borrowing_kernel
def lay_points(outermost: Places, cell: float, spacing: float, along: Field, across: Field) -> None:
    """Midpoints [m] of the outer edges of each line's outermost cells, from the centre of cell (0, 0).

    outermost: [lines, 2]; cell [m] along the lines, spacing [m] from line to line; along, across:
    [points], overwritten.
    """
    count = 0
    for k in range(outermost.shape[0]):
        if outermost[k, 0] >= 0:
            along[count], along[count + 1] = (outermost[k, 0] - 0.5) * cell, (outermost[k, 1] + 0.5) * cell
            across[count], across[count + 1] = k * spacing, k * spacing
            count += 2


@kernel
def normal_equations(
    log_x: Field, log_y: Field, log_a: float, log_b: float, log_n: float, normal: Field, radial: Field
) -> float:
    """`J^T J` and, in the last column, `-J^T (rho - 1)`, from ln|x| and ln|y|; returns the cost
    `sum (rho - 1)^2` [1].

    With u = ln|x/a|, v = ln|y/b| and the share s = |x/a|^n / rho^n: `ln rho = max(u, v) + ln(1 +
    exp(-n |u-v|)) / n`, its derivatives by ln a, ln b, ln n are `-s`, `-(1-s)` and `s u + (1-s) v -
    ln rho`. log_x, log_y: [points]; normal: [3, 4], overwritten; radial: [3, points], scratch.
    """
    exponent, cost = math.exp(log_n), 0.0
    # Radial variable of the points; the exponential never overflows. A loop for each function, as
    # each call takes all registers
    smaller, log_rho, rho = radial
    for k in range(log_x.size):
        smaller[k] = math.exp(-exponent * abs((log_x[k] - log_a) - (log_y[k] - log_b)))
    for k in range(log_x.size):
        log_rho[k] = max(log_x[k] - log_a, log_y[k] - log_b) + math.log1p(smaller[k]) / exponent
    for k in range(log_x.size):
        rho[k] = math.exp(log_rho[k])
    # Sums in registers: an array would be read and written at each point
    aa = ab = an = bb = bn = nn = ae = be = ne = 0.0
    for k in range(log_x.size):
        u, v = log_x[k] - log_a, log_y[k] - log_b
        larger_share = 1.0 / (1.0 + smaller[k])
        share = larger_share if u >= v else smaller[k] * larger_share
        error = rho[k] - 1.0
        # Gradient of rho by ln a, ln b, ln n
        by_a, by_b = -rho[k] * share, rho[k] * (share - 1.0)
        by_n = rho[k] * (share * u + (1.0 - share) * v - log_rho[k])
        cost += error * error
        aa, ab, an = aa + by_a * by_a, ab + by_a * by_b, an + by_a * by_n
        bb, bn, nn = bb + by_b * by_b, bn + by_b * by_n, nn + by_n * by_n
        ae, be, ne = ae - by_a * error, be - by_b * error, ne - by_n * error
    normal[0, 0], normal[0, 1], normal[0, 2], normal[0, 3] = aa, ab, an, ae
    normal[1, 0], normal[1, 1], normal[1, 2], normal[1, 3] = ab, bb, bn, be
    normal[2, 0], normal[2, 1], normal[2, 2], normal[2, 3] = an, bn, nn, ne
    return cost


@kernel
def damped_step(normal: Field, damping: float) -> tuple[float, float, float]:
    """Step of (ln a, ln b, ln n) [1] from `(J^T J + damping diag) step = -J^T error` by
    elimination.

    normal: [3, 4] of `normal_equations`, symmetric and positive definite in its first three
    columns; damping: [1].
    """
    floor = 1e-14 * (normal[0, 0] + normal[1, 1] + normal[2, 2])
    a00 = normal[0, 0] * (1.0 + damping) + floor
    a11 = normal[1, 1] * (1.0 + damping) + floor
    a22 = normal[2, 2] * (1.0 + damping) + floor
    ratio_1, ratio_2 = normal[0, 1] / a00, normal[0, 2] / a00
    b11, b12, b22 = a11 - ratio_1 * normal[0, 1], normal[1, 2] - ratio_1 * normal[0, 2], a22 - ratio_2 * normal[0, 2]
    right_1, right_2 = normal[1, 3] - ratio_1 * normal[0, 3], normal[2, 3] - ratio_2 * normal[0, 3]
    ratio = b12 / b11
    step_n = (right_2 - ratio * right_1) / (b22 - ratio * b12)
    step_b = (right_1 - b12 * step_n) / b11
    step_a = (normal[0, 3] - normal[0, 1] * step_b - normal[0, 2] * step_n) / a00
    return step_a, step_b, step_n
