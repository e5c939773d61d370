"""Pressure mats in the text exports of their makers, Tekscan and XSENSOR: frames of pressures on rows and columns.

Both are lines of a key and its value, once or before each frame, and a line of numbers for each row of cells.
"""

from __future__ import annotations

import re
from math import inf, isfinite, isnan
from pathlib import Path
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.recorded_csv import fields_of, line_blocks
from contact_sim_pkg.excitation.table_words import factor_of, is_number, number, seconds_of_text, si_unit
from contact_sim_pkg.files import open_regular_file
from contact_sim_pkg.memory import refuse_above_limit

__all__ = ["PRESSURE_UNITS", "MatRecording", "is_mat", "read_mat"]

PRESSURE_UNITS = ("Pa", "kPa", "mmHg", "psi", "N/cm^2")
"""that an option may state"""
HEAD = 1 << 14
"""[bytes] of a file in which rows and columns stand"""
BYTES_OF_A_CELL = 20
"""as read, all together, and in [Pa]"""
MOST_CELLS = 1 << 20
KEYS = {
    "rows": ("rows",), "cols": ("cols", "columns"), "frame": ("frame",), "time": ("time",), "sensor": ("sensor",),
    "unit": ("units", "unit", "pressure units"), "period": ("seconds per frame",), "area": ("sensel area",),
    "row_pitch": ("row spacing", "row pitch", "sensel height"), "last": ("end frame",),
    "col_pitch": ("col spacing", "column spacing", "col pitch", "column pitch", "sensel width"),
    "pitch": ("sensor pitch", "sensel pitch", "pitch", "sensor spacing", "spacing"), "saturation": ("saturation pressure",),
}  # fmt: skip
"""What is taken of a file, by the makers' words."""
MEANT = {word: key for key, words in KEYS.items() for word in words}
OF_A_MAT = ("frame", "unit", "row_pitch", "pitch")
"""beside rows and columns"""
NOT_OF_THE_SENSOR = ("B", "b")
"""of a cell: Tekscan"""
RAW = ("raw", "counts", "raw counts", "count", "digital", "adc", "")

Array = NDArray[numpy.float64]


class MatRecording(NamedTuple):
    """What a file of a mat holds, row by row as it is written."""

    times: Array
    """[frames] [s] from the first on"""
    frames: NDArray[numpy.float32]
    """[frames, rows, cols] [Pa] >= 0"""
    row_pitch: float
    """[m] from row to row"""
    col_pitch: float
    notes: tuple[str, ...]
    """what was found and assumed, a sentence each"""
    warnings: tuple[str, ...]
    """those of them that make load or peak doubtful"""


class _Key(NamedTuple):
    """A line that is no row of cells."""

    name: str
    """of `KEYS`; empty for any other"""
    unit: str
    """in brackets behind the name"""
    value: str


def is_mat(path: Path) -> bool:
    """Whether a file is the text export of a mat: its head states rows and columns, and frames, a unit or a pitch, each on a line
    of its own.
    """
    try:
        with open_regular_file(path) as file:
            head = file.read(HEAD).replace(b"\0", b"").decode("latin-1")
    except OSError:
        return False
    keys = [_key(line) for line in head.splitlines()]
    sizes = {key.name for key in keys if key.value.isdigit()}
    return {"rows", "cols"} <= sizes and any(key.name in OF_A_MAT for key in keys)


def read_mat(
    path: Path, *, rate: float | None = None, unit: str | None = None, pitch: float | None = None
) -> MatRecording:
    """Read all frames of a mat.

    Args:
        path: of the file.
        rate: [Hz] of the frames; None: by the times that the file states.
        unit: of the pressures, where the file states none.
        pitch: [m] from cell to cell both ways, where the file states none.

    Raises:
        BagError: with the line, for raw counts, a frame that is not whole, what is not stated anywhere, or two sensors.
    """
    notes: list[str] = []
    reading = _Reading(path)
    try:
        for block in line_blocks(path, notes):
            for line, text in block:
                reading.add(line, text)
    except ExcitationError as error:
        raise BagError(str(error)) from None
    frames = reading.finish()
    notes += reading.notes()
    factor, said = _factor(path, reading.values.get("unit"), unit)
    by_rows, by_cols = (
        _pitch(path, reading.values.get(key) or reading.values.get("pitch"), pitch, key)
        for key in ("row_pitch", "col_pitch")
    )
    warnings = _warnings_of(reading.values, frames, by_rows * by_cols)
    notes += warnings
    times, by = _times(path, reading, rate)
    count, rows, cols = frames.shape
    notes.append(
        f"{count} frames of {rows} by {cols} cells of {1e3 * by_rows:.4g} by {1e3 * by_cols:.4g} mm, {said}{by}."
    )
    return MatRecording(times, (frames * factor).astype(numpy.float32), by_rows, by_cols, tuple(notes), tuple(warnings))


def _key(text: str) -> _Key:
    """Key and value of a line: `ROWS 8`, `Rows:,8`, `Sensel Width (cm):,1.27`."""
    bare = text.strip().strip('",;\t ')
    word, _, rest = bare.partition(" ")
    name = MEANT.get(word.strip(":,;").lower().replace("_", " "), "")
    if name:
        return _Key(name, "", rest.strip('",;:= \t'))
    match = re.match(r'([^:,;\t=(\[]+?)\s*(?:[(\[]([^)\]]*)[)\]])?\s*"?\s*[:,;\t=]\s*(.*)', bare)
    if match is None:
        return _Key("", "", bare)
    name = MEANT.get(match[1].strip().lower().replace("_", " "), "")
    return _Key(name, match[2] or "", match[3].strip('",;:= \t'))


class _Reading:
    """A file while its lines come."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.values: dict[str, _Key] = {}
        """of the head"""
        self.numbers: list[int] = []
        """of the frames, as they are numbered"""
        self.clock: list[str | None] = []
        """of the frames"""
        self.lines: list[int] = []
        """where the frames begin"""
        self.outside = self.below = 0
        self._frames: list[Array] = []
        self._rows: list[list[float]] = []
        self._named: int | None = None
        self._any_named = False
        self._time: str | None = None
        self._separator: str | None = None

    def add(self, line: int, text: str) -> None:
        """Take the next line that holds something."""
        first = text.lstrip('"')[:1]
        cell = text[:2].rstrip(',;\t "').lstrip('"')
        if (
            first
            and first not in "@*#,;"
            and (first in "+-.0123456789" or cell in NOT_OF_THE_SENSOR or text[:3] == "NaN")
        ):
            self._row(line, text)
        elif first:
            self._head(line, text)

    def _head(self, line: int, text: str) -> None:
        key = _key(text)
        if self._rows and text[:1] not in "*#,;":
            raise BagError(
                f"{self.path}, line {line}: frame {self._number()} has {len(self._rows)} of {self._size('rows', line)} rows, then "
                f"'{text[:40]}'; export the frame whole"
            )
        if key.name == "frame":
            found = re.search(r"\d+", key.value)
            self._named = int(found[0]) if found else self._number()
            self._time, self._any_named = None, True
        elif key.name == "time":
            self._time = key.value if self._named is not None else None
        elif key.name:
            before = self.values.setdefault(key.name, key)
            if key.value != before.value and key.name in ("rows", "cols", "unit", "sensor", "row_pitch", "col_pitch"):
                raise BagError(
                    f"{self.path}, line {line}: {key.name} is '{key.value:.40}' and was '{before.value:.40}'; export each sensor "
                    "into a file of its own"
                )

    def _row(self, line: int, text: str) -> None:
        cols, rows = self._size("cols", line), self._size("rows", line)
        if rows * cols > MOST_CELLS:
            raise BagError(f"{self.path}: {rows} by {cols} cells; at most {MOST_CELLS} are read")
        if not self._rows:
            if self._named is None and self._any_named:
                where = (
                    f"frame {self.numbers[-1]} has more than {rows} rows"
                    if self._frames
                    else "a row outside of any frame"
                )
                raise BagError(f"{self.path}, line {line}: {where}; export the frames whole")
            self.lines.append(line)
        if self._separator is None:
            self._separator = next((mark for mark in ";\t," if mark in text), "")
        fields = fields_of(text, self._separator or None)
        while len(fields) > cols and not fields[-1].strip():
            fields.pop()
        if len(fields) != cols:
            raise BagError(f"{self.path}, line {line}: {len(fields)} cells in a row, {cols} columns are stated")
        self._rows.append(_plain(text, fields) or [self._cell(line, field) for field in fields])
        if len(self._rows) == rows:
            self.numbers.append(self._number())
            self.clock.append(self._time)
            self._frames.append(numpy.array(self._rows))
            refuse_above_limit(
                BYTES_OF_A_CELL * rows * cols * len(self._frames), f"{self.path}: its first {len(self._frames)} frames"
            )
            self._rows, self._named, self._time = [], None, None

    def _cell(self, line: int, field: str) -> float:
        text = field.strip().strip('"')
        if text in NOT_OF_THE_SENSOR:
            self.outside += 1
            return 0.0
        value = number(text) if is_number(text) else float("nan")
        if not isfinite(value):
            raise BagError(f"{self.path}, line {line}: '{text[:40]}' is no pressure; a finite number is expected")
        if value < 0.0:
            self.below += 1
        return max(value, 0.0)

    def _number(self) -> int:
        return self._named if self._named is not None else (self.numbers[-1] + 1 if self.numbers else 1)

    def _size(self, key: str, line: int) -> int:
        value = self.values[key].value if key in self.values else ""
        if not re.fullmatch(r"0*[1-9]\d{0,6}", value):
            raise BagError(
                f"{self.path}, line {line}: {key} is '{value:.40}'; a mat states its rows and columns before the first frame"
            )
        return int(value)

    def finish(self) -> Array:
        """All frames, as written [frames, rows, cols]; at least one."""
        if self._rows:
            rows = self._size("rows", self.lines[-1])
            raise BagError(
                f"{self.path}: the file ends in frame {self._number()}, after {len(self._rows)} of {rows} rows; export it again, "
                "or cut it before that frame"
            )
        if not self._frames:
            raise BagError(
                f"{self.path}: the file states rows and columns and holds no frame; export the pressures too"
            )
        return numpy.stack(self._frames)

    def notes(self) -> list[str]:
        """What was found in the cells."""
        found = []
        if self.outside:
            found.append(
                f"{self.outside // len(self._frames)} cells of a frame are none of the sensor (B): taken as unloaded."
            )
        if self.below:
            found.append(f"{self.below} values lie below 0: taken as unloaded.")
        last = self.values.get("last")
        if last is not None and last.value.isdigit() and int(last.value) > self.numbers[-1]:
            found.append(f"The file announces frames up to {last.value}, the last one is {self.numbers[-1]}.")
        gaps = int((numpy.diff(self.numbers) > 1).sum())
        if gaps:
            found.append(f"Frames are missing at {gaps} places.")
        return found


def _plain(text: str, fields: list[str]) -> list[float]:
    """Cells of a row of plain numbers; none where one of them needs a closer look."""
    try:
        values = [float(field) for field in fields] if "_" not in text else []
    except ValueError:
        return []
    return values if values and min(values) >= 0.0 and max(values) < inf and not any(map(isnan, values)) else []


def _factor(path: Path, key: _Key | None, unit: str | None) -> tuple[float, str]:
    """Factor of the pressures to [Pa], and what is said of it."""
    stated = "" if key is None else key.value
    if stated.lower() in RAW and (stated or unit is None):
        what = "states no unit" if not stated else f"holds {stated}"
        cure = (
            "calibrate the sensor and export pressures" if stated else f"state it by --unit {'|'.join(PRESSURE_UNITS)}"
        )
        raise BagError(f"{path}: the mat {what}, and counts are no pressures; {cure}")
    factor = factor_of(stated or str(unit))
    if factor is None or si_unit(stated or str(unit)) != "Pa":
        raise BagError(
            f"{path}: '{(stated or str(unit))[:40]}' is no unit of a pressure; export pressures in {', '.join(PRESSURE_UNITS)}"
        )
    if stated and unit is not None and factor_of(unit) != factor:
        raise BagError(f"{path}: --unit is {unit}, the file states {stated}; leave the option out")
    return factor, f"pressures in {stated}" if stated else f"{unit} as stated"


def _pitch(path: Path, key: _Key | None, given: float | None, name: str) -> float:
    """Distance of the cells [m]."""
    if key is None:
        if given is None:
            raise BagError(
                f"{path}: the file does not state the distance of its cells ({name}); state it by --pitch MM"
            )
        return given
    value, _, own = key.value.partition(" ")
    factor = factor_of(own or key.unit) if own or key.unit else None
    if (
        factor is None
        or si_unit(own or key.unit) != "m"
        or not is_number(value)
        or not 1e-4 <= number(value) * factor <= 1.0
    ):
        raise BagError(
            f"{path}: {name} is '{key.value:.40}' {key.unit:.20}; a length of 0.1 mm to 1 m with its unit is expected; or write it "
            "so in the file"
        )
    found = number(value) * factor
    if given is not None and abs(given - found) > 1e-3 * found:
        raise BagError(
            f"{path}: --pitch is {1e3 * given:g} mm, the file states {1e3 * found:g} mm; leave the option out"
        )
    return found


def _warnings_of(values: dict[str, _Key], frames: Array, cell: float) -> list[str]:
    """What of the head does not fit the pressures."""
    found = []
    text, _, unit = values["area"].value.partition(" ") if "area" in values else ("", "", "")
    side = factor_of(unit.rstrip("2²^")) if unit else None
    if side is not None and is_number(text) and abs(number(text) * side**2 / cell - 1.0) > 0.01:
        found.append(f"A cell has {values['area'].value}, its pitch says {1e6 * cell:.4g} mm²: the pitch counts.")
    limit = values["saturation"].value.partition(" ")[0] if "saturation" in values else ""
    if is_number(limit) and number(limit) > 0.0 and (count := int((frames >= number(limit)).sum())):
        found.append(
            f"{count} values are saturated ({values['saturation'].value}): load and peak are larger than they show."
        )
    return found


def _times(path: Path, reading: _Reading, rate: float | None) -> tuple[Array, str]:
    """Times of the frames [s] from the first on, and what is said of them."""
    numbers = numpy.array(reading.numbers, dtype=numpy.float64)
    period = reading.values["period"].value if "period" in reading.values else ""
    if rate is None and is_number(period) and number(period) > 0.0:
        rate = 1.0 / number(period)
    if len(numbers) == 1:
        return numpy.zeros(1), ""
    if rate is not None:
        times, by = (numbers - numbers[0]) / rate, f", at {rate:g} Hz"
    elif all(each is not None for each in reading.clock):
        try:
            times = numpy.array([seconds_of_text(str(each)) for each in reading.clock])
        except ValueError:
            raise BagError(
                f"{path}: '{reading.clock[0]!s:.40}' is no time of day; state the rate of the frames by --rate HZ"
            ) from None
        times, by = times - times[0], ", at their own times"
    else:
        raise BagError(f"{path}: the frames have no times; state their rate by --rate HZ")
    wrong = numpy.flatnonzero(numpy.diff(times) <= 0.0)
    if wrong.size:
        place = int(wrong[0]) + 1
        raise BagError(
            f"{path}, line {reading.lines[place]}: frame {reading.numbers[place]} is not later than the one before it; cut the "
            "recording there, or state the rate by --rate HZ"
        )
    return times, by
