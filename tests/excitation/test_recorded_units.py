"""Recordings: the unit of the values, the rate, bounds, and the memory that reading takes."""

import tracemalloc

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_pkg.excitation import recorded_csv
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.recorded import RecordedVibration

GRAVITY = 9.80665
RATE = 200.0
TIME = numpy.arange(400) / RATE
SHAKEN = 0.8 * numpy.sin(2.0 * numpy.pi * 5.0 * TIME)


def write(path, z, header="x,z", time=None, comment=""):
    values = [numpy.zeros(len(z)), z] if time is None else [time, numpy.zeros(len(z)), z]
    lines = [",".join(repr(float(value)) for value in row) for row in zip(*values, strict=True)]
    path.write_text("\n".join([*([comment] if comment else []), header, *lines]) + "\n", encoding="utf-8")
    return path


@pytest.mark.fault("A8")
@pytest.mark.parametrize(("unit", "factor"), [("g", GRAVITY), ("mg", GRAVITY / 1000.0)])
def test_gravity_in_another_unit_is_refused_until_the_unit_is_stated(tmp_path, unit, factor):
    true = RecordedVibration(write(tmp_path / "si.csv", SHAKEN + GRAVITY), RATE).acceleration(TIME)[1]
    path = write(tmp_path / "a.csv", (SHAKEN + GRAVITY) / factor)
    with pytest.raises(ExcitationError, match=rf"is gravity in {unit} and not in m/s\^2 .*; state the unit"):
        RecordedVibration(path, RATE)
    stated = RecordedVibration(path, RATE, unit=unit)
    numpy.testing.assert_allclose(stated.acceleration(TIME)[1], true, atol=1e-9)
    named = RecordedVibration(write(tmp_path / "b.csv", (SHAKEN + GRAVITY) / factor, f"x [{unit}],z [{unit}]"), RATE)
    numpy.testing.assert_array_equal(named.acceleration(TIME), stated.acceleration(TIME))
    assert RecordedVibration(path, RATE, unit="m/s^2").bias["z"] == pytest.approx(GRAVITY / factor, rel=1e-12)


@pytest.mark.fault("A8")
@pytest.mark.parametrize(
    "values", [1000.0 * SHAKEN, SHAKEN + 100.0, 16384.0 + SHAKEN], ids=["mg without gravity", "mean", "counts"]
)
def test_values_that_no_rig_has_in_si_units_are_refused(tmp_path, values):
    path = write(tmp_path / "a.csv", values)
    with pytest.raises(ExcitationError, match=r"in m/s\^2 allowed are 49 and 200; state the unit"):
        RecordedVibration(path, RATE)
    RecordedVibration(path, RATE, unit="m/s^2")


def test_without_gravity_the_assumed_unit_is_a_warning(tmp_path):
    path = write(tmp_path / "a.csv", SHAKEN)
    (told,) = (note for note in RecordedVibration(path, RATE).describe()["notes"] if note.startswith("WARNING"))
    assert "in m/s^2 is assumed" in told
    for stated in (
        RecordedVibration(path, RATE, unit="m/s^2"),
        RecordedVibration(write(tmp_path / "b.csv", SHAKEN, "x [m/s^2],z [m/s^2]"), RATE),
        RecordedVibration(write(tmp_path / "c.csv", SHAKEN + GRAVITY), RATE),
    ):
        assert not any("WARNING" in note for note in stated.describe()["notes"])


@pytest.mark.fault("A8")
@given(value=st.floats(), where=st.integers(0, 2))
@settings(max_examples=60)
def test_any_number_in_a_file_is_taken_or_refused_by_its_line(tmp_path_factory, value, where):
    path = tmp_path_factory.mktemp("any") / "a.csv"
    rows = [[k / RATE, 0.0, GRAVITY + 0.01 * k] for k in range(8)]
    rows[5][where] = value
    path.write_text("\n".join(["t,x,z", *(",".join(map(repr, row)) for row in rows)]))
    try:
        taken = RecordedVibration(path)
    except ExcitationError as error:
        assert "line 7" in str(error) or "mean" in str(error)  # noqa: PT017
    else:
        assert numpy.isfinite(taken.acceleration(TIME[:4])).all()


@pytest.mark.fault("A14")
@pytest.mark.parametrize("wrong", [0.5, 2.0, 0.98, 1.02])
def test_a_stated_rate_that_the_file_contradicts_stops(tmp_path, wrong):
    timed = write(tmp_path / "a.csv", SHAKEN + GRAVITY, "t,x,z", TIME)
    noted = write(tmp_path / "b.csv", SHAKEN + GRAVITY, comment="# Sampling rate: 0.2 kHz")
    both = write(tmp_path / "c.csv", SHAKEN + GRAVITY, "t,x,z", TIME * wrong, "# fs = 200 Hz")
    for path, source in ((timed, "the time column"), (noted, "a comment in the file")):
        assert RecordedVibration(path, 1.005 * RATE).rate == 1.005 * RATE
        with pytest.raises(
            ExcitationError, match=f"is {wrong * RATE:g} Hz, {source} says 200 Hz; they must agree within 1 %"
        ):
            RecordedVibration(path, wrong * RATE)
    with pytest.raises(ExcitationError, match="a comment states 200 Hz, the time column says"):
        RecordedVibration(both)
    with pytest.raises(ExcitationError, match="never guessed"):
        RecordedVibration(noted)


@pytest.mark.fault("A14")
def test_a_sine_clipped_at_2_g_is_counted_exactly(tmp_path):
    """A sine of 3 g cut at +-2 g: the samples beyond, counted by hand; clipped below as above."""
    whole = 3.0 * GRAVITY * numpy.sin(2.0 * numpy.pi * 5.0 * TIME + 0.1)
    limit = 2.0 * GRAVITY
    recording = RecordedVibration(write(tmp_path / "a.csv", numpy.clip(whole, -limit, limit)), RATE)
    clipping = recording.clipping["z"]
    assert clipping.samples == int((numpy.abs(whole) >= limit).sum())
    assert clipping.value == pytest.approx(limit)
    assert clipping.first_line == 2 + int(numpy.argmax(numpy.abs(whole) >= limit))
    assert f"{clipping.samples} of 400 samples of z lie at the full scale" in " ".join(recording.describe()["notes"])


@pytest.mark.fault("A11")
@pytest.mark.parametrize("columns", [1, 3, 12])
def test_the_memory_that_a_recording_takes_stays_below_the_estimate(tmp_path, monkeypatch, columns):
    monkeypatch.setattr(recorded_csv, "BLOCK", 1 << 14)
    path = tmp_path / "a.csv"
    names = ["z", "x", "y", *(f"c{k}" for k in range(9))][:columns]
    row = ",".join(["9.8", "0.1", "0.2", *["1"] * 9][:columns])
    path.write_text(",".join(names) + "\n" + f"{row}\n{row}1\n" * 20_000)
    estimate = recorded_csv.memory_of_text(path)
    tracemalloc.start()
    RecordedVibration(path, 1000.0, high_pass=1.0, sample_rate=500.0, unused="x")
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert 0.3 * estimate < peak < 1.05 * estimate


def test_lines_are_numbered_across_blocks(tmp_path, monkeypatch):
    monkeypatch.setattr(recorded_csv, "BLOCK", 64)
    lines = ["\ufeff# Größe", "", "t;z", *(f"{k};{10 + 0.125 * (k % 3)}" for k in range(50)), "# end", "50;1O"]
    path = tmp_path / "a.csv"
    path.write_text("\r\n".join(lines), encoding="utf-8")
    with pytest.raises(ExcitationError, match=f"line {len(lines)}: '1O' in column 'z' is no number"):
        recorded_csv.read_table(path)
    path.write_text("\r\n".join(lines[:-1]), encoding="utf-8")
    table = recorded_csv.read_table(path)
    assert table.lines.tolist() == list(range(4, 54))
    assert table.columns["z"].tolist() == [10 + 0.125 * (k % 3) for k in range(50)]


def test_a_line_without_end_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(recorded_csv, "BLOCK", 64)
    monkeypatch.setattr(recorded_csv, "LONGEST_LINE", 256)
    (tmp_path / "a.csv").write_text("z\n" + "1" * 1000)
    with pytest.raises(ExcitationError, match="line 2: the line has more than 256 characters"):
        recorded_csv.read_table(tmp_path / "a.csv")
