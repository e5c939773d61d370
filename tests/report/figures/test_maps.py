"""Colour scales and windows of the maps."""

import numpy as np
import pytest

from contact_sim_pkg.report.figures.maps import extension, loaded_window, robust_limits, whole_window
from contact_sim_pkg.report.series import PressureMap

FIELD = PressureMap(np.zeros((10, 20)), 0.01, 0.005, -0.045, -0.0475)


def test_a_smooth_field_is_shown_up_to_its_largest_value():
    values = np.linspace(0.0, 500.0, 1000)

    limits = robust_limits(values, 0.02)

    assert (limits.vmin, limits.vmax) == (0.0, 500.0)
    assert extension(values, limits) == "neither"


def test_a_few_spikes_do_not_darken_the_rest():
    values = np.concatenate([np.zeros(5000), np.full(990, 300.0), np.full(10, 3000.0)])

    limits = robust_limits(values, 0.02)

    assert limits.vmax == pytest.approx(300.0)
    assert extension(values, limits) == "max"


def test_a_field_without_load_has_a_scale_all_the_same():
    assert robust_limits(np.zeros(4), 0.02).vmax == 1.0


def test_the_window_is_the_loaded_cells_and_two_around_them():
    pressure = np.zeros((10, 20))
    pressure[4:6, 8:11] = 1.0

    window = loaded_window(FIELD._replace(pressure=pressure))

    # Loaded from -10 to 10 mm along x and from -10 to 5 mm along y, then two cells of 10 and 5 mm.
    assert window == pytest.approx((-30.0, 30.0, -20.0, 15.0))


def test_without_load_the_window_is_the_whole_grid():
    assert loaded_window(FIELD) == whole_window(FIELD) == pytest.approx((-50.0, 50.0, -50.0, 50.0))
