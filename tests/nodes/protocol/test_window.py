"""Back-pressure from the simulator and from the logger."""

import pytest

from contact_sim_pkg.nodes.protocol.window import LEAST_SECONDS, MOST_SECONDS, BlockWindow, Gather


def sent(window: BlockWindow) -> list[int]:
    numbers = []
    while window.open:
        numbers.append(window.next_number())
    return numbers


def test_blocks_of_a_window_are_sent_before_any_answer():
    assert sent(BlockWindow(100, logged=True)) == list(range(24))
    assert sent(BlockWindow(100, logged=True, ahead=3)) == [0, 1, 2]


def test_the_slower_of_simulator_and_logger_limits_the_window():
    window = BlockWindow(100, logged=True, ahead=8)
    sent(window)
    window.on_done(19)
    assert sent(window) == []
    window.on_recorded(1)
    assert sent(window) == [8, 9]


def test_without_a_logger_only_the_simulator_counts():
    window = BlockWindow(100, logged=False, ahead=8)
    sent(window)
    window.on_done(0)
    assert sent(window) == [8]


def test_an_older_answer_changes_nothing():
    window = BlockWindow(100, logged=False, ahead=8)
    window.on_done(5)
    window.on_done(2)
    assert sent(window)[-1] == 13


def test_no_block_beyond_the_last_one_is_sent():
    window = BlockWindow(3, logged=True)
    assert sent(window) == [0, 1, 2]
    with pytest.raises(ValueError, match="block 3 may not be sent"):
        window.next_number()


def test_the_window_is_finished_when_both_have_answered_for_the_last_block():
    window = BlockWindow(3, logged=True)
    sent(window)
    window.on_done(2)
    assert not window.finished
    window.on_recorded(2)
    assert window.finished


@pytest.mark.parametrize(
    ("each", "expected"), [(0.004, 0.008), (0.0001, LEAST_SECONDS), (3.0, MOST_SECONDS)], ids=["usual", "fast", "slow"]
)
def test_messages_gather_for_the_time_of_two_blocks_within_bounds(each, expected):
    gather = Gather()
    found = [gather.on_block(block, 100.0 + block * each) for block in (0, 1, 3, 3)]
    assert found[1:] == pytest.approx([expected] * 3, rel=1e-6)
