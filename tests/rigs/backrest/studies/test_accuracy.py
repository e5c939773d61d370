"""The study of accuracy and cost of the backrest rig."""

import numpy
import pytest

from contact_sim_lab.accuracy import scene_study as accuracy_cost
from contact_sim_lab.rigs.backrest import accuracy as accuracy_cost_backrest
from contact_sim_lab.rigs.backrest.drive import drive_of, fast_run, slow_run
from contact_sim_lab.rigs.backrest.twin import SlappingMass, slapping_mass
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.scene.resolve import load_resolved

SMALL_SHELL = (
    "effects.backrest.shell_modes={}", "backrest.preload=20", "effects.backrest.shell_modes.points_up=8",
    "effects.backrest.shell_modes.points_across=6",
)  # fmt: skip


def quiet(line):
    pass


def by_quantity(rows):
    found = {}
    for row in rows:
        found.setdefault(row["quantity"], []).append(row)
    return found


@pytest.fixture(scope="module")
def slap_rows():
    return accuracy_cost_backrest.tolerance_rows("seat_slap", load_resolved("seat_slap"), quiet)


def test_a_slap_s_error_falls_with_the_requested_tolerance(slap_rows):
    quantities = by_quantity(slap_rows)
    assert set(quantities) == {"motion", "normal force", "friction", "instants of touch"}
    for name, rows in quantities.items():
        assert [row["tolerance"] for row in rows] == pytest.approx([10.0**-k for k in range(3, 12)])
        assert all(
            "own code" in row["reference"] if name == "friction" else "scipy" in row["reference"] for row in rows
        )
        assert all(row["error"] <= row["tolerance"] for row in rows[:7])
        assert rows[6]["error"] < 0.05 * rows[0]["error"]


def test_the_plot_and_the_table_take_the_rows_of_a_back(slap_rows, tmp_path):
    rows = [{**row, "first_call_s": None, "next_start_s": None} for row in slap_rows]
    assert accuracy_cost.write_plot(rows, tmp_path / "slap.png").stat().st_size > 10_000
    table = accuracy_cost.sections(rows)[0]
    assert set(table.rows[0]) == {
        "tolerance", "motion", "normal force", "friction", "instants of touch", "ms per simulated s",
    }  # fmt: skip


def test_the_twin_of_the_study_touches_when_the_mass_under_a_true_sine_does():
    """Another integration, from event to event; the study's drive is straight between samples a millisecond apart."""
    scene = load_resolved("seat_slap")
    contact = scene.data["effects"]["backrest"]
    drive = drive_of(scene, 1.0)
    rig = drive.model.rig
    body = SlappingMass(
        float(rig.mass[0]), float(rig.preload[0]), 14.715, 5.25, contact["normal_elastic"]["coefficient"], 1.5,
        rig.contact.dissipative.damping,
    )  # fmt: skip
    lifted = slapping_mass(body, 1.0)
    twin, own = slow_run(drive), fast_run(drive, 1e-8 * drive.model.scale)
    assert len(twin.touches) >= 4
    for touch in twin.touches:
        assert numpy.abs(lifted.touches - touch).min() < 2e-5
    assert own.touches == pytest.approx(twin.touches, abs=1e-11)


def test_friction_is_measured_where_the_scene_has_it():
    scene = load_resolved("seat_slip", "duration=0.2")
    quantities = by_quantity(accuracy_cost_backrest.tolerance_rows("seat_slip", scene, quiet))
    assert set(quantities) == {"motion", "normal force", "friction"}, "a back that keeps contact touches nothing"
    assert "own code" in quantities["friction"][0]["reference"]
    assert quantities["friction"][-1]["error"] < 1e-9


def test_more_modes_of_a_shell_come_nearer_to_the_most():
    rows = by_quantity(accuracy_cost_backrest.mode_rows("seat_slap", load_resolved("seat_slap", *SMALL_SHELL), quiet))
    motion = {row["level"]: row["error"] for row in rows["motion"]}
    assert list(motion) == ["1 mode", "4 modes", "9 modes", "25 modes"]
    assert motion["1 mode"] > motion["9 modes"] > 1e3 * motion["25 modes"]
    assert accuracy_cost_backrest.mode_rows("seat_slap", load_resolved("seat_slap"), quiet) == []


def test_every_rig_under_an_integrator_has_its_parts():
    assert all(accuracy_cost.studies_of(name) for name in rigs())


def test_pan_and_back_of_foam_are_compared_with_own_code():
    scene = load_resolved("seat_ride_full", "duration=0.2")
    rows = accuracy_cost.studies_of("occupant")[0].rows("seat_ride_full", scene, quiet)
    assert {row["quantity"] for row in rows} == {"motion", "normal force"}
    assert all(row["reference"].startswith("own code") for row in rows)
    errors = [row["error"] for row in rows if row["quantity"] == "motion"]
    assert errors[-1] < 1e-8
    assert errors[-1] <= errors[0]
