"""What is told of an excitation before a run."""

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.run.sources import make_vibration


def notes(*values):
    return make_vibration(resolved("seat_slap", *values)).describe()["notes"]


def test_a_sine_that_its_samples_follow_to_the_accuracy_has_no_note():
    assert notes() == []
    assert notes("accuracy=1e-6", "vibration.sample_rate=12500") == []
    assert notes("accuracy=realtime") == []


@pytest.mark.parametrize(("values", "rate"), [(["accuracy=1e-6"], 12_500), (["vibration.frequency=40"], 4000)])
def test_the_largest_gap_between_a_sine_and_its_straight_lines_is_reported_with_the_cure(values, rate):
    (note,) = notes(*values)
    frequency = 40.0 if rate == 4000 else 5.25
    time = numpy.linspace(0.0, 1e-3, 2001) - 0.5e-3  # about a crest
    sine = numpy.cos(2.0 * numpy.pi * frequency * time)
    off = float((sine - sine[0]).max())
    assert f"up to {off:.2g} of its amplitude off" in note
    assert f"vibration.sample_rate: {rate} leaves" in note
    assert notes(*values, f"vibration.sample_rate={rate}") == []
