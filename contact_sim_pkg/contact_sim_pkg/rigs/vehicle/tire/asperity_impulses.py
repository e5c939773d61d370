"""Travelling impulses of road asperities: each site of the road pushes while the contact passes
over it.

Sites at x = n dx, n = 1..N, N = floor(L/dx); the contact of length b is centred at x = s (s = v t).
Site n acts while `|n dx - s| < b/2`, with its normal force F_n times sin(phi_n), phi_n the angle of
its push to the road:

    f(x, s) = sum F_n sin(phi_n) W((n dx - s) / b) delta(x - n dx)   [N/m],     F(s) = sum over the
    active sites

W is 1 (rectangular), or `1 + cos(2 pi (n dx - s)/b)` (raised cosine): smooth, and of the same
impulse and mean force, for dx = b/2, b/3, … even of the same resultant at every s. About b/dx sites
act at once.

The road between the sites and the elastic field are not in it: it is a load added to a contact,
chosen by its inputs. Source: Tire/Road Contact eq 10, with N as the limit of the sum and delta the
Dirac density.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry, kernel

__all__ = [
    "AsperityImpulses",
    "asperity_density",
    "asperity_force",
    "default_asperities",
    "make_asperities",
    "site_count",
]

FORCE_SHARE = 0.1
"""Part of the wheel load that the active sites carry together when nothing is known; a choice, not
a measurement.
"""


class AsperityImpulses(NamedTuple):
    spacing: float  # [m] dx
    contact_length: float  # [m] b
    push: Vector  # [N] F_n sin(phi_n) of site n = 1..N, at index n - 1
    raised_cosine: bool  # the window W


def site_count(road_length: float, spacing: float) -> int:
    """`N = floor(L/dx + 1e-9)`: a length that is a whole number of spacings counts its last
    site.

    road_length, spacing: [m].
    """
    if not (0.0 < spacing < math.inf and 0.0 <= road_length < math.inf):
        raise ValueError(f"asperities: spacing {spacing} m, road length {road_length} m; both finite, spacing above 0")
    return math.floor(road_length / spacing + 1e-9)


def make_asperities(
    spacing: float, contact_length: float, force: Vector, angle: Vector, raised_cosine: bool = False
) -> AsperityImpulses:
    """Sites with given forces F_n [N] and angles phi_n [rad] (pi/2: straight up), one entry a site.

    spacing: dx [m]; contact_length: b [m]. Raises `ValueError` for sizes that are not positive,
    rows of different length and values that are not finite.
    """
    for name, value in (("spacing", spacing), ("contact length", contact_length)):
        if not 0.0 < value < math.inf:
            raise ValueError(f"asperities: {name} is {value} m, it must be a finite number above 0")
    force, angle = numpy.asarray(force, dtype=float), numpy.asarray(angle, dtype=float)
    if force.ndim != 1 or force.shape != angle.shape:
        raise ValueError(
            f"asperities: forces {force.shape} and angles {angle.shape}, both must be one row of the sites"
        )
    # Only the vertical part of a push acts.
    push = force * numpy.sin(angle)
    if not numpy.all(numpy.isfinite(push)):
        site = int(numpy.argmin(numpy.isfinite(push))) + 1
        raise ValueError(f"asperities: force or angle of site {site} is not a finite number")
    return AsperityImpulses(float(spacing), float(contact_length), push, bool(raised_cosine))


def default_asperities(
    load: float, spacing: float, contact_length: float, slope: Vector, raised_cosine: bool = False
) -> AsperityImpulses:
    """Asperities without data: `F_n = 0.1 P dx / b` [N], `phi_n = pi/2 - atan h'(n dx)` [rad].

    load: P [N]; spacing: dx [m]; contact_length: b [m]; slope: h' of the road, dimensionless, one
    for each site. Errors as in `make_asperities`.
    """
    slope = numpy.asarray(slope, dtype=float)
    force = numpy.full(slope.shape, FORCE_SHARE * load * spacing / contact_length)
    return make_asperities(spacing, contact_length, force, 0.5 * math.pi - numpy.arctan(slope), raised_cosine)


@entry
def asperity_force(asperities: AsperityImpulses, travel: float) -> float:
    """Resultant [N] with the contact centred at `travel` [m]; 0 where no site is under it, NaN for
    NaN.
    """
    if math.isnan(travel):
        return math.nan
    first, last = active_sites(asperities, travel)
    total = 0.0
    for n in range(first, last):
        total += asperities.push[n - 1] * window(asperities, n, travel)
    return total


@entry
def asperity_density(asperities: AsperityImpulses, travel: float, start: float, cell: float, out: Vector) -> None:
    """Line density [N/m] on cells: `out[i]` is the mean of f over start + i cell to start + (i + 1)
    cell [m].

    out: [cells]; travel: s [m]. A site on the border of two cells counts to the right one. Sites
    outside the cells are left out. cell > 0. NaN for NaN.
    """
    for i in range(out.shape[0]):
        out[i] = math.nan if math.isnan(travel) else 0.0
    first, last = active_sites(asperities, travel)
    for n in range(first, last):
        i = math.floor((n * asperities.spacing - start) / cell + 1e-9)
        if 0 <= i < out.shape[0]:
            out[i] += asperities.push[n - 1] * window(asperities, n, travel) / cell


BORDER = 1e-9
"""Of the contact's length: a site so near its border lies on it."""


@kernel
def active_sites(asperities: AsperityImpulses, travel: float) -> tuple[int, int]:
    """First site that may act, and the one after the last; those on the border are sorted out by
    the window.

    travel: [m].
    """
    half = 0.5 * asperities.contact_length
    sites = asperities.push.shape[0]
    if math.isnan(travel):
        return 1, 1
    first = math.floor(min(max((travel - half) / asperities.spacing, 1.0), sites + 1.0))
    last = math.ceil(min(max((travel + half) / asperities.spacing, 0.0), float(sites)))
    return first, last + 1


@kernel
def window(asperities: AsperityImpulses, site: int, travel: float) -> float:
    """Window W of a site, dimensionless, at `travel` s [m]; 0 for `|n dx - s| >= b/2`, rounding aside."""
    distance = (site * asperities.spacing - travel) / asperities.contact_length
    if not abs(distance) < 0.5 - BORDER:
        return 0.0
    if asperities.raised_cosine:
        return 1.0 + math.cos(2.0 * math.pi * distance)
    return 1.0
