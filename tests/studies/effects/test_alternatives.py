"""Scenes with one effect left out, or one more."""

import itertools

import numpy
import pytest
from ruamel.yaml import YAML

from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.rigs.vehicle.tire.schema import SidewallComplianceSection
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.studies.effects import absent, reduced
from contact_sim_pkg.studies.effects.alternatives import effects_of, with_effect, without_effects

UPRIGHT = "vibration={kind: sine, frequency: 4, amplitude: 3}"
BACKWARD = "vibration={kind: half_sine, axis: x, amplitude: -20, duration: 0.02, start: 1}"
NO_FIELD = "effects.tire.contact_field=null"
CLEAT = "road={kind: cleat, %s, height: 0.01, length: 0.02}"


def alternative(scene, name, *values, on=False):
    resolved = load_resolved(scene, *values)
    contact, effect = next(each for each in effects_of(resolved) if f"{each[0].name}.{each[1].name}" == name)
    return without_effects(resolved, effect) if on else with_effect(resolved, contact, effect)


def named(found, contact):
    return [name for name, keys in found.scene.data["effects"][contact].items() if keys is not None]


def test_with_an_effect_comes_what_it_needs():
    found = alternative("car_full_bench", "tire.wheel_spin")
    assert found.beside == ("brush", "sidewall_compliance")
    assert set(named(found, "tire")) >= {"brush", "sidewall_compliance", "wheel_spin", "inflation"}
    assert found.replaced == found.removed == ()


def test_an_effect_takes_the_place_of_those_it_excludes():
    found = alternative("seat_ride", "seat.general_dissipative")
    assert found.replaced == ("normal_dissipative",)
    assert set(named(found, "seat")) == {"cushion", "foam_hysteresis", "general_dissipative"}


def test_what_needs_a_replaced_effect_goes_and_another_carries_the_load():
    found = alternative("seat_ride", "seat.foam", "effects.seat.contact_field={}")
    assert found.replaced == ("cushion",)
    assert found.removed == ("contact_field",)
    assert found.beside == ("normal_elastic",)


def test_what_acts_through_an_effect_alone_goes_with_it():
    assert alternative("tire_braking", "tire.brush", on=True).scene.slip is None
    assert alternative("tire_braking", "tire.brush", on=True).beside == ("sidewall_compliance",)
    assert "sliding" not in alternative("seat_slap", "backrest.friction", on=True).scene.data["backrest"]


def test_an_input_stays_with_an_effect_that_names_it_too():
    """The bristles act by the slip with or without a belt that yields; so they do in the file that
    `--write` makes.
    """
    scene = load_resolved("tire_braking")
    less = alternative("tire_braking", "tire.sidewall_compliance", on=True).scene
    assert (less.data["slip"], less.effect("tire", SidewallComplianceSection)) == (scene.data["slip"], None)
    text = reduced.text_of("tire_braking", [], reduced.Reduced(less, (), (), (), 1.0, 1.0), 1e-2)
    assert YAML(typ="safe").load(text)["slip"]["points"] == scene.data["slip"]["points"]


def test_over_all_pairs_of_effects_an_input_goes_with_the_last_that_names_it():
    """One of two effects of a rig is left out, of the same contact or of two."""
    pairs = [
        (rig.name, *pair)
        for rig in rigs().values()
        for pair in itertools.permutations([(each.name, effect) for each in rig.contacts for effect in each.effects], 2)
    ]
    kept = set()
    for rig, (contact, gone), (other, stays) in pairs:
        if gone.name in stays.excludes or stays.name in gone.excludes:
            continue
        data = {"rig": rig, "effects": {contact: {gone.name: {}}}}
        data["effects"].setdefault(other, {})[stays.name] = {}
        for where in {*gone.inputs, *stays.inputs}:
            _give(data, where)
        left = ResolvedScene(data).without(gone).data
        expected = stays.inputs if stays.name in left["effects"].get(other, {}) else ()
        for where in {*gone.inputs, *stays.inputs}:
            assert _has(left, where) == (where in expected), (rig, gone.name, stays.name, where)
        kept |= {(gone.name, where) for where in expected}
    assert ("sidewall_compliance", "slip") in kept
    assert ("brush", "slip") not in kept, "what needs it goes as well"


def _give(data, where):
    *sections, key = where.split(".")
    for section in sections:
        data = data.setdefault(section, {})
    data[key] = 1.0


def _has(data, where):
    for key in where.split("."):
        if key not in data:
            return False
        data = data[key]
    return True


def test_all_that_can_act_together_keeps_what_is_on():
    scene = load_resolved("seat_ride")
    found = reduced.all_together(scene)
    assert set(scene.data["effects"]["seat"]) | {"friction", "softening"} == set(found.data["effects"]["seat"])


@pytest.mark.parametrize(
    ("scene", "values", "effects"),
    [
        ("tire_bump", ("effects.tire.contact_field=null", "road={kind: cleat, position: 9, height: 0.01, length: 0.02}"),
         {"contact_field"}),
        ("tire_bump", ("effects.tire.contact_field=null", "road={kind: cleat, position: 9, height: 1.0e-9, length: 0.02}"), set()),
        ("tire_bump", ("effects.tire.contact_field=null", "road={kind: bump, position: 9, height: 0.03, length: 6}"), set()),
        ("tire_bump", ("effects.tire.contact_field=null", "road={kind: bump, position: 9, height: 0.08, length: 0.45}"),
         {"contact_field"}),
        ("tire_rough_road", ("effects.tire.contact_field=null",), {"contact_field"}),
        ("tire_rough_road", ("effects.tire.contact_field=null", "road={kind: iso8608, roughness: 1.0e-15}"), set()),
        ("impact_rubber_drop", ("impact.temperatures=[256.0]",), {"shift"}),
        ("impact_rubber_drop", (), set()),
        ("seat_ride", ("vibration={kind: sine, axis: x, frequency: 3, amplitude: 3}",), {"friction"}),
        ("seat_ride", ("vibration={kind: sine, axis: x, frequency: 3, amplitude: 1.0e-9}",), set()),
        ("seat_ride", (BACKWARD,), {"friction"}),
        ("seat_ride", (UPRIGHT, "effects.seat.normal_dissipative=null"), set()),
        ("seat_ride", (UPRIGHT, "effects.seat.normal_dissipative=null", "effects.seat.foam_hysteresis=null"),
         {"normal_dissipative", "general_dissipative"}),
        ("tire_bump", (NO_FIELD, CLEAT % "position: 90"), set()),  # 30 m in 3 s
        ("tire_bump", (NO_FIELD, CLEAT % "position: -9"), set()),
        ("tire_bump", (NO_FIELD, CLEAT % "position: 70, period: 50"), {"contact_field"}),
        ("tire_bump", (NO_FIELD, CLEAT % "position: 90, period: 200"), set()),
        ("tire_rough_road", (NO_FIELD,), {"contact_field"}),
        ("tire_rough_road", (NO_FIELD, "travel={speed: 0}"), set()),
        ("car_full_bench", (), set()),
    ],
)  # fmt: skip
def test_the_data_of_a_scene_call_for_effects_that_are_off(scene, values, effects):
    resolved = load_resolved(scene, *values)
    assert {effect.name for _contact, effect, _reason in absent.absent_effects(resolved)} == effects
    sentence = absent.sentence_of_absent(resolved)
    assert all(name in sentence for name in effects)
    assert bool(sentence) == bool(effects)


@pytest.mark.parametrize(
    ("amplitude", "columns", "effects"),
    [(0.5, "x,z", {"friction"}), (0.5, "forward,z", set()), (0.02, "x,z", set()), (0.0, "x,z", set())],
)
def test_a_recording_calls_for_friction_where_it_shakes_fore_and_aft(tmp_path, amplitude, columns, effects):
    """A third of the requested 1e-2 of gravity is 0.033 m/s^2; a forward column may be absent."""
    wave = numpy.sin(2.0 * numpy.pi * 4.0 * numpy.arange(400) / 100.0)
    path = tmp_path / "floor.csv"
    samples = numpy.column_stack([0.6 + amplitude * wave, 9.81 + 2.0 * wave])
    numpy.savetxt(path, samples, delimiter=",", header=columns, comments="")
    values = (f"vibration={{kind: recorded, file: {path}, rate: 100}}", "duration=3")
    found = absent.absent_effects(load_resolved("seat_ride", *values))
    assert {effect.name for _contact, effect, _reason in found} == effects


@pytest.mark.parametrize(("start", "effects"), [(0.0, set()), (1.5, {"friction"})])
def test_only_the_part_of_a_recording_that_a_run_plays_calls_for_friction(tmp_path, start, effects):
    instants = numpy.arange(600) / 100.0
    wave = numpy.sin(2.0 * numpy.pi * 4.0 * instants)
    path = tmp_path / "floor.csv"
    samples = numpy.column_stack([2.0 * wave * (instants > 4.0), 9.81 + wave])
    numpy.savetxt(path, samples, delimiter=",", header="x,z", comments="")
    values = (f"vibration={{kind: recorded, file: {path}, rate: 100, start: {start}}}", "duration=3")
    found = absent.absent_effects(load_resolved("seat_ride", *values))
    assert {effect.name for _contact, effect, _reason in found} == effects


def test_a_recording_that_is_too_short_calls_for_nothing(tmp_path):
    path = tmp_path / "floor.csv"
    path.write_text("x,z\n1,9\n-1,11\n", encoding="utf-8")
    scene = load_resolved("seat_ride", f"vibration={{kind: recorded, file: {path}, rate: 100}}")
    assert absent.sentence_of_absent(scene) == ""
