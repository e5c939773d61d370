"""The numbers of an OpenCRG file: big-endian binary (KRBI, KDBI) or fixed-width text (LRFI,
LDFI).
"""

from contextlib import suppress
from io import BytesIO
from itertools import islice
from math import isfinite
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.opencrg.header import NUMBER, Header
from contact_sim_pkg.excitation.opencrg.layout import MOST_CELLS, CrgLayout

RECORD = 80  # [bytes] a record of the payload
_BINARY = {"KRBI": ">f4", "KDBI": ">f8"}
_FIELD_WIDTH = {"LRFI": 10, "LDFI": 20}


def read_payload(data: bytes, header: Header, layout: CrgLayout) -> NDArray[numpy.float64]:
    """All numbers, [rows, columns]; missing cells are NaN.

    Raises:
        ExcitationError: too few or too many bytes or lines, with both numbers; a field that is no
        number.
    """
    if header.format in _BINARY:
        return _read_binary(data, header, layout, numpy.dtype(_BINARY[header.format]))
    return _read_text(data, header, layout, _FIELD_WIDTH[header.format])


def _read_binary(data: bytes, header: Header, layout: CrgLayout, number: "numpy.dtype[Any]") -> NDArray[numpy.float64]:
    found = len(data) - header.payload_start
    row_bytes = layout.columns * number.itemsize
    rows = layout.rows if layout.rows is not None else _open_ended_rows(found, row_bytes)
    expected = rows * row_bytes
    padded = -(-expected // RECORD) * RECORD
    if found not in (expected, padded) or rows < 2:
        raise ExcitationError(
            f"{header.file}, byte {header.payload_start}: the road data has {found} bytes, expected {expected} "
            f"({rows} rows of {layout.columns} numbers of {number.itemsize} bytes) or {padded} (filled to records of "
            f"{RECORD}); " + _cause(found, expected, number.itemsize)
        )
    if rows * layout.columns > MOST_CELLS:
        raise ExcitationError(
            f"{header.file}: {rows} x {layout.columns} numbers are above the limit of {MOST_CELLS}; cut the road"
        )
    _check_fill(numpy.frombuffer(data, number, offset=header.payload_start + expected), header, rows)
    numbers = numpy.frombuffer(data, number, rows * layout.columns, header.payload_start)
    with numpy.errstate(invalid="ignore"):  # a signalling NaN is a missing cell like any other
        values = numbers.astype(numpy.float64).reshape(rows, layout.columns)
    return values[: rows - _filled_rows(values, row_bytes)] if layout.rows is None else values


def _check_fill(fill: NDArray[Any], header: Header, rows: int) -> None:
    """The rest of the last record holds no numbers."""
    with numpy.errstate(invalid="ignore"):
        held = int(numpy.count_nonzero(fill[~numpy.isnan(fill)]))
    if held:
        raise ExcitationError(
            f"{header.file}: {held} numbers follow the {rows} rows that the header asks for, where only the fill of "
            "the last record was expected; header and data do not belong together"
        )


def _open_ended_rows(found: int, row_bytes: int) -> int:
    """Rows where the header gives no end: the payload is either whole rows, or whole rows filled up
    to the next record."""
    if found % row_bytes == 0 or found % RECORD:
        return max(found // row_bytes, 1)
    return found // row_bytes


def _filled_rows(values: NDArray[numpy.float64], row_bytes: int) -> int:
    """Number of rows at the end that are only the fill of the last record."""
    most = (RECORD - 1) // row_bytes
    count = 0
    while count < most and numpy.isnan(values[-1 - count]).all():
        count += 1
    return count


def _cause(found: int, expected: int, itemsize: int) -> str:
    if found % itemsize:
        return (
            f"{found} is not a multiple of {itemsize}: bytes were lost or added, as line-ending conversion does "
            "(carriage returns); take the original file"
        )
    return "the file is cut; take the whole file" if found < expected else "header and data do not belong together"


def _read_text(data: bytes, header: Header, layout: CrgLayout, width: int) -> NDArray[numpy.float64]:
    stream = BytesIO(data)
    stream.seek(header.payload_start)
    count = max((number for number, line in enumerate(stream, start=1) if line.strip()), default=0)
    # Lines that the layout needs, against those of the file.
    per_line = RECORD // width
    lines_per_row = -(-layout.columns // per_line)
    rows = layout.rows if layout.rows is not None else max(-(-count // lines_per_row), 2)
    if count != rows * lines_per_row:
        raise ExcitationError(
            f"{header.file}, line {header.payload_line}: the road data has {count} lines, expected "
            f"{rows * lines_per_row} ({rows} rows of {layout.columns} numbers, {per_line} a line); the file is cut "
            "or the header belongs to another file"
        )
    if rows * layout.columns > MOST_CELLS:
        raise ExcitationError(
            f"{header.file}: {rows} x {layout.columns} numbers are above the limit of {MOST_CELLS}; cut the road"
        )
    # Fields of each line into its row.
    values = numpy.empty((rows, layout.columns))
    stream.seek(header.payload_start)
    for index, line in enumerate(islice(stream, count)):
        row, part = divmod(index, lines_per_row)
        start = part * per_line
        stop = min(start + per_line, layout.columns)
        values[row, start:stop] = _fields(line.rstrip(b"\r\n"), stop - start, width, header, index)
    return values


def _fields(line: bytes, count: int, width: int, header: Header, index: int) -> list[float]:
    place = f"{header.file}, line {header.payload_line + index}"
    text = line.decode("latin-1")
    if len(text.rstrip()) > count * width or len(text) < count * width:
        raise ExcitationError(
            f"{place}: the line has {len(text.rstrip())} characters, expected {count * width} ({count} numbers of "
            f"{width} characters)"
        )
    with suppress(ValueError):  # plain numbers, nearly always
        found = [float(text[position : position + width]) for position in range(0, count * width, width)]
        if "_" not in text and all(map(isfinite, found)):
            return found
    numbers = []
    for position in range(0, count * width, width):
        field = text[position : position + width].strip()
        if field.startswith("*"):
            numbers.append(float("nan"))
        elif NUMBER.fullmatch(field):
            numbers.append(float(field))
        else:
            raise ExcitationError(f"{place}: '{field}' in columns {position + 1} to {position + width} is no number")
    return numbers
