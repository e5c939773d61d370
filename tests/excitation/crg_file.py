"""OpenCRG files for the tests: written and read by code that shares nothing with the reader under test."""

import math
import struct
from pathlib import Path

import numpy

REAL_DATA = Path(__file__).resolve().parents[3] / "shared" / "data"


def header(form="KRBI", road=None, channels=None, extra=(), rows=5, increment=0.5, v=(-0.4, 0.0, 0.2), phi=True):
    """Text of a header for `rows` cross sections at explicit v; `road` changes or removes (None) entries."""
    entries = {
        "REFERENCE_LINE_START_U": 10.0,
        "REFERENCE_LINE_END_U": 10.0 + (rows - 1) * increment,
        "REFERENCE_LINE_INCREMENT": increment,
        "LONG_SECTION_V_RIGHT": v[0],
        "LONG_SECTION_V_LEFT": v[-1],
        **(road or {}),
    }
    if channels is None:
        channels = ["reference line phi,rad"] * phi + [f"long section at v = {position:.3f},m" for position in v]
    return "\n".join(
        [
            "$CT                     ! comment text",
            "Testfläche, K\xf6ln",
            "$!*****",
            "$ROAD_CRG",
            "* a comment line",
            *(f"{key} = {value!r}   ! inline" for key, value in entries.items() if value is not None),
            "$",
            *extra,
            "$KD_Definition",
            f"#:{form}",
            *(f"D:{channel}" for channel in channels),
            "$",
            "$$$$" + "$" * 60,
            "",
        ]
    )


def payload(form, table):
    """The numbers of `table` (rows of floats) in one of the four formats."""
    if form in ("KRBI", "KDBI"):
        code = "f" if form == "KRBI" else "d"
        data = b"".join(struct.pack(f">{code}", value) for row in table for value in row)
        missing = struct.pack(f">{code}", math.nan)
        return data + missing * (-len(data) % 80 // len(missing))
    width = 10 if form == "LRFI" else 20
    lines = []
    for row in table:
        fields = [("*" * 9).rjust(width) if math.isnan(value) else f"{value:{width}.{width - 5}f}" for value in row]
        per_line = 80 // width
        lines += ["".join(fields[i : i + per_line]) for i in range(0, len(fields), per_line)]
    return ("\n".join(lines) + "\n").encode("latin-1")


def write(path, form="KRBI", table=None, text=None, **options):
    """Write a file and return its path."""
    text = header(form, **options) if text is None else text
    path.write_bytes(text.encode("latin-1") + payload(form, table))
    return path


def table(rows=5, sections=3, phi=True, seed=0):
    """Numbers that every format holds exactly: multiples of 1/1024 around 2 m."""
    generator = numpy.random.default_rng(seed)
    heights = 2.0 + generator.integers(-50, 50, (rows, sections)) / 1024.0
    heading = numpy.arange(rows) / 1024.0
    heading[0] = math.nan
    return (numpy.column_stack((heading, heights)) if phi else heights).tolist()


def slow_read(path):
    """A slow reader of well-formed KRBI files with numbered long sections: u0, du, v list, heights as nested lists."""
    data = Path(path).read_bytes()
    end = data.index(b"\n$$$$")
    start = data.index(b"\n", end + 1) + 1
    values = {}
    sections = 0
    for line in data[:end].decode("latin-1").splitlines():
        if line.startswith("D:long section"):
            sections += 1
        elif "=" in line and line[0] not in "$*%":
            key, _, number = line.partition("=")
            values[key.strip().lower()] = number.strip()
    u0, u1, du = (float(values[f"reference_line_{name}"]) for name in ("start_u", "end_u", "increment"))
    v0, dv = float(values["long_section_v_right"]), float(values["long_section_v_increment"])
    rows = round((u1 - u0) / du) + 1
    numbers = [entry[0] for entry in struct.iter_unpack(">f", data[start : start + 4 * rows * (sections + 1)])]
    heights = [numbers[i * (sections + 1) + 1 : (i + 1) * (sections + 1)] for i in range(rows)]
    return u0, du, [v0 + j * dv for j in range(sections)], heights


def bilinear(du, v, heights, x, y):
    """Height at one place inside the grid, x from the grid's start, by the textbook formula."""
    i = min(int(x / du), len(heights) - 2)
    j = max(k for k in range(len(v) - 1) if v[k] <= y)
    s, t = x / du - i, (y - v[j]) / (v[j + 1] - v[j])
    low = heights[i][j] * (1 - t) + heights[i][j + 1] * t
    high = heights[i + 1][j] * (1 - t) + heights[i + 1][j + 1] * t
    return low * (1 - s) + high * s
