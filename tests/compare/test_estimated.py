"""Estimated errors of a recording beside what its scene requested."""

import pytest

from contact_sim_pkg.compare.estimated import above, above_request, accuracy_lines, accuracy_numbers
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.run.outputs import Estimate

ESTIMATES = [
    Estimate("tire/force.normal", 40.0, 5000.0),
    Estimate("tire/axle.longitudinal", 30.0, 75.0),
    Estimate("tire/patch.peak", 12e3, 600e3),
    Estimate("bench/motion.velocity of wheel_z", 0.003, 1.0),
]


@pytest.fixture
def recording(car):
    read = read_recording(car)
    topics = [*read.topics, read.topics[0]._replace(name="/tire/axle", type="contact_msgs_defs/msg/AxleForce")]
    return read._replace(scene={**read.scene, "accuracy": 1e-2}, topics=topics, estimates=ESTIMATES)


def test_a_force_errs_by_its_largest_error_over_the_largest_force(recording):
    numbers = accuracy_numbers(recording)
    assert numbers["requested"] == 1e-2
    assert numbers["estimated"]["tire"] == {"force": pytest.approx(40.0 / 5000.0), "peak": 0.02, "area": None}
    assert numbers["estimated"]["seat"]["force"] is None
    assert numbers["not_resolved"] == {"tire/axle.longitudinal": pytest.approx(0.4)}


def test_bodies_err_by_their_forces_or_by_the_speed_that_these_leave(recording):
    assert accuracy_numbers(recording)["estimated"]["motion"]["motion"] == pytest.approx(0.008)
    faster = recording._replace(estimates=[*ESTIMATES[:3], ESTIMATES[3]._replace(error=0.02)])
    assert accuracy_numbers(faster)["estimated"]["motion"]["motion"] == pytest.approx(0.02)


def test_what_is_above_the_request_is_named_and_what_no_request_moves(recording):
    numbers = accuracy_numbers(recording)
    assert above(numbers) == ["tire peak pressure 2e-2"]
    assert above_request(numbers) == ("estimated above the requested 1e-2: tire peak pressure 2e-2", True)
    floor = {**numbers, "not_below": {"tire": {"peak": [2e-2, "tire something"]}}}
    assert not above_request(floor).is_doubtful
    assert above_request({}) == ("", False)
    scene = {**recording.scene, "rig": "car", "accuracy": 1e-4, "effects": {"seat": {"cushion": {}}}}
    named = above(accuracy_numbers(recording._replace(scene=scene)))
    assert any(each.startswith("seat force, not below 1e-3 with seat cushion") for each in named)
    assert "tire force 8e-3" in named


def test_a_line_says_what_was_requested_and_what_is_estimated(recording):
    lines = accuracy_lines(accuracy_numbers(recording))
    assert lines[0] == (
        "tire force: requested 1e-2, estimated 8e-3; longitudinal not resolved (40 % of its own); "
        "peak pressure: estimated 2e-2 (above); area: not estimated"
    )
    assert lines[-1] == "motion: requested 1e-2, estimated 8e-3"


def test_a_bag_without_a_request_has_no_section(recording):
    assert accuracy_numbers(recording._replace(scene={})) == {}
