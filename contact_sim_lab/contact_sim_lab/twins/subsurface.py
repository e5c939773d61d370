"""Stress in a half-space by cubature of the point-force solutions, and the closed forms on the axis
of Hertz contacts.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy
import scipy.integrate
from numpy.typing import NDArray

__all__ = [
    "circle_axis",
    "line_axis",
    "normal_point",
    "rectangle",
    "tangential_point",
    "tensor_under_ellipse",
    "under_ellipse",
    "worst_under_ellipse",
]

Six = tuple[float, float, float, float, float, float]
Points = NDArray[numpy.float64]


def normal_point(x: Any, y: Any, z: float, nu: float) -> tuple[Any, Any, Any, Any, Any, Any]:
    """xx, yy, zz, xy, xz, yz of a unit force into the body (Boussinesq; Johnson 1985, eqs 3.18 in
    Cartesian form).

    x, y, z: [m], x and y also arrays; the result: [1/m^2].
    """
    r = (x * x + y * y + z * z) ** 0.5
    s, q = 1.0 - 2.0 * nu, r * (r + z)
    bend = (2 * r + z) / (r**3 * (r + z) ** 2)
    shear = 3 * x * y * z / r**5 - s * bend * x * y
    k = -1.0 / (2.0 * math.pi)
    xx = k * (3 * x * x * z / r**5 + s * (1.0 / q - z / r**3 - bend * x * x))
    yy = k * (3 * y * y * z / r**5 + s * (1.0 / q - z / r**3 - bend * y * y))
    return xx, yy, k * 3 * z**3 / r**5, k * shear, k * 3 * x * z * z / r**5, k * 3 * y * z * z / r**5


def tangential_point(x: float, y: float, z: float, nu: float) -> Six:
    """The same of a unit force along x (Cerruti; Johnson 1985, eqs 3.76).

    x, y, z: [m]; the result: [1/m^2].
    """
    r = math.sqrt(x * x + y * y + z * z)
    s, g = 1.0 - 2.0 * nu, r + z
    k = 1.0 / (2.0 * math.pi)
    bend = 1.0 / (r**3 * g * g) + 2.0 / (r * r * g**3)
    xx = k * (-3 * x**3 / r**5 + s * (x / r**3 - 3 * x / (r * g * g) + x**3 * bend))
    yy = k * (-3 * x * y * y / r**5 + s * (x / r**3 - x / (r * g * g) + x * y * y * bend))
    xy = k * (-3 * x * x * y / r**5 + s * (-y / (r * g * g) + x * x * y * bend))
    return xx, yy, -k * 3 * x * z * z / r**5, xy, -k * 3 * x * x * z / r**5, -k * 3 * x * y * z / r**5


def rectangle(
    point_force: Callable[[float, float, float, float], Six],
    load: Callable[[float, float], float],
    half: tuple[float, float],
    at: tuple[float, float, float],
    nu: float,
) -> list[float]:
    """Stresses [Pa] at a point below the surface of `load(x, y)` [Pa] on |x| < half[0], |y| <
    half[1], by cubature.
    """
    values = []
    for component in range(6):
        value, _ = scipy.integrate.dblquad(
            lambda eta, xi: load(xi, eta) * point_force(at[0] - xi, at[1] - eta, at[2], nu)[component],  # noqa: B023
            -half[0],
            half[0],
            -half[1],
            half[1],
            epsabs=1e-11,
            epsrel=1e-10,
        )
        values.append(float(value))
    return values


def _forces_of_ellipse(half_axes: tuple[float, float]) -> tuple[Points, Points, Points]:
    """Places along x and y [40, 80] [m] and forces [40, 1] [m^2] over p0 of the pressure ``p0 sqrt(1 - r^2)``.

    r = sin(pi s/2), Gauss in s, which removes the root at the edge, and evenly round the ellipse.
    """
    nodes, weights = numpy.polynomial.legendre.leggauss(40)
    angles = 2.0 * math.pi * (numpy.arange(80) + 0.5) / 80
    half_turn = 0.25 * math.pi * (nodes + 1.0)
    r, a, b = numpy.sin(half_turn), *half_axes
    # Pressure cos(pi s/2), area a b r dr dphi with dr = pi/2 cos(pi s/2) ds.
    force = 0.25 * math.pi * weights * r * numpy.cos(half_turn) ** 2 * a * b * 2.0 * math.pi / 80
    return numpy.outer(a * r, numpy.cos(angles)), numpy.outer(b * r, numpy.sin(angles)), force[:, None]


def under_ellipse(half_axes: tuple[float, float], points: Points) -> Points:
    """zz and xz over p0 [2, n] [1] at ``points`` [n, 3] [m] below the pressure of an ellipse.

    Boussinesq's point forces at `_forces_of_ellipse`: within 1e-6 from a depth of 0.2 semi-axes on.
    half_axes: [m] along x, y.
    """
    xi, eta, shares = _forces_of_ellipse(half_axes)
    found = []
    for x, y, z in points:
        common = -1.5 / math.pi * shares * z**2 * ((x - xi) ** 2 + (y - eta) ** 2 + z**2) ** -2.5
        found.append((numpy.sum(z * common), numpy.sum((x - xi) * common)))
    return numpy.array(found).T


def tensor_under_ellipse(half_axes: tuple[float, float], points: Points, nu: float) -> Points:
    """xx, yy, zz, xy, xz, yz over p0 [6, n] [1], as `under_ellipse`."""
    xi, eta, shares = _forces_of_ellipse(half_axes)
    found = [[numpy.sum(shares * part) for part in normal_point(x - xi, y - eta, z, nu)] for x, y, z in points]
    return numpy.array(found).T


def worst_under_ellipse(slim: float, nu: float, limits: tuple[float, float], count: int) -> tuple[Points, Points]:
    """Largest stress over its limit at p0 = 1 [points] [1/Pa] at count^3 points of a quarter of the box 4 a x 4 b x 3 a
    under an ellipse, and the share [points] of the box that each stands for.

    slim: smaller over larger semi-axis [1]; limits: of normal and shear stress [Pa]. By `tensor_under_ellipse`; above 0.06
    of the larger semi-axis, where it fails, the stress is that of this depth.
    """
    places = (numpy.arange(count) + 0.5) / count
    x, y, z = (
        part.ravel() for part in numpy.meshgrid(2.0 * places, 2.0 * places * slim, 3.0 * places**1.5, indexing="ij")
    )
    below = numpy.stack([x, y, numpy.maximum(z, 0.06)], axis=1)
    stress = numpy.abs(tensor_under_ellipse((1.0, slim), below, nu))
    worst = numpy.maximum(stress[:3].max(axis=0) / limits[0], stress[3:].max(axis=0) / limits[1])
    return worst, numpy.tile(1.5 * places**0.5, count**2) / count**3


def circle_axis(depth: float, nu: float) -> tuple[float, float]:
    """zz and radial stress over p0 [1] on the axis of a circular Hertz contact (Johnson 1985, eq
    3.45); depth: over a [1]; nu: [1]."""
    swing = math.atan(1.0 / depth) if depth > 0.0 else 0.5 * math.pi
    zz = -1.0 / (1.0 + depth**2)
    return zz, -(1.0 + nu) * (1.0 - depth * swing) - 0.5 * zz


def line_axis(depth: float, nu: float) -> tuple[float, float, float]:
    """xx (across), yy (along the line), zz over p0 [1] on the axis of a Hertz line contact (Johnson
    1985, eq 4.46).

    depth: over the half width [1]; nu: [1].
    """
    root = math.sqrt(1.0 + depth**2)
    xx, zz = -((1.0 + 2.0 * depth**2) / root - 2.0 * depth), -1.0 / root
    return xx, nu * (xx + zz), zz
