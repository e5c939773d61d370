"""Files of road profiles, known by their names and first lines: tables of x and z, UMTRI ERD, RDF with a poly_line.

Sources: Sayers & Karamihas, ERD file format for storage and analysis of road profiles (UMTRI): the second line
states numbers of channels and samples, ... , kind of data (5: text), step; labels of 8 characters follow up to END.
RDF is a TeimOrbit file: sections in [], below them tables in (); `$` and `!` start comments.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.recorded_csv import LARGEST_FILE
from contact_sim_pkg.excitation.table_files import read_recording
from contact_sim_pkg.excitation.table_words import factor_of, is_number, si_unit
from contact_sim_pkg.files import open_regular_file, read_regular_file

__all__ = ["ProfilePoints", "is_opencrg", "read_points"]

Array = NDArray[numpy.float64]

HEAD = 1 << 16
"""[bytes] in which a file shows what it is."""
DISTANCES = ("x", "s", "distance", "station", "position", "chainage", "dist")
TIMES = ("time", "t", "timestamp", "zeit")
BARE = ("x", "z_left", "z_right")
"""Columns of a file without a header; of two, the second is the only track."""
_LEFT = re.compile(r"(?:^|[^a-z])(?:l|left|lwp|links)(?:$|[^a-z])|^(?:zl|lelev|lprof)", re.IGNORECASE)
_RIGHT = re.compile(r"(?:^|[^a-z])(?:r|right|rwp|rechts)(?:$|[^a-z])|^(?:zr|relev|rprof)", re.IGNORECASE)
_SUFFIX = re.compile(r"_(mm|cm|m|ft|in|km)$")
LABELS = 8  # characters of a keyword, and of a short name and a unit
ERD_TEXT = 5
SAID_BY_ERD = ("GAIN", "OFFSET")
"""Keywords that change numbers."""
WITHOUT_EFFECT = ("MDI_HEADER", "HEADER", "UNITS", "MODEL", "GRAPHICS")
"""Sections of an RDF file that are read, or change no height."""


class ProfilePoints(NamedTuple):
    """The points of a profile as its file has them, in [m]."""

    format: str
    x: Array  # [points] distance
    z: Array  # [points, tracks] height; of two tracks the left one first
    lines: NDArray[numpy.int64]  # of the points, from 1
    notes: tuple[str, ...]  # what was assumed, and what was not applied
    assumed: bool  # whether a unit was


def is_opencrg(path: Path) -> bool:
    """Whether a road file is an OpenCRG file, by its name or its sections; a file that is not there goes by its name."""
    if path.suffix.lower() == ".crg":
        return True
    head = _head(path)
    return re.search(rb"^\$(CT|ROAD_CRG|KD_DEFINITION)\b", head, re.IGNORECASE | re.MULTILINE) is not None


def read_points(path: Path, header_line: int | None = None) -> ProfilePoints:
    """The points of a file of any of the formats.

    Raises:
        ExcitationError: with the line, for what is malformed, unknown, missing or in another unit.
    """
    if is_opencrg(path):
        raise ExcitationError(f"{path}: this is an OpenCRG file; write road.kind: opencrg")
    lines = (line.strip() for line in _head(path).decode("latin-1").splitlines())
    begins = next((line for line in lines if line and line[0] not in "$!"), "")
    if begins.startswith("ERDFILE") or path.suffix.lower() == ".erd":
        return _read_erd(path)
    if re.fullmatch(r"\[\w+\]\s*([$!].*)?", begins) or path.suffix.lower() == ".rdf":
        return _read_rdf(path)
    return _read_table(path, header_line)


def _head(path: Path) -> bytes:
    try:
        with open_regular_file(path) as file:
            return bytes(file.read(HEAD))
    except OSError:
        return b""


def _text_lines(path: Path) -> list[str]:
    try:
        data = read_regular_file(path, LARGEST_FILE, "cut the road")
    except OSError as error:
        raise ExcitationError(f"{path}: cannot be read: {error.strerror or error}") from error
    return data.decode("utf-8-sig", errors="replace").splitlines()


def _read_table(path: Path, header_line: int | None) -> ProfilePoints:
    table = read_recording(path, header_line, section="road", bare=BARE)
    columns = {name: values for name, values in table.columns.items() if name not in table.texts}
    x, tracks = _columns_of(path, list(columns), table.units)
    # Units in brackets are read already; others may end a name.
    notes, assumed = list(table.notes), False
    found = {}
    for name in (x, *tracks):
        unit, suffix = table.units.get(name), _SUFFIX.search(name)
        if unit is not None and unit != "m":
            raise ExcitationError(
                f"{path}: column '{name}' is in {unit}; distance and height are lengths: m, mm, cm, ft, in"
            )
        factor = factor_of(suffix[1]) if unit is None and suffix else 1.0
        found[name] = columns[name] * (factor or 1.0)
        assumed = assumed or (unit is None and not suffix)
    if assumed:
        notes.append(
            "Distance and height are taken as metres, for no unit is stated; write it behind the names: x [m],z [mm]."
        )
    if x not in DISTANCES or (len(tracks) == 1 and tracks[0] != "z"):
        notes.append(f"Distance is column '{x}', height {' and '.join(map(repr, tracks))}.")
    left_out = [name for name in table.columns if name not in found]
    if left_out:
        notes.append(f"Columns that are not used: {', '.join(left_out)}.")
    z = numpy.stack([found[name] for name in tracks], axis=1)
    return ProfilePoints("table", found[x], z, table.lines, tuple(notes), assumed)


def _columns_of(path: Path, names: list[str], units: object) -> tuple[str, list[str]]:
    """Distance, and the height of one track, or of the left and the right one."""
    plain = {name: _SUFFIX.sub("", name) for name in names}
    x = next((name for name in names if plain[name] in DISTANCES), names[0] if names else "")
    rest = [name for name in names if name != x]
    height = [name for name in rest if plain[name] == "z"]
    left = [name for name in rest if _LEFT.search(plain[name])]
    right = [name for name in rest if _RIGHT.search(plain[name])]
    if plain.get(x) in TIMES:
        raise ExcitationError(
            f"{path}: column '{x}' is a time; a profile has a distance x, in m (speed is travel.speed)"
        )
    if len(height) == 1:
        return x, height
    if len(left) == len(right) == 1:
        return x, [left[0], right[0]]
    if len(rest) == 1:
        return x, rest
    raise ExcitationError(
        f"{path}: which columns are distance and height? The header names {', '.join(names)}; name them x and z, or x, z_left "
        "and z_right"
    )


def _read_erd(path: Path) -> ProfilePoints:
    lines = _text_lines(path)
    if not lines or not lines[0].startswith("ERDFILE"):
        raise ExcitationError(
            f"{path}, line 1: an ERD file begins with ERDFILEV2.00; give a table of x and z, or rename the file"
        )
    stated = [part.strip() for part in (lines[1] if len(lines) > 1 else "").split(",")]
    if len(stated) < 6 or not all(is_number(part) for part in stated[:6]):
        raise ExcitationError(
            f"{path}, line 2: '{', '.join(stated)[:60]}'; numbers of channels, samples, records, bytes, the kind of data and the "
            "step were expected"
        )
    channels, samples, kind, step = (float(stated[place]) for place in (0, 1, 4, 5))
    if kind != ERD_TEXT:
        raise ExcitationError(
            f"{path}, line 2: its numbers are binary (kind {kind:g}); export it as text (kind {ERD_TEXT})"
        )
    if not step > 0.0 or not 1 <= channels <= 1000 or channels % 1:
        raise ExcitationError(
            f"{path}, line 2: {channels:g} channels with a step of {step:g}; at least 1, and above 0, are read"
        )
    # Labels
    labels: dict[str, str] = {}
    end = next((number for number, line in enumerate(lines) if number > 1 and line.strip() == "END"), None)
    if end is None:
        raise ExcitationError(f"{path}: the header has no end: a line END was expected; the file is cut or no ERD file")
    for number, line in enumerate(lines[2:end], 3):
        word = line[:LABELS].strip().upper()
        if word in SAID_BY_ERD:
            raise ExcitationError(
                f"{path}, line {number}: {word} is not applied; export heights in their unit, without {word}"
            )
        labels[word] = line[LABELS:]
    width, notes, assumed = int(channels), [], False
    names, units = _cells(labels.get("SHORTNAM", ""), width), _cells(labels.get("UNITSNAM", ""), width)
    # Numbers, a sample a line
    points = [each for each in enumerate(lines[end + 1 :], end + 2) if each[1].strip()]
    values = numpy.array([_numbers(path, number, line, width) for number, line in points]).reshape(-1, width)
    if samples > 0 and samples != len(values):
        raise ExcitationError(
            f"{path}, line 2: it states {samples:g} samples, the file holds {len(values)}; the file is cut or joined"
        )
    chosen = _tracks_of(path, names, width)
    along = _unit(path, "XUNITS", labels.get("XUNITS", "").strip())
    across = [_unit(path, "UNITSNAM", units[place]) for place in chosen]
    if along is None or None in across:
        assumed = True
        notes.append("Distance and height are taken as metres where XUNITS and UNITSNAM state no unit.")
    if width > len(chosen):
        notes.append(f"Of {width} channels {' and '.join(names[place] for place in chosen)} are the tracks.")
    z = values[:, chosen] * [1.0 if factor is None else factor for factor in across]
    x: Array = numpy.arange(len(values), dtype=numpy.float64) * (step * (along or 1.0))
    return ProfilePoints("ERD", x, z, numpy.array([number for number, _ in points]), tuple(notes), assumed)


def _cells(text: str, count: int) -> list[str]:
    """The labels of so many channels, each of 8 characters."""
    return [text[LABELS * place : LABELS * (place + 1)].strip() for place in range(count)]


def _tracks_of(path: Path, names: list[str], width: int) -> list[int]:
    left = [place for place, name in enumerate(names) if _LEFT.search(name)]
    right = [place for place, name in enumerate(names) if _RIGHT.search(name)]
    if len(left) == len(right) == 1:
        return [left[0], right[0]]
    if width <= 2:
        return list(range(width))
    raise ExcitationError(
        f"{path}: which of its {width} channels ({', '.join(names)}) are the tracks? Export one, or name two LElev and RElev "
        "(SHORTNAM)"
    )


def _unit(path: Path, where: str, unit: str) -> float | None:
    """Factor of a unit of length; None where none is stated."""
    if not unit:
        return None
    factor = factor_of(unit)
    if factor is None or si_unit(unit) != "m":
        raise ExcitationError(f"{path}: {where} is '{unit}'; units of length are read: m, mm, cm, km, ft, in")
    return factor


def _numbers(path: Path, number: int, line: str, width: int) -> list[float]:
    fields = line.replace(",", " ").split()
    try:
        if len(fields) != width:
            raise ValueError(line)
        return [float(field) for field in fields]
    except ValueError:
        raise ExcitationError(
            f"{path}, line {number}: '{line.strip()[:60]}' is no point; {width} numbers with decimal points were expected"
        ) from None


def _read_rdf(path: Path) -> ProfilePoints:
    section = table = ""
    values: dict[str, tuple[str, int]] = {}
    points: list[tuple[int, str]] = []
    for number, key, value in _rdf_lines(path):
        if key == "[":
            section, table = value.upper(), ""
        elif key == "(":
            table = value.upper()
        elif key:
            values[f"{section}.{key.upper()}"] = value.strip("'\""), number
        elif table == "XZ_DATA":
            points.append((number, value))
        else:
            raise ExcitationError(
                f"{path}, line {number}: '{value[:60]}' is no KEY = VALUE and stands in no table (XZ_DATA)"
            )
    # Which road it is
    road, line = values.get("MODEL.ROAD_TYPE", values.get("MODEL.METHOD", ("", 1)))
    if road.lower() != "poly_line":
        raise ExcitationError(
            f"{path}, line {line}: its road is '{road}'; a poly_line with (XZ_DATA) is read, and others are scenes of the bench: "
            "road.kind: flat, step, bump, cleat, pothole, iso8608"
        )
    if not points:
        raise ExcitationError(
            f"{path}: the file has no points; a table (XZ_DATA) of x, z left and z right was expected"
        )
    unit = values.get("UNITS.LENGTH", ("", 0))[0]
    factor = _unit(path, "LENGTH", unit)
    notes = [] if factor is not None else ["Distance and height are taken as metres, for [UNITS] states no LENGTH."]
    ignored = [f"{key.partition('.')[2]} = {value} (line {at})" for key, (value, at) in values.items()
               if key.partition(".")[0] not in WITHOUT_EFFECT]  # fmt: skip
    if ignored:
        notes.append(f"Settings of the file that were not applied: {', '.join(ignored)}.")
    width = len(points[0][1].replace(",", " ").split())
    if width not in (2, 3):
        raise ExcitationError(
            f"{path}, line {points[0][0]}: '{points[0][1][:60]}'; x, z left and z right were expected"
        )
    found = numpy.array([_numbers(path, *point, width) for point in points]) * (factor or 1.0)
    lines = numpy.array([number for number, _ in points])
    return ProfilePoints("RDF", found[:, 0], found[:, 1:], lines, tuple(notes), factor is None)


def _rdf_lines(path: Path) -> Iterator[tuple[int, str, str]]:
    """Number, key and value of each line that says something: `[` and `(` open a section and a table, rows have no key."""
    for number, line in enumerate(_text_lines(path), 1):
        text = re.split(r"[$!]", line, maxsplit=1)[0].strip()
        if not text or text.startswith("{"):
            continue
        if text[0] in "[(":
            yield number, text[0], text[1:].rstrip("])").strip()
        elif "=" in text:
            key, _, value = text.partition("=")
            yield number, key.strip(), value.strip()
        else:
            yield number, "", text
