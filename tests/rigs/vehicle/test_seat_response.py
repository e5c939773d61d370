"""Responses of the seat while a run goes on: against the linear model, the report, and any length of block."""

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.block_encoder import Output, encode_block
from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.records.messages import BodyMotion, ContactForce, SeatResponse
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.signal.metrics import ride_metrics
from contact_sim_pkg.report.signal.spectrum import transmissibility
from contact_sim_pkg.rigs.vehicle.seat.biodynamics import apparent_mass, seat_to_head, seat_transmissibility
from contact_sim_pkg.rigs.vehicle.seat.occupants import OCCUPANTS
from contact_sim_pkg.rigs.vehicle.seat.report.occupant import apparent_mass_of, occupant_signals, seat_to_head_of
from contact_sim_pkg.rigs.vehicle.seat.report.ride import ride_signals
from contact_sim_pkg.rigs.vehicle.seat.response import RunningResponse
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.run.outputs import BlockStamps
from contact_sim_pkg.run.rigs import result_topics
from contact_sim_pkg.run.scene_outputs import outputs_of, records_of
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.timing import Timing

TOPIC = "seat/response"
STIFFNESS, DAMPING = 5e4, 500.0  # [N/m], [N s/m] of a linear cushion
LINEAR = (
    f"effects.seat={{normal_elastic: {{coefficient: {STIFFNESS}, exponent: 1}}, "
    f"general_dissipative: {{coefficient: {DAMPING}, approach_exponent: 0, rate_exponent: 1}}}}"
)
NOISE = "vibration={kind: noise, low: 0.5, high: 20, rms: 1.0}"
CHAIN = "seat.occupant.model=boileau_rakheja"
NAMES = ("transmissibility", "apparent_mass", "seat_to_head")


def complex_of(record, name):
    """A response as one complex number a frequency."""
    return getattr(record, name) * numpy.exp(1j * getattr(record, f"{name}_phase"))


def test_the_responses_are_those_of_the_linear_model():
    last = records_of(outputs_of("seat_ride", 120.0, NOISE, LINEAR, CHAIN, "seat.response_segment=16"), TOPIC)[-1]
    model, frequency = OCCUPANTS["boileau_rakheja"], last.frequency
    expected = (
        seat_transmissibility(model, frequency, STIFFNESS, DAMPING),
        apparent_mass(model, frequency),
        seat_to_head(model, frequency),
    )
    assert last.segments == 14
    for name, closed in zip(NAMES, expected, strict=True):
        trusted = (getattr(last, f"{name}_coherence") > 0.95) & (last.floor_density > 1e-3 * last.floor_density.max())
        assert trusted.sum() > 300
        numpy.testing.assert_allclose(complex_of(last, name)[trusted], closed[trusted], rtol=1e-2)


@pytest.fixture(scope="module")
def ride(tmp_path_factory):
    """Recorded ride of a minute with the default segments."""
    folder = tmp_path_factory.mktemp("ride") / "bag"
    run_offline(resolved("seat_ride", NOISE, LINEAR, CHAIN, "duration=60"), folder)
    return open_bag(folder)


def test_the_last_message_has_the_numbers_of_the_report(ride):
    recording = read_recording(ride)
    signals, floor = occupant_signals(recording), ride_signals(recording.motion).floor
    last = decode(SeatResponse, list(ride.messages(TOPIC))[-1].data)
    shown = (
        transmissibility(floor, signals.seat, signals.sample_rate),
        apparent_mass_of(signals),
        seat_to_head_of(signals),
    )
    for name, report in zip(NAMES, shown, strict=True):
        assert last.segments == report.segments
        inside = slice(1, 1 + len(last.frequency))
        numpy.testing.assert_allclose(last.frequency, report.frequency[inside], rtol=1e-12)
        for column, expected in (
            (getattr(last, name), report.magnitude),
            (getattr(last, f"{name}_phase"), report.phase),
            (getattr(last, f"{name}_coherence"), report.coherence),
        ):
            numpy.testing.assert_allclose(column, expected[inside], rtol=1e-9, atol=1e-9)


def test_seat_is_that_of_the_time_series_but_for_the_windows(ride):
    signals = ride_signals(read_recording(ride).motion)
    floor, seat = (ride_metrics(each, signals.sample_rate).weighted_rms for each in (signals.floor, signals.seat))
    last = decode(SeatResponse, list(ride.messages(TOPIC))[-1].data)
    assert last.floor_weighted_rms == pytest.approx(floor, rel=0.02)
    assert last.seat_weighted_rms == pytest.approx(seat, rel=0.02)
    assert last.seat_factor == pytest.approx(100.0 * seat / floor, rel=0.01)


def test_a_message_comes_with_every_segment_from_the_second_on(ride):
    messages = list(ride.messages(TOPIC))
    records = [decode(SeatResponse, message.data) for message in messages]
    assert [record.segments for record in records] == list(range(2, 30))
    assert {record.segment_length for record in records} == {4.0}
    # the last sample of a segment of 4 s that begins every 2 s
    ends = [2.0 * record.segments + 2.0 - 1e-3 for record in records]
    assert [message.log_time * 1e-9 for message in messages] == pytest.approx(ends, abs=1e-9)
    assert [record.block for record in records] == [int(end / 0.01) for end in ends]
    assert (records[0].frequency[0], records[0].frequency[-1]) == (0.25, 80.0)


TIMES = numpy.arange(4000) * 1e-3


def responses_in_blocks(samples, head):
    """Messages of one ride of noise in blocks of so many samples at 1 kHz, as stamps and records without `block`."""
    acceleration, force = numpy.random.default_rng(1).normal(size=(4, 4000)), 500.0 + 50.0 * numpy.sin(30.0 * TIMES)
    running = RunningResponse(0.8, 1000.0, head)
    timing = Timing(samples * 1e-3, 4000 // samples, 1, samples, 1, 1, 1)
    found = []
    for block in range(timing.blocks):
        part, stamps = slice(block * samples, (block + 1) * samples), BlockStamps(block, timing)
        none, zeros = numpy.zeros((4, samples)), numpy.zeros(samples)
        given = [
            Output("seat/force", stamps.start, ContactForce(
                block=block, sample_period=1e-3, normal=force[part], tangential=zeros, approach=zeros, effective_height=zeros,
            )),
            Output("bench/motion", stamps.start, BodyMotion(
                block=block, sample_period=1e-3, bodies=("floor_z", "seat_frame_z", "occupant1_z", "occupant2_z"),
                position=none, velocity=none, acceleration=acceleration[:, part],
            )),
        ]  # fmt: skip
        found += running.outputs(stamps, given)
    encode_block(found)
    return [(each.stamp, [numpy.asarray(value).tobytes() for value in each.record[1:]]) for each in found]


@pytest.mark.parametrize("head", [None, 2])
@pytest.mark.parametrize("samples", [1, 10, 500, 4000])
def test_the_length_of_blocks_changes_no_bit(samples, head):
    found = responses_in_blocks(samples, head)
    assert len(found) == 8
    assert found == responses_in_blocks(100, head)


def test_a_model_without_a_head_leaves_its_columns_empty():
    last = records_of(outputs_of("seat_ride", 0.5), TOPIC)[-1]
    assert len(last.seat_to_head) == len(last.seat_to_head_phase) == len(last.seat_to_head_coherence) == 0
    assert len(last.apparent_mass) == len(last.frequency) > 0


def test_a_floor_at_rest_has_no_response():
    last = records_of(outputs_of("seat_ride", 1.0, "vibration={kind: sine, frequency: 4, amplitude: 0}"), TOPIC)[-1]
    assert last.floor_weighted_rms == 0.0
    assert numpy.isnan(last.seat_factor)
    assert numpy.isnan(last.transmissibility).all()


AT_REST = "vibration={kind: sine, frequency: 4, amplitude: 0}"
FORWARD = "vibration={kind: sine, axis: x, frequency: 4, amplitude: 1}"


@pytest.mark.parametrize(
    ("scene", "values"),
    [
        ("seat_ride", (AT_REST,)),
        ("seat_ride", (FORWARD,)),
        ("seat_ride_full", (AT_REST, "seat.occupant.model=iso_5982")),
    ],
)
def test_a_seat_that_moves_by_rounding_alone_has_no_response(scene, values):
    last = records_of(outputs_of(scene, 1.0, *values), TOPIC)[-1]
    assert last.seat_weighted_rms < 1e-9
    for name in NAMES:
        for part in ("", "_phase", "_coherence"):
            assert numpy.isnan(getattr(last, name + part)).all()


def test_a_run_of_less_than_two_segments_publishes_none(tmp_path):
    outcome = run_offline(resolved("seat_ride", "duration=0.5", "seat.response_segment=0.4"), tmp_path / "bag")
    bag = open_bag(tmp_path / "bag")
    assert outcome.failure == ""
    assert f"/{TOPIC}" in bag.topics
    assert bag.count(TOPIC) == 0


def test_a_scene_leaves_the_topic_out():
    scene = resolved("seat_ride", "seat.response_segment=0")
    assert TOPIC not in result_topics(scene)
    assert TOPIC in result_topics(resolved("seat_ride"))
    assert records_of(outputs_of("seat_ride", 0.5, "seat.response_segment=0"), TOPIC) == []


@pytest.mark.parametrize(("duration", "segment"), [(60.0, 4.0), (18.0, 4.0), (9.0, 2.0), (0.01, 0.1)])
def test_the_default_segment_gives_a_run_eight_segments_or_more(duration, segment):
    scene = resolved("seat_ride", f"duration={duration}")
    assert scene.data["seat"]["response_segment"] == pytest.approx(segment, abs=1e-12)


@pytest.mark.parametrize("segment", ["0.09", "300"])
def test_a_segment_too_short_or_too_long_is_refused(segment):
    with pytest.raises(SceneError, match=rf"response_segment.*{segment} s is outside 0.1 to 262.1\d* s at 1000 Hz"):
        resolved("seat_ride", f"seat.response_segment={segment}")


def test_pan_and_seat_back_together_have_a_response_of_the_pan():
    found = records_of(outputs_of("seat_ride_full", 1.0, "seat.response_segment=0.4"), TOPIC)
    assert [record.segments for record in found] == [2, 3, 4]
    assert found[-1].seat_weighted_rms > 0.0
