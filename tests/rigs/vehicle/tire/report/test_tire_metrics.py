"""Metrics of a tire from a recording in which no two quantities are equal, worked out by numpy and scipy."""

import numpy as np
import pytest
import scipy.stats
from tests.report import uneven_bag as known

from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.series import PressureMap
from contact_sim_pkg.rigs.vehicle.tire.report.metrics import peak_over, tire_metrics

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


def test_the_stiffness_is_the_slope_of_load_over_approach_about_the_standing_load(metrics):
    about = abs(FORCE["normal"] - known.STANDING) <= 0.2 * known.STANDING
    slope = scipy.stats.linregress(FORCE["approach"][about], FORCE["normal"][about]).slope
    assert metrics["stiffness"].value == pytest.approx(1e-3 * slope, rel=1e-9)


def test_the_footprint_is_the_median_of_the_fields_about_the_standing_load(metrics):
    about = abs(FIELD["load"] - known.STANDING) <= 0.1 * known.STANDING
    assert 2 < about.sum() < known.BLOCKS - 1
    sizes = {
        "length": 1e3 * known.CELL_X * np.array(known.LENGTHS),
        "width": 1e3 * known.CELL_Y * np.array(known.WIDTHS),
    }
    for key, values in {**sizes, "area": 1e4 * FIELD["area"], "mean_pressure": 1e-3 * FIELD["mean"]}.items():
        assert metrics[key].value == pytest.approx(np.median(values[about]), rel=1e-9)
    assert metrics["peak_pressure"].value == pytest.approx(1e-3 * FIELD["peak"].max())
    assert metrics["peak_pressure"].remark.endswith(f"at {known.STAMPS[FIELD['peak'].argmax()] * 1e-9:.3f} s")


def test_the_peak_over_a_tread_block_is_the_largest_mean_over_its_cells(metrics):
    """20 mm are two cells along and three across."""
    highest = known.PRESSURES["tire"][FIELD["peak"].argmax()].astype(float)
    blocks = np.lib.stride_tricks.sliding_window_view(highest, (2, 3)).mean(axis=(2, 3))
    assert metrics["patch_pressure"].value == pytest.approx(1e-3 * blocks.max(), rel=1e-12)
    uneven = np.random.default_rng(4).uniform(0.0, 1e5, (9, 7))
    for side, shape in ((0.02, (2, 3)), (0.033, (3, 5))):
        blocks = np.lib.stride_tricks.sliding_window_view(uneven, shape).mean(axis=(2, 3))
        grid = PressureMap(uneven, known.CELL_X, known.CELL_Y, 0.0, 0.0)
        assert peak_over(grid, side) == pytest.approx(blocks.max(), rel=1e-12)


def test_the_resistance_is_the_force_against_the_way_over_the_load(metrics):
    assert metrics["resistance"].value == pytest.approx(
        -known.AXLE["longitudinal"].mean() / FORCE["normal"].mean(), rel=1e-12
    )
    assert metrics["resistance"].value > 0.0
