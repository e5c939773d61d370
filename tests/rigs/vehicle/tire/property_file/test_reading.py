"""Tire property files: units, comments, tables, other keys; every fault one sentence with its line."""

import math
import random

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from tests.rigs.vehicle.tire.property_file.tir_file import text, write

from contact_sim_pkg.files import FileRefusedError
from contact_sim_pkg.rigs.vehicle.tire.property_file import scene_keys
from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.fit import Lines, Target
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
IN_NEWTONS = {
    **{key: value for key, value in IN_MILLIMETRES.items() if key not in ("BELT_MASS", "FREQ_LONG", "DAMP_LONG")},
    "FNOMIN": 4000, "VERTICAL_STIFFNESS": 220.0, "INFLPRES": None, "NOMPRES": None, "BELT_IYY": 6e5,
    "YAW_STIFFNESS": 5e6 * math.pi / 180.0,
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


@pytest.mark.parametrize(
    ("word", "number", "pascal", "unit"),
    [("INFLPRES", 220000, 220e3, "pascal"), ("INFLATION_PRESSURE", 2.7, 2.7e5, "bar"), ("IP", 40, 275790.29, "psi")],
)
def test_a_pressure_that_one_unit_alone_makes_an_inflation_is_taken_in_it(tmp_path, word, number, pascal, unit):
    """Makers write bar or psi beside meter and newton, in which 2.7 would be 2.7 Pa."""
    units = {"LENGTH": "'mm'", "FORCE": "'newton'", "MASS": "'kg'", "TIME": "'s'", "ANGLE": "'rad'"}
    found = read(tmp_path, text(units=units, **{**IN_NEWTONS, word: number}))
    assert found.get(word) == pytest.approx(pascal, rel=1e-7)
    assert any(f"is taken in {unit}" in note for note in found.notes)


def test_a_pressure_that_two_units_make_an_inflation_is_refused_with_both(tmp_path):
    cure = r"line 27: IP 95 is 95 Pa, .*; PRESSURE = 'kpa' or PRESSURE = 'psi' in \[UNITS\] would make it one"
    with pytest.raises(PropertyFileError, match=cure):
        read(tmp_path, INFLPRES=None, NOMPRES=None, IP=95)
    with pytest.raises(PropertyFileError, match=r"INFLPRES 220000 is 2\.2e\+10 Pa, read in bar; .*PRESSURE = 'pascal'"):
        read(tmp_path, units={**MILLIMETRES, "PRESSURE": "'bar'"}, **{**IN_MILLIMETRES, "INFLPRES": 220000})


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
        (
            text(INFLPRES=None, NOMPRES=None, COLD_PRESS=2.2),
            "line 27: COLD_PRESS 2.2 looks like an inflation under a name",
        ),
        (
            text() + "PROPERTY_FILE_FORMAT = 'FTIRE'",
            "line 29: 'ftire': a file of FTire, which describes belt and tread as a",
        ),
        (text() + "[CDTIRE_DATA]\n", "line 29: 'CDTIRE_DATA': a file of CDTire, .* give a Magic Formula file"),
        (text() + "PROPERTY_FILE_FORMAT = 'RMOD-K'", "line 29: 'rmod-k': a file of RMOD-K"),
        (
            text() + "[DEFLECTION_LOAD_CURVE]\n0 0\n",
            r"line 30: \[DEFLECTION_LOAD_CURVE\] has one point; two or more are needed",
        ),
        (text() + "[DEFLECTION_LOAD_CURVE]\n0 0\n0.01\n", r"line 31: '0\.01' is no row of \[DEFLECTION_LOAD_CURVE\]"),
        (
            text() + "[DEFLECTION_LOAD_CURVE]\n0 0\n0.02 9\n0.01 12\n",
            r"line 32: .* goes from 0\.02 m, 9 N to 0\.01 m, 12 N",
        ),
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


def test_a_table_of_loads_is_read_in_the_units_of_the_file_in_either_order(tmp_path):
    head = text(units={**MILLIMETRES, "PRESSURE": "'bar'"}, **IN_MILLIMETRES)
    points = ((0.0, 0.0), (0.01, 3000.0), (0.02, 6400.0))
    for rows in ("{pen fz}\n0 0\n10 3.0\n20 6.4\n", "{fz, pen}\n0 0\n3.0, 10\n6.4, 20 $ kN and mm\n"):
        found = read(tmp_path, head + "[DEFLECTION_LOAD_CURVE]\n" + rows)
        assert [x for point in found.curve.points for x in point] == pytest.approx(
            [x for point in points for x in point]
        )
        deflection, stiffness = found.curve.under(4000.0)
        assert (deflection, stiffness) == pytest.approx((0.01 + 1000.0 / 340e3, 340e3))
        assert found.curve.under(6401.0) is found.curve.load_at(0.021) is None
        assert found.curve.load_at(0.015) == pytest.approx(4700.0)
        assert found.notes == ()


@pytest.mark.parametrize(
    ("line", "pascal"),
    [
        ("! : COMMENT :           Infl. pressure    (Pa)  200000", 2e5), ("!: Infl. Pressure (PSI) : 32", 220632.233),
        ("$ 'Pressure             - 2.00 bar'", 2e5), ("! inflation pressure range (Pa) 100000", None), ("! pressure (Pa)", None),
        ("! pressure (furlong) 3", None),
    ],
)  # fmt: skip
def test_an_inflation_in_a_comment_is_found(tmp_path, line, pascal):
    found = read(tmp_path, line + "\n" + text()).commented
    assert found == pytest.approx((pascal, 1), rel=1e-7) if pascal else found is None


def broken(generator):
    """A file with one to four lines deleted, doubled, swapped, garbled or moved into another section, or another unit."""
    curve = "[DEFLECTION_LOAD_CURVE]\n{pen fz}\n0 0\n0.01 3000\n0.02 6400\n"
    lines = (text(IP=250000, PROPERTY_FILE_FORMAT="'PAC2002'", LIP=1, Q_FZ2=15, PKX1=20) + curve).splitlines()
    for _ in range(generator.randint(1, 4)):
        at, to = generator.randrange(len(lines)), generator.randrange(len(lines))
        way = generator.randrange(7)
        if way == 0:
            del lines[at]
        elif way == 1:
            lines.insert(to, lines[at])
        elif way == 2:
            lines[at], lines[to] = lines[to], lines[at]
        elif way == 3:
            place, size = generator.randrange(len(lines[at]) + 1), generator.randint(0, 4)
            garble = "".join(generator.choice("=[]{}$!'\"0.9-eE+ ,\tnaÿ\x1b") for _ in range(size))
            lines[at] = lines[at][:place] + garble + lines[at][place + generator.randint(0, 3) :]
        elif way == 4:
            lines[at] = f"[{generator.choice(('UNITS', 'MODEL', 'DEFLECTION_LOAD_CURVE', 'MDI_HEADER', 'X', ''))}]"
        elif way == 5:
            quantity = generator.choice(list(UNITS))
            lines.insert(5, f"{quantity} = '{generator.choice([*UNITS[quantity], 'stone', ''])}'")
        else:
            name, _, _ = lines[at].partition("=")
            lines[at] = (
                f"{name}= {generator.choice(('0', '-1', '1e-320', '1e300', '1e999', 'nan', '4,2', '-2.2e5', '1e3', ''))}"
            )
    return "\n".join(lines)


@pytest.mark.fault("A15")
def test_a_broken_file_is_read_or_refused_in_one_sentence(tmp_path, monkeypatch):
    """Up to the keys of the scene; the fit alone, which costs a second, is left out."""
    monkeypatch.setattr(scene_keys, "fitted", lambda inflation, aim, ring: inflation)
    standing = Target(220e3, 4000.0, 2e5, 0.02, 0.13, 0.14), Lines(1e-3, 2e-5, 0.0166)
    monkeypatch.setattr(scene_keys, "found_where", lambda inflation, targets: [standing] * len(targets))
    refused = 0
    for seed in range(600):
        file = write(tmp_path, broken(random.Random(seed)))
        try:
            found = scene_keys.scene_tire(read_property_file(file))
        except PropertyFileError as error:
            refused += 1
            assert "\n" not in str(error)  # noqa: PT017
            assert str(error).startswith(str(file))  # noqa: PT017
        else:
            assert 1e5 <= found.effects["inflation"]["pressure"] <= 4e5
            assert all(math.isfinite(each.file) and each.file > 0.0 for each in found.judged)
    assert 100 < refused < 500


def test_a_long_line_of_quotes_takes_no_time(tmp_path):
    """A million of them: a search from each would take hours."""
    for filling in ("''", "'a$", "[", "=", "$", '"', "$pres (", "!pres - 1"):
        try:
            read(tmp_path, text() + filling * ((LARGEST_FILE - 2000) // len(filling)))
        except PropertyFileError as error:
            assert len(str(error)) < 500  # noqa: PT017
