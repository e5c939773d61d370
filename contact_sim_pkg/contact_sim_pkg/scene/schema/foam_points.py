"""Points of a measured foam: strain, stress while loading and, where it was measured, while unloading."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

__all__ = ["FEWEST_POINTS", "MOST_SHARE", "Points", "elastic_of", "point_fault", "share_of"]

FEWEST_POINTS = 5
MOST_SHARE = 0.9
"""[1] of a foam's hysteresis."""
Points: TypeAlias = list[list[float]]
"""[points] of 2 or 3 numbers, stresses in [Pa]; the curve begins at the origin, which is no point"""


def elastic_of(points: Sequence[Sequence[float]]) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Strain and stress [Pa] of the elastic curve, the mean of loading and unloading."""
    return tuple(each[0] for each in points), tuple(sum(each[1:]) / (len(each) - 1) for each in points)


def share_of(points: Sequence[Sequence[float]]) -> float | None:
    """Share s [1] of a hysteresis F = F_el (1 +- s) whose loop has the area of the measured one: with the areas A
    under loading and B under unloading, by trapezoids from the origin, s = (A - B)/(A + B). None without unloading.
    """
    if len(points[0]) < 3:
        return None
    loading = unloading = 0.0
    for (e, p, q), (f, r, s) in zip([[0.0, 0.0, 0.0], *points], points, strict=False):
        loading += 0.5 * (f - e) * (p + r)
        unloading += 0.5 * (f - e) * (q + s)
    return (loading - unloading) / (loading + unloading)


def point_fault(points: Sequence[Sequence[float]]) -> str:
    """What is wrong with points of a curve, with the number of the point from 1; empty: nothing is."""
    width = len(points[0])
    before = [0.0] * width
    for number, point in enumerate(points, 1):
        if len(point) != width:
            return f"point {number} has {len(point)} numbers, point 1 has {width}; give each point the same"
        if not before[0] < point[0] < 1.0:
            return f"point {number}: strain {point[0]:.4g} is not above {before[0]:.4g} and below 1"
        if not point[1] > before[1]:
            return f"point {number}: stress {point[1]:.4g} Pa is not above {before[1]:.4g} Pa of the one before"
        if width > 2 and not before[2] <= point[2] <= point[1]:
            return (
                f"point {number}: stress {point[2]:.4g} Pa while unloading is not from {before[2]:.4g} Pa, of the one before, "
                f"to {point[1]:.4g} Pa, that of loading"
            )
        before = list(point)
    share = share_of(points)
    if share is not None and share > MOST_SHARE:
        return f"the loop has a share of {share:.3g}, at most {MOST_SHARE:g} are allowed; look at the unloading"
    return ""
