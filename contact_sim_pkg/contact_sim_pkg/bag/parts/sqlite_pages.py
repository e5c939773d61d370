"""The rows of the table of messages in an SQLite file that was cut off, from its pages.

SQLite reaches a row over the inner pages of a table, and gives up where one of them is missing. The
rows themselves stand in leaf pages, which say of themselves what they are. Source: "Database File
Format" of the SQLite documentation, sections 1.3, 1.6 and 2.1.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import IO

from contact_sim_pkg.bag.mcap.chunks import LARGEST_RECORD
from contact_sim_pkg.files import open_regular_file

__all__ = ["rows_of_pages"]

_LEAF = 13
"""kind of a page that holds rows"""
_INTEGERS = {1: 1, 2: 2, 3: 3, 4: 4, 5: 6, 6: 8, 8: 0, 9: 0}
"""serial type -> bytes; 8 and 9 are the numbers 0 and 1"""


def rows_of_pages(path: Path) -> Iterator[tuple[int, int, int, bytes]]:
    """Number, topic, time [ns] and bytes of each message of a file, as far as its pages are there."""
    with open_regular_file(path) as file:
        head = file.read(100)
        size = int.from_bytes(head[16:18], "big") or 65536
        size = 65536 if size == 1 else size
        usable = size - head[20] if len(head) == 100 else 0
        number = 0
        while usable >= 480:
            number += 1
            file.seek((number - 1) * size)
            page = file.read(size)
            if len(page) < size:
                return
            start = 100 if number == 1 else 0
            if page[start] == _LEAF:
                yield from _rows_of(file, page, start, size, usable)


def _rows_of(file: IO[bytes], page: bytes, start: int, size: int, usable: int) -> Iterator[tuple[int, int, int, bytes]]:
    for cell in range(int.from_bytes(page[start + 3 : start + 5], "big")):
        pointer = start + 8 + 2 * cell
        place = int.from_bytes(page[pointer : pointer + 2], "big")
        try:
            length, place = _varint(page, place)
            rowid, place = _varint(page, place)
            row = _message(rowid, _payload(file, page, place, length, size, usable))
        except (IndexError, ValueError):
            continue
        if row is not None:
            yield row


def _payload(file: IO[bytes], page: bytes, place: int, length: int, size: int, usable: int) -> bytes:
    """The record of a cell: what stands in the page, and in the pages that continue it (section 1.6)."""
    if length > LARGEST_RECORD:
        raise ValueError
    if length <= usable - 35:
        return page[place : place + length]
    least = (usable - 12) * 32 // 255 - 23
    here = least + (length - least) % (usable - 4)
    here = here if here <= usable - 35 else least
    content, following = [page[place : place + here]], int.from_bytes(page[place + here : place + here + 4], "big")
    left = length - here
    while left > 0:
        file.seek((following - 1) * size)
        more = file.read(size)
        if following == 0 or len(more) < size:
            raise ValueError
        content.append(more[4 : 4 + min(left, usable - 4)])
        left -= usable - 4
        following = int.from_bytes(more[:4], "big")
    return b"".join(content)


def _message(rowid: int, record: bytes) -> tuple[int, int, int, bytes] | None:
    """A row of the shape of a message: its number (NULL, as it is the row's), two integers, bytes."""
    end, place = _varint(record, 0)
    kinds = []
    while place < end:
        kind, place = _varint(record, place)
        kinds.append(kind)
    if len(kinds) != 4 or kinds[0] != 0 or kinds[3] < 12 or kinds[3] % 2:
        return None
    if kinds[1] not in _INTEGERS or kinds[2] not in _INTEGERS:
        return None
    topic, place = _integer(record, place, kinds[1])
    time, place = _integer(record, place, kinds[2])
    data = record[place : place + (kinds[3] - 12) // 2]
    if len(data) != (kinds[3] - 12) // 2:
        raise ValueError
    return rowid, topic, time, data


def _integer(record: bytes, place: int, kind: int) -> tuple[int, int]:
    if kind in (8, 9):
        return kind - 8, place
    end = place + _INTEGERS[kind]
    return int.from_bytes(record[place:end], "big", signed=True), end


def _varint(data: bytes, place: int) -> tuple[int, int]:
    """A number of 1 to 9 bytes, and the place behind it; IndexError beyond the end."""
    value = 0
    for count in range(8):
        byte = data[place + count]
        value = value << 7 | byte & 0x7F
        if byte < 0x80:
            return value, place + count + 1
    return value << 8 | data[place + 8], place + 9
