import pytest

from comparisons.field.measure import Row
from comparisons.field.plan import Share, Task
from comparisons.field.readings import AIMS, readings, verdicts
from comparisons.field.solver import OURS
from comparisons.field.table import reading_lines, verdict_lines

AIM = next(aim for aim in AIMS if aim.solver == "ASPHER" and aim.error == 1e-3)
TASK = Task(
    AIM.task, lambda _seed: None, False, (1e-3, 1e-9), {OURS: Share((1.0,), 2, 9), "ASPHER": Share((1.0,), 1, 9)}
)


def row(solver, seed, error, ms):
    return Row(AIM.task, solver, seed, 1.0, error, 3.0 * error, 0.0, ms, 2.0 * ms, ms, 9, None)


ROWS = [
    row(OURS, 1, 1e-2, 1.0),
    row(OURS, 1, 1e-4, 4.0),
    row(OURS, 2, 1e-2, 10.0),
    row(OURS, 2, 1e-4, 10.0),
    row("ASPHER", 1, 1e-2, 5.0),
    row("ASPHER", 1, 1e-4, 20.0),
]


def test_times_are_read_at_equal_error_and_ratios_are_those_of_the_same_seed():
    found = {(one.solver, one.error): one for one in readings(TASK, ROWS)}
    assert found[OURS, 1e-3].ms == pytest.approx(6.0)  # median of 2 and 10
    assert found["ASPHER", 1e-3].ms == pytest.approx(10.0)
    assert found["ASPHER", 1e-3].ms_95 == pytest.approx(20.0)
    assert found["ASPHER", 1e-3].ratio == pytest.approx(5.0)
    assert found[OURS, 1e-3].largest_error == pytest.approx(3e-3)
    assert found["ASPHER", 1e-9].ms is None
    assert found["ASPHER", 1e-9].ratio is None


def test_a_long_tail_of_errors_counts():
    assert row(OURS, 1, 1e-3, 1.0).counted_error == 1e-3
    assert row(OURS, 1, 1e-3, 1.0)._replace(largest_error=6e-3).counted_error == pytest.approx(2e-3)
    late = [one._replace(largest_error=30.0 * one.error) if one.solver == "ASPHER" else one for one in ROWS]
    (found,) = (one for one in readings(TASK, late) if one.solver == "ASPHER" and one.error == 1e-3)
    assert found.ms == pytest.approx(20.0)  # a tenth of the asked error at the median


def test_verdicts_name_what_was_reached():
    (verdict,) = (one for one in verdicts(readings(TASK, ROWS)) if one.aim == AIM)
    assert verdict.measured == pytest.approx(5.0)
    assert verdict.goal_reached is True
    text = "\n".join(verdict_lines([verdict, verdict._replace(goal_reached=None)]))
    assert "ASPHER / ours, at least" in text
    assert "yes" in text
    assert "–" in text


def test_our_own_time_is_an_upper_bound():
    aim = next(aim for aim in AIMS if aim.solver == OURS)
    rows = [one._replace(task=aim.task) for one in ROWS[:4]]
    task = TASK._replace(name=aim.task, asked=(aim.error,))
    (verdict,) = (one for one in verdicts(readings(task, rows)) if one.aim == aim)
    assert verdict.measured > aim.goal
    assert verdict.goal_reached is False


def test_tables_are_markdown():
    head, rule, *lines = reading_lines(readings(TASK, ROWS))
    assert head.count("|") == rule.count("|") == lines[0].count("|")
    assert len(lines) == 4
    assert verdict_lines([]) == []
