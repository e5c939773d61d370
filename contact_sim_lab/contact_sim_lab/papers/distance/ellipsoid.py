"""Nearest boundary point of an ellipsoid or elliptic cylinder, from inside or outside, as a
supporting plane.

In the axes of the ellipsoid, with y the point and t the largest root of `sum (h_i y_i / (t +
h_i^2))^2 = 1`, the foot is `x_i = h_i^2 y_i / (t + h_i^2)`. The unknown is `tau = t + h_min^2 >=
0`, in which `1 - |w(tau)|^-1` is nearly a straight line, so that Newton's method converges from the
left without a bracket. On the plane of symmetry across the smallest axis the foot may leave that
plane (tau = 0): then it is one of two or more, and the others follow by reflection.

Source: Eberly (2013), Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid.
"""

from __future__ import annotations

import math

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import entry, kernel

__all__ = ["supporting_plane"]

Field = NDArray[numpy.float64]

MOST_STEPS = 60
EXACT = 4e-16


@entry
def supporting_plane(half_axes: Field, local: Field, normal: Field) -> float:
    """Outward unit `normal` [3] (overwritten) at the foot of `local`, and the plane's distance from
    the centre [m].

    half_axes: [3] [m], inf along a cylinder; local: [3] [m] from the centre, in the axes of the
    ellipsoid. `distance - normal . local` is the depth of the point, negative outside.
    """
    smallest = min(half_axes[0], half_axes[1], half_axes[2])
    tau = secular_root(half_axes, local, smallest)
    free, inside = -1, 1.0
    for j in range(3):
        share = share_of(half_axes[j], local[j], smallest, tau)  # x_j / h_j
        normal[j] = share / half_axes[j]
        inside -= share * share
        if half_axes[j] == smallest:
            free = j
    if tau == 0.0:
        normal[free] = math.sqrt(max(inside, 0.0)) / smallest
    length = math.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2)
    support = 0.0
    for j in range(3):
        normal[j] /= length
        if normal[j] != 0.0:
            support += (half_axes[j] * normal[j]) ** 2
    return math.sqrt(support)


@kernel
def share_of(half_axis: float, local: float, smallest: float, tau: float) -> float:
    """`h y / (t + h^2)` [1]; zero along a cylinder and on a plane of symmetry. Lengths over the
    smallest half axis."""
    if local == 0.0 or half_axis == math.inf:
        return 0.0
    return half_axis * local / (tau + (half_axis - smallest) * (half_axis + smallest))


@kernel
def secular_root(half_axes: Field, local: Field, smallest: float) -> float:
    """tau [1]: the root, or 0 where the foot leaves the plane of symmetry.

    half_axes, local: [3], lengths over the smallest half axis.
    """
    tau = 0.0
    for j in range(3):
        if half_axes[j] == smallest:
            tau = math.hypot(tau, smallest * local[j])
    if tau == 0.0 and norm_and_slope(half_axes, local, smallest, 0.0)[0] <= 1.0:
        return 0.0
    for _ in range(MOST_STEPS):
        norm, slope = norm_and_slope(half_axes, local, smallest, tau)
        step = norm * (norm - 1.0) / -slope
        tau += step
        if abs(step) <= EXACT * tau:
            break
    return tau


@kernel
def norm_and_slope(half_axes: Field, local: Field, smallest: float, tau: float) -> tuple[float, float]:
    """|w| and d|w|/d tau [1], with `w_j = h_j y_j / (t + h_j^2)`.

    half_axes, local: [3], lengths over the smallest half axis.
    """
    square, half_slope = 0.0, 0.0
    for j in range(3):
        share = share_of(half_axes[j], local[j], smallest, tau)
        if share != 0.0:
            square += share * share
            half_slope -= share * share / (tau + (half_axes[j] - smallest) * (half_axes[j] + smallest))
    norm = math.sqrt(square)
    return norm, half_slope / max(norm, 1e-300)
