"""`bench report`: one figure for print; each option on each kind of input acts, or is refused by name."""

import re
import xml.etree.ElementTree as ElementTree

import click
import pytest
from PIL import Image
from tests.report.metrics.test_of_bag import foreign_bag

from contact_sim_pkg.cli.main import bench, main

OPTIONS = {
    "--out": ["--out", "FILE"],
    "--format": ["--format", "png", "tire-load"],
    "--require": ["--require", "tire.load < 1 N"],
    "--check": ["--check"],
    "--skip-bad": ["--skip-bad"],
    "--across-versions": ["--across-versions"],
    "--overwrite": ["--overwrite"],
}
TAKEN = {
    "a bag": {"--out", "--format", "--require", "--skip-bad", "--overwrite"},
    "two bags": {"--out", "--require", "--skip-bad", "--across-versions", "--overwrite"},
    "a figure": {"--out", "--format", "--skip-bad", "--overwrite"},
    "a bag of others": {"--out", "--skip-bad", "--overwrite"},
}
"""Options by the kind of input; a bag of others has a page of its topics, without figures and metrics."""
REFUSED = {
    "--format": "--format|has no figure 'tire-load'; it has none",
    "--check": "--check|holds no scene",
    "--require": "--require|tire.load: the list has no such metric; it has none",
}


@pytest.fixture(scope="module")
def imu(tmp_path_factory):
    return foreign_bag(tmp_path_factory.mktemp("others") / "imu", "imu", [(0.0, 0.0, 9.81)] * 100)


def arguments(kind, bag, imu):
    one = str(bag.path)
    return {
        "a bag": [one], "two bags": [one, one], "a figure": [one, "--format", "png", "tire-load"],
        "a bag of others": [str(imu)],
    }[kind]  # fmt: skip


def test_every_option_is_in_the_table():
    known = {
        option for parameter in bench.get_command(click.Context(bench), "report").params for option in parameter.opts
    }
    assert {name for name in known if name.startswith("--")} == {*OPTIONS, "--output"}


@pytest.mark.parametrize("option", OPTIONS)
@pytest.mark.parametrize("kind", TAKEN)
def test_an_option_acts_or_is_refused_by_its_name(bare, imu, tmp_path, monkeypatch, capsys, kind, option):
    monkeypatch.chdir(tmp_path)
    place = tmp_path / ("a.png" if "figure" in kind or option == "--format" else "a.html")
    own = [str(place) if each == "FILE" else each for each in OPTIONS[option]]
    given = [*arguments(kind, bare, imu), *own, *([] if option == "--out" else ["--out", str(place)])]
    if option in TAKEN[kind]:
        assert main(["report", *given]) == 0
        assert place.stat().st_size > 4_000
    else:
        assert main(["report", *given]) == 2
        assert re.search(REFUSED.get(option, option), capsys.readouterr().err)
        assert not place.exists()


def test_a_figure_is_printed_at_300_dots_an_inch(bare, tmp_path, capsys):
    place = tmp_path / "load.png"
    assert main(["report", str(bare.path), "--format", "png", "tire-load", "--output", str(place)]) == 0
    assert capsys.readouterr().out == f"report: {place}\n"
    with Image.open(place) as image:
        assert image.info["dpi"] == pytest.approx((300.0, 300.0), abs=0.01)
        assert image.width == round(7.4 * 300)  # the width of a picture of the page [inch]
        assert image.getpixel((0, 0))[:3] == (255, 255, 255)
        assert len({image.getpixel((x, y)) for x in range(0, image.width, 7) for y in range(0, image.height, 7)}) > 10


def test_a_figure_as_svg_needs_no_font_and_stays_the_same(bare, tmp_path):
    places = [tmp_path / name for name in ("one.svg", "two.svg")]
    for place in places:
        assert main(["report", str(bare.path), "--format", "svg", "tire-loop", "--out", str(place)]) == 0
    root = ElementTree.parse(places[0]).getroot()
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert not [each for each in root.iter() if each.tag.endswith("}text")]
    assert "var(" not in places[0].read_text()
    assert places[0].read_bytes() == places[1].read_bytes()


def test_a_figure_lies_beside_its_bag_and_is_not_written_over(tmp_path, capsys):
    from tests.report import synthetic_bag

    bag = synthetic_bag.bare_bag(tmp_path / "bag")
    command = ["report", str(bag.path.parent), "--format", "png", "tire-load"]
    assert main(command) == 0
    assert (tmp_path / "bag" / "tire-load.png").exists()
    assert main(command) == 2
    assert "exists already" in capsys.readouterr().err
    assert main([*command, "--overwrite"]) == 0


def test_every_figure_of_the_page_can_be_named(car, tmp_path):
    """Those that an unknown name lists, each once, a contact by its name and not by its number."""
    from contact_sim_pkg.report.printed import figures_of
    from contact_sim_pkg.report.reading import read_recording
    from contact_sim_pkg.report.report import write_report

    found = figures_of(read_recording(car))
    page = write_report(car, tmp_path / "page.html").read_text()
    assert len(found) == page.count('<svg aria-hidden="true" focusable="false"')  # as `drawing.picture` writes it
    assert {"tire-map", "seat-load", "rolling-peaks", "ride-transmissibility", "bench-energy"} <= set(found)


@pytest.mark.parametrize(("name", "nearest"), [("tire-lod", "tire-load"), ("tire", ""), ("../tire-loop", "tire-loop")])
def test_an_unknown_figure_is_refused_with_the_nearest_and_all(bare, tmp_path, capsys, name, nearest):
    """`tire` is the beginning of several words: the first figure of that contact."""
    place = tmp_path / "a.png"
    status = main(["report", str(bare.path), "--format", "png", name, "--out", str(place)])
    if not nearest:
        assert status == 0
        return
    assert status == 2
    said = capsys.readouterr().err
    assert f"has no figure '{name}'; nearest is {nearest}; it has tire-load, tire-loop, rolling-peaks\n" in said
    assert not place.exists()


def test_a_figure_of_another_ending_is_refused(bare, tmp_path, capsys):
    assert main(["report", str(bare.path), "--format", "svg", "tire-load", "--out", str(tmp_path / "a.png")]) == 2
    assert "its name ends in .svg" in capsys.readouterr().err
