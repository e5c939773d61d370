"""Contact of a sphere and a half-space, or of two spheres, as plain geometry (Goloshchapov eqs
1-7).

``r^2 = 2 R x - x^2 = k_p^2 R x``, ``k_p = sqrt(2 - x/R)``, x the approach, ``R = R1 R2/(R1 + R2)``.
The radius is that of the rigid overlap: sqrt(2) times Hertz's. Exact for a sphere on a plane; for
two spheres `overlap_radius` is exact, and eq 1 is its first order in x.
"""

from __future__ import annotations

import math

from contact_sim_pkg.rigs.impact.theory.checks import check_not_negative, check_number, check_positive
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError

__all__ = [
    "SMALL_SHAPE_FACTOR",
    "contact_radius",
    "depth_factor",
    "depth_note",
    "effective_radius",
    "overlap_radius",
    "shape_factor",
]

SMALL_SHAPE_FACTOR = math.sqrt(2.0)
DEEP = 0.3  # x/R above which the quadratic shape is a rough picture


def effective_radius(radius_1: float, radius_2: float) -> float:
    """``R1 R2/(R1 + R2)`` in [m], both > 0; either may be infinite (a plane). Raises ImpactError
    otherwise.
    """
    curvature = 0.0
    for radius in (radius_1, radius_2):
        curvature += 1.0 / check_number("radius", radius, "m", above=0.0, infinite=True)
    if curvature == 0.0:
        raise ImpactError("two planes have no contact radius; one of the radii must be finite")
    return 1.0 / curvature


def depth_note(depth: float, radius: float) -> str | None:
    """None up to x/R = 0.3, a sentence up to 1; raises ImpactError above, where the shape has no
    meaning, and for R not above 0.

    depth, radius: [m].
    """
    ratio = check_number("depth", depth, "m") / check_positive("radius", radius, "m")
    if not ratio <= 1.0:
        raise ImpactError(
            f"depth over radius {ratio:.4g}: the contact geometry ends at 1; choose a stiffer or slower case"
        )
    if ratio > DEEP:
        return f"depth over radius {ratio:.3g} is above {DEEP}: the quadratic contact shape is a rough picture there"
    return None


def shape_factor(depth: float, radius: float) -> float:
    """``k_p = sqrt(2 - x/R)``, 1 to sqrt(2); raises ImpactError outside 0 <= x <= R [m]."""
    depth_note(check_not_negative("depth", depth, "m"), radius)
    return math.sqrt(2.0 - depth / radius)


def contact_radius(depth: float, radius: float) -> float:
    """``sqrt(2 R x - x^2)`` in [m]; 0 without approach. Raises ImpactError for x > R and R not
    above 0.
    """
    check_positive("radius", radius, "m")
    if check_number("depth", depth, "m") <= 0.0:
        return 0.0
    return shape_factor(depth, radius) * math.sqrt(radius * depth)


def overlap_radius(depth: float, radius_1: float, radius_2: float) -> float:
    """Radius in [m] of the circle in which two finite spheres intersect whose centres stand ``R1 +
    R2 - x`` apart.

    ``r^2 = R1^2 - d1^2``, ``d1 = (D^2 + R1^2 - R2^2)/(2 D)``.
    Raises ImpactError where one swallows the other's pole by R, and for radii not above 0.
    """
    check_positive("radius", radius_1, "m")
    check_positive("radius", radius_2, "m")
    if check_number("depth", depth, "m") <= 0.0:
        return 0.0
    depth_note(depth, effective_radius(radius_1, radius_2))
    # Heron: r = 2 area / D of the triangle R1, R2, D, factored so that small x does not cancel
    distance = radius_1 + radius_2 - depth
    product = depth * (distance + radius_1 + radius_2) * (2.0 * radius_2 - depth) * (2.0 * radius_1 - depth)
    return math.sqrt(product) / (2.0 * distance)


def depth_factor(radius: float, body_radius: float, body_share: float) -> float:
    """``k_h = (R - D2 R2)/R2`` of the contact surface's depth ``h_x = k_h x`` (eq 6); D1 for a
    half-space, where R = R2.

    Radii > 0 [m], D2 from 0 to 1; raises ImpactError otherwise.
    """
    check_positive("radius", radius, "m")
    check_positive("radius of the body", body_radius, "m")
    check_number("share of the body", body_share, least=0.0, most=1.0)
    return (radius - body_share * body_radius) / body_radius
