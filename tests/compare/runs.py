"""Outputs of runs made up for the tests, in closed form."""

import numpy

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.records.messages import AxleForce, BodyMotion, ContactForce, ContactPatch

PERIOD = 1e-3  # [s]


def force(normal, tangential=None, stamp=0, topic="tire/force"):
    normal = numpy.asarray(normal, dtype=float)
    along = numpy.zeros_like(normal) if tangential is None else numpy.asarray(tangential, dtype=float)
    zero = numpy.zeros_like(normal)
    record = ContactForce(
        block=0, sample_period=PERIOD, normal=normal, tangential=along, approach=zero, effective_height=zero
    )
    return Output(topic, stamp, record)


def axle(longitudinal, vertical):
    return Output(
        "tire/axle", 0, AxleForce(block=0, sample_period=PERIOD, longitudinal=longitudinal, vertical=vertical)
    )


def motion(position, velocity, acceleration, body="wheel_z"):
    rows = {"position": position, "velocity": velocity, "acceleration": acceleration}
    values = {name: numpy.atleast_2d(numpy.asarray(row, dtype=float)) for name, row in rows.items()}
    return Output("bench/motion", 0, BodyMotion(block=0, sample_period=PERIOD, bodies=(body,), **values))


def patch(peak, area, stamp=0):
    numbers = dict.fromkeys(
        ("origin_x", "origin_y", "load", "mean", "centre_x", "centre_y", "approach", "lame_a", "lame_b", "lame_n"), 0.0
    )
    record = ContactPatch(
        block=0, cell_x=0.01, cell_y=0.02, peak=peak, area=area, pressure=numpy.zeros((2, 2), numpy.float32), **numbers
    )
    return Output("tire/patch", stamp, record)
