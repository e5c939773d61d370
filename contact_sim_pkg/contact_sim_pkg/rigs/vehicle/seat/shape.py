"""The lower surface of a seated occupant, as the gap over a flat cushion: two buttocks and two
thighs.

Each is a paraboloid (buttock: radius R_b about the tuberosity) or a parabolic cylinder (thigh:
radius R_t, from below the tuberosity forwards), raised by ``thigh_rise``; the surface is the lower
envelope. x forward, y left, z up.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.rigs.vehicle.seat.schema import Body


class SeatShape(NamedTuple):
    """Sizes of the shape."""

    buttock_spacing: float  # [m] between the lowest points of the two buttocks
    buttock_radius: float  # [m]
    thigh_radius: float  # [m]
    thigh_length: float  # [m] forward of the lowest points
    thigh_rise: float  # [m] of the thighs' lowest line over the buttocks' lowest points


def shape_of(body: Body) -> SeatShape:
    """Sizes of a scene's body."""
    return SeatShape(body.buttock_spacing, body.buttock_radius, body.thigh_radius, body.thigh_length, body.thigh_rise)


def seat_gap(shape: SeatShape, x: NDArray[numpy.float64], y: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
    """Height [m] of the occupant's lower surface over its lowest point, at x and y [m].

    Shape [rows, cols] for x [rows] and y [cols].
    """
    side = numpy.abs(y)[None, :] - 0.5 * shape.buttock_spacing
    along = x[:, None]
    buttock = (along**2 + side**2) / (2.0 * shape.buttock_radius)
    beyond = numpy.maximum(along - shape.thigh_length, 0.0) + numpy.maximum(-along, 0.0)
    thigh = shape.thigh_rise + (side**2 + beyond**2) / (2.0 * shape.thigh_radius)
    return numpy.minimum(buttock, thigh)


def seat_gap_on(shape: SeatShape, settings: FieldSettings) -> NDArray[numpy.float64]:
    """Gap [rows, cols] [m] of the occupant over the flat cushion on the cells of a grid."""
    return seat_gap(shape, *seat_cells(settings))


def seat_cells(settings: FieldSettings) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]:
    """Cell centres [m] of the seat's grid: x [rows] forward from the tuberosities, y [cols] to the
    left.

    The tuberosities lie 0.3 of the length from its back.
    """
    rows, cols = numpy.arange(settings.rows, dtype=float), numpy.arange(settings.cols, dtype=float)
    x = (rows + 0.5) * settings.cell_x - 0.3 * settings.rows * settings.cell_x
    y = (cols - 0.5 * (settings.cols - 1)) * settings.cell_y
    return x, y
