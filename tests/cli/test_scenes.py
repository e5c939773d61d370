"""`bench list --try`, `bench show --source`, `bench new`: what the shipped scenes offer, and a scene of one's own."""

import json
import re
import shlex

import pytest

from contact_sim_pkg.cli.main import main
from contact_sim_pkg.scene.load import find_scene, load_scene, shipped_names
from contact_sim_pkg.scene.things_to_try import Trial, things_to_try

TEXT = """\
# A scene.
#
# Things to try:
#   bench run one --set a=1
#   bench run one --set b=2
#       more than a
#       of everything
#   bench run one --pace max  fast
# Not a trial.
rig: tire
#   bench run none
"""


def test_trials_are_the_commands_of_the_first_comment_with_what_they_show():
    assert things_to_try(TEXT) == [
        Trial("bench run one --set a=1", ""),
        Trial("bench run one --set b=2", "more than a of everything"),
        Trial("bench run one --pace max", "fast"),
    ]
    assert things_to_try("# A scene.\nrig: tire\n") == []


TEXTS = [find_scene(name).read_text() for name in shipped_names()]
TRIALS = [trial.command for text in TEXTS for trial in things_to_try(text)]


def test_every_command_of_a_shipped_scene_is_listed(capsys):
    assert main(["list", "--try", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["rows"]
    assert [row["command"] for row in rows] == TRIALS
    assert len(rows) == sum(text.count("\n#   bench ") for text in TEXTS) > 60
    assert main(["list", "--try"]) == 0
    text = capsys.readouterr().out
    assert all(f"  {command}\n" in text for command in TRIALS)


def test_trials_of_one_scene_are_those_of_its_file(capsys):
    assert main(["list", "--try", "--json", "seat_slap"]) == 0
    rows = json.loads(capsys.readouterr().out)["rows"]
    assert [row["command"] for row in rows] == [
        each.command for each in things_to_try(find_scene("seat_slap").read_text())
    ]
    assert main(["list", "seat_slap"]) == 0
    assert "tire_bump" not in capsys.readouterr().out
    assert main(["list", "seat_slab"]) == 2
    assert "seat_slab is no shipped scene" in capsys.readouterr().err


@pytest.mark.parametrize("command", [each for each in TRIALS if each.startswith("bench run") and "FILE" not in each])
def test_what_is_to_be_tried_is_a_scene(command, capsys):
    arguments = shlex.split(re.sub(r" --offline| --out \S+", "", command))[2:]
    assert main(["show", *arguments]) == 0, capsys.readouterr().err


def test_a_source_is_the_file_itself(capsys):
    assert main(["show", "--source", "tire_bump"]) == 0
    assert capsys.readouterr().out == find_scene("tire_bump").read_text()
    assert main(["show", "--source", "tire_bump", "--duration", "2"]) == 2
    assert "leave out what changes it" in capsys.readouterr().err
    assert main(["show", "--source"]) == 2


@pytest.mark.parametrize("name", shipped_names())
def test_a_new_scene_is_a_shipped_one_that_tries_itself(name, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "own", "--like", name]) == 0
    assert "run it: bench run own.yaml" in capsys.readouterr().out
    made, shipped = load_scene(tmp_path / "own.yaml"), load_scene(name)
    assert made.model_dump(exclude={"name"}) == shipped.model_dump(exclude={"name"})
    trials = things_to_try((tmp_path / "own.yaml").read_text())
    assert all(f" {name} " not in f"{each.command} " for each in trials)


def test_a_new_scene_begins_with_the_nearest_name_and_overwrites_nothing(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "my_cleat.yaml"]) == 0
    assert "made from tire_cleat" in capsys.readouterr().out
    for name, made_from in (("seat", "seat_ride"), ("my_roller", "roller_flutter"), ("seat_shock_2", "seat_shock")):
        assert main(["new", name]) == 0
        assert f"made from {made_from}" in capsys.readouterr().out
    before = (tmp_path / "my_cleat.yaml").read_text()
    assert main(["new", "my_cleat"]) == 2
    assert "exists already and is never overwritten" in capsys.readouterr().err
    assert (tmp_path / "my_cleat.yaml").read_text() == before
    assert main(["new", "other", "--like", "nothing_like_it"]) == 2
    assert "there is no such scene" in capsys.readouterr().err
    assert not (tmp_path / "other.yaml").exists()
    assert main(["new", "xyz"]) == 2
    assert "No shipped scene shares a word with xyz" in capsys.readouterr().err
    assert not (tmp_path / "xyz.yaml").exists()
