"""The records of a file of ours beside those that the writer of the `mcap` package makes of the same messages."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import zstandard
from mcap.reader import make_reader
from mcap.records import Chunk, ChunkIndex, Footer, MetadataIndex, SummaryOffset
from mcap.stream_reader import StreamReader
from mcap.writer import Writer

from contact_sim_pkg.bag.mcap.append_file import create_file
from contact_sim_pkg.bag.mcap.chunked_file import ChunkedFile

TEXTS = {"scene": "rig: tire\n"}
TOPICS = [("/a", "std_msgs/msg/String"), ("/b", "std_msgs/msg/String"), ("/c", "geometry_msgs/msg/Vector3")]
MESSAGES = [(1 + k % 3, k // 3, 1000 * k + 7 * (k % 2), 1000 * k, bytes([k]) * (17 * k)) for k in range(40)]
"""Channel, sequence, log time, publish time, data."""


def ours(place: Path) -> Path:
    """Written in two chunks by `ChunkedFile`."""
    content = ChunkedFile(create_file(place, "ours.mcap"), "test")
    content.add_metadata("texts", TEXTS)
    for topic, name in TOPICS:
        content.add_channel(topic, "cdr", name, f"definition of {name}", TEXTS)
    for number, message in enumerate(MESSAGES):
        if number == 25:
            content.end_chunk()
        content.add_message(*message)
    content.finish()
    return place / "ours.mcap"


def theirs(place: Path) -> Path:
    """The same by the `mcap` package."""
    with (place / "theirs.mcap").open("wb") as file:
        writer: Any = Writer(file, chunk_size=4 << 20)
        writer.start("ros2", "test")
        writer.add_metadata("texts", TEXTS)
        schemas: dict[str, int] = {}
        for topic, name in TOPICS:
            if name not in schemas:
                schemas[name] = writer.register_schema(name, "ros2msg", f"definition of {name}".encode())
            writer.register_channel(topic, "cdr", schemas[name], TEXTS)
        for number, (channel, sequence, log_time, publish_time, data) in enumerate(MESSAGES):
            if number == 25:
                writer.flush()
            writer.add_message(channel, log_time, data, publish_time, sequence)
        writer.finish()
    return place / "theirs.mcap"


def records(path: Path) -> list[Any]:
    """All records in order, without what depends on how well a chunk is packed, and without empty groups."""
    found: list[Any] = []
    with path.open("rb") as file:
        for record in StreamReader(file, emit_chunks=True).records:
            match record:
                case Chunk():
                    found.append(replace(record, data=zstandard.decompress(record.data)))
                case ChunkIndex():
                    offsets = dict.fromkeys(record.message_index_offsets, 0)
                    bare = replace(record, chunk_start_offset=0, chunk_length=0, compressed_size=0)
                    found.append(replace(bare, message_index_offsets=offsets))
                case SummaryOffset(group_length=0):  # of attachments, which neither file has
                    pass
                case Footer() | SummaryOffset() | MetadataIndex():
                    found.append(type(record))
                case _:
                    found.append(record)
    return found


def test_the_records_are_those_that_the_writer_of_the_mcap_package_makes(tmp_path: Path) -> None:
    assert records(ours(tmp_path)) == records(theirs(tmp_path))


def test_the_places_in_the_summary_lead_to_each_message_of_a_topic(tmp_path: Path) -> None:
    with ours(tmp_path).open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        found = reader.iter_messages(topics=["/b"])
        read = [(channel.id, each.sequence, each.log_time, each.publish_time, each.data) for _, channel, each in found]
        assert [record.metadata for record in reader.iter_metadata()] == [TEXTS]
    assert read == [each for each in MESSAGES if each[0] == 2]
