"""Contact points read one by one."""

from types import SimpleNamespace

import numpy as np
import pytest

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.report.point_reading import PointReader


def instant(*normal, state=None):
    count = len(normal)
    force = np.array(normal, dtype=float)
    return SimpleNamespace(
        x=np.arange(count) * 0.1, y=np.arange(count) * -0.2, approach=force * 1e-3, normal=force, tangential=-0.1 * force,
        displacement=np.full(count, 0.01), state=np.array(state if state is not None else (force > 0.0) * 2, dtype=np.uint8),
    )  # fmt: skip


def taken(*instants):
    points = PointReader()
    for number, each in enumerate(instants):
        points.add(0.1 * number, each)
    return points.finish()


def test_point_1_is_the_one_that_carries_most_at_first():
    series = taken(instant(1.0, 5.0, 2.0), instant(9.0, 1.0, 1.0))
    assert series.normal.tolist() == [5.0, 1.0]
    assert series.tangential == pytest.approx([-0.5, -0.1])
    assert (series.first_x, series.first_y) == pytest.approx((0.1, -0.2))


def test_first_touch_is_the_first_force_after_none():
    series = taken(instant(4.0, 1.0), instant(0.0, 0.0), instant(0.0, 2.0), instant(0.0, 0.0), instant(7.0, 7.0))
    assert series.touch.time == pytest.approx(0.2)
    assert series.touch.normal.tolist() == [0.0, 2.0]
    assert series.heaviest.time == pytest.approx(0.4)


def test_a_contact_that_is_kept_shows_its_first_instant():
    assert taken(instant(4.0), instant(5.0)).touch.time == 0.0


def test_a_contact_that_begins_apart_touches_when_it_first_carries():
    assert taken(instant(0.0), instant(0.0), instant(5.0)).touch.time == pytest.approx(0.2)


def test_states_are_counted():
    series = taken(instant(0.0, 1.0, 1.0, 1.0, state=(0, 1, 2, 3)), instant(1.0, 1.0, 1.0, 1.0, state=(3, 3, 2, 3)))
    assert series.apart.tolist() == [1.0, 0.0]
    assert series.touching.tolist() == [1.0, 0.0]
    assert series.sticking.tolist() == [1.0, 1.0]
    assert series.slipping.tolist() == [1.0, 3.0]


def test_arrays_that_do_not_fit_are_refused():
    odd = instant(1.0, 2.0)
    odd.state = odd.state[:1]
    with pytest.raises(BagError, match="arrays of different length"):
        taken(odd)
    with pytest.raises(BagError, match="are 1, before they were 2"):
        taken(instant(1.0, 2.0), instant(1.0))
