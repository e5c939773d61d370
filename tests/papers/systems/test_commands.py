"""`bench paper PAPER --system NAME INPUT` on the examples, and its refusals with status 2."""

import json
from pathlib import Path

import pytest

from contact_sim_lab.papers.registry import load, paper_of, papers
from contact_sim_pkg.cli.main import main

EXAMPLES = Path(__file__).parents[3] / "examples" / "papers"
ON_EXAMPLES = [
    ("driver-seat", "distance", "distance.yaml", ()),
    ("driver-seat", "cnoidal", "cnoidal.csv", ("terms=1",)),
    ("tire-road", "profile", "profile_tip.csv", ()),
    ("tire-road", "profile", "profile_outline.csv", ("load=4000",)),
    ("identifiability", "inertia", "inertia.csv", ()),
]
LABELS = {"by", "fit", "form", "parameter", "unit"}


def ran(capsys, paper, system, source, values, output):
    arguments = ["paper", paper, str(source), "--system", system, "--output", str(output), "--json"]
    status = main([*arguments, *(part for value in values for part in ("--set", value))])
    return status, capsys.readouterr()


@pytest.mark.parametrize(("paper", "system", "file", "values"), ON_EXAMPLES)
def test_each_example_runs_and_is_drawn(capsys, tmp_path, paper, system, file, values):
    status, text = ran(capsys, paper, system, EXAMPLES / file, values, tmp_path / "picture.png")
    assert status == 0
    found = json.loads(text.out)
    # What the table of systems says that the command shows, numbers as numbers.
    keys = {key for row in [*found["rows"], *found["course"]] for key in row}
    (shown,) = (each.shows for each in paper_of(paper).systems if each.name == system)
    assert {name for _, place in shown for name in place.split(", ")} <= keys
    for row in [*found["rows"], *found["course"]]:
        assert not [value for key, value in row.items() if isinstance(value, str) and key not in LABELS]
    assert (tmp_path / "picture.png").stat().st_size > 5000


def test_a_table_for_a_person_has_six_digits(capsys, tmp_path):
    arguments = ["paper", "tire-road", str(EXAMPLES / "profile_tip.csv"), "--system", "profile"]
    arguments += ["--set", "load=40.123456", "--output", str(tmp_path / "picture.png")]
    assert main(arguments) == 0
    text = capsys.readouterr().out
    assert "40.1235" in text
    assert main([*arguments, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert f"{found['rows'][-1]['approach_m']:.6g}" in text


def test_every_system_that_runs_is_there_and_says_what_it_takes():
    systems = [system for paper in papers() for system in paper.systems if system.name]
    assert {"distance", "cnoidal", "profile", "load", "inertia", "axes"} <= {system.name for system in systems}
    for system in systems:
        assert callable(load(system.run))
        assert system.input


@pytest.mark.parametrize(
    ("paper", "system", "text", "values", "sentence"),
    [
        ("driver-seat", "distance", "body_1: {kind: cone}\nbody_2: {kind: cone}\n", (), "a kind of sphere"),
        ("driver-seat", "cnoidal", "time,value\n0,1\n", (), "at least 8 are needed"),
        ("tire-road", "profile", "r,height\n0,0\n1,1\n2,4\n", ("load=-1",), "load"),
        ("tire-road", "load", "rig: tire\n", (), "duration"),
        ("identifiability", "inertia", "sx\n1\n", (), "columns sx, sy, sz"),
        ("identifiability", "axes", "", (), "is no bag"),
        ("identifiability", "moments", "", (), "unknown"),
    ],
)
def test_bad_input_ends_with_status_2_and_its_name(capsys, tmp_path, paper, system, text, values, sentence):
    path = tmp_path / ("scene.yaml" if system == "load" else "input.csv")
    path.write_text(text, encoding="utf-8")
    status, found = ran(capsys, paper, system, path, values, tmp_path / "picture.png")
    assert status == 2
    assert sentence in found.err
    assert not (tmp_path / "picture.png").exists()


def test_an_input_that_is_not_there_is_named(capsys, tmp_path):
    status, found = ran(capsys, "driver-seat", "distance", tmp_path / "nowhere.yaml", (), tmp_path / "picture.png")
    assert status == 2
    assert "nowhere.yaml" in found.err
