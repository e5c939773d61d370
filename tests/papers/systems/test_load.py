"""System *load*: runs over seeds of a random road."""

import numpy
import pytest

from contact_sim_lab.papers.tire_road.system_load import load_over_seeds, loads_of
from contact_sim_lab.records.paper import PaperError
from contact_sim_pkg.library import load_scene, run, series

SCENE = """
rig: tire
description: a point contact on a random road
duration: 0.2
travel: {speed: 5.0}
road: {kind: iso8608, roughness_class: B}
effects:
  tire: {normal_elastic: {}, normal_dissipative: {}}
outputs: {force_rate: 500.0}
"""


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "road.yaml"
    path.write_text(SCENE, encoding="utf-8")
    return path


def test_each_row_is_the_run_of_its_seed_and_the_numbers_are_theirs(scene):
    values = {"seeds": 3, "first": 4, "duration": 0.0, "start": 0.0}
    rows = {row["quantity"]: row["value"] for row in load_over_seeds(scene, values).rows}
    loads = numpy.array([series(run(load_scene(scene, f"seed={seed}")), "tire/force")["normal"] for seed in (4, 5, 6)])
    assert rows["mean load"] == pytest.approx(loads.sum() / loads.size, rel=1e-12)
    spread = numpy.sqrt((((loads - loads.sum(axis=0) / 3.0) ** 2).sum(axis=0) / 2.0).mean())
    assert rows["spread over the seeds, rms over time"] == pytest.approx(spread, rel=1e-12)
    assert spread > 1.0
    assert loads_of(str(scene), range(4, 6), 0.1).loads == pytest.approx(loads[:2, :50], rel=1e-12)


def test_a_road_without_chance_and_scenes_without_a_road_are_named(scene):
    scene.write_text(SCENE.replace("{kind: iso8608, roughness_class: B}", "{kind: flat}"), encoding="utf-8")
    values = {"seeds": 2, "first": 1, "duration": 0.1, "start": 0.0}
    assert "give a scene with a random one" in load_over_seeds(scene, values).note
    with pytest.raises(PaperError, match="start 5 s: the runs end at"):
        load_over_seeds(scene, values | {"start": 5.0})
    with pytest.raises(PaperError, match="rig seat has no wheel on a road"):
        loads_of("seat_ride", range(1, 3))
