"""Malformed OpenCRG files: every one a sentence with the place and both numbers, none another exception."""

import math
import re
import tracemalloc

import numpy
import pytest
from tests.excitation import crg_file

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.opencrg.road import OpenCrgRoad, memory_needed

X, Y = numpy.linspace(0.0, 2.0, 9), numpy.array([-0.4, 0.1, 0.2])
BELGIAN = crg_file.REAL_DATA / "belgian_block.crg"


def refused(tmp_path, message, numbers=None, **options):
    path = crg_file.write(tmp_path / "road.crg", options.pop("form", "KRBI"), numbers or crg_file.table(), **options)
    with pytest.raises(ExcitationError, match=message) as caught:
        OpenCrgRoad(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.fault("A13")
@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ({"REFERENCE_LINE_INCREMENT": None}, "no REFERENCE_LINE_INCREMENT"),
        ({"REFERENCE_LINE_INCREMENT": 0.0}, r"line \d+: REFERENCE_LINE_INCREMENT is 0 m; allowed"),
        ({"REFERENCE_LINE_END_U": 12.2}, r"line \d+: REFERENCE_LINE_END_U 12\.2 m is 4\.4 increments"),
        ({"REFERENCE_LINE_END_U": 9.0}, "END_U 9 m is -2 increments"),
        ({"REFERENCE_LINE_END_U": 12.5}, r"80 bytes, expected 96 .*\bcut\b"),
        ({"REFERENCE_LINE_END_U": 11.5}, "4 numbers follow the 4 rows"),
        ({"REFERENCE_LINE_END_U": 1e9}, r"limit 67108864"),
        ({"LONG_SECTION_V_LEFT": 0.25}, r"LONG_SECTION_V_LEFT says 0\.25 m, the channel definitions say 0\.2 m"),
        ({"REFERENCE_LINE_END_PHI": 0.1}, r"END_PHI says 0\.1 rad, the data says 0\.00390625 rad"),
        ({"REFERENCE_LINE_START_Z": 0.0, "REFERENCE_LINE_END_Z": 3.0}, "END_Z says 3 m, the data says 0 m"),
        (
            {"REFERENCE_LINE_START_X": 0.0, "REFERENCE_LINE_START_Y": 0.0, "REFERENCE_LINE_END_X": 5.0},
            r"END_X says 5 m, the data says 1\.9999",
        ),
        ({"REFERENCE_LINE_END_B": 0.2}, r"END_B says 0\.2 m/m, the data says 0 m/m"),
        ({"REFERENCE_LINE_INCREMNT": 0.5}, r"line \d+: 'reference_line_incremnt' is no .* REFERENCE_LINE_INCREMENT"),
        ({"reference_line_start_u": 10.0}, r"already given in line \d+"),
        ({"REFERENCE_LINE_START_S": "abc"}, "a plain number was expected"),
    ],
)
def test_a_header_that_contradicts_itself_or_the_data_is_refused_with_both_numbers(tmp_path, entries, message):
    refused(tmp_path, message, road=entries)


PHI = "reference line phi,rad"


@pytest.mark.parametrize(
    ("channels", "message"),
    [
        ([PHI, "long section 1,m", "long section 2,m", "long section 4,m"], "where 'long section 3' was expected"),
        ([PHI, "long section 1,m", "long section 2,m", "long section at v = 0.2,m"], "where 'long section 3' was"),
        ([PHI, "long section 1,mm", "long section 2,m", "long section 3,m"], "unit of 'long section 1' is 'mm'"),
        (["reference line phi,deg", "long section 1,m"], "is 'deg'; only rad"),
        ([PHI, "reference line friction,m/m", "long section 1,m"], "'reference line friction' is unknown"),
        ([PHI, PHI, "long section 1,m"], "defined a second time"),
        ([PHI], "no long section"),
        ([PHI, "long section at v = 0.2,m", "long section at v = 0.1,m"], "v must increase"),
    ],
)
def test_bad_channel_definitions_are_refused_by_name(tmp_path, channels, message):
    refused(tmp_path, message, channels=channels)


def test_a_channel_count_that_disagrees_with_the_road_parameters_shows_both(tmp_path):
    channels = [PHI, *(f"long section {k},m" for k in (1, 2, 3))]
    entries = {"LONG_SECTION_V_INCREMENT": 0.1}
    refused(tmp_path, "ask for 7 long sections .* definitions have 3", road=entries, channels=channels)


@pytest.mark.fault("A13")
@pytest.mark.parametrize(
    ("stated", "told"),
    [
        ("10.0,0.25", r"says 0\.25 m where REFERENCE_LINE_INCREMENT says 0\.5 m"),
        ("11.0,0.5", "11 m where REFERENCE_LINE_START_U"),
    ],
)
def test_the_channel_for_viewing_does_not_refuse_a_road_but_is_told(tmp_path, stated, told):
    """The standard's handmade_arc.crg and handmade_circle.crg state 1 m there and 4 or 10 m in the road parameters."""
    plain = OpenCrgRoad(crg_file.write(tmp_path / "plain.crg", table=crg_file.table()))
    text = crg_file.header().replace("#:KRBI", f"#:KRBI\nU:reference line x,m,{stated}")
    road = OpenCrgRoad(crg_file.write(tmp_path / "a.crg", table=crg_file.table(), text=text))
    assert (road.describe()["increment_m"], len(plain.describe()["notes"])) == (0.5, len(road.describe()["notes"]) - 1)
    assert re.search(told, road.describe()["notes"][0])


def test_a_road_too_steep_for_a_wheel_is_refused_before_the_run(tmp_path):
    """The standard's handmade_vtest.crg rises by 5.6 m across its 3 m."""
    rows = [[0.0, 0.7, 1.4]] * 3
    steep = OpenCrgRoad(crg_file.write(tmp_path / "a.crg", table=rows, rows=3, v=(-0.4, 0.0, 0.4), phi=False))
    steep.refuse_steep_track(numpy.array([-0.3, 0.0, 0.04]))  # 0.595 m
    with pytest.raises(
        ExcitationError, match=r"rises by 0\.7 m across the 0\.4 m of the tire's track; allowed: 0\.6 m"
    ):
        steep.refuse_steep_track(numpy.array([-0.2, 0.2]))


@pytest.mark.fault("A11")
@pytest.mark.parametrize("form", ["KRBI", "KDBI", "LRFI", "LDFI"])
@pytest.mark.parametrize("holes", [False, True])
def test_the_memory_that_a_road_takes_stays_below_the_estimate(tmp_path, form, holes):
    table = [[1.0 + (row % 7) / 64.0] * 40 for row in range(2000)]
    table[3][2] = math.nan if holes else 1.0
    v = tuple(0.1 * k for k in range(40))
    path = crg_file.write(tmp_path / "a.crg", form, table=table, rows=2000, v=v, phi=False)
    OpenCrgRoad(path, missing="hole")  # what is imported and kept once is not the file's
    tracemalloc.start()
    road = OpenCrgRoad(path, missing="hole")
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert road.describe()["missing_cells"] == holes
    assert 0.3 * memory_needed(path) < peak < 1.05 * memory_needed(path) + 1e6


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("$ROAD_CRG\n", "$ROAD_CRX\n", r"\$ROAD_CRX is unknown; did you mean ROAD_CRG"),
        ("$ROAD_CRG\n", "", "stands outside of every section"),
        ("$!*****\n", "", "opens inside section"),
        ("#:KRBI", "#:KRBX", "'KRBX' is unknown; allowed: LRFI"),
        ("$$$$" + "$" * 60, "$", "no end: .* was expected|never opened"),
        ("$KD_Definition", "$ROAD_CRG_FILE\nother.crg\n$\n$KD_Definition", "refers to another file"),
    ],
)
def test_broken_sections_are_refused_with_the_line(tmp_path, old, new, message):
    refused(tmp_path, rf"line \d+: .*({message})", text=crg_file.header().replace(old, new, 1))


@pytest.mark.parametrize("value", [1e38, -1e38, math.inf, 1.5e3])
@pytest.mark.parametrize("form", ["KRBI", "KDBI"])
def test_absurd_heights_are_refused_with_their_place(tmp_path, value, form):
    numbers = crg_file.table()
    numbers[3][2] = value
    refused(tmp_path, "row 4, long section 2 is .* damaged or in another unit", numbers, form=form)


def test_a_road_without_any_height_is_refused(tmp_path):
    refused(tmp_path, "all 15 cells of the road are missing", [[math.nan] * 4] * 5)


def test_a_reference_line_that_bends_onto_itself_is_refused(tmp_path):
    numbers = crg_file.table()
    for row, heading in zip(numbers, (math.nan, 0.0, 0.0, 1.5, 3.0), strict=True):
        row[0] = heading  # 3 1/m; the left edge is 0.4 m away
    refused(tmp_path, r"row 4 the reference line bends by 3 1/m", numbers, v=(-0.2, 0.0, 0.4))


def test_a_heading_that_is_missing_inside_is_refused(tmp_path):
    numbers = crg_file.table()
    numbers[2][0] = math.nan
    refused(tmp_path, "phi of the reference line in row 3 is nan", numbers)


def test_a_bad_field_of_text_data_is_named_with_its_line(tmp_path):
    text = crg_file.header("LRFI")
    body = crg_file.payload("LRFI", crg_file.table())
    first = text.count("\n") + 1
    spoiled = body.replace(b"\n   0.00098", b"\n   0.0x098", 1)
    assert spoiled != body
    (tmp_path / "road.crg").write_bytes(text.encode("latin-1") + spoiled)
    with pytest.raises(ExcitationError, match=rf"line {first + 1}: '0\.0x098' in columns 1 to 10 is no number"):
        OpenCrgRoad(tmp_path / "road.crg")


@pytest.mark.fault("A13")
@pytest.mark.parametrize("form", ["KRBI", "KDBI", "LRFI", "LDFI"])
def test_a_file_cut_anywhere_is_refused(tmp_path, form):
    whole = crg_file.write(tmp_path / "road.crg", form, crg_file.table(rows=6), rows=6).read_bytes()
    path = tmp_path / "cut.crg"
    useful = len(whole) - (64 if form == "KRBI" else 48 if form == "KDBI" else 1)  # the fill, or the last line's end
    cuts = {0, 1, useful - 1, *range(2, useful, 7), *(k + d for k in range(80, useful, 80) for d in (-1, 0, 1))}
    for cut in sorted(cut for cut in cuts if cut < useful):
        path.write_bytes(whole[:cut])
        with pytest.raises(ExcitationError, match=re.escape(str(path))):
            OpenCrgRoad(path)


def test_lost_carriage_returns_are_found_by_the_size_and_said(tmp_path):
    numbers = crg_file.table(rows=200)
    whole = crg_file.write(tmp_path / "road.crg", "KRBI", numbers, rows=200).read_bytes()
    (tmp_path / "cut.crg").write_bytes(whole[:-300] + whole[-298:])
    with pytest.raises(ExcitationError, match=r"has 3198 bytes, expected 3200 .*line-ending conversion"):
        OpenCrgRoad(tmp_path / "cut.crg")


@pytest.mark.parametrize("flip", [1, 16, 32, 128])
def test_a_flipped_byte_of_the_header_is_refused_or_changes_nothing(tmp_path, flip):
    entries = {
        "REFERENCE_LINE_START_X": 1.0, "REFERENCE_LINE_START_Y": 2.0, "REFERENCE_LINE_END_X": 3.0,
        "REFERENCE_LINE_END_Y": 2.0, "REFERENCE_LINE_START_PHI": 0.0, "REFERENCE_LINE_END_PHI": 0.0,
        "LONG_SECTION_V_INCREMENT": 0.3,
    }  # fmt: skip
    channels = [PHI, *(f"long section {k},m" for k in (1, 2, 3))]
    numbers = [[0.0, *row[1:]] for row in crg_file.table()]
    path = crg_file.write(tmp_path / "road.crg", "KRBI", numbers, road=entries, channels=channels, v=(-0.3, 0.0, 0.3))
    whole = path.read_bytes()
    wanted = OpenCrgRoad(path).heights(X, Y)
    accepted = 0
    for place in range(len(whole) - 80):
        spoiled = bytearray(whole)
        spoiled[place] ^= flip
        path.write_bytes(spoiled)
        try:
            found = OpenCrgRoad(path).heights(X, Y)
        except ExcitationError:
            continue
        accepted += 1
        # two statements of one length may differ by a thousandth of the increment
        numpy.testing.assert_allclose(found, wanted, atol=1e-3, err_msg=f"byte {place}")
    assert accepted > 20  # comments


def test_random_bytes_never_end_in_another_exception(tmp_path):
    generator = numpy.random.default_rng(3)
    path = crg_file.write(tmp_path / "road.crg", "KDBI", crg_file.table())
    whole = numpy.frombuffer(path.read_bytes(), numpy.uint8)
    for _ in range(400):
        spoiled = whole.copy()
        places = generator.integers(0, len(whole), generator.integers(1, 6))
        spoiled[places] = generator.integers(0, 256, len(places))
        path.write_bytes(spoiled.tobytes())
        try:
            heights = OpenCrgRoad(path, missing="fill", file_settings="apply").heights(X, Y)
        except ExcitationError:
            continue
        assert numpy.isfinite(heights).all()


@pytest.mark.parametrize("content", [b"", b"\x00" * 1000, b"PK\x03\x04", "ÄÖÜ\n".encode(), b"$CT\n$\n$$$$\n"])
def test_files_that_are_no_opencrg_are_refused(tmp_path, content):
    (tmp_path / "road.crg").write_bytes(content)
    with pytest.raises(ExcitationError, match=r"road\.crg"):
        OpenCrgRoad(tmp_path / "road.crg")


def test_a_missing_file_and_a_directory_are_refused(tmp_path):
    with pytest.raises(ExcitationError, match=r"none\.crg: cannot be read: No such file"):
        OpenCrgRoad(tmp_path / "none.crg")
    with pytest.raises(ExcitationError, match="cannot be read: is a directory"):
        OpenCrgRoad(tmp_path)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"missing": "guess"}, "missing is 'guess'; allowed: refuse, fill, hole"),
        ({"border_u": "mirror"}, "border_u is 'mirror'; allowed: none, zero, constant, repeat, reflect"),
        ({"level": "sea"}, "level is 'sea'"),
        ({"hole_depth": -1.0}, "hole_depth is -1"),
        ({"start": math.nan}, "start is nan"),
        ({"file_settings": "maybe"}, "'maybe' .* allowed: refuse, ignore, apply"),
    ],
)
def test_unknown_choices_are_refused_with_the_allowed_ones(tmp_path, options, message):
    path = crg_file.write(tmp_path / "road.crg", "KRBI", crg_file.table())
    with pytest.raises(ExcitationError, match=message):
        OpenCrgRoad(path, **options)


@pytest.mark.skipif(not BELGIAN.exists(), reason="the measured road is not at ../shared/data")
def test_the_measured_belgian_block_is_refused_when_cut_or_converted(tmp_path):
    whole = BELGIAN.read_bytes()
    start = whole.index(b"$$$$") + 73
    converted = whole[:start] + whole[start:].replace(b"\r\n", b"\n")
    assert len(whole) - len(converted) == 6
    rows = numpy.random.default_rng(4).integers(0, 1001, 20) * 342 * 4
    cuts = [whole[: start + row + shift] for row in rows for shift in (-1, 0, 1)]
    for content in [converted, *cuts]:
        (tmp_path / "road.crg").write_bytes(content)
        with pytest.raises(ExcitationError):
            OpenCrgRoad(tmp_path / "road.crg", missing="fill")
