"""Tire property files: units, comments, tables, other keys; every fault one sentence with its line."""

import math

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from tests.rigs.vehicle.tire.property_file.tir_file import text, write

from contact_sim_pkg.files import FileRefusedError
from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.keys import DIMENSIONS, KEYS, UNITS
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import LARGEST_FILE, read_property_file

MILLIMETRES = {
    "LENGTH": "'mm'", "FORCE": "'kilonewton'", "ANGLE": "'degrees'", "MASS": "'gram'", "TIME": "'ms'", "PRESSURE": "'bar'",
}  # fmt: skip
IN_MILLIMETRES = {
    "UNLOADED_RADIUS": 316.0, "WIDTH": 205, "ASPECT_RATIO": 0.55, "RIM_RADIUS": 203.2, "INFLPRES": 2.2, "NOMPRES": 2.2,
    "BELT_MASS": 7000, "BELT_IYY": 6e8, "FNOMIN": 4, "VERTICAL_STIFFNESS": 0.22, "FREQ_LONG": 0.07, "DAMP_LONG": 0.045,
    "YAW_STIFFNESS": 5000.0 * math.pi / 180.0,
}  # fmt: skip


def read(folder, content=None, **keys):
    return read_property_file(write(folder, content, **keys))


def test_the_same_tire_in_millimetres_kilonewtons_and_bar_is_the_same(tmp_path):
    plain = read(tmp_path, YAW_STIFFNESS=5000.0)
    other = read(tmp_path, units=MILLIMETRES, **IN_MILLIMETRES)
    assert {key: value for key, (value, _) in other.values.items()} == pytest.approx(
        {key: value for key, (value, _) in plain.values.items()}, rel=1e-12
    )
    assert plain.get("VERTICAL_STIFFNESS") == 220000.0
    assert plain.notes == other.notes == ()


def test_a_pressure_without_a_unit_is_force_over_area(tmp_path):
    units = {name: unit for name, unit in MILLIMETRES.items() if name != "PRESSURE"} | {"FORCE": "newton"}
    given = {**IN_MILLIMETRES, "FNOMIN": 4000, "VERTICAL_STIFFNESS": 220, "INFLPRES": 0.22, "NOMPRES": 0.22}
    assert read(tmp_path, units=units, **given).get("INFLPRES") == pytest.approx(220e3, rel=1e-12)
    with pytest.raises(PropertyFileError, match=r"INFLPRES 220000 is 2\.2e\+11 Pa, .* names no PRESSURE; 10000 to"):
        read(tmp_path, units=units, **{**given, "INFLPRES": 220000})


def test_units_left_out_are_those_of_si_with_a_note(tmp_path):
    found = read(tmp_path, units={"LENGTH": "'METER'"})
    assert found.get("FNOMIN") == 4000.0
    assert found.notes == ("[UNITS] names no FORCE, MASS, TIME, ANGLE; taken in SI",)


def test_units_and_dimensions_are_known_to_each_other():
    assert {name for powers in DIMENSIONS.values() for name, _ in powers} == set(UNITS)
    assert {key.unit for key in KEYS.values()} <= set(DIMENSIONS)
    assert UNITS["PRESSURE"]["psi"] == pytest.approx(6894.757293168361, rel=1e-12)  # exact by definition
    assert UNITS["MASS"]["slug"] == pytest.approx(14.593902937206, rel=1e-12)


def test_comments_quotes_tables_exponents_and_encodings_are_read(tmp_path):
    content = (
        "\ufeff$ a 'comment with one quote\r\n[mdi_header]\r\nFILE_TYPE = 'TIR'\r\n{comment}\r\n"
        "[units]\r\nlength='mm'!here too\r\nFORCE = \"N\"\r\nMASS=kg\r\nTIME='sec'\r\nANGLE='rad'\r\n"
        "[MODEL]\r\nTYRE = 'a $ and = and [ in quotes' $ there\r\n"
        "[SHAPE]\r\n{radial width}\r\n 1.0 0.0\r\n 0.9 1.0\r\n"
        "[DIMENSION]\r\nwidth = 2.05D+002 $ [mm]\r\nRIM_RADIUS=.2032E3\r\nASPECT_RATIO = +0.55\r\n"
    )
    for encoded in (content.encode(), content[1:].replace("a 'c", "ä 'c").encode("latin-1")):
        found = read(tmp_path, encoded)
        assert {key: value for key, (value, _) in found.values.items()} == pytest.approx(
            {"WIDTH": 0.205, "RIM_RADIUS": 0.2032, "ASPECT_RATIO": 0.55}
        )
        assert found.values["WIDTH"].line == 18
        assert found.unread == ("TYRE",)
        assert found.notes == ("tables skipped: SHAPE",)


def test_of_a_key_that_stands_there_twice_the_last_counts_with_a_note(tmp_path):
    found = read(tmp_path, text() + "FNOMIN = 5000\nFNOMIN = 5000\n")
    assert found.get("FNOMIN") == 5000.0
    assert [note for note in found.notes if "FNOMIN" in note] == [
        "FNOMIN stands in line 23 and again in line 29; the last counts"
    ]


def test_nothing_and_0_of_a_quantity_above_0_count_as_not_given(tmp_path):
    found = read(tmp_path, FREQ_LONG=0, Q_FZ2=0, Q_RA1="  $ half length")
    assert found.get("FREQ_LONG") is found.get("Q_RA1") is None
    assert found.get("Q_FZ2") == 0.0
    assert found.notes == ("FREQ_LONG is 0 and counts as not given", "Q_RA1 has no value and counts as not given")


@pytest.mark.fault("A15")
@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"", "none of the keys of a tire is there"),
        (text().encode("utf-16"), "byte 3: this is no text"),
        (text().replace("'meter'", "'furlong'"), r"line 6: LENGTH in 'furlong' is not read; meter, metre, m, .* are"),
        (text(FNOMIN=None) + "FNOMIN = 4,0", r"line 28: FNOMIN is '4,0'; a number with a decimal point was expected"),
        (text(FNOMIN=None) + "FNOMIN = nan", "a number with a decimal point"),
        (text(FNOMIN=None) + "FNOMIN = 4000 N", "'4000 N'"),
        (text(FNOMIN=None) + "FNOMIN = 1e400", "FNOMIN inf is inf N, read in newton; 100 to 200000 N is allowed"),
        (text(FNOMIN=None) + "FNOMIN = " + "9" * 5000, "FNOMIN inf is inf N"),
        (text(ASPECT_RATIO=None) + "ASPECT_RATIO = 55", r"ASPECT_RATIO 55 is 55; 0\.1 to 1\.2 is allowed"),
        (text(WIDTH=205), "WIDTH 205 is 205 m, read in meter"),
        (text() + "NAME = 'no end", r"line \d+: a text begins and does not end"),
        (text() + "[OPEN", r"'\[OPEN' opens a section without \]"),
        (text() + "a b = 3", "'a b' is no name of a key"),
        ("x = 3\n[UNITS]\n", "line 1: 'x = 3' stands before the first"),
        (text().replace("'tir'", "'rdf'"), "line 3: FILE_TYPE is 'rdf'; 'tir'"),
    ],
)
def test_a_file_that_is_none_is_refused_with_its_line(tmp_path, content, sentence):
    with pytest.raises(PropertyFileError, match=sentence) as caught:
        read(tmp_path, content)
    assert "\n" not in str(caught.value)
    assert str(caught.value).startswith(str(tmp_path))


def test_a_file_too_large_or_no_file_is_refused_unread(tmp_path):
    with pytest.raises(FileRefusedError, match="at most 1048576 bytes"):
        read(tmp_path, b"\n" * (LARGEST_FILE + 1))
    with pytest.raises(FileRefusedError, match="is a directory"):
        read_property_file(tmp_path)


@given(st.data())
@example(None)
@settings(max_examples=200, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_damaged_bytes_are_read_or_refused_in_one_sentence(tmp_path, data):
    content = bytearray(text().encode())
    if data is not None:
        for place, byte in data.draw(
            st.lists(st.tuples(st.integers(0, len(content) - 1), st.integers(0, 255)), max_size=8)
        ):
            content[place] = byte
        content = content[: data.draw(st.integers(0, len(content)))]
    try:
        found = read(tmp_path, bytes(content))
    except PropertyFileError as error:
        assert "\n" not in str(error)  # noqa: PT017
    else:
        assert all(KEYS[key].low <= value <= KEYS[key].high for key, (value, _) in found.values.items())


def test_a_long_line_of_quotes_takes_no_time(tmp_path):
    """A million of them: a search from each would take hours."""
    for filling in ("''", "'a$", "[", "=", "$", '"'):
        try:
            read(tmp_path, text() + filling * ((LARGEST_FILE - 2000) // len(filling)))
        except PropertyFileError as error:
            assert len(str(error)) < 500  # noqa: PT017
