"""What comes in on the excitation topics: taken in order, or dropped, counted and named (FAULTS B1 to B4, B6)."""

import random

import pytest
from tests.nodes.blocks import LENGTH, road, vibration

from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.nodes.protocol.input_blocks import FARTHEST_AHEAD, InputBlocks, check_block

VIBRATION, ROAD = "platform/vibration", "road/patch"


@pytest.fixture
def inputs():
    return InputBlocks([ROAD, VIBRATION], LENGTH, 1000)


def test_blocks_are_released_when_every_input_has_the_next_one(inputs):
    assert inputs.offer(VIBRATION, vibration(0)) == ""
    assert inputs.next_blocks() is None
    assert inputs.offer(ROAD, road(0)) == ""
    taken = inputs.next_blocks()
    assert {topic: block.block for topic, block in taken.items()} == {ROAD: 0, VIBRATION: 0}
    assert inputs.next_blocks() is None


@pytest.mark.fault("B7")
def test_a_missing_block_is_named_with_its_input_and_the_last_good_one(inputs):
    for block in range(3):
        inputs.offer(VIBRATION, vibration(block))
    inputs.offer(ROAD, road(0))
    inputs.next_blocks()
    assert inputs.describe_missing() == "block 1 of road/patch is missing (the last good one was block 0)"


@pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf")])
def test_a_block_with_a_value_that_is_not_finite_is_dropped_and_a_good_one_accepted_later(inputs, value):
    reason = inputs.offer(VIBRATION, vibration(0, value=value))
    assert "platform/vibration" in reason
    assert "NaN or infinite" in reason
    assert inputs.dropped[VIBRATION] == 1
    assert inputs.offer(VIBRATION, vibration(0)) == ""


@pytest.mark.fault("B2")
@pytest.mark.parametrize(("samples", "period"), [(2, 1e-3), (10, 1e-3), (12, 1e-3), (11, 2e-3)])
def test_samples_that_do_not_fill_the_block_are_dropped(inputs, samples, period):
    assert "do not fill a block" in inputs.offer(VIBRATION, vibration(0, samples=samples, period=period))


@pytest.mark.fault("B3")
@pytest.mark.parametrize("value", [1.0e300, 1.0001e4])
def test_a_finite_but_absurd_acceleration_is_dropped(inputs, value):
    assert "allowed: up to 10000 m/s^2" in inputs.offer(VIBRATION, vibration(0, value=value))


@pytest.mark.fault("B3")
def test_an_absurd_road_height_is_dropped(inputs):
    assert "allowed: up to 1000 m" in inputs.offer(ROAD, road(0, height=2e3))


@pytest.mark.fault("B4")
def test_number_and_stamp_must_agree(inputs):
    assert "stamped 0 ns instead of 30000000 ns" in inputs.offer(VIBRATION, vibration(3, stamp=0))


def test_bytes_that_are_no_block_are_dropped(inputs):
    assert inputs.offer(VIBRATION, b"\0\1\0\0 no block") != ""
    assert inputs.offer(VIBRATION, b"") != ""
    assert inputs.dropped[VIBRATION] == 2


def test_a_second_block_of_the_same_number_is_not_mixed_in(inputs):
    inputs.offer(VIBRATION, vibration(0, value=1.0))
    assert "came a second time" in inputs.offer(VIBRATION, vibration(0, value=2.0))
    inputs.offer(ROAD, road(0))
    assert inputs.next_blocks()[VIBRATION].acceleration_z[0] == 1.0
    assert "came a second time" in inputs.offer(VIBRATION, vibration(0))


@pytest.mark.fault("B1")
def test_a_thousand_bad_blocks_leave_no_trace_but_their_count(inputs):
    """FAULTS B1 for numbered blocks; there are no live commands that could be held."""
    for _ in range(1000):
        inputs.offer(VIBRATION, vibration(0, value=float("nan")))
    assert inputs.offer(VIBRATION, vibration(0, value=2.0)) == ""
    inputs.offer(ROAD, road(0))
    assert inputs.next_blocks()[VIBRATION].acceleration_z.tolist() == [2.0] * 11
    assert inputs.dropped == {ROAD: 0, VIBRATION: 1000}


@pytest.mark.fault("B6")
def test_a_burst_is_bounded(inputs):
    reasons = [inputs.offer(VIBRATION, vibration(block)) for block in range(10 * FARTHEST_AHEAD)]
    assert reasons.count("") == FARTHEST_AHEAD
    assert inputs.dropped[VIBRATION] == 9 * FARTHEST_AHEAD


def test_a_block_beyond_the_scene_is_refused():
    with pytest.raises(MessageError, match="none of the scene's blocks 0 to 4"):
        check_block(VIBRATION, vibration(5), LENGTH, 5)


@pytest.mark.fault("B4")
def test_shuffled_and_repeated_blocks_are_released_in_order_once():
    inputs = InputBlocks([VIBRATION], LENGTH, 60)
    numbers = [*range(60), *range(60)]
    random.Random(1).shuffle(numbers)
    taken = []
    for number in numbers:
        inputs.offer(VIBRATION, vibration(number))
        while (blocks := inputs.next_blocks()) is not None:
            taken.append(blocks[VIBRATION].block)
    assert taken == list(range(60))
    assert inputs.dropped[VIBRATION] == 60
