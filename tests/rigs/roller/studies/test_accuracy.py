"""The study of accuracy and cost of the roller rig's scenes."""

import pytest

from contact_sim_lab.accuracy import scene_study as accuracy_cost
from contact_sim_lab.rigs.roller import accuracy as accuracy_cost_roller
from contact_sim_pkg.scene.resolve import load_resolved

SMALL = (
    "effects.roller.subsurface.cells_x=8",
    "effects.roller.subsurface.cells_y=10",
    "effects.roller.subsurface.cells_z=6",
)
PARTS = {
    "roller_steady": ("ellipse", "dangerous volume"), "roller_flutter": ("ellipse", "tilt and yaw"),
    "roller_programme": accuracy_cost_roller.PARTS,
}  # fmt: skip


def rows_of(name):
    values = SMALL if name != "roller_flutter" else ()
    few = ("effects.roller.damage.table_rows=3",) if name == "roller_programme" else ()
    return accuracy_cost_roller.rows(name, load_resolved(name, *values, *few), lambda line: None)


@pytest.mark.parametrize("name", PARTS)
def test_a_scene_has_the_parts_of_its_effects(name, tmp_path):
    rows = [{**row, "first_call_s": None, "next_start_s": None} for row in rows_of(name)]
    assert tuple(dict.fromkeys(row["part"] for row in rows)) == PARTS[name]
    assert len(accuracy_cost.sections(rows)) == len(PARTS[name]) + 1
    assert accuracy_cost.write_plot(rows, tmp_path / "roller.png").stat().st_size > 10_000


def test_dearer_ways_err_less():
    errors = {(row["part"], row["quantity"], row["level"]): row["error"] for row in rows_of("roller_programme")}
    assert errors["ellipse", "peak pressure", "AGM and Newton"] < 1e-13
    assert 1e-6 < errors["ellipse", "peak pressure", "polynomial (eq 10)"] < 1e-3
    angles = [error for (part, _quantity, _level), error in errors.items() if part == "tilt and yaw"]
    assert angles[0] > angles[1] > angles[2] > angles[4]
    assert angles[-1] < 1e-8
    assert errors["heave", "heave over the track's range", "as it is run, order 4"] < 1e-6
    jumps = [error for (part, _quantity, _level), error in errors.items() if part == "time acceleration"]
    assert 0.0 < jumps[0] < jumps[-1] < 0.05
