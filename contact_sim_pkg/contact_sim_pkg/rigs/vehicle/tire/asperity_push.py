"""Impulses of the road's asperities over one block: the sites of the strip that came, and their
resultant over the travel.

Source: Tire/Road Contact eq 10.
"""

from __future__ import annotations

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.messages import RoadPatch
from contact_sim_pkg.rigs.vehicle.tire.asperity_impulses import FORCE_SHARE, asperity_force, default_asperities
from contact_sim_pkg.rigs.vehicle.tire.model import Asperities, TireGeometry

__all__ = ["asperity_push"]


def asperity_push(asperities: Asperities, geometry: TireGeometry, road: RoadPatch, travel: Vector) -> Vector:
    """Resultant [N] for each ``travel`` [m] of the wheel centre inside the block of ``road``; both
    [points].

    Sites lie at whole multiples of the spacing. The push of each follows from the slope of the road
    there, averaged over the width of the standing footprint.
    """
    spacing, half = asperities.spacing, 0.5 * asperities.contact_length
    first = int(numpy.ceil((travel.min() - half) / spacing))
    last = int(numpy.floor((travel.max() + half) / spacing))
    places = numpy.asarray(numpy.arange(first, last + 1) * spacing, dtype=numpy.float64)
    slope = _slopes(geometry, road, places)
    load = asperities.load * asperities.share / FORCE_SHARE
    sites = default_asperities(load, spacing, asperities.contact_length, slope, asperities.raised_cosine)
    moved = travel - (first - 1) * spacing  # the kernel counts its sites from 1
    return numpy.array([asperity_force(sites, position) for position in moved])


def _slopes(geometry: TireGeometry, road: RoadPatch, x: Vector) -> Vector:
    """Slope of the mean profile under the footprint at ``x`` [m]."""
    rows, cols = road.height.shape
    y = (numpy.arange(cols) - 0.5 * (cols - 1)) * road.cell_y
    profile = road.height[:, abs(y) <= geometry.half_width].mean(axis=1, dtype=numpy.float64)
    lattice = (road.first_row + numpy.arange(rows)) * road.cell_x
    return numpy.asarray(numpy.interp(x, lattice, numpy.gradient(profile, road.cell_x)), dtype=numpy.float64)
