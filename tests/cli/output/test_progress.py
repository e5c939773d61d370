"""What a run shows of itself on standard error."""

import pytest

from contact_sim_pkg.cli.output import progress
from contact_sim_pkg.run.offline import RunProgress


@pytest.mark.parametrize(("peak", "shown"), [(0.0, "load 520 N"), (12_345.0, "load 520 N, peak 12.3 kPa")])
def test_a_pressure_is_shown_where_there_is_one(capsys, monkeypatch, peak, shown):
    monkeypatch.setattr(progress, "PLAIN_SECONDS", 0.0)
    with progress.RunDisplay(2.0) as display:
        display.show(RunProgress(50, 200, 0.5, 1.25, 520.0, peak))
    assert capsys.readouterr().err == f"0.50 of 2 s, 1.25x real time, {shown}\n"


def test_a_paused_replay_shows_its_current_text_and_calls_its_items_messages(capsys, monkeypatch):
    monkeypatch.setattr(progress, "PLAIN_SECONDS", 0.0)
    with progress.RunDisplay(2.0, "waiting for the subscribers", "message") as display:
        display.update(0.5, "9 of 20 messages")
        display.update(0.5, "9 of 20 messages, paused")
    shown = capsys.readouterr().err.splitlines()
    assert shown == ["9 of 20 messages", "9 of 20 messages, paused; no further message for 0 s"]
