"""Reading a tire property file: sections of `KEY = value` lines, tables, comments, and its units.

The format is TeimOrbit ASCII. `[NAME]` opens a section; `$` and `!` begin a comment outside of
quotes; lines without `=` are the rows of a table. Letters large and small are the same.
"""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import NamedTuple

from contact_sim_pkg.files import printable, read_regular_file
from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.keys import DIMENSIONS, KEYS, UNITS

__all__ = ["PropertyFile", "Value", "read_property_file"]

LARGEST_FILE = 1 << 20  # [bytes]; such files have about ten thousand
SI = {"LENGTH": "meter", "FORCE": "newton", "MASS": "kg", "TIME": "second", "ANGLE": "radian"}
"""Unit of a quantity that [UNITS] leaves out."""
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eEdD][+-]?\d+)?")
QUOTED_OR_MARK = re.compile(r"""'[^']*'|"[^"]*"|[$!'"]""")
NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_.\-]*")


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

    def get(self, key: str) -> float | None:
        """A number in SI, None where the file has none."""
        return self.values[key].value if key in self.values else None


def read_property_file(path: Path) -> PropertyFile:
    """Read `path`, at most 1 MiB, in UTF-8 or Latin-1.

    Of a key that stands there twice the last counts, and a note says so. A unit that is left out is
    that of SI, with a note. No value, and 0 for a quantity that has to be above 0, count as not
    given.

    Raises PropertyFileError, with file and line, for what is no such text, a unit that is unknown,
    a number that is none or out of range. FileRefusedError: no regular file, or too large.
    """
    lines = _Lines(str(path))
    lines.read(_text(path))
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
    if lines.tables:
        notes.append(f"tables skipped: {', '.join(map(printable, lines.tables))}")
    return PropertyFile(str(path), units, values, tuple(lines.unread), (*lines.notes, *notes))


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


class _Lines:
    """The lines of a file, sorted: keys that are read, units, other keys, tables."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.found: dict[str, tuple[str, int]] = {}
        self.named_units: dict[str, tuple[str, int]] = {}
        self.unread: dict[str, None] = {}
        self.tables: dict[str, None] = {}
        self.notes: list[str] = []

    def fail(self, line: int, sentence: str) -> PropertyFileError:
        return PropertyFileError(f"{self.file}, line {line}: {sentence}")

    def read(self, text: str) -> None:
        section: str | None = None
        for number, whole in enumerate(re.split(r"\r\n|\r|\n", text), start=1):
            line = self._before_comment(number, whole).strip()
            if not line:
                continue
            if line.startswith("["):
                if not line.endswith("]"):
                    raise self.fail(number, f"{line[:40]!r} opens a section without ]")
                section = line[1:-1].strip().upper()
            elif section is None:
                raise self.fail(number, f"{line[:40]!r} stands before the first [SECTION]; no .tir file?")
            elif "=" in line and not line.startswith(("'", '"', "{", "(")):
                self._assign(section, number, line)
            elif section != "MDI_HEADER":
                self.tables[section] = None

    def _before_comment(self, number: int, whole: str) -> str:
        for mark in QUOTED_OR_MARK.finditer(whole):
            if mark.group() in ("$", "!"):
                return whole[: mark.start()]
            if len(mark.group()) == 1:
                raise self.fail(number, f"a text begins and does not end: {whole[mark.start() :][:40]!r}")
        return whole

    def _assign(self, section: str, number: int, line: str) -> None:
        name, _, text = (part.strip() for part in line.partition("="))
        key = name.upper()
        if not NAME.fullmatch(name):
            raise self.fail(number, f"{name[:40]!r} is no name of a key; KEY = value is read")
        if section == "MDI_HEADER":
            if key == "FILE_TYPE" and _word(text) != "tir":
                raise self.fail(number, f"FILE_TYPE is {printable(text, 40)}; 'tir', a tire property file, is read")
            return
        known = self.named_units if section == "UNITS" else self.found
        if key not in (UNITS if section == "UNITS" else KEYS):
            self.unread[key] = None
            return
        if key in known and known[key][0] != text:
            self.notes.append(f"{key} stands in line {known[key][1]} and again in line {number}; the last counts")
        known[key] = (text, number)

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
        given, factor, written = float(re.sub("[dD]", "e", text)), 1.0, []
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
            unit = "" if known.unit == "1" else f" {known.unit}"
            read_as = f", read in {' '.join(written)}" if written else ""
            raise self.fail(
                line, f"{key} {given:g} is {value:.6g}{unit}{read_as}; {known.low:g} to {known.high:g}{unit} is allowed"
            )
        return value
