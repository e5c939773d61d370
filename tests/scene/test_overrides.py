"""Values from the command line: put in before validation, faults name the option."""

import pytest

from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.overrides import set_duration, set_pace, set_rate, set_road, set_value, set_vibration
from contact_sim_pkg.scene.resolve import load_resolved


@pytest.mark.parametrize(
    ("assignment", "read"),
    [
        ("duration=2.5", lambda scene: scene.duration == 2.5),
        ("seat.occupant.masses.0=40.0", lambda scene: scene.seat.occupant.masses[0] == 40.0),
        ("seat.occupant.frame_mass=5e0", lambda scene: scene.seat.occupant.frame_mass == 5.0),
        ("effects.seat.half_space_field={}", lambda scene: scene.effects.seat.half_space_field is not None),
        (
            "effects.seat.friction={coefficient_static: 0.5}",
            lambda scene: scene.effects.seat.friction.coefficient_static == 0.5,
        ),
        ("description=a=b", lambda scene: scene.description == "a=b"),
        ("vibration={kind: noise, low: 1, high: 20, rms: 1}", lambda scene: scene.vibration.high == 20.0),
    ],
)
def test_one_value_is_changed(maker, assignment, read):
    scene = maker.load("seat", {"seat": {"occupant": {"masses": [33.4, 10.7]}}}, [set_value(assignment)])
    assert read(scene)


def test_null_takes_a_key_out(maker):
    given = {
        "effects": {"seat": {"normal_elastic": {}, "half_space_field": {}, "friction": {"coefficient_static": 0.5}}}
    }
    scene = maker.load("seat", given, [set_value("effects.seat.friction=null"), set_value("duration=2")])
    assert scene.effects.seat.friction is None
    assert scene.effects.seat.half_space_field is not None
    assert scene.duration == 2.0


def test_null_for_a_key_that_is_needed_says_that_it_is_missing(maker):
    with pytest.raises(SceneError, match="rig: is missing"):
        maker.load("seat", overrides=[set_value("rig=null")])


def test_the_last_of_equal_options_wins(maker):
    assert maker.load("seat", overrides=[set_duration("2"), set_value("duration=3")]).duration == 3.0


@pytest.mark.parametrize(("pace", "value"), [("max", "max"), ("realtime", "realtime"), ("0.5", 0.5), (2, 2.0)])
def test_pace_is_a_word_or_a_factor(maker, pace, value):
    assert maker.load("seat", overrides=[set_pace(pace)]).pace == value


@pytest.mark.parametrize(
    ("override", "line"),
    [
        (
            lambda: set_value("seat.occupnt=3"),
            "--set seat.occupnt=3: seat.occupnt: the key is unknown; did you mean 'occupant'?",
        ),
        (
            lambda: set_value("seat.seed=3"),
            "--set seat.seed=3: seat.seed: the key is unknown; it stands at the top of the scene: seed",
        ),
        (
            lambda: set_value("foam.length=3"),
            "--set foam.length=3: foam: the key is unknown; it is effects.seat.foam, effects.backrest.foam",
        ),
        (
            lambda: set_value("damping=3"),
            "--set damping=3: damping: the key is unknown; it is seat.occupant.damping, effects.tire.normal_dissipative.damping",
        ),
        (
            lambda: set_value("duration=2 min"),
            "--set duration=2 min: duration: '2 min' was read as text, a number is needed without its unit: 2 min is 120 s",
        ),
        (
            lambda: set_value("duration.x=3"),
            "--set duration.x=3: duration.x: 'duration' is the value '1.0' and has no keys",
        ),
        (
            lambda: set_value("effects.seat.frcition=null"),
            "--set effects.seat.frcition=null: effects.seat.frcition: null removes a key, and the scene does not give this",
        ),
        (
            lambda: set_value("a.b=null"),
            "--set a.b=null: a.b: null removes a key, and the scene does not give this one",
        ),
        (lambda: set_duration("1_0"), "--duration 1_0: duration: '1_0' was read as text, a number is needed, write 10"),
        (lambda: set_duration("-1"), "--duration -1: duration: -1 s is not above 0 s"),
        (lambda: set_pace("fast"), "--pace fast: pace: 'fast' was read as text"),
        (lambda: set_road("no/such.crg"), "--road no/such.crg: road: the rig seat has no road"),
        (lambda: set_vibration("no/such.csv"), "--vibration no/such.csv: vibration.rate: is missing"),
        (lambda: set_rate("476"), "--rate 476: vibration.rate: the key is unknown"),
    ],
)
def test_a_fault_names_the_option(maker, override, line):
    with pytest.raises(SceneError) as caught:
        maker.load("seat", overrides=[override()])
    assert any(told.startswith(line) for told in str(caught.value).splitlines())


@pytest.mark.parametrize("assignment", ["duration", "=3", "a..b=3", "a=[1", "a=!!python/object/apply:os.system [x]"])
def test_an_assignment_that_is_none_is_refused(assignment):
    with pytest.raises(SceneError) as caught:
        set_value(assignment)
    assert str(caught.value).startswith(f"--set {assignment}: ")


def test_an_item_beyond_the_list_is_refused(maker):
    changes = {"seat": {"occupant": {"masses": [33.4, 10.7]}}}
    (fault,) = maker.faults("seat", changes, [set_value("seat.occupant.masses.2=1")])
    assert "has 2 items" in fault


def test_a_vibration_file_takes_the_place_of_any_vibration(maker, tmp_path):
    file = tmp_path / "floor.csv"
    file.write_text("z\n0\n")
    scene = maker.load("seat", {"vibration.sample_rate": 500.0}, [set_vibration(file), set_rate("476")])
    assert (scene.vibration.kind, scene.vibration.file, scene.vibration.rate) == ("recorded", str(file), 476.0)
    assert scene.vibration.sample_rate == 500.0


def test_a_road_file_keeps_how_the_scene_treats_files_but_not_what_belongs_to_the_old_one(maker, tmp_path):
    file = tmp_path / "road.crg"
    file.write_bytes(b"x")
    before = {
        "kind": "opencrg",
        "file": "old.crg",
        "start": 3.0,
        "sha256": "0" * 64,
        "missing_cells": "fill",
        "border_u": "repeat",
    }
    road = maker.load("tire", {"road": before}, [set_road(file)]).road
    assert (road.file, road.start, road.sha256) == (str(file), 0.0, None)
    assert (road.missing_cells, road.border_u) == ("fill", "repeat")


def test_a_relative_file_counts_from_the_current_folder(maker, tmp_path, monkeypatch):
    (tmp_path / "road.crg").write_bytes(b"x")
    monkeypatch.chdir(tmp_path)
    assert maker.load("tire", overrides=[set_road("road.crg")]).road.file == str(tmp_path / "road.crg")


@pytest.mark.parametrize(
    ("name", "text", "kind"),
    [
        ("a.crg", "", "opencrg"), ("a.txt", "$CT\nroad\n$\n$ROAD_CRG\n", "opencrg"), ("a.csv", "x,z\n0,0\n", "profile"),
        ("a.rdf", "$ words\n[UNITS]\n", "profile"), ("a.erd", "ERDFILEV2.00\n", "profile"),
    ],
)  # fmt: skip
def test_the_kind_of_a_road_file_follows_from_its_name_and_content(maker, tmp_path, name, text, kind):
    (tmp_path / name).write_text(text)
    assert maker.load("tire", overrides=[set_road(tmp_path / name)]).road.kind == kind


@pytest.mark.parametrize("assignment", ["road.file=own.csv", "road={kind: profile, file: own.csv}"])
def test_a_file_counts_from_the_current_folder(tmp_path, monkeypatch, assignment):
    """Where it is there; else the name stays, for the folder of the scene."""
    monkeypatch.chdir(tmp_path)
    assert "/" not in str(set_value(assignment).node)
    (tmp_path / "own.csv").write_text("x,z\n0,0\n60,0\n", encoding="utf-8")
    values = [assignment] if "kind" in assignment else ["road={kind: profile, file: other.csv}", assignment]
    scene = load_resolved("tire_bump", *values)
    assert scene.files["road.file"] == tmp_path / "own.csv"
