"""What a run shows of itself on standard error."""

import sys
from itertools import pairwise
from types import SimpleNamespace

import pytest
from tests.terminal import Terminal

from contact_sim_pkg.cli.output import progress
from contact_sim_pkg.run.offline import RunProgress


@pytest.mark.parametrize(("peak", "shown"), [(0.0, "load 520 N"), (12_345.0, "load 520 N, peak 12.3 kPa")])
def test_a_pressure_is_shown_where_there_is_one(capsys, monkeypatch, peak, shown):
    monkeypatch.setattr(progress, "PLAIN_SECONDS", 0.0)
    with progress.RunDisplay(2.0) as display:
        display.show(RunProgress(50, 200, 0.5, 1.25, 520.0, peak))
    assert capsys.readouterr().err == f"starting\n0.50 of 2 s, 1.25x real time, {shown}\n"


def test_a_paused_replay_shows_its_current_text_and_calls_its_items_messages(capsys, monkeypatch):
    monkeypatch.setattr(progress, "PLAIN_SECONDS", 0.0)
    with progress.RunDisplay(2.0, "waiting for the subscribers", "message") as display:
        display.update(0.5, "9 of 20 messages")
        display.update(0.5, "9 of 20 messages, paused")
    begin, *shown = capsys.readouterr().err.splitlines()
    assert begin == "waiting for the subscribers"
    assert shown == ["9 of 20 messages", "9 of 20 messages, paused; no further message for 0 s"]


def test_elsewhere_than_on_a_terminal_a_line_comes_at_the_first_block_and_every_five_seconds(capsys, monkeypatch):
    now = [0.0]
    monkeypatch.setattr(progress, "time", SimpleNamespace(monotonic=lambda: now[0]))
    printed = []
    display = progress.RunDisplay(100.0)
    monkeypatch.setattr(display, "print_line", lambda line: printed.append((now[0], line)))
    # 40 s before the first block, one block in 30 s, 30 s without a further one
    for half_second in range(1, 200):
        now[0] = 0.5 * half_second
        completed = 0.0 if now[0] < 40.0 else 1.0 if now[0] < 70.0 else 2.0
        display.update(completed, f"{completed} of 100 s" if completed else "compiling")
    times = [0.0, *(at for at, _ in printed), now[0]]
    assert max(later - earlier for earlier, later in pairwise(times)) <= 5.0
    assert len(printed) <= now[0] / 3.0 + 1
    assert (40.0, "1.0 of 100 s") in printed
    assert printed[1][1].startswith("compiling (for ")
    assert printed[-1][1].startswith("2.0 of 100 s; no further block for ")


def test_on_a_terminal_a_bar_is_drawn_on_standard_error_and_removed(capfd, monkeypatch):
    with Terminal() as terminal:
        monkeypatch.setattr(sys, "stderr", terminal.stream)
        monkeypatch.setenv("TERM", "xterm")
        with progress.RunDisplay(10.0) as display:
            display.update(5.0, "5.00 of 10 s")
            display._bar.refresh()
    drawn = terminal.drawn
    assert "5.00 of 10 s" in drawn
    assert "━" in drawn
    assert drawn.rstrip().endswith("\x1b[2K")  # the line is empty again
    assert capfd.readouterr().out == ""
