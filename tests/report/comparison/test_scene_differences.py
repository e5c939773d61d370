"""What tells runs apart."""

from contact_sim_pkg.report.comparison.scene_differences import differences

SCENE = {
    "name": "seat_slap", "description": "one", "vibration": {"kind": "sine", "frequency": 4.75, "amplitude": 14.715},
    "effects": {"backrest": {"friction": None, "normal_elastic": {}}},
}  # fmt: skip


def changed(**values):
    scene = {**SCENE, **{key: value for key, value in values.items() if key != "vibration"}}
    scene["vibration"] = {**SCENE["vibration"], **values.get("vibration", {})}
    return scene


def test_equal_values_and_descriptions_do_not_tell_apart():
    assert differences([SCENE, changed(description="another")]) == []


def test_a_value_comes_with_its_key_and_unit():
    (found,) = differences([SCENE, changed(vibration={"frequency": 5.25})])
    assert found.key == "vibration.frequency"
    assert found.values == ("4.75 Hz", "5.25 Hz")


def test_what_a_scene_lacks_is_a_dash():
    friction = {"backrest": {"friction": {}, "normal_elastic": {}}}
    (found,) = differences([SCENE, changed(effects=friction)])
    assert found == ("effects.backrest.friction", ("–", "on"))


def test_how_a_scene_is_run_comes_last():
    first, second = {"duration": 4.0, **SCENE}, changed(name="seat_slip", duration=2.0, vibration={"amplitude": 4.905})
    found = differences([first, second])
    assert [each.key for each in found] == ["vibration.amplitude", "duration", "name"]


def test_a_section_that_a_scene_leaves_out_is_one_line_and_its_sections_none():
    law = {"normal_elastic": {}, "friction": {"coefficient": 0.4, "law": {"kind": "smooth", "speed": 0.01}}}
    found = differences([changed(effects={"backrest": law}), SCENE])
    assert found == [("effects.backrest.friction", ("on", "–"))]
    both = differences(
        [changed(effects={"backrest": law}), changed(effects={"backrest": {**law, "friction": {"coefficient": 0.5}}})]
    )
    assert [each.key for each in both] == ["effects.backrest.friction.coefficient", "effects.backrest.friction.law"]
