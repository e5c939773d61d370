"""How a run ended is in its bag: state, blocks, who died of what, what never came."""

from contact_sim_pkg.nodes.protocol.record_outcome import UNREPORTED, outcome_of
from contact_sim_pkg.nodes.protocol.states import Follower, RunState
from contact_sim_pkg.records.messages import BenchProgress


def followed(*states: RunState, message: str = "") -> Follower:
    run = Follower()
    for block, state in enumerate(states, start=-1):
        run.accept(
            BenchProgress(
                state=int(state),
                run=0,
                block=block,
                blocks=100,
                messages_sent=0,
                real_time_factor=0.0,
                load=0.0,
                peak_pressure=0.0,
                scene="seat_ride",
                message=message,
            )
        )
    return run


def test_a_run_that_finished_has_no_failure():
    outcome = outcome_of(followed(RunState.READY, RunState.FINISHED), 100, counts={"dropped road/patch": 0})
    assert outcome == {"ended": "finished", "blocks_done": "100", "failure": ""}


def test_the_end_of_a_node_is_the_failure_whatever_the_simulator_reported():
    reason = "vibration was ended by SIGKILL; it said nothing"
    outcome = outcome_of(followed(RunState.READY, RunState.STOPPED, message="stopped by the user"), 7, reason=reason)
    assert outcome == {"ended": "failed", "blocks_done": "7", "failure": reason}


def test_a_fault_that_the_simulator_names_is_the_failure():
    outcome = outcome_of(followed(RunState.READY, RunState.FAILED, message="block 3 is missing"), 3)
    assert (outcome["ended"], outcome["failure"]) == ("failed", "block 3 is missing")


def test_a_recording_names_a_simulator_that_fell_silent():
    outcome = outcome_of(followed(RunState.READY, RunState.RUNNING), 1)
    assert (outcome["ended"], outcome["failure"]) == ("stopped", UNREPORTED)


def test_missing_messages_and_those_left_out_are_counted():
    outcome = outcome_of(followed(RunState.READY, RunState.FINISHED), 97, lacking=3, counts={"foreign road/patch": 12})
    assert outcome["lacking"] == "3 messages of the blocks done never came"
    assert outcome["foreign road/patch"] == "12"
