"""Bags of others: what cannot be what it is taken for never gives a clean verdict."""

import math
from itertools import product

import numpy
import pytest
from tests.bag import foreign

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.records.metric import NO_BAND
from contact_sim_pkg.report.metrics.foreign import ForeignOptions
from contact_sim_pkg.report.metrics.of_bag import metrics_of_bags
from contact_sim_pkg.report.metrics.views import junit_of

G, RATE, SAMPLES = 9.80665, 400.0, 16_000
TIME = numpy.arange(SAMPLES) / RATE
RIDE = numpy.stack(
    [
        math.sqrt(2.0) * numpy.sin(2.0 * math.pi * 2.0 * TIME),
        0.01 * numpy.sin(2.0 * math.pi * 3.0 * TIME),
        math.sqrt(2.0) * numpy.sin(2.0 * math.pi * 16.0 * TIME) + G,
    ],
    axis=1,
)
A_X, A_Z, A_8 = 0.890, 0.768, 1.246
"""[m/s^2] ISO 2631-1, table 3: Wd(2 Hz), Wk(16 Hz), and 1.4 times the first"""


def bag(path, values, *, covariance=0.0, seconds=lambda t: t):
    types, rows = foreign.STORE.types, []
    vector, quaternion = types["geometry_msgs/msg/Vector3"], types["geometry_msgs/msg/Quaternion"]
    nine = numpy.zeros(9)
    measured = nine.copy()
    measured[0] = covariance
    for number, row in enumerate(values):
        stamp = round(seconds(number / RATE) * 1e9)
        time = types["builtin_interfaces/msg/Time"](stamp // 10**9, stamp % 10**9)
        header = types["std_msgs/msg/Header"](time, "imu")
        message = types[foreign.IMU](
            header,
            quaternion(0.0, 0.0, 0.0, 1.0),
            nine,
            vector(0.0, 0.0, 0.0),
            nine,
            vector(*map(float, row)),
            measured,
        )
        rows.append(("/imu", round(number / RATE * 1e9), bytes(foreign.STORE.serialize_cdr(message, foreign.IMU))))
    path.write_bytes(foreign.mcap(rows, {"/imu": foreign.IMU}))
    return path


def metrics(path, **options):
    found = metrics_of_bags([path], chosen=ForeignOptions(**options))
    return {each.key.removeprefix("imu."): each for each in found.metrics}, found.notes


def test_a_ride_has_the_values_of_the_standard_and_no_mark(tmp_path):
    found, notes = metrics(bag(tmp_path / "a.mcap", RIDE))
    assert (found["x.a_w"].value, found["z.a_w"].value) == pytest.approx((A_X, A_Z), rel=3e-3)
    assert found["a_8"].value == pytest.approx(A_8, rel=3e-3)
    assert all(each.broken == () for each in found.values())
    assert len(notes) == 1


@pytest.mark.fault("A16")
def test_values_in_g_are_refused_until_their_unit_is_stated(tmp_path):
    path = bag(tmp_path / "a.mcap", RIDE / G)
    with pytest.raises(BagError, match=r"gravity in g and not in m/s\^2 .*--unit g"):
        metrics(path)
    assert metrics(path, unit="g")[0]["a_8"].value == pytest.approx(A_8, rel=3e-3)


@pytest.mark.fault("A16")
@pytest.mark.parametrize("order", [(0, 2, 1), (2, 0, 1), (1, 2, 0)])
def test_the_axis_of_gravity_is_weighted_as_the_vertical_one_and_said_first(tmp_path, order):
    found, notes = metrics(bag(tmp_path / "a.mcap", RIDE[:, order]))
    up, along = ("xyz"[order.index(axis)] for axis in (2, 0))
    assert found[f"{up}.a_w"].value == pytest.approx(A_Z, rel=3e-3)
    assert found[f"{along}.a_w"].value == pytest.approx(A_X, rel=3e-3)
    assert found["a_8"].value == pytest.approx(A_8, rel=3e-3)
    assert f"gravity lies on {up}, so {up} points up" in notes[0]


@pytest.mark.fault("A16")
def test_an_unknown_sample_leaves_its_axis_and_what_rests_on_it_without_a_value(tmp_path):
    values = RIDE.copy()
    values[700, 2] = math.nan
    found, _ = metrics(bag(tmp_path / "a.mcap", values))
    for key in ("z.a_w", "a_8", "a_v"):
        assert math.isnan(found[key].value)
        assert found[key].verdict == NO_BAND
    assert all(
        any("z: 1 of 16000 samples unknown: NaN at sample 700" in each for each in m.broken) for m in found.values()
    )
    text = junit_of("ride", list(found.values()))
    assert f'errors="{len(found)}"' in text
    assert found["x.a_w"].value == pytest.approx(A_X, rel=3e-3)


@pytest.mark.fault("A16")
def test_what_was_not_measured_has_no_value(tmp_path):
    found, _ = metrics(bag(tmp_path / "a.mcap", 0.0 * RIDE, covariance=-1.0))
    assert all(math.isnan(each.value) for each in found.values())
    assert "not measured: its covariance begins with -1 (REP 145)" in found["z.a_w"].broken[-1]


@pytest.mark.fault("A16")
def test_no_change_of_unit_axis_sample_or_stamp_yields_a_clean_verdict(tmp_path):
    """Whatever is done to a ride: refused, or its values are right, or marked."""
    units = {"m/s^2": 1.0, "g": 1.0 / G, "mg": 1000.0 / G}
    gravities = {"with gravity": 0.0, "without": G}
    spoilt = {"whole": None, "NaN": math.nan, "inf": math.inf}
    times = {"s": lambda t: t, "ms": lambda t: 1e3 * t, "us": lambda t: 1e6 * t, "shrunk": lambda t: 1e-3 * t}
    seen = []
    for number, (unit, gravity, spoil, time) in enumerate(product(units, gravities, spoilt, times)):
        values = (RIDE - [0.0, 0.0, gravities[gravity]])[
            : 40 * 400 : 1, (0, 2, 1) if number % 2 else (0, 1, 2)
        ] * units[unit]
        if spoilt[spoil] is not None:
            values[123, number % 3] = spoilt[spoil]
        case = (unit, gravity, spoil, time)
        if number % 4 and case[1:] != ("with gravity", "whole", "s"):  # a quarter of them, and each unit alone
            continue
        try:
            found, _ = metrics(bag(tmp_path / f"{number}.mcap", values, seconds=times[time]))
        except BagError:
            seen.append("refused")
            continue
        marked = all(each.broken for each in found.values())
        right = found["a_8"].value == pytest.approx(A_8, rel=3e-3)
        assert marked or right, case
        seen.append("marked" if marked else "right")
    assert set(seen) == {"refused", "marked", "right"}
