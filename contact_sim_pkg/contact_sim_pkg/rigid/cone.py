"""Projections on the friction cone, its base, and on a ray of it.

Cone: ``|c_t| <= mu c_n``. Polyhedral cone: its base is the regular polygon with vertices at angles
``2 pi k / facets`` on the disc of radius ``mu c_n``. ``facets = 0`` stands for the disc; in the
plane the second tangent is 0 and both are the same.

Source: Identifiability eqs 5 to 7.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import kernel


@kernel
def project_on_disc(x, y, radius):
    """Nearest point of the disc about the origin."""
    length, radius = math.hypot(x, y), max(radius, 0.0)
    if length <= radius:
        return x, y
    factor = radius / length
    return factor * x, factor * y


@kernel
def sector_axis(x, y, facets):
    """Angle of the middle of the facet whose sector holds (x, y)."""
    step = 2.0 * math.pi / facets
    return (math.floor(math.atan2(y, x) / step) + 0.5) * step


@kernel
def project_on_polygon(x, y, radius, facets):
    """Nearest point of the regular polygon with vertices at radius ``radius``; a point and its
    nearest share a sector.
    """
    if x == 0.0 and y == 0.0:
        return 0.0, 0.0
    half = math.pi / facets
    axis = sector_axis(x, y, facets)
    cosine, sine = math.cos(axis), math.sin(axis)
    along, across = cosine * x + sine * y, cosine * y - sine * x
    radius = max(radius, 0.0)
    apothem, edge = radius * math.cos(half), radius * math.sin(half)
    if along <= apothem:
        return x, y
    across = min(max(across, -edge), edge)
    return cosine * apothem - sine * across, sine * apothem + cosine * across


@kernel
def project_on_base(x, y, radius, facets):
    """Nearest point of the base of the cone: disc where ``facets`` is 0, else polygon."""
    if facets == 0:
        return project_on_disc(x, y, radius)
    return project_on_polygon(x, y, radius, facets)


@kernel
def project_on_ray(c_n, c_t, slope):
    """Nearest point of the ray ``(1, slope) s, s >= 0`` to (c_n, c_t): its s."""
    return max(0.0, (c_n + slope * c_t) / (1.0 + slope * slope))


@kernel
def project_on_cone(c_n, x, y, friction, facets):
    """Nearest point of the friction cone to ``(c_n, x, y)``."""
    if facets == 0:
        length = math.hypot(x, y)
        if length <= friction * c_n:
            return c_n, x, y
        normal = project_on_ray(c_n, length, friction)
        factor = friction * normal / length
        return normal, factor * x, factor * y
    axis = sector_axis(x, y, facets)
    half = math.pi / facets
    cosine, sine = math.cos(axis), math.sin(axis)
    along, across = cosine * x + sine * y, cosine * y - sine * x
    slope = friction * math.cos(half)
    if along <= slope * c_n:
        return c_n, x, y
    normal = project_on_ray(c_n, along, slope)
    edge = friction * math.sin(half) * normal
    if abs(across) > edge:  # nearest on the ray at the end of the facet
        side = math.copysign(1.0, across)
        ray_x, ray_y = math.cos(half), side * math.sin(half)
        normal = project_on_ray(c_n, along * ray_x + across * ray_y, friction)
        edge = friction * math.sin(half) * normal
        across = side * edge
    along = slope * normal
    return normal, cosine * along - sine * across, sine * along + cosine * across
