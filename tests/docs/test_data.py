"""Every row of `docs/data.md` runs on a file made here; a row that nothing is made for fails."""

import math
import re
import shlex
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as BagOfOthers
from scipy.io import savemat, wavfile
from tests.bag import foreign
from tests.excitation import crg_file
from tests.excitation.profile import test_road as roads
from tests.identify import foreign_bag, motions
from tests.report.sitting import grid, mat_file, run_bag
from tests.rigs.vehicle.tire.property_file import tir_file

from contact_sim_pkg.cli.main import main
from contact_sim_pkg.standard.imported_mats import import_mat

PAGE = Path(__file__).resolve().parents[2] / "docs" / "data.md"
HEADER = "| you have | command | you get | assumed |"
QUICK = ("--offline", "--no-record", "--duration", "0.02")
"""beside `bench run`"""
G, RATE = 9.80665, 200.0
TIME = np.arange(800) / RATE
X, Z = 0.4 * np.sin(4.0 * math.pi * TIME), 1.5 * np.sin(8.0 * math.pi * TIME) + G
MAT = grid(0.0127, 40, 40, 0.05, (0.01, -0.02))


class Made(NamedTuple):
    """What a row needs, in the current folder, and what shows that it did its work."""

    make: Callable[[Path], object]
    shows: str
    """in what the command prints"""
    code: int = 0
    library: str = ""
    """that the row says it needs; where it is absent that is what is printed"""


def table(path, names, *columns):
    rows = (",".join(f"{value:.6f}" for value in row) for row in zip(*columns, strict=True))
    path.write_text("\n".join([names, *rows]) + "\n")


def imu_bag(path, change=lambda a: (a.x, a.y, a.z)):
    """The recording of `tests.bag.foreign` with other axes or units."""
    rows = []
    for topic, time, data in foreign.ROWS:
        if topic == "/imu":
            message = foreign.STORE.deserialize_cdr(data, foreign.IMU)
            message.linear_acceleration.x, message.linear_acceleration.y, message.linear_acceleration.z = change(
                message.linear_acceleration
            )
            data = bytes(foreign.STORE.serialize_cdr(message, foreign.IMU))
        rows.append((topic, time, data))
    path.mkdir()
    (path / "0.mcap").write_bytes(foreign.mcap(rows))


def cut_bag(path):
    whole = foreign.mcap(foreign.ROWS, chunk_size=20_000)
    path.write_bytes(whole[: len(whole) // 2])


def cell_bag(path):
    """The force of a load cell, 700 N and a wave."""
    types, kind = foreign.STORE.types, "geometry_msgs/msg/WrenchStamped"
    vector = types["geometry_msgs/msg/Vector3"]
    with BagOfOthers(path, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        topic = writer.add_connection("/cell", kind, typestore=foreign.STORE)
        for k in range(400):
            header = types["std_msgs/msg/Header"](
                types["builtin_interfaces/msg/Time"](k // 100, k % 100 * 10**7), "cell"
            )
            force = vector(0.0, 0.0, 700.0 + 10.0 * math.sin(0.1 * k))
            wrench = types["geometry_msgs/msg/Wrench"](force, vector(0.0, 0.0, 0.0))
            writer.write(topic, k * 10**7, foreign.STORE.serialize_cdr(types[kind](header, wrench), kind))


def stones(path):
    heights = 0.01 * np.random.default_rng(2).standard_normal((80, 21))
    crg_file.write(
        path, "LRFI", table=heights.tolist(), rows=80, increment=0.25, phi=False, v=np.linspace(-0.5, 0.5, 21).tolist()
    )


def force(path):
    """A half sine of 0.060 N s within 1.8 ms: k = 0.5 of 0.02 kg at 2 m/s."""
    time = np.arange(-200, 600) * 1e-5
    table(path, "time [ms],force [N]", 1e3 * time, 52.36 * np.sin(np.pi * np.clip(time / 1.8e-3, 0.0, 1.0)))


def xsensor(path):
    rows = "\n".join(",".join(f"{value / 133.322:.2f}" for value in row) for row in MAT.pressure)
    path.write_text(f"FILE NAME:,drive\nROWS:,40\nCOLUMNS:,40\nFrame:,1\nTime:,10:00:00.000\n{rows}\n")


def mat_bag(path):
    import_mat(mat_file(path.with_suffix(".txt"), MAT), path)


def daq_file(path):
    if find_spec("asammdf"):
        import asammdf

        file = asammdf.MDF(version="4.10")
        file.append([asammdf.Signal(Z, TIME, "m/s^2", "z")])
        file.save(path)
    else:
        path.write_bytes(b"MDF")


def write_mat(path):
    savemat(path, {"time": TIME, "x": X, "z": Z})


MADE = {
    "bench run seat_ride --vibration ride.csv --set vibration.time_column=time": Made(
        lambda at: table(at / "ride.csv", "time [s],x,z", TIME, X, Z), "simulated 0.02 s"
    ),
    "bench run seat_ride --vibration bare.csv --rate 200": Made(lambda at: table(at / "bare.csv", "x,z", X, Z), "simulated 0.02 s"),
    "bench run seat_ride --vibration ride.mat --set vibration.time_column=time": Made(
        lambda at: write_mat(at / "ride.mat"), "simulated 0.02 s"
    ),
    "bench run seat_ride --vibration ride.mcap": Made(
        lambda at: foreign.chunked(at).rename(at / "ride.mcap"), "simulated 0.02 s"
    ),
    "bench import phone.csv --axes z=up,x=ahead --unit g --out phone": Made(
        lambda at: table(at / "phone.csv", "time,ahead,up,heart rate", TIME, X / G, Z / G, 70.0 + X), "phone: 801 messages"
    ),
    "bench import ride.mat --out bag": Made(lambda at: write_mat(at / "ride.mat"), "bag: 800 messages"),
    "bench import ride.wav --scale 50 --axes z=ch1 --out bag": Made(
        lambda at: wavfile.write(at / "ride.wav", 200, np.int16(Z / 50.0 * 32768)), "bag: 800 messages"
    ),
    "bench import ride.mf4 --out bag": Made(lambda at: daq_file(at / "ride.mf4"), "bag: 800 messages", library="asammdf"),
    "bench metrics imu": Made(lambda at: imu_bag(at / "imu"), "1.24 m/s²", code=1),
    "bench metrics lidar --unit g": Made(
        lambda at: imu_bag(at / "lidar", lambda a: (a.x / G, a.y / G, a.z / G)), "1.24 m/s²", code=1
    ),
    "bench metrics camera": Made(
        lambda at: imu_bag(at / "camera", lambda a: (a.x, -a.z, a.y)), "gravity lies on y, so y points down", code=1
    ),
    "bench metrics split": Made(foreign.split, "1.24 m/s²", code=1),
    "bench metrics ride.db3": Made(lambda at: foreign.sqlite_file(at).rename(at / "ride.db3"), "1.24 m/s²", code=1),
    "bench metrics ride.bag": Made(foreign.ros1, "1.24 m/s²", code=1),
    "bench recover cut.mcap saved": Made(
        lambda at: cut_bag(at / "cut.mcap"), "saved: ", code=3
    ),
    "bench metrics cell": Made(lambda at: cell_bag(at / "cell"), "force z, mean"),
    "bench identify thrown --box 0.1 0.2 0.3": Made(
        lambda at: foreign_bag.write_odometry(at / "thrown", motions.states_of(motions.planar())), "mass"
    ),
    "bench run tire_belgian_block --road road.crg": Made(lambda at: stones(at / "road.crg"), "simulated 0.02 s"),
    "bench run tire_belgian_block --road pairs.csv": Made(
        lambda at: (at / "pairs.csv").write_text(roads.table(["x,z"], roads.X, roads.Z)), "simulated 0.02 s"
    ),
    "bench run tire_belgian_block --road road.rdf": Made(
        lambda at: (at / "road.rdf").write_text(roads.rdf()), "simulated 0.02 s"
    ),
    "bench run tire_belgian_block --road road.erd": Made(
        lambda at: (at / "road.erd").write_text(roads.erd()), "simulated 0.02 s"
    ),
    "bench tire tire.tir": Made(tir_file.write, "size: 205/55 R16"),
    "bench import tekscan.csv --out mat": Made(lambda at: mat_file(at / "tekscan.csv", MAT), "mat: 1 messages"),
    "bench import xsensor.csv --unit mmHg --pitch 12.7 --out mat": Made(lambda at: xsensor(at / "xsensor.csv"), "mat: 1 messages"),
    "bench metrics mat --loaded 500": Made(lambda at: mat_bag(at / "mat"), "loaded above 500 Pa"),
    "bench compare tekscan.csv run --plot maps.png": Made(
        lambda at: (mat_file(at / "tekscan.csv", MAT), run_bag(at / "run")), "tekscan lies on B: run turned by 2.9°"
    ),
    "bench material impacts.csv": Made(
        lambda at: table(at / "impacts.csv", "m,R,V0,tau,k", *np.outer([0.02, 0.01, 1.0, 0.001, 0.5], [1.0, 1.001])), "tan_beta"
    ),
    "bench material force.csv --mass 0.02 --speed 2": Made(lambda at: force(at / "force.csv"), "0.5 "),
}  # fmt: skip
"""By the command of a row."""


def commands():
    """The second cell of each row of the page."""
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    rows = [line for line in lines[lines.index(HEADER) + 2 :] if line.startswith("|")]
    cells = [[cell.strip() for cell in re.split(r"(?<!\\)\|", row)[1:-1]] for row in rows]
    assert all(len(row) == HEADER.count("|") - 1 and all(row) for row in cells)
    return [cell[1].strip("`") for cell in cells]


def test_every_row_has_its_maker_and_every_maker_its_row():
    assert sorted(commands()) == sorted(MADE)


@pytest.mark.parametrize("command", MADE)
def test_a_row_does_what_it_says(command, tmp_path, monkeypatch, capfd):
    made = MADE[command]
    made.make(tmp_path)
    monkeypatch.chdir(tmp_path)
    arguments = shlex.split(command.removeprefix("bench "))
    absent = made.library and not find_spec(made.library)
    assert main([*arguments, *(QUICK if arguments[0] == "run" else ())]) == (2 if absent else made.code)
    printed, said = capfd.readouterr()
    assert (f"is read by {made.library}, which is not installed" if absent else made.shows) in printed + said
