import pytest

from contact_sim_lab.goals import goals as benchmark
from contact_sim_lab.goals import laws as benchmark_core
from contact_sim_lab.laws import seat_slap
from contact_sim_lab.records.goal import GoalPart, Measured


@pytest.mark.parametrize(
    ("found", "goal", "reached"),
    [
        (Measured("a", 1.0, "s", most=2.0), "≤ 2", True),
        (Measured("a", 3.0, "s", most=2.0), "≤ 2", False),
        (Measured("a", 3.0, "x", least=3.0), "≥ 3", True),
        (Measured("a", 2.9, "x", least=3.0), "≥ 3", False),
        (Measured("a", None, "x", least=3.0), "≥ 3", None),
        (Measured("a", 1.0, "x"), "", None),
    ],
)
def test_a_figure_is_held_against_its_goal(found, goal, reached):
    assert (found.goal, found.reached) == (goal, reached)


def test_a_missed_goal_and_one_that_was_not_measured_are_shown(monkeypatch):
    parts = (
        GoalPart("machine", lambda: [Measured(benchmark.BUSY, 0.1, "")]),
        GoalPart(
            "part", lambda: [Measured("slow", 3.0, "s", most=2.0, note="why"), Measured("gone", None, "s", most=2.0)]
        ),
        GoalPart("part", lambda: [Measured("good", 1.0, "s", most=2.0), Measured("beside", 1.0, "s")]),
    )
    monkeypatch.setattr(benchmark, "parts", lambda: parts)
    goals, beside = benchmark.sections(benchmark.study())
    assert [row["reached"] for row in goals.rows] == ["NO", "not measured", "yes"]
    assert goals.note.splitlines() == ["1 of 3 goals reached", "slow: why"]
    assert [row["what"] for row in beside.rows] == [benchmark.BUSY, "beside"]


def test_the_goals_of_error_are_reached():
    rows = [*benchmark_core.steel(), *benchmark_core.stick_slip()]
    assert all(row.reached for row in rows), rows


def test_a_run_that_is_right_by_chance_is_not_the_cheapest():
    errors = (1e-4, 1e-9, 1e-6, 2e-9, 1e-10)
    work = [seat_slap.SlapCost("a", 10.0**-i, error, float(i + 1)) for i, error in enumerate(errors)]
    assert seat_slap.cheapest(work, 1e-8) == work[3]
    assert seat_slap.cheapest(work, 1e-11) is None
    assert seat_slap.cheapest(work, 1.0) == work[0]
