"""Reading a recorded signal from a text file: named columns, one sample a line."""

import re
from pathlib import Path
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.files import read_regular_file

from .errors import ExcitationError

LARGEST_FILE = 1 << 28  # [bytes]
TIME_NAMES = ("time", "t", "time_s")
UNITS = ("m/s^2", "m/s2", "m/s²", "m s^-2", "s")
SEPARATORS = {";": "semicolon", "\t": "tab", ",": "comma"}  # none of them in the header: spaces


class Table(NamedTuple):
    """The columns of a recording."""

    file: str
    columns: dict[str, NDArray[numpy.float64]]  # by lower-case name
    lines: NDArray[numpy.int64]  # number of the line of each sample, from 1
    separator: str

    def column(self, name: str) -> NDArray[numpy.float64]:
        """One column; ExcitationError where it is absent or holds NaN or infinity (with the line)."""
        if name not in self.columns:
            raise ExcitationError(
                f"{self.file}: there is no column '{name}'; the header names {', '.join(self.columns)}"
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
        """The time column by its name, or by a usual name where none is given; None where there is none."""
        if name is not None:
            return self.column(name.lower())
        found = [usual for usual in TIME_NAMES if usual in self.columns]
        return self.column(found[0]) if found else None


def read_table(path: Path) -> Table:
    """Read the file.

    The first line that is neither empty nor a comment (#, %) names the columns; a unit in brackets after a name must be
    m/s^2 (s for time). Columns are separated by semicolon, tab, comma or spaces, whichever of them the header holds, in
    this order.

    Raises:
        ExcitationError: with the line, for no header, ragged lines and fields that are no numbers; a file above 256
            MiB.
    """
    lines = _read_lines(path)
    numbered = [(number, line) for number, line in enumerate(lines, start=1) if line and line[0] not in "#%"]
    if len(numbered) < 3:
        raise ExcitationError(
            f"{path}: the file has {max(len(numbered) - 1, 0)} samples; a line of column names and at least two were "
            "expected"
        )
    separator = next((mark for mark in SEPARATORS if mark in numbered[0][1]), None)
    names = _names(path, *numbered[0], separator)
    rows = []
    for number, line in numbered[1:]:
        fields = line.split(separator)
        if len(fields) != len(names):
            raise ExcitationError(
                f"{path}, line {number}: {len(fields)} fields, expected {len(names)} ({', '.join(names)}), separated "
                f"by {SEPARATORS.get(separator or '', 'space')}"
            )
        rows.append(fields)
    try:
        if any("_" in line for _, line in numbered[1:]):  # Python reads 9_8 as 98; a file does not mean that
            raise ValueError
        values = numpy.array(rows, dtype=numpy.float64)
    except ValueError:
        raise _bad_field(path, numbered[1:], rows, names) from None
    columns = {name: numpy.ascontiguousarray(values[:, index]) for index, name in enumerate(names)}
    numbers = numpy.array([number for number, _ in numbered[1:]])
    return Table(str(path), columns, numbers, SEPARATORS.get(separator or "", "space"))


def _read_lines(path: Path) -> list[str]:
    try:
        text = read_regular_file(path, LARGEST_FILE, "cut the recording").decode("utf-8-sig")
    except OSError as error:
        raise ExcitationError(f"{path}: cannot be read: {error.strerror or error}") from error
    except UnicodeDecodeError as error:
        raise ExcitationError(
            f"{path}, byte {error.start}: this is no text; a recording is a text file in UTF-8"
        ) from error
    return [line.strip() for line in text.split("\n")]


def _names(path: Path, number: int, line: str, separator: str | None) -> list[str]:
    names = []
    for field in line.split(separator):
        match = re.fullmatch(r'"?\s*([^\[("]*?)\s*(?:[\[(]([^\])]*)[\])])?\s*"?', field.strip())
        if match is None or not match.group(1) or _is_number(match.group(1)):
            raise ExcitationError(
                f"{path}, line {number}: '{field.strip()[:40]}' is no column name; the first line must name the "
                "columns, such as x y z"
            )
        if match.group(2) is not None and match.group(2).strip() not in UNITS:
            raise ExcitationError(
                f"{path}, line {number}: unit '{match.group(2)}' of column '{match.group(1)}' is not read; convert to "
                "m/s^2"
            )
        names.append(match.group(1).lower())
    for name in names:
        if names.count(name) > 1:
            raise ExcitationError(f"{path}, line {number}: column '{name}' is named twice")
    return names


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _bad_field(path: Path, numbered: list[tuple[int, str]], rows: list[list[str]], names: list[str]) -> ExcitationError:
    for (number, _), fields in zip(numbered, rows, strict=True):
        for name, field in zip(names, fields, strict=True):
            if not _is_number(field) or "_" in field:
                return ExcitationError(
                    f"{path}, line {number}: '{field[:40]}' in column '{name}' is no number (a decimal point is "
                    "expected)"
                )
    return ExcitationError(f"{path}: a field is no number")
