"""Reading a tire property file: sections of `KEY = value` lines, tables, comments, and its units.

The format is TeimOrbit ASCII. `[NAME]` opens a section; `$` and `!` begin a comment outside of
quotes; lines without `=` are the rows of a table. Letters large and small are the same. Of the
comments an inflation is read, as `Infl. pressure (Pa) 200000` or `Pressure - 2.00 bar`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

from contact_sim_pkg.files import printable, read_regular_file
from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.keys import (
    ALIASES,
    DIMENSIONS,
    KEYS,
    NOMINAL,
    OPERATING,
    STRUCTURAL,
    UNITS,
)
from contact_sim_pkg.rigs.vehicle.tire.property_file.load_curve import LoadCurve

__all__ = ["PropertyFile", "Value", "read_property_file"]

LARGEST_FILE = 1 << 20  # [bytes]; such files have about ten thousand
SI = {"LENGTH": "meter", "FORCE": "newton", "MASS": "kg", "TIME": "second", "ANGLE": "radian"}
"""Unit of a quantity that [UNITS] leaves out."""
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eEdD][+-]?\d+)?")
QUOTED_OR_MARK = re.compile(r"""'[^']*'|"[^"]*"|[$!'"]""")
NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_.\-]*")
CURVE = "DEFLECTION_LOAD_CURVE"
FORMAT_KEYS = ("PROPERTY_FILE_FORMAT", "VENDER_TIRE_TYPE")
COMMENTED = re.compile(
    rf"pres[a-z]*\.?[ \t]{{0,40}}(?:[(\[](?P<unit>[a-z]+)[)\]][ \t]{{0,40}}[:=\-]?[ \t]{{0,40}}(?P<value>{NUMBER.pattern})"
    rf"|[:=\-][ \t]{{0,40}}(?P<first>{NUMBER.pattern})[ \t]{{0,40}}(?P<then>[a-z]+))", re.IGNORECASE,
)  # fmt: skip
"""An inflation in a comment: its unit in brackets before the number, or after it."""
LIMIT = re.compile("max|min|range|limit", re.IGNORECASE)
GUESSED = ("pascal", "kpa", "bar", "psi", "mpa")
USUAL_INFLATION = (5e4, 1.2e6)  # [Pa]; a number without a unit is taken where one unit alone puts it here


class Value(NamedTuple):
    """A number of the file."""

    value: float  # in SI
    line: int


class PropertyFile(NamedTuple):
    """The keys of `keys.KEYS` that a file gives, in SI units."""

    file: str
    units: dict[str, str]  # quantity -> unit, as used
    values: dict[str, Value]
    unread: tuple[str, ...]  # other keys, in the order of the file
    notes: tuple[str, ...]
    format: str = ""  # PROPERTY_FILE_FORMAT, its letters and figures in capitals
    curve: LoadCurve | None = None
    commented: Value | None = None  # inflation [Pa] in a comment
    further: Mapping[str, Value] = MappingProxyType({})
    """Numbers of the other keys, as written, without their units"""

    def get(self, key: str) -> float | None:
        """A number in SI, None where the file has none."""
        return self.values[key].value if key in self.values else None


def read_property_file(path: Path) -> PropertyFile:
    """Read `path`, at most 1 MiB, in UTF-8 or Latin-1.

    Of a key that stands there twice the last counts, and a note says so. A unit that is left out is
    that of SI, with a note. No value, and 0 for a quantity that has to be above 0, count as not
    given.

    Raises PropertyFileError, with file and line, for what is no such text, a unit that is unknown,
    a number that is none or out of range, a table of loads that does not rise, an inflation under a
    name that is not known, a file of a structural model. FileRefusedError: no regular file, or too
    large.
    """
    lines = _Lines(str(path))
    lines.read(_text(path))
    lines.refuse_structural()
    units, notes = lines.units()
    values = {}
    for key, (text, line) in lines.found.items():
        if not text:
            notes.append(f"{key} has no value and counts as not given")
            continue
        value = lines.number(key, text, line, units)
        if value == 0.0 and KEYS[key].zero_is_none:
            notes.append(f"{key} is 0 and counts as not given")
        else:
            values[key] = Value(value, line)
    if not values:
        raise PropertyFileError(f"{path}: none of the keys of a tire is there, such as UNLOADED_RADIUS; no .tir file?")
    lines.refuse_unknown_inflation(values)
    if lines.tables:
        notes.append(f"tables skipped: {', '.join(map(printable, lines.tables))}")
    return PropertyFile(
        str(path), units, values, tuple(lines.unread), (*lines.notes, *notes), _letters(lines.format[0]), lines.curve(units),
        lines.commented, lines.further(),
    )  # fmt: skip


def _text(path: Path) -> str:
    content = read_regular_file(path, LARGEST_FILE, "a tire property file has a few hundred lines")
    if b"\0" in content:
        raise PropertyFileError(
            f"{path}, byte {content.index(0)}: this is no text in UTF-8 or Latin-1, in which a .tir file is read"
        )
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")


def _word(text: str) -> str:
    """A quoted text without its quotes, in small letters."""
    return text.strip("'\"").strip().lower()


def _float(text: str) -> float:
    """A number that `NUMBER` matches; FORTRAN writes D for E."""
    return float(re.sub("[dD]", "e", text))


def _usual(pressure: float) -> bool:
    low, high = USUAL_INFLATION
    return low <= pressure <= high


def _letters(text: str) -> str:
    """Letters and figures alone, in capitals: `5.2.1` and `521`, `PAC-MC` and `pac_mc` are the same."""
    return re.sub("[^A-Z0-9]", "", text.upper())


class _Lines:
    """The lines of a file, sorted: keys that are read, units, other keys, tables."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.found: dict[str, tuple[str, int]] = {}
        self.named_units: dict[str, tuple[str, int]] = {}
        self.unread: dict[str, tuple[str, int]] = {}
        self.sections: dict[str, int] = {}
        self.tables: dict[str, None] = {}
        self.rows: list[tuple[str, int]] = []  # of the table of loads
        self.format, self.program = ("", 0), ("", 0)
        self.commented: Value | None = None
        self.notes: list[str] = []

    def fail(self, line: int, sentence: str) -> PropertyFileError:
        return PropertyFileError(f"{self.file}, line {line}: {sentence}")

    def read(self, text: str) -> None:
        section: str | None = None
        for number, whole in enumerate(re.split(r"\r\n|\r|\n", text), start=1):
            line = self._before_comment(number, whole).strip()
            if not line or section == "MDI_HEADER":
                self._comment(number, whole)
            if not line:
                continue
            if line.startswith("["):
                if not line.endswith("]"):
                    raise self.fail(number, f"{line[:40]!r} opens a section without ]")
                section = line[1:-1].strip().upper()
                self.sections.setdefault(section, number)
            elif section is None:
                raise self.fail(number, f"{line[:40]!r} stands before the first [SECTION]; no .tir file?")
            elif "=" in line and not line.startswith(("'", '"', "{", "(")):
                self._assign(section, number, line)
            elif section == CURVE:
                self.rows.append((line, number))
            elif section != "MDI_HEADER":
                self.tables[section] = None

    def _comment(self, number: int, whole: str) -> None:
        """Keep the first inflation that stands in a comment."""
        found = None if self.commented or LIMIT.search(whole) else COMMENTED.search(whole[:400])
        if found is None:
            return
        unit, value = (found["unit"], found["value"]) if found["unit"] else (found["then"], found["first"])
        pascal = UNITS["PRESSURE"].get(unit.lower())
        if pascal is not None and 0.0 < (pressure := pascal * _float(value)) < math.inf:
            self.commented = Value(pressure, number)

    def _before_comment(self, number: int, whole: str) -> str:
        for mark in QUOTED_OR_MARK.finditer(whole):
            if mark.group() in ("$", "!"):
                return whole[: mark.start()]
            if len(mark.group()) == 1:
                raise self.fail(number, f"a text begins and does not end: {whole[mark.start() :][:40]!r}")
        return whole

    def _assign(self, section: str, number: int, line: str) -> None:
        name, _, text = (part.strip() for part in line.partition("="))
        key = ALIASES.get(name.upper(), name.upper())
        if not NAME.fullmatch(name):
            raise self.fail(number, f"{name[:40]!r} is no name of a key; KEY = value is read")
        if section == "MDI_HEADER":
            if key == "FILE_TYPE" and _word(text) != "tir":
                raise self.fail(number, f"FILE_TYPE is {printable(text, 40)}; 'tir', a tire property file, is read")
            return
        if key in FORMAT_KEYS:
            self.format, self.program = (
                (_word(text), number) if key == FORMAT_KEYS[0] else self.format,
                (_word(text), number),
            )
            return
        known = self.named_units if section == "UNITS" else self.found
        if key not in (UNITS if section == "UNITS" else KEYS):
            self.unread[key] = text, number
            return
        if key in known and known[key][0] != text:
            self.notes.append(f"{key} stands in line {known[key][1]} and again in line {number}; the last counts")
        known[key] = (text, number)

    def further(self) -> dict[str, Value]:
        """Numbers of the keys that are not read."""
        return {key: Value(_float(text), line) for key, (text, line) in self.unread.items() if NUMBER.fullmatch(text)}

    def refuse_structural(self) -> None:
        """Raise for a file of a structural model."""
        for text, line in (self.format, self.program, *self.sections.items()):
            for letters, program in STRUCTURAL.items():
                if letters in _letters(text):
                    raise self.fail(
                        line,
                        f"{printable(text, 40)!r}: a file of {program}, which describes belt and tread as a structure that "
                        f"{program} alone solves, and states no stiffness at a nominal load; give a Magic Formula file of "
                        "the tire (PAC2002, MF-Tyre), or one with UNLOADED_RADIUS, WIDTH, RIM_RADIUS, INFLPRES, FNOMIN and "
                        "VERTICAL_STIFFNESS",
                    )

    def refuse_unknown_inflation(self, values: dict[str, Value]) -> None:
        """Raise where a number that is not read looks like the inflation, and none is read."""
        if any(word in values for word in (*OPERATING, *NOMINAL)):
            return
        for key, (text, line) in self.unread.items():
            if re.search("PRES(?!MIN|MAX|_MIN|_MAX)|INFL", key) and not LIMIT.search(key) and NUMBER.fullmatch(text):
                raise self.fail(
                    line, f"{key} {text[:40]} looks like an inflation under a name that is not read; call it INFLPRES"
                )

    def curve(self, units: dict[str, str]) -> LoadCurve | None:
        """The table of loads in SI."""
        length, force = (UNITS[quantity][units[quantity]] for quantity in ("LENGTH", "FORCE"))
        points: list[tuple[float, float]] = []
        turned = False
        for text, line in self.rows:
            if text.startswith(("{", "(")):
                turned = text.lower().lstrip("{( \t").startswith("f")
                continue
            words = text.replace(",", " ").split()
            if len(words) != 2 or not all(NUMBER.fullmatch(word) for word in words):
                raise self.fail(line, f"{text[:40]!r} is no row of [{CURVE}]; a deflection and a load were expected")
            first, then = (_float(word) for word in words)
            point = (length * then, force * first) if turned else (length * first, force * then)
            if not (math.isfinite(point[0]) and math.isfinite(point[1])):
                raise self.fail(line, f"{text[:40]!r} of [{CURVE}] is too large")
            if points and not (point[0] > points[-1][0] and point[1] >= points[-1][1]):
                raise self.fail(
                    line, f"[{CURVE}] goes from {points[-1][0]:g} m, {points[-1][1]:g} N to {point[0]:g} m, {point[1]:g} N; "
                    "deflection and load must rise from row to row"
                )  # fmt: skip
            points.append(point)
        if len(points) == 1:
            raise self.fail(self.rows[-1][1], f"[{CURVE}] has one point; two or more are needed")
        return LoadCurve(tuple(points), self.sections[CURVE]) if points else None

    def units(self) -> tuple[dict[str, str], list[str]]:
        """Unit of each quantity, and what was assumed."""
        units: dict[str, str] = {}
        for quantity, (text, line) in self.named_units.items():
            unit = _word(text)
            if unit not in UNITS[quantity]:
                raise self.fail(
                    line, f"{quantity} in {printable(text, 40)} is not read; {', '.join(UNITS[quantity])} are"
                )
            units[quantity] = unit
        missing = [quantity for quantity in SI if quantity not in units]
        notes = [f"[UNITS] names no {', '.join(missing)}; taken in SI"] if missing else []
        return {**SI, **units}, notes

    def number(self, key: str, text: str, line: int, units: dict[str, str]) -> float:
        """The number of a key in SI, refused out of its range."""
        if not NUMBER.fullmatch(text):
            raise self.fail(line, f"{key} is {text[:40]!r}; a number with a decimal point was expected")
        known = KEYS[key]
        given, factor, written = _float(text), 1.0, []
        for quantity, power in DIMENSIONS[known.unit]:
            if quantity == "PRESSURE" and quantity not in units:
                factor *= UNITS["FORCE"][units["FORCE"]] / UNITS["LENGTH"][units["LENGTH"]] ** 2
                written.append(f"{units['FORCE']} / {units['LENGTH']}^2, as [UNITS] names no PRESSURE")
            else:
                factor *= UNITS[quantity][units[quantity]] ** power
                written.append(units[quantity] + ("" if power == 1 else f"^{power}"))
        value = given * factor
        if value == 0.0 == given and known.zero_is_none:
            return 0.0
        if not (math.isfinite(value) and known.low <= value <= known.high):
            cure = ""
            if known.unit == "Pa":
                fitting = [name for name in GUESSED if _usual(given * UNITS["PRESSURE"][name])]
                if len(fitting) == 1 and "PRESSURE" not in units:
                    value = given * UNITS["PRESSURE"][fitting[0]]
                    self.notes.append(
                        f"{key} {given:g} (line {line}) is taken in {fitting[0]}, {value:g} Pa: no other unit makes it an "
                        "inflation, and [UNITS] names no PRESSURE"
                    )
                    return value
                written_units = " or ".join(f"PRESSURE = '{name}'" for name in fitting)
                cure = f"; {written_units} in [UNITS] would make it one" if fitting else ""
            unit = "" if known.unit == "1" else f" {known.unit}"
            read_as = f", read in {' '.join(written)}" if written else ""
            raise self.fail(
                line,
                f"{key} {given:g} is {value:.6g}{unit}{read_as}; {known.low:g} to {known.high:g}{unit} is allowed{cure}",
            )
        return value
