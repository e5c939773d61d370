"""The domain inside a Lame curve `|x/a|^n + |y/b|^n <= 1`: inside test, boundary by arc length,
mesh; n from 0.1 to 100.

The usual parametrisation by cosines bunches its points at the corners for n > 2 and at the tips for
n < 2. Here each octant has a parameter s from 0 (tip) to 1 (diagonal) in which it is smooth: with
`t = s^max(1, 1/n)` the curve is `x/a = (1 + t^n)^(-1/n)`, `y/b = t x/a`, and the same with the axes
exchanged. Lengths, sector areas and centroids are Gauss sums over fixed panels of s; against
quadrature and closed forms they are good to 1e-9.

Source: Driver and Seat eqs 4 and 5, Tire/Road Contact eqs 5 and 6, with signed powers.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.pressure.closed_form.lame import refuse_axes, refuse_exponent

__all__ = ["LARGEST_EXPONENT", "LameMesh", "inside", "lame_boundary", "lame_mesh", "perimeter", "radial_variable"]

Field = NDArray[numpy.float64]

LARGEST_EXPONENT = 100.0
"""Of boundary and mesh; the domain is then a rectangle to 0.7 % of its sides."""

SLENDEREST = 1e12
"""Largest ratio of the half axes of boundary and mesh."""

# Of s, in each octant; the one at a tip is halved again and again, since s has fractional powers
# there
PANELS = 32
HALVINGS = 24
NODES, WEIGHTS = numpy.polynomial.legendre.leggauss(10)
NEWTON_STEPS = 8


class LameMesh(NamedTuple):
    """Cells between rays from the centre and rings of constant rho; `sum(area)` is the area of the
    domain.
    """

    x: Field  # [cells] [m] centroids, ring by ring from the centre
    y: Field  # [cells] [m]
    area: Field  # [cells] [m^2]


class _Quadrant(NamedTuple):
    """x/a, y/b and their derivatives by s: s = 0 at the tip on x, 1 on the diagonal, 2 at the tip
    on y.
    """

    x: Field
    y: Field
    slope_x: Field
    slope_y: Field


def radial_variable(x: Field, y: Field, a: float, b: float, exponent: float) -> Field:
    """`rho = (|x/a|^n + |y/b|^n)^(1/n)` by logarithms, x and y [m] of any fitting shapes; 1 on the
    curve, inf beyond.

    Raises `ValueError` for n < 0.1, axes outside 1e-100 to 1e100 m and coordinates that are not
    numbers.
    """
    refuse_axes(a, b)
    refuse_exponent(exponent)
    x, y = numpy.asarray(x, dtype=float), numpy.asarray(y, dtype=float)
    if numpy.isnan(x).any() or numpy.isnan(y).any():
        raise ValueError("Lame curve: a coordinate is nan, it must be a number")
    with numpy.errstate(divide="ignore", over="ignore"):
        u, v = numpy.log(abs(x) / a), numpy.log(abs(y) / b)
        larger = numpy.maximum(u, v)
        apart = numpy.where(numpy.isinf(larger), 0.0, larger) - numpy.minimum(u, v)
        return numpy.asarray(numpy.exp(larger + numpy.log1p(numpy.exp(-exponent * apart)) / exponent))


def inside(x: Field, y: Field, a: float, b: float, exponent: float) -> NDArray[numpy.bool_]:
    """Where `rho <= 1`; errors as `radial_variable`.

    x, y: [points] [m], or any one shape, which is that of the result; a, b: [m].
    """
    return numpy.asarray(radial_variable(x, y, a, b, exponent) <= 1.0)


def perimeter(a: float, b: float, exponent: float) -> float:
    """Length of the curve [m].

    Raises `ValueError` for n outside 0.1 to 100, axes outside 1e-100 to 1e100 m and a ratio of
    theirs beyond 1e12.
    """
    _refuse(a, b, exponent)
    return 4.0 * float(_lengths(a, b, exponent)[-1])


def lame_boundary(a: float, b: float, exponent: float, count: int) -> tuple[Field, Field]:
    """x, y [m] of `count` points at equal arc lengths, from (a, 0) towards +y. Errors as
    `perimeter`.
    """
    _refuse(a, b, exponent)
    if count < 1:
        raise ValueError(f"Lame curve: {count} boundary points, at least 1 is needed")
    quarter = _lengths(a, b, exponent)[-1]
    number, rest = numpy.divmod(4.0 * quarter * numpy.arange(count) / count, quarter)
    # Every second quadrant runs from y to x
    along = numpy.where(number % 2 == 0, rest, quarter - rest)
    point = _quadrant(exponent, _at_lengths(a, b, exponent, along))
    sign_x = numpy.where((number == 0) | (number == 3), 1.0, -1.0)
    sign_y = numpy.where(number < 2, 1.0, -1.0)
    return a * sign_x * point.x, b * sign_y * point.y


def lame_mesh(a: float, b: float, exponent: float, rings: int, sectors: int) -> LameMesh:
    """Mesh of rings, evenly spaced in rho, by sectors, evenly spaced along the curve (a multiple of
    4).

    The area [m^2] is exact in each cell, since it scales with rho^2, and so are the centroids [m]:
    a sum of `area` times a smooth function there is its integral with an error of the second order.
    a, b: half axes [m]. Errors as `perimeter`.
    """
    _refuse(a, b, exponent)
    if rings < 1 or sectors < 4 or sectors % 4:
        raise ValueError(
            f"Lame mesh: {rings} rings and {sectors} sectors, at least 1 ring and a multiple of 4 sectors are needed"
        )
    area, x, y = _sectors(a, b, exponent, sectors // 4)
    area = numpy.concatenate([area, area[::-1], area, area[::-1]])
    x = numpy.concatenate([x, -x[::-1], -x, x[::-1]])
    y = numpy.concatenate([y, y[::-1], -y, -y[::-1]])
    rho = numpy.arange(rings + 1) / rings
    share = numpy.diff(rho**2)
    radius = numpy.diff(rho**3) / share  # of the centroid, over that of the whole sector
    cells = (radius[:, None] * x).ravel(), (radius[:, None] * y).ravel(), (share[:, None] * area).ravel()
    return LameMesh(*cells)


def _sectors(a: float, b: float, exponent: float, count: int) -> tuple[Field, Field, Field]:
    """Area and centroid of the sectors of one quadrant between points at equal arc lengths."""
    quarter = _lengths(a, b, exponent)[-1]
    bounds = _at_lengths(a, b, exponent, quarter * numpy.arange(count + 1) / count)
    bounds[0], bounds[-1] = 0.0, 2.0
    cuts = numpy.unique(numpy.concatenate([bounds, _panel_edges()]))
    s, weight = _gauss(cuts[:-1], cuts[1:])
    point = _quadrant(exponent, s)
    rate = 0.5 * a * b * (point.x * point.slope_y - point.y * point.slope_x) * weight
    parts = numpy.stack([rate, a * point.x * rate, b * point.y * rate]).sum(axis=-1)
    area, first_x, first_y = numpy.add.reduceat(parts, numpy.searchsorted(cuts, bounds[:-1]), axis=1)
    return area, 2.0 / 3.0 * first_x / area, 2.0 / 3.0 * first_y / area


def _quadrant(exponent: float, s: Field) -> _Quadrant:
    """The first quadrant of the unit curve at s in 0..2."""
    near = numpy.minimum(s, 2.0 - s)
    steep, flat = max(exponent, 1.0), max(1.0, 1.0 / exponent)
    power, ratio = near**steep, near**flat  # t^n and t
    major = (1.0 + power) ** (-1.0 / exponent)
    slope_major = -major / (1.0 + power) * (steep / exponent) * near ** (steep - 1.0)
    slope_minor = flat * near ** (flat - 1.0) * major + ratio * slope_major
    first = s <= 1.0
    return _Quadrant(
        numpy.where(first, major, ratio * major),
        numpy.where(first, ratio * major, major),
        numpy.where(first, slope_major, -slope_minor),
        numpy.where(first, slope_minor, -slope_major),
    )


def _speed(a: float, b: float, exponent: float, s: Field) -> Field:
    """Arc length per unit of s [m]."""
    point = _quadrant(exponent, s)
    return numpy.asarray(numpy.hypot(a * point.slope_x, b * point.slope_y))


def _panel_edges() -> Field:
    octant = numpy.concatenate(
        [[0.0], 0.5 ** numpy.arange(HALVINGS, 0, -1) / PANELS, numpy.arange(1, PANELS + 1) / PANELS]
    )
    return numpy.concatenate([octant, 2.0 - octant[-2::-1]])


def _gauss(low: Field, high: Field) -> tuple[Field, Field]:
    """Nodes and weights [..., 10] of Gauss sums from `low` to `high`."""
    half = 0.5 * (high - low)[..., None]
    return low[..., None] + half * (NODES + 1.0), half * WEIGHTS


def _lengths(a: float, b: float, exponent: float) -> Field:
    """Arc length [m] from the tip on x to each panel edge."""
    edges = _panel_edges()
    s, weight = _gauss(edges[:-1], edges[1:])
    return numpy.concatenate([[0.0], numpy.cumsum((_speed(a, b, exponent, s) * weight).sum(axis=-1))])


def _at_lengths(a: float, b: float, exponent: float, lengths: Field) -> Field:
    """s at arc lengths of the first quadrant [m], by Newton inside the panel."""
    edges, table = _panel_edges(), _lengths(a, b, exponent)
    panel = numpy.clip(numpy.searchsorted(table, lengths, side="right") - 1, 0, edges.size - 2)
    low, high = edges[panel], edges[panel + 1]
    wanted = lengths - table[panel]
    length = (
        table[panel + 1] - table[panel]
    )  # 0 where a panel at the tip of a needle is below the rounding of the whole
    found = low + (high - low) * numpy.divide(wanted, length, out=numpy.zeros_like(wanted), where=length > 0.0)
    for _ in range(NEWTON_STEPS):
        s, weight = _gauss(low, found)
        missing = wanted - (_speed(a, b, exponent, s) * weight).sum(axis=-1)
        found = numpy.clip(found + missing / _speed(a, b, exponent, found), low, high)
    return numpy.asarray(found)


def _refuse(a: float, b: float, exponent: float) -> None:
    refuse_axes(a, b)
    refuse_exponent(exponent)
    if exponent > LARGEST_EXPONENT:
        raise ValueError(f"Lame curve: exponent n = {exponent}, boundary and mesh go to {LARGEST_EXPONENT:g}")

    if max(a, b) > SLENDEREST * min(a, b):
        raise ValueError(
            f"Lame curve: half axes a = {a} m, b = {b} m, boundary and mesh go to a ratio of {SLENDEREST:g}"
        )
