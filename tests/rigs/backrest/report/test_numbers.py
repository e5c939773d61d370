"""Numbers behind the backrest's pictures, against closed forms and the bag read by other means."""

import math

import numpy as np
import pytest
from tests.rigs.backrest.report import backrest_bag as known

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.records.messages import ContactPatch, ContactPoints
from contact_sim_pkg.report.point_series import PointSeries
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.series import PressureMap
from contact_sim_pkg.report.signal import episodes, loops
from contact_sim_pkg.rigs.backrest.report import numbers

FREQUENCY = 5.0
OMEGA = 2.0 * math.pi * FREQUENCY


@pytest.fixture(scope="module")
def kept_bag(tmp_path_factory):
    return known.backrest_bag(tmp_path_factory.mktemp("bags") / "kept", FREQUENCY, slaps=False)


@pytest.fixture(scope="module")
def slap_bag(tmp_path_factory):
    return known.backrest_bag(tmp_path_factory.mktemp("bags") / "slap", FREQUENCY, points=6)


@pytest.fixture(scope="module")
def kept(kept_bag):
    return read_recording(kept_bag)


@pytest.fixture(scope="module")
def slap(slap_bag):
    return read_recording(slap_bag)


def test_the_normal_loop_encloses_the_work_of_its_damper(kept):
    last = loops.normal_loop(kept.contacts["backrest"]).since(loops.steady_start(2.0, 1.0 / FREQUENCY))
    closed = loops.Loop(*(np.append(column, column[0]) for column in last))
    work = 2.0 * math.pi * known.DAMPING * OMEGA * known.KEPT**2
    assert loops.loop_work(closed) == pytest.approx(work, rel=1e-3)


def test_the_friction_loop_has_the_paper_s_sign_and_the_work_of_its_damper(kept):
    loop = loops.tangential_loop(kept.contacts["backrest"], kept.points)
    slid = known.SLIDING * np.sin(OMEGA * loop.time)
    force = known.FRICTION_STIFFNESS * slid + known.FRICTION_DAMPING * known.SLIDING * OMEGA * np.cos(OMEGA * loop.time)
    assert loop.force == pytest.approx(force, abs=1e-3)
    inner = slice(100, -100)  # the spline has no more than its end conditions at the ends
    assert loop.displacement[inner] == pytest.approx(slid[inner], abs=1e-4 * known.SLIDING)
    cycle = (loop.time >= 1.0 - 1e-9) & (loop.time <= 1.2 + 1e-9)
    enclosed = loops.Loop(*(column[cycle] for column in loop))
    work = math.pi * known.FRICTION_DAMPING * OMEGA * known.SLIDING**2
    assert loops.loop_work(enclosed) == pytest.approx(work, rel=1e-3)


def test_the_loop_of_one_of_many_points_is_what_its_messages_say(slap, slap_bag):
    loop = loops.point_loop(slap.points)
    messages = [decode(ContactPoints, each.data) for each in slap_bag.messages("/backrest/points")]
    assert loop.force.tolist() == [each.normal[3] for each in messages]
    friction = loops.tangential_loop(slap.contacts["backrest"], slap.points)
    assert friction.force.tolist() == [-each.tangential[3] for each in messages]


def test_the_area_ratio_is_one_at_rest_and_counts_loaded_cells(slap, slap_bag):
    area = loops.area_ratio(slap.fields["backrest"])
    loaded = [
        int(np.count_nonzero(decode(ContactPatch, each.data).pressure)) for each in slap_bag.messages("/backrest/patch")
    ]
    assert area.reference == pytest.approx(known.REST_CELLS * known.CELL_X * known.CELL_Y, rel=1e-12)
    assert area.ratio == pytest.approx(np.array(loaded) / known.REST_CELLS, rel=1e-12)
    assert set(loaded) == {0, known.REST_CELLS, known.DEEP_CELLS}


def test_there_is_no_area_ratio_where_the_contact_at_rest_is_not_recorded(slap):
    field = slap.fields["backrest"]
    assert loops.area_ratio(field._replace(time=field.time + 0.5)) is None


def test_shares_add_up_and_are_those_of_the_closed_form(kept):
    shares = numbers.state_shares(kept.points, 1.0 / FREQUENCY)
    assert shares.edges == pytest.approx(np.arange(11) / FREQUENCY, abs=1e-9)
    total = shares.apart + shares.touching + shares.sticking + shares.slipping
    assert total == pytest.approx(1.0, rel=1e-12)
    assert not shares.apart.any()
    assert shares.sticking == pytest.approx(0.5, abs=0.051), "sin > 0: 9 or 10 of the 20 instants of a cycle"


def test_shares_of_many_points_are_parts_of_all_points():
    zeros = np.zeros(4)
    points = PointSeries(
        np.arange(4) * 0.1, 10, np.array([10.0, 5.0, 5.0, 0.0]), zeros, np.array([0.0, 5.0, 3.0, 4.0]),
        np.array([0.0, 0.0, 2.0, 6.0]), 0.0, 0.0, zeros, zeros, zeros, zeros, None, None,
    )  # fmt: skip
    shares = numbers.state_shares(points, 0.2)
    assert shares.apart == pytest.approx([0.75, 0.25])
    assert shares.sticking == pytest.approx([0.25, 0.35])
    assert shares.slipping == pytest.approx([0.0, 0.4])


def test_slaps_last_from_touch_to_loss(slap):
    slaps = episodes.slaps_of(slap.episodes)
    assert slaps.start == pytest.approx(known.touches(FREQUENCY))
    assert episodes.durations(slaps) == pytest.approx(0.5 / FREQUENCY)
    assert numbers.heaviest_slap(slaps) == 0


def test_a_run_without_episodes_has_no_slaps(kept):
    assert episodes.slaps_of(kept.episodes).start.size == 0
    assert episodes.slaps_of(None).start.size == 0
    assert numbers.heaviest_slap(episodes.slaps_of(None)) is None


@pytest.mark.parametrize(
    ("scene", "period"),
    [
        ({"vibration": {"kind": "sine", "axis": "x", "amplitude": 1.0, "frequency": 4.0}}, 0.25),
        ({"vibration": {"kind": "half_sine"}, "backrest": {"sliding": {"amplitude": 1.0, "frequency": 2.0}}}, None),
        ({"vibration": None, "backrest": {"sliding": {"amplitude": 0.01, "frequency": 2.0}}}, 0.5),
        ({"vibration": None, "backrest": {"sliding": {"amplitude": 0.0, "frequency": 2.0}}}, None),
        ({}, None),
    ],
)
def test_the_drive_has_a_period_where_it_is_a_sine(scene, period):
    assert numbers.drive_period(scene) == period


def test_a_coarse_loop_stands_for_the_second_half_of_the_run():
    time = np.linspace(0.0, 4.0, 401)
    fine, dots = loops.Loop(*(np.linspace(0.0, 4.0, 4001),) * 3).steady(3.6)
    assert not dots
    assert fine.time[0] == pytest.approx(3.6)
    coarse, dots = loops.Loop(time, time, time).steady(3.6)
    assert dots
    assert coarse.time[0] == pytest.approx(2.0)
    whole, dots = loops.Loop(time[:50], time[:50], time[:50]).steady(0.0)
    assert not dots
    assert whole.time.size == 50


def test_the_lumbar_part_and_the_height_are_those_of_the_mean_map(kept):
    """Rows of a map by hand: 3, 1, 2 and 4 N at 0.10, 0.15, 0.20 and 0.25 m; lumbar within 60 mm of 0.2 m."""
    pressure = np.repeat(np.array([[3.0], [1.0], [2.0], [4.0]]), 5, axis=1)
    average = kept.fields["backrest"].average._replace(pressure=pressure, cell_x=0.05, origin_x=0.10)
    field = kept.fields["backrest"]._replace(average=average)
    scene = {**kept.scene, "effects": {"backrest": {"cushion": {"lumbar_height": 0.2}}}}
    recording = kept._replace(scene=scene, fields={"backrest": field})
    assert numbers.back_load(recording) == pytest.approx((0.185, 0.7))
    assert numbers.back_load(kept) is None


def test_a_back_that_ends_within_its_footprint_is_said():
    """A grid of 40 by 32 cells of 12.5 mm is that of a back 500 mm high and 400 mm wide."""
    pressure = np.zeros((40, 32))
    field = PressureMap(pressure, 0.0125, 0.0125, -0.24375, -0.19375)
    pressure[1:-1, 1:-1] = 1.0
    assert numbers.ends_of_back(field) == ""
    pressure[0, 10] = pressure[-1, 10] = 1.0
    assert numbers.ends_of_back(field) == "the footprint is cut at -250 and 250 mm (up, x), where the back ends"
    pressure[20, 31] = 1.0
    assert numbers.ends_of_back(field).endswith("-250 and 250 mm (up, x), 200 mm (left, y), where the back ends")
