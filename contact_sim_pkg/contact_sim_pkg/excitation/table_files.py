"""Recordings in the files of data loggers, as the table that a text file gives: `.mat`, `.wav`, MDF4, TDMS, UFF58, TYDEX, bags.

Their libraries are imported on use; those of MDF4, TDMS, UFF58 and MATLAB 7.3 come with the extra `daq`.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation import tydex
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.recorded_csv import LARGEST_FILE, RecordedTable, memory_of_text, read_table
from contact_sim_pkg.excitation.table_words import factor_of, si_unit, split_unit
from contact_sim_pkg.files import BAG_ENDINGS, RefusedError, open_regular_file
from contact_sim_pkg.records.rig import load

__all__ = ["memory_needed", "read_recording"]

MAT_HEADER, MAT_VERSION = 128, (b"\x00\x01", b"\x01\x00")
MAT_KINDS = {*range(1, 8), 9, *range(12, 19)}
"""Types of an element of a file of MATLAB 5"""
MAT_MATRIX, MAT_COMPRESSED = 14, 15

Array = NDArray[numpy.float64]
Column = tuple[str, str | None, Array]
"""name, unit, samples"""


def read_recording(
    path: Path, header_line: int | None = None, *, section: str = "vibration", bare: tuple[str, ...] = ()
) -> RecordedTable:
    """The columns of a recording of any of the formats; a text file as `read_table` reads it.

    Columns of different lengths are refused; times of a channel become a column `time` [s].

    Raises:
        ExcitationError: the file cannot be read, holds no columns, or its library is not installed.
    """
    reader = READERS.get(Path(path).suffix.lower())
    if reader is None:
        return read_table(path, header_line, section=section, bare=bare)
    try:
        with open_regular_file(path) as file:
            size = file.seek(0, 2)
    except OSError as error:
        raise ExcitationError(f"{path}: cannot be read: {error.strerror or error}") from error
    if size > LARGEST_FILE:
        raise ExcitationError(f"{path}: the file has {size} bytes, at most {LARGEST_FILE} are read; cut the recording")
    try:
        found = list(reader(Path(path)))
    except RefusedError:
        raise
    except Exception as error:  # noqa: BLE001 - the parsers of damaged files raise errors of many kinds
        reason = " ".join(str(error).split()) or type(error).__name__
        raise ExcitationError(f"{path}: cannot be read as {Path(path).suffix}: {reason:.200}") from None
    return _table(path, found)


def memory_needed(path: Path) -> int:
    """Memory in [bytes] that reading a recording and treating its columns takes; 0 for no file. A file of numbers packs them,
    and each becomes 8 bytes, and some more on the way.
    """
    if Path(path).suffix.lower() not in READERS:
        return memory_of_text(path)
    try:
        return 40 * Path(path).stat().st_size
    except OSError:
        return 0


def _table(path: Path, found: list[Column]) -> RecordedTable:
    lengths = {len(values) for _, _, values in found}
    if not found or max(lengths) < 2:
        raise ExcitationError(f"{path}: the file holds no columns of samples; at least one of two samples is needed")
    if len(lengths) > 1:
        listed = ", ".join(f"{name} {len(values)}" for name, _, values in found[:8])
        raise ExcitationError(f"{path}: its columns differ in length ({listed}); export those of one rate alone")
    columns: dict[str, Array] = {}
    units: dict[str, str] = {}
    for written, unit, values in found:
        name, own = split_unit(written)
        name, unit = name.lower(), unit or own
        if name in columns:
            raise ExcitationError(f"{path}: column '{name}' is there twice; give each column a name of its own")
        factor = None if unit is None else factor_of(unit)
        columns[name] = numpy.asarray(values, dtype=numpy.float64) * (factor or 1.0)
        if unit is not None and factor is not None:
            units[name] = si_unit(unit)
    lines = numpy.arange(1, max(lengths) + 1)
    return RecordedTable(str(path), columns, lines, "none", frozenset(units), units=units)


def _library(name: str, path: Path) -> Any:
    try:
        return import_module(name)
    except ImportError:
        raise ExcitationError(
            f"{path}: {path.suffix} is read by {name}, which is not installed; pip install 'contact_sim_pkg[daq]'"
        ) from None


def _mat(path: Path) -> Iterator[Column]:
    """Vectors of numbers, those in structures too; a matrix gives a column each, NAME_1, NAME_2."""
    from scipy.io import loadmat  # takes 0.2 s

    content = path.read_bytes()
    if b"MATLAB 7.3" in content[:MAT_HEADER]:
        with _library("h5py", path).File(path) as stored:
            vectors: list[tuple[str, Any]] = []
            stored.visititems(lambda name, item: vectors.append((name, item[()].T)) if hasattr(item, "dtype") else None)
    else:
        if content[124:126] in MAT_VERSION:
            _refuse_broken_mat(content[MAT_HEADER:], "<" if content[126:128] == b"IM" else ">")
        vectors = [each for each in loadmat(path, simplify_cells=True).items() if not each[0].startswith("__")]
    for name, value in vectors:
        yield from _columns_of(name, value)


def _refuse_broken_mat(elements: bytes, order: str) -> None:
    """Walk through the elements of a file of MATLAB 5: of a damaged one scipy's reader ends the process."""
    place = 0
    while place < len(elements):
        if len(elements) - place < 8:
            raise ValueError("the last element is cut off")
        kind, size = struct.unpack_from(f"{order}II", elements, place)
        begin = place + 8
        if kind >> 16:  # a short element: length and type in one number, the content in the other
            kind, size, begin = kind & 0xFFFF, 4, place + 4
        end = begin + size
        if kind not in MAT_KINDS or end > len(elements):
            raise ValueError(f"the element at byte {MAT_HEADER + place} is damaged or cut off")
        if kind == MAT_COMPRESSED:
            _refuse_broken_mat(zlib.decompress(elements[begin:end]), order)
        elif kind == MAT_MATRIX:
            _refuse_broken_mat(elements[begin:end], order)
        place = end if kind == MAT_COMPRESSED else end + -(end - place) % 8  # padded to 8 bytes


def _columns_of(name: str, value: Any) -> Iterator[Column]:
    if isinstance(value, dict):
        for key, part in value.items():
            yield from _columns_of(key, part)
        return
    array = numpy.asarray(value)
    if array.dtype.kind not in "iuf" or array.size < 2:
        return
    array = numpy.squeeze(array)
    name = name.rpartition("/")[2]
    if array.ndim == 1:
        yield name, None, array
    elif array.ndim == 2:
        array = array if array.shape[0] >= array.shape[1] else array.T
        for place, column in enumerate(array.T, 1):
            yield f"{name}_{place}", None, column


def _wav(path: Path) -> Iterator[Column]:
    """Channels `ch1`, `ch2` … as shares of full scale, and their time."""
    from scipy.io import wavfile

    rate, samples = wavfile.read(path)
    full = float(-numpy.iinfo(samples.dtype).min) if samples.dtype.kind == "i" else 1.0
    shares = (samples.astype(numpy.float64) - 128.0) / 128.0 if samples.dtype == numpy.uint8 else samples / full
    shares = shares.reshape(len(samples), -1)
    yield "time", "s", numpy.arange(len(shares)) / rate
    for place, column in enumerate(shares.T, 1):
        yield f"ch{place}", None, column


def _mdf(path: Path) -> Iterator[Column]:
    """The channels of the largest group, and its time."""
    with _library("asammdf", path).MDF(path) as content:
        signals = [
            each
            for each in content.iter_channels(skip_master=True)
            if each.samples.dtype.kind in "iuf" and each.samples.ndim == 1
        ]
    longest = max((len(each.samples) for each in signals), default=0)
    chosen = [each for each in signals if len(each.samples) == longest]
    if chosen:
        yield "time", "s", chosen[0].timestamps
    for each in chosen:
        yield each.name, each.unit or None, each.samples


def _tdms(path: Path) -> Iterator[Column]:
    """The channels of the first group, and their time where they state a step."""
    content = _library("nptdms", path).TdmsFile.read(path)
    group = next(iter(content.groups()), None)
    channels = [] if group is None else [each for each in group.channels() if each.dtype.kind in "iuf" and len(each)]
    if channels and "wf_increment" in channels[0].properties:
        yield "time", "s", channels[0].time_track()
    for each in channels:
        yield each.name, each.properties.get("unit_string") or None, each[:]


def _uff(path: Path) -> Iterator[Column]:
    """The records of data set 58 over evenly spaced time."""
    records = [each for each in _as_list(_library("pyuff", path).UFF(str(path)).read_sets()) if each.get("type") == 58]
    for place, record in enumerate(records, 1):
        if place == 1:
            yield "time", "s", numpy.asarray(record["x"], dtype=numpy.float64)
        name = str(record.get("id1", "")).strip() or f"ch{place}"
        unit = str(record.get("ordinate_axis_units_lab", "")).strip()
        yield name, None if unit in ("", "NONE") else unit, numpy.real(record["data"])


def _as_list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else [value]


def _bag(path: Path) -> Iterator[Column]:
    """The acceleration of a bag. Bags lie above this package, so their reader is found by its name."""
    yield from load("contact_sim_pkg.bag.recorded_imu:columns")(path)


READERS: dict[str, Callable[[Path], Iterator[Column]]] = {
    ".mat": _mat, ".wav": _wav, ".mf4": _mdf, ".mdf": _mdf, ".tdms": _tdms, ".uff": _uff, ".unv": _uff,
    ".tdx": tydex.columns,
    **dict.fromkeys(BAG_ENDINGS, _bag),
}  # fmt: skip
"""By the end of a file's name."""
