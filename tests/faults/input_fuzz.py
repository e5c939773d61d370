"""Inputs of other people, and what spoils them: a line gone or twice, a word garbled, bytes changed, the end cut off."""

from __future__ import annotations

import io
import random
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy
import scipy.io
from scipy.io import wavfile
from tests.bag import foreign
from tests.excitation.crg_file import header
from tests.excitation.profile import test_road

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.excitation.opencrg.road import OpenCrgRoad
from contact_sim_pkg.excitation.profile.road import ProfileRoad
from contact_sim_pkg.excitation.recorded import RecordedVibration
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import read_property_file
from contact_sim_pkg.standard.imported import ImportChoice, import_recording
from contact_sim_pkg.standard.imported_mats import import_mat

TIME = numpy.arange(400) / 200.0
Z = 9.80665 + 1.5 * numpy.sin(25.0 * TIME)
WORDS = ("", "nan", "-", "1e999", "=1+1", "\0", "é", "1,5", ";", "\t", "[m/s^2]", "9" * 400, "-1", "0", "#", "$", '"')


def tables() -> Iterator[bytes]:
    """Tables as loggers and spreadsheets write them."""
    rows = [f"{t:.4f},{0.1 * z:.5f},0.0,{z:.5f}" for t, z in zip(TIME, Z, strict=True)]
    yield "\n".join(["time,x,y,z", *rows]).encode()
    yield "\n".join(["# logger 7", "", "time,x,y,z", "s,g,g,g", *rows]).encode()
    german = [row.replace(",", ";").replace(".", ",") for row in rows]
    yield "\r\n".join(["Zeit [s];x [m/s²];y [m/s²];z [m/s²]", *german]).encode("cp1252")
    yield "\n".join(["time\tx\ty\tz", *(row.replace(",", "\t") for row in rows)]).encode("utf-16")
    stamped = [f"2026-03-01T10:30:{t:06.3f}Z,{z:.5f}" for t, z in zip(TIME, Z, strict=True)]
    yield "\n".join(["timestamp,z", *stamped]).encode()


def matlab() -> Iterator[bytes]:
    """A file of MATLAB 5."""
    stream = io.BytesIO()
    scipy.io.savemat(stream, {"time": TIME, "x": 0.1 * Z, "z": Z})
    yield stream.getvalue()


def sounds() -> Iterator[bytes]:
    """A recording as sound, in whole numbers and in floats."""
    for kind in (numpy.int16, numpy.float32):
        stream = io.BytesIO()
        wavfile.write(stream, 200, (1000.0 * (Z - 9.80665)).astype(kind))
        yield stream.getvalue()


def roads() -> Iterator[bytes]:
    """An OpenCRG road in text."""
    values = "\n".join("".join(f"{0.001 * (i + j):10.7f}" for j in range(4)) for i in range(5))
    yield (header("LRFI") + values + "\n").encode("latin-1")


def profiles() -> Iterator[bytes]:
    """Roads as pairs, in RDF and in ERD."""
    yield from (text.encode() for _, text in test_road.KINDS.values())


def mats() -> Iterator[bytes]:
    """A pressure map of Tekscan and one of XSENSOR."""
    yield MAT.encode()
    yield b"FILE NAME:,ride\nROWS:,2\nCOLUMNS:,3\nUNITS:,kPa\nFrame:,1\nTime:,10:00:00.000\n1,2,3\n4,5,6\n"


MAT = """\
DATA_TYPE MOVIE
ROWS 2
COLS 3
ROW_SPACING 10 mm
COL_SPACING 10 mm
SECONDS_PER_FRAME 0.01
UNITS kPa
START_FRAME 1
END_FRAME 2
ASCII_DATA @@
Frame 1
1,2,3
4,5,6

Frame 2
1,2,3
4,5,7
@@
"""


def tires() -> Iterator[bytes]:
    """A property file of a tire."""
    yield TIRE.encode()


TIRE = """\
[MDI_HEADER]
FILE_TYPE = 'tir'
FILE_VERSION = 3.0
[UNITS]
LENGTH = 'meter'
FORCE = 'newton'
ANGLE = 'radians'
MASS = 'kg'
TIME = 'second'
PRESSURE = 'pascal'
[MODEL]
PROPERTY_FILE_FORMAT = 'PAC2002'
[DIMENSION]
UNLOADED_RADIUS = 0.317
WIDTH = 0.205
ASPECT_RATIO = 0.55
RIM_RADIUS = 0.2032
RIM_WIDTH = 0.165
[OPERATING_CONDITIONS]
INFLPRES = 220000
NOMPRES = 220000
[VERTICAL]
FNOMIN = 4000
VERTICAL_STIFFNESS = 210000
VERTICAL_DAMPING = 500
"""


def bags() -> Iterator[bytes]:
    """Short bags of others."""
    rows = foreign.ROWS[:60]
    yield foreign.mcap(rows)
    yield foreign.mcap(rows, **foreign.BARE, **foreign.TERSE)


def _of_bag(path: Path, folder: Path) -> None:
    bag = open_bag(path, skip_bad=True)
    for message in bag.messages():
        bag.topics[message.topic]
    bag.columns("/imu", ("linear_acceleration.z",))


def _imported(path: Path, folder: Path) -> None:
    import_recording(path, folder / "bag", ImportChoice(scale=100.0, unit="m/s^2"))


KINDS: dict[str, tuple[str, Callable[[], Iterator[bytes]], Callable[[Path, Path], object]]] = {
    "table": (".csv", tables, _imported),
    "vibration": (
        ".csv",
        tables,
        lambda path, _: RecordedVibration(path, forward=None).acceleration(numpy.arange(50) / 100.0),
    ),
    "matlab": (".mat", matlab, _imported),
    "sound": (".wav", sounds, _imported),
    "road": (".crg", roads, lambda path, _: OpenCrgRoad(path)),
    "profile": (".csv", profiles, lambda path, _: ProfileRoad(path)),
    "mat": (".csv", mats, lambda path, folder: import_mat(path, folder / "bag", pitch=0.01)),
    "tire": (".tir", tires, lambda path, _: read_property_file(path)),
    "bag": (".mcap", bags, _of_bag),
}
"""Ending, valid contents and reader of each kind."""


def spoilt(content: bytes, draw: random.Random) -> bytes:
    """The content with one to four of the changes."""
    for _ in range(draw.randint(1, 4)):
        content = draw.choice((_bytes, _cut, _line_gone, _line_twice, _word, _word))(content, draw)
    return content


def _bytes(content: bytes, draw: random.Random) -> bytes:
    changed = bytearray(content)
    for _ in range(draw.choice((1, 3, 20))):
        if changed:
            changed[draw.randrange(len(changed) if draw.random() < 0.5 else min(len(changed), 400))] = draw.randrange(
                256
            )
    return bytes(changed)


def _cut(content: bytes, draw: random.Random) -> bytes:
    return content[: draw.randrange(len(content) + 1)]


def _line_gone(content: bytes, draw: random.Random) -> bytes:
    lines = content.split(b"\n")
    del lines[draw.randrange(min(len(lines), 12 if draw.random() < 0.5 else len(lines)))]
    return b"\n".join(lines)


def _line_twice(content: bytes, draw: random.Random) -> bytes:
    lines = content.split(b"\n")
    at = draw.randrange(len(lines))
    return b"\n".join([*lines[:at], lines[at], *lines[draw.randrange(len(lines)) :]])


def _word(content: bytes, draw: random.Random) -> bytes:
    at = draw.randrange(len(content) + 1) if draw.random() < 0.5 else draw.randrange(min(len(content), 400) + 1)
    return content[:at] + draw.choice(WORDS).encode() + content[at + draw.randrange(8) :]
