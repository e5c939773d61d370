import numpy
import pytest

from contact_sim_pkg.records.effect import Observed
from contact_sim_pkg.records.registry import effects
from contact_sim_pkg.rigs.vehicle.studies import accuracy_field as accuracy_cost_field
from contact_sim_pkg.rigs.vehicle.studies import accuracy_integrator as accuracy_cost_integrator
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.studies import cases
from contact_sim_pkg.studies.accuracy import scene_study as accuracy_cost
from contact_sim_pkg.studies.effects import ablation
from contact_sim_pkg.studies.goals import starts


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


def test_every_effect_of_a_scene_has_a_row_with_its_topics(tmp_path):
    scene = load_resolved("seat_ride", "effects.seat={normal_elastic: {}, normal_dissipative: {}}", "duration=1")
    path = tmp_path / "ride.yaml"
    path.write_text(scene.to_yaml(), encoding="utf-8")
    rows = ablation.study(str(path))
    losses = {"normal_dissipative", "general_dissipative"}
    assert {row["effect"] for row in rows} == {
        "normal_elastic",
        *losses,
        "foam",
        "foam_hysteresis",
        "friction",
        "cushion",
        "contact_field",
        "half_space_field",
        "softening",
    }
    by_name = {row["effect"]: row for row in rows}
    assert all("seat/force" in row["topics"] for name, row in by_name.items() if name != "contact_field")
    assert by_name["normal_elastic"]["verdict"] == "carries the load"
    assert by_name["cushion"]["why"] == "in its place normal_elastic carries the load"
    assert by_name["friction"]["on"] is False
    assert by_name["friction"]["load_rms_change"] == 0.0, "friction does not act on the vertical force"
    assert by_name["normal_dissipative"]["load_rms_change"] != 0.0
    changes = [by_name[name]["load_rms_change"] for name in sorted(losses)]
    assert changes[0] == pytest.approx(changes[1], rel=1e-6), "by default the general law is the usual one"


@pytest.mark.parametrize(
    ("scene", "values", "needed"),
    [
        ("tire_bump", ("road={kind: flat}",), False),
        ("tire_bump", ("road.length=0.3",), True),
        ("tire_bump", (), False),
        ("tire_rough_road", (), True),
    ],
)
def test_the_rule_for_the_pressure_field_looks_at_the_waves_of_the_road(scene, values, needed):
    nothing = Observed({}, {}, 0.0)
    assert effects()["contact_field"]["tire"].called_for(load_resolved(scene, *values), nothing)[0] is needed


@pytest.mark.parametrize(("forward", "needed"), [(0.0, False), (0.1, False), (5.0, True)])
def test_the_rule_for_friction_looks_at_the_fore_aft_demand(forward, needed):
    observed = Observed({"seat": numpy.array([450.0, 500.0])}, {"seat": False}, forward)
    assert effects()["friction"]["seat"].called_for(load_resolved("seat_ride"), observed)[0] is needed


def test_the_first_start_of_a_scene_is_measured_cold_and_warm():
    (row,) = starts.study(names=["seat_slap"])
    assert row["kernels"] > 10
    assert row["cold CPU [s]"] > row["warm CPU [s]"] > 0.0
    (section,) = starts.sections([row, {**row, "scene": "dearer", "cold CPU [s]": 1e3, "reached": False}])
    assert [line["scene"] for line in section.rows] == ["dearer", "seat_slap"]
