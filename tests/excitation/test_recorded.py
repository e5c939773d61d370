"""Recorded vibration: synthetic recordings with known bias, tilt, clipping and rate, and the measured bus floor."""

import json
import math
from pathlib import Path

import numpy
import pytest

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.recorded import RecordedVibration

BUS = Path(__file__).resolve().parents[3] / "shared" / "data" / "bus_l83_floor_acceleration.csv"
RATE = 200.0
TIME = numpy.arange(2000) / RATE
X = numpy.sin(2.0 * numpy.pi * 3.0 * TIME + 0.1)
Z = 2.0 * numpy.sin(2.0 * numpy.pi * 7.3 * TIME + 0.7)


def write(path, columns, separator=",", names=None, digits=9):
    names = list(columns) if names is None else names
    lines = [separator.join(names)]
    lines += [separator.join(f"{value:.{digits}f}" for value in row) for row in zip(*columns.values(), strict=True)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


@pytest.fixture
def plain(tmp_path):
    return write(tmp_path / "plain.csv", {"x": X + 0.2, "y": 0.0 * X, "z": Z + 9.81})


@pytest.mark.parametrize("separator", [",", ";", "\t", " "])
def test_every_separator_is_found_from_the_header(tmp_path, separator):
    path = write(tmp_path / "a.csv", {"x": X, "y": 0.0 * X, "z": Z + 9.81}, separator)
    x, z = RecordedVibration(path, RATE).acceleration(TIME[10:50])
    numpy.testing.assert_allclose(x, (X - X.mean())[10:50], atol=2e-9)
    numpy.testing.assert_allclose(z, (Z - Z.mean())[10:50], atol=2e-9)


@pytest.mark.parametrize("separator", [";", "\t", " "])
def test_decimal_commas_are_read_where_commas_separate_nothing(tmp_path, separator):
    """As a German Excel writes them."""
    path = write(tmp_path / "a.csv", {"x": X, "y": 0.0 * X, "z": Z + 9.81}, separator)
    path.write_text(path.read_text().replace(".", ","))
    x, z = RecordedVibration(path, RATE).acceleration(TIME[10:50])
    numpy.testing.assert_allclose(x, (X - X.mean())[10:50], atol=2e-9)
    numpy.testing.assert_allclose(z, (Z - Z.mean())[10:50], atol=2e-9)


@pytest.mark.parametrize("end", ["", "\n"])  # a last line without its end is read apart
@pytest.mark.parametrize("bad", ["1.234,5", "1,2,3", "1.5"])
def test_a_comma_that_may_be_meant_in_two_ways_is_refused_with_its_line(tmp_path, bad, end):
    path = tmp_path / "a.csv"
    path.write_text(f"x;z\n0,1;9,8\n0,2;{bad}{end}")
    with pytest.raises(ExcitationError, match=r"line [23]: '.*' in column '.' is no number"):
        RecordedVibration(path, RATE)


def test_a_column_of_another_name_is_refused_with_the_key_that_names_it(tmp_path):
    path = write(tmp_path / "a.csv", {"t": TIME, "Az": Z + 9.81})
    names = "the header names t, az; name the right one by vibration"
    with pytest.raises(ExcitationError, match=f"no column 'z'; {names}.vertical_column=NAME"):
        RecordedVibration(path, unused="x")
    with pytest.raises(ExcitationError, match=f"no column 'x'; {names}.forward_column=NAME"):
        RecordedVibration(path, vertical="az")
    with pytest.raises(ExcitationError, match=f"no column 'zeit'; {names}.time_column=NAME"):
        RecordedVibration(path, vertical="az", time="Zeit", unused="x")


def test_samples_are_given_back_at_their_instants(plain):
    x, z = RecordedVibration(plain, RATE).acceleration(TIME)
    numpy.testing.assert_allclose(x, X - X.mean(), atol=2e-9)
    numpy.testing.assert_allclose(z, Z - Z.mean(), atol=2e-9)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.85])
def test_between_samples_the_signal_is_band_limited(tmp_path, share):
    frequency = share * 0.5 * RATE
    wave = numpy.sin(2.0 * numpy.pi * frequency * TIME + 0.4)
    path = write(tmp_path / "a.csv", {"x": 0.0 * X, "z": wave + 9.81}, digits=12)
    time = numpy.random.default_rng(0).uniform(1.0, 9.0, 500)
    z = RecordedVibration(path, RATE).acceleration(time)[1]
    exact = numpy.sin(2.0 * numpy.pi * frequency * time + 0.4) - wave.mean()
    assert numpy.abs(z - exact).max() < 1e-4


def test_sampling_more_slowly_removes_what_would_fold_back(tmp_path):
    wave = numpy.sin(2.0 * numpy.pi * 5.0 * TIME) + numpy.sin(2.0 * numpy.pi * 60.0 * TIME)
    path = write(tmp_path / "a.csv", {"x": 0.0 * X, "z": wave + 9.81})
    recording = RecordedVibration(path, RATE, sample_rate=50.0)
    time = numpy.arange(50, 400) / 50.0
    z = recording.acceleration(time)[1]
    numpy.testing.assert_allclose(z, numpy.sin(2.0 * numpy.pi * 5.0 * time), atol=2e-3)
    assert any("before sampling at 50 Hz" in note for note in recording.describe()["notes"])


def test_bias_and_tilt_are_found(tmp_path):
    angle = math.radians(5.0)
    path = write(tmp_path / "a.csv", {"x": X + 9.81 * math.sin(angle), "y": 0.0 * X, "z": Z + 9.81 * math.cos(angle)})
    described = RecordedVibration(path, RATE).describe()
    assert described["tilt_degrees"] == pytest.approx(5.0, abs=0.05)
    assert described["axes"]["x"]["bias_m_per_s2"] == pytest.approx(9.81 * math.sin(angle) + X.mean(), abs=1e-9)
    assert described["axes"]["z"]["rms_m_per_s2"] == pytest.approx(numpy.std(Z), rel=1e-6)


def test_a_corrected_tilt_gives_back_the_upright_axes(tmp_path):
    roll, pitch = 0.1, -0.2
    about_x = numpy.array([[1, 0, 0], [0, math.cos(roll), -math.sin(roll)], [0, math.sin(roll), math.cos(roll)]])
    about_y = numpy.array([[math.cos(pitch), 0, math.sin(pitch)], [0, 1, 0], [-math.sin(pitch), 0, math.cos(pitch)]])
    upright = numpy.array([0.0 * X, 0.0 * X, (Z - Z.mean()) + 9.81])
    tilted = about_x @ about_y @ upright
    path = write(tmp_path / "a.csv", dict(zip("xyz", tilted, strict=True)), digits=12)
    x, z = RecordedVibration(path, RATE, tilt="correct").acceleration(TIME)
    numpy.testing.assert_allclose(z, upright[2] - 9.81, atol=1e-9)
    numpy.testing.assert_allclose(x, 0.0, atol=1e-9)


def test_clipped_samples_are_counted_placed_and_kept(tmp_path):
    wave = numpy.clip(30.0 * numpy.sin(2.0 * numpy.pi * 1.0 * TIME + 0.05) + 9.81, -19.61, 19.61)
    path = write(tmp_path / "a.csv", {"x": X, "y": 0.0 * X, "z": wave})
    recording = RecordedVibration(path, RATE)
    at_limit = numpy.flatnonzero(numpy.abs(wave) == 19.61)
    clipping = recording.clipping["z"]
    assert clipping.samples == len(at_limit)
    assert clipping.first_line == at_limit[0] + 2
    assert clipping.longest_run == max(
        len(run) for run in numpy.split(at_limit, numpy.flatnonzero(numpy.diff(at_limit) > 1) + 1)
    )
    note = next(note for note in recording.describe()["notes"] if "full scale" in note)
    assert note.startswith(f"{len(at_limit)} of 2000 samples of z lie at the full scale of 19.61 m/s^2 (clipped;")
    numpy.testing.assert_allclose(recording.acceleration(TIME)[1], wave - wave.mean(), atol=2e-9)
    with pytest.raises(ExcitationError, match="samples of z lie at the full scale"):
        RecordedVibration(path, RATE, clipped="refuse")


def test_a_pure_tone_that_meets_its_peak_again_and_again_is_not_clipped(tmp_path):
    tone = numpy.round(5.0 * numpy.sin(2.0 * numpy.pi * 2.5 * TIME), 9)  # 80 samples a period, one at the peak
    assert numpy.count_nonzero(tone == 5.0) > 10
    path = write(tmp_path / "a.csv", {"x": tone, "z": Z + 9.81})
    assert RecordedVibration(path, RATE).clipping["x"].samples == 0
    assert RecordedVibration(path, RATE, full_scale=5.0).clipping["x"].samples == 2 * numpy.count_nonzero(tone == 5.0)


@pytest.mark.parametrize(("scale", "samples"), [(2.0 * 9.80665, 2), (17.3, 0)])
def test_two_lone_samples_at_a_usual_full_scale_are_clipped(tmp_path, scale, samples):
    wave = Z + 9.81
    wave[[300, 900]] = round(scale, 3)
    path = write(tmp_path / "a.csv", {"x": X, "z": wave}, digits=3)
    assert RecordedVibration(path, RATE).clipping["z"].samples == samples


@pytest.mark.parametrize("value", [9.81, 19.61, 3.0, -9.81])
def test_a_constant_signal_is_not_clipped_unless_it_lies_at_a_stated_full_scale(tmp_path, value):
    path = write(tmp_path / "a.csv", {"x": 0.0 * X + value, "z": Z + 9.81})
    recording = RecordedVibration(path, RATE)
    assert recording.clipping["x"].samples == 0
    assert not any("full scale" in note for note in recording.describe()["notes"])
    assert RecordedVibration(path, RATE, full_scale=abs(value)).clipping["x"].samples == len(X)


def test_a_stated_full_scale_counts_what_lies_at_it(plain):
    raw = numpy.round(Z + 9.81, 9)
    found = RecordedVibration(plain, RATE, full_scale=11.0).clipping["z"].samples
    assert found == numpy.count_nonzero(raw >= 11.0) > 0
    assert RecordedVibration(plain, RATE).clipping["z"].samples == 0


def timed(tmp_path, rate=RATE, **changes):
    return write(tmp_path / "timed.csv", {"Time": TIME * RATE / rate, "x": X, "y": 0.0 * X, "z": Z + 9.81, **changes})


def test_the_rate_is_derived_from_the_time_column_or_compared_with_it(tmp_path):
    path = timed(tmp_path)
    assert RecordedVibration(path).rate == pytest.approx(RATE, rel=1e-9)
    assert RecordedVibration(path, 201.0).rate == 201.0
    for stated in (400.0, 203.0):
        with pytest.raises(ExcitationError, match=rf"stated rate is {stated:g} Hz, the time column says 200 Hz"):
            RecordedVibration(path, stated)


def test_without_time_column_the_rate_must_be_stated(plain):
    with pytest.raises(ExcitationError, match=r"must be stated \(vibration\.rate, or --rate\); it is never guessed"):
        RecordedVibration(plain)


def test_a_gap_in_time_is_refused_with_its_line(tmp_path):
    time = TIME.copy()
    time[500:] += 3.0 / RATE
    with pytest.raises(ExcitationError, match=r"line 502: time goes on by 0\.02 s"):
        RecordedVibration(timed(tmp_path, Time=time))


def test_names_units_and_signs_of_columns(tmp_path):
    names = ["up [m/s^2]", '"Forward (m/s2)"']
    path = write(tmp_path / "a.csv", {"up": -Z - 9.81, "forward": X}, names=names)
    recording = RecordedVibration(path, RATE, vertical="-up", forward="FORWARD")
    x, z = recording.acceleration(TIME)
    numpy.testing.assert_allclose(z, Z - Z.mean(), atol=2e-9)
    numpy.testing.assert_allclose(x, X - X.mean(), atol=2e-9)
    with pytest.raises(ExcitationError, match="this axis points down; name it with a minus sign"):
        RecordedVibration(path, RATE, vertical="up", forward="forward")


def test_without_forward_column_there_is_no_forward_acceleration(plain):
    x, z = RecordedVibration(plain, RATE, forward=None).acceleration(TIME)
    assert not x.any()
    assert z.any()


@pytest.mark.parametrize(("axis", "wave", "other"), [("x", X, "z"), ("z", Z, "x")])
def test_the_column_of_an_axis_that_is_not_used_may_be_absent(tmp_path, axis, wave, other):
    path = write(tmp_path / "one.csv", {"time": TIME, axis: wave})
    found = dict(zip("xz", RecordedVibration(path, unused=other).acceleration(TIME), strict=True))
    numpy.testing.assert_allclose(found[axis], wave - wave.mean(), atol=2e-9)
    assert not found[other].any()
    with pytest.raises(ExcitationError, match=f"there is no column '{other}'"):
        RecordedVibration(path)
    with pytest.raises(ExcitationError, match=f"there is no column '{axis}'"):
        RecordedVibration(write(tmp_path / "none.csv", {"time": TIME, "w": wave}), unused=other)


def test_without_a_vertical_column_the_tilt_is_unknown_and_not_corrected(tmp_path):
    path = write(tmp_path / "forward.csv", {"x": X, "y": 0.0 * X})
    assert any(
        "No column is vertical" in note for note in RecordedVibration(path, RATE, unused="z").describe()["notes"]
    )
    with pytest.raises(ExcitationError, match="there is no column 'z'"):
        RecordedVibration(path, RATE, tilt="correct", unused="z")


def test_a_kept_bias_stays(plain):
    z = RecordedVibration(plain, RATE, remove_bias=False).acceleration(TIME)[1]
    numpy.testing.assert_allclose(z, Z + 9.81, atol=2e-9)


def test_the_high_pass_takes_the_drift_and_leaves_the_rest(tmp_path):
    drift = 0.5 * numpy.sin(2.0 * numpy.pi * 0.1 * TIME)
    path = write(tmp_path / "a.csv", {"x": X, "y": 0.0 * X, "z": Z + drift + 9.81})
    z = RecordedVibration(path, RATE, high_pass=0.5).acceleration(TIME)[1]
    middle = slice(400, 1600)
    assert numpy.abs(z - Z)[middle].max() < 0.02


@pytest.mark.parametrize("part", [0.5, 1.0, 2.0])
def test_the_high_pass_is_a_butterworth_filter_of_order_four_run_both_ways(tmp_path, part):
    """Gain 1/(1 + (f_c/f)^8) of a steady sine of f = part f_c."""
    corner = 2.0
    sine = numpy.sin(2.0 * numpy.pi * part * corner * TIME)
    path = write(tmp_path / "a.csv", {"x": X, "y": 0.0 * X, "z": sine + 9.81})
    z = RecordedVibration(path, RATE, high_pass=corner).acceleration(TIME)[1]
    middle = slice(600, 1400)
    gain = numpy.dot(z[middle], sine[middle]) / numpy.dot(sine[middle], sine[middle])
    assert gain == pytest.approx(1.0 / (1.0 + part**-8), abs=1e-4)


def test_start_shifts_the_recording(plain):
    later = RecordedVibration(plain, RATE, start=1.5)
    whole = RecordedVibration(plain, RATE)
    time = numpy.linspace(0.0, 8.0, 99)
    numpy.testing.assert_allclose(later.acceleration(time)[1], whole.acceleration(time + 1.5)[1], atol=1e-11)


def test_after_the_end_the_choice_decides(plain):
    time = numpy.array([3.0, 12.0])
    with pytest.raises(ExcitationError, match=r"recording ends after 9\.995 s, t = 12 s was requested"):
        RecordedVibration(plain, RATE).acceleration(time)
    assert RecordedVibration(plain, RATE, beyond="zero").acceleration(time)[1][1] == 0.0
    repeated = RecordedVibration(plain, RATE, beyond="repeat")
    numpy.testing.assert_allclose(repeated.acceleration(time)[1], repeated.acceleration(time + 10.0)[1], atol=1e-12)
    assert repeated.acceleration(time)[1][1] == pytest.approx((Z - Z.mean())[400], abs=1e-8)


LINES = ["x y z", "0 0 9.8", "1 0 9.9", "2 0 9.7"]


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ([*LINES, "1 2"], "line 5: 2 fields, expected 3"),
        ([*LINES, "", "# comment", "1 2 3 4"], "line 7: 4 fields, expected 3"),
        ([*LINES, "1 2 nan"], "line 5: column 'z' is nan"),
        ([*LINES, "1 2 inf"], "line 5: column 'z' is inf"),
        ([*LINES, "1 2 9,8"], "line 5: '9,8' in column 'z' is no number"),
        ([*LINES, "1 2 9_8"], "line 5: '9_8' in column 'z' is no number"),
        (["1 2 3", *LINES], "line 1: '1' is no column name"),
        (["x x z", *LINES[1:]], "column 'x' is named twice"),
        (["a b c", *LINES[1:]], "no column 'x'; the header names a, b, c"),
        (["x;y;z [mV]", "0;0;1", "0;0;1", "0;0;1"], r"unit 'mV' of column 'z' is not read"),
        ([*LINES, "1 2 1e300"], "line 5: column 'z' is 1e\\+300 m/s\\^2; allowed: within \\+-100000"),
        ([*LINES, "1 -1e6 9"], "line 5: column 'y' is -1e\\+06"),
        (["x y z"], "0 samples"),
        ([], "0 samples"),
    ],
)
def test_bad_files_are_refused_with_the_line(tmp_path, lines, message):
    path = tmp_path / "bad.csv"
    path.write_text("\n".join(lines), encoding="utf-8")
    with pytest.raises(ExcitationError, match=message) as caught:
        RecordedVibration(path, RATE)
    assert str(path) in str(caught.value)


def test_binary_missing_and_directory_are_refused(tmp_path):
    (tmp_path / "b.csv").write_bytes(b"x y z\n\xff\xfe\x00")
    for path, message in (
        (tmp_path / "b.csv", "byte 6: this is no text"),
        (tmp_path / "no.csv", "cannot be read"),
        (tmp_path, "cannot"),
    ):
        with pytest.raises(ExcitationError, match=message):
            RecordedVibration(path, RATE)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"tilt": "yes"}, "tilt is 'yes'; allowed: keep, correct"),
        ({"beyond": "loop"}, "beyond is 'loop'"),
        ({"rate": -5.0}, "rate is -5"),
        ({"high_pass": 100.0}, "high_pass is 100"),
        ({"start": 10.0}, "start is 10"),
        ({"tilt": "correct", "lateral": "side"}, "no column 'side'"),
        ({"tilt": "correct", "forward": None}, "without a forward column"),
    ],
)
def test_bad_choices_are_refused(plain, options, message):
    with pytest.raises(ExcitationError, match=message):
        RecordedVibration(plain, **{"rate": RATE, **options})


def test_a_recording_without_gravity_has_no_known_tilt(tmp_path):
    path = write(tmp_path / "a.csv", {"x": X, "y": 0.0 * X, "z": Z})
    assert RecordedVibration(path, RATE).describe()["tilt_degrees"] is None
    with pytest.raises(ExcitationError, match="tilt cannot be corrected"):
        RecordedVibration(path, RATE, tilt="correct")


@pytest.mark.skipif(not BUS.exists(), reason="the measured floor vibration is not at ../shared/data")
def test_the_measured_bus_floor_is_read_and_its_flaws_are_named():
    rows = [[float(field) for field in line.split()] for line in BUS.read_text().splitlines()[1:]]
    mean = [sum(column) / len(rows) for column in zip(*rows, strict=True)]
    recording = RecordedVibration(BUS, 476.0)
    described = json.loads(json.dumps(recording.describe()))
    assert described["samples"] == len(rows) == 44182
    assert described["duration_s"] == pytest.approx(44182 / 476)
    assert described["axes"]["z"]["bias_m_per_s2"] == pytest.approx(mean[2])
    expected = math.degrees(math.atan2(math.hypot(mean[0], mean[1]), mean[2]))
    assert described["tilt_degrees"] == pytest.approx(expected)
    at_limit = [row[2] for row in rows].count(max(row[2] for row in rows))
    assert described["axes"]["z"]["clipped_samples"] == at_limit == 2
    assert any("2 of 44182 samples of z lie at the full scale of 19.6" in note for note in described["notes"])
    z = recording.acceleration(numpy.arange(100, 110) / 476.0)[1]
    numpy.testing.assert_allclose(z, [row[2] - mean[2] for row in rows[100:110]], atol=1e-9)
