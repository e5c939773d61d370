"""Metrics of bags: ours, those of anybody, and repeated runs."""

import math

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.records.metric import Band, Metric
from contact_sim_pkg.report.metrics.foreign import ForeignOptions
from contact_sim_pkg.report.metrics.of_bag import metrics_of_bags
from contact_sim_pkg.report.metrics.repeated import repeated
from contact_sim_pkg.report.signal.metrics import ride_metrics
from contact_sim_pkg.report.signal.weighting import WD

STORE = get_typestore(Stores.ROS2_JAZZY)
T = STORE.types
RATE = 500.0


def foreign_bag(folder, kind, values, rate=RATE, times=None, turning=None, frame="sensor"):
    """A bag by rosbags with one topic of `kind`; values [samples, 3]."""
    name = {
        "imu": "sensor_msgs/msg/Imu",
        "accel": "geometry_msgs/msg/AccelStamped",
        "wrench": "geometry_msgs/msg/WrenchStamped",
    }[kind]
    times = np.arange(len(values)) / rate if times is None else times
    vector, header = T["geometry_msgs/msg/Vector3"], T["std_msgs/msg/Header"]
    zero = vector(0.0, 0.0, 0.0)
    with Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection(f"/sensor/{kind}", name, typestore=STORE)
        for time, row, turn in zip(
            times, values, np.zeros((len(values), 3)) if turning is None else turning, strict=True
        ):
            stamp = round(time * 1e9)
            top = header(T["builtin_interfaces/msg/Time"](stamp // 10**9, stamp % 10**9), frame)
            linear = vector(*map(float, row))
            if kind == "imu":
                attitude, none = T["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0), np.zeros(9)
                message = T[name](top, attitude, none, vector(*map(float, turn)), none, linear, none)
            elif kind == "accel":
                message = T[name](top, T["geometry_msgs/msg/Accel"](linear, zero))
            else:
                message = T[name](top, T["geometry_msgs/msg/Wrench"](linear, zero))
            writer.write(connection, stamp, STORE.serialize_cdr(message, name))
    return folder


@pytest.fixture(scope="module")
def shaken():
    """40 s of noise on three axes, gravity on z."""
    noise = np.random.default_rng(5).normal(size=(round(40 * RATE), 3)) * [0.3, 0.2, 0.8]
    return noise + np.array([0.0, 0.0, 9.81])


def by_key(paths, **chosen):
    return {each.key: each for each in metrics_of_bags(paths, **chosen).metrics}


@pytest.mark.parametrize("kind", ["imu", "accel"])
def test_a_foreign_bag_has_the_same_a_w_as_the_signal(tmp_path, shaken, kind):
    found = by_key([foreign_bag(tmp_path / "bag", kind, shaken)])
    expected = ride_metrics(shaken[:, 2], RATE)
    a_w = found[f"sensor_{kind}.z.a_w"]
    assert a_w.value == pytest.approx(expected.weighted_rms, rel=1e-9)
    assert a_w.broken == ()
    assert found[f"sensor_{kind}.x.a_w"].broken == ()
    assert found[f"sensor_{kind}.a_8"].value == pytest.approx(expected.weighted_rms, rel=1e-9)


def test_an_axis_and_a_weighting_are_chosen(tmp_path, shaken):
    bag = foreign_bag(tmp_path / "bag", "imu", shaken)
    assert set(by_key([bag], chosen=ForeignOptions("x:Wc"))) >= {"sensor_imu.a_w", "sensor_imu.crest"}
    assert by_key([bag], chosen=ForeignOptions("x:Wc"))["sensor_imu.a_w"].name == "a_w, Wc"
    assert by_key([bag], chosen=ForeignOptions("Wj"))["sensor_imu.a_w"].name == "a_w, Wj"
    assert (
        by_key([bag], chosen=ForeignOptions("Wf"))["sensor_imu.a_w"].band is None
    )  # no words of comfort for motion sickness
    with pytest.raises(
        BagError, match=r"--axis Wq: is neither axis nor weighting; allowed are x, y, z, rx, ry, rz, Wk"
    ):
        metrics_of_bags([bag], chosen=ForeignOptions("Wq"))


def test_a_rotation_is_weighted_by_we_and_has_no_band(tmp_path):
    """rad/s of a sine of 1 Hz and 1 rad/s² rms: a_w is |We(1 Hz)| = 0.8798."""
    time = np.arange(0.0, 60.0, 1.0 / RATE)
    velocity = np.sqrt(2.0) / (2.0 * np.pi) * np.sin(2.0 * np.pi * time)
    bag = foreign_bag(tmp_path / "bag", "imu", np.zeros((time.size, 3)), turning=np.stack([velocity] * 3, axis=1))
    found = by_key([bag], chosen=ForeignOptions("ry"))["sensor_imu.a_w"]
    assert found.value == pytest.approx(0.8798, rel=5e-3)  # with the start of the sine
    assert (found.unit, found.band, found.name) == ("rad/s²", None, "a_w, We")


def test_the_daily_dose_of_a_horizontal_axis_is_taken_1_4_times(tmp_path, shaken):
    bag = foreign_bag(tmp_path / "bag", "accel", shaken)
    along = ride_metrics(shaken[:, 0], RATE, WD)
    expected = 1.4 * along.vibration_dose * (8.0 * 3600.0 / 40.0) ** 0.25
    assert by_key([bag])["sensor_accel.x.dose"].value == pytest.approx(expected, rel=1e-9)


@pytest.fixture(scope="module")
def sines(tmp_path_factory):
    """20 s of a sine an axis at 250 Hz; rms [m/s^2] and gain by the tables of ISO 8041-1: Wd 0.2550 and 0.5143, Wk 0.9884."""
    time = np.arange(20 * 250) / 250.0
    waves = [
        np.sqrt(2.0) * rms * np.sin(2.0 * np.pi * f * time) for rms, f in ((4.0, 7.943), (0.5, 3.981), (1.2, 10.0))
    ]
    return foreign_bag(tmp_path_factory.mktemp("sines") / "bag", "imu", np.stack(waves, axis=1), rate=250.0)


A_W = {"x": 4.0 * 0.2550, "y": 0.5 * 0.5143, "z": 1.2 * 0.9884}


def test_the_highest_axis_decides_on_the_day_with_1_4_of_x_and_y(sines):
    """1.4 x is above z, x alone is below; comfort adds all three as they are."""
    found = by_key([sines])
    for axis, a_w in A_W.items():
        assert found[f"sensor_imu.{axis}.a_w"].value == pytest.approx(a_w, rel=5e-3)
    assert found["sensor_imu.a_8"].value == pytest.approx(1.4 * A_W["x"], rel=5e-3)
    assert found["sensor_imu.a_8"].remark.split("; ")[-2] == "x decides"
    assert found["sensor_imu.a_v"].value == pytest.approx(np.linalg.norm([*A_W.values()]), rel=5e-3)


@pytest.mark.parametrize(
    ("chosen", "factor", "a_w"), [("x", 1.4, A_W["x"]), ("x:Wk", 1.0, 4.0 * 1.037), ("z:Wd", 1.0, 1.2 * 0.2017)]
)
def test_1_4_belongs_to_a_horizontal_axis_under_the_horizontal_weighting(sines, chosen, factor, a_w):
    found = by_key([sines], chosen=ForeignOptions(chosen))
    assert found["sensor_imu.a_w"].value == pytest.approx(a_w, rel=5e-3)
    dose = 1.10668 * a_w * (8.0 * 3600.0) ** 0.25
    assert found["sensor_imu.dose"].value == pytest.approx(factor * dose, rel=5e-3)


def test_the_rate_is_that_of_the_steps_between_samples(tmp_path, shaken):
    few = shaken[:20]
    notes = metrics_of_bags([foreign_bag(tmp_path / "bag", "imu", few, rate=250.0)]).notes
    assert any("20 samples at 250 Hz; mean of each axis removed" in note for note in notes)


def test_forces_of_a_pull_have_their_mean_range_and_variation(tmp_path):
    force = np.random.default_rng(7).uniform([500.0, 200.0, -90.0], [570.0, 270.0, -20.0], (40, 3))
    found = by_key([foreign_bag(tmp_path / "bag", "wrench", force, times=7.0 + np.arange(40) / RATE)])
    along = force[:, 2]
    assert found["sensor_wrench.force"].value == pytest.approx(along.mean(), rel=1e-12)
    assert found["sensor_wrench.force"].remark == f"{along.min():.5g} to {along.max():.5g} N"
    assert found["sensor_wrench.force"].window == pytest.approx((7.0, 7.0 + 40 / RATE))
    assert found["sensor_wrench.variation"].value == pytest.approx(along.std() / -along.mean(), rel=1e-12)


def test_forces_of_a_wrench(tmp_path, shaken):
    found = by_key([foreign_bag(tmp_path / "bag", "wrench", shaken)])
    assert found["sensor_wrench.force"].value == pytest.approx(shaken[:, 2].mean())


def test_a_signal_that_breaks_an_assumption_says_so(tmp_path, shaken):
    def broken(name, values, **how):
        found = by_key([foreign_bag(tmp_path / name, "imu", values, **how)], chosen=ForeignOptions("z"))
        return " | ".join(found["sensor_imu.a_w"].broken)

    assert "too short: 3 s, 34 s needed" in broken("short", shaken[: round(3 * RATE)])
    slow = 9.81 + np.clip(5.0 * np.sin(np.arange(len(shaken)) / 40.0), -2.0, 2.0)
    assert "clipped: " in broken("clipped", np.stack([slow * 0.0, slow * 0.0, slow], axis=1))
    assert "wrong rate: 100 Hz carries nothing above 50 Hz" in broken("slow", shaken[:4000], rate=100.0)
    shock = np.zeros((20_000, 3))
    shock[500:510, 2] = 10.0
    assert "crest factor 4" in broken("shock", shock)
    times = np.arange(len(shaken)) / RATE
    times[9000:] += 0.5
    assert "wrong rate: 1 gaps in the stamps" in broken("gap", shaken, times=times)


def test_a_bag_of_nothing_is_refused(tmp_path):
    with Writer(tmp_path / "bag", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection("/text", "std_msgs/msg/String", typestore=STORE)
        writer.write(connection, 0, STORE.serialize_cdr(T["std_msgs/msg/String"]("x"), "std_msgs/msg/String"))
    assert main(["metrics", str(tmp_path / "bag")]) == 2
    with pytest.raises(BagError, match="there is nothing to weight"):
        metrics_of_bags([tmp_path / "bag"])


def test_equal_runs_are_refused(car):
    with pytest.raises(BagError, match=r"are the same run: their spread is 0 and says nothing"):
        metrics_of_bags([car.path.parent, car.path.parent])


def runs(*values):
    band = Band(-math.inf, 100.0, "limit", "")
    return [[Metric("seat.factor", "SEAT", value, "%", "good", band)] for value in values]


def test_three_runs_within_5_per_cent_are_a_test():
    (mean,) = repeated(list("ABC"), [{"seed": each} for each in range(3)], runs(58.0, 60.0, 62.0))
    # Student's t of two degrees of freedom at p is (2 p - 1) / sqrt(2 p (1 - p)); the standard deviation is 2
    student = 0.95 / math.sqrt(2.0 * 0.975 * 0.025)
    assert (mean.value, mean.size, mean.broken) == (60.0, 3, ())
    assert mean.spread == pytest.approx(student * 2.0 / math.sqrt(3.0), rel=1e-12)


def test_runs_that_differ_more_or_are_too_few_are_not_valid():
    (mean,) = repeated(list("ABC"), [{"seed": each} for each in range(3)], runs(54.0, 60.0, 66.0))
    assert mean.broken == ("not valid by ISO 10326-1: A is 10 % from the mean, above 5 %",)
    (mean,) = repeated(list("AB"), [{"seed": each} for each in range(2)], runs(60.0, 60.1))
    assert mean.broken == ("not valid by ISO 10326-1: 2 runs, 3 needed",)


@pytest.mark.fault("G13")
def test_stamps_that_ask_for_gigabytes_of_zeros_are_refused_before(tmp_path, capsys):
    """24 samples 1 us apart: 50 s of padding for Wf are 5e7 samples. 32 bytes a sample are 1.5 GiB at the very least."""
    bag = foreign_bag(tmp_path / "fast", "imu", np.ones((24, 3)) * [0.0, 0.0, 9.81], times=np.arange(24) * 1.001e-6)
    assert main(["metrics", str(bag), "--axis", "Wf"]) == 2
    said = capsys.readouterr().err
    assert "Hz with 50 s of zeros (are the stamps right?) needs" in said
    assert float(said.partition("needs ")[2].split()[0]) > 1.5
    assert "limit 1 GiB (limits.memory)" in said


@pytest.mark.fault("G13")
def test_a_frame_of_megabytes_is_no_name(tmp_path, capsys):
    bag = foreign_bag(tmp_path / "long", "imu", np.ones((16, 3)), frame="x" * (17 << 20))
    assert main(["metrics", str(bag)]) == 2
    assert "holds a text of 17825793 bytes; at most 16777216 are read" in capsys.readouterr().err


def test_a_bag_without_accelerations_is_named_without_gaps(tmp_path, car, capsys):
    assert main(["metrics", str(car.path), "--unit", "g"]) == 2
    assert capsys.readouterr().err == "bench: --unit: for a bag of anybody; a run of the bench has m/s², z upwards\n"
    assert main(["metrics", str(car.path), "--topic", "tire/force"]) == 2
    assert "the topic tire/force of" in capsys.readouterr().err
