"""No command writes over what it reads, or over a file that it did not make, unasked."""

import click
import pytest
from tests.report import synthetic_bag as known

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.names import new_directory
from contact_sim_pkg.cli.main import COMMANDS, LABORATORY, bench, main

IMPACTS = "m,R,V0,tau,k\n0.02,0.01,1,0.001,0.5\n0.02,0.01,1,0.001,0.51\n"
MAT = "ROWS 1\nCOLS 2\nROW_SPACING 10 mm\nCOL_SPACING 10 mm\nUNITS kPa\nFrame 1\n1,2\n"
OUTPUTS = {  # command, its parameter -> arguments that name FILE as an output
    ("material", "table"): ["IMPACTS", "--csv", "FILE"],
    ("material", "plot"): ["IMPACTS", "--plot", "FILE"],
    ("identify", "plot"): ["BAG", "--box", "1", "1", "1", "--plot", "FILE"],
    ("compare", "plot"): ["MAT", "MAT", "--plot", "FILE"],
    ("accuracy", "plot"): ["seat_ride", "--plot", "FILE"],
    ("effects", "write"): ["seat_ride", "--write", "FILE"],
    ("validation", "page"): ["--page", "FILE"],
    ("growth", "page"): ["--page", "FILE"],
    ("growth", "plot"): ["--plot", "FILE"],
    ("paper", "output"): ["contact-area", "--figure", "5", "--output", "FILE"],
    ("report", "out"): ["BAG", "--out", "FILE"],
    ("export", "out"): ["BAG", "--csv", "--out", "FILE"],
    ("import", "out"): ["RIDE", "--rate", "100", "--out", "FILE"],
    ("run", "out"): ["seat_ride", "--offline", "--out", "FILE"],
    ("sweep", "out"): ["seat_ride", "--vary", "seed=1,2", "--out", "FILE"],
    ("plan", "out"): ["tire_cleat_speeds", "--out", "FILE"],
    ("fit", "out"): ["seat_ride", "--to", "RIDE", "--metric", "seat.SEAT", "--free", "seed=1:2", "--out", "FILE"],
    ("plan", "junit_file"): ["tire_cleat_speeds", "--out", "plans", "--junit", "FILE"],
    ("recover", "target"): ["BAG", "FILE"],
    ("tire test", "out"): ["modes", "tire_cleat", "--out", "FILE"],
    ("tire test", "junit_file"): ["modes", "tire_cleat", "--out", "tested", "--junit", "FILE"],
}
INPUTS = {
    "beside",
    "impacts",
    "bag",
    "bags",
    "hull",
    "scene",
    "road",
    "vibration",
    "from_bag",
    "file",
    "folder",
    "tolerances",
}


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    return known.bare_bag(tmp_path_factory.mktemp("outputs") / "bag")


def call(bag, folder, arguments, file):
    (folder / "impacts.csv").write_text(IMPACTS)
    (folder / "ride.csv").write_text("z\n" + "9.8\n9.9\n" * 8)
    (folder / "mat.csv").write_text(MAT)
    known_names = {
        "FILE": file,
        "MAT": folder / "mat.csv",
        "RIDE": folder / "ride.csv",
        "BAG": bag.path.parent,
        "IMPACTS": folder / "impacts.csv",
    }
    return main([str(known_names.get(argument, argument)) for argument in arguments])


def commands_of(name, command):
    """A command, or those of a group by both names."""
    below = command.commands if isinstance(command, click.Group) else {}
    return [(name, command), *((f"{name} {each}", found) for each, found in below.items())]


def test_every_path_of_a_command_is_a_known_output_or_an_input():
    paths = {
        (name, parameter.name)
        for whole in (*COMMANDS, *LABORATORY)
        for name, command in commands_of(whole, bench.get_command(click.Context(bench), whole))
        for parameter in command.params
        if isinstance(parameter.type, click.Path)
    }
    assert {(name, parameter) for name, parameter in paths if parameter not in INPUTS} == set(OUTPUTS)


@pytest.mark.parametrize("output", OUTPUTS, ids=" ".join)
def test_a_file_of_somebody_else_stays_as_it_is(bag, tmp_path, capsys, output):
    theirs = tmp_path / "theirs.png"
    theirs.write_text("a week's work")
    assert call(bag, tmp_path, [*output[0].split(), *OUTPUTS[output]], theirs) == 2
    said = capsys.readouterr().err
    assert "theirs.png" in said
    assert "exists already" in said
    assert said.splitlines()[-1].startswith("bench: ")
    assert theirs.read_text() == "a week's work"


NAMES = {
    "line break": "a\nb.png",
    "escape": "a\x1b[2J.png",
    "component": "a" * 300 + ".png",
    "path": "b/" * 2100 + "c.png",
}


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("output", OUTPUTS, ids=" ".join)
def test_a_name_that_no_file_can_have_is_refused_before_anything_starts(bag, tmp_path, capsys, output, name):
    assert call(bag, tmp_path, [*output[0].split(), *OUTPUTS[output]], tmp_path / NAMES[name]) == 2
    printed, said = capsys.readouterr()
    assert printed == ""
    reason = "control character in its name; give another" if name in ("line break", "escape") else "give a shorter one"
    assert said.splitlines()[-1].startswith("bench: ")  # a note on the bag may stand in front
    assert said.endswith(f"{reason}{' name' if 'another' in reason else ''}\n")
    assert "\x1b" not in said
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["impacts.csv", "mat.csv", "ride.csv"]


def test_room_is_kept_for_the_file_in_the_directory_of_a_bag(tmp_path):
    with pytest.raises(BagError, match=r"has 256 bytes in one name, 255 are possible"):
        new_directory(tmp_path / ("é" * 124 + "a"), "")  # 249 bytes, and _0.mcap
    new_directory(tmp_path / ("é" * 124), "")


@pytest.mark.parametrize("name", ["impacts.csv", "impacts_groups.csv"])
def test_impacts_are_never_overwritten_even_on_request(bag, tmp_path, capsys, name):
    given = tmp_path / name
    given.write_text(IMPACTS)
    arguments = ["material", str(given), "--csv", str(tmp_path / "impacts.csv"), "--overwrite"]
    assert main(arguments) == 2
    assert "is read by this command" in capsys.readouterr().err
    assert given.read_text() == IMPACTS


def test_tables_and_pictures_are_overwritten_on_request(bag, tmp_path, capsys):
    for output, name in ((("material", "table"), "a.csv"), (("material", "plot"), "a.png")):
        file = tmp_path / name
        file.write_text("old")
        assert call(bag, tmp_path, [*output[0].split(), *OUTPUTS[output], "--overwrite"], file) == 0
        assert file.read_bytes() != b"old"
    capsys.readouterr()


def test_a_page_is_made_again_and_nothing_else_is(bag, tmp_path, capsys):
    page, notes = bag.path.parent / "report.html", tmp_path / "notes.html"
    for _ in range(2):
        assert main(["report", str(bag.path.parent)]) == 0
    made = page.read_bytes()
    page.write_bytes(b"old\n" + made)  # no page of ours: it begins otherwise
    assert main(["report", str(bag.path.parent)]) == 2
    assert "exists already" in capsys.readouterr().err
    assert main(["report", str(bag.path.parent), "--overwrite"]) == 0
    assert page.read_bytes() == made
    page.write_bytes(made.replace(b"</body>", b"old</body>"))
    assert main(["report", str(bag.path.parent)]) == 0
    assert page.read_bytes() == made
    notes.write_text("<!DOCTYPE html><title>notes on the Contact Bench report</title>")
    assert main(["report", str(bag.path.parent), "--out", str(notes)]) == 2
    assert main(["report", str(bag.path.parent), "--out", str(bag.path), "--overwrite"]) == 2
    assert "is read by this command" in capsys.readouterr().err
    assert main(["report", str(bag.path.parent), "--out", str(notes), "--overwrite"]) == 0
    assert main(["report", *[str(bag.path.parent)] * 2, "--out", str(notes)]) == 0  # bags without a scene


def test_a_full_disk_is_a_fault_and_no_refusal(monkeypatch, capsys):
    def full(_text="", **_options):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(click, "echo", full)
    assert main(["show", "seat_ride"]) == 1
    assert capsys.readouterr().err == "bench: No space left on device\n"
