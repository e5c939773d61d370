"""Cost of accuracy of the block rig: facets and the compliant contact against located rigid
contact.
"""

from itertools import pairwise

import pytest

from contact_sim_lab.accuracy import scene_study as accuracy_cost
from contact_sim_lab.rigs.body import accuracy as accuracy_cost_block
from contact_sim_pkg.scene.resolve import load_resolved


def quiet(_line):
    pass


def errors(rows, quantity):
    return {row["level"]: row["error"] for row in rows if row["quantity"] == quantity}


@pytest.fixture(scope="module")
def slope_scene():
    return load_resolved("block_slope", "duration=0.5")


def test_a_stiffer_contact_comes_nearer_to_the_rigid_one_that_slides_to_a_stop(slope_scene):
    end = list(errors(accuracy_cost_block.contact_rows("", slope_scene, quiet), "end").values())
    assert len(end) == 6
    assert all(later < 0.2 * earlier for earlier, later in pairwise(end))


def test_turning_on_a_sticking_corner_follows_the_tolerance(slope_scene):
    rows = accuracy_cost_block.turn_rows("", slope_scene, quiet)
    found = {row["tolerance"]: row["error"] for row in rows}
    assert float(slope_scene.data["integrator"]["relative_tolerance"]) in found
    assert all(error <= 10.0 * tolerance for tolerance, error in found.items())
    assert found[1e-4] > 100.0 * found[1e-8] > 0.0
    assert all(row["ms_per_simulated_s"] > 0.0 for row in rows)


def test_a_box_of_a_scene_turns_on_an_edge_and_a_ball_on_none():
    box, ball = (
        accuracy_cost_block.turn_rows("", load_resolved(name), quiet) for name in ("box_3d_tumble", "block_zeno")
    )
    assert len(box) >= 6
    assert all(row["error"] <= 10.0 * row["tolerance"] for row in box)
    assert ball == []


def test_in_the_plane_there_is_no_cone_to_cut(slope_scene):
    assert accuracy_cost_block.facet_rows("", slope_scene, quiet) == []


def test_facets_of_a_sliding_ball_cost_accuracy():
    scene = load_resolved(
        "block_zeno", "block.position=[0,0,0.05]", "block.velocity=[1.0,0.4,0]", "duration=0.1",
        "effects.block.rigid_contact.friction=0.1",
    )  # fmt: skip
    path = errors(accuracy_cost_block.facet_rows("", scene, quiet), "path")
    assert path["4 facets"] > 2.0 * path["16 facets"] > 0.0
    assert path["true cone"] == 0.0


def test_the_table_names_the_parts_of_a_block(slope_scene):
    rows = [
        {**dict.fromkeys(accuracy_cost.COLUMNS), **row}
        for row in accuracy_cost_block.contact_rows("", slope_scene, quiet)
    ]
    titles = [section.title for section in accuracy_cost.sections(rows)]
    assert titles[0].startswith("contact model")
