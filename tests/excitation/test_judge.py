"""What a recorded acceleration shows of itself, for every reader alike."""

import math

import numpy
import pytest

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.judge import Cures, judge_acceleration, judge_stamps, unknown_samples
from contact_sim_pkg.excitation.recorded import RecordedVibration

G = 9.80665
RATE = 100.0
TIME = numpy.arange(2000) / RATE
CURES = Cures("--unit {}", "--up {}", "state the unit of the times")
SHAKEN = {
    "x": 0.4 * numpy.sin(2.0 * math.pi * 2.0 * TIME),
    "y": 0.2 * numpy.sin(2.0 * math.pi * 3.0 * TIME),
    "z": 1.5 * numpy.sin(2.0 * math.pi * 4.0 * TIME) + G,
}


def judge(axes=SHAKEN, **stated):
    return judge_acceleration(axes, RATE, "ride", CURES, **stated)


def test_an_upright_sensor_is_taken_as_it_is():
    judged = judge()
    assert (judged.factor, judged.up, judged.assumed, judged.faults, judged.unknown) == (1.0, "z", (), (), {})


def test_a_unit_that_gravity_contradicts_is_refused_and_one_that_is_stated_is_taken():
    for unit, factor in (("g", G), ("mg", G / 1000.0)):
        scaled = {axis: values / factor for axis, values in SHAKEN.items()}
        with pytest.raises(ExcitationError, match=rf"ride: .* is gravity in {unit} and not in .*--unit {unit}"):
            judge(scaled)
        assert judge(scaled, unit=unit).factor == pytest.approx(factor, rel=1e-12)
    with pytest.raises(ExcitationError, match=r"in m/s\^2 allowed are 49 and 200"):
        judge({axis: 7.0 * values for axis, values in SHAKEN.items()})


@pytest.mark.parametrize(("axis", "sign"), [("x", 1.0), ("y", 1.0), ("y", -1.0), ("z", -1.0)])
def test_gravity_on_another_axis_says_where_up_is(axis, sign):
    turned = {**SHAKEN, axis: sign * SHAKEN["z"]}
    if axis != "z":
        turned["z"] = SHAKEN["x"]
    judged = judge(turned)
    up = f"{'-' if sign < 0.0 else ''}{axis}"
    assert judged.up == up
    assert judged.assumed == (f"gravity lies on {axis}, so {axis} points {'down' if sign < 0.0 else 'up'}",)
    assert judge(turned, up=up).assumed == ()
    with pytest.raises(ExcitationError, match=rf"gravity lies on {axis} .* and not .*; write --up {up}"):
        judge(turned, up="-x" if axis != "x" else "-z")


def test_a_sensor_between_the_axes_that_turns_or_holds_part_of_gravity_is_doubtful():
    tilt = math.radians(45.0)
    between = {**SHAKEN, "z": SHAKEN["z"] - G + G * math.cos(tilt), "y": SHAKEN["y"] + G * math.sin(tilt)}
    assert judge(between).faults == ("gravity lies between the axes: none of them is vertical",)
    angle = math.radians(20.0) * TIME / TIME[-1]
    turning = {**SHAKEN, "z": SHAKEN["z"] - G + G * numpy.cos(angle), "y": SHAKEN["y"] + G * numpy.sin(angle)}
    assert (
        judge(turning).faults[0].startswith("the sensor turns: gravity by 7.5°")
    )  # half a part before the ends of 10° each
    partly = {**SHAKEN, "z": SHAKEN["z"] - 4.0}
    assert judge(partly).faults == ("the mean of 5.81 m/s² is neither gravity nor none",)
    free = {**SHAKEN, "z": SHAKEN["z"] - G}
    assert judge(free).faults == ("unit assumed: m/s²",)
    assert judge(free, unit="m/s^2").faults == ()


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 2e5])
def test_an_axis_with_an_unknown_sample_is_named(value):
    axes = {axis: values.copy() for axis, values in SHAKEN.items()}
    axes["z"][700] = axes["z"][703] = value
    judged = judge(axes)
    assert list(judged.unknown) == ["z"]
    assert "2 of 2000 samples unknown" in judged.unknown["z"]
    assert "at sample 700" in judged.unknown["z"]
    assert unknown_samples(SHAKEN["z"]) == ""


def test_stamps_show_rate_scatter_gaps_and_steps_back():
    assert judge_stamps(TIME, "ride", "cure").rate == pytest.approx(RATE, rel=1e-12)
    assert judge_stamps(TIME, "ride", "cure").faults == ()
    shifted = TIME + 0.2 / RATE * numpy.where(numpy.arange(TIME.size) % 2, 1.0, -1.0)
    assert judge_stamps(shifted, "ride", "cure").faults == ("wrong rate: stamps scatter by 40 % of the step",)
    gap = numpy.where(TIME >= 7.0, TIME + 3.0, TIME)
    assert "1 gaps in the stamps, the first before sample 700" in judge_stamps(gap, "ride", "cure").faults[0]
    back = numpy.where(TIME >= 7.0, TIME - 3.0, TIME)
    assert "1 stamps go back, the first at sample 700" in judge_stamps(back, "ride", "cure").faults[0]
    with pytest.raises(ExcitationError, match="do not ascend"):
        judge_stamps(numpy.zeros(100), "ride", "cure")


@pytest.mark.parametrize("factor", [1e3, 1e6, 1e9, 1e-6])
def test_times_in_another_unit_are_refused(factor):
    with pytest.raises(ExcitationError, match=r"is no rate of a vibration .*state the unit of the times"):
        judge_stamps(factor * TIME, "ride", CURES.time)


def write(path, columns, header):
    rows = zip(*columns, strict=True)
    path.write_text(
        "\n".join([header, *(",".join(repr(float(each)) for each in row) for row in rows)]), encoding="utf-8"
    )
    return path


@pytest.mark.fault("A16")
def test_a_file_is_judged_like_a_bag(tmp_path):
    x, y, z = SHAKEN.values()
    with pytest.raises(
        ExcitationError, match=r"gravity lies on y \(mean 9.80\d* m/s\^2\), not on z; .*vertical_column: y"
    ):
        RecordedVibration(write(tmp_path / "turned.csv", (x, z, y), "x,y,z"), RATE)
    with pytest.raises(ExcitationError, match=r"no rate of a vibration.*write vibration.time_unit: ms"):
        RecordedVibration(write(tmp_path / "ms.csv", (1e3 * TIME, x, y, z), "time,x,y,z"))
    inside = slice(50, -50)
    for unit, factor in (("ms", 1e3), ("us", 1e6), ("ns", 1e9)):
        path = write(tmp_path / f"{unit}.csv", (factor * TIME, x, y, z), "time,x,y,z")
        read = RecordedVibration(path, time_unit=unit)
        assert read.rate == pytest.approx(RATE, rel=1e-9)
        assert read.acceleration(TIME[inside])[1] == pytest.approx(z[inside] - z.mean(), abs=1e-9)


def test_samples_at_stamps_that_scatter_are_taken_at_their_stamps(tmp_path):
    scattered = TIME + numpy.random.default_rng(5).uniform(-0.2, 0.2, TIME.size) / RATE
    scattered[[0, -1]] = TIME[[0, -1]]
    z = 1.5 * numpy.sin(2.0 * math.pi * 4.0 * scattered) + 0.8 * numpy.sin(2.0 * math.pi * 11.0 * scattered + 0.3) + G
    read = RecordedVibration(write(tmp_path / "a.csv", (scattered, numpy.zeros(TIME.size), z), "time,x,z"))
    assert any("resampled by them" in note for note in read.describe()["notes"])
    cut = RecordedVibration(
        write(tmp_path / "cut.csv", (scattered, numpy.zeros(TIME.size), numpy.minimum(z, 11.5)), "time,x,z")
    )
    assert cut.clipping["z"].samples == numpy.count_nonzero(z >= 11.5)  # looked for before
    inside = slice(100, -100)
    true = 1.5 * numpy.sin(2.0 * math.pi * 4.0 * TIME) + 0.8 * numpy.sin(2.0 * math.pi * 11.0 * TIME + 0.3)
    found = read.acceleration(TIME[inside])[1]
    rms = math.sqrt(0.5 * (1.5**2 + 0.8**2))
    assert numpy.abs(found + z.mean() - G - true[inside]).max() < 2e-4 * rms


@pytest.mark.fault("A16")
def test_a_tilt_is_corrected_by_a_lateral_column_of_any_name(tmp_path):
    roll = math.radians(10.0)
    y = math.sin(roll) * SHAKEN["z"]
    z = math.cos(roll) * SHAKEN["z"]
    path = write(tmp_path / "tilted.csv", (SHAKEN["x"], y, z), "a_x,a_y,a_z")
    read = RecordedVibration(path, RATE, vertical="a_z", forward="a_x", lateral="a_y", tilt="correct")
    inside = slice(100, -100)
    assert read.acceleration(TIME[inside])[1] == pytest.approx(SHAKEN["z"][inside] - SHAKEN["z"].mean(), abs=1e-3)


def test_an_error_code_is_no_sample():
    """-9999 among numbers below 20; as large as its neighbours it is a number."""
    values = SHAKEN["z"].copy()
    values[777 % values.size] = -9999.0
    assert unknown_samples(values) == f"1 of {values.size} samples unknown: -9999 at sample {777 % values.size}"
    assert unknown_samples(numpy.array([9000.0, 9999.0, 8000.0])) == ""


def test_failed_reads_and_a_frozen_sensor_are_named():
    shaken = {axis: values.copy() for axis, values in SHAKEN.items()}
    assert not judge_acceleration(shaken, RATE, "a", CURES).faults
    for values in shaken.values():
        values[50::50] = 0.0
    count = len(range(50, shaken["z"].size, 50))
    assert (
        f"failed reads: {count} samples are 0 in all axes, the first 50"
        in judge_acceleration(shaken, RATE, "a", CURES).faults
    )
    frozen = {axis: values.copy() for axis, values in SHAKEN.items()}
    begin = frozen["z"].size - round(1.5 * RATE)
    for values in frozen.values():
        values[begin:] = values[begin]
    faults = judge_acceleration(frozen, RATE, "a", CURES).faults
    assert f"frozen: {frozen['z'].size - begin} samples from {begin} on are equal in all axes" in faults


@pytest.mark.parametrize("gravity", [0.85, 1.0, 1.2])
def test_gravity_in_g_of_a_badly_calibrated_sensor_is_asked_about(gravity):
    shaken = {axis: gravity * values / G for axis, values in SHAKEN.items()}
    with pytest.raises(ExcitationError, match="gravity in g and not in"):
        judge_acceleration(shaken, RATE, "a", CURES)


def test_milliseconds_of_a_fast_logger_are_asked_about():
    with pytest.raises(ExcitationError, match="are the times milliseconds"):
        judge_stamps(numpy.arange(1000.0) / 2.0, "a", "")
