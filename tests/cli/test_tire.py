"""`bench tire`: a table, a part of a scene that a run takes, JSON; bad input one sentence and exit
code 2.
"""

import csv
import json

import pytest
from click.testing import CliRunner
from tests.rigs.vehicle.tire.magic_formula.whole_set import tir_text
from tests.rigs.vehicle.tire.property_file.tir_file import write

from contact_sim_pkg.cli.main import main
from contact_sim_pkg.cli.tire import command
from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation
from contact_sim_pkg.scene.load import load_scene


def run(*arguments):
    return CliRunner().invoke(command, [str(a) for a in arguments], catch_exceptions=False)


def test_names_of_sections_and_units_are_printed_without_their_control_characters(tmp_path, capsys):
    file = write(tmp_path, VERTICAL_STIFFNESS=None)
    text = file.read_text()
    file.write_text(text + "[\x1b[2JEVIL\x07]\n1 2 3\n")
    assert main(["tire", str(file)]) == 1  # without a stiffness
    assert "tables skipped: \\x1b[2JEVIL\\x07" in capsys.readouterr().err
    file.write_text(text.replace("TIME = 'second'", "TIME = '\x1b[31m'"))
    assert main(["tire", str(file)]) == 2
    said = capsys.readouterr().err
    assert "\\x1b[31m" in said
    assert "\x1b" not in said


SCENE = """\
rig: tire
description: a test
duration: 1.0
travel: {speed: 10.0}
road: {kind: bump, position: 10.0, height: 0.03, length: 0.6}
"""


def test_the_part_of_a_scene_is_one_that_loads(tmp_path):
    shown = run(write(tmp_path, UNLOADED_RADIUS=0.32, LONGITUDINAL_STIFFNESS=1e5, PCX1=1.5, PCY1=1.3))
    assert shown.exit_code == 0
    part = shown.stdout[shown.stdout.index("# from tire.tir") :]
    (tmp_path / "own.yaml").write_text(SCENE + part + "    contact_field: {}\n")
    inflation = load_scene(tmp_path / "own.yaml").effect("tire", Inflation)
    assert (inflation.size, inflation.radius) == ("205/55 R16", 0.32)
    assert 0.6 < inflation.sidewall_angle < 1.57
    assert "read, nothing uses it yet" in shown.stdout
    assert "2 keys not read: PCX1, PCY1" in shown.stderr


def test_json_holds_keys_fit_and_effects(tmp_path):
    shown = run(write(tmp_path, PROPERTY_FILE_FORMAT="'MF-Tyre'", **{f"P{i}": i for i in range(20)}), "--json")
    found = json.loads(shown.stdout)
    assert set(found) == {"file", "format", "units", "keys", "not_read", "fit", "notes", "usable", "effects"}
    assert found["keys"][0] == {
        "key": "UNLOADED_RADIUS", "value": 0.316, "unit": "m", "line": 12,
        "becomes": "inflation.radius, unless it is that of the size",
    }  # fmt: skip
    assert found["format"] == "MFTYRE"
    assert found["not_read"]["count"] == 20
    assert len(found["not_read"]["first"]) == 12
    assert found["usable"] is True
    assert [row["quantity"] for row in found["fit"][:3]] == ["radius", "stiffness", "deflection"]
    assert all(abs(row["difference"]) <= 0.1 for row in found["fit"][:3])
    assert set(found["effects"]["tire"]) == {"inflation", "rigid_ring"}


def test_a_tire_that_cannot_be_met_ends_with_1_and_the_three_figures(tmp_path, capsys):
    """1 MN/m of a car tire: 4 kN deflect it by 4 mm."""
    assert main(["tire", str(write(tmp_path, VERTICAL_STIFFNESS=1e6))]) == 1
    said = capsys.readouterr()
    assert "effects:" not in said.out
    sentence = said.err.splitlines()[-1]
    assert "no scene, as the nearest tire is not within 6 % of the file" in sentence
    for figure in ("radius 0.316 m, fitted 0.31", "stiffness 1e+06 N/m, fitted ", "deflection 0.004 m, fitted "):
        assert figure in sentence
    assert sentence.count("(ratio ") == 3
    assert main(["tire", str(write(tmp_path, VERTICAL_STIFFNESS=None)), "--json"]) == 1
    said = capsys.readouterr()
    assert json.loads(said.out)["effects"] is None
    assert said.err.splitlines()[-1].endswith("add VERTICAL_STIFFNESS, best with FNOMIN")


@pytest.mark.fault("A15")
def test_a_bad_file_is_one_sentence_and_exit_code_2(tmp_path, capsys):
    for content, sentence in ((b"\0", "this is no text"), ("[UNITS]\nLENGTH = 'furlong'", "'furlong' is not read")):
        assert main(["tire", str(write(tmp_path, content)), "--json"]) == 2
        said = capsys.readouterr()
        assert said.out == ""
        assert sentence in said.err
        assert said.err.count("\n") == 1
    assert main(["tire", str(tmp_path / "none.tir")]) == 2


def refused(capsys, *arguments):
    assert main(["tire", "test", *map(str, arguments)]) == 2
    said = capsys.readouterr().err.splitlines()[-1]
    assert said.startswith(("bench: ", "Error: "))
    return said


def test_without_a_name_the_procedures_are_listed(capsys):
    assert main(["tire", "test", "--json"]) == 0
    names = [row["procedure"] for row in json.loads(capsys.readouterr().out)["rows"]]
    assert len(names) == len({*names}) == 12
    assert {"stiffness", "cornering", "braking", "combined", "relaxation", "drum", "cleat", "modes"} <= {*names}


def test_bad_input_of_a_test_is_one_sentence(tmp_path, capsys):
    out = ("--out", tmp_path / "out")
    for arguments, said in (
        (("cornring", "tire_cleat", *out), "'cornring' is no procedure"),
        (("cornring", "tire_cleat", *out), "did you mean cornering?"),
        (("modes", "seat_ride", *out), "has no tire"),
        (("modes", "tire_half_space", *out), "half-space"),
        (("modes", "tire_cleat"), "--out DIR"),
        (("modes",), "Missing argument 'SCENE'"),
        (("stiffness", "tire_cleat", *out, "--at", "load=60000"), "load 60000 N is beyond the law, which ends at"),
        (("stiffness", "tire_cleat", *out, "--at", "load=1,2"), "450 to 200000 N is allowed"),
        (
            ("stiffness", "tire_cleat", *out, "--at", "lod=1000"),
            "'lod' is no condition here; there are inflation, load",
        ),
        (("stiffness", "tire_cleat", *out, "--at", "load=heavy"), "numbers with commas"),
        (("modes", "tire_cleat", *out, "--beside", tmp_path / "none.tir"), "none.tir"),
        (("modes", "tire_cleat", *out, "--beside", write(tmp_path)), "the Magic Formula needs PCX1, PDX1"),
        (("modes", "no_such", *out), "there is no such scene"),
        (("modes", tmp_path / "none.tir", *out), "none.tir"),
        (("modes", tmp_path / "none.tir", *out, "--set", "duration=1"), "a property file has none"),
    ):
        assert said in refused(capsys, *arguments)
    assert not (tmp_path / "out").exists()


def test_a_test_writes_a_table_with_units_a_page_and_junit_with_a_file_beside(tmp_path, capsys):
    file, out = tmp_path / "whole.tir", tmp_path / "out"
    file.write_text(tir_text(QDRP1=1.0))
    options = ("--at", "load=3000", "--at", "inflation=200e3,220e3", "--beside", str(file), "--jobs", "1")
    called = ["tire", "test", "stiffness", "tire_cleat", "--out", str(out), *options]
    assert main([*called, "--junit", str(tmp_path / "tests.xml")]) == 0
    said = capsys.readouterr()
    assert "nothing uses" in said.err
    assert "QDRP1" in said.err
    header, *rows = csv.reader((out / "stiffness.csv").open())
    assert header[:5] == ["tire", "inflation [Pa]", "load [N]", "deflection [m]", "stiffness [N/m]"]
    assert [row[:3] for row in rows] == [
        ["bench", "200000", "3000"], ["bench", "220000", "3000"], ["whole.tir", "200000", "3000"],
        ["whole.tir", "220000", "3000"],
    ]  # fmt: skip
    assert 'tests="4"' in (tmp_path / "tests.xml").read_text()
    assert "whole.tir" in (out / "stiffness.html").read_text()
    # The same command goes on
    assert main([*called, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["procedures"][0]["again"], found["failed"]) == (4, [])


def test_a_file_in_place_of_a_scene_is_fitted_and_stands_beside_itself(tmp_path, capsys):
    file, out = tmp_path / "whole.tir", tmp_path / "out"
    file.write_text(tir_text(LFZO=1.0))
    options = ("--at", "load=4100", "--at", "inflation=217e3", "--jobs", "1")
    assert main(["tire", "test", "stiffness", str(file), "--out", str(out), *options]) == 0
    _header, own, of_file = csv.reader((out / "stiffness.csv").open())
    assert (own[0], of_file[0]) == ("bench", "whole.tir")
    assert float(own[4]) == pytest.approx(float(of_file[4]), rel=0.1)
    assert float(of_file[4]) == pytest.approx(207000.0, rel=1e-9)
