"""The companion of a scene: each dial one level finer, all else as it is."""

import pytest

from contact_sim_pkg.compare.companion import companion_of, dials_of, factor_of, finer_than
from contact_sim_pkg.compare.excitation_check import foreign_topics, other_road
from contact_sim_pkg.run.sources import make_sources, make_surface, road_lattice
from contact_sim_pkg.scene.resolve import load_resolved


@pytest.fixture(scope="module")
def scene():
    return load_resolved("tire_rough_road", "duration=0.2")


def test_each_dial_is_one_level_finer_and_nothing_else_changes(scene):
    finer = companion_of(scene)
    before, after = dials_of(scene.data), {key: dials_of(finer.scene.data)[key] for key in dials_of(scene.data)}
    ratios = {key: after[key] / before[key] for key in before}
    assert ratios["integrator.relative_tolerance"] == pytest.approx(0.01, rel=1e-12)
    assert ratios["integrator.coupling_tolerance"] == pytest.approx(0.25, rel=1e-12)
    assert ratios["effects.tire.contact_field.rows"] == pytest.approx(1.5, rel=1e-12)
    assert ratios["effects.tire.contact_field.cols"] == pytest.approx(1.5, rel=1e-12)
    assert ratios["effects.tire.contact_field.tolerance"] == pytest.approx(0.1, rel=1e-12)
    assert ratios["outputs.force_rate"] == pytest.approx(4.0, rel=1e-12)
    turned = ("integrator", "effects", "outputs")
    assert [key for key in scene.data if finer.scene.data[key] != scene.data[key]] == [
        key for key in scene.data if key in turned
    ]


def test_without_the_grid_fields_keep_their_cells(scene):
    finer = companion_of(scene, grid=False)
    field, before = (each.data["effects"]["tire"]["contact_field"] for each in (finer.scene, scene))
    assert (field["rows"], field["cols"]) == (before["rows"], before["cols"])
    assert not finer.grid


def test_the_longest_way_between_two_fields_is_a_dial_where_the_scene_has_it(scene):
    data = {**scene.data, "integrator": {**scene.data["integrator"], "coupling_length": 0.03}}
    assert dials_of(data)["integrator.coupling_length"] == 0.03


def test_a_dial_at_its_bound_stays():
    finest = load_resolved("block_slope", "integrator.relative_tolerance=1e-13")
    assert companion_of(finest).dials == ()
    assert finer_than(finest, finest).data == finest.data


def test_a_reference_shares_no_dial_with_what_it_judges():
    """The grid of tire_texture is given, its tolerances follow from the request."""
    judged, reference = (load_resolved("tire_texture", f"accuracy={accuracy}") for accuracy in ("1e-3", "1e-4"))
    finer = dials_of(finer_than(reference, judged).data)
    given, free = dials_of(judged.data), dials_of(reference.data)
    assert finer["effects.tire.contact_field.rows"] == 1.5 * given["effects.tire.contact_field.rows"]
    assert finer["integrator.coupling_tolerance"] == free["integrator.coupling_tolerance"]
    assert finer["integrator.relative_tolerance"] == pytest.approx(0.01 * free["integrator.relative_tolerance"])
    assert not any(finer[key] == given[key] for key in given)


def test_the_delivered_error_follows_from_the_share_of_the_finer_run(scene):
    """1 / (1 - (2/3)^2) of a grid of second order, 1 / (1 - 1/4) of the coupling."""
    assert factor_of("force", companion_of(scene)) == pytest.approx(4.0 / 3.0, rel=1e-12)
    assert factor_of("area", companion_of(scene)) == pytest.approx(9.0 / 5.0, rel=1e-12)
    assert factor_of("peak", companion_of(scene, grid=False)) == pytest.approx(4.0 / 3.0, rel=1e-12)
    assert factor_of("force", companion_of(load_resolved("seat_ride"))) == pytest.approx(9.0 / 5.0, rel=1e-12)
    assert factor_of("motion", companion_of(load_resolved("block_slope"))) == pytest.approx(1.0 / 0.99, rel=1e-12)


def surface_of(scene):
    return make_surface(scene, road_lattice(scene).cell_x)


def test_a_finer_lattice_carries_the_same_road(scene):
    finer = companion_of(scene).scene
    coarse, fine = (make_sources(each)["road/patch"] for each in (scene, finer))
    assert fine.block(3).height.size > 2 * coarse.block(3).height.size
    assert other_road(coarse, surface_of(finer), (0, 3)) == 0.0


def test_another_road_is_seen_on_the_finer_lattice_and_in_the_bag(scene):
    same, another = make_sources(scene), load_resolved("tire_rough_road", "duration=0.2", "seed=2")
    assert foreign_topics(same, make_sources(scene), (0, 3)) == []
    assert foreign_topics(same, make_sources(another), (0, 3)) == ["road/patch"]
    assert foreign_topics(same, {}, (0, 3)) == ["road/patch"]
    assert other_road(same["road/patch"], surface_of(companion_of(another).scene), (0, 3)) > 1e-4
