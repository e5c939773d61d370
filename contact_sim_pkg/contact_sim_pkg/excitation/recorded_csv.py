"""Reading a recorded signal from a text file as people have them: named columns, one sample a line."""

import codecs
import csv
import os
import re
from array import array
from collections.abc import Iterator, Mapping
from itertools import chain
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.table_words import (
    STANDARD_GRAVITY,
    UNITS,
    bare_name,
    factor_of,
    is_number,
    number,
    seconds_of_text,
    si_unit,
    split_unit,
)
from contact_sim_pkg.files import open_regular_file

__all__ = ["STANDARD_GRAVITY", "UNITS", "RecordedTable", "fields_of", "line_blocks", "memory_of_text", "read_table"]

LARGEST_FILE = 1 << 28  # [bytes]
TIME_NAMES = ("time", "t", "time_s", "time_ms", "time_us", "time_ns", "timestamp", "zeit", "runtime")
TIME_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
"""Unit of a time column -> [s]"""
EPOCHS = {"s": (5e8, 5e9), "ms": (5e11, 5e12), "us": (5e14, 5e15), "ns": (5e17, 5e18)}
"""Times since 1970 from 1985 to 2128 by their unit; a value shows which one it is."""
BLOCK = 1 << 20  # [bytes] of text that are read at a time
LONGEST_LINE = 1 << 22  # [bytes]
BYTES_PER_TREATED_ROW = 160
"""Three axes as used, and one through the filters: mirrored twice as long, its spectrum, gain,
product and inverse.
"""
COMMENT = "#%"
_RATE = re.compile(r"(?:sampl\w*|rate|\bfs\b)[^\d\n]{0,20}?(\d+(?:\.\d+)?)\s*(k)?hz", re.IGNORECASE)
Array = NDArray[numpy.float64]
SEPARATORS = {";": "semicolon", "\t": "tab", ",": "comma"}  # none of them in the header: spaces


class RecordedTable(NamedTuple):
    """The columns of a recording."""

    file: str
    columns: dict[str, NDArray[numpy.float64]]  # by lower-case name; NaN where a column holds texts
    lines: NDArray[numpy.int64]  # number of the line of each sample, from 1
    separator: str
    with_unit: frozenset[str] = frozenset()  # columns whose unit the header names
    nominal_rate: float | None = None  # [Hz], as a comment of the file says
    notes: tuple[str, ...] = ()  # what was assumed of the file, a sentence each
    texts: frozenset[str] = frozenset()  # columns of texts that are no times
    units: Mapping[str, str] = MappingProxyType({})  # SI units of the columns whose unit is known

    def column(self, name: str, key: str = "") -> NDArray[numpy.float64]:
        """One column by its name, as the file writes it or bare; ExcitationError where it is absent, with the `key` of a
        vibration that names it, or holds NaN or infinity (with the line).
        """
        name = bare_name(name)
        cure = f"; name the right one by vibration.{key}=NAME" if key else ""
        if name not in self.columns:
            raise ExcitationError(
                f"{self.file}: there is no column '{name}'; the header names {', '.join(self.columns)}{cure}"
            )
        column = self.columns[name]
        wrong = numpy.flatnonzero(~numpy.isfinite(column))
        if name in self.texts:
            raise ExcitationError(
                f"{self.file}: column '{name}' holds texts that are neither numbers nor times{cure or '; name another'}"
            )
        if wrong.size:
            raise ExcitationError(
                f"{self.file}, line {self.lines[wrong[0]]}: column '{name}' is {column[wrong[0]]}; a finite number "
                f"was expected ({wrong.size} such samples); fill the gap or cut the recording there"
            )
        return column

    def time(self, name: str | None, unit: str | None = None) -> tuple[NDArray[numpy.float64] | None, str]:
        """The time column by its name, or by a usual name where none is given; None where there is none.

        Args:
            name: of the column, or of two joined by `+`: a date and a time of day.
            unit: s, ms, us or ns; None: as the header says, times since 1970 by their size, else s.

        Returns:
            [samples] [s] from the first sample on where it counts from 1970, and what was assumed; empty without.
        """
        if name is None:
            found = next((usual for usual in TIME_NAMES if usual in self.columns and usual not in self.texts), None)
            if found is None:
                return None, ""
            name = found
        first, _, second = name.partition("+")
        column = self.column(first, "time_column")
        if second:
            column = column + self.column(second, "time_column")
        if bare_name(first) in self.with_unit:
            return column, ""
        if unit is None and len(column):
            for each, (low, high) in EPOCHS.items():
                if low < column.min() and column.max() < high:
                    return (column - column[0]) * TIME_UNITS[each], f"The column {first} counts {each} since 1970."
        return column * TIME_UNITS[unit or "s"], ""


def read_table(
    path: Path, header_line: int | None = None, *, section: str = "vibration", bare: tuple[str, ...] = ()
) -> RecordedTable:
    """Read the file, a block of lines at a time: beside the numbers only one block is held.

    The first line that is neither empty nor a comment (#, %), or the stated one, names the columns, with a unit
    in brackets or in a row below; values are taken to SI. Columns are separated by semicolon, tab, comma or spaces,
    whichever of them the header holds, in this order. Numbers may have decimal commas where those separate nothing,
    or in quotes. Dates and times of ISO 8601, and times of day, become seconds from the first one on. UTF-8,
    UTF-16, else Windows-1252, which is noted.

    Args:
        path: of the file.
        header_line: number of the line with the names, from 1.
        section: of a scene, whose key `header_line` a refusal names.
        bare: names of the columns of a file that begins with numbers; without them it is refused.

    Raises:
        ExcitationError: with the line, for no header, ragged lines and fields that are no numbers;
        a file above 256
            MiB.
    """
    notes: list[str] = []
    blocks = line_blocks(path, notes)
    comments: list[str] = []
    head: list[tuple[int, str]] = []
    # Comments, and words before a stated header
    for head in blocks:
        comments += [line for _, line in head if line[0] in COMMENT]
        head = _without_comments([each for each in head if each[0] >= (header_line or 0)])
        if head:
            break
    if not head:
        raise _too_short(path, 0)
    # Names and units
    separator = next((mark for mark in SEPARATORS if mark in head[0][1]), None)
    layout = _layout(path, head, separator, section, bare)
    columns = [array("d") for _ in layout.names]
    numbers = array("q")
    # Numbers, a block of lines at a time
    for numbered in chain([head[layout.rows :]], (_without_comments(block) for block in blocks)):
        numbered = [each for each in numbered if separator is None or each[1].strip(f"{separator} ")]
        for column, part in zip(columns, layout.parsed(path, numbered).T, strict=True):
            column.frombytes(numpy.ascontiguousarray(part).tobytes())
        numbers.extend(number for number, _ in numbered)
    if len(numbers) < 2:
        raise _too_short(path, len(numbers))
    # Columns in SI units
    named = {name: numpy.frombuffer(column) for name, column in zip(layout.names, columns, strict=True)}
    for name, factor in layout.factors.items():
        named[name] = named[name] if factor == 1.0 else named[name] * factor
    for name in layout.moments:
        named[name] = named[name] - named[name][0]
    return RecordedTable(
        str(path), named, numpy.frombuffer(numbers, numpy.int64), SEPARATORS.get(separator or "", "space"),
        frozenset(layout.factors) | layout.moments, _nominal_rate(comments), tuple(notes), layout.texts, layout.units,
    )  # fmt: skip


def memory_of_text(path: Path) -> int:
    """Memory in [bytes] that `read_table` and the treatment of its columns take, from the file's
    lines; 0 for no file.

    A row: its columns and line number, three axes, and one axis at a time through the filters.
    """
    rows = fields = 0
    try:
        for block in line_blocks(path, [], text=False):
            rows += block.count(b"\n") + 1
            if not fields:
                head = next(
                    (line for line in block.splitlines() if line.strip() and line.strip()[:1] not in b"#%"), b""
                )
                mark = next((mark for mark in SEPARATORS if mark.encode() in head), None)
                fields = len(head.split(None if mark is None else mark.encode()))
    except ExcitationError:
        return 0
    return rows * (8 * (fields + 1) + BYTES_PER_TREATED_ROW) + 4 * BLOCK


def line_blocks(path: Path, notes: list[str], *, text: bool = True) -> Iterator[Any]:
    """Whole lines, numbered and stripped, those that are empty left out; or as they are, in
    bytes. ``notes`` takes what was assumed of the encoding.
    """
    number = 1
    rest = b""
    try:
        with open_regular_file(path) as opened:
            size = os.fstat(opened.fileno()).st_size
            if size > LARGEST_FILE:
                raise ExcitationError(
                    f"{path}: the file has {size} bytes, at most {LARGEST_FILE} are read; cut the recording"
                )
            file: Any = opened
            if opened.read(2) in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE):
                file = codecs.EncodedFile(opened, "utf-8", "utf-16", errors="replace")
                notes.append("The file is read as UTF-16.")
            opened.seek(0)
            # Whole lines of each block; the rest goes before the next
            start = 0
            while block := file.read(BLOCK):
                content, newline, after = block.rpartition(b"\n")
                if not newline:
                    rest += after
                    if len(rest) > LONGEST_LINE:
                        raise ExcitationError(
                            f"{path}, line {number}: the line has more than {LONGEST_LINE} characters; a recording has a "
                            "line a sample"
                        )
                    continue
                whole, rest = rest + content + newline, after
                yield _numbered(path, whole, start, number, notes) if text else whole
                start, number = start + len(whole), number + whole.count(b"\n")
            if rest:
                yield _numbered(path, rest, start, number, notes) if text else rest
    except OSError as error:
        raise ExcitationError(f"{path}: cannot be read: {error.strerror or error}") from error


def _numbered(path: Path, block: bytes, start: int, first: int, notes: list[str]) -> list[tuple[int, str]]:
    try:
        text = block.decode("utf-8-sig" if start == 0 else "utf-8")
    except UnicodeDecodeError as error:
        try:
            if b"\0" in block:
                raise ValueError("it holds zero bytes")
            text = block.decode("cp1252")
        except ValueError:
            raise ExcitationError(
                f"{path}, byte {start + error.start}: this is no text; a recording is a text file in UTF-8, UTF-16 or Windows-1252"
            ) from error
        said = "The file is not UTF-8 and is read as Windows-1252."
        notes += [said] if said not in notes else []
    lines = ((number, line.strip()) for number, line in enumerate(text.split("\n"), start=first))
    return [(number, line) for number, line in lines if line]


def _without_comments(numbered: list[tuple[int, str]]) -> list[tuple[int, str]]:
    return [each for each in numbered if each[1][0] not in COMMENT]


def _too_short(path: Path, samples: int) -> ExcitationError:
    return ExcitationError(
        f"{path}: the file has {samples} samples; a line of column names and at least two were expected"
    )


class _Layout:
    """What the head of a file says of its columns."""

    def __init__(
        self, separator: str | None, names: list[str], factors: dict[str, float], rows: int, section: str
    ) -> None:
        """Columns with their names, those with a unit with its factor to SI; ``rows`` lines are no samples."""
        self.separator, self.names, self.factors, self.rows = separator, names, factors, rows
        self.section = section
        self.moments: frozenset[str] = frozenset()
        """columns of dates and times"""
        self.texts: frozenset[str] = frozenset()
        """columns of other texts"""
        self.units: dict[str, str] = {}
        self._decimal_mark = ""

    def look(self, fields: list[str]) -> None:
        """Take from the first sample which columns hold texts."""
        no_numbers = [
            name for name, field in zip(self.names, fields, strict=False) if field.strip() and not is_number(field)
        ]
        values = dict(zip(self.names, fields, strict=False))
        self.moments = frozenset(name for name in no_numbers if _is_moment(values[name]))
        self.texts = frozenset(name for name in no_numbers if re.match(r"[^\W\d]", values[name].strip()))

    def parsed(self, path: Path, numbered: list[tuple[int, str]]) -> Array:
        """Numbers of a block, [lines, columns]: by numpy, and where that does not read it, field by field."""
        lines = [line for _, line in numbered]
        if not lines:
            return numpy.empty((0, len(self.names)))
        self._decimal_mark = self._decimal_mark or _decimal_mark(numbered, self.separator)
        if not self.moments and not self.texts:
            try:
                pointed = [_with_point(line, self._decimal_mark == ",") for line in lines]
                values = numpy.loadtxt(pointed, delimiter=self.separator, comments=None, ndmin=2)
            except ValueError:
                values = numpy.empty((0, 0))
            if values.shape == (len(lines), len(self.names)):
                return values
        return numpy.array([self._row(path, *each) for each in numbered])

    def _row(self, path: Path, number_of_line: int, line: str) -> list[float]:
        fields = fields_of(line, self.separator)
        width = len(self.names)
        if len(fields) > width and not any(field.strip() for field in fields[width:]):
            fields = fields[:width]  # separators at the end of a line
        if len(fields) != width:
            cure = (
                ""
                if number_of_line > 3
                else f"; where words stand before the header, name its line ({self.section}.header_line)"
            )
            raise ExcitationError(
                f"{path}, line {number_of_line}: {len(fields)} fields, expected {width} ({', '.join(self.names)}), separated "
                f"by {SEPARATORS.get(self.separator or '', 'space')}{cure}"
            )
        return [self._value(path, number_of_line, name, field) for name, field in zip(self.names, fields, strict=True)]

    def _value(self, path: Path, number_of_line: int, name: str, field: str) -> float:
        if name in self.texts:
            return numpy.nan
        try:
            if name in self.moments:
                return seconds_of_text(field)
            # A comma is decimal where commas separate nothing, or in quotes
            if {".": ",", ",": "."}.get(self._decimal_mark, "_") in field:
                raise ValueError(field)
            return number(field) if field.strip() else numpy.nan
        except ValueError:
            expected = (
                "a date and time such as the first one is expected" if name in self.moments else
                "a decimal point is expected, or a comma throughout where commas separate no columns"
            )  # fmt: skip
            kind = "date and time" if name in self.moments else "number"
            raise ExcitationError(
                f"{path}, line {number_of_line}: '{field[:40]}' in column '{name}' is no {kind} ({expected})"
            ) from None


def fields_of(line: str, separator: str | None) -> list[str]:
    """The fields of a line, without the quotes round them."""
    if separator is None:
        return line.split()
    return next(csv.reader([line], delimiter=separator)) if '"' in line else line.split(separator)


def _is_moment(text: str) -> bool:
    try:
        seconds_of_text(text)
    except ValueError:
        return False
    return True


def _layout(
    path: Path, head: list[tuple[int, str]], separator: str | None, section: str, bare: tuple[str, ...]
) -> _Layout:
    """Names and units of the columns, from the header and a row of units below it."""
    (line, text), *below = head
    fields = fields_of(text, separator)
    while len(fields) > 1 and not fields[-1].strip():
        fields.pop()
    if len(fields) <= len(bare) and all(map(is_number, fields)):
        return _Layout(separator, list(bare[: len(fields)]), {}, 0, section)
    names: list[str] = []
    units: list[str | None] = []
    for field in fields:
        name, unit = split_unit(field)
        if not name or is_number(name) or re.search(r'[\[("]', name):
            raise ExcitationError(
                f"{path}, line {line}: '{field.strip()[:40]}' is no column name; the first line must name the "
                f"columns, such as x y z, or name its line ({section}.header_line)"
            )
        names.append(name.lower())
        units.append(unit)
    rows = 1
    if below and (row := _units_of(fields_of(below[0][1], separator), len(names))):
        units, rows = [own or each for own, each in zip(units, row, strict=True)], 2
    for name in names:
        if names.count(name) > 1:
            raise ExcitationError(
                f"{path}, line {line}: column '{name}' is named twice; give each column a name of its own"
            )
    factors, si_units = {}, {}
    for name, unit in zip(names, units, strict=True):
        if unit is None:
            continue
        factor = factor_of(unit)
        if factor is None:
            raise ExcitationError(
                f"{path}, line {line}: unit '{unit}' of column '{name}' is not read; {', '.join(filter(None, UNITS))} are; write "
                "one of these, or no unit"
            )
        factors[name], si_units[name] = factor, si_unit(unit)
    layout = _Layout(separator, names, factors, rows, section)
    layout.units = si_units
    if len(head) > rows:
        layout.look(fields_of(head[rows][1], separator))
    return layout


def _units_of(fields: list[str], columns: int) -> list[str] | None:
    """The units of a row that holds nothing else; None for a row of samples."""
    texts = [field.strip().strip('"').strip("[]() ") for field in fields[:columns]]
    if len(texts) < columns or any(is_number(text) and text != "1" for text in texts) or not any(texts):
        return None
    return (
        texts if all(factor_of(text) is not None for text in texts) and any(map(str.isalpha, "".join(texts))) else None
    )


def _decimal_mark(lines: list[tuple[int, str]], separator: str | None) -> str:
    """The decimal mark that lines of numbers show; empty where they show none. Beside points, commas
    are none: 1.234,5 may be meant in two ways.
    """
    shown = "" if separator == "," else ","
    return next((mark for mark in (".", shown) if mark and any(mark in line for _, line in lines)), "")


def _with_point(text: str, commas: bool) -> str:
    """The text with decimal points for its commas; ValueError where points stand beside them."""
    if commas and "." in text:
        raise ValueError(text)
    return text.replace(",", ".") if commas else text


def _nominal_rate(comments: list[str]) -> float | None:
    """Sampling rate in [Hz] that a comment of the file states; None where none does, or several
    differ.
    """
    found = {
        float(match.group(1)) * (1e3 if match.group(2) else 1.0) for line in comments for match in _RATE.finditer(line)
    }
    return found.pop() if len(found) == 1 else None
