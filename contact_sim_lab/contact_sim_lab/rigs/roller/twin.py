"""Stress under a Hertz ellipse by cubature of Boussinesq's and Cerruti's point forces: r = sin(pi s
/ 2) in s, uniform in angle.
"""

from __future__ import annotations

import math

import numpy
from numpy.typing import NDArray

__all__ = ["ellipse_stress", "weighted_points"]

Values = NDArray[numpy.float64]


def weighted_points(semi_axes: tuple[float, float], radii: int, angles: int) -> tuple[Values, Values, Values]:
    """x [m], y [m] and force [N] of unit peak pressure on a grid of an ellipse, [radii, angles]."""
    nodes, weights = numpy.polynomial.legendre.leggauss(radii)
    s = 0.25 * math.pi * (nodes + 1.0)
    r, turn = numpy.sin(s)[:, None], 2.0 * math.pi * (numpy.arange(angles) + 0.5)[None, :] / angles
    cells = 0.25 * math.pi * weights * numpy.cos(s) * (2.0 * math.pi / angles)
    force = numpy.sqrt(1.0 - r**2) * semi_axes[0] * semi_axes[1] * r * cells[:, None]
    return semi_axes[0] * r * numpy.cos(turn), semi_axes[1] * r * numpy.sin(turn), force * numpy.ones_like(turn)


def ellipse_stress(
    semi_axes: tuple[float, float],
    traction: tuple[float, float],
    poisson: float,
    point: Values,
    radii: int,
    angles: int,
) -> Values:
    """xx, yy, zz, xy, xz, yz [6] over the peak pressure at `point` (x, y, z > 0) [m]; traction: q_x
    / p and q_y / p.
    """
    # Point forces that add up to the pressure.
    at_x, at_y, force = weighted_points(semi_axes, radii, angles)
    x, y, z, free = point[0] - at_x, point[1] - at_y, float(point[2]), 1.0 - 2.0 * poisson
    force, d = force / (2.0 * math.pi), numpy.sqrt(x**2 + y**2 + z**2)
    e = d + z

    def pushed(x: Values, y: Values) -> tuple[Values, Values, Values]:
        normal = free * (1.0 / (d * e) - y**2 * (d + e) / (d**3 * e**2)) - 3.0 * z * x**2 / d**5
        shear = free * x * y * (d + e) / (d**3 * e**2) - 3.0 * x * y * z / d**5
        return normal, shear, -3.0 * x * z**2 / d**5

    def dragged(x: Values, y: Values) -> Values:
        along = x / d**3 - 3.0 * x / (d * e**2) + x**3 / (d**3 * e**2) + 2.0 * x**3 / (d**2 * e**3)
        across = x / d**3 - x / (d * e**2) + x * y**2 / (d**3 * e**2) + 2.0 * x * y**2 / (d**2 * e**3)
        shear = -y / (d * e**2) + x**2 * y / (d**3 * e**2) + 2.0 * x**2 * y / (d**2 * e**3)
        return numpy.array([
            float((force * value).sum())
            for value in (
                free * along - 3.0 * x**3 / d**5, free * across - 3.0 * x * y**2 / d**5, -3.0 * x * z**2 / d**5,
                free * shear - 3.0 * x**2 * y / d**5, -3.0 * x**2 * z / d**5, -3.0 * x * y * z / d**5,
            )
        ])  # fmt: skip

    # Sum over the forces: Boussinesq for the pressure, Cerruti for the traction.
    (xx, xy, xz), (yy, _xy, yz) = pushed(x, y), pushed(y, x)
    sums = numpy.array([float((force * part).sum()) for part in (xx, yy, -3.0 * z**3 / d**5, xy, xz, yz)])
    return sums + traction[0] * dragged(x, y) + traction[1] * dragged(y, x)[[1, 0, 2, 3, 5, 4]]
