"""What was run, as rows with units."""

import json
from types import SimpleNamespace

import numpy as np
import pytest

from contact_sim_pkg.records.metric import MET, OUTSIDE, SELF_CHECK, Metric
from contact_sim_pkg.report import facts
from contact_sim_pkg.report.reading import contact_name
from contact_sim_pkg.report.rows import described_rows, plain, scene_rows
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.run.bag_content import described_by_publishers

SCENE = {
    "rig": "seat",
    "block_length": 0.01,
    "outputs": {"field_rate": 100.0},
    "vibration": {"kind": "sine", "frequency": 4.0},
}


def recording(**changes):
    empty = Recording("bag", {}, [], {}, [], {}, {}, None, None, None, 1.5)
    return empty._replace(**changes)


def test_values_of_a_scene_carry_the_units_of_the_schema():
    rows = {row.label: row.value for row in scene_rows(SCENE)}

    assert rows["block length"] == "0.01 s"
    assert rows["outputs · field rate"] == "100 Hz"
    assert rows["vibration · frequency"] == "4 Hz"


def test_an_excitation_carries_its_units_at_the_end_of_its_keys():
    rows = described_rows({"peak_m_per_s2": 3.0, "rate_Hz": 476.0, "axes": {"z": {"bias_m_per_s2": 0.2}}, "none": None})

    assert rows == [("peak", "3 m/s²"), ("rate", "476 Hz"), ("axes · z · bias", "0.2 m/s²")]


def test_waveforms_in_a_list_become_rows_too():
    assert described_rows({"x": [], "z": [{"frequency_Hz": 25.0}]}) == [("z · frequency", "25 Hz")]


def test_an_absent_effect_is_not_listed():
    scene = {
        "effects": {"seat": {"normal_elastic": {}, "friction": None, "half_space_field": {"rows": 40, "length": 0.6}}}
    }

    rows = facts.effect_rows(recording(scene=scene))["seat"]

    assert rows == [("elastic force", "on"), ("pressure field of a half-space", "rows 40, length 0.6 m")]


def test_notes_of_the_excitation_stand_apart_from_its_values():
    described = {"platform/vibration": {"kind": "recorded", "notes": ["4 samples clipped"]}}

    (found,) = facts.excitation_facts(recording(metadata={"excitation": json.dumps(described)}))

    assert found == ("platform/vibration", [("kind", "recorded")], ["4 samples clipped"])


@pytest.mark.parametrize("ended", ["failed", "stopped"])
def test_a_run_that_ended_early_is_a_warning(ended):
    assert ended in facts.warnings(recording(metadata={"ended": ended, "failure": ""}))[0]
    assert facts.warnings(recording(metadata={"ended": "finished"})) == []


def test_an_excitation_of_another_node_is_a_warning_and_one_of_the_bench_is_not():
    described = {"platform/vibration": {"file": "bus.csv", "notes": ["4 of 9520 clipped"]}}
    for node, warned in (("/vibration", False), ("/lab/vibration", False), ("/my_sine", True)):
        found = described_by_publishers(described, {"platform/vibration": node})
        said = facts.warnings(recording(metadata={"excitation": json.dumps(found)}))
        assert (len(said) == 1 and said[0].startswith(f"platform/vibration: published by {node}")) == warned
        assert found["platform/vibration"]["published by"] == node
        assert ("file" in found["platform/vibration"]) == (not warned)
    assert described_by_publishers(described, {}) == described


def test_a_run_that_was_killed_is_no_finished_one():
    """Its bag has no end, and so no word of how it ended."""
    killed = recording(scene={"name": "x"}, notes=["x_0.mcap holds 3 messages: it was not finished"])
    assert "killed" in facts.ended_early(killed)[0]
    assert facts.ended_early(killed._replace(metadata={"ended": "finished"})) == []


def test_what_a_bag_lacks_is_a_warning():
    assert facts.warnings(recording(notes=["the bag was not finished"])) == ["the bag was not finished"]


def test_a_bag_without_scene_still_tells_its_length():
    assert facts.run_rows(recording()) == [("simulated time", "1.5 s")]
    assert facts.effect_rows(recording()) == {}


@pytest.mark.parametrize(("topic", "name"), [("/tire/force", "tire"), ("/rig2/seat/patch", "seat"), ("force", "force")])
def test_a_contact_is_called_after_its_topic(topic, name):
    assert contact_name(topic) == name


@pytest.mark.parametrize(("value", "text"), [(True, "yes"), (0.1 + 0.2, "0.3"), ([1.0, 2.5], "1, 2.5"), (12, "12")])
def test_values_are_written_as_a_person_would(value, text):
    assert plain(value) == text


def test_the_largest_force_and_pressure_come_with_their_instants():
    time = np.array([0.0, 0.1, 0.2])
    contact = SimpleNamespace(time=time, normal=np.array([1.0, 710.4, 3.0]))
    field = SimpleNamespace(time=time[1:], peak=np.array([2e3, 11.9e3]))
    silent = SimpleNamespace(time=time, normal=np.zeros(3))
    found = facts.largest_values(recording(contacts={"seat": contact, "back": silent}, fields={"seat": field}))
    assert found == "Largest as sampled: seat 710 N at 0.100 s, 11.9 kPa at 0.200 s"
    steady = contact.__class__(time=time, normal=np.array([300.0, 300.1, 300.0]))
    assert facts.largest_values(recording(contacts={"roller": steady})) == "Largest as sampled: roller 300 N all along"
    assert facts.largest_values(recording(contacts={"back": silent})) == ""


def test_numbers_without_any_uncertainty_say_what_speaks_for_them():
    checks = [
        Metric(key, key, 1.0, "N", verdict, None, basis=SELF_CHECK) for key, verdict in (("a", MET), ("b", OUTSIDE))
    ]
    other = Metric("c", "c", 1.0, "N", "no band", None)
    assert facts.without_error([*checks, other]) == "Numerical error not estimated: 1 of 2 self-checks met"
    assert facts.without_error([other]) == "Numerical error not estimated"
    assert facts.without_error([*checks, other._replace(error=0.1)]) == ""
