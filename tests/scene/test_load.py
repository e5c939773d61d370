"""Scenes by name or path, and the shipped ones."""

import shlex
from itertools import pairwise

import pytest

from contact_sim_pkg.records.registry import rigs as known_rigs
from contact_sim_pkg.records.registry import shipped_scenes
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.load import find_scene, list_scenes, load_scene, shipped_names
from contact_sim_pkg.scene.overrides import set_value


def test_the_shipped_scenes_are_listed_smallest_first():
    entries = list_scenes()
    assert [entry.name for entry in entries] == shipped_names()
    backs = [*["backrest"] * 5, *["seat"] * 4, "occupant"]
    rigs = ["seat", *["block"] * 6, *["roller"] * 5, *backs, *["impact"] * 4, *["tire"] * 12, *["car"] * 2]
    assert [entry.rig for entry in entries] == rigs
    assert {name for rig in known_rigs().values() for name in rig.scenes} == set(shipped_names())
    assert all(entry.description and entry.path.is_file() for entry in entries)


@pytest.mark.parametrize("name", shipped_names())
def test_every_shipped_scene_starts_with_a_comment_and_needs_nothing_outside_the_package(name):
    text = shipped_scenes()[name].read_text(encoding="utf-8")
    assert text.startswith("# ")
    assert "shared" not in text
    assert load_scene(name).name == name


TRIED = [
    (name, line)
    for name in shipped_names()
    for line in shipped_scenes()[name].read_text(encoding="utf-8").splitlines()
    if line.startswith("#   bench run")
]


@pytest.mark.parametrize(("name", "line"), TRIED, ids=[line[14:60] for _name, line in TRIED])
def test_what_a_scene_says_to_try_is_a_valid_scene(name, line):
    words = shlex.split(line.lstrip("# ").partition("   ")[0])
    given = [set_value(value) for option, value in pairwise(words) if option == "--set"]
    assert load_scene(words[2], given).name == words[2]


def test_a_scene_without_name_is_called_like_its_file(maker):
    assert maker.load("seat").name == "seat"


def test_a_file_name_that_cannot_be_a_name_asks_for_one(maker, tmp_path):
    path = tmp_path / "my scene.yaml"
    path.write_text(maker.write("seat").read_text())
    with pytest.raises(SceneError, match=r"name: 'my scene' is not a name.*; write name: my_scene$"):
        load_scene(path)


def test_an_unknown_name_is_told_the_nearest():
    with pytest.raises(SceneError, match=r"did you mean tire_bump\?"):
        load_scene("tire_bmp")
    with pytest.raises(SceneError, match=r"did you mean tire_bump\?"):
        load_scene("TIRE_BUMP")


@pytest.mark.parametrize(
    ("scene", "assignment", "meant"),
    [
        ("tire_rough_road", "road.roughness=C", "did you mean 'roughness_class: C'?"),
        ("tire_rough_road", "road.class=C", "did you mean 'roughness_class'?"),
        ("tire_bump", "road.roughness=C", "it belongs to a road of kind iso8608, this one is bump"),
        ("tire_bump", "road.depth=0.1", "it belongs to a road of kind pothole, this one is bump"),
        ("tire_rough_road", "road.seed=3", "it stands at the top of the scene: seed"),
        ("tire_bump", "travel.speed=60 km/h", "without its unit: 60 km/h is 16.667 m/s, write 16.667"),
        ("tire_bump", "travel.speed=37 mph", "37 mph is 16.54 m/s, write 16.54"),
        ("tire_bump", "travel.speed='5'", "a number is needed without quotes"),
        ("tire_bump", "travel.speed=5 m/s", "without its unit: write 5"),
        ("tire_bump", "travel.speed=5 apples", "was read as text, a number is needed; allowed"),
    ],
)
def test_a_key_or_value_that_is_none_is_told_what_was_meant(scene, assignment, meant):
    with pytest.raises(SceneError) as caught:
        load_scene(scene, [set_value(assignment)])
    assert meant in str(caught.value.faults[0])


def test_a_path_is_taken_as_a_path(tmp_path):
    assert find_scene(tmp_path / "x.yaml") == tmp_path / "x.yaml"
    with pytest.raises(SceneError, match="there is no such file"):
        load_scene(tmp_path / "x.yaml")


def test_faults_are_told_one_a_line_ordered_by_line_options_last(maker):
    from contact_sim_pkg.scene.overrides import set_pace

    file = maker.folder / "two.yaml"
    file.write_text("rig: seat\nduration: -1\nseed: x\neffects: {seat: {normal_elastic: {}}}\n")
    with pytest.raises(SceneError) as caught:
        load_scene(file, [set_pace("x")])
    assert [line.split(": ")[0] for line in str(caught.value).splitlines()] == [
        f"{file}:1:1", f"{file}:2:11", f"{file}:3:7", "--pace x",
    ]  # fmt: skip
