"""Every row of `docs/data.md` runs in a copy of `examples/inputs`, and every file there has a row."""

import re
import shlex
import shutil
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import pytest
from tests.docs.sample_files import FOLDER, SAMPLES_OF
from tests.report.sitting import run_bag

from contact_sim_pkg.cli.main import main
from contact_sim_pkg.standard.imported_mats import import_mat

PAGE = Path(__file__).resolve().parents[2] / "docs" / "data.md"
HEADER = "| you have | command | you get | assumed |"
QUICK = ("--offline", "--no-record", "--duration", "0.02")
"""beside `bench run`"""
LIBRARIES = {".mf4": "asammdf", ".tdms": "nptdms", ".uff": "pyuff", "ride_73.mat": "h5py"}
"""By the end of a name: what reads it; where it is absent, that is what is printed."""


WEIGHTED = "x: a_w, Wd                0.886 m/s²"
"""1 m/s² at 2 Hz: the weighting of the standard there"""


class Shown(NamedTuple):
    """What shows that a row did its work."""

    text: str
    """in what the command prints"""
    code: int = 0
    make: Callable[[Path], object] = lambda _: None
    """makes what a row needs beside the files of `examples/inputs`"""


SHOWN = {
    "bench run seat_ride --vibration ride.csv --set vibration.time_column=time": Shown("simulated 0.02 s"),
    "bench run seat_ride --vibration floor_g.csv --set vibration.time_column=time": Shown("simulated 0.02 s"),
    "bench run seat_ride --vibration bare.csv --rate 200": Shown("simulated 0.02 s"),
    "bench run seat_ride --vibration ride.mat --set vibration.time_column=time": Shown("simulated 0.02 s"),
    "bench run seat_ride --vibration ride.mcap": Shown("simulated 0.02 s"),
    "bench import phone.csv --axes z=up,x=ahead --unit g --out phone": Shown("phone: 801 messages"),
    "bench import ride.mat --out bag": Shown("bag: 800 messages"),
    "bench import ride_73.mat --out bag": Shown("bag: 800 messages"),
    "bench import ride.wav --scale 50 --axes z=ch1 --out bag": Shown("bag: 800 messages"),
    "bench import ride.mf4 --out bag": Shown("bag: 800 messages"),
    "bench import ride.tdms --out bag": Shown("bag: 800 messages"),
    "bench import ride.uff --out bag": Shown("bag: 800 messages"),
    "bench metrics ride.mcap": Shown(WEIGHTED, code=1),
    "bench metrics lidar.mcap --unit g": Shown(WEIGHTED, code=1),
    "bench metrics camera.mcap": Shown("gravity lies on y, so y points down", code=1),
    "bench metrics split": Shown(WEIGHTED, code=1),
    "bench metrics ride.db3": Shown("300 samples at 100 Hz", code=1),
    "bench metrics ride.bag": Shown(WEIGHTED, code=1),
    "bench metrics ride.mcap --require limits.yaml": Shown("at most 2; yours", code=1),
    "bench compare run run --tolerances tolerances.yaml": Shown(
        "all 2 tolerances hold", make=lambda at: run_bag(at / "run")
    ),
    "bench recover cut.mcap saved": Shown("saved: 354 messages", code=3),
    "bench metrics cell.mcap": Shown("force z, mean"),
    "bench identify thrown.mcap --box 0.1 0.2 0.3": Shown("mass"),
    "bench identify thrown.mcap --hull corners.csv": Shown("mass"),
    "bench run tire_belgian_block --road road.crg": Shown("simulated 0.02 s"),
    "bench run tire_belgian_block --road pairs.csv": Shown("simulated 0.02 s"),
    "bench run tire_belgian_block --road road.rdf": Shown("simulated 0.02 s"),
    "bench run tire_belgian_block --road road.erd": Shown("simulated 0.02 s"),
    "bench tire tire.tir": Shown("size: 205/55 R16"),
    'bench tire tire.csv --size "205/55 R16"': Shown("stiffness, 6000 N, 180 kPa"),
    "bench import tekscan.csv --out mat": Shown("mat: 1 messages"),
    "bench import xsensor.csv --unit mmHg --pitch 12.7 --out mat": Shown("mat: 1 messages"),
    "bench metrics mat --loaded 500": Shown(
        "loaded above 500 Pa", make=lambda at: import_mat(at / "tekscan.csv", at / "mat")
    ),
    "bench compare tekscan.csv run --plot maps.png": Shown(
        "tekscan lies on B: run turned by 2.9°", make=lambda at: run_bag(at / "run")
    ),
    "bench material impacts.csv": Shown("tan_beta"),
    'bench run tire_flat_track --set "tire.programme={file: sweep.tdx}"': Shown("simulated 0.02 s"),
    'bench run seat_ride --set "effects.seat.cushion.curve={file: foam.csv, area: 0.01, thickness: 0.05}"': Shown(
        "simulated 0.02 s"
    ),
    "bench material force.csv --mass 0.02 --speed 2": Shown("0.5 "),
}
"""By the command of a row."""


def commands():
    """The second cell of each row of the page."""
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    rows = [line for line in lines[lines.index(HEADER) + 2 :] if line.startswith("|")]
    cells = [[cell.strip() for cell in re.split(r"(?<!\\)\|", row)[1:-1]] for row in rows]
    assert all(len(row) == HEADER.count("|") - 1 and all(row) for row in cells)
    return [cell[1].strip("`") for cell in cells]


def test_every_row_is_run():
    assert sorted(commands()) == sorted(SHOWN)


def test_every_sample_has_a_row():
    assert {path.name for path in FOLDER.iterdir()} == {*SAMPLES_OF}
    named = {word for command in commands() for word in re.split("[ ,}]+", command)}
    assert set(SAMPLES_OF) <= named


@pytest.mark.parametrize("name", SAMPLES_OF)
def test_a_sample_is_what_its_maker_makes(name, tmp_path):
    """Texts byte for byte; what other libraries write is not the same from one of their versions to the next."""
    try:
        SAMPLES_OF[name](tmp_path / name)
    except ImportError:
        pytest.skip("its library is absent")
    if name.endswith((".csv", ".crg", ".rdf", ".erd", ".tir", ".yaml")):
        assert (tmp_path / name).read_bytes() == (FOLDER / name).read_bytes()
    else:
        assert (tmp_path / name).exists()


@pytest.mark.parametrize("command", SHOWN)
def test_a_row_does_what_it_says(command, tmp_path, monkeypatch, capfd):
    folder = tmp_path / "inputs"
    shutil.copytree(FOLDER, folder)
    shown = SHOWN[command]
    shown.make(folder)
    monkeypatch.chdir(folder)
    arguments = shlex.split(command.removeprefix("bench "))
    library = next((each for end, each in LIBRARIES.items() if arguments[1].endswith(end) and not find_spec(each)), "")
    assert main([*arguments, *(QUICK if arguments[0] == "run" else ())]) == (2 if library else shown.code)
    printed, said = capfd.readouterr()
    assert (f"is read by {library}, which is not installed" if library else shown.text) in printed + said
