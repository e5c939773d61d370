"""From what a user names as a bag to its files, in order, unpacked where they were packed."""

from __future__ import annotations

import re
import shutil
import weakref
from pathlib import Path
from tempfile import mkdtemp

import zstandard

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.mcap.append_file import free_bytes_at
from contact_sim_pkg.bag.mcap.layout import MAGIC
from contact_sim_pkg.bag.metadata import files_of_bag
from contact_sim_pkg.bag.parts.mcap_part import McapPart
from contact_sim_pkg.bag.parts.part import ZSTD_MAGIC, Part
from contact_sim_pkg.files import BAG_ENDINGS, open_regular_file

__all__ = ["files_of", "parts_of"]

METADATA = "metadata.yaml"
ENDINGS = (*BAG_ENDINGS, ".zstd", ".zst")
SQLITE, ROS1 = b"SQLite format 3\0", b"#ROSBAG V"
KEPT_FREE = 500_000_000
"""[bytes] of the disk that are not filled by unpacking a file"""
_BLOCK = 1 << 20
_NUMBERED = re.compile(r"(.*?)_?(\d+)(\.\w+)+")


def parts_of(place: Path, *, skip_bad: bool = False) -> list[Part]:
    """The files of a bag, each opened by what its first bytes say it is; at least one.

    Args:
        place: directory or file.
        skip_bad: pass over files of a split bag that are missing or cannot be read, with a note.

    Raises:
        BagError: there is no bag, or a file of it cannot be read.
    """
    found: list[Part] = []
    lost: list[str] = []
    for file in files_of(place):
        try:
            found.append(_part(file, place))
        except BagError as error:
            if not skip_bad:
                raise
            lost.append(str(error))
    if not found:
        raise BagError("; ".join(lost))
    found[0].notes.extend(lost)
    return found


def files_of(place: Path) -> list[Path]:
    """The files of a bag in order: those that its metadata names, else by number; BagError for a directory without any,
    or with files of several bags.
    """
    if not place.is_dir():
        return [place]
    metadata = place / METADATA
    if metadata.exists():
        files = [_present(place / Path(name).name) for name in files_of_bag(metadata)]
    else:
        files = sorted((each for each in place.iterdir() if each.suffix in ENDINGS), key=_number)
        if len({_stem(each) for each in files}) > 1:
            raise BagError(
                f"{place} holds {len(files)} bag files and no {METADATA} ({', '.join(each.name for each in files)}); "
                "give the one file to read"
            )
    if not files:
        raise BagError(f"{place} holds no bag files ({', '.join(ENDINGS)}); give the directory or the file of a bag")
    return files


def _present(file: Path) -> Path:
    """The file, or what became of it when somebody packed or unpacked it."""
    others = [file.with_suffix(""), *(file.with_name(file.name + ending) for ending in (".zstd", ".zst"))]
    return next((each for each in (file, *others) if each.exists()), file)


def _stem(file: Path) -> str:
    match = _NUMBERED.fullmatch(file.name)
    return match.group(1) if match else file.name


def _number(file: Path) -> tuple[str, int]:
    match = _NUMBERED.fullmatch(file.name)
    return (match.group(1), int(match.group(2))) if match else (file.name, 0)


def _part(file: Path, place: Path) -> Part:
    try:
        with open_regular_file(file) as stream:
            begin = stream.read(16)
    except OSError as error:
        where = "" if file == place else f"{file.name}: "
        raise BagError(
            f"the bag {place} cannot be opened: {where}{error.strerror}; give its directory or its file"
        ) from None
    if begin.startswith(ZSTD_MAGIC):
        return _unpacked(file)
    if begin == SQLITE:
        from contact_sim_pkg.bag.parts.sqlite_part import SqlitePart

        return SqlitePart(file)
    if begin.startswith(ROS1):
        from contact_sim_pkg.bag.parts.ros1 import Ros1Part

        return Ros1Part(file)
    if not begin.startswith(MAGIC):
        raise BagError(
            f"{file.name} is no bag: it begins with {begin[:8].hex(' ') or 'nothing'}; read are MCAP, SQLite (.db3) and "
            "ROS 1 (.bag), also packed with zstd"
        )
    return McapPart(file)


def _unpacked(file: Path) -> Part:
    """The part in a packed file, which is unpacked beside the temporary files and removed with its part."""
    folder = Path(mkdtemp(prefix="contact-bench-"))
    target = folder / (file.stem if Path(file.stem).suffix else f"{file.stem}.mcap")
    note = ""
    try:
        with open_regular_file(file) as packed, open(target, "xb") as plain:
            stream = zstandard.ZstdDecompressor().stream_reader(packed, read_across_frames=True)
            try:
                while block := stream.read(_BLOCK):
                    plain.write(block)
                    if free_bytes_at(folder) < KEPT_FREE:
                        raise BagError(
                            f"{file} unpacks to more than {plain.tell()} bytes, for which {folder.parent} has no room; "
                            "set TMPDIR to a larger disk"
                        )
            except zstandard.ZstdError as error:
                note = f"{file.name} is damaged: it cannot be unpacked beyond {plain.tell()} bytes ({error})"
        with open(target, "rb") as plain_file:
            if plain_file.read(4) == ZSTD_MAGIC:
                raise BagError(f"{file} was packed twice; unpack it once")
        part = _part(target, file)
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        raise
    weakref.finalize(part, shutil.rmtree, folder, ignore_errors=True)
    part.notes.extend([note] if note else [])
    return part
