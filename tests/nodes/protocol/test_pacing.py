"""Pace by an injected steady clock (FAULTS C1: the system clock plays no part)."""

import math

import pytest

from contact_sim_pkg.nodes.protocol.pacing import Lateness, Pacer, RateLimit, parse_pace


@pytest.mark.parametrize(("text", "factor"), [("realtime", 1.0), ("max", math.inf), ("2.5", 2.5), (0.5, 0.5)])
def test_a_pace_is_a_word_or_a_factor(text, factor):
    assert parse_pace(text) == factor


@pytest.mark.parametrize("text", ["fast", "0", "-1", "nan", "inf", "1001"])
def test_another_pace_is_refused_with_the_allowed_ones(text):
    with pytest.raises(ValueError, match=r"allowed: realtime, max, or a factor from 0.001 to 1000"):
        parse_pace(text)


def test_nothing_is_due_before_the_start():
    assert Pacer(math.inf, 0.01).wait(0, 5.0) == math.inf


@pytest.mark.fault("C1")
def test_at_half_pace_a_block_of_10_ms_is_due_every_20_ms():
    pacer = Pacer(0.5, 0.01)
    pacer.start(100.0)
    assert pacer.wait(0, 100.0) == 0.0
    assert pacer.wait(3, 100.01) == pytest.approx(0.05)


@pytest.mark.fault("C3")
def test_a_late_run_catches_up_from_the_first_start():
    pacer = Pacer(1.0, 0.01)
    pacer.start(100.0)
    pacer.start(200.0)
    assert pacer.wait(50, 100.6) == 0.0


def test_behind_a_pause_blocks_are_due_as_much_later_as_it_lasted():
    pacer = Pacer(2.0, 0.01)
    pacer.start(100.0)
    lateness = Lateness(pacer)
    for now in (100.5, 101.0):  # the second call changes nothing
        pacer.pause(now)
    assert pacer.wait(101, 200.0) == math.inf
    pacer.resume(140.5)
    pacer.resume(150.0)
    assert pacer.wait(100, 140.5) == 0.0
    assert pacer.wait(104, 140.5) == pytest.approx(0.02)
    assert lateness.block_done(103, 140.52, 1.0) == ""
    assert lateness.late == 0


def test_at_pace_max_every_block_is_due_at_once():
    pacer = Pacer(math.inf, 0.01)
    pacer.start(100.0)
    assert pacer.wait(10**9, 100.0) == 0.0


@pytest.fixture
def lateness():
    pacer = Pacer(1.0, 0.01)
    pacer.start(100.0)
    return Lateness(pacer)


@pytest.mark.fault("C3")
def test_blocks_done_late_are_counted_and_reported_after_a_hundred_in_a_row(lateness):
    printed = [lateness.block_done(block, 100.0 + 0.016 * (block + 1), 0.625) for block in range(140)]
    late = [block for block in range(140) if 0.016 * (block + 1) > 0.01 * (block + 2)]
    assert lateness.late == len(late)
    assert [block for block, text in enumerate(printed) if text] == late[99:]
    assert (
        printed[-1] == f"slower than its pace: 0.62x real time, 0.83 s behind after block 139 ({len(late)} blocks late)"
    )


@pytest.mark.fault("C3")
def test_a_constant_delay_is_called_one_and_the_pace_held(lateness):
    """A source that began 0.5 s late, and a run that stood still for 1 s; each delay stays as it is from then on."""
    printed = [lateness.block_done(block, 100.51 + 0.01 * (block + 1), 1.0) for block in range(1000)]
    assert printed[98] == ""
    assert printed[99] == "held with a constant delay, 0.5 s behind after block 99 (100 blocks late)"
    stood = [lateness.block_done(block, 101.51 + 0.01 * (block + 1), 0.9) for block in range(1000, 3000)]
    assert stood[0] == "slower than its pace: 0.9x real time, 1.5 s behind after block 1000 (1001 blocks late)"
    assert stood[-1] == "held with a constant delay, 1.5 s behind after block 2999 (3000 blocks late)"


@pytest.mark.fault("C3")
def test_a_run_one_in_two_hundred_too_slow_is_called_slow_in_the_end(lateness):
    printed = [lateness.block_done(block, 100.5 + 0.01005 * (block + 1), 0.995) for block in range(1000)]
    assert "slower than its pace" in printed[-1]


@pytest.mark.fault("C3")
def test_a_run_that_has_caught_up_is_not_late_any_more(lateness):
    assert all(not lateness.block_done(block, 105.0, 0.1) for block in range(99))
    assert lateness.block_done(99, 101.01, 1.0) == ""
    assert lateness.block_done(100, 105.0, 0.1) == ""
    assert lateness.late == 100


def test_without_a_pace_nothing_is_late():
    pacer = Pacer(math.inf, 0.01)
    pacer.start(100.0)
    lateness = Lateness(pacer)
    assert all(not lateness.block_done(block, 1e6, 0.1) for block in range(50))
    assert lateness.late == 0


def passed(rate, times, early=0.0):
    limit = RateLimit(rate, early)
    return [time for time in times if limit.passes("tire/patch", time)]


@pytest.mark.parametrize(("rate", "count"), [(20.0, 200), (100.0, 1000), (3.0, 30)])
def test_of_a_hundred_messages_a_second_the_rate_passes_on_average(rate, count):
    assert len(passed(rate, [0.01 * number for number in range(1000)], early=0.002)) == pytest.approx(count, abs=1)


def test_a_batch_that_comes_a_little_early_is_none_less():
    batches = [0.05 * number - 0.01 * (number % 2) for number in range(200)]  # every second one 10 ms early
    assert len(passed(20.0, batches, early=0.025)) == 200


def test_a_gap_is_not_made_up_for_by_a_burst():
    times = [*(0.01 * number for number in range(100)), *(30.0 + 0.001 * number for number in range(100))]
    assert len([time for time in passed(20.0, times) if time >= 30.0]) <= 3  # 0.1 s at 20 Hz, and one


def test_each_topic_has_a_rate_of_its_own():
    limit = RateLimit(20.0, 0.0)
    assert [limit.passes(topic, 1.0) for topic in ("a", "b", "a")] == [True, True, False]
