"""The road and the travel from overlapping blocks."""

from types import SimpleNamespace

import numpy as np
import pytest
from tests.report import rolling_bag as known

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.rigs.vehicle.tire.report.road_series import RoadReader


def message(patch):
    rows, cols = patch.height.shape
    return SimpleNamespace(**{**patch._asdict(), "height": patch.height.ravel()}, rows=rows, cols=cols)


@pytest.fixture(scope="module")
def road():
    passing = RoadReader()
    for block in range(100):
        passing.add(block * known.BLOCK_LENGTH, "", message(known.road(block)))
    return passing.finish()


def test_every_row_of_the_road_is_there_once(road):
    np.testing.assert_allclose(np.diff(road.distance), known.CELL_X)
    assert road.distance[0] == pytest.approx(-0.2)
    assert road.distance[-1] > 9.9


def test_heights_are_those_of_the_step(road):
    np.testing.assert_allclose(road.middle, np.where(road.distance >= known.STEP_AT - 1e-9, known.STEP, 0.0), atol=1e-9)
    np.testing.assert_array_equal(road.low, road.middle)
    np.testing.assert_array_equal(road.high, road.middle)


def test_travel_reaches_to_the_end_of_the_last_block(road):
    assert road.travel.at(np.array([0.0, 0.123, 1.0])) == pytest.approx([0.0, 1.23, 10.0])


def test_the_strip_holds_the_extremes_beside_the_middle():
    patch = known.road(0)
    height = patch.height.copy()
    beside = known.COLS // 2 + 5  # 27.5 mm from the middle
    height[:, beside], height[:, 0] = 0.02, 0.5  # the last one lies far outside
    passing = RoadReader()
    passing.add(0.0, "", message(patch._replace(height=height)))

    road = passing.finish()

    assert (road.low.max(), road.high.min(), road.high.max()) == (0.0, pytest.approx(0.02), pytest.approx(0.02))
    assert not road.middle.any()


def test_a_block_that_does_not_fill_its_grid_is_refused():
    broken = message(known.road(0))
    broken.rows += 1

    with pytest.raises(BagError, match=r"has 14400 heights for 151 x 96 nodes"):
        RoadReader().add(0.0, "", broken)
