"""`bench hard --accuracy`: marks, table and exit code; the cases are scenes that can be run."""

import pytest

from contact_sim_lab.hard import accuracy_table
from contact_sim_lab.hard.accuracy_cases import CASES, AccuracyCase
from contact_sim_lab.hard.accuracy_table import failed, mark_of, rows_of, sections, study
from contact_sim_pkg.compare.first_look import FirstLook, Request
from contact_sim_pkg.compare.least_errors import LeastError, least_errors
from contact_sim_pkg.scene.resolve import load_resolved

BRUSH = {"force": LeastError(1.5e-2, "tire brush")}
BLOCK = AccuracyCase("jam", "a slipping block jams", "block_painleve", ("duration=0.1",))


def run(requested, force_error, motion_error=0.0, **estimated):
    return Request(requested, {"force": force_error, "motion": motion_error}, (), estimated, 10.0, None, False)


@pytest.mark.parametrize(
    ("request_", "least", "mark", "names"),
    [
        (run(1e-2, 1e-2, 9e-3), {}, "held", ""),
        (run(1e-2, 2e-2, force=1.2e-2), {}, "named", "force estimated 1.2e-2"),
        (run(1e-2, 2e-2, force=9e-3), {}, "missed", ""),
        (run(1e-2, 2e-2, force=9e-3), BRUSH, "named", "force not below 1.5e-2 with tire brush"),
        (run(1e-1, 2e-1, force=9e-3), BRUSH, "missed", ""),
        # Bodies move by the forces on them, and not the other way
        (run(1e-2, 0.0, 2e-2, force=3e-2), {}, "named", "motion estimated 3e-2"),
        (run(1e-2, 2e-2, 0.0, motion=3e-2), {}, "missed", ""),
        (run(1e-2, 2e-2, 2e-2, force=9e-3, motion=3e-2), {}, "missed", ""),
    ],
)
def test_an_error_above_the_request_is_named_by_kind_or_missed(request_, least, mark, names):
    assert mark_of(request_, least) == (mark, names)


def test_a_run_that_ends_is_named_by_its_sentence_and_the_table_counts_the_marks():
    runs = (run(1e-1, 5e-2), run(1e-2, 2e-2, force=3e-2), run(1e-4, 2e-2))
    look = FirstLook("block_painleve", runs, 0.0, 0.1, 3e-5, 10.0, (), ((1e-3, "block 3: the step is too long"),))
    rows = [{**row, "scene_cpu_s": 7.0} for row in rows_of(BLOCK, look, {})]
    assert [row["mark"] for row in rows] == ["held", "named", "named", "missed"]
    assert rows[2]["names"] == "block 3: the step is too long"
    assert rows[0]["cpu_s"] == pytest.approx(1.0)  # of 10 s per simulated second
    [section] = sections(rows)
    assert section.rows == [
        {
            "scene": "jam",
            "1e-1": "5e-2 held",
            "1e-2": "2e-2 named",
            "1e-3": "named",
            "1e-4": "2e-2 missed",
            "CPU s": "7",
        }
    ]
    assert section.note == "held 1 of 4; named 2; missed 1; 7 CPU s"
    assert failed(rows)
    assert not failed([{**row, "mark": "held"} if row["requested"] < 1e-1 else row for row in rows])


def test_a_case_is_run_with_its_values_and_says_so_at_once():
    lines = []
    rows = study(lines.append, (BLOCK,))
    assert lines[0] == "1 of 1: jam: a slipping block jams"
    assert [row["requested"] for row in rows] == [1e-1, 1e-2, 1e-3, 1e-4]
    assert all(row["mark"] == "held" and row["end_s"] == pytest.approx(0.1) for row in rows)


def test_a_scene_that_is_refused_is_named_by_the_sentence_and_one_without_a_finer_run_is_missed(monkeypatch):
    refused = BLOCK._replace(values=("block.mass=-1",))
    rows = study(lambda _line: None, (refused,))
    assert all(row["mark"] == "named" and "block.mass" in row["names"] for row in rows)

    def fails(*_arguments, **_options):
        raise accuracy_table.RunError("block 1: the body is lost")

    monkeypatch.setattr(accuracy_table, "first_look", fails)
    assert {row["mark"] for row in study(lambda _line: None, (BLOCK,))} == {"missed"}


def test_the_least_error_of_a_kind_is_the_largest_of_the_effects_that_act():
    assert least_errors(load_resolved("tire_cleat").data)["tire"]["force"] == LeastError(1.5e-2, "tire brush")
    assert least_errors(load_resolved("tire_bump").data) == {}
    assert least_errors({"rig": "unheard of"}) == {}


def test_fifteen_scenes_are_accepted_with_their_values():
    assert len({case.name for case in CASES}) == 15
    for case in CASES:
        assert 0.0 < case.span <= load_resolved(case.scene, *case.values).duration
