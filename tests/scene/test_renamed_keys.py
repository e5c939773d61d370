"""Renamed and removed scene keys: a scene with an old key is refused with what takes its place, the scene of an old bag
is read.

Most renames of these tests are made up: an effect, a section and a key below a section.
"""

import pytest
from tests.bag import hand_made

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.texts import scene_of_text
from contact_sim_pkg.cli.main import main as bench_main
from contact_sim_pkg.records.messages import String
from contact_sim_pkg.run.from_bag import cautions, refuse_other_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.renamed_keys import REMOVED, RENAMED, sentence_of
from contact_sim_pkg.scene.resolve import ResolvedScene, read_explicit, read_resolved, resolve
from contact_sim_pkg.scene.schema.catalog import catalog

MADE_UP = {
    "effects.seat.bounce": "effects.seat.normal_elastic",
    "shaker": "vibration",
    "seat.occupant.hip_mass": "seat.occupant.frame_mass",
}


@pytest.fixture
def renamed(monkeypatch):
    """The made-up renames beside the true ones."""
    for old, new in MADE_UP.items():
        monkeypatch.setitem(RENAMED, old, new)


def with_old_names(text):
    """A resolved scene of the rig seat as a version before the renames wrote it."""
    for old, new in MADE_UP.items():
        before, after = (f"{key.rpartition('.')[2]}:" for key in (new, old))
        assert text.count(before) == 1
        text = text.replace(before, after)
    return text


def test_no_old_key_is_a_key_of_today_and_every_new_one_is():
    keys = {".".join(location) for location in catalog()}
    assert not keys & {*RENAMED, *REMOVED}
    assert set(RENAMED.values()) <= keys


@pytest.mark.usefixtures("renamed")
@pytest.mark.parametrize(
    ("changes", "fault"),
    [
        (
            {"effects.seat.bounce": {"coefficient": 5e5}, "effects.seat.normal_elastic": ...},
            "effects.seat.bounce: was renamed; write effects.seat.normal_elastic in its place",
        ),
        (
            {"shaker": {"kind": "sine", "frequency": 4.0, "amplitude": 1.0}, "vibration": ...},
            "shaker: was renamed; write vibration in its place",
        ),
        (
            {"seat.occupant.hip_mass": 6.0},
            "seat.occupant.hip_mass: was renamed; write seat.occupant.frame_mass in its place",
        ),
        (
            {"seat.occupant.hip_mass": 6.0, "seat.occupant.frame_mass": 7.0},
            "seat.occupant.hip_mass: was renamed; write seat.occupant.frame_mass in its place",
        ),
        (
            {"effects.seat.pressure_mat": {"rows": 12}},
            f"effects.seat.pressure_mat: was removed; write {REMOVED['effects.seat.pressure_mat']} in its place",
        ),
        (
            {"effects.seat.contact_field": {"rows": 12}},
            "effects.seat.contact_field.rows: was renamed; write effects.seat.half_space_field.rows in its place",
        ),
    ],
)
def test_an_old_key_is_refused_with_one_sentence_that_names_the_new_one(maker, changes, fault):
    assert maker.faults("seat", changes) == [fault]


@pytest.mark.usefixtures("renamed")
def test_the_value_under_an_old_key_is_checked_as_that_of_the_new_one(maker):
    first, second = maker.faults("seat", {"seat.occupant.hip_mass": -6.0})
    assert first.endswith("write seat.occupant.frame_mass in its place")
    assert second.startswith("seat.occupant.frame_mass: -6.0 kg is below")


@pytest.mark.usefixtures("renamed")
@pytest.mark.parametrize("value", ["5e5", "null"])
def test_an_old_key_on_the_command_line_is_refused(maker, value):
    override = set_value(f"effects.seat.bounce.coefficient={value}")
    sentence = "was renamed; write effects.seat.normal_elastic.coefficient in its place"
    assert maker.faults("seat", overrides=[override]) == [f"effects.seat.bounce.coefficient: {sentence}"]


@pytest.mark.usefixtures("renamed")
def test_bench_ends_with_2_and_the_new_key(maker, capsys):
    file = maker.write("seat", {"seat.occupant.hip_mass": 6.0})
    assert bench_main(["show", str(file)]) == 2
    assert "write seat.occupant.frame_mass in its place" in capsys.readouterr().err


@pytest.mark.usefixtures("renamed")
def test_a_recorded_scene_with_old_keys_reads_as_one_with_the_new_ones(maker):
    scene = resolve(maker.load("seat", {"seat.occupant.frame_mass": 6.0}))
    old = with_old_names(scene.to_yaml())
    assert read_explicit(old, "scene of a bag") == scene.data
    assert read_resolved(old).data == scene.data
    assert scene_of_text(old, "scene of a bag") == scene.data


@pytest.mark.usefixtures("renamed")
def test_a_bag_with_old_keys_is_reported_and_simulated_again(tmp_path):
    content = hand_made.seat_ride()
    old = with_old_names(content.texts["scene"])
    content.texts = {**content.texts, "scene": old}
    content.messages[0] = ("bench/scene", 0, encode(String(data=old)))
    hand_made.write(tmp_path / "old", content)
    assert open_bag(tmp_path / "old").scene == old
    assert bench_main(["report", str(tmp_path / "old"), "--out", str(tmp_path / "page.html")]) == 0
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "frame mass" in page
    assert "hip mass" not in page
    refuse_other_scene(tmp_path / "old", ResolvedScene(read_explicit(old, "scene of a bag")))


FIELD_OF_0_1 = {"length": 0.6, "width": 0.5, "rows": 40, "cols": 40, "tolerance": 1e-3, "corrector_passes": 0}


@pytest.mark.parametrize(
    ("effect", "keys", "today"),
    [("contact_field", FIELD_OF_0_1, {"half_space_field": FIELD_OF_0_1}), ("pressure_mat", {"rows": 36}, {})],
)
def test_the_seat_of_a_bag_of_0_1_is_read(maker, tmp_path, effect, keys, today):
    law = {"normal_elastic": {"coefficient": 2.73e5, "exponent": 1.5}}
    text = resolve(maker.load("seat", {"effects.seat": law})).to_yaml()
    indented = "\n".join(f"      {key}: {value}" for key, value in keys.items())
    old = text.replace("    normal_elastic:\n", f"    {effect}:\n{indented}\n    normal_elastic:\n")
    expected = {**law, **today}
    assert scene_of_text(old, "scene of a bag")["effects"]["seat"] == expected
    data = read_explicit(old, "scene of a bag")
    assert data["effects"]["seat"] == expected
    content = hand_made.seat_ride()
    content.texts = {**content.texts, "scene": old}
    content.messages[0] = ("bench/scene", 0, encode(String(data=old)))
    hand_made.write(tmp_path / "old", content)
    said = [line for line in cautions(tmp_path / "old") if "was removed" in line]
    assert len(said) == (effect == "pressure_mat")


@pytest.mark.parametrize(
    ("key", "found"),
    [
        ("shaker", "was renamed; write vibration in its place"),
        ("shaker.rate", "was renamed; write vibration.rate in its place"),
        ("effects.seat.bounce", "was renamed; write effects.seat.normal_elastic in its place"),
        ("effects.seat.pressure_mat.rows", f"was removed; write {REMOVED['effects.seat.pressure_mat']} in its place"),
        ("effects.seat", ""),
        ("shakers", ""),
    ],
)
@pytest.mark.usefixtures("renamed")
def test_the_sentence_of_a_section_holds_for_the_keys_below_it(key, found):
    assert sentence_of(tuple(key.split("."))) == found
