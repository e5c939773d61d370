"""Tables of topics as files: CSV, Parquet, and a CSV of frames for a map."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Callable, Iterator, Sequence
from importlib import import_module
from importlib.util import find_spec
from itertools import count
from pathlib import Path
from typing import IO, Any

import numpy as np

from contact_sim_pkg.bag.errors import BagError, UnreadableTypeError
from contact_sim_pkg.bag.names import safe_name
from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.files import FileRefusedError, as_cell, check_output, new_file, wrong_name
from contact_sim_pkg.records.registry import announced
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.report.export.table import Map, NoTableError, TopicTable, maps_of, table_of, time_of

__all__ = ["CSV", "PARQUET", "export", "formats"]

CSV, PARQUET = "csv", "parquet"
LONGEST_NAME = 200
"""Characters of a file's name."""
ROWS_AT_ONCE = 1 << 16
LARGEST_MAP = 10_000_000
"""Bytes of a map's file; a larger one is written where its topic is named."""
BYTES_OF_CELL = 12
"""The most that the text of a cell takes, near enough."""
GRID = ("cell_x", "cell_y", "origin_x", "origin_y")
"""Fields that place the cells of a map, written above its frames."""


def formats() -> dict[str, str]:
    """Formats of a table, each a ``module:function`` of a table and the stream that it is written to: ours, and those
    that plug-ins bring.
    """
    ours = {CSV: f"{__name__}:write_csv", PARQUET: f"{__name__}:write_parquet"}
    return {**ours, **announced("exports", ours)}


def _writer(form: str) -> Callable[[TopicTable, IO[bytes]], None]:
    known = formats()
    if form not in known:
        raise BagError(f"there is no format {form}; formats are {', '.join(known)}")
    if form == PARQUET and find_spec("pyarrow") is None:
        raise BagError("--parquet needs pyarrow, which is not installed; pip install pyarrow, or --csv")
    write: Callable[[TopicTable, IO[bytes]], None] = load(known[form])
    return write


def export(
    bag: Bag,
    form: str,
    topics: Sequence[str],
    out: Path,
    *,
    overwrite: bool = False,
    on_file: Callable[[str], None] = lambda _line: None,
) -> Iterator[Path]:
    """Write a file a topic into the folder `out`, `tire_force.csv`, and one a map, `tire_patch_pressure.csv`.

    All files have names of their own, which are free, before the first one is written.

    Args:
        bag: to read.
        form: one of `formats`, which is also the ending of its files; maps are CSV in each.
        topics: all where it is empty, but those that have nothing for a table: `bag.notes` names them, and those
            whose file has another name than theirs, and maps above `LARGEST_MAP`, which are left out as well;
            `bag.left_out` those of a type that cannot be read.
        out: folder, made where it does not exist.
        overwrite: replace files that exist.
        on_file: called with a line on each file, before it is written.

    Yields:
        Each file when it is written.

    Raises:
        BagError: no such format or topic, one that has nothing for a table, nothing recorded, or Parquet without pyarrow.
        FileRefusedError: a file exists, or `out` is one. MemoryLimitError: a table is too large.
    """
    write = _writer(form)
    names = [bag.topic(each).name for each in topics] or [name for name in bag.topics if bag.count(name)]
    if not names:
        raise BagError(f"{bag.path} holds no message: there is nothing to export")
    if reason := wrong_name(out):
        raise FileRefusedError(out, reason)
    if out.exists() and not out.is_dir():
        raise FileRefusedError(out, "exists already and is a file; --out names a folder with a file a topic")
    files = _files(bag, names, form)
    for name in files.values():
        if out.exists():
            check_output(out / name, [bag.path], overwrite=overwrite)
        elif reason := wrong_name(out / name):
            raise FileRefusedError(out / name, reason)
    # a topic that is named and has no table is refused before the first file
    tables = [table_of(bag, name) for name in names] if topics else _tables(bag, names)
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileRefusedError(out, f"cannot be made: {error.strerror}") from error
    for table in tables:
        file = out / files[table.topic, ""]
        if table.columns:
            on_file(f"{file.name}: {len(table.columns[0].values):,} rows of {len(table.columns)} columns")
            with new_file(file, [bag.path], overwrite=overwrite) as stream:
                write(table, stream)
            yield file
        for each in table.maps:
            place = out / files[table.topic, each.name]
            size = f"{each.cells:,} cells in {bag.count(table.topic)} frames, {each.cells * BYTES_OF_CELL / 1e6:.0f} MB at most"
            if not topics and each.cells * BYTES_OF_CELL > LARGEST_MAP:
                bag.notes.append(f"{table.topic} {each.name}: {size}; it is left out, --topic {table.topic} writes it")
                continue
            on_file(f"{place.name}: {size}")
            with new_file(place, [bag.path], overwrite=overwrite) as stream:
                _write_map(bag, table.topic, each, stream)
            yield place


def _tables(bag: Bag, names: Sequence[str]) -> Iterator[TopicTable]:
    """The tables of topics; a note in the bag says which ones have nothing for a table, `bag.left_out` which ones
    cannot be read.
    """
    for name in names:
        try:
            yield table_of(bag, name)
        except NoTableError as error:
            bag.notes.append(f"{error}; it is left out")
        except UnreadableTypeError as error:
            bag.left_out.append(f"{error}; {name} is left out ({bag.count(name)} messages)")


def _files(bag: Bag, names: Sequence[str], form: str) -> dict[tuple[str, str], str]:
    """Name of the file of each topic, with "", and of each of its maps: `/tire/force` -> `tire_force.csv`.

    A name that another one has taken is numbered, one that is too long is cut; a note in the bag says so.
    """
    found: dict[tuple[str, str], str] = {}
    for topic in names:
        for part, ending in [("", form), *((each.name, CSV) for each in maps_of(bag, topic))]:
            plain = "_".join(filter(None, (topic.strip("/").replace("/", "_"), part)))
            stem = safe_name(plain, LONGEST_NAME)
            numbered = (f"{stem}_{number}.{ending}" for number in count(2))
            file = f"{stem}.{ending}"
            while file in found.values():
                file = next(numbered)
            if file != f"{plain}.{ending}":
                bag.notes.append(f"{' '.join(filter(None, (topic, part)))} is in {file}")
            found[topic, part] = file
    return found


def write_csv(table: TopicTable, stream: IO[bytes]) -> None:
    """A header with units and a row a sample; numbers in the fewest digits that give the same bits, empty where a
    value is not defined."""
    text = io.TextIOWrapper(stream, encoding="utf-8", newline="")
    writer = csv.writer(text)
    writer.writerow([as_cell(column.header) for column in table.columns])
    for start in range(0, len(table.columns[0].values), ROWS_AT_ONCE):
        part = slice(start, start + ROWS_AT_ONCE)
        writer.writerows(zip(*(_texts(column.values[part]) for column in table.columns), strict=True))
    text.flush()
    text.detach()


def _texts(values: Any) -> list[Any]:
    column = np.asarray(values)
    if column.dtype == np.float32:
        # the shortest text of a float32 is not that of the same value as a double
        return ["" if math.isnan(value) else str(value) for value in column]
    if column.dtype.kind == "f":
        return ["" if math.isnan(value) else value for value in column.tolist()]
    return [*map(as_cell, column.tolist())]


def write_parquet(table: TopicTable, stream: IO[bytes]) -> None:
    """The columns with their units as metadata."""
    pyarrow, parquet = import_module("pyarrow"), import_module("pyarrow.parquet")
    fields = [
        pyarrow.field(column.header, pyarrow.array(np.asarray(column.values)).type, metadata={"unit": column.unit})
        for column in table.columns
    ]
    arrays = [pyarrow.array(np.asarray(column.values)) for column in table.columns]
    parquet.write_table(pyarrow.Table.from_arrays(arrays, schema=pyarrow.schema(fields)), stream)


def _write_map(bag: Bag, topic: str, field: Map, stream: IO[bytes]) -> None:
    """Frames as a pressure mat writes them: what places the cells, then for each frame a line `frame, number, time`,
    and its rows along x from the front of the file's first row, columns along y."""
    write: Callable[[str], Any] = lambda line: stream.write(line.encode() + b"\n")  # noqa: E731
    for number, (log_time, message) in enumerate(bag.decoded(topic)):
        rows, cols = (_size(message, side) for side in field.sides)
        if number == 0:
            write(f"{field.name} [{field.unit}],rows,{rows},cols,{cols}")
            write(",".join(f"{name} [m],{getattr(message, name)!r}" for name in GRID if hasattr(message, name)))
        write(f"frame,{number},time [s],{time_of(log_time, message)!r},rows,{rows},cols,{cols}")
        for row in np.reshape(getattr(message, field.name), (rows, cols)):
            write(",".join(map(str, row)))


def _size(message: Any, side: str) -> int:
    value = getattr(message, side)
    return int(value) if np.ndim(value) == 0 else len(value)
