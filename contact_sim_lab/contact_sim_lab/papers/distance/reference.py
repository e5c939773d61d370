"""Distance and overlap of ellipsoids by other ways: SLSQP and 40 digits, support functions, a
linear program over directions.

An ellipsoid is its centre [3] and its matrix Q [3, 3], `(p - c)^T Q (p - c) <= 1`; its support
function is `h(n) = n . c + sqrt(n^T Q^-1 n)`.

Source: Driver and Seat eqs 1 and 2, by other ways.
"""

from __future__ import annotations

from collections.abc import Sequence

import mpmath
import numpy
import scipy.optimize
from numpy.typing import NDArray

__all__ = ["directions", "ellipsoid_distance", "largest_ball_radius", "separating_translation", "support"]

Field = NDArray[numpy.float64]
Ellipsoid = tuple[Field, Field]


def ellipsoid_distance(one: Ellipsoid, other: Ellipsoid, starts: int = 5) -> float:
    """Distance of two separate ellipsoids [m]: the best of many SLSQP runs, then the stationarity
    equations to 40 digits.
    """
    random, best = numpy.random.default_rng(7), None

    def left(points: Field) -> Field:
        return numpy.array(
            [1.0 - (p - c) @ q @ (p - c) for p, (c, q) in zip((points[:3], points[3:]), (one, other), strict=True)]
        )

    # Best feasible run of several perturbed starts
    for _ in range(starts):
        begin = numpy.concatenate([one[0], other[0]]) + 0.1 * random.standard_normal(6)
        found = scipy.optimize.minimize(
            lambda z: 0.5 * ((z[:3] - z[3:]) ** 2).sum(),
            begin,
            constraints={"type": "ineq", "fun": left},
            options={"ftol": 1e-15, "maxiter": 500},
        )
        if left(found.x).min() > -1e-7 and (best is None or found.fun < best.fun):
            best = found
    assert best is not None
    return _polished(one, other, best.x)


def _polished(one: Ellipsoid, other: Ellipsoid, points: Field) -> float:
    """`p1 - p2 + 2 l1 Q1 (p1 - c1) = 0`, the same for body 2, and both boundaries."""
    gap = points[:3] - points[3:]
    normals = [2.0 * q @ (p - c) for p, (c, q) in zip((points[:3], points[3:]), (one, other), strict=True)]
    multipliers = [abs(gap @ n) / (n @ n) for n in normals]

    def equations(*z: mpmath.mpf) -> list[mpmath.mpf]:
        found, values = [], []
        for side, (centre, shape) in enumerate((one, other)):
            here, there = z[3 * side : 3 * side + 3], z[3 - 3 * side : 6 - 3 * side]
            off = [here[i] - mpmath.mpf(centre[i]) for i in range(3)]
            slope = [sum(mpmath.mpf(shape[i, j]) * off[j] for j in range(3)) for i in range(3)]
            found += [here[i] - there[i] + 2 * z[6 + side] * slope[i] for i in range(3)]
            values.append(sum(off[i] * slope[i] for i in range(3)) - 1)
        return found + values

    with mpmath.workdps(40):
        root = mpmath.findroot(equations, [*points, *multipliers], tol=1e-50, maxsteps=40)
        return float(mpmath.sqrt(sum((root[i] - root[3 + i]) ** 2 for i in range(3))))


def support(body: Ellipsoid, normals: Field) -> Field:
    """h(n) [m] for unit normals [..., 3]."""
    centre, shape = body
    inverse = numpy.linalg.inv(shape)
    return numpy.asarray(normals @ centre + numpy.sqrt(numpy.einsum("...i,ij,...j", normals, inverse, normals)))


def directions(count: int) -> Field:
    """Unit vectors [count, 3] spread evenly over the sphere (golden angle)."""
    step = numpy.arange(count) + 0.5
    height, angle = 1.0 - 2.0 * step / count, numpy.pi * (1.0 + 5.0**0.5) * step
    around = numpy.sqrt(1.0 - height**2)
    return numpy.stack([around * numpy.cos(angle), around * numpy.sin(angle), height], axis=1)


def separating_translation(one: Ellipsoid, other: Ellipsoid) -> float:
    """Smallest translation [m] that separates two ellipsoids: least `h1(n) + h2(-n)`, from the best
    of 4000 directions.
    """

    def overlap(n: Field) -> float:
        unit = n / numpy.linalg.norm(n)
        return float(support(one, unit) + support(other, -unit))

    start = directions(4000)
    best = start[numpy.argsort(support(one, start) + support(other, -start))[:5]]
    options = {"xatol": 1e-10, "fatol": 1e-16, "maxiter": 4000}
    return float(min(scipy.optimize.minimize(overlap, n, method="Nelder-Mead", options=options).fun for n in best))


def largest_ball_radius(bodies: Sequence[Ellipsoid], count: int = 20_000) -> float:
    """Radius [m] of the largest ball under the tangent planes of all bodies in `count` directions
    (a little too large).
    """
    normals = directions(count)
    rows = numpy.column_stack([numpy.tile(normals, (len(bodies), 1)), numpy.ones(count * len(bodies))])
    bounds = numpy.concatenate([support(body, normals) for body in bodies])
    found = scipy.optimize.linprog([0.0, 0.0, 0.0, -1.0], A_ub=rows, b_ub=bounds, bounds=[(None, None)] * 4)
    return float(-found.fun)
