"""Tables as people have them: names, units, times, commas, encodings, words around them."""

import math

import numpy
import pytest

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.recorded import RecordedVibration
from contact_sim_pkg.excitation.recorded_csv import read_table
from contact_sim_pkg.excitation.table_words import factor_of, seconds_of_text

G, RATE = 9.80665, 200.0
TIME = numpy.arange(1000) / RATE
X = 0.4 * numpy.sin(2.0 * math.pi * 2.0 * TIME)
Z = 1.5 * numpy.sin(2.0 * math.pi * 4.0 * TIME) + 0.8 * numpy.sin(2.0 * math.pi * 11.0 * TIME + 0.3)
INSIDE = slice(80, -80)
BEGIN = 1_772_360_000  # [s] since 1970: 2026-03-01T10:13:20Z


def rows(*columns, separator=",", form="{:.6f}", end=""):
    return [separator.join(form.format(each) for each in row) + end for row in zip(*columns, strict=True)]


def check(path, text, *, encoding="utf-8", **options):
    """The file gives the signal, whose rms is known."""
    path.write_bytes(text.encode(encoding))
    read = RecordedVibration(path, **options)
    assert read.rate == pytest.approx(RATE, rel=1e-6)
    x, z = read.acceleration(TIME[INSIDE])
    rms = math.sqrt(0.5 * (1.5**2 + 0.8**2))
    assert numpy.abs(z - Z[INSIDE]).max() < 1e-5 * rms
    assert numpy.abs(x - X[INSIDE]).max() < 1e-5 * rms
    return read.describe()["notes"]


def lines(header, *columns, **form):
    return "\n".join([*header, *rows(*columns, **form)]) + "\n"


UP = Z + G
CASES = {
    "a row of units": (lines(["time,x,y,z", "s,g,g,g"], TIME, X / G, X, UP / G, form="{:.9f}"), {}),
    "units in brackets below": (lines(["time,x,z", "[s],[m/s²],[m/s²]"], TIME, X, UP), {}),
    "milliseconds behind the name": (lines(["time [ms],x,z"], 1e3 * TIME, X, UP), {}),
    "milliseconds in the name": (lines(["time_ms,x,z"], 1e3 * TIME, X, UP), {}),
    "milliseconds by a key": (lines(["time,x,z"], 1e3 * TIME, X, UP), {"time_unit": "ms"}),
    "since 1970 in ms": (lines(["timestamp,x,z"], 1e3 * (BEGIN + TIME), X, UP), {"time": "timestamp"}),
    "since 1970 in us": (lines(["t,x,z"], 1e6 * (BEGIN + TIME), X, UP), {}),
    "since 1970 in s": (lines(["t,x,z"], BEGIN + TIME, X, UP), {}),
    "spaces": (lines(["t x z"], TIME, X, UP, separator="  "), {}),
    "separators at the ends": (lines(["time,x,z,"], TIME, X, UP, end=","), {}),
    "separators at the ends of samples": (lines(["time,x,z"], TIME, X, UP, end=",,"), {}),
    "blank lines of separators": (lines(["time,x,z"], TIME, X, UP) + ",,\n,,\n", {}),
    "words before the header": (lines(["Recorder 7", "Operator: x, y", "", "time,x,z"], TIME, X, UP), {"header_line": 4}),
    "names as written": (
        lines(['"Time (s)","Linear Acceleration x (m/s^2)","Linear Acceleration z (m/s^2)"'], TIME, X, UP),
        {"time": "Time (s)", "forward": "Linear Acceleration x (m/s^2)", "vertical": "Linear Acceleration z (m/s^2)"},
    ),
    "bare names": (
        lines(['"Time (s)","Acc X (mm/s/s)","Acc Z (mm/s/s)"'], TIME, 1e3 * X, 1e3 * UP, form="{:.4f}"),
        {"time": "time", "forward": "acc x", "vertical": "Acc Z"},
    ),
    "a column of words": (
        "time,label,x,z\n" + "".join(f"{t:.4f},ride a,{x:.6f},{z:.6f}\n" for t, x, z in zip(TIME, X, UP, strict=True)), {}
    ),
    "decimal commas": (lines(["Zeit [s];x;z"], TIME, X, UP, separator=";").replace(".", ","), {"time": "Zeit"}),
    "decimal commas in quotes": (
        "time,x,z\n" + "".join(
            ",".join(f'"{each:.6f}"'.replace(".", ",") for each in row) + "\n" for row in zip(TIME, X, UP, strict=True)
        ), {},
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_a_table_is_read(tmp_path, case):
    text, options = CASES[case]
    check(tmp_path / "a.csv", text, **options)


@pytest.mark.parametrize("form", ["{d}T{t:.3f}Z", "{d} {t:.3f}", "{d}T{t:.6f}+02:00"])
def test_dates_and_times_become_seconds(tmp_path, form):
    written = [
        form.replace("{t:.3f}", "{t}").replace("{t:.6f}", "{t}").format(d="2026-03-01", t=_clock(t)) for t in TIME
    ]
    body = "".join(f"{w},{x:.6f},{z:.6f}\n" for w, x, z in zip(written, X, UP, strict=True))
    check(tmp_path / "a.csv", f"timestamp,x,z\n{body}", time="timestamp")


def _clock(t):
    """hh:mm:ss.mmm from two seconds before a full minute on."""
    seconds = 58.0 + t
    return f"10:{30 + int(seconds // 60):02}:{seconds % 60:06.3f}"


def test_a_date_and_a_time_of_day_make_one_time(tmp_path):
    late = [86_398.0 + t for t in TIME]  # over midnight
    days = ["2026-03-01" if t < 86_400.0 else "2026-03-02" for t in late]
    clocks = [f"{int(t % 86_400 // 3600):02}:{int(t % 3600 // 60):02}:{t % 60:06.3f}" for t in late]
    body = "".join(f"{d},{c},{x:.6f},{z:.6f}\n" for d, c, x, z in zip(days, clocks, X, UP, strict=True))
    check(tmp_path / "a.csv", f"Date,Time,x,z\n{body}", time="Date+Time")


@pytest.mark.parametrize(("encoding", "said"), [("cp1252", "Windows-1252"), ("utf-16", "UTF-16")])
def test_an_encoding_other_than_utf_8_is_read_and_said(tmp_path, encoding, said):
    text = lines(["Zeit [s];x [m/s²];z [m/s²]"], TIME, X, UP, separator=";").replace(".", ",")
    notes = check(tmp_path / "a.csv", text, encoding=encoding, time="Zeit")
    assert any(said in note for note in notes)


def test_the_spellings_of_a_unit_are_one():
    for spelling in (
        "m/s^2",
        "m/s2",
        "m/s²",
        "m/s/s",
        "ms-2",
        "m s-2",
        "m s^-2",
        "m·s⁻²",
        "m*s^-2",
        "M/S2",
        "m/sec^2",
        "m/s**2",
    ):
        assert factor_of(spelling) == 1.0, spelling
    assert factor_of("mm/s²") == factor_of("mms-2") == 1e-3
    assert factor_of("ft/s²") == 0.3048
    assert (factor_of("ms"), factor_of("µs"), factor_of("msec"), factor_of("G")) == (1e-3, 1e-6, 1e-3, G)
    assert factor_of("furlong") is None


def test_texts_of_times_are_read_to_the_microsecond():
    assert seconds_of_text("1970-01-02T00:00:01.25Z") == 86_401.25
    assert seconds_of_text("1970-01-02T02:00:01.25+02:00") == 86_401.25
    assert seconds_of_text("2.1.1970 00:00:01,25") == 86_401.25
    assert seconds_of_text("1970-01-02") == 86_400.0
    assert seconds_of_text("10:30:25.125") == 37_825.125
    for text in ("", "soon", "10:30", "1.5"):
        with pytest.raises(ValueError):  # noqa: PT011 - the text alone
            seconds_of_text(text)


REFUSED = {
    "words before the header": ("Recorder 7\ntime,x,z\n0,0,9.8\n0.1,0,9.8\n", r"name its line \(vibration.header_line\)"),
    "no header": ("0,0,9.8\n0.1,0,9.8\n", r"is no column name; the first line must name the columns, .*header_line"),
    "unknown unit": ("time,z [furlong]\n0,9.8\n0.1,9.8\n", r"unit 'furlong' of column 'z' is not read; .* write one of these"),
    "words": ("time,x,z\n0,0,abc\n0.1,0,abd\n", r"column 'z' holds texts .*vertical_column=NAME"),
    "a gap": ("time,x,z\n0,0,9.8\n0.1,0,\n0.2,0,9.8\n", r"line 3: column 'z' is nan; .*fill the gap or cut the recording"),
    "two marks": ("time;x;z\n0;0;1.234,5\n1;0;1.234,5\n", r"is no number \(a decimal point is expected"),
    "twice": ("time,z,z\n0,0,1\n1,0,1\n", r"column 'z' is named twice; give each column a name of its own"),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_a_refusal_ends_with_what_to_write(tmp_path, case):
    text, expected = REFUSED[case]
    (tmp_path / "a.csv").write_text(text)
    with pytest.raises(ExcitationError, match=expected):
        RecordedVibration(tmp_path / "a.csv")


def test_an_epoch_is_said(tmp_path):
    (tmp_path / "a.csv").write_text(lines(["timestamp,z"], 1e3 * (BEGIN + TIME), UP))
    time, said = read_table(tmp_path / "a.csv").time(None)
    assert said == "The column timestamp counts ms since 1970."
    assert time == pytest.approx(TIME, abs=1e-9)
