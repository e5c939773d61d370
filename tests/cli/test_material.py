"""`bench material`: table, JSON, CSV, picture; bad input one sentence and exit code 2."""

import csv
import json

import numpy
import pytest
from click.testing import CliRunner

from contact_sim_pkg.cli.main import main
from contact_sim_pkg.cli.material import command
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.motion import solve_impact

SPHERE = Sphere(0.02, 0.01)


@pytest.fixture
def file(tmp_path):
    """Six temperatures, three speeds, ten repeats each, 1 % noise: E' falls and tan(beta) peaks over temperature."""
    random = numpy.random.default_rng(4)
    lines = ["m,R,V0,tau,k,T"]
    for temperature in range(270, 330, 10):
        for speed in (0.5, 1.0, 2.0):
            modulus = 8e6 * (1.0 + 3.0 / (1.0 + 10.0 ** ((temperature - 285) / 15 - 0.3 * numpy.log10(speed))))
            impact = solve_impact(SPHERE, Material(modulus, 0.2), speed)
            for _ in range(10):
                noise = 1.0 + 0.01 * random.standard_normal(3)
                values = (speed * noise[0], impact.duration * noise[1], impact.restitution * noise[2])
                lines.append(",".join(["0.02", "0.01", *(repr(float(v)) for v in values), str(temperature)]))
    path = tmp_path / "impacts.csv"
    path.write_text("\n".join(lines) + "\n")
    return path


def run(*arguments):
    return CliRunner().invoke(command, [str(a) for a in arguments], catch_exceptions=False)


def test_groups_impacts_and_their_intervals_come_out_in_json(file):
    found = json.loads(run(file, "--json").stdout)
    assert len(found["impacts"]) == 180
    assert len(found["groups"]) == 18
    assert found["master_curve"] is None
    group = found["groups"][0]
    assert group["impacts"] == 10
    assert group["E'_low"] < group["E'"] < group["E'_high"]
    assert group["tan_beta"] == pytest.approx(0.2, rel=0.1)
    assert {"line", "T", "V0", "tau", "k", "E'", "E''", "tan_beta", "note"} == set(found["impacts"][0])


def test_a_person_sees_a_table_and_the_law_of_the_master_curve(file):
    shown = run(file, "--shift", "wlf", "--glass-temperature", "223").stdout
    assert "reduced_speed" in shown
    assert "223" in shown
    found = json.loads(run(file, "--shift", "wlf", "--json").stdout)["master_curve"]
    assert found["found"] is True
    assert found["Tg"] > 100.0


def test_csv_and_picture_are_written(file, tmp_path):
    table, picture = tmp_path / "out.csv", tmp_path / "out.png"
    assert (
        run(file, "--csv", table, "--plot", picture, "--shift", "arrhenius", "--activation-energy", "9e4").exit_code
        == 0
    )
    with open(table, newline="") as stream:
        assert len(list(csv.DictReader(stream))) == 180
    with open(tmp_path / "out_groups.csv", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 18
    assert float(rows[0]["reduced_speed"]) > 0.0
    assert picture.read_bytes()[:4] == b"\x89PNG"
    run(file, "--plot", tmp_path / "plain.svg")
    assert (tmp_path / "plain.svg").stat().st_size > 1000


def test_a_parameter_without_its_law_is_refused(file, capsys):
    for arguments in (["--glass-temperature", "223"], ["--shift", "wlf", "--activation-energy", "9e4"]):
        assert main(["material", str(file), *arguments]) == 2
        assert "belongs to --shift" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["nowhere.csv"], "cannot be read"),
        (["FILE", "--form", "best"], "form 'best'"),
        (["FILE", "--end", "never"], "end rule 'never'"),
        (["FILE", "--shape", "big"], "shape factor 'big'"),
        (["FILE", "--shift", "vft"], "shift 'vft'"),
        (["FILE", "--confidence", "95"], "confidence 95"),
        (["FILE", "--shift", "wlf", "--glass-temperature", "400"], "pole"),
        (["FILE", "--plot", "out.nothing"], "is no name of a picture"),
        (["FILE", "--csv", "/nowhere/out.csv"], "cannot be written"),
        (["FILE", "--speed-ratio", "0.5"], "speed ratio 0.5"),
        (["FILE", "--temperature-span", "-1"], "temperature span -1"),
    ],
)
def test_bad_input_is_one_sentence_and_exit_code_2(file, capsys, arguments, sentence):
    status = main(["material", *(str(file) if a == "FILE" else a for a in arguments)])
    said = capsys.readouterr().err.strip()
    assert status == 2
    assert sentence in said
    assert "\n" not in said
