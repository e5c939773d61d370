"""Where published peaks lie, in the transmissibility of a seat that they are of."""

import numpy
import pytest

from contact_sim_pkg.report.drawing import style
from contact_sim_pkg.report.series import MotionSeries, Recording
from contact_sim_pkg.rigs.vehicle.seat.report.section import ride_sections

RATE = 200.0


def ride(**effects):
    """A seat that moves with its floor, in white noise of 30 s."""
    floor = numpy.random.default_rng(7).normal(size=round(30.0 * RATE))
    time = numpy.arange(floor.size) / RATE
    motion = MotionSeries(time, 1.0 / RATE, {}, {"floor_z": floor, "seat_frame_z": floor}, {})
    scene = {"rig": "seat", "effects": {"seat": effects}}
    return Recording("bag", {}, [], {}, [], {}, scene, None, None, None, 30.0)._replace(scene=scene, motion=motion)


@pytest.mark.parametrize(
    ("effects", "shaded"),
    [
        ({}, True),
        ({"suspension": {"stiffness": 1e4}}, False),
        ({"cushion": {"tissue": 2e3, "carrier": "plate"}}, False),
    ],
)
def test_a_seat_on_a_suspension_and_a_hard_one_have_their_peak_elsewhere(effects, shaded):
    with style():
        (section,) = [each for each in ride_sections(ride(**effects)) if each.key == "ride"]
    (picture,) = [each for each in section.pictures if each.name == "ride-transmissibility"]
    assert picture.caption.endswith("Shaded: where textbooks have the peak of car seats with people.") is shaded
