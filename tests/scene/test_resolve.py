"""Accuracy becomes explicit; the resolved scene reads back to the same bits and resolves to itself."""

import hashlib
import json

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from contact_sim_pkg.rigs.vehicle.seat.schema import HalfSpaceField
from contact_sim_pkg.rigs.vehicle.tire.schema import TireField
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.load import load_scene, shipped_names
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import read_resolved, resolve
from contact_sim_pkg.scene.schema.accuracy import LEVELS

FIELD = "effects.tire.contact_field"


def data_of(maker, base, changes=None):
    return resolve(maker.load(base, changes)).data


def leaves(data):
    if isinstance(data, dict):
        return [leaf for value in data.values() for leaf in leaves(value)]
    return [leaf for value in data for leaf in leaves(value)] if isinstance(data, list) else [data]


@pytest.mark.parametrize(
    ("accuracy", "cells"),
    [
        ("realtime", (48, 64)), (0.1, (48, 64)), (1e-2, (48, 64)), (9.99e-3, (96, 128)), (1e-3, (96, 128)),
        (9.99e-4, (144, 192)), (1e-8, (144, 192)),
    ],
)  # fmt: skip
def test_the_cheapest_rung_that_reaches_the_accuracy_is_taken(maker, accuracy, cells):
    field = data_of(maker, "tire", {FIELD: {}, "accuracy": accuracy})["effects"]["tire"]["contact_field"]
    assert (field["rows"], field["cols"]) == cells


@pytest.mark.parametrize(
    ("accuracy", "tolerance"), [("realtime", 1e-4), (0.1, 1e-4), (1e-2, 1e-4), (1e-3, 1e-5), (1e-8, 1e-10)]
)
def test_time_integration_takes_a_hundredth_of_the_asked_error(maker, accuracy, tolerance):
    found = data_of(maker, "tire", {"accuracy": accuracy})["integrator"]["relative_tolerance"]
    assert found == pytest.approx(tolerance, rel=1e-12)


def test_fidelity_levels_get_finer_and_more_expensive():
    for grids in (TireField.levels, HalfSpaceField.levels):
        cells = [grid.rows * grid.cols for grid in grids]
        tolerances = [grid.tolerance for grid in grids]
        assert len(grids) == len(LEVELS)
        assert cells == sorted(cells)
        assert tolerances == sorted(tolerances, reverse=True)
        assert min(grid.corrector_passes for grid in grids) >= 0
    assert LEVELS[-1].accuracy == 0.0


def test_what_the_scene_gives_itself_stays(maker):
    given = {"rows": 20, "cols": 30, "tolerance": 1e-5, "corrector_passes": 0, "length": 0.1, "width": 0.2}
    data = data_of(maker, "tire", {FIELD: given, "integrator.relative_tolerance": 1e-7})
    assert data["effects"]["tire"]["contact_field"] == given
    assert data["integrator"]["relative_tolerance"] == 1e-7


def test_every_default_is_written_out(maker):
    data = data_of(maker, "car", {"effects.tire.contact_field": {}, "effects.seat.normal_dissipative": {}})
    assert data["tire"]["body_mass"] == 300.0
    assert data["seat"]["occupant"]["masses"] == [33.4, 10.7]
    assert data["effects"]["seat"]["normal_dissipative"] == {"damping": 1.0}
    assert data["limits"]["memory"] == 1.0
    assert data["name"] == "car"
    assert None not in leaves(data)


def test_what_the_rig_lacks_is_not_there(maker, rig):
    data = data_of(maker, rig)
    own = {"tire", "seat"} if rig == "car" else {rig}
    contacts = ("tire", "seat", "backrest", "impact", "block", "roller")
    assert {name for name in contacts if name in data} == own == set(data["effects"])
    assert all("contact_field" not in effects for effects in data["effects"].values())


def test_the_data_is_plain_json(maker, rig):
    data = data_of(maker, rig)
    assert json.loads(json.dumps(data)) == data


def assert_round_trip(resolved):
    text = resolved.to_yaml()
    again = read_resolved(text)
    assert json.dumps(again.data) == json.dumps(resolved.data)
    assert again.to_yaml() == text


def test_a_resolved_scene_reads_back_the_same(maker, rig):
    assert_round_trip(resolve(maker.load(rig)))


def test_a_resolved_scene_is_a_scene_that_resolves_to_itself(maker, tmp_path):
    resolved = resolve(maker.load("car", {FIELD: {"cols": 32}, "accuracy": 1e-3}))
    path = tmp_path / "resolved.yaml"
    path.write_text(resolved.to_yaml(), encoding="utf-8")
    assert resolve(load_scene(path)).data == resolved.data


@given(
    mass=st.floats(0.1, 2000), accuracy=st.floats(1e-8, 0.1), text=st.text(max_size=40), seed=st.integers(0, 2**53 - 1)
)
@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_numbers_and_texts_survive_the_round_trip_to_the_bit(maker, mass, accuracy, text, seed):
    changes = {"tire": {"wheel_mass": mass}, "accuracy": accuracy, "seed": seed, "description": text, FIELD: {}}
    try:
        scene = maker.load("tire", changes)
    except SceneError:
        assert any(ord(letter) < 32 or not letter.isprintable() for letter in text)
        return
    assert_round_trip(resolve(scene))


def test_a_resolved_text_that_leaves_something_open_is_refused(maker):
    text = resolve(maker.load("tire", {FIELD: {}})).to_yaml()
    open_text = "".join(line for line in text.splitlines(keepends=True) if "tolerance: 0.001" not in line)
    assert open_text != text
    with pytest.raises(SceneError, match=r"contact_field\.tolerance: is left open"):
        read_resolved(open_text)


@pytest.fixture
def recorded(maker):
    (maker.folder / "floor.csv").write_text("z\n0.5\n")
    return maker.load("seat", {"vibration": {"kind": "recorded", "file": "floor.csv", "rate": 100.0}})


def test_an_input_file_is_tied_by_name_and_checksum(maker, recorded):
    resolved = resolve(recorded)
    assert resolved.data["vibration"]["file"] == "floor.csv"
    assert resolved.data["vibration"]["sha256"] == hashlib.sha256(b"z\n0.5\n").hexdigest()
    assert resolved.file_path("vibration.file") == maker.folder / "floor.csv"


def test_a_file_that_changed_since_is_refused(maker, recorded):
    resolved = resolve(recorded)
    (maker.folder / "floor.csv").write_text("z\n0.6\n")
    with pytest.raises(SceneError, match="another content than the scene was resolved with"):
        resolved.file_path("vibration.file")


def test_a_resolved_text_reads_without_its_files_and_asks_for_them_later(maker, recorded):
    text = resolve(recorded).to_yaml()
    with pytest.raises(SceneError, match="is not there; give its path"):
        read_resolved(text, folder=maker.folder / "elsewhere").file_path("vibration.file")
    given = read_resolved(text, files={"vibration.file": maker.folder / "floor.csv"})
    assert given.file_path("vibration.file") == maker.folder / "floor.csv"
    assert read_resolved(text, folder=maker.folder).file_path("vibration.file").name == "floor.csv"


def test_an_absolute_file_name_leaves_no_trace_of_the_machine(maker, recorded):
    file = str(maker.folder / "floor.csv")
    scene = maker.load("seat", {"vibration": {"kind": "recorded", "file": file, "rate": 100.0}})
    assert str(maker.folder) not in resolve(scene).to_yaml()


@pytest.mark.parametrize("name", shipped_names())
def test_every_shipped_scene_resolves_and_reads_back(name):
    assert_round_trip(resolve(load_scene(name)))


def test_the_general_law_of_a_back_has_the_default_loss_of_a_back():
    """Restitution 0.6 at 0.5 m/s is 1.9497 s/m of damping, times the elastic coefficient."""
    general = "effects.backrest={normal_elastic: {}, general_dissipative: {}}"
    slap = load_scene("seat_slap", [set_value("backrest.sliding=null"), set_value(general)])
    effects = resolve(slap).data["effects"]["backrest"]
    ratio = effects["general_dissipative"]["coefficient"] / effects["normal_elastic"]["coefficient"]
    assert ratio == pytest.approx(1.9497, rel=1e-4)
