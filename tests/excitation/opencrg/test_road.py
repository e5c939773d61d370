"""OpenCRG roads against files that the test writes and an independent slow reader."""

import json
import math

import numpy
import pytest
from tests.excitation import crg_file

from contact_sim_pkg.excitation.borders import TurnedBeginning
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.opencrg.road import OpenCrgRoad

BELGIAN = crg_file.REAL_DATA / "belgian_block.crg"
NAN = math.nan


def road(tmp_path, numbers=None, **options):
    """A road of the test's table, raw heights unless told otherwise."""
    keys = ("form", "road", "channels", "extra", "rows", "increment", "v", "phi")
    wanted = {key: options.pop(key) for key in keys if key in options}
    phi = wanted.get("phi", True)
    numbers = crg_file.table(phi=phi) if numbers is None else numbers
    form = wanted.pop("form", "KRBI")
    return OpenCrgRoad(crg_file.write(tmp_path / "road.crg", form, numbers, **wanted), **{"level": "raw", **options})


@pytest.mark.parametrize("form", ["KRBI", "KDBI", "LRFI", "LDFI"])
def test_all_four_formats_give_the_heights_at_the_nodes_and_bilinear_between(tmp_path, form):
    numbers = crg_file.table()
    surface = road(tmp_path, numbers, form=form)
    heights, v = [row[1:] for row in numbers], [-0.4, 0.0, 0.2]
    nodes = surface.heights(0.5 * numpy.arange(5), numpy.array(v))
    rounded = 6e-6 if form == "LRFI" else 1e-12  # ten characters hold five decimals
    numpy.testing.assert_allclose(nodes, heights, atol=rounded)
    x, y = numpy.array([0.0, 0.1, 0.77, 1.999, 2.0]), numpy.array([-0.4, -0.3, 0.05, 0.2])
    expected = [[crg_file.bilinear(0.5, v, heights, a, b) for b in y] for a in x]
    numpy.testing.assert_allclose(surface.heights(x, y), expected, atol=rounded)


@pytest.mark.parametrize("form", ["KRBI", "LDFI"])
def test_a_row_longer_than_a_record_is_read(tmp_path, form):
    v = tuple(0.1 * k for k in range(23))
    numbers = crg_file.table(sections=23)
    surface = road(tmp_path, numbers, form=form, v=v)
    numpy.testing.assert_allclose(
        surface.heights(0.5 * numpy.arange(5), numpy.array(v)), [row[1:] for row in numbers], atol=1e-12
    )


def test_numbers_that_touch_in_fixed_width_text_are_told_apart(tmp_path):
    text = crg_file.header("LRFI", rows=2, phi=False).encode("latin-1")
    (tmp_path / "road.crg").write_bytes(text + b"-0.0111111-0.0222222-0.0333333\n 0.0111111 0.0000000-0.1000000\n")
    surface = OpenCrgRoad(tmp_path / "road.crg", level="raw")
    expected = [[-0.0111111, -0.0222222, -0.0333333], [0.0111111, 0.0, -0.1]]
    numpy.testing.assert_allclose(surface.heights(numpy.array([0.0, 0.5]), numpy.array([-0.4, 0.0, 0.2])), expected)


@pytest.mark.parametrize(
    "entries",
    [
        {"LONG_SECTION_V_INCREMENT": 0.3},
        {"LONG_SECTION_V_INCREMENT": 0.3, "LONG_SECTION_V_LEFT": None},
        {"LONG_SECTION_V_INCREMENT": 0.3, "LONG_SECTION_V_RIGHT": None},
        {"LONG_SECTION_V_INCREMENT": 0.3, "LONG_SECTION_V_RIGHT": None, "LONG_SECTION_V_LEFT": None},
        {},
    ],
)
def test_numbered_long_sections_lie_evenly_between_the_edges(tmp_path, entries):
    channels = ["reference line phi,rad", *(f"long section {k},m" for k in (1, 2, 3))]
    numbers = crg_file.table()
    surface = road(tmp_path, numbers, v=(-0.3, 0.0, 0.3), channels=channels, road=entries)
    nodes = surface.heights(0.5 * numpy.arange(5), numpy.array([-0.3, 0.0, 0.3]))
    numpy.testing.assert_allclose(nodes, [row[1:] for row in numbers], atol=1e-12)


def test_a_file_without_an_end_takes_its_rows_from_the_data(tmp_path):
    numbers = crg_file.table()  # 80 bytes of numbers and no fill
    longer = crg_file.table(rows=6)  # 96 bytes of numbers, 64 of fill: three rows of four numbers would fit in
    for rows, entry in ((5, numbers), (6, longer)):
        surface = road(tmp_path, entry, road={"REFERENCE_LINE_END_U": None})
        assert surface.describe()["rows"] == rows


def test_banking_slope_and_start_height_of_the_reference_line_are_added(tmp_path):
    channels = [
        "reference line phi,rad", "reference line banking,m/m", "reference line slope,m/m",
        "long section at v = -0.400,m", "long section at v = 0.200,m",
    ]  # fmt: skip
    numbers = [[NAN, 0.01, NAN, 0.5, 0.5], [0.0, 0.02, 0.03, 0.5, 0.5], [0.0, 0.02, -0.01, 0.5, 0.5]]
    surface = road(tmp_path, numbers, rows=3, v=(-0.4, 0.2), channels=channels, road={"REFERENCE_LINE_START_Z": 7.0})
    line = numpy.array([7.0, 7.0 + 0.5 * 0.03, 7.0 + 0.5 * 0.02]) + 0.5
    expected = line[:, None] + numpy.array([[0.01], [0.02], [0.02]]) * numpy.array([-0.4, 0.2])
    numpy.testing.assert_allclose(
        surface.heights(numpy.array([0.0, 0.5, 1.0]), numpy.array([-0.4, 0.2])), expected, atol=1e-7
    )


def test_start_and_lateral_offset_move_the_origin(tmp_path):
    plain, moved = road(tmp_path), road(tmp_path, start=0.75, lateral_offset=-0.1)
    x, y = numpy.array([0.0, 0.3, 1.1]), numpy.array([-0.2, 0.0, 0.25])
    numpy.testing.assert_allclose(moved.heights(x, y), plain.heights(x + 0.75, y - 0.1), atol=1e-13)


def test_level_is_explicit(tmp_path):
    x, y = numpy.array([0.0]), numpy.array([0.0])
    numbers = crg_file.table()
    raw, origin, mean = (road(tmp_path, numbers, level=level) for level in ("raw", "origin", "mean"))
    assert raw.heights(x, y)[0, 0] == numbers[0][2]
    assert origin.heights(x, y)[0, 0] == 0.0
    whole_mean = sum(sum(row[1:]) for row in numbers) / 15
    assert mean.heights(x, y)[0, 0] == pytest.approx(numbers[0][2] - whole_mean)
    assert mean.describe()["height_removed_m"] == pytest.approx(whole_mean)


OUTSIDE_U = [
    ("zero", -0.25, None),
    ("zero", 2.25, None),
    ("constant", -3.0, 0.0),
    ("constant", 9.0, 2.0),
    ("repeat", 2.25, 0.25),
    ("repeat", -0.25, 1.75),
    ("repeat", 101.7, 1.7),
    ("reflect", -0.25, 0.25),
    ("reflect", 2.25, 1.75),
    ("reflect", 5.3, 1.3),
]


@pytest.mark.parametrize(("border", "x", "same_as"), OUTSIDE_U)
def test_beyond_the_ends_the_border_mode_decides(tmp_path, border, x, same_as):
    surface = road(tmp_path, border_u=border, level="raw")
    y = numpy.array([-0.1, 0.1])
    found = surface.heights(numpy.array([x]), y)
    expected = numpy.zeros((1, 2)) if same_as is None else surface.heights(numpy.array([same_as]), y)
    numpy.testing.assert_allclose(found, expected, atol=1e-11)


@pytest.mark.parametrize(
    ("border", "y", "same_as"),
    [
        ("zero", 0.3, None),
        ("constant", 0.3, 0.2),
        ("constant", -4.0, -0.4),
        ("repeat", 0.3, -0.3),
        ("reflect", 0.3, 0.1),
        ("reflect", -0.5, -0.3),
    ],
)
def test_beyond_the_sides_the_border_mode_decides(tmp_path, border, y, same_as):
    surface = road(tmp_path, border_v=border, level="raw")
    x = numpy.array([0.3, 1.2])
    found = surface.heights(x, numpy.array([0.0, y]))[:, 1]
    expected = numpy.zeros(2) if same_as is None else surface.heights(x, numpy.array([same_as]))[:, 0]
    numpy.testing.assert_allclose(found, expected, atol=1e-12)


def test_border_none_refuses_with_the_place(tmp_path):
    surface = road(tmp_path, border_u="none", border_v="none")
    with pytest.raises(
        ExcitationError, match=r"x = 2\.1 m lies outside .*road\.border_u: zero, keep, repeat or reflect"
    ):
        surface.heights(numpy.array([0.0, 2.1]), numpy.array([0.0]))
    with pytest.raises(ExcitationError, match=r"y = -0\.5 m lies outside .*road\.border_v: zero"):
        surface.heights(numpy.array([0.0]), numpy.array([-0.5]))


def with_holes():
    numbers = [[float(10 * row + column) for column in range(4)] for row in range(5)]
    numbers[1] = [NAN, 11.0, NAN, 13.0]
    numbers[3] = [NAN] * 4
    return numbers


HOLES = {"phi": False, "v": (-0.3, -0.1, 0.1, 0.3)}


@pytest.mark.fault("A13")
def test_missing_cells_are_refused_with_their_count(tmp_path):
    with pytest.raises(ExcitationError, match=r"6 of 20 cells have no height; .*road\.missing_cells: fill or hole"):
        road(tmp_path, with_holes(), **HOLES)


def test_missing_cells_are_filled_along_the_cross_section_and_then_along_the_road(tmp_path):
    surface = road(tmp_path, with_holes(), **HOLES, missing="fill")
    found = surface.heights(0.5 * numpy.arange(5), numpy.array([-0.3, -0.1, 0.1, 0.3]))
    numpy.testing.assert_allclose(found[1], [11.0, 11.0, 12.0, 13.0], atol=1e-12)
    numpy.testing.assert_allclose(found[3], [30.0, 31.0, 32.0, 33.0], atol=1e-12)
    assert "6 of 20 cells" in surface.describe()["notes"][0]


def test_missing_cells_become_holes_of_the_depth_that_is_requested(tmp_path):
    filled = road(tmp_path, with_holes(), **HOLES, missing="fill")
    holes = road(tmp_path, with_holes(), **HOLES, missing="hole", hole_depth=0.25)
    x, y = 0.5 * numpy.arange(5), numpy.array([-0.3, -0.1, 0.1, 0.3])
    depth = filled.heights(x, y) - holes.heights(x, y)
    numpy.testing.assert_allclose(depth, 0.25 * numpy.isnan(with_holes()), atol=1e-12)


MODIFIERS = [
    "$ROAD_CRG_MODS", "SCALE_Z_GRID = 2.0", "REFLINE_OFFSET_Z = 5.0", "$",
    "$ROAD_CRG_OPTS", "BORDER_MODE_U = 3", "$",
]  # fmt: skip


def test_settings_of_the_file_are_refused_until_the_user_decides(tmp_path):
    with pytest.raises(
        ExcitationError,
        match=r"BORDER_MODE_U = 3 \(line \d+\), SCALE_Z_GRID = 2 .*road\.file_settings: apply or ignore",
    ):
        road(tmp_path, extra=MODIFIERS)


def test_settings_of_the_file_are_ignored_or_applied_as_requested(tmp_path):
    plain = road(tmp_path)
    ignored = road(tmp_path, extra=MODIFIERS, file_settings="ignore")
    applied = road(tmp_path, extra=MODIFIERS, file_settings="apply")
    x, y = numpy.array([0.2, 1.9]), numpy.array([0.0, 0.1])
    numpy.testing.assert_array_equal(ignored.heights(x, y), plain.heights(x, y))
    numpy.testing.assert_allclose(applied.heights(x, y), 2.0 * plain.heights(x, y) + 5.0, rtol=1e-12)
    assert applied.describe()["border_u"] == "repeat"
    assert "SCALE_Z_GRID = 2" in ignored.describe()["notes"][0]


def test_a_setting_that_cannot_be_applied_is_refused_by_name(tmp_path):
    extra = ["$ROAD_CRG_OPTS", "BORDER_SMOOTH_UBEG = 1.5", "$"]
    with pytest.raises(ExcitationError, match="BORDER_SMOOTH_UBEG cannot be applied"):
        road(tmp_path, extra=extra, file_settings="apply")


def test_settings_that_leave_heights_alone_pass(tmp_path):
    extra = ["$ROAD_CRG_OPTS", "WARN_MSGS = 0", "$", "$ROAD_CRG_MODS", "REFPOINT_X = 12.5", "SCALE_Z_GRID = 1.0", "$"]
    x, y = numpy.linspace(0.0, 1.0, 7), numpy.linspace(-0.1, 0.1, 3)
    plain = road(tmp_path).heights(x, y)
    assert plain.any()
    assert road(tmp_path, extra=extra).heights(x, y).tobytes() == plain.tobytes()


def test_settings_that_change_nothing_on_this_road_are_taken_and_named(tmp_path):
    extra = ["$ROAD_CRG_MODS", "GRID_NAN_MODE = 2", "SCALE_BANKING = 3", "SCALE_SLOPE = 3", "$",
             "$ROAD_CRG_OPTS", "BORDER_MODE_U = 2", "BORDER_MODE_V = 3", "$"]  # fmt: skip
    x, y = numpy.linspace(0.0, 1.0, 7), numpy.linspace(-0.1, 0.1, 3)
    plain = road(tmp_path).heights(x, y)
    for policy in ("refuse", "ignore", "apply"):
        surface = road(tmp_path, extra=extra, file_settings=policy, border_v="constant")
        assert surface.heights(x, y).tobytes() == plain.tobytes()
        notes = " ".join(surface.describe()["notes"])
        assert "change nothing here: BORDER_MODE_U = 2" in notes
        assert "GRID_NAN_MODE = 2" in notes
        assert "not applied, for border_u and border_v are chosen: BORDER_MODE_V = 3" in notes


@pytest.mark.parametrize(
    ("line", "changes"),
    [
        ("GRID_NAN_MODE = 2", {"numbers": "holes", "missing": "fill"}),
        ("SCALE_SLOPE = 3", {"road": {"REFERENCE_LINE_START_S": 0.01}}),
        ("SCALE_LENGTH = 2", {}),
    ],
)
def test_settings_that_change_heights_still_wait_for_the_user(tmp_path, line, changes):
    options = {**changes, **(HOLES if changes.get("numbers") else {})}
    numbers = with_holes() if options.pop("numbers", None) else None
    for policy, sentence in (("refuse", line), ("apply", "cannot be applied")):
        with pytest.raises(ExcitationError, match=sentence):
            road(tmp_path, numbers, extra=["$ROAD_CRG_MODS", line, "$"], file_settings=policy, **options)


def test_before_its_beginning_a_road_is_turned_so_that_its_slope_goes_on(tmp_path):
    x, y = numpy.array([-0.4, -0.1, 0.0, 0.3]), numpy.array([-0.3, 0.1])
    for start in (0.0, 0.2):
        plain = road(tmp_path, start=start, border_u="none")
        turned = TurnedBeginning(plain)
        begins, mirrored = plain.heights(numpy.array([-start]), y), plain.heights(numpy.abs(x + start) - start, y)
        expected = numpy.where((x < -start)[:, None], 2.0 * begins - mirrored, mirrored)
        numpy.testing.assert_allclose(turned.heights(x, y), expected, atol=1e-13)
    # Where the start itself lies before the road the border decides.
    before = TurnedBeginning(road(tmp_path, start=-1.0, border_u="zero"))
    assert not before.heights(numpy.array([0.0, 0.9]), y).any()


def test_large_roads_are_evaluated_without_their_table_to_the_same_bits(tmp_path, monkeypatch):
    x, y = numpy.linspace(-1.0, 3.0, 50), numpy.linspace(-0.3, 0.1, 9)
    for border in ("repeat", "reflect", "constant"):
        small = road(tmp_path, border_u=border).heights(x, y)
        with monkeypatch.context() as patch:
            patch.setattr("contact_sim_pkg.excitation.opencrg.road.LARGEST_TABLE", 1)
            assert road(tmp_path, border_u=border).heights(x, y).tobytes() == small.tobytes()


def test_description_is_plain_json_and_names_the_curve(tmp_path):
    described = json.loads(json.dumps(road(tmp_path).describe()))
    assert described["heading_change_rad"] == pytest.approx(3 / 1024)
    # heading grows by 1/1024 rad each 0.5 m; the right edge is 0.4 m away
    assert described["largest_stretch_beside_reference_line"] == pytest.approx(0.4 / 1024 / 0.5)


@pytest.mark.skipif(not BELGIAN.exists(), reason="the measured road is not at ../shared/data")
def test_the_measured_belgian_block_agrees_with_an_independent_reader():
    surface = OpenCrgRoad(BELGIAN, missing="fill", level="raw", border_u="none", border_v="none")
    u0, du, v, heights = crg_file.slow_read(BELGIAN)
    described = surface.describe()
    assert described["missing_cells"] == sum(math.isnan(value) for row in heights for value in row)
    assert (u0, len(heights), len(v)) == (730.0, 1001, 341)
    generator = numpy.random.default_rng(2)
    x, y = numpy.sort(generator.uniform(0.0, 10.0, 40)), numpy.sort(generator.uniform(-1.3, 1.7, 30))
    expected = [[crg_file.bilinear(du, v, heights, a, b) for b in y] for a in x]
    numpy.testing.assert_allclose(surface.heights(x, y), expected, atol=1e-10)


@pytest.mark.skipif(not BELGIAN.exists(), reason="the measured road is not at ../shared/data")
def test_the_measured_belgian_block_is_refused_while_nobody_says_what_missing_cells_are():
    with pytest.raises(ExcitationError, match="22228 of 341341 cells"):
        OpenCrgRoad(BELGIAN)


@pytest.mark.skipif(not BELGIAN.exists(), reason="the measured road is not at ../shared/data")
def test_the_measured_belgian_block_starts_at_height_zero_and_stays_near_it():
    surface = OpenCrgRoad(BELGIAN, missing="fill")
    described = surface.describe()
    assert surface.heights(numpy.zeros(1), numpy.zeros(1))[0, 0] == pytest.approx(0.0, abs=1e-12)
    assert described["lowest_height_in_file_m"] == pytest.approx(2.0355, abs=1e-4)
    assert described["highest_height_in_file_m"] == pytest.approx(2.1830, abs=1e-4)
    line = surface.heights(numpy.arange(0.0, 10.0, 0.01), numpy.array([0.3]))[:, 0]  # 0.3 m left
    x = numpy.arange(len(line))
    assert numpy.std(line - numpy.polyval(numpy.polyfit(x, line, 1), x)) == pytest.approx(0.0143, abs=5e-4)
