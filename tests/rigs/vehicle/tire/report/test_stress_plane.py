"""Stress below Hertz fields, against the textbook values of the circular contact."""

import numpy as np
import pytest

from contact_sim_pkg.report.series import PressureMap
from contact_sim_pkg.rigs.vehicle.tire.report import stress_plane as module
from contact_sim_pkg.rigs.vehicle.tire.report.stress_plane import stress_plane

RADIUS, PEAK = 0.05, 400e3  # [m], [Pa]


def circle(cells=80, centre=(0.01, -0.02)):
    cell = 3.0 * RADIUS / cells
    x = (np.arange(cells) - 0.5 * (cells - 1)) * cell
    pressure = PEAK * np.sqrt(np.maximum(1.0 - (x[:, None] ** 2 + x[None, :] ** 2) / RADIUS**2, 0.0))
    return PressureMap(pressure, cell, cell, centre[0] + x[0], centre[1] + x[0])


# Johnson, Contact Mechanics, section 3.4: largest shear over p0 and its depth over the radius.
@pytest.mark.parametrize(("poisson", "shear", "depth"), [(0.3, 0.310, 0.481), (0.5, 0.266, 0.548)])
def test_largest_shear_below_a_circular_contact(poisson, shear, depth):
    plane = stress_plane(circle(), poisson)

    row, col = np.unravel_index(plane.max_shear.argmax(), plane.max_shear.shape)
    assert plane.max_shear[row, col] / PEAK == pytest.approx(shear, abs=0.002)
    assert plane.z[row] / RADIUS == pytest.approx(depth, abs=0.03)
    assert plane.x[col] == pytest.approx(0.01, abs=1e-3)
    assert plane.y == pytest.approx(-0.02, abs=1e-6)


def test_on_the_axis_von_mises_is_twice_the_shear_and_the_compression_is_known():
    plane = stress_plane(circle(), 0.3)

    axis = module.COLUMNS // 2
    np.testing.assert_allclose(plane.von_mises[:, axis], 2.0 * plane.max_shear[:, axis], rtol=2e-3)
    np.testing.assert_allclose(plane.normal[5:, axis], -PEAK / (1.0 + (plane.z[5:] / RADIUS) ** 2), rtol=5e-3)


def test_a_large_field_is_averaged_and_keeps_its_stresses(monkeypatch):
    fine = stress_plane(circle(81), 0.5)
    monkeypatch.setattr(module, "MOST_TERMS", 3e6)

    coarse = stress_plane(circle(81), 0.5)

    assert coarse.z[0] == pytest.approx(2.0 * fine.z[0])
    assert coarse.max_shear.max() == pytest.approx(fine.max_shear.max(), rel=0.02)
    assert coarse.y == pytest.approx(fine.y, abs=1e-5)


def test_a_field_without_load_has_no_stress():
    assert stress_plane(circle()._replace(pressure=np.zeros((4, 4))), 0.5) is None
