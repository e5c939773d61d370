"""Pause, stop and the logger's requests as the simulator takes them, by an injected steady clock."""

from types import SimpleNamespace

import pytest

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.nodes.protocol import progress_report
from contact_sim_pkg.nodes.protocol.progress_report import ProgressReport
from contact_sim_pkg.nodes.protocol.simulated_run import SimulatedRun
from contact_sim_pkg.nodes.protocol.states import STOPPED_BY_USER, NodeError, RunState
from contact_sim_pkg.records.messages import BenchProgress, BenchRecorded

DONE = SimpleNamespace(messages=(1, 2, 3), load=512.0, peak_pressure=0.0)  # a block
SCENE = SimpleNamespace(name="block_slip", blocks=1000, block_length_ns=10_000_000, block_length=0.01)


class Run:
    """A run without inputs at half of real time."""

    def __init__(self, monkeypatch, *, logged=True):
        self.now = 100.0
        monkeypatch.setattr(progress_report.time, "monotonic", lambda: self.now)
        self.sent: list[BenchProgress] = []
        publisher = SimpleNamespace(publish=lambda data: self.sent.append(decode(BenchProgress, data)))
        report = ProgressReport(publisher, SCENE)
        self.resets = []
        simulation = SimpleNamespace(inputs=(), blocks=SCENE.blocks, reset=lambda: self.resets.append(self.now))
        self.run = SimulatedRun(simulation, report, SCENE, 0.5, logged=logged, input_timeout=5.0)

    def advance(self, seconds):
        """Do what is due; answers of the logger come at once."""
        end = self.now + seconds
        while self.now < end:
            if self.run.may_begin(self.now):
                number, _ = self.run.next_block()
                self.run.on_done(number, DONE, self.now)
                self.run.on_recorded(answer(number), self.now)
            self.now = min(end, self.now + 0.001)
        return self.states()[-1]

    def states(self):
        return [RunState(each.state) for each in self.sent]

    @property
    def blocks(self):
        return self.sent[-1].block + 1


def answer(block, *, closed=False, message="", run=0):
    return BenchRecorded(run=run, block=block, messages=max(0, 3 * block), closed=closed, bag="bag", message=message)


@pytest.fixture
def begun(monkeypatch):
    made = Run(monkeypatch)
    made.run.start(made.now)
    assert made.advance(1.0) is RunState.RUNNING
    assert made.blocks == 50
    return made


def test_a_paused_run_reports_it_and_goes_on_at_its_pace(begun):
    begun.run.pause(begun.now)
    assert begun.advance(20.0) is RunState.PAUSED
    assert (begun.blocks, begun.sent[-1].message) == (50, "paused")
    begun.run.resume(begun.now)
    assert begun.states()[-2:] == [RunState.PAUSED, RunState.RUNNING]
    begun.run.refuse_standstill(begun.now)  # nobody has delayed it
    begun.advance(1.0)
    assert begun.blocks == 100
    assert begun.sent[-1].real_time_factor == pytest.approx(0.5, rel=0.02)
    assert begun.run.late == ""
    with pytest.raises(NodeError, match=r"waited 5.02 s"):
        begun.run.refuse_standstill(begun.now + 6.0)


def test_only_a_run_under_way_pauses_and_only_a_paused_one_goes_on(monkeypatch):
    made = Run(monkeypatch)
    made.run.pause(made.now)
    assert made.sent == []
    made.run.start(made.now)
    made.run.resume(made.now)
    made.run.pause(made.now)
    made.run.pause(made.now)
    assert made.states() == [RunState.READY, RunState.PAUSED]
    assert made.run.stop(made.now) is None
    made.run.resume(made.now)
    made.run.pause(made.now)
    assert made.states()[2:] == [RunState.STOPPED]


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("paused", [False, True])
def test_a_logger_that_the_user_ends_ends_the_run_as_a_signal_does(begun, closed, paused):
    if paused:
        begun.run.pause(begun.now)
    assert begun.run.on_recorded(answer(49, closed=closed, message=STOPPED_BY_USER), begun.now) == ""
    assert (begun.states()[-1], begun.sent[-1].message) == (RunState.STOPPED, STOPPED_BY_USER)
    assert begun.run.logger.status_to_leave(begun.now) == (0 if closed else None)
    begun.run.on_recorded(answer(49, closed=True, message=""), begun.now)
    assert begun.run.logger.status_to_leave(begun.now) == 0


def test_a_logger_that_closes_its_bag_for_another_reason_is_a_loss(begun):
    reason = f"{STOPPED_BY_USER}; the disk is full"
    assert begun.run.on_recorded(answer(49, closed=True, message=reason), begun.now) == reason
    assert begun.run.logger.status_to_leave(begun.now) == 3


def test_before_ready_a_request_counts_only_from_a_logger_without_a_bag(monkeypatch):
    made = Run(monkeypatch)
    made.run.report.send(RunState.STARTING)
    made.run.on_recorded(answer(12, closed=True, message=STOPPED_BY_USER), made.now)  # of another bench
    made.run.on_recorded(answer(-1, message=STOPPED_BY_USER), made.now)
    assert made.states() == [RunState.STARTING]
    made.run.on_recorded(answer(-1, closed=True, message=STOPPED_BY_USER), made.now)
    assert made.states() == [RunState.STARTING, RunState.STOPPED]
    assert made.run.logger.status_to_leave(made.now) == 0


def step(made, count):
    """Do blocks of a paused run."""
    for _ in range(count):
        assert made.run.may_step()
        number, _ = made.run.next_block()
        made.run.on_done(number, DONE, made.now)
        made.run.on_recorded(answer(number, run=made.run.report.number), made.now)


def test_blocks_of_a_step_stay_paused_and_are_neither_caught_up_nor_waited_for(begun):
    assert not begun.run.may_step()
    begun.run.pause(begun.now)
    begun.advance(12.0)
    step(begun, 30)
    assert (begun.states()[-1], begun.blocks) == (RunState.PAUSED, 80)
    begun.run.refuse_standstill(begun.now)
    begun.run.resume(begun.now)
    begun.advance(1.0)
    assert begun.blocks == pytest.approx(130, abs=1)
    assert begun.run.late == ""


def test_a_reset_waits_for_the_bag_and_begins_the_next_run_paused(begun):
    assert not begun.run.reset(begun.now)
    assert (begun.states()[-1], begun.run.why_over()) == (
        RunState.RESET, "the run has ended: block_slip: reset after 0.5 s, 0.5x real time",
    )  # fmt: skip
    assert begun.run.logger.deserted
    assert begun.run.on_recorded(answer(49, closed=True, message="reset"), begun.now) == ""
    assert not begun.run.logger.deserted
    begun.run.begin_anew(begun.now)
    assert begun.resets == [begun.now]
    assert begun.states()[-2:] == [RunState.READY, RunState.PAUSED]
    assert (begun.sent[-1].run, begun.blocks, begun.sent[-1].messages_sent, begun.run.blocks_left) == (1, 0, 0, 1000)
    assert begun.run.reset(begun.now)  # at its start already
    begun.run.on_recorded(answer(49, closed=True), begun.now)  # of the run before
    step(begun, 3)
    assert (begun.sent[-1].run, begun.blocks, begun.sent[-1].messages_sent) == (1, 3, 9)


def test_a_run_that_has_ended_is_not_reset_again(begun):
    begun.run.stop(begun.now)
    assert begun.run.why_over().startswith("the run has ended: block_slip: stopped")
