"""Who holds a run up, and how long the simulator stays after it."""

import pytest
from tests.nodes.blocks import LENGTH, vibration

from contact_sim_pkg.nodes.protocol.input_blocks import InputBlocks
from contact_sim_pkg.nodes.protocol.logger_answers import CLOSE_SECONDS, STOP_SECONDS, LoggerAnswers
from contact_sim_pkg.nodes.protocol.window import BlockWindow
from contact_sim_pkg.records.messages import BenchRecorded

VIBRATION = "platform/vibration"


class Run:
    """A run of 100 blocks whose logger answers for those up to `recorded`."""

    def __init__(self, done: int, recorded: int, *, logged: bool = True):
        self.window = BlockWindow(100, logged=logged, ahead=8)
        self.answers = LoggerAnswers(self.window, logged=logged)
        self.inputs = InputBlocks([VIBRATION], LENGTH, 100)
        if recorded >= 0:
            self.answers.accept(
                BenchRecorded(run=0, block=recorded, messages=5 * recorded, closed=False, bag="bag", message="")
            )
        for block in range(done + 1):
            self.inputs.offer(VIBRATION, vibration(block))
            self.inputs.next_blocks()
            self.window.next_number()
            self.window.on_done(block)

    def who(self) -> str:
        return self.answers.cause_of_delay(self.inputs)


def test_a_logger_that_does_not_answer_is_named_and_the_source_that_waits_for_it_is_not():
    printed = Run(done=12, recorded=4).who()
    assert printed.startswith("the logger has not answered for block 5")
    assert VIBRATION not in printed


@pytest.mark.fault("B5")
def test_a_source_that_stops_is_named_while_the_logger_answers():
    assert (
        Run(done=12, recorded=9).who() == "block 13 of platform/vibration is missing (the last good one was block 12)"
    )
    assert "block 3 of platform/vibration" in Run(done=2, recorded=-1, logged=False).who()


def test_after_the_end_the_simulator_stays_until_the_bag_is_closed():
    run = Run(done=12, recorded=12)
    run.answers.end(5.0)
    assert run.answers.status_to_leave(5.0) is None
    run.answers.accept(BenchRecorded(run=0, block=12, messages=60, closed=True, bag="bag", message=""))
    assert run.answers.status_to_leave(5.0) == 0


@pytest.mark.parametrize(("stopped", "seconds"), [(False, CLOSE_SECONDS), (True, STOP_SECONDS)])
def test_a_logger_that_never_closes_is_waited_for_shortly_after_a_signal(stopped, seconds):
    run = Run(done=12, recorded=12)
    run.answers.end(5.0, stopped=stopped)
    assert run.answers.status_to_leave(4.9 + seconds) is None
    assert run.answers.status_to_leave(5.1 + seconds) == 1


def test_the_reason_of_a_bag_closed_before_the_end_is_handed_on_once():
    run = Run(done=2, recorded=1)
    assert run.answers.accept(BenchRecorded(run=0, block=2, messages=10, closed=False, bag="bag", message="")) is None
    assert (
        run.answers.accept(
            BenchRecorded(run=0, block=2, messages=10, closed=True, bag="bag", message="the disk is full")
        )
        == "the disk is full"
    )
    assert (
        run.answers.accept(
            BenchRecorded(run=0, block=2, messages=10, closed=True, bag="bag", message="the disk is full")
        )
        is None
    )
