"""Bags of anyone: MCAP and SQLite of ROS 2, and ROS 1, read by rosbags; an MCAP that is cut or
damaged, as far as whole chunks go.

rosbags wants a whole file. Where it gives up, the reader of this package takes what can be read of
an MCAP.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.metadata import files_of_bag
from contact_sim_pkg.bag.reader import Bag, open_bag
from contact_sim_pkg.files import open_regular_file

__all__ = ["AnyBag", "use_bag"]

Result = TypeVar("Result")
METADATA = "metadata.yaml"
ENDINGS = (".mcap", ".db3", ".bag")


class AnyBag(NamedTuple):
    """Topics of a bag with their types, and their messages."""

    path: Path
    topics: dict[str, str]
    read: Callable[[str], Iterator[Any]]  # messages of a topic, in file order
    notes: list[str]  # what is missing, one line each; full once the messages have been read


class _UnreadableError(Exception):
    """Bytes that rosbags cannot take apart."""


def use_bag(path: Path, use: Callable[[AnyBag], Result]) -> Result:
    """What `use` makes of the bag; it may be called twice, the second time with what can be read of
    a damaged one.

    Raises:
        BagError: nothing of the bag can be read.
    """
    place = _place_of(path)
    try:
        return _whole(place, use)
    except _UnreadableError as error:
        # rosbags reads whole files only: what is left of a damaged one is read by our reader
        bag = _what_is_left(place)
        if bag is None:
            raise BagError(
                f"the bag {path} cannot be read: {str(error).rstrip('.')}; give the directory or the file of a whole bag"
            ) from None
        if not bag.topics:
            raise BagError(f"of the bag {path} nothing can be read: {'; '.join(bag.notes) or error}") from None
    types = {name: topic.type for name, topic in bag.topics.items()}
    return use(AnyBag(path, types, lambda topic: (message for _, message in bag.decoded(topic)), bag.notes))


def _place_of(path: Path) -> Path:
    """The path, or the only file with messages in a directory without metadata; its files are
    regular ones that can be opened.
    """
    if not path.exists():
        raise BagError(f"there is no bag {path}; give the directory or the file of a bag")
    place, files = path, [path]
    if path.is_dir() and (path / METADATA).exists():
        files = [path / name for name in files_of_bag(path / METADATA)]
    elif path.is_dir():
        files = [file for file in sorted(path.iterdir()) if file.suffix in ENDINGS]
        if len(files) != 1:
            raise BagError(
                f"the directory {path} has no {METADATA} and {len(files)} files of messages; give one of them"
            )
        place = files[0]
    # A pipe or a socket would block the reader
    for file in files:
        try:
            open_regular_file(file).close()
        except OSError as error:
            raise BagError(
                f"{file} cannot be opened: {error.strerror}; give the directory or the file of a bag"
            ) from None
    return place


def _whole(place: Path, use: Callable[[AnyBag], Result]) -> Result:
    """By rosbags. Its parsers meet damaged bytes with errors of many kinds, from its own to those
    of SQLite.
    """
    reader: Any = None
    try:
        reader = AnyReader([place], default_typestore=get_typestore(Stores.ROS2_JAZZY))
        reader.open()
    except Exception as error:  # noqa: BLE001 - the parsers of damaged bytes raise errors of many kinds
        raise _UnreadableError(str(error)) from None
    try:
        types = {row.topic: row.msgtype for row in reader.connections}
        return use(AnyBag(place, types, lambda topic: _messages(reader, topic), []))
    finally:
        reader.close()


def _messages(reader: AnyReader, topic: str) -> Iterator[Any]:
    rows = [row for row in reader.connections if row.topic == topic]
    try:
        for connection, _, data in reader.messages(connections=rows):
            yield reader.deserialize(data, connection.msgtype)
    except Exception as error:  # noqa: BLE001 - the parsers of damaged bytes raise errors of many kinds
        raise _UnreadableError(str(error)) from None


def _what_is_left(place: Path) -> Bag | None:
    """The bag by the reader of this package, damaged chunks left out; None where it is no MCAP."""
    try:
        return open_bag(place, skip_bad=True)
    except BagError:
        return None
