"""Profiles of roads in the files that people have, against z = 0.01 sin(pi x)."""

import codecs
import re

import numpy
import pytest

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.profile.formats import is_opencrg
from contact_sim_pkg.excitation.profile.road import ProfileRoad

X = numpy.arange(0.0, 4.01, 0.05)
Z = 0.01 * numpy.sin(numpy.pi * X)
MIDDLE = numpy.zeros(1)


def table(header, *columns, separator=",", form="{:.6f}"):
    rows = [separator.join(form.format(value) for value in row) for row in zip(*columns, strict=True)]
    return "\n".join([*header, *rows, ""])


def rdf(unit="meter", scale=1.0, right=Z, more=""):
    rows = table([], scale * X, scale * Z, scale * right, separator=" ")
    return (
        f"$ comment\n[MDI_HEADER]\nFILE_TYPE = 'rdf'\n[UNITS]\nLENGTH = '{unit}'\n[MODEL]\nMETHOD = '2D' $ words\n"
        f"ROAD_TYPE = 'poly_line'\n[GRAPHICS]\nWIDTH = 3.0\n[PARAMETERS]\n{more}(XZ_DATA)\n{{x left right}}\n{rows}"
    )


def erd(channels=(Z,), step=0.05, names=("Elev.",), unit="m", along="m", kind=5, samples=None):
    head = [
        "ERDFILEV2.00",
        f" {len(channels)}, {len(X) if samples is None else samples}, -1, 1, {kind}, {step}, -1,",
        "TITLE   a sine",
        "SHORTNAM" + "".join(f"{name:8}" for name in names),
        "UNITSNAM" + "".join(f"{unit:8}" for _ in channels),
        f"XUNITS  {along}",
        "END",
    ]
    return table(head, *channels, separator=" ", form="{:12.6f}")


KINDS = {
    "pairs": ("x_z.csv", table(["x [m],z [m]"], X, Z)),
    "no header": ("x_z.txt", table([], X, Z, separator=" ")),
    "millimetres": ("x_z.csv", table(["x [m],z [mm]"], X, 1e3 * Z)),
    "row of units": ("x_z.csv", table(["station\televation", "m\tmm"], X, 1e3 * Z, separator="\t")),
    "units in names": ("x_z.csv", table(["x_m;z_mm"], X, 1e3 * Z, separator=";")),
    "decimal commas": ("x_z.csv", table(["Weg [m];Höhe [m]"], X, Z, separator=";").replace(".", ",")),
    "from 1000 m on, in feet": ("x_z.csv", table(["x [ft],z [in]"], (X + 1000.0) / 0.3048, Z / 0.0254, form="{:.7f}")),
    "two tracks": ("x_z.csv", table(["x,z_left,z_right"], X, Z, Z)),
    "more columns": ("x_z.csv", table(["x [m],y [m],z [m]"], X, 0 * X, Z)),
    "RDF": ("road.rdf", rdf()),
    "RDF in mm": ("road.txt", rdf("mm", 1e3)),
    "ERD": ("road.erd", erd()),
    "ERD in mm and ft": ("road.dat", erd((1e3 * Z, 1e3 * Z), 0.05 / 0.3048, ("LElev.", "RElev."), "mm", "ft")),
    "ERD with a middle track": ("road.erd", erd((Z, 0 * Z, Z), names=("LElev.", "CElev.", "RElev."))),
}


def road(tmp_path, name, text, **options):
    data = text if isinstance(text, bytes) else text.encode("cp1252")
    (tmp_path / name).write_bytes(data)
    assert not is_opencrg(tmp_path / name)
    return ProfileRoad(tmp_path / name, level="origin", **options)


@pytest.mark.parametrize("kind", KINDS)
def test_each_kind_of_file_gives_the_sine_at_its_points_and_is_straight_between(tmp_path, kind):
    surface = road(tmp_path, *KINDS[kind])
    at = numpy.array([0.0, 0.05, 0.5, 1.5, 3.95, 4.0])
    numpy.testing.assert_allclose(surface.heights(at, MIDDLE)[:, 0], 0.01 * numpy.sin(numpy.pi * at), atol=1.1e-6)
    between = 0.005 * (numpy.sin(0.45 * numpy.pi) + 1.0)
    assert surface.heights(numpy.array([0.475]), numpy.array([-0.1, 0.1])) == pytest.approx(between, abs=1.1e-6)


def test_a_file_in_utf_16_is_read(tmp_path):
    text = codecs.BOM_UTF16_LE + KINDS["pairs"][1].encode("utf-16-le")
    assert road(tmp_path, "x_z.csv", text).heights(numpy.array([0.5]), MIDDLE)[0, 0] == pytest.approx(0.01)


def test_the_mean_is_that_over_the_way_and_not_over_the_points(tmp_path):
    (tmp_path / "x_z.csv").write_text("x [m],z [m]\n0,0\n1,0\n2,0\n2.001,1\n6.001,1\n")
    surface = ProfileRoad(tmp_path / "x_z.csv")
    expected = (4.0 + 0.0005) / 6.001
    assert surface.heights(numpy.array([0.5]), MIDDLE)[0, 0] == pytest.approx(-expected, rel=1e-12)
    assert surface.describe()["height_removed_m"] == pytest.approx(expected, rel=1e-12)


def test_two_tracks_are_straight_across_between_them_and_level_beyond(tmp_path):
    text = table(["x [m],z_right [m],z_left [m]"], X, 0 * X, Z)  # by their names, whatever the order
    surface = road(tmp_path, "x_z.csv", text, track_offset=0.0, track_width=1.6)
    across = surface.heights(numpy.array([0.5]), numpy.array([-3.0, -0.8, -0.4, 0.0, 0.4, 0.8, 3.0]))[0]
    numpy.testing.assert_allclose(across, 0.01 * numpy.array([0, 0, 0.25, 0.5, 0.75, 1, 1]), atol=1e-12)
    left = road(tmp_path, "x_z.csv", text, track_width=1.6)
    assert left.heights(numpy.array([0.5]), MIDDLE)[0, 0] == pytest.approx(0.01)
    assert any("left track; road.track_offset: -0.8 takes the right one" in note for note in left.describe()["notes"])


def test_beyond_its_ends_the_road_goes_on_as_the_border_says_or_is_refused(tmp_path):
    name, text = KINDS["pairs"]
    with pytest.raises(
        ExcitationError, match=r"x = 4\.1 m lies outside .*road\.border_u: zero, keep, repeat or reflect"
    ):
        road(tmp_path, name, text).heights(numpy.array([4.1]), MIDDLE)
    for border, same_as in (("constant", 4.0), ("repeat", 0.5), ("reflect", 3.5)):
        surface = road(tmp_path, name, text, border_u=border)
        there, here = surface.heights(numpy.array([4.5, same_as]), MIDDLE)[:, 0]
        assert there == pytest.approx(here, abs=1e-12)
    assert road(tmp_path, name, text, border_u="zero").heights(numpy.array([4.5]), MIDDLE)[0, 0] == 0.0
    assert road(tmp_path, name, text, start=1.0).heights(numpy.array([0.5]), MIDDLE)[0, 0] == pytest.approx(-0.01)


SAID = {
    "a gap": ("x [m],z [m]\n0,0\n1,0\n2,0.1\n3,0\n40,0\n", r"1 steps of x .*5 times the median 1 m, .*line 5 to 6 with 37 m"),
    "uneven": ("x [m],z [m]\n0,0\n1,0\n2,0.1\n2.5,0\n", r"unevenly spaced, by 0\.5 to 1 m; the road is straight between"),
    "no unit": ("x,z\n0,0\n1,0\n2,0.1\n", "taken as metres"),
    "other names": ("Weg [m],Profil [m]\n0,0\n1,0\n", "Distance is column 'weg', height 'profil'"),
    "further columns": ("x [m],z [m],mu\n0,0,1\n1,0,1\n", "not used: mu"),
}  # fmt: skip


@pytest.mark.parametrize("case", SAID)
def test_what_was_found_or_assumed_is_said(tmp_path, case):
    text, sentence = SAID[case]
    notes = road(tmp_path, "x_z.csv", text).describe()["notes"]
    assert any(re.search(sentence, note) for note in notes), notes


def test_settings_of_an_rdf_file_that_are_not_applied_are_named(tmp_path):
    notes = road(tmp_path, "road.rdf", rdf(more="MU = 0.8\nOFFSET = 3\n")).describe()["notes"]
    assert any("not applied: MU = 0.8 (line 12), OFFSET = 3 (line 13)" in note for note in notes), notes


REFUSED = {
    "x falls": ("a.csv", "x [m],z [m]\n0,0\n1,0\n0.9,0\n2,0\n", r"line 4: x falls, 0\.9 m after 1 m in line 3 .*sort the lines"),
    "x repeats": ("a.csv", "x [m],z [m]\n0,0\n1,0\n1,0.1\n2,0\n", r"line 4: x repeats, .*vertical face needs a millimetre"),
    "NaN": ("a.csv", "x [m],z [m]\n0,0\n1,nan\n2,0\n", r"line 3: the point is \(1, nan\).*delete the line"),
    "blank": ("a.csv", "x [m],z [m]\n0,0\n1,\n2,0\n", r"line 3: the point is \(1, nan\)"),
    "text": ("a.csv", "x [m],z [m]\n0,0\n1,high\n2,0\n", r"line 3: 'high' in column 'z' is no number"),
    "ragged": ("a.csv", "x [m],z [m]\n0,0\n1\n2,0\n", r"line 3: 1 fields, expected 2 .*road\.header_line"),
    "words before": ("a.csv", "Site 7\nx [m],z [m]\n0,0\n1,0\n", r"road\.header_line"),
    "time": ("a.csv", "time [s],z [m]\n0,0\n1,0\n", "column 'time' is a time"),
    "force": ("a.csv", "x [m],z [N]\n0,0\n1,0\n", "column 'z' is in N"),
    "which": ("a.csv", "x [m],y [m],iri\n0,0,1\n1,0,1\n", "name them x and z, or x, z_left and z_right"),
    "one point": ("a.csv", "x [m],z [m]\n0,0\n", "at least two|two at least"),
    "mm as m": ("a.csv", table(["x,z"], X, 1e3 * Z), r"half of the road is steeper than .*x \[m\],z \[mm\]"),
    "both mm": ("a.csv", table(["x,z"], 1e3 * X, 1e3 * Z), r"half of its steps are longer than 50 m"),
    "far": ("a.csv", "x,z\n0,0\n1,0\n2,2000\n", r"line 4: the height is more than 1000 m"),
    "OpenCRG": ("a.txt", "$CT\nroad\n$\n", "road.kind: opencrg"),
    "plank": ("a.rdf", rdf().replace("poly_line", "plank"), r"line 8: its road is 'plank'; .*road\.kind: flat, step, bump"),
    "3D": ("a.rdf", "[MODEL]\nMETHOD = '3D'\n", r"line 2: its road is '3D'"),
    "no data": ("a.rdf", "[MODEL]\nROAD_TYPE = 'poly_line'\n", r"no points; a table \(XZ_DATA\)"),
    "RDF ragged": ("a.rdf", rdf() + "5.0 0.0\n", r"line \d+: '5\.0 0\.0' is no point; 3 numbers"),
    "RDF unit": ("a.rdf", rdf("parsec"), "LENGTH is 'parsec'"),
    "ERD cut": ("a.erd", erd(samples=90), r"states 90 samples, the file holds 81"),
    "ERD binary": ("a.erd", erd(kind=1), r"line 2: its numbers are binary .*as text \(kind 5\)"),
    "ERD channels": ("a.erd", erd((Z, Z, Z), names=("a", "b", "c")), r"which of its 3 channels \(a, b, c\)"),
    "ERD head": ("a.erd", "x,z\n0,0\n1,0\n", "line 1: an ERD file begins with ERDFILEV2.00"),
    "ERD gain": ("a.erd", erd().replace("TITLE   a sine", "GAIN    2.0"), "line 3: GAIN is not applied"),
    "ERD end": ("a.erd", erd().replace("END\n", ""), "no end: a line END"),
}  # fmt: skip


@pytest.mark.fault("A13")
@pytest.mark.parametrize("case", REFUSED)
def test_what_is_no_profile_is_refused_with_its_line_and_the_cure(tmp_path, case):
    name, text, sentence = REFUSED[case]
    (tmp_path / name).write_text(text)
    with pytest.raises(ExcitationError, match=sentence):
        ProfileRoad(tmp_path / name)
