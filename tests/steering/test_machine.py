"""States and commands of a steered run, by an injected clock and a run that only counts."""

import pytest

from contact_sim_pkg.steering.machine import Answer, Code, Steering, SteeringState

STOPPED, PLAYING, PAUSED, QUITTING = SteeringState


class Run:
    """Notes what it is called for."""

    def __init__(self, blocks=100):
        self.blocks_left, self.calls, self.over, self.at_start = blocks, [], "", True

    def why_over(self):
        return self.over

    def pause(self, now):
        self.calls.append(("pause", now))

    def resume(self, now):
        self.calls.append(("resume", now))

    def reset(self, now):
        self.calls.append(("reset", now))
        return self.at_start


@pytest.fixture
def run():
    return Run()


@pytest.fixture
def steering(run):
    return Steering(run, clock=lambda: 7.0)


def test_it_starts_stopped_and_plays_pauses_and_plays_again(run, steering):
    assert steering.state is STOPPED
    for state in (PLAYING, PAUSED, PLAYING):
        assert steering.set_state(state).answer == Answer(Code.OK)
        assert (steering.state, steering.plays) == (state, state is PLAYING)
    assert run.calls == [("resume", 7.0), ("pause", 7.0), ("resume", 7.0)]


def test_a_stopped_run_can_begin_paused(run, steering):
    assert steering.set_state(PAUSED).answer == Answer(Code.OK)
    assert steering.step(1).answer is None


@pytest.mark.parametrize("state", [STOPPED, PLAYING, PAUSED])
def test_a_state_that_is_there_already_is_answered_as_such(steering, state):
    steering.set_state(state)
    answer = steering.set_state(state).answer
    assert (answer.code, answer.sentence) == (Code.ALREADY, f"the state is {state.name} already")


@pytest.mark.parametrize(("wanted", "code"), [(4, 0), (5, 0), (6, 103), (255, 103)])
def test_states_of_worlds_are_unsupported_and_others_do_not_exist(run, steering, wanted, code):
    steering.set_state(PLAYING)
    answer = steering.set_state(wanted).answer
    assert int(answer.code) == code
    assert answer.sentence
    assert steering.state is PLAYING


@pytest.mark.parametrize("wanted", [STOPPED, PLAYING, PAUSED])
def test_nothing_follows_quitting(run, steering, wanted):
    steering.set_state(PAUSED)
    step = steering.step(3)
    assert steering.set_state(QUITTING).answer == Answer(Code.OK)
    assert step.answer == Answer(Code.FAILED, "the simulator quits")
    assert steering.set_state(wanted).answer.code is Code.INCORRECT_TRANSITION
    assert steering.set_state(QUITTING).answer.code is Code.ALREADY
    assert steering.reset().answer.code is Code.INCORRECT_STATE
    assert steering.step(1).answer.code is Code.FAILED


def test_a_step_counts_its_blocks_and_answers_with_the_last(run, steering):
    steering.set_state(PAUSED)
    heard, seen = [], []
    command = steering.step(3, on_step=lambda done, left: seen.append((done, left)))
    command.when_done(heard.append)
    while steering.steps:
        assert heard == []
        steering.on_block_done()
    assert heard == [Answer(Code.OK)]
    assert seen == [(1, 2), (2, 1), (3, 0)]
    assert steering.state is PAUSED
    command.when_done(heard.append)
    assert len(heard) == 2
    steering.on_block_done()  # of a run that plays: nobody waits for it
    assert len(heard) == 2


@pytest.mark.parametrize("state", [STOPPED, PLAYING])
def test_a_step_needs_a_pause(steering, state):
    steering.set_state(state)
    assert steering.step(1).answer == Answer(Code.FAILED, f"the state is {state.name}; a step needs PAUSED")


@pytest.mark.parametrize("count", [0, 101])
def test_a_step_is_of_blocks_that_the_scene_has(steering, count):
    steering.set_state(PAUSED)
    answer = steering.step(count).answer
    assert answer == Answer(Code.FAILED, f"steps is {count}; the scene has blocks for 1 to 100")


def test_a_cancelled_step_ends_after_the_block_done_last(steering):
    steering.set_state(PAUSED)
    command = steering.step(50)
    for _ in range(20):
        steering.on_block_done()
    steering.cancel(command)
    assert command.answer == Answer(Code.FAILED, "cancelled after 20 of 50 steps")
    assert not steering.steps
    steering.cancel(command)
    assert steering.set_state(PLAYING).answer.code is Code.OK


def test_one_command_at_a_time(run, steering):
    steering.set_state(PAUSED)
    steering.step(5)
    steering.on_block_done()
    said = "1 of 5 steps are done; one command at a time"
    for command in (steering.step(1), steering.set_state(PLAYING), steering.set_state(STOPPED), steering.reset()):
        assert command.answer == Answer(Code.INCORRECT_STATE, said)
    assert steering.set_state(PAUSED).answer.code is Code.ALREADY


@pytest.mark.parametrize("scope", [0, 1, 2, 3, 255])
def test_a_reset_ends_stopped_once_the_next_run_is_at_its_start(run, steering, scope):
    run.at_start = False
    steering.set_state(PLAYING)
    command = steering.reset(scope)
    assert (command.answer, steering.state) == (None, STOPPED)
    assert run.calls[-2:] == [("pause", 7.0), ("reset", 7.0)]
    assert steering.set_state(PLAYING).answer.sentence == "a reset is under way; one command at a time"
    steering.on_begun_anew()
    assert command.answer == Answer(Code.OK)
    assert steering.set_state(PLAYING).answer == Answer(Code.OK)


def test_a_run_at_its_start_is_reset_at_once_and_stopping_is_a_reset(run, steering):
    assert steering.reset().answer == Answer(Code.OK)
    steering.set_state(PLAYING)
    run.at_start = False
    command = steering.set_state(STOPPED)
    assert (command.answer, run.calls[-1]) == (None, ("reset", 7.0))
    steering.on_end("the disk is full")
    assert command.answer == Answer(Code.FAILED, "the disk is full")


@pytest.mark.parametrize("scope", [4, 5, 8, 254])
def test_a_scope_of_spawned_things_is_unsupported(run, steering, scope):
    answer = steering.reset(scope).answer
    assert answer.code is Code.UNSUPPORTED
    assert answer.sentence == f"scope is {scope}; the bench spawns nothing: 0, 1, 2, 3 or 255"
    assert run.calls == []


def test_a_run_that_is_over_takes_nothing_but_the_end(run, steering):
    steering.set_state(PAUSED)
    run.over = "the run has ended: seat_ride: finished after 3 s"
    for command in (steering.set_state(PLAYING), steering.step(1), steering.reset()):
        assert command.answer == Answer(Code.INCORRECT_STATE, run.over)
    assert steering.set_state(QUITTING).answer.code is Code.OK
