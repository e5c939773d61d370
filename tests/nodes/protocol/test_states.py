"""How a node tells its own run from another bench on the same topics."""

import pytest

from contact_sim_pkg.nodes.protocol.states import Follower, NodeError, RecordedFollower, RunState
from contact_sim_pkg.nodes.protocol.window import AHEAD
from contact_sim_pkg.records.messages import BenchProgress, BenchRecorded


def report(state: RunState, block: int, run: int = 0) -> BenchProgress:
    return BenchProgress(
        state=int(state),
        run=run,
        block=block,
        blocks=100,
        messages_sent=0,
        real_time_factor=0.0,
        load=0.0,
        peak_pressure=0.0,
        scene="seat_ride",
        message="",
    )


def test_a_run_is_followed_from_its_start_to_its_end():
    follower = Follower()
    steps = [
        (RunState.STARTING, -1),
        (RunState.READY, -1),
        (RunState.RUNNING, 0),
        (RunState.RUNNING, 7),
        (RunState.FINISHED, 99),
    ]
    assert all(follower.accept(report(*step)) for step in steps)
    assert follower.state is RunState.FINISHED


def test_a_run_under_way_is_another_bench():
    with pytest.raises(
        NodeError, match=r"another bench \(scene seat_ride, block 57 of 100\) .* ROS_DOMAIN_ID"
    ) as refusal:
        Follower().accept(report(RunState.RUNNING, 57))
    assert refusal.value.exit_status == 2


def test_a_run_that_got_further_than_the_window_without_this_node_is_another_bench():
    follower = Follower()
    follower.accept(report(RunState.STARTING, -1))
    with pytest.raises(NodeError, match="another bench"):
        follower.accept(report(RunState.RUNNING, AHEAD))


def test_ready_may_have_been_overwritten_by_the_first_blocks():
    follower = Follower()
    follower.accept(report(RunState.STARTING, -1))
    assert follower.accept(report(RunState.RUNNING, AHEAD - 1))


@pytest.mark.parametrize("state", [RunState.STARTING, RunState.READY, RunState.FAILED, RunState.STOPPED])
def test_a_second_bench_that_starts_beside_a_run_is_passed_over(state):
    follower = Follower()
    follower.accept(report(RunState.READY, -1))
    follower.accept(report(RunState.RUNNING, 12))
    assert not follower.accept(report(state, -1))
    assert follower.state is RunState.RUNNING


def test_a_run_may_pause_again_and_again_and_go_on():
    follower = Follower()
    steps = [(RunState.STARTING, -1), (RunState.READY, -1), (RunState.PAUSED, -1), (RunState.RUNNING, -1),
             (RunState.RUNNING, 7), (RunState.PAUSED, 7), (RunState.RUNNING, 7), (RunState.PAUSED, 9)]  # fmt: skip
    for step in steps:
        assert follower.accept(report(*step))
        assert follower.state is step[0]
        assert follower.state.under_way == (step[0] is not RunState.STARTING)
        assert not follower.state.ended
    assert not follower.accept(report(RunState.READY, 9))
    assert follower.accept(report(RunState.STOPPED, 9))
    assert follower.state.ended


def test_a_paused_run_that_this_node_did_not_see_begin_is_another_bench():
    with pytest.raises(NodeError, match="another bench"):
        Follower().accept(report(RunState.PAUSED, -1))


def test_nothing_follows_the_end():
    follower = Follower()
    follower.accept(report(RunState.READY, -1))
    follower.accept(report(RunState.STOPPED, 3))
    assert not follower.accept(report(RunState.RUNNING, AHEAD))


def test_an_answer_of_the_logger_that_lies_behind_is_passed_over():
    follower = RecordedFollower()
    assert follower.accept(BenchRecorded(run=0, block=5, messages=60, closed=False, bag="bags/a", message=""))
    assert not follower.accept(BenchRecorded(run=0, block=-1, messages=0, closed=True, bag="bags/b", message=""))
    assert follower.accept(BenchRecorded(run=0, block=5, messages=60, closed=True, bag="bags/a", message="done"))
    assert (follower.closed, follower.bag, follower.message) == (True, "bags/a", "done")


def test_a_reset_ends_a_run_and_the_next_one_is_followed_from_its_start():
    follower = Follower()
    for state, block in ((RunState.READY, -1), (RunState.RUNNING, 40), (RunState.RESET, 40)):
        assert follower.accept(report(state, block))
    assert follower.state.ended
    assert not follower.accept(report(RunState.RUNNING, 41))
    assert follower.accept(report(RunState.READY, -1, run=1))
    assert (follower.number, follower.block, follower.state) == (1, -1, RunState.READY)
    assert not follower.accept(report(RunState.RUNNING, 60))  # of the run before
    assert follower.accept(report(RunState.RUNNING, 3, run=1))
    assert follower.accept(report(RunState.PAUSED, 2, run=2))  # the report of the reset was overwritten
    assert (follower.number, follower.block) == (2, 2)


def test_a_node_that_joins_behind_a_reset_belongs_to_no_run():
    with pytest.raises(NodeError, match="another bench"):
        Follower().accept(report(RunState.READY, -1, run=1))


def test_answers_of_the_logger_are_those_of_their_run():
    follower = RecordedFollower()
    assert follower.accept(BenchRecorded(run=0, block=5, messages=60, closed=True, bag="bags/a", message=""))
    assert follower.accept(BenchRecorded(run=1, block=-1, messages=1, closed=False, bag="bags/a_2", message=""))
    assert (follower.block, follower.closed, follower.bag) == (-1, False, "bags/a_2")
    assert not RecordedFollower(2).accept(
        BenchRecorded(run=1, block=9, messages=99, closed=True, bag="bags/a_2", message="")
    )
