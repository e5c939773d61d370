"""The bench as a library: the examples run, and a series has one row a sample, as the messages hold them."""

import ast
import json
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import matplotlib.pyplot
import numpy
import pytest
from tests.bench_process import ENVIRONMENT, LONGEST_COMMAND

import contact_sim_pkg
from contact_sim_pkg import compare, load_scene, open_bag, series
from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.cli.output import progress, working
from contact_sim_pkg.files import FileRefusedError

EXAMPLES = Path(__file__).parents[1] / "examples" / "library"


def run_example(name, folder):
    environment = {**ENVIRONMENT, "MPLBACKEND": "agg"}
    command = [sys.executable, EXAMPLES / name]
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, timeout=LONGEST_COMMAND, check=True
    )
    return done.stdout


def test_a_faster_wheel_is_pressed_harder_by_a_bump(tmp_path):
    forces = [float(each) for each in re.findall(r"(\d+) N at", run_example("force_over_a_bump.py", tmp_path))]
    assert len(forces) == 3
    assert forces == sorted(forces)


def test_a_controlled_floor_leaves_less_force_on_the_seat(tmp_path):
    """The loop leaves T / (1 + 0.3 T) of a transmissibility T: 0.77 of T = 1, where the seat goes along with the floor, and
    0.63 at the peak of 1.94.
    """
    text = run_example("controlled_floor.py", tmp_path)
    held, controlled = (float(each) for each in re.findall(r"seat ± +(\d+\.\d+) N", text))
    assert 0.6 * held < controlled < 0.85 * held


def test_the_pressure_of_a_sphere_is_that_of_hertz(tmp_path):
    """E* = 5 MPa, R = 50 mm, 3 N: a = 2.823 mm, delta = a^2/R = 0.15937 mm, p0 = 3 F/(2 pi a^2) = 179.7 kPa."""
    text = run_example("pressure_of_a_sphere.py", tmp_path)
    a = (3.0 * 3.0 * 0.05 / (4.0 * 5e6)) ** (1.0 / 3.0)
    approach, peak = 1e3 * a**2 / 0.05, 1e-3 * 3.0 * 3.0 / (2.0 * numpy.pi * a**2)
    found = [float(each) for each in re.findall(r"(\d+\.\d+) (?:mm|kPa)", text)]
    assert found[:2] == pytest.approx([approach] * 2, rel=2e-3)
    assert found[2:] == pytest.approx([peak] * 2, rel=2e-2)


def run_notebook(path):
    """Run the cells of a notebook one after the other; returns what each code cell shows, as Jupyter would."""
    names, shown = {}, []
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] != "code":
            continue
        assert (cell["outputs"], cell["execution_count"]) == ([], None)  # a notebook is kept without its outputs
        tree = ast.parse("".join(cell["source"]))
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, path.name, "exec"), names)
        shown.append(None if last is None else eval(compile(ast.Expression(last.value), path.name, "eval"), names))
    return names, shown


def test_the_notebook_runs_from_top_to_bottom(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    matplotlib.pyplot.switch_backend("agg")
    names, shown = run_notebook(EXAMPLES / "seat_and_tire.ipynb")
    assert re.search(r"tire \d+ N, seat \d+ N", capsys.readouterr().out)
    tables = [each for each in shown if each is not None and not isinstance(each, Path)]
    assert len(tables) == 4
    for each in tables:
        ElementTree.fromstring(f"<div>{each._repr_html_()}</div>")
    assert names["bag"].metrics()["tire.load"].value == pytest.approx(names["tire"]["normal"].mean(), rel=1e-2)
    assert (tmp_path / "seat_and_tire.png").stat().st_size > 10_000
    assert shown[-1] == Path("seat_and_tire.html")
    assert shown[-1].stat().st_size > 100_000


def test_a_series_has_one_row_a_sample(tmp_path):
    bag = contact_sim_pkg.run(load_scene("seat_ride", "duration=0.1"), tmp_path / "bag")
    force, columns = series(bag, "seat/force"), bag.columns("seat/force")
    assert len(force) == 100
    assert force.time == pytest.approx(numpy.arange(100) * 1e-3, abs=1e-9)
    assert force["normal"].tobytes() == columns["normal"].tobytes()
    assert force.units["normal"] == "N"
    with pytest.raises(KeyError, match="it has block, normal"):
        force["norma"]
    assert series(tmp_path / "bag", "bench/motion")["position.seat_frame_z"].shape == (100,)


def test_a_temporary_bag_goes_with_its_object():
    bag = contact_sim_pkg.run(load_scene("seat_ride", "duration=0.05"))
    path = bag.path
    assert open_bag(path).complete
    del bag
    assert not path.exists()


def test_what_is_public_is_there():
    import contact_sim_pkg.laws as laws
    import contact_sim_pkg.pressure as pressure
    import contact_sim_pkg.rigs as rigs

    page = (Path(__file__).parents[1] / "docs" / "library.md").read_text()
    for package, module in (("laws", laws), ("pressure", pressure), ("rigs", rigs)):
        row = next(line for line in page.splitlines() if line.startswith(f"| `contact_sim_pkg.{package}`"))
        for name in re.findall(r"`(\w+)`", row.split("|")[2]):
            assert callable(getattr(module, name)), name
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        getattr(pressure, "nothing")  # noqa: B009


@pytest.fixture(scope="module")
def two(tmp_path_factory):
    """Two runs of a seat over parts of one recording."""
    folder = tmp_path_factory.mktemp("two")
    return [
        contact_sim_pkg.run(load_scene("seat_ride", "duration=2", f"vibration.start={start}"), folder / name)
        for name, start in (("once", 1.0), ("later", 2.0))
    ]


def test_a_bag_says_its_metrics_as_the_command_does(two, capsys):
    found = two[0].metrics()
    main(["metrics", str(two[0].path.parent), "--json"])
    printed = {row["key"]: row for row in json.loads(capsys.readouterr().out)["metrics"]}
    assert found.keys() == [*printed]
    assert {each.key: each.value for each in found} == {key: row["value"] for key, row in printed.items()}
    main(["metrics", str(two[0].path.parent)])
    assert f"{found}\n" == capsys.readouterr().out
    with pytest.raises(KeyError, match=r"no 'seat.a_v'; nearest are seat.a_w"):
        found["seat.a_v"]


def test_a_bag_writes_the_page_of_the_command(two, tmp_path):
    page = two[0].report(tmp_path / "mine.html")
    main(["report", str(two[0].path), "--out", str(tmp_path / "theirs.html")])
    assert page.read_bytes() == (tmp_path / "theirs.html").read_bytes()
    assert two[0].report(str(page)) == page  # a page of the bench is made again
    (tmp_path / "notes.html").write_text("mine")
    with pytest.raises(FileRefusedError, match="exists already"):
        two[0].report(tmp_path / "notes.html")
    assert two[0].report(tmp_path / "notes.html", overwrite=True).stat().st_size > 10_000
    assert two[1].report() == two[1].path.parent / "report.html"


def test_two_bags_side_by_side(two):
    found = compare(*two)
    a, b = (bag.metrics()["seat.a_w"].value for bag in two)
    assert found["seat.a_w"].values == (a, b)
    assert a != b
    assert compare(*(bag.path.parent for bag in two)).keys() == found.keys()
    assert found[0].moved == max(each.moved for each in found)
    with pytest.raises(BagError, match="rig"):
        compare(two[0], contact_sim_pkg.run(load_scene("block_fall", "duration=0.1")))


def test_a_notebook_shows_tables(two):
    shown = [
        two[0].scene and load_scene("seat_ride"),
        two[0],
        series(two[0], "seat/force"),
        two[0].metrics(),
        compare(*two),
    ]
    texts = [each._repr_html_() for each in shown]
    for text in texts:
        ElementTree.fromstring(f"<div>{text}</div>")
    for text, part in zip(
        texts, ("rig seat", "<td>/seat/force</td>", "<td>normal</td><td>N</td>", "SEAT", "A: once"), strict=True
    ):
        assert part in text


def test_a_fault_of_a_value_is_in_words_of_python():
    with pytest.raises(contact_sim_pkg.SceneError, match="the value duration=-1: duration: ") as refused:
        load_scene("seat_ride", "duration=-1")
    assert "--set" not in str(refused.value)


def test_a_run_that_lasts_shows_what_it_does(capsys, monkeypatch):
    monkeypatch.delenv(working.SWITCH)
    monkeypatch.setattr(working, "PATIENCE", 0.0)
    monkeypatch.setattr(working, "IN_A_FILE", 0.0)
    monkeypatch.setattr(working, "LOOK", 0.001)
    monkeypatch.setattr(progress, "PLAIN_SECONDS", 0.0)
    contact_sim_pkg.run(load_scene("seat_ride", "duration=0.5"))
    assert re.search(r"0\.\d\d s simulated, [0-9.]+x real time", capsys.readouterr().err)
    contact_sim_pkg.run(load_scene("seat_ride", "duration=0.1"), progress=False)
    assert capsys.readouterr().err == ""
