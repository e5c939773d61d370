"""Each rig's list on its main scene: 8 to 14 metrics, at least half with a band or a closed form, none of these missed."""

import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.records.metric import CLOSED_FORM, EVENT, OUTSIDE, SELF_CHECK, STATE, STATIONARY
from contact_sim_pkg.report.metrics.listing import metrics_of
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.run.offline import run_offline

MAIN = [
    ("seat_ride", "duration=40"), ("tire_rough_road", "duration=1"), ("seat_slap", "duration=1.2"), ("impact_rubber_drop",),
    ("block_fall",), ("roller_steady",),
]  # fmt: skip


@pytest.mark.parametrize("scene", MAIN, ids=[scene[0] for scene in MAIN])
def test_the_list_of_the_main_scene(scene, tmp_path):
    assert run_offline(resolved(*scene), tmp_path / "bag").failure == ""
    found = metrics_of(read_recording(open_bag(tmp_path / "bag")))
    assert 8 <= len(found) <= 14
    assert len({each.key for each in found}) == len(found)
    assert 2 * sum(each.band is not None for each in found) >= len(found)
    assert [each.name for each in found if each.verdict == OUTSIDE and not each.broken] == []
    assert all(each.topic and each.window[1] > each.window[0] for each in found)
    assert all(each.basis == SELF_CHECK for each in found if each.band is not None and each.band.kind == CLOSED_FORM)
    assert {each.basis for each in found} <= {EVENT, STATIONARY, STATE, SELF_CHECK}
