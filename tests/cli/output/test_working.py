"""A command that prints nothing for a second says on standard error what it does, and stops when it prints."""

import math
import sys
import time

import click
import pytest
from tests.terminal import Terminal

from contact_sim_pkg.cli.main import DISPLAY_THEMSELVES, bench, main
from contact_sim_pkg.cli.output import progress, working
from contact_sim_pkg.cli.output.say import announce, say

LONG = 20.0  # [s] that nothing here takes


@pytest.fixture
def impatient(monkeypatch):
    """A command is silent for too long at once."""
    monkeypatch.delenv(working.SWITCH)
    monkeypatch.setattr(working, "PATIENCE", 0.0)
    monkeypatch.setattr(working, "IN_A_FILE", 0.0)
    monkeypatch.setattr(working, "LOOK", 0.001)
    monkeypatch.setattr(progress, "PLAIN_SECONDS", 0.0)


def until_displayed():
    """Wait for the display, as long work would."""
    ends = time.monotonic() + LONG
    while working._STATE.display is None and time.monotonic() < ends:
        time.sleep(0.001)
    assert working._STATE.display is not None


def test_a_silent_command_says_what_it_does_and_how_far_it_is(capsys, impatient):
    with working.working("bench thing"):
        until_displayed()
        working.doing("thing: the first half", 0.5)
    assert capsys.readouterr().err.startswith("bench thing\nthing: the first half\n")


def test_what_it_prints_ends_the_display_and_nothing_comes_after_its_end(capsys, impatient, monkeypatch):
    with working.working("bench thing"):
        until_displayed()
        monkeypatch.setattr(working, "IN_A_FILE", math.inf)
        say("the answer")
        assert working._STATE.display is None
        capsys.readouterr()
    monkeypatch.setattr(working, "PATIENCE", 0.0)
    monkeypatch.setattr(working, "IN_A_FILE", 0.0)
    time.sleep(0.02)
    assert capsys.readouterr().err == ""


def test_a_line_that_was_told_is_not_said_twice_at_once(capsys, impatient):
    with working.working("bench thing"):
        announce("thing: case 1 of 2")
        time.sleep(0.02)
        assert working._STATE.display is None
    assert "thing: case 1 of 2\n" in capsys.readouterr().err


def test_it_can_be_switched_off(impatient, monkeypatch):
    monkeypatch.setenv(working.SWITCH, "off")
    with working.working("bench thing"):
        time.sleep(0.02)
        assert working._STATE.display is None


def test_a_display_of_its_own_is_alone(impatient):
    with working.working("bench thing"), working.displayed_elsewhere():
        time.sleep(0.02)
        assert working._STATE.display is None


def test_on_a_terminal_it_is_drawn_on_standard_error_and_removed_and_the_answer_goes_to_standard_output(
    capfd, impatient, monkeypatch
):
    with Terminal() as terminal:
        monkeypatch.setattr(sys, "stderr", terminal.stream)
        monkeypatch.setenv("TERM", "xterm")
        with working.working("bench thing"):
            until_displayed()
            sys.stdout.write("the answer\n")
            working._STATE.display._bar.refresh()
    assert "bench thing" in terminal.drawn
    assert "the answer" not in terminal.drawn
    assert capfd.readouterr().out == "the answer\n"


def test_every_command_is_watched_unless_it_displays_itself(monkeypatch):
    monkeypatch.delenv(working.SWITCH)
    watched = []
    for name in bench.list_commands(None):
        with monkeypatch.context() as patch:
            patch.setattr(working, "_watch", lambda _over: watched.append(working._STATE.text))
            patch.setattr(bench, "get_command", lambda _context, name: click.Command(name, callback=lambda: None))
            assert main([name]) == 0
    expected = [f"bench {name}: working" for name in bench.list_commands(None) if name not in DISPLAY_THEMSELVES]
    assert watched == expected
