"""Encoded messages as an independent decoder (mcap-ros2-support) reads them, and what is refused."""

import struct
from typing import Any

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.records import Schema
from mcap_ros2.decoder import DecoderFactory

from contact_sim_pkg.bag import messages
from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.bag.typestore import definition
from contact_sim_pkg.excitation.blocks import RoadPatch, VibrationBlock

STAMP = 12_345_678_901
FINITE = st.floats(allow_nan=False, allow_infinity=False)


def independently_decoded(type_name: str, data: bytes) -> Any:
    """The message as mcap-ros2-support reads it by the definition that a bag would carry."""
    schema = Schema(id=1, name=type_name, encoding="ros2msg", data=definition(type_name).encode())
    decode = DecoderFactory().decoder_for("cdr", schema)
    assert decode is not None
    return decode(data)


def road_patch(block: int = 7) -> RoadPatch:
    height = numpy.arange(12, dtype=numpy.float32).reshape(4, 3) / 8
    return RoadPatch(block, 1.25, 1.5, -3, 0.01, 0.02, height)


def patch_field() -> messages.PatchField:
    return messages.PatchField(9, *(0.5 * k for k in range(14)), numpy.arange(6, dtype=numpy.float32).reshape(2, 3))


def motion_block() -> messages.MotionBlock:
    arrays = numpy.arange(12.0).reshape(3, 2, 2)
    return messages.MotionBlock(3, 1e-3, ("wheel_z", "body_z"), *arrays)


def test_a_road_patch_reads_back_by_an_independent_decoder() -> None:
    value = road_patch()
    read = independently_decoded("contact_msgs_defs/msg/RoadPatch", messages.encode_road_patch(value, STAMP))
    assert (read.header.stamp.sec, read.header.stamp.nanosec, read.header.frame_id) == (12, 345_678_901, "bench")
    assert (read.block, read.travel_start, read.travel_end, read.first_row) == value[:4]
    assert (read.rows, read.cols, read.cell_x, read.cell_y) == (4, 3, 0.01, 0.02)
    assert numpy.array_equal(read.height, value.height.ravel())


def test_a_contact_patch_reads_back_by_an_independent_decoder() -> None:
    value = patch_field()
    read = independently_decoded(
        "contact_msgs_defs/msg/ContactPatch", messages.encode_contact_patch(value, STAMP, "tire_contact")
    )
    assert (read.rows, read.cols, read.header.frame_id) == (2, 3, "tire_contact")
    assert [getattr(read, name) for name in value._fields[:-1]] == list(value[:-1])
    assert numpy.array_equal(read.pressure, value.pressure.ravel())


def test_a_motion_block_reads_back_by_an_independent_decoder() -> None:
    value = motion_block()
    read = independently_decoded("contact_msgs_defs/msg/BodyMotion", messages.encode_motion(value, STAMP))
    assert list(read.bodies) == ["wheel_z", "body_z"]
    assert read.samples == 2
    for name in ("position", "velocity", "acceleration"):
        assert numpy.array_equal(getattr(read, name), getattr(value, name).ravel())


def test_a_wrench_reads_back_by_an_independent_decoder() -> None:
    value = messages.Wrench((1.0, 2.0, 3.0), (4.0, 5.0, 6.0))
    read = independently_decoded(
        "geometry_msgs/msg/WrenchStamped", messages.encode_wrench(value, STAMP, "seat_contact")
    )
    assert (read.wrench.force.x, read.wrench.force.y, read.wrench.force.z) == value.force
    assert (read.wrench.torque.x, read.wrench.torque.y, read.wrench.torque.z) == value.torque


@settings(deadline=None)
@given(block=st.integers(0, 2**64 - 1), values=st.lists(FINITE, min_size=6, max_size=6))
def test_an_energy_ledger_reads_back_bit_for_bit(block: int, values: list[float]) -> None:
    data = messages.encode_energy(messages.Energy(block, *values), STAMP)
    read = independently_decoded("contact_msgs_defs/msg/EnergyLedger", data)
    names = messages.Energy._fields
    assert struct.pack("<Q6d", *(getattr(read, name) for name in names)) == struct.pack("<Q6d", block, *values)


@settings(deadline=None)
@given(text=st.text(st.characters(exclude_characters="\0", exclude_categories=("Cs",)), max_size=30))
def test_texts_of_any_length_are_filled_up_to_a_multiple_of_four(text: str) -> None:
    progress = messages.Progress(3, -1, 100, 5, 3.5, 400.0, 2e5, text, "")
    for data in (messages.encode_scene(text), messages.encode_progress(progress, STAMP, text)):
        assert len(data) % 4 == 0
        assert data[:4] == b"\0\1\0\0"
    assert messages.decode_scene(messages.encode_scene(text)) == text
    assert messages.decode_progress(messages.encode_progress(progress, STAMP, text)) == progress


ROUND_TRIPS = {
    "road": (road_patch(), messages.encode_road_patch, messages.decode_road_patch, ()),
    "vibration": (
        VibrationBlock(2, 0.002, numpy.arange(5.0), -numpy.arange(5.0)),
        messages.encode_vibration,
        messages.decode_vibration,
        (),
    ),
    "force": (
        messages.ContactForceBlock(1, 1e-3, *numpy.arange(12.0).reshape(4, 3)),
        messages.encode_contact_force,
        messages.decode_contact_force,
        ("tire_contact",),
    ),
    "patch": (patch_field(), messages.encode_contact_patch, messages.decode_contact_patch, ("tire_contact",)),
    "motion": (motion_block(), messages.encode_motion, messages.decode_motion, ()),
    "wrench": (
        messages.Wrench((1.0, 2.0, 3.0), (4.0, 5.0, 6.0)),
        messages.encode_wrench,
        messages.decode_wrench,
        ("a",),
    ),
    "cost": (
        messages.Cost(4, 0.01, 1.0, 5, 1, 2, 9, 1e-7, 0.5, 7, 2, 3e-3),
        messages.encode_cost,
        messages.decode_cost,
        (),
    ),
    "recorded": (
        messages.Recorded(-1, 7, True, "bags/a", "closed"),
        messages.encode_recorded,
        messages.decode_recorded,
        (),
    ),
}


@pytest.mark.parametrize("name", ROUND_TRIPS)
def test_decoding_gives_back_what_was_encoded(name: str) -> None:
    value, encode, decode, frame = ROUND_TRIPS[name]
    read = decode(encode(value, STAMP, *frame))  # type: ignore[operator]
    assert type(read) is type(value)
    for sent, got in zip(value, read, strict=True):
        assert numpy.array_equal(sent, got)


@pytest.mark.parametrize("name", ROUND_TRIPS)
def test_the_stamp_is_read_without_decoding(name: str) -> None:
    value, encode, _, frame = ROUND_TRIPS[name]
    assert messages.stamp_of(encode(value, STAMP, *frame)) == STAMP  # type: ignore[operator]


def test_the_clock_carries_the_stamp() -> None:
    read = independently_decoded("rosgraph_msgs/msg/Clock", messages.encode_clock(STAMP))
    assert (read.clock.sec, read.clock.nanosec) == (12, 345_678_901)
    assert messages.stamp_of(messages.encode_clock(STAMP)) == STAMP


def test_decoded_arrays_are_fit_for_compiled_code_and_for_change() -> None:
    height = messages.decode_road_patch(messages.encode_road_patch(road_patch(), STAMP)).height
    value = VibrationBlock(2, 0.002, numpy.arange(5.0), numpy.arange(5.0))
    samples = messages.decode_vibration(messages.encode_vibration(value, STAMP, "odd")).acceleration_z
    for array, kind in ((height, numpy.float32), (samples, numpy.float64)):
        assert array.dtype == kind
        assert array.flags.c_contiguous
        assert array.flags.aligned
        assert array.flags.writeable


def test_a_transposed_grid_is_sent_row_by_row() -> None:
    value = road_patch()
    turned = value._replace(height=numpy.asfortranarray(value.height))
    assert messages.encode_road_patch(turned, STAMP) == messages.encode_road_patch(value, STAMP)


def test_a_grid_with_a_wrong_number_of_values_is_refused_with_both_numbers() -> None:
    data = bytearray(messages.encode_road_patch(road_patch(), STAMP))
    rows = data.index(struct.pack("<II", 4, 3))
    data[rows] = 5
    with pytest.raises(MessageError, match=r"block 7 of .*RoadPatch has 12 values for a grid of 5 x 3"):
        messages.decode_road_patch(bytes(data))


@pytest.mark.parametrize("bad", [float("nan"), float("inf"), -float("inf")])
def test_values_that_are_not_finite_are_refused_by_name(bad: float) -> None:
    patch = road_patch()
    patch.height[1, 2] = bad
    with pytest.raises(MessageError, match=r"height of .*RoadPatch, block 7, has 1 value"):
        messages.decode_road_patch(messages.encode_road_patch(patch, STAMP))
    signal = VibrationBlock(4, 0.002, numpy.array([0.0, bad]), numpy.zeros(2))
    with pytest.raises(MessageError, match=r"acceleration_x of .*VibrationBlock, block 4, has 1 value"):
        messages.decode_vibration(messages.encode_vibration(signal, STAMP))


@pytest.mark.parametrize("spacing", [0.0, -0.01, float("nan"), float("inf")])
def test_a_spacing_that_is_not_above_zero_is_refused_by_name(spacing: float) -> None:
    with pytest.raises(MessageError, match=r"cell_y of .*RoadPatch, block 7, is .*above 0"):
        messages.decode_road_patch(messages.encode_road_patch(road_patch()._replace(cell_y=spacing), STAMP))


@settings(deadline=None)
@given(cut=st.integers(0, 1000))
def test_cut_bytes_are_refused_and_never_misread(cut: int) -> None:
    data = messages.encode_road_patch(road_patch(), STAMP)
    with pytest.raises(MessageError):
        messages.decode_road_patch(data[: min(cut, len(data) - 4)])


@settings(deadline=None)
@given(noise=st.binary(max_size=200))
def test_noise_is_refused_or_reads_as_a_valid_block(noise: bytes) -> None:
    try:
        value = messages.decode_vibration(noise)
    except MessageError:
        return
    assert numpy.isfinite(value.acceleration_x).all()


def test_arrays_that_differ_in_length_are_refused_with_their_lengths() -> None:
    force = messages.ContactForceBlock(1, 1e-3, *(numpy.zeros(n) for n in (3, 3, 2, 3)))
    with pytest.raises(MessageError, match=r"approach has 2"):
        messages.encode_contact_force(force, STAMP, "tire_contact")
    motion = motion_block()._replace(velocity=numpy.zeros((2, 3)))
    with pytest.raises(MessageError, match=r"velocity \(2, 3\)"):
        messages.encode_motion(motion, STAMP)


@pytest.mark.parametrize("stamp", [-1, 2**31 * 10**9])
def test_a_stamp_that_ros_cannot_carry_is_refused(stamp: int) -> None:
    with pytest.raises(MessageError, match="allowed: 0 to"):
        messages.encode_road_patch(road_patch(), stamp)


def test_a_number_that_does_not_fit_its_field_is_refused() -> None:
    with pytest.raises(MessageError, match="EnergyLedger cannot be encoded"):
        messages.encode_energy(messages.Energy(-1, *[0.0] * 6), STAMP)
