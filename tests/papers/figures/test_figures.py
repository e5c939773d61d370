"""Figures that need no long run: every number inside its tolerance; the whole set is `bench paper --all`."""

import json

import pytest

from contact_sim_lab.pages.paper_pages import row_of, write_pages
from contact_sim_lab.papers.contact_area import figures
from contact_sim_lab.papers.registry import figure_of, paper_of
from contact_sim_lab.papers.rolling_contact import figures_track as rolling
from contact_sim_lab.papers.tire_road import figures as tire_road
from contact_sim_lab.records.paper import Number
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.files import FileRefusedError
from contact_sim_pkg.rigs.impact.theory.bodies import Material

QUICK = [
    ("contact-area", "4"),
    ("contact-area", "5"),
    ("rolling-contact", "9"),
    ("rolling-contact", "3"),
    ("rolling-contact", "4"),
    ("rolling-contact", "10"),
    ("tire-road", "2"),
    ("tire-road", "3"),
    ("driver-seat", "6"),
    ("driver-seat", "7"),
    ("identifiability", "1"),
]


@pytest.mark.parametrize(("key", "number"), QUICK)
def test_a_figure_is_inside(key, number):
    figure = figure_of(paper_of(key), number)
    numbers = figure.compute({each.name: each.default for each in figure.parameters}).numbers
    assert {each.what for each in numbers if each.verdict == "OUTSIDE"} == set()
    assert any(each.verdict == "inside" for each in numbers)
    assert all(each.origin for each in numbers if each.expected is not None)


def _softer(monkeypatch):
    """The body of the product, 1 % softer than that of the reference."""
    monkeypatch.setattr(figures, "Material", lambda modulus, loss: Material(0.99 * modulus, loss))


def _stiffer_reference(monkeypatch):
    influence = tire_road.dense_influence
    monkeypatch.setattr(tire_road, "dense_influence", lambda *given: 1.01 * influence(*given))


def _more_rolling_friction(monkeypatch):
    roller = rolling.ROLLER
    monkeypatch.setattr(rolling, "ROLLER", roller._replace(rolling_friction=1.01 * roller.rolling_friction))


@pytest.mark.parametrize(
    ("key", "number", "fault", "said"),
    [
        ("contact-area", "4", _softer, "largest force"),
        ("tire-road", "4", _stiffer_reference, "load of the dense solution at the approach obtained"),
        ("rolling-contact", "3", _more_rolling_friction, "growth rate"),
    ],
)
def test_a_fault_of_one_per_cent_is_outside(key, number, fault, said, monkeypatch):
    fault(monkeypatch)
    figure = figure_of(paper_of(key), number)
    found = figure.compute({each.name: each.default for each in figure.parameters}).numbers
    assert said in {each.what for each in found if each.verdict == "OUTSIDE"}


def test_what_was_given_is_counted_apart():
    figure = figure_of(paper_of("rolling-contact"), "9")
    row = row_of(paper_of("rolling-contact"), figure, figure.compute({}).numbers, 0.0)
    assert (row["input"], row["inside"], row["outside"]) == (12, 4, 0)


def test_rounding_is_shown_as_such():
    shown = [Number("", "", 1.0 + each, 1.0, 1.0, "").shown_difference(2) for each in (0.0, 1e-14, -1e-13, 1e-11)]
    assert shown == ["0", "<1e-12", "<1e-12", "1e-11"]


def test_a_figure_follows_its_values():
    """Twice the speed: depth scales with V0^0.8, contact time with V0^-0.2."""
    figure = figure_of(paper_of("contact-area"), "4")
    values = {each.name: each.default for each in figure.parameters}
    one, two = (
        {each.what: each.obtained for each in figure.compute({**values, "speed": speed}).numbers}
        for speed in (1.0, 2.0)
    )
    assert two["depth x_m"] / one["depth x_m"] == pytest.approx(2.0**0.8, rel=1e-9)
    assert two["contact time"] / one["contact time"] == pytest.approx(2.0**-0.2, rel=1e-9)


def test_pages_are_made_again_and_nothing_else_is(tmp_path):
    paper = paper_of("contact-area")
    rows = write_pages([paper], tmp_path)
    assert {row["verdict"] for row in rows} == {"judged, inside", "shape only"}
    first = (tmp_path / "contact-area.md").read_bytes()
    assert write_pages([paper], tmp_path)
    assert (tmp_path / "contact-area.md").read_bytes() == first
    (tmp_path / "contact-area_4.png").write_bytes(b"a week's work")
    with pytest.raises(FileRefusedError, match="exists already"):
        write_pages([paper], tmp_path)


def test_the_command_draws_and_prints(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["paper", "contact-area", "--figure", "5", "--set", "speed=1", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["values"]["speed"] == 1.0
    assert {"quantity", "expected", "obtained", "difference", "verdict", "origin"} <= set(found["numbers"][0])
    assert (tmp_path / found["output"]).read_bytes().startswith(b"\x89PNG")
    assert main(["paper", "contact-area", "--equation", "115", "--set", "loss_tangent=0.5", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["results"]["time"] == pytest.approx(0.5 / 1750.0)
    assert main(["paper"]) == main(["paper", "tire-road"]) == 0


@pytest.mark.parametrize("as_json", [[], ["--json"]])
def test_a_number_outside_ends_with_status_1(tmp_path, capsys, monkeypatch, as_json):
    """Of one figure, and of all; the picture and the numbers are there."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(figures, "INSIDE", 1e-18)
    assert main(["paper", "contact-area", "--figure", "4", *as_json]) == 1
    assert "OUTSIDE" in capsys.readouterr().out
    assert (tmp_path / "contact-area_figure_4.png").exists()
    assert main(["paper", "contact-area", "--all", *as_json]) == 1
    assert "OUTSIDE" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["contact_area"], "did you mean 'contact-area'"),
        (["contact-area", "--figure", "1"], "'1': unknown"),
        (["contact-area", "--equation", "115", "--set", "loss=1"], "--set 'loss': unknown"),
        (["contact-area", "--equation", "115", "--set", "loss_tangent=-1"], "loss_tangent -1.0: "),
        (
            ["tire-road", "--equation", "5", "--set", "x=0,1", "--set", "y=0,0,0"],
            "x has 2, y has 3 values; give lists of the same length",
        ),
        (["contact-area", "--figure", "5", "--set", "speed=1e200"], "speed 1e+200 m/s"),
        (["contact-area", "--figure", "5", "--set", "speed=1e3"], "figure 5: depth over radius"),
        (["contact-area", "--figure", "4", "--equation", "5"], "do not go together"),
        (["--figure", "4"], "needs a PAPER"),
        (["contact-area", "--set", "a=1"], "--set needs"),
        (["contact-area", "--system", "nothing"], "'nothing': unknown"),
    ],
)
def test_what_is_wrong_is_refused(arguments, said, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["paper", *arguments]) == 2
    assert said in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
