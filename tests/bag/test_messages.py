"""Encoded messages as an independent decoder (mcap-ros2-support) reads them, and what is refused."""

import struct
from types import SimpleNamespace
from typing import Any

import numpy
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mcap.records import Schema
from mcap_ros2.decoder import DecoderFactory
from tests.bench_process import PACKAGE

from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.bag.excitation import decode_road, decode_vibration
from contact_sim_pkg.bag.messages import decode, encode, record_of, stamp_of
from contact_sim_pkg.bag.typestore import definition, installed_types
from contact_sim_pkg.records import messages as records
from contact_sim_pkg.records.definitions import definition_of
from contact_sim_pkg.records.messages import (
    BenchProgress,
    BenchRecorded,
    BodyMotion,
    Clock,
    ContactForce,
    ContactPatch,
    ContactPoints,
    EnergyLedger,
    RoadPatch,
    SolverCost,
    String,
    Time,
    VibrationBlock,
)
from contact_sim_pkg.run.outputs import wrench_of

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
    return RoadPatch(
        block=block, travel_start=1.25, travel_end=1.5, first_row=-3, cell_x=0.01, cell_y=0.02, height=height
    )


def patch_field() -> ContactPatch:
    numbers = {name: 0.5 * k for k, name in enumerate(ContactPatch._fields)}
    pressure = numpy.arange(6, dtype=numpy.float32).reshape(2, 3)
    return ContactPatch(**numbers | {"block": 9, "pressure": pressure})


def motion_block() -> BodyMotion:
    position, velocity, acceleration = numpy.arange(12.0).reshape(3, 2, 2)
    bodies = ("wheel_z", "body_z")
    return BodyMotion(
        block=3, sample_period=1e-3, bodies=bodies, position=position, velocity=velocity, acceleration=acceleration
    )


def test_a_road_patch_reads_back_by_an_independent_decoder() -> None:
    value = road_patch()
    read = independently_decoded("contact_msgs_defs/msg/RoadPatch", encode(value, STAMP))
    assert (read.header.stamp.sec, read.header.stamp.nanosec, read.header.frame_id) == (12, 345_678_901, "bench")
    assert (read.block, read.travel_start, read.travel_end, read.first_row) == (7, 1.25, 1.5, -3)
    assert (read.rows, read.cols, read.cell_x, read.cell_y) == (4, 3, 0.01, 0.02)
    assert numpy.array_equal(read.height, value.height.ravel())


def test_a_contact_patch_reads_back_by_an_independent_decoder() -> None:
    value = patch_field()
    read = independently_decoded("contact_msgs_defs/msg/ContactPatch", encode(value, STAMP, "tire_contact"))
    assert (read.rows, read.cols, read.header.frame_id) == (2, 3, "tire_contact")
    for name in set(value._fields) - {"pressure"}:
        assert getattr(read, name) == getattr(value, name)
    assert numpy.array_equal(read.pressure, value.pressure.ravel())


def test_a_motion_block_reads_back_by_an_independent_decoder() -> None:
    value = motion_block()
    read = independently_decoded("contact_msgs_defs/msg/BodyMotion", encode(value, STAMP))
    assert list(read.bodies) == ["wheel_z", "body_z"]
    assert read.samples == 2
    for name in ("position", "velocity", "acceleration"):
        assert numpy.array_equal(getattr(read, name), getattr(value, name).ravel())


def test_a_wrench_reads_back_by_an_independent_decoder() -> None:
    value = wrench_of((1.0, 2.0, 3.0), (4.0, 5.0, 6.0))
    read = independently_decoded("geometry_msgs/msg/WrenchStamped", encode(value, STAMP, "seat_contact"))
    assert (read.wrench.force.x, read.wrench.force.y, read.wrench.force.z) == value.wrench.force
    assert (read.wrench.torque.x, read.wrench.torque.y, read.wrench.torque.z) == value.wrench.torque


@given(block=st.integers(0, 2**64 - 1), values=st.lists(FINITE, min_size=6, max_size=6))
def test_an_energy_ledger_reads_back_bit_for_bit(block: int, values: list[float]) -> None:
    given = dict(zip(EnergyLedger._fields, (block, *values), strict=True))
    data = encode(EnergyLedger(**given), STAMP)
    read = independently_decoded("contact_msgs_defs/msg/EnergyLedger", data)
    assert struct.pack("<Q6d", *(getattr(read, name) for name in given)) == struct.pack("<Q6d", block, *values)


@given(text=st.text(st.characters(exclude_characters="\0", exclude_categories=("Cs",)), max_size=30))
def test_texts_of_any_length_are_filled_up_to_a_multiple_of_four(text: str) -> None:
    progress = BenchProgress(
        state=3,
        run=0,
        block=-1,
        blocks=100,
        messages_sent=5,
        real_time_factor=3.5,
        load=400.0,
        peak_pressure=2e5,
        scene=text,
        message="",
    )
    for data in (encode(String(data=text)), encode(progress, STAMP, text)):
        assert len(data) % 4 == 0
        assert data[:4] == b"\0\1\0\0"
    assert decode(String, encode(String(data=text))).data == text
    assert decode(BenchProgress, encode(progress, STAMP, text)) == progress


def force_block(**columns: Any) -> ContactForce:
    given = {name: numpy.arange(3.0) for name in ("normal", "tangential", "approach", "effective_height")}
    return ContactForce(block=1, sample_period=1e-3, **given | columns)


def vibration_block(block: int = 2, **columns: Any) -> VibrationBlock:
    given = {"acceleration_x": numpy.arange(5.0), "acceleration_z": -numpy.arange(5.0)}
    return VibrationBlock(block=block, sample_period=0.002, **given | columns)


ROUND_TRIPS = {
    "road": road_patch(),
    "vibration": vibration_block(),
    "force": force_block(),
    "force with impulses": force_block(impulses=numpy.ones(3)),
    "patch": patch_field(),
    "motion": motion_block(),
    "wrench": wrench_of((1.0, 2.0, 3.0), (4.0, 5.0, 6.0)),
    "cost": SolverCost(
        block=4, wall_time=0.01, real_time_factor=1.0, steps=5, field_residual=1e-7, coupling_steps_repeated=2
    ),
    "recorded": BenchRecorded(run=0, block=-1, messages=7, closed=True, bag="bags/a", message="closed"),
}


@pytest.mark.parametrize("name", ROUND_TRIPS)
def test_decoding_gives_back_what_was_encoded(name: str) -> None:
    value = ROUND_TRIPS[name]
    read = decode(type(value), encode(value, STAMP, "tire_contact"))
    assert type(read) is type(value)
    for field in value._fields:
        assert numpy.array_equal(getattr(read, field), getattr(value, field))


def example(name: str) -> Any:
    """A record of a message with every field given: sides of arrays are 3 long, columns 4."""
    definition = definition_of(name)
    values: dict[str, Any] = {}
    for k, field in enumerate(definition.record_fields):
        if not field.is_array:
            values[field.name] = "text" if field.type == "string" else k % 2
        elif field.type == "string":
            values[field.name] = ("a", "", "üb", "abc")[: 3 if field.name in definition.sides else 4]
        else:
            shape = (3,) * len(field.shape) or (3 if field.name in definition.sides else 4,)
            values[field.name] = numpy.arange(numpy.prod(shape)).reshape(shape).astype(field.type)
    return getattr(records, name)(**values)


@pytest.mark.parametrize("frame", ["", "a", "ab", "abc", "abcd", "abcde", "abcdef", "abcdefg"])
@pytest.mark.parametrize("name", sorted(path.stem for path in (PACKAGE / "contact_sim_pkg" / "msg").glob("*.msg")))
def test_the_bytes_are_those_of_rosbags(name: str, frame: str) -> None:
    data = encode(example(name), STAMP, frame)
    type_name, types = definition_of(name).type_name, installed_types()
    theirs = bytes(types.serialize_cdr(types.deserialize_cdr(data, type_name), type_name))
    assert data == theirs + bytes(-len(theirs) % 4)


@pytest.mark.parametrize("name", ROUND_TRIPS)
def test_the_stamp_is_read_without_decoding(name: str) -> None:
    assert stamp_of(encode(ROUND_TRIPS[name], STAMP, "tire_contact")) == STAMP


def test_the_clock_carries_the_stamp() -> None:
    read = independently_decoded("rosgraph_msgs/msg/Clock", encode(Clock(clock=Time(sec=12, nanosec=345_678_901))))
    assert (read.clock.sec, read.clock.nanosec) == (12, 345_678_901)
    assert stamp_of(encode(Clock(clock=Time(sec=12, nanosec=345_678_901)))) == STAMP


def test_decoded_arrays_are_fit_for_compiled_code_and_for_change() -> None:
    height = decode_road(encode(road_patch(), STAMP)).height
    samples = decode_vibration(encode(vibration_block(), STAMP, "odd")).acceleration_z
    for array, kind in ((height, numpy.float32), (samples, numpy.float64)):
        assert array.dtype == kind
        assert array.flags.c_contiguous
        assert array.flags.aligned
        assert array.flags.writeable


def test_a_transposed_grid_is_sent_row_by_row() -> None:
    value = road_patch()
    turned = value._replace(height=numpy.asfortranarray(value.height))
    assert encode(turned, STAMP) == encode(value, STAMP)


def test_a_grid_with_a_wrong_number_of_values_is_refused_with_both_numbers() -> None:
    data = bytearray(encode(road_patch(), STAMP))
    rows = data.index(struct.pack("<II", 4, 3))
    data[rows] = 5
    with pytest.raises(MessageError, match=r"block 7 of .*RoadPatch has 12 values of height for 5 rows x 3 cols"):
        decode_road(bytes(data))


@pytest.mark.parametrize("bad", [float("nan"), float("inf"), -float("inf")])
def test_values_that_are_not_finite_are_refused_by_name(bad: float) -> None:
    patch = road_patch()
    patch.height[1, 2] = bad
    with pytest.raises(MessageError, match=r"height of .*RoadPatch, block 7, has 1 value"):
        decode_road(encode(patch, STAMP))
    signal = vibration_block(4, acceleration_x=numpy.array([0.0, bad]), acceleration_z=numpy.zeros(2))
    with pytest.raises(MessageError, match=r"acceleration_x of .*VibrationBlock, block 4, has 1 value"):
        decode_vibration(encode(signal, STAMP))


@pytest.mark.parametrize("spacing", [0.0, -0.01, float("nan"), float("inf")])
def test_a_spacing_that_is_not_above_zero_is_refused_by_name(spacing: float) -> None:
    with pytest.raises(MessageError, match=r"cell_y of .*RoadPatch, block 7, is .*above 0"):
        decode_road(encode(road_patch()._replace(cell_y=spacing), STAMP))


@given(cut=st.integers(0, 1000))
def test_cut_bytes_are_refused_and_never_misread(cut: int) -> None:
    data = encode(road_patch(), STAMP)
    with pytest.raises(MessageError):
        decode_road(data[: min(cut, len(data) - 4)])


@given(noise=st.binary(max_size=200))
def test_noise_is_refused_or_reads_as_a_valid_block(noise: bytes) -> None:
    try:
        value = decode_vibration(noise)
    except MessageError:
        return
    assert numpy.isfinite(value.acceleration_x).all()


def test_arrays_that_differ_in_length_are_refused_with_their_lengths() -> None:
    with pytest.raises(MessageError, match=r"approach has 2"):
        encode(force_block(approach=numpy.zeros(2)), STAMP, "tire_contact")
    with pytest.raises(MessageError, match=r"impulses has 2"):
        encode(force_block(impulses=numpy.zeros(2)), STAMP, "tire_contact")
    motion = motion_block()._replace(velocity=numpy.zeros((2, 3)))
    with pytest.raises(MessageError, match=r"velocity \(2, 3\)"):
        encode(motion, STAMP)


@pytest.mark.parametrize("stamp", [-1, 2**31 * 10**9])
def test_a_stamp_that_ros_cannot_carry_is_refused(stamp: int) -> None:
    with pytest.raises(MessageError, match="allowed: 0 to"):
        encode(road_patch(), stamp)


def test_a_number_that_does_not_fit_its_field_is_refused() -> None:
    with pytest.raises(MessageError, match="EnergyLedger cannot be encoded"):
        encode(EnergyLedger(**dict.fromkeys(EnergyLedger._fields, 0.0) | {"block": -1}), STAMP)


def test_reals_are_no_whole_numbers() -> None:
    points = dict.fromkeys(ContactPoints._fields, numpy.zeros(2)) | {"block": 1}
    with pytest.raises(MessageError, match=r"ContactPoints cannot be encoded: .*float64.*uint8"):
        encode(ContactPoints(**points), STAMP)


def test_a_field_that_an_older_bag_lacks_has_its_default_and_no_other_may_be_missing() -> None:
    columns = {name: numpy.arange(3.0) for name in ("normal", "tangential", "approach", "effective_height")}
    older = SimpleNamespace(block=1, sample_period=1e-3, **columns)
    assert record_of(ContactForce, older).impulses.shape == (0,)
    del older.normal
    with pytest.raises(AttributeError, match="normal"):
        record_of(ContactForce, older)
