"""Reading a recorded signal from a text file: named columns, one sample a line."""

import os
import re
from array import array
from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.files import open_regular_file

LARGEST_FILE = 1 << 28  # [bytes]
TIME_NAMES = ("time", "t", "time_s")
STANDARD_GRAVITY = 9.80665  # [m/s^2] exact by definition
UNITS = {
    "m/s^2": 1.0, "m/s2": 1.0, "m/s²": 1.0, "m s^-2": 1.0, "g": STANDARD_GRAVITY, "mg": 1e-3 * STANDARD_GRAVITY, "s": 1.0,
}  # fmt: skip
"""Unit behind a column's name -> factor to SI."""
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
    columns: dict[str, NDArray[numpy.float64]]  # by lower-case name
    lines: NDArray[numpy.int64]  # number of the line of each sample, from 1
    separator: str
    with_unit: frozenset[str] = frozenset()  # columns whose unit the header names
    nominal_rate: float | None = None  # [Hz], as a comment of the file says

    def column(self, name: str, key: str = "") -> NDArray[numpy.float64]:
        """One column; ExcitationError where it is absent, with the `key` of a vibration that names
        it, or holds NaN or infinity (with the line).
        """
        if name not in self.columns:
            cure = f"; name the right one with --set vibration.{key}=NAME" if key else ""
            raise ExcitationError(
                f"{self.file}: there is no column '{name}'; the header names {', '.join(self.columns)}{cure}"
            )
        column = self.columns[name]
        wrong = numpy.flatnonzero(~numpy.isfinite(column))
        if wrong.size:
            raise ExcitationError(
                f"{self.file}, line {self.lines[wrong[0]]}: column '{name}' is {column[wrong[0]]}; a finite number "
                f"was expected ({wrong.size} such samples)"
            )
        return column

    def time(self, name: str | None) -> NDArray[numpy.float64] | None:
        """The time column by its name, or by a usual name where none is given; None where there is
        none.

        The result: [samples] [s].
        """
        if name is not None:
            return self.column(name.lower(), "time_column")
        found = [usual for usual in TIME_NAMES if usual in self.columns]
        return self.column(found[0]) if found else None


def read_table(path: Path) -> RecordedTable:
    """Read the file, a block of lines at a time: beside the numbers only one block is held.

    The first line that is neither empty nor a comment (#, %) names the columns, with the unit of an
    acceleration in brackets where it is known: m/s^2, g or mg, read as m/s^2; s for time. Columns
    are separated by semicolon, tab, comma or spaces, whichever of them the header holds, in this
    order. Where that is no comma, numbers may have decimal commas.

    Raises:
        ExcitationError: with the line, for no header, ragged lines and fields that are no numbers;
        a file above 256
            MiB.
    """
    blocks = _line_blocks(path)
    comments: list[str] = []
    head: list[tuple[int, str]] = []
    # Comments before the header.
    for head in blocks:
        comments += [line for _, line in head if line[0] in COMMENT]
        head = _without_comments(head)
        if head:
            break
    if not head:
        raise _too_short(path, 0)
    # Names and units.
    separator = next((mark for mark in SEPARATORS if mark in head[0][1]), None)
    names, factors = _names(path, *head[0], separator)
    columns = [array("d") for _ in names]
    numbers, decimal_mark = array("q"), ""
    # Numbers, a block of lines at a time.
    for numbered in chain([head[1:]], (_without_comments(block) for block in blocks)):
        decimal_mark = decimal_mark or _decimal_mark(numbered, separator)
        values = _parse(path, numbered, names, separator, decimal_mark == ",")
        for column, part in zip(columns, values.T, strict=True):
            column.frombytes(numpy.ascontiguousarray(part).tobytes())
        numbers.extend(number for number, _ in numbered)
    if len(numbers) < 2:
        raise _too_short(path, len(numbers))
    # Columns in SI units.
    named = {name: numpy.frombuffer(column) for name, column in zip(names, columns, strict=True)}
    for name, factor in factors.items():
        named[name] = named[name] if factor == 1.0 else named[name] * factor
    return RecordedTable(
        str(path), named, numpy.frombuffer(numbers, numpy.int64), SEPARATORS.get(separator or "", "space"),
        frozenset(factors), _nominal_rate(comments),
    )  # fmt: skip


def memory_needed(path: Path) -> int:
    """Memory in [bytes] that `read_table` and the treatment of its columns take, from the file's
    lines; 0 for no file.

    A row: its columns and line number, three axes, and one axis at a time through the filters.
    """
    rows = fields = 0
    try:
        for block in _line_blocks(path, text=False):
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


def _line_blocks(path: Path, *, text: bool = True) -> Iterator[Any]:
    """Whole lines, numbered and stripped, those that are empty left out; or as they are, in
    bytes.
    """
    number = 1
    rest = b""
    try:
        with open_regular_file(path) as file:
            size = os.fstat(file.fileno()).st_size
            if size > LARGEST_FILE:
                raise ExcitationError(
                    f"{path}: the file has {size} bytes, at most {LARGEST_FILE} are read; cut the recording"
                )
            # Whole lines of each block; the rest goes before the next.
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
                yield _numbered(path, whole, start, number) if text else whole
                start, number = start + len(whole), number + whole.count(b"\n")
            if rest:
                yield _numbered(path, rest, start, number) if text else rest
    except OSError as error:
        raise ExcitationError(f"{path}: cannot be read: {error.strerror or error}") from error


def _numbered(path: Path, block: bytes, start: int, first: int) -> list[tuple[int, str]]:
    try:
        text = block.decode("utf-8-sig" if start == 0 else "utf-8")
    except UnicodeDecodeError as error:
        raise ExcitationError(
            f"{path}, byte {start + error.start}: this is no text; a recording is a text file in UTF-8"
        ) from error
    lines = ((number, line.strip()) for number, line in enumerate(text.split("\n"), start=first))
    return [(number, line) for number, line in lines if line]


def _without_comments(numbered: list[tuple[int, str]]) -> list[tuple[int, str]]:
    return [each for each in numbered if each[1][0] not in COMMENT]


def _too_short(path: Path, samples: int) -> ExcitationError:
    return ExcitationError(
        f"{path}: the file has {samples} samples; a line of column names and at least two were expected"
    )


def _parse(path: Path, numbered: list[tuple[int, str]], names: list[str], separator: str | None, commas: bool) -> Array:
    """Numbers of a block, [lines, columns]; where numpy does not read it, the first bad line is
    looked for.
    """
    lines = [line for _, line in numbered]
    if not lines:
        return numpy.empty((0, len(names)))
    try:
        pointed = [_with_point(line, commas) for line in lines]
        values = numpy.loadtxt(pointed, delimiter=separator, comments=None, ndmin=2)
    except ValueError:
        values = numpy.empty((0, 0))
    if values.shape == (len(lines), len(names)):
        return values
    rows = []
    for number, line in numbered:
        fields = line.split(separator)
        if len(fields) != len(names):
            raise ExcitationError(
                f"{path}, line {number}: {len(fields)} fields, expected {len(names)} ({', '.join(names)}), separated "
                f"by {SEPARATORS.get(separator or '', 'space')}"
            )
        for name, field in zip(names, fields, strict=True):
            # Python reads 9_8 as 98; a file does not mean that
            if not _is_number(field, commas) or "_" in field:
                raise ExcitationError(
                    f"{path}, line {number}: '{field[:40]}' in column '{name}' is no number (a decimal point is "
                    "expected, or a comma throughout where commas separate no columns)"
                )
        rows.append([float(_with_point(field, commas)) for field in fields])
    return numpy.array(rows)


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


def _names(path: Path, number: int, line: str, separator: str | None) -> tuple[list[str], dict[str, float]]:
    """Names of the columns, and of those with a unit the factor to SI units."""
    names: list[str] = []
    factors: dict[str, float] = {}
    for field in line.split(separator):
        # Name and unit of a column.
        match = re.fullmatch(r'"?\s*([^\[("]*?)\s*(?:[\[(]([^\])]*)[\])])?\s*"?', field.strip())
        if match is None or not match.group(1) or _is_number(match.group(1)):
            raise ExcitationError(
                f"{path}, line {number}: '{field.strip()[:40]}' is no column name; the first line must name the "
                "columns, such as x y z"
            )
        unit = None if match.group(2) is None else match.group(2).strip()
        if unit is not None and unit not in UNITS:
            raise ExcitationError(
                f"{path}, line {number}: unit '{match.group(2)}' of column '{match.group(1)}' is not read; {', '.join(UNITS)} "
                "are"
            )
        names.append(match.group(1).lower())
        if unit is not None:
            factors[names[-1]] = UNITS[unit]
    # Each name once.
    for name in names:
        if names.count(name) > 1:
            raise ExcitationError(f"{path}, line {number}: column '{name}' is named twice")
    return names, factors


def _is_number(text: str, commas: bool = False) -> bool:
    try:
        float(_with_point(text, commas))
    except ValueError:
        return False
    return True
