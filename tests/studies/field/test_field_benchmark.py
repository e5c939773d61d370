import math

import numpy
import pytest

from contact_sim_lab.field import field_benchmark
from contact_sim_lab.rigs.vehicle.work_precision import rolling_problem


def test_the_road_has_the_spectrum_that_is_asked_for():
    heights = rolling_problem.rough_road(1)
    wave = numpy.fft.rfftfreq(2048, rolling_problem.FINEST)
    density = 2.0 * (abs(numpy.fft.rfft(heights, axis=0)) ** 2).mean(axis=1) * rolling_problem.FINEST / 2048
    for low, high in ((6.0, 20.0), (20.0, 60.0)):  # the band's upper end takes power from profiles near it
        band = (wave >= low) & (wave < high)
        assert (density[band] * wave[band] ** 2).mean() == pytest.approx(256e-6 * 0.01, rel=0.25)


def test_a_coarser_grid_takes_every_second_node():
    fine, coarse = (rolling_problem.rolling_problem(grid, 2) for grid in ("256x192", "128x96"))
    numpy.testing.assert_array_equal(coarse.road, fine.road[::2, ::2])
    assert coarse.half_space.cell_x == 2.0 * fine.half_space.cell_x


def test_times_are_read_at_equal_error():
    rows = [{"error": 1e-2, "ms": 1.0}, {"error": 1e-4, "ms": 4.0}]
    assert field_benchmark.read_at(rows, 1e-3) == pytest.approx(2.0)
    assert field_benchmark.read_at(rows, 1e-5) is None
    assert field_benchmark.read_at(rows, 1e-1) == 1.0


def test_a_short_sequence_is_measured():
    found = field_benchmark.rows_of("128x96", 1, 1, 6, ("rolling",), lambda _text: None)
    assert all(math.isfinite(row["ms"]) and row["error"] < 0.5 for row in found)
    assert found[-1]["error"] < 1e-4
