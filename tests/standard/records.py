"""Records with closed forms, and the motion that they come from."""

import numpy

from contact_sim_pkg.records.messages import AxleForce, BodyMotion, ContactPatch

PERIOD = 1e-3  # [s]
RADIUS, PEAK = 0.06, 3.0e5  # [m], [Pa] of a Hertz contact
ROWS, COLS, CELL_X, CELL_Y = 90, 130, 0.002, 0.0015  # [m]
ORIGIN_X, ORIGIN_Y = -0.09, -0.0975  # [m]


def hertz_patch() -> ContactPatch:
    """p = p0 sqrt(1 - (r/a)^2) on a fine grid; load 2 pi a^2 p0 / 3 (Johnson 1985, eq. 4.24)."""
    x = ORIGIN_X + CELL_X * numpy.arange(ROWS)[:, None]
    y = ORIGIN_Y + CELL_Y * numpy.arange(COLS)[None, :]
    pressure = PEAK * numpy.sqrt(numpy.maximum(0.0, 1.0 - (x**2 + y**2) / RADIUS**2))
    return patch_of(pressure, 2.0 * numpy.pi * RADIUS**2 * PEAK / 3.0)


def patch_of(pressure, load=0.0) -> ContactPatch:
    """A patch with these pressures [rows, cols] on the grid above."""
    return ContactPatch(
        block=3, cell_x=CELL_X, cell_y=CELL_Y, origin_x=ORIGIN_X, origin_y=ORIGIN_Y, load=load, peak=PEAK, mean=0.0,
        area=numpy.pi * RADIUS**2, centre_x=0.0, centre_y=0.0, approach=1e-3, lame_a=RADIUS, lame_b=RADIUS, lame_n=2.0,
        pressure=numpy.asarray(pressure, numpy.float32),
    )  # fmt: skip


def motion_of(bodies, position=0.0, velocity=0.0, acceleration=0.0, samples=10) -> BodyMotion:
    """A motion; numbers or [coordinates] hold for all samples, [coordinates, samples] as they are."""

    def rows(values):
        given = numpy.atleast_1d(numpy.asarray(values, float))
        return numpy.ascontiguousarray(
            numpy.broadcast_to(given if given.ndim == 2 else given[:, None], (len(bodies), samples))
        )

    return BodyMotion(
        block=2, sample_period=PERIOD, bodies=tuple(bodies), position=rows(position), velocity=rows(velocity),
        acceleration=rows(acceleration),
    )  # fmt: skip


def axle_of(samples=10, **given) -> AxleForce:
    """A force on the axle: longitudinal -10, -11, ... N, vertical 4000 N."""
    count = numpy.arange(samples, dtype=float)
    return AxleForce(
        block=2, sample_period=PERIOD, longitudinal=-10.0 - count, vertical=numpy.full(samples, 4000.0), **given
    )
