"""What tells runs apart."""

from types import SimpleNamespace

from contact_sim_pkg.report.comparison.scene_differences import differences, labels

SCENE = {
    "name": "seat_slap", "description": "one", "vibration": {"kind": "sine", "frequency": 4.75, "amplitude": 14.715},
    "effects": {"backrest": {"friction": None, "normal_elastic": {}}},
}  # fmt: skip


def changed(**values):
    scene = {**SCENE, **{key: value for key, value in values.items() if key != "vibration"}}
    scene["vibration"] = {**SCENE["vibration"], **values.get("vibration", {})}
    return scene


def recording(scene, name="bag"):
    return SimpleNamespace(scene=scene, name=name)


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
    assert labels([recording(first), recording(second)]).title == "vibration.amplitude"


def test_runs_are_called_by_the_first_value_that_tells_all_apart():
    runs = [changed(vibration={"frequency": f, "amplitude": a}) for f, a in ((4.75, 1.0), (5.25, 1.0), (5.75, 2.0))]
    called = labels([recording(each) for each in runs])
    assert called == ("vibration.frequency", ("4.75 Hz", "5.25 Hz", "5.75 Hz"))


def test_runs_that_no_single_value_tells_apart_are_called_by_all():
    runs = [changed(vibration={"frequency": f, "amplitude": a}) for f in (4.0, 5.0) for a in (1.0, 2.0)]
    called = labels([recording(each) for each in runs])
    assert called.title == "vibration.frequency, vibration.amplitude"
    assert called.names[1] == "4 Hz, 2 m/s²"


def test_runs_that_differ_in_much_are_called_by_their_bags():
    runs = [
        changed(vibration={"frequency": f, "amplitude": a, "low": f + a, "high": f - a})
        for f in (4.0, 5.0)
        for a in (1.0, 2.0)
    ]
    called = labels([recording(each, f"run_{number}") for number, each in enumerate(runs)])
    assert called == ("bag", ("run_0", "run_1", "run_2", "run_3"))


def test_equal_scenes_are_called_by_their_bags():
    assert labels([recording(SCENE, "a"), recording(SCENE, "b")]) == ("bag", ("a", "b"))
