"""Mat metrics of maps that are summed up by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from scipy import ndimage

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


UNEVEN = np.pad(np.random.default_rng(12).uniform(2e3, 50e3, (6, 5)), ((1, 3), (2, 1)))
"""Loaded on six rows from row 1, on five columns from column 2, no two cells alike."""


def test_each_zone_of_an_uneven_map_has_its_own_load_left_and_right():
    """Rows in thirds from the rear; of five columns the middle one lies to the right of its edge."""
    loaded, found = UNEVEN[1:7, 2:7], zones(grid(UNEVEN), PAN, 3)
    for number, name in enumerate(PAN):
        third = loaded[2 * number : 2 * number + 2]
        assert found[f"{name} left"] == pytest.approx(100.0 * third[:, 3:].sum() / loaded.sum())
        assert found[f"{name} right"] == pytest.approx(100.0 * third[:, :3].sum() / loaded.sum())
    assert len({round(share, 3) for share in found.values()}) == 6


def test_each_number_of_an_uneven_map_is_its_own_with_its_unit():
    field = SimpleNamespace(
        average=grid(UNEVEN), time=np.arange(5) * 0.1, load=np.array([1.0, 2.0, 3.0, 4.0, 5.0]),
        centre_x=np.array([0.0, 0.003, 0.001, 0.004, 0.0045]), centre_y=np.array([0.0, 0.004, 0.002, 0.002, 0.0026]),
    )  # fmt: skip
    found = {each.key.partition(".")[2]: each for each in mat_metrics("seat", field, 0.7)}
    loaded = UNEVEN[1:7, 2:7]
    middle = ndimage.center_of_mass(UNEVEN)
    steep = max(abs(np.diff(UNEVEN, axis=0)).max() / 0.01, abs(np.diff(UNEVEN, axis=1)).max() / 0.02)
    expected = {
        "map_load": (2e-4 * loaded.sum(), "N"), "map_area": (2.0 * loaded.size, "cm²"),
        "map_mean": (1e-3 * loaded.mean(), "kPa"), "map_peak": (1e-3 * loaded.max(), "kPa"),
        "map_gradient": (1e-3 * steep / 100.0, "kPa/cm"), "map_spd": (25.0 * (loaded.std() / loaded.mean()) ** 2, "%"),
        "centre_x": (1e3 * (-0.05 + 0.01 * middle[0]), "mm"), "centre_y": (1e3 * (-0.03 + 0.02 * middle[1]), "mm"),
        "centre_path": (1e3 * (0.005 + math.sqrt(8e-6) + 0.003 + math.sqrt(0.61e-6)), "mm"),
    }  # fmt: skip
    for key, (value, unit) in expected.items():
        assert (found[key].value, found[key].unit) == (pytest.approx(value, rel=1e-9), unit), key
    assert found["map_mean"].window == (0.0, 0.7)
