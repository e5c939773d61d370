"""Metrics of a tire from a recording in which no two quantities are equal, worked out by numpy and scipy."""

import numpy as np
import pytest
from tests.report import uneven_bag as known

from contact_sim_pkg import load_scene, run
from contact_sim_pkg.pressure.field.extent import extent
from contact_sim_pkg.records.metric import STATE
from contact_sim_pkg.report.field_series import peak_over
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.rigs.vehicle.tire.report.metrics import tire_metrics

FORCE, FIELD = known.FORCES["tire"], known.FIELDS["tire"]


@pytest.fixture(scope="module")
def metrics(uneven):
    return {each.key.partition(".")[2]: each for each in tire_metrics(read_recording(uneven))}


def test_load_and_its_variation_are_those_of_contact_and_asperities_together(metrics):
    carried = FORCE["normal"] + FORCE["impulses"]
    assert metrics["dlc"].value == pytest.approx(carried.std() / known.STANDING, rel=1e-5)
    assert metrics["load"].value == pytest.approx(carried.mean(), rel=1e-12)
    assert metrics["load"].remark == f"{carried.min():.4g} to {carried.max():.4g} N"
    assert metrics["load"].window == pytest.approx((known.START, known.TIMES[-1] + known.PERIOD))


def test_time_off_the_road_counts_samples_and_how_often_it_lifts(metrics):
    assert metrics["lift_off"].value == pytest.approx(100.0 * 3 / 28)
    assert metrics["lift_off"].remark.endswith("2 times")


@pytest.mark.parametrize(
    ("key", "scale", "unit"),
    [
        ("stiffness", 1e-3, "kN/m"),
        ("length", 1e3, "mm"),
        ("width", 1e3, "mm"),
        ("area", 1e4, "cm²"),
        ("mean_pressure", 1e-3, "kPa"),
    ],
)
def test_stiffness_and_footprint_are_those_of_the_standing_tire(metrics, key, scale, unit):
    assert metrics[key].value == pytest.approx(scale * known.STANDS[key], rel=1e-12)
    assert (metrics[key].unit, metrics[key].basis, metrics[key].topic) == (unit, STATE, "tire/standing")


def test_a_bag_without_the_standing_tire_has_no_guess_of_it(uneven, metrics):
    recording = read_recording(uneven)
    older = recording._replace(series={name: value for name, value in recording.series.items() if name != "standing"})
    left = {each.key.partition(".")[2] for each in tire_metrics(older)}
    assert set(metrics) - left == {"stiffness", "length", "width", "area", "mean_pressure"}


def test_the_peak_is_the_largest_of_the_run(metrics):
    assert metrics["peak_pressure"].value == pytest.approx(1e-3 * FIELD["peak"].max())
    assert metrics["peak_pressure"].remark.endswith(f"at {known.STAMPS[FIELD['peak'].argmax()] * 1e-9:.3f} s")


def test_a_footprint_ends_where_the_square_of_its_pressure_comes_to_0():
    """An ellipse of Hertz, whose square is a parabola, within a tenth of a cell wherever its middle lies."""
    for shift in (0.0, 0.3, 0.5):
        x, y = np.arange(40) - 19.5 + shift, np.arange(30) - 14.5
        pressure = np.sqrt(np.maximum(1.0 - (x[:, None] / 13.3) ** 2 - (y[None, :] / 9.7) ** 2, 0.0))
        assert extent(pressure) == pytest.approx(2 * 13.3, abs=0.1)
        assert extent(pressure.T) == pytest.approx(2 * 9.7, abs=0.1)
    assert extent(np.zeros((4, 5))) == 0.0
    assert extent(np.ones((4, 5))) == 4.0


def test_the_peak_over_a_tread_block_is_the_largest_mean_over_a_square(metrics):
    """By brute force: each cell in 60 x 60 even parts, of which squares of 20 mm are whole numbers."""
    fine = 60
    uneven = np.random.default_rng(4).uniform(0.0, 1e5, (7, 6))
    parts = np.repeat(np.repeat(uneven, fine, axis=0), fine, axis=1)
    sums = np.pad(parts, ((1, 0), (1, 0))).cumsum(axis=0).cumsum(axis=1)
    for cells_x, cells_y in ((1.5, 2.25), (2.0, 1.1), (0.4, 0.75)):
        rows, cols = round(fine * cells_x), round(fine * cells_y)
        means = (sums[rows:, cols:] - sums[:-rows, cols:] - sums[rows:, :-cols] + sums[:-rows, :-cols]) / (rows * cols)
        assert peak_over(uneven, 0.02 / cells_x, 0.02 / cells_y, 0.02) == pytest.approx(means.max(), rel=1e-9)
    each = [peak_over(field, known.CELL_X, known.CELL_Y, 0.02) for field in known.PRESSURES["tire"].astype(float)]
    assert metrics["patch_pressure"].value == pytest.approx(1e-3 * max(each), rel=1e-9)


def test_the_resistance_is_the_force_against_the_way_over_the_load(metrics):
    assert metrics["resistance"].value == pytest.approx(
        -known.AXLE["longitudinal"].mean() / FORCE["normal"].mean(), rel=1e-12
    )
    assert metrics["resistance"].value > 0.0


@pytest.mark.parametrize(("duration", "said"), [(0.2, "too short: ends at 2 m, its obstacle at 10.3 m"), (1.1, "")])
def test_a_run_that_ends_before_its_obstacle_is_too_short(tmp_path, duration, said):
    values = ["effects.tire.contact_field=null", f"duration={duration}"]
    found = run(load_scene("tire_bump", *values), tmp_path / "bag").metrics()
    for key in ("tire.load_largest", "tire.load_smallest", "tire.off_the_road"):
        assert "; ".join(found[key].broken) == said
