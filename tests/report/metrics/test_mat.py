"""Mat metrics of maps that are summed up by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from contact_sim_pkg.report.metrics.mat import centre, gradient, mat_metrics, path, spd, zones
from contact_sim_pkg.report.series import PressureMap

PAN = ("rear", "middle", "front")


def grid(pressure):
    return PressureMap(np.asarray(pressure, dtype=float), 0.01, 0.02, -0.05, -0.03)


def test_an_even_pressure_has_no_spd_and_two_levels_have_a_known_one():
    assert spd(np.full((3, 4), 5e3)) == 0.0
    # mean 2, sum (p - 2)^2 = 2: 2 / (4 * 2 * 4)
    assert spd(np.array([[1e3, 3e3, 0.0]])) == pytest.approx(100.0 * 2.0 / 32.0)


def test_the_gradient_is_the_steepest_step_between_neighbours():
    assert gradient(grid([[0.0, 100.0], [50.0, 100.0]])) == pytest.approx(100.0 / 0.02)
    assert gradient(grid([[0.0, 10.0], [90.0, 10.0]])) == pytest.approx(90.0 / 0.01)


def test_the_centre_of_pressure_is_the_weighted_mean_of_the_cells():
    assert centre(grid([[0.0, 0.0], [30.0, 10.0]])) == pytest.approx((-0.04, -0.03 + 0.25 * 0.02))


def test_six_zones_of_the_pan_take_the_whole_load():
    pressure = np.repeat(np.array([[1.0], [1.0], [2.0], [2.0], [3.0], [3.0]]), 4, axis=1) * 1e3
    found = zones(grid(pressure), PAN, 3)
    parts = dict(zip(PAN, (1.0, 2.0, 3.0), strict=True))
    assert found == pytest.approx(
        {f"{name} {side}": 100.0 * parts[name] / 12.0 for name in PAN for side in ("left", "right")}
    )
    uneven = zones(grid(np.pad(pressure, ((2, 5), (1, 0)))), PAN, 3)  # cells without load beside them change nothing
    assert uneven == pytest.approx(found)


def test_the_back_has_four_zones_and_the_path_counts_while_it_carries():
    field = SimpleNamespace(
        average=grid(np.full((4, 4), 1e3)), time=np.arange(4) * 0.1, load=np.array([1.0, 1.0, 0.0, 1.0]),
        centre_x=np.array([0.0, 0.003, 0.0, 9.0]), centre_y=np.array([0.0, 0.004, 0.0, 9.0]),
    )  # fmt: skip
    assert np.hypot(*path(field)).sum() == pytest.approx(0.005)
    found = {each.key: each.value for each in mat_metrics("backrest", field, 0.4)}
    assert found["backrest.centre_path"] == pytest.approx(5.0)
    assert [key for key in found if "zone" in key] == [
        f"backrest.zone_{part}_{side}" for part in ("lower", "upper") for side in ("left", "right")
    ]
