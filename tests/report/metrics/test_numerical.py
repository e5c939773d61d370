"""Numerical errors of metrics, from the estimates of a run."""

import math

import numpy as np
import pytest

from contact_sim_pkg.report.metrics.listing import all_metrics
from contact_sim_pkg.report.metrics.numerical import errors_of, not_resolved
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.run.outputs import Estimate

BLOCKS = np.array([30.0, 40.0, 0.0, 0.0])  # N: with random signs sqrt(30² + 40²) / 4 = 12.5 N of the mean
ESTIMATES = [
    Estimate("tire/force.normal", 40.0, 5000.0), Estimate("tire/patch.peak", 12e3, 600e3),
    Estimate("tire/patch.area", 1e-4, 0.02), Estimate("tire/axle.longitudinal", 30.0, 75.0),
]  # fmt: skip


@pytest.fixture(scope="module")
def recording(car):
    read = read_recording(car)
    topics = [*read.topics, read.topics[0]._replace(name="/tire/axle", type="contact_msgs_defs/msg/AxleForce")]
    blocks = {"tire/force.normal": BLOCKS, "tire/axle.longitudinal": np.array([30.0])}
    return read._replace(
        scene={**read.scene, "accuracy": 1e-2}, topics=topics, estimates=ESTIMATES, block_errors=blocks
    )


def test_a_largest_value_errs_by_its_kind_and_a_mean_by_what_random_signs_leave(recording):
    errors = errors_of(recording)
    assert errors.largest("tire", "force") == pytest.approx(40.0 / 5000.0)
    assert errors.largest("tire", "peak") == pytest.approx(0.02)
    assert errors.largest("tire", "area") == pytest.approx(0.008)  # the force that makes it errs by more than 5e-3
    assert errors.of_mean("tire", "force", 3000.0, 5000.0) == pytest.approx(12.5)
    assert errors.of_mean("motion", "motion", 1.0, 4.0) == pytest.approx(4.0 * 12.5 / 5000.0)
    assert errors.of_column_mean("tire/axle.longitudinal", np.array([-75.0, 5.0])) == 30.0
    assert math.isnan(errors.largest("seat", "force"))
    assert math.isnan(errors_of(recording._replace(scene={}, block_errors={})).of_mean("tire", "force", 3000.0, 5000.0))


def test_what_no_request_makes_smaller_is_a_share_of_the_mean_itself(recording):
    """Of an rms of 1, whatever its largest value; of a column's mean, also where the blocks err by less."""
    scene = {**recording.scene, "rig": "car", "effects": {"seat": {"cushion": {}}, "tire": {"brush": {}}}}
    errors = errors_of(recording._replace(scene=scene))
    assert errors.largest("seat", "force") == pytest.approx(1e-3)
    assert (
        errors.of_mean("seat", "force", 1.0, 5.0) == errors.of_mean("seat", "force", 1.0, 50.0) == pytest.approx(1e-3)
    )
    assert errors.of_column_mean("tire/axle.longitudinal", np.array([-3000.0, 1000.0])) == pytest.approx(30.0)
    assert errors.of_column_mean("tire/axle.longitudinal", np.array([-5000.0, 3000.0])) == pytest.approx(
        1.5e-2 * 4000.0
    )


def test_the_metrics_of_a_run_say_what_they_rest_on(uneven):
    recording = read_recording(uneven)
    recording = recording._replace(
        scene={**recording.scene, "accuracy": 1e-2}, estimates=ESTIMATES[:3], block_errors={"tire/force.normal": BLOCKS}
    )
    found = {each.key: each for each in all_metrics(recording)}
    carried = recording.contacts["tire"].normal
    assert found["tire.load"].error == pytest.approx(12.5 / 5000.0 * carried.max())
    peak = found["tire.peak_pressure"]
    assert (peak.basis, peak.error) == ("event", pytest.approx(0.02 * peak.value))
    assert {each.basis for each in found.values()} <= {"event", "stationary", "state", "self-check"}


def test_a_small_difference_of_large_numbers_is_not_resolved():
    assert not_resolved(0.01, 0.002) == ("not resolved: numerical error 0.002 of 0.01",)
    assert not_resolved(-0.01, 0.0009) == ()
    assert not_resolved(0.01, math.nan) == ()
