import numpy
import pytest

from comparisons.field import with_ours
from comparisons.field.measure import measure, reference_fields
from comparisons.field.plan import FULL, QUICK, Share, Task
from comparisons.field.problems import hertz, tire
from comparisons.field.solver import OURS, Candidate, NotSolvedError, rolled

OUR_SOLVER = Candidate(OURS, "0", "", with_ours.make)


class Scaled:
    """A stand-in peer: the reference, off by its tolerance; it took a second for tables."""

    untimed = 1.0

    def __init__(self, problem, sequence):
        self.field = reference_fields(problem, 1)[0]

    def reset(self):
        pass

    def solve(self, gap, cells, tolerance):
        if tolerance < 1e-4:
            raise NotSolvedError("it stopped early")
        return self.field * (1.0 + tolerance)


def test_errors_loads_and_times_are_what_the_solver_did():
    shares = {OURS: Share((1e-4, 1e-8), 1, 2), "stand-in": Share((1e-2, 1e-3, 1e-6), 1, 3)}
    task = Task("(a)", lambda _seed: hertz(48), False, (1e-3,), shares)
    rows, set_ups, refused = measure(task, [OUR_SOLVER, Candidate("stand-in", "1", "", Scaled)], lambda _text: None)
    assert [(row.solver, row.tolerance, row.solves) for row in rows] == [
        (OURS, 1e-4, 2),
        (OURS, 1e-8, 2),
        ("stand-in", 1e-2, 3),
        ("stand-in", 1e-3, 3),
    ]
    assert [row.error for row in rows[2:]] == pytest.approx([1e-2, 1e-3], rel=1e-6)
    assert [row.load_error for row in rows[2:]] == pytest.approx([1e-2, 1e-3], rel=1e-6)
    assert rows[1].error < 1e-5
    assert rows[1].load_error < 1e-8
    assert rows[1].closed_form == pytest.approx(0.0, abs=0.03)
    assert all(
        row.wall_ms < -900.0 and row.ms < 0.0 for row in rows[2:]
    )  # what it says it spent on tables is taken off
    assert {one.solver for one in set_ups} == {OURS, "stand-in"}
    assert refused[0] == "(a), stand-in at 1e-06: it stopped early"


def test_a_sequence_is_measured_from_its_third_step_on():
    task = Task("(d)", lambda seed: tire("128x96", seed), True, (1e-3,), {OURS: Share((1e-3,), 2, 6)})
    rows, _, refused = measure(task, [OUR_SOLVER], lambda _text: None)
    assert [(row.seed, row.solves) for row in rows] == [(1, 4), (2, 4)]
    assert all(0.0 < row.error <= row.largest_error < 0.05 for row in rows)
    assert not refused


def test_a_field_is_moved_with_the_road():
    field = numpy.arange(12.0).reshape(4, 3)
    numpy.testing.assert_array_equal(rolled(field, 1)[:3], field[1:])
    assert not rolled(field, 1)[3].any()
    assert rolled(field, 0) is field


@pytest.mark.parametrize("plan", [FULL, QUICK])
def test_every_task_has_three_tolerances_of_ours_and_of_a_peer_that_takes_part(plan):
    assert all(len(share.tolerances) >= 3 for task in plan for share in task.shares.values())
    assert all(OURS in task.shares for task in plan)
