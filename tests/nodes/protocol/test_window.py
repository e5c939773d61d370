"""Back-pressure from the simulator and from the logger."""

import pytest

from contact_sim_pkg.nodes.protocol.window import BlockWindow


def sent(window: BlockWindow) -> list[int]:
    numbers = []
    while window.open:
        numbers.append(window.next_number())
    return numbers


def test_blocks_up_to_four_ahead_are_sent_before_any_answer():
    assert sent(BlockWindow(100, logged=True)) == [0, 1, 2, 3]


def test_the_slower_of_simulator_and_logger_limits_the_window():
    window = BlockWindow(100, logged=True)
    sent(window)
    window.on_done(9)
    assert sent(window) == []
    window.on_recorded(1)
    assert sent(window) == [4, 5]


def test_without_a_logger_only_the_simulator_counts():
    window = BlockWindow(100, logged=False)
    sent(window)
    window.on_done(0)
    assert sent(window) == [4]


def test_an_older_answer_changes_nothing():
    window = BlockWindow(100, logged=False)
    window.on_done(5)
    window.on_done(2)
    assert sent(window)[-1] == 9


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
