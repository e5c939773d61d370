"""Spans round the events of a scene."""

import pytest

from contact_sim_pkg.compare.events import event_spans
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.resolve import load_resolved


def spans(scene, *values):
    resolved = load_resolved(scene, *values)
    return event_spans(resolved, make_sources(resolved))


def test_a_late_bump_is_passed_in_its_span():
    (found,) = spans("tire_bump", "road={kind: bump, position: 25, height: 0.03, length: 0.6}")
    assert found.reason == "passage of the obstacle"
    # 24.7 to 25.3 m at 10 m/s, 10 ms a block, and 0.1 s before and behind
    assert found.span.shown <= 240 < 247 < 253 < 260 <= found.span.end
    assert found.span.first == found.span.shown - 10


def test_a_longer_obstacle_has_a_longer_span():
    (short,) = spans("tire_bump", "road={kind: bump, position: 15, height: 0.03, length: 0.6}")
    (long,) = spans("tire_bump", "road={kind: bump, position: 15, height: 0.03, length: 4}")
    assert long.span.end - long.span.shown == pytest.approx(short.span.end - short.span.shown + 34, abs=3)


def test_slip_has_its_spans():
    found = spans("tire_braking")
    reasons = {each.reason: each.span for each in found}
    assert reasons["largest slip"].shown <= 150 < reasons["largest slip"].end
    assert reasons["largest slip angle"].end == 300
    assert "steepest place of the road" in reasons


def test_a_shock_is_in_the_span_of_a_seat():
    (found,) = spans("seat_drop", "vibration.start=2.0")
    assert found.reason == "largest acceleration"
    assert found.span.shown <= 205 < found.span.end


def test_a_rig_that_begins_at_the_start_runs_as_much_as_its_work_allows():
    (short,) = spans("seat_shock")
    assert (short.reason, short.span) == ("the whole run", (0, 0, 300))
    (long,) = spans("seat_slap", "duration=3600")
    # 1 ms a block on a usual machine: 10 s of work are some 10 000 blocks of 360 000
    assert long.reason == "from the start"
    assert 9_000 < long.span.end <= 10_000
