"""What a report says beside SEAT and a peak where the record is too short for them."""

import numpy
import pytest

from contact_sim_pkg.report.signal.spectrum import shortage, shortage_of_record
from contact_sim_pkg.rigs.vehicle.seat.report.metrics import vibration_metrics
from contact_sim_pkg.rigs.vehicle.seat.report.ride import RideSignals

RATE = 1000.0


@pytest.mark.parametrize(
    ("seconds", "segments"),
    [(5, 7), (20, 9), (33, 15), (34, 0), (60, 0)],  # half-overlapping segments of 4 s, or fewer ones; 0: enough
)
def test_a_short_record_says_how_few_segments_it_gives(seconds, segments):
    said = shortage_of_record(round(seconds * RATE), RATE)
    assert said.startswith(f"uncertain: {segments} segments of ") if segments else said == ""


def test_the_random_error_that_sixteen_segments_leave_is_six_per_cent():
    """Bendat and Piersol: sqrt(1 - g2) / (|g| sqrt(2 n)) of a magnitude, g2 the coherence."""
    assert shortage(16, 4.0) == ""
    assert shortage(15, 4.0) != ""
    assert shortage(30, 2.0) != ""
    assert numpy.sqrt(0.1 / 0.9 / (2 * 16)) == pytest.approx(0.059, abs=1e-3)


@pytest.mark.parametrize(("seconds", "says"), [(5.0, True), (60.0, False)])
def test_it_stands_beside_seat(seconds, says):
    floor = numpy.random.default_rng(1).normal(size=round(seconds * RATE))
    found = vibration_metrics(RideSignals(numpy.arange(len(floor)) / RATE, RATE, floor, 0.5 * floor))
    (factor,) = (each for each in found if each.name == "SEAT")
    assert any("too short: " in text for text in factor.broken) is says
    assert factor.value == pytest.approx(50.0)
