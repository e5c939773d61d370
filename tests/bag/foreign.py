"""Bags as others write them: one recording of Imu and text, in the formats and by the settings of rosbag2."""

from __future__ import annotations

import math
import sqlite3
from collections.abc import Callable
from io import BytesIO
from pathlib import Path

import numpy
import yaml
import zstandard
from mcap.writer import CompressionType, IndexType, Writer
from rosbags.rosbag1 import Writer as Ros1Writer
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as Ros2Writer
from rosbags.typesys import Stores, get_typestore

IMU, TEXT = "sensor_msgs/msg/Imu", "std_msgs/msg/String"
STORE = get_typestore(Stores.ROS2_JAZZY)
BEGIN = 1_700_000_000_000_000_000  # [ns]
SAMPLES = 1600
RATE = 100  # [Hz]
TYPES = {"/imu": IMU, "/note": TEXT}
Row = tuple[str, int, bytes]


def imu(number: int, store=STORE, **more: object) -> object:
    """Sample of a ride: √2 sin(2π 16 t) + g upwards, √2 sin(2π 2 t) forwards; every number differs."""
    t = number / RATE
    types = store.types
    vector, quaternion = types["geometry_msgs/msg/Vector3"], types["geometry_msgs/msg/Quaternion"]
    time = types["builtin_interfaces/msg/Time"]
    stamp = time(int(BEGIN // 10**9) + number // RATE, number % RATE * (10**9 // RATE))
    header = types["std_msgs/msg/Header"](stamp=stamp, frame_id="imu", **more)
    x, z = (math.sqrt(2.0) * math.sin(2.0 * math.pi * f * t) for f in (2.0, 16.0))
    nine = numpy.zeros(9)
    return types[IMU](
        header, quaternion(0.0, 0.0, 0.0, 1.0), nine, vector(1e-3 * number, 0.0, 0.0), nine,
        vector(x, 1e-4 * number, z + 9.80665), nine,
    )  # fmt: skip


def rows() -> list[Row]:
    """Topic, time [ns] and CDR of each message; a text after every 40th sample."""
    found: list[Row] = []
    for number in range(SAMPLES):
        time = BEGIN + number * (10**9 // RATE)
        found.append(("/imu", time, bytes(STORE.serialize_cdr(imu(number), IMU))))
        if number % 40 == 0:
            found.append(("/note", time + 7, bytes(STORE.serialize_cdr(STORE.types[TEXT](f"note {number}"), TEXT))))
    return found


ROWS = rows()


def mcap(messages: list[Row], topics: dict[str, str] = TYPES, **settings: object) -> bytes:
    """An MCAP file by the settings of the mcap library."""
    stream = BytesIO()
    writer = Writer(stream, **settings)
    writer.start(profile="ros2", library="foreign")
    channels = {}
    for topic, kind in topics.items():
        schema = writer.register_schema(kind, "ros2msg", STORE.generate_msgdef(kind, ros_version=2)[0].encode())
        channels[topic] = writer.register_channel(topic, "cdr", schema)
    for number, (topic, time, data) in enumerate(messages):
        writer.add_message(channels[topic], time, data, time, number)
    writer.finish()
    return stream.getvalue()


BARE = {"use_chunking": False, "compression": CompressionType.NONE}
TERSE = {
    "index_types": IndexType.NONE, "repeat_channels": False, "repeat_schemas": False, "use_statistics": False,
    "use_summary_offsets": False,
}  # fmt: skip


def _file(path: Path, content: bytes) -> Path:
    path.write_bytes(content)
    return path


def bare(path: Path) -> Path:
    """No chunks (preset `fastwrite`)."""
    return _file(path / "bare.mcap", mcap(ROWS, **BARE))


def terse(path: Path) -> Path:
    """Chunks, and no summary at all."""
    return _file(path / "terse.mcap", mcap(ROWS, chunk_size=20_000, **TERSE))


def bare_terse(path: Path) -> Path:
    """Neither chunks nor summary."""
    return _file(path / "bare_terse.mcap", mcap(ROWS, **BARE, **TERSE))


def chunked(path: Path) -> Path:
    """lz4 chunks with an index, repeated neither schemas nor channels."""
    settings = {"compression": CompressionType.LZ4, "repeat_channels": False, "repeat_schemas": False}
    return _file(path / "chunked.mcap", mcap(ROWS, chunk_size=20_000, **settings))


def packed_file(path: Path) -> Path:
    """A lone file, packed with zstd."""
    return _file(path / "packed.mcap.zstd", zstandard.compress(mcap(ROWS, chunk_size=20_000)))


def write_metadata(directory: Path, files: list[str], storage: str = "mcap") -> Path:
    """`metadata.yaml` of a bag of these files."""
    content = {
        "version": 9, "storage_identifier": storage, "duration": {"nanoseconds": 1}, "message_count": len(ROWS),
        "starting_time": {"nanoseconds_since_epoch": BEGIN}, "topics_with_message_count": [], "compression_format": "",
        "compression_mode": "", "relative_file_paths": files,
    }  # fmt: skip
    (directory / "metadata.yaml").write_text(yaml.safe_dump({"rosbag2_bagfile_information": content}))
    return directory


def split(path: Path) -> Path:
    """Three files in an order that only the metadata knows, split by size."""
    directory = path / "split"
    directory.mkdir()
    for name, part in zip("cab", (ROWS[:500], ROWS[500:1100], ROWS[1100:]), strict=True):
        _file(directory / f"{name}.mcap", mcap(part))
    return write_metadata(directory, ["c.mcap", "a.mcap", "b.mcap"])


def split_packed(path: Path) -> Path:
    """Two files, each packed, as `--compression-mode file` leaves them."""
    directory = path / "split_packed"
    directory.mkdir()
    for name, part in zip("01", (ROWS[:500], ROWS[500:]), strict=True):
        _file(directory / f"ride_{name}.mcap.zstd", zstandard.compress(mcap(part)))
    return write_metadata(directory, ["ride_0.mcap.zstd", "ride_1.mcap.zstd"])


def no_metadata(path: Path) -> Path:
    """Twelve files without metadata: the recorder was killed."""
    directory = path / "ride"
    directory.mkdir()
    for number in range(12):
        part = ROWS[number * len(ROWS) // 12 : (number + 1) * len(ROWS) // 12]
        _file(directory / f"ride_{number}.mcap", mcap(part))
    return directory


def _by_rosbags(path: Path, storage: StoragePlugin, mode: CompressionMode | None = None) -> Path:
    writer = Ros2Writer(path, version=9, storage_plugin=storage)
    if mode is not None:
        writer.set_compression(mode, CompressionFormat.ZSTD)
    with writer:
        connections = {topic: writer.add_connection(topic, kind, typestore=STORE) for topic, kind in TYPES.items()}
        for topic, time, data in ROWS:
            writer.write(connections[topic], time, data)
    return path


def sqlite(path: Path) -> Path:
    """SQLite."""
    return _by_rosbags(path / "sqlite", StoragePlugin.SQLITE3)


def sqlite_file(path: Path) -> Path:
    """The lone `.db3` of a bag of Foxy: a table of topics without quality of service, and no definitions."""
    return fill_sqlite(path / "old.db3", ROWS)


def fill_sqlite(file: Path, rows: list[Row]) -> Path:
    """Write a new `.db3` of these messages."""
    with sqlite3.connect(file) as database:
        database.executescript(
            "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT);"
            "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB);"
            "CREATE INDEX timestamp_idx ON messages (timestamp ASC);"
        )
        numbers = {topic: number for number, topic in enumerate(TYPES, 1)}
        database.executemany(
            "INSERT INTO topics VALUES (?, ?, ?, 'cdr')", [(numbers[each], each, TYPES[each]) for each in TYPES]
        )
        database.executemany(
            "INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)",
            [(numbers[topic], time, data) for topic, time, data in rows],
        )
    database.close()
    return file


def sqlite_packed(path: Path) -> Path:
    """SQLite, the file packed with zstd."""
    return _by_rosbags(path / "sqlite_packed", StoragePlugin.SQLITE3, CompressionMode.FILE)


def sqlite_messages(path: Path) -> Path:
    """SQLite, each message packed with zstd."""
    return _by_rosbags(path / "sqlite_messages", StoragePlugin.SQLITE3, CompressionMode.MESSAGE)


def mcap_messages(path: Path) -> Path:
    """MCAP, each message packed with zstd."""
    return _by_rosbags(path / "mcap_messages", StoragePlugin.MCAP, CompressionMode.MESSAGE)


FOREIGN: tuple[Callable[[Path], Path], ...] = (
    bare, terse, bare_terse, chunked, packed_file, split, split_packed, no_metadata, sqlite, sqlite_file, sqlite_packed,
    sqlite_messages, mcap_messages,
)  # fmt: skip
"""Makers of bags with the bytes of `ROWS`, in a directory."""


def ros1(path: Path) -> Path:
    """The same recording by ROS 1, its definitions those of ROS 1."""
    store = get_typestore(Stores.ROS1_NOETIC)
    file = path / "ride.bag"
    with Ros1Writer(file) as writer:
        connections = {topic: writer.add_connection(topic, kind, typestore=store) for topic, kind in TYPES.items()}
        for number in range(SAMPLES):
            time = BEGIN + number * (10**9 // RATE)
            writer.write(connections["/imu"], time, store.serialize_ros1(imu(number, store, seq=number), IMU))
            if number % 40 == 0:
                text = store.types[TEXT](f"note {number}")
                writer.write(connections["/note"], time + 7, store.serialize_ros1(text, TEXT))
    return file


def with_strangers(path: Path, *, json: bool = True) -> Path:
    """The recording with topics that nobody here can read: events of a service, a text that is no definition, JSON."""
    strangers = {  # type, definition, encoding, message
        "/light/_service_event": ("std_srvs/srv/SetBool_Event", b"", "cdr", b"\0\1\0\0" + bytes(20)),
        "/odd": ("odd_msgs/msg/Odd", b"this is: no definition\n", "cdr", b"\0\1\0\0abcd"),
        "/json": ("odd", b"{}", "json", b'{"a": 1}'),
    }
    if not json:
        del strangers["/json"]
    file = path / "strangers.mcap"
    with file.open("wb") as stream:
        writer = Writer(stream)
        writer.start(profile="ros2", library="foreign")
        channels = {}
        for topic, kind in TYPES.items():
            schema = writer.register_schema(kind, "ros2msg", STORE.generate_msgdef(kind, ros_version=2)[0].encode())
            channels[topic] = writer.register_channel(topic, "cdr", schema)
        for topic, (kind, text, encoding, _) in strangers.items():
            channels[topic] = writer.register_channel(topic, encoding, writer.register_schema(kind, "ros2msg", text))
        for number, (topic, time, data) in enumerate(ROWS):
            writer.add_message(channels[topic], time, data, time, number)
            if number % 400 == 0:
                for stranger, (*_, content) in strangers.items():
                    writer.add_message(channels[stranger], time, content, time, number)
        writer.finish()
    return file
