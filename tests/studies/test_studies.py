import numpy
import pytest

from contact_sim_lab import cases
from contact_sim_lab.accuracy import scene_study as accuracy_cost
from contact_sim_lab.goals import starts
from contact_sim_lab.rigs.vehicle import accuracy_field as accuracy_cost_field
from contact_sim_lab.rigs.vehicle import accuracy_integrator as accuracy_cost_integrator
from contact_sim_pkg.scene.resolve import load_resolved


@pytest.fixture(scope="module")
def tolerance_rows():
    return accuracy_cost_integrator.tolerance_rows(load_resolved("tire_half_space"), lambda text: None)


def test_the_error_of_the_time_integration_falls_with_the_tolerance(tolerance_rows):
    motion = {row["tolerance"]: row["error"] for row in tolerance_rows if row["quantity"] == "motion"}
    assert len(motion) == 8
    assert all(error <= 10.0 * tolerance for tolerance, error in motion.items())
    assert min(motion.values()) < 1e-3 * max(motion.values())


def test_force_and_motion_of_a_tire_on_its_rigid_ring_are_compared_at_the_belt():
    scene = load_resolved("tire_bump", "effects.tire.rigid_ring={}", "duration=0.5")
    rows = accuracy_cost_integrator.tolerance_rows(scene, lambda text: None)
    assert all(row["error"] < 1e-4 for row in rows if row["quantity"] == "normal force")


def test_the_plot_is_drawn_for_every_part_that_is_there(tolerance_rows, tmp_path):
    path = accuracy_cost.write_plot(tolerance_rows, tmp_path / "plot.png")
    assert path.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("field", "constant"),
    [("accuracy", "ACCURACY"), ("work_precision", "WORK_PRECISION"), ("goals", "GOALS"), ("hard_cases", "CASES")],
)
def test_every_module_that_a_rig_names_has_its_cases(field, constant):
    modules = cases.modules_of_rigs(field)
    assert modules
    assert all(cases.objects((module,), constant) for module in modules)


def test_means_over_coarser_cells_keep_the_integral_and_a_constant():
    fine = numpy.random.default_rng(3).random((30, 42))
    coarse = accuracy_cost_field._onto(fine, (20, 12))
    assert coarse.shape == (20, 12)
    assert coarse.mean() == pytest.approx(fine.mean(), rel=1e-13)
    assert accuracy_cost_field._onto(numpy.full((30, 42), 2.5), (20, 12)) == pytest.approx(2.5)
    assert accuracy_cost_field._onto(fine, (15, 21))[3, 4] == pytest.approx(fine[6:8, 8:10].mean())


def test_the_first_start_of_a_scene_is_measured_cold_and_warm():
    (row,) = starts.study(names=["seat_slap"])
    assert row["kernels"] > 10
    assert row["cold CPU [s]"] > row["warm CPU [s]"] > 0.0
    (section,) = starts.sections([row, {**row, "scene": "dearer", "cold CPU [s]": 1e3, "reached": False}])
    assert [line["scene"] for line in section.rows] == ["dearer", "seat_slap"]
