"""Report and summary of the impact rig: what the bag holds is shown, what it lacks is absent, numbers are the bag's."""

import json
import re
from types import SimpleNamespace

import numpy as np
import pytest

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.report import render
from contact_sim_pkg.report.summary import summarise_recording
from contact_sim_pkg.rigs.impact.report.figures_material import material_of_run
from contact_sim_pkg.rigs.impact.report.series import MOST_COURSES, ImpactReader, hertz_pressure, impact_warnings
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import resolve

PICTURES = ("bounces", "force", "indentation", "stress", "wave", "front", "position", "material")


def recording_of(folder, name, *values):
    run_offline(resolve(load_scene(name, [set_value(each) for each in values])), folder / "bag")
    return read_recording(open_bag(folder / "bag"))


@pytest.fixture(scope="module")
def rubber(tmp_path_factory):
    return recording_of(tmp_path_factory.mktemp("rubber"), "impact_rubber_drop", "duration=0.5")


def shown(page):
    return [name for name in PICTURES if re.search(rf'id="impact-{name}-', page)]


def test_every_picture_is_there_and_marks_of_another_rig_are_not(rubber):
    page = render(rubber)
    assert shown(page) == list(PICTURES)
    assert "Backrest contact" not in page
    assert "E′ and tan β as bench material reads them" in page


def test_an_effect_that_is_off_has_no_picture(tmp_path):
    bare = recording_of(
        tmp_path, "impact_rubber_drop", "duration=0.3", "effects.impact={normal_elastic: {}, micro_front: {}}",
        "impact.course_samples=0",
    )  # fmt: skip
    assert shown(render(bare)) == ["bounces", "front", "material"]


def test_a_run_that_ends_before_the_touch_has_a_page_without_impacts(tmp_path):
    early = recording_of(tmp_path, "impact_rubber_drop", "duration=0.1")
    assert "impacts" not in early.series
    assert shown(render(early)) == []
    assert "impacts" not in summarise_recording(early)


def test_the_summary_has_the_events_and_is_json(rubber):
    impacts = summarise_recording(rubber)["impacts"]
    events = rubber.series["impacts"].events
    assert impacts["count"] == len(events.number) == 2
    assert impacts["restitution"] == events.restitution.tolist()
    assert impacts["peak_force_max_N"] == pytest.approx(59.1039, abs=1e-3)
    json.dumps(impacts)


def test_the_material_of_the_run_is_that_of_its_scene(rubber):
    for estimate in material_of_run(rubber.series["impacts"], rubber.scene).estimates:
        assert estimate.storage_modulus.value == pytest.approx(8.0e6, rel=1e-9)
        assert estimate.loss_tangent.value == pytest.approx(0.2, rel=1e-9)


def test_many_impacts_keep_the_courses_of_the_first_alone(tmp_path):
    many = recording_of(tmp_path, "impact_steel", "impact.speeds=[0.05]", "duration=0.5", "outputs.force_rate=1000")
    assert len(many.series["impacts"].events.number) > MOST_COURSES
    assert [each.number for each in many.series["impacts"].courses] == list(range(MOST_COURSES))


def test_a_bag_without_impacts_has_no_series():
    assert ImpactReader().finish() is None


def test_a_sphere_beyond_first_yield_is_reported():
    """Hertz in another form: p0 = (2 E*/pi) sqrt(d/R) at the depth d = (3 F/(4 E* sqrt(R)))^(2/3); first yield at 1.60 times."""
    force, modulus, radius = np.array([100.0, 1000.0]), np.array([1.05e11, 1.05e11]), np.array([0.01, 0.02])
    depth = (0.75 * force / (modulus * np.sqrt(radius))) ** (2.0 / 3.0)
    pressure = hertz_pressure(force, modulus, radius)
    assert pressure == pytest.approx(2.0 * modulus / np.pi * np.sqrt(depth / radius), rel=1e-12)
    events = SimpleNamespace(
        peak_force=force, storage_modulus=modulus / 2.0**0.5, shape_factor=np.full(2, 2.0**0.5), radius=radius,
        start=np.array([0.1, 0.2]), peak_time=np.array([3e-5, 3e-5]), release=np.array([0, 1]),
    )  # fmt: skip
    rig = {"speeds": [1.0, 2.0], "temperatures": [293.0], "repeats": 1, "bounces": 1, "sample": {}}
    recording = SimpleNamespace(
        scene={"rig": "impact", "impact": rig}, series={"impacts": SimpleNamespace(events=events)}
    )
    assert impact_warnings(recording) == []
    rig["sample"] = {"yield_strength": float(pressure[1]) / 1.60 * 0.999}
    (sentence,) = impact_warnings(recording)
    assert "1.6 times impact.sample.yield_strength, first at 0.2 s" in sentence
