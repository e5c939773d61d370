"""Repeated runs are of one scene and differ; a band holds its ends whatever rounding adds."""

import math

import pytest

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.records.metric import Band, Metric
from contact_sim_pkg.report.metrics.repeated import repeated


def metric(value):
    return Metric("seat.a_w", "a_w", value, "m/s²", "no band", None)


SCENE = {"name": "ride", "seed": 1, "seat": {"cushion_modulus": 4e4}, "vibration": {"start": 0.0}}


def test_runs_of_one_scene_with_other_seeds_are_pooled():
    (found,) = repeated(["a", "b"], [SCENE, {**SCENE, "seed": 2}], [[metric(1.0)], [metric(1.2)]])
    # Student's t of one degree of freedom at 0.975 is tan(0.475 pi) = 12.706
    assert (found.value, found.spread) == pytest.approx((1.1, 0.1 * math.tan(0.475 * math.pi)))
    other_part = {**SCENE, "vibration": {"start": 5.0}}
    assert repeated(["a", "b"], [SCENE, other_part], [[metric(1.0)], [metric(1.2)]])


def test_a_seed_that_acts_on_nothing_makes_no_second_run():
    with pytest.raises(BagError, match="a and b are the same run"):
        repeated(["a", "b"], [SCENE, {**SCENE, "seed": 2}], [[metric(1.0)], [metric(1.0)]])


def test_runs_of_two_seats_are_not_pooled():
    thin = {**SCENE, "seat": {"cushion_modulus": 2e4}}
    with pytest.raises(BagError, match=r"different scenes \(seat.cushion_modulus\).*bench compare"):
        repeated(["a", "b"], [SCENE, thin], [[metric(1.0)], [metric(1.2)]])


def test_an_effect_without_keys_makes_another_scene():
    one, two = (
        {**SCENE, "effects": {"seat": each}} for each in ({"softening": {}, "foam": {"k": 1}}, {"foam": {"k": 1}})
    )
    with pytest.raises(BagError, match=r"different scenes \(effects.seat.softening\)"):
        repeated(["a", "b"], [one, two], [[metric(1.0)], [metric(1.2)]])


def test_a_band_holds_its_ends_beside_rounding():
    band = Band(110.0, 150.0, "usual", "car tires")
    assert band.holds(40 * 3.75000000000000075)
    assert not band.holds(150.001)
    assert Band(float("-inf"), 1.0, "limit", "").holds(-1e300)


def test_parts_of_one_recording_that_overlap_are_no_repeats():
    runs = [{**SCENE, "duration": 20.0, "vibration": {"file": "/data/bus.csv", "start": start}} for start in (0.0, 1.0)]
    with pytest.raises(BagError, match=r"a and b share 19 s of bus\.csv.*vibration\.start=20 or later"):
        repeated(["a", "b"], runs, [[metric(1.0)], [metric(1.2)]])
    apart = [runs[0], {**runs[1], "vibration": {"file": "/data/bus.csv", "start": 20.0}}]
    assert repeated(["a", "b"], apart, [[metric(1.0)], [metric(1.2)]])
