"""Pace by an injected steady clock (FAULTS C1: the system clock plays no part)."""

import math

import pytest

from contact_sim_pkg.nodes.pacing import Pacer, parse_pace


@pytest.mark.parametrize(("text", "factor"), [("realtime", 1.0), ("max", math.inf), ("2.5", 2.5), (0.5, 0.5)])
def test_a_pace_is_a_word_or_a_factor(text, factor):
    assert parse_pace(text) == factor


@pytest.mark.parametrize("text", ["fast", "0", "-1", "nan", "inf", "1001"])
def test_another_pace_is_refused_with_what_is_allowed(text):
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


def test_at_pace_max_every_block_is_due_at_once():
    pacer = Pacer(math.inf, 0.01)
    pacer.start(100.0)
    assert pacer.wait(10**9, 100.0) == 0.0
