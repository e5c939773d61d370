"""`bench hard --accuracy`: marks, table and exit code; the cases are scenes that can be run."""

import click
import pytest

from contact_sim_lab.cli.hard import command
from contact_sim_lab.hard import accuracy_table
from contact_sim_lab.hard.accuracy_cases import CASES, AccuracyCase
from contact_sim_lab.hard.accuracy_table import cells, failed, mark_of, rows_of, study, summary, unjudged
from contact_sim_pkg.compare.first_look import FirstLook, Request
from contact_sim_pkg.compare.least_errors import LeastError, least_errors
from contact_sim_pkg.scene.resolve import load_resolved

BRUSH = {"force": LeastError(1.5e-2, "tire brush")}
JAM = next(case for case in CASES if case.name == "jam")
BLOCK = JAM._replace(values=(*JAM.values, "duration=0.1"))
GUARD = {"guard": "touches", "figure": 3.0, "relation": "≥", "bound": 2.0}


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
    rows = [{**row, **GUARD, "scene_cpu_s": 7.0} for row in rows_of(BLOCK, look, {})]
    assert [row["mark"] for row in rows] == ["held", "named", "named", "missed"]
    assert rows[2]["names"] == "block 3: the step is too long"
    assert rows[0]["cpu_s"] == pytest.approx(1.0)  # of 10 s per simulated second
    assert cells(rows) == {
        "scene": "jam",
        "1e-1": "5e-2 held",
        "1e-2": "2e-2 named",
        "1e-3": "named",
        "1e-4": "2e-2 missed",
        "CPU s": "7",
        "hard because": "touches: 3, ≥ 2",
    }
    assert summary(rows) == "held 1 of 4; named 2; missed 1; not hard 0; 7 CPU s"
    assert (failed(rows), unjudged(rows)) == (True, False)
    assert not failed([{**row, "mark": "held"} if row["requested"] < 1e-1 else row for row in rows])


def test_a_case_is_run_with_its_values_and_says_so_at_once():
    lines = []
    (rows,) = study(lines.append, (BLOCK,))
    assert lines[0] == f"1 of 1: jam: {BLOCK.hard}"
    assert [row["requested"] for row in rows] == [1e-1, 1e-2, 1e-3, 1e-4]
    assert all(row["mark"] == "held" and row["end_s"] == pytest.approx(0.1) for row in rows)


def test_a_slip_that_does_not_jam_is_not_hard_whatever_its_errors():
    """The rotation of the other sign slides on: 1/m + (x^2 + 2 |x z|) mu / I of that corner is above 0."""
    slides = BLOCK._replace(values=("block.rotation=[0, 0.463647609, 0]", "duration=0.1"))
    (rows,) = study(lambda _line: None, (slides,))
    assert {row["mark"] for row in rows} == {"not hard"}
    assert rows[0]["figure"] == pytest.approx(3.69, abs=5e-3)
    assert (failed(rows), unjudged(rows)) == (False, True)


def test_the_command_prints_each_scene_as_it_comes(monkeypatch):
    printed = []

    def study_of_two(_progress):
        for name in ("one", "two"):
            printed.append(name)
            yield [{**row(name), "requested": asked} for asked in (1e-1, 1e-2)]

    def row(name):
        return {**GUARD, "scene": name, "mark": "held", "force": 1e-3, "motion": None, "names": "", "scene_cpu_s": 1.0}

    monkeypatch.setattr(accuracy_table, "study", study_of_two)
    monkeypatch.setattr("contact_sim_lab.cli.hard.click.echo", lambda line="", **_options: printed.append(line))
    context = click.Context(command)
    with pytest.raises(click.exceptions.Exit) as ended:
        context.invoke(command, accuracy=True, effects=False, as_json=False)
    assert ended.value.exit_code == 0
    assert [line.split()[0] for line in printed] == ["one", "scene", "one", "two", "two", "held"]


def test_a_scene_that_is_refused_says_so_and_one_without_a_finer_run_is_missed(monkeypatch):
    refused = BLOCK._replace(values=("block.mass=-1",))
    (rows,) = study(lambda _line: None, (refused,))
    assert all(row["mark"] == "not hard" and "block.mass" in row["names"] for row in rows)

    def fails(*_arguments, **_options):
        raise accuracy_table.RunError("block 1: the body is lost")

    monkeypatch.setattr(accuracy_table, "first_look", fails)
    (rows,) = study(lambda _line: None, (BLOCK,))
    assert {row["mark"] for row in rows} == {"missed"}


def test_the_least_error_of_a_kind_is_the_largest_of_the_effects_that_act():
    assert least_errors(load_resolved("tire_cleat").data)["tire"]["force"] == LeastError(1.5e-2, "tire brush")
    assert least_errors(load_resolved("tire_bump").data) == {}
    assert least_errors({"rig": "unheard of"}) == {}


def test_every_scene_says_what_makes_it_hard():
    for case in CASES:
        assert case.is_hard.what
        assert not case.is_hard.met(float("nan"))
    with pytest.raises(TypeError):
        AccuracyCase("scene", "hard", "block_painleve", ())


def test_fifteen_scenes_are_accepted_with_their_values():
    assert len({case.name for case in CASES}) == 15
    for case in CASES:
        assert 0.0 < case.span <= load_resolved(case.scene, *case.values).duration


def test_each_scene_is_hard():
    """Whatever its errors are: what makes it hard is measured from its run."""
    figures = {case.name: (case.is_hard, accuracy_table._figure(case, lambda _line: None)) for case in CASES}
    assert {name: guard.says(figure) for name, (guard, figure) in figures.items() if not guard.met(figure)} == {}
