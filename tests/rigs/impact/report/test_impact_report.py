"""Report and summary of the impact rig: what the bag holds is shown, what it lacks is absent, numbers are the bag's."""

import re
from types import SimpleNamespace

import numpy as np
import pytest

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.report import render
from contact_sim_pkg.rigs.impact.report.material import material_of_run
from contact_sim_pkg.rigs.impact.report.metrics import impact_metrics
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
    (count,) = impact_metrics(early)
    assert (count.value, count.broken) == (0.0, ("too short: no impact ended",))


def test_the_metrics_are_those_of_the_events(rubber):
    metrics = {each.key: each for each in impact_metrics(rubber)}
    events = rubber.series["impacts"].events
    assert metrics["impact.count"].value == len(events.number) == 2
    assert metrics["impact.restitution"].value == events.restitution[0]
    assert metrics["impact.force"].value == pytest.approx(59.1039, abs=1e-3)
    assert metrics["impact.storage_modulus"].verdict == metrics["impact.energy"].verdict == "met"


def test_steel_meets_the_closed_form_of_hertz(tmp_path):
    steel = recording_of(tmp_path, "impact_steel", "duration=0.2")
    metrics = {each.key: each for each in impact_metrics(steel)}
    for key in ("duration", "force", "depth"):
        assert metrics[f"impact.{key}"].band.source == "Hertz's elastic impact"
        assert metrics[f"impact.{key}"].verdict == "met"


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
