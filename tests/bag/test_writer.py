"""What the writer puts on disk, read back by rosbags and, independently, by mcap with mcap-ros2-support."""

import os
import threading
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mcap.reader import make_reader
from mcap.records import Chunk
from mcap.stream_reader import StreamReader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader
from rosbags.interfaces import QosDurability
from rosbags.rosbag2 import Reader
from ruamel.yaml import YAML

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.mcap.chunked_file import CHUNK_BYTES
from contact_sim_pkg.bag.metadata import Extent, metadata_text, recorded_topics
from contact_sim_pkg.bag.topics import RECORDED, full_name
from contact_sim_pkg.bag.typestore import type_hash
from contact_sim_pkg.bag.writer import BagWriter

Record = Callable[..., Path]
Encoded = list[tuple[str, int, bytes]]


def chunks_of(bag: Path) -> list[Chunk]:
    """The chunks of a bag, by the mcap package."""
    with (bag / f"{bag.name}_0.mcap").open("rb") as file:
        return [record for record in StreamReader(file, emit_chunks=True).records if isinstance(record, Chunk)]


def test_rosbags_reads_every_message_as_it_was_written(record: Record, encoded: Encoded) -> None:
    with AnyReader([record()]) as reader:
        read = [(connection.topic, time, bytes(data)) for connection, time, data in reader.messages()]
        loads = [
            reader.deserialize(data, connection.msgtype).normal  # type: ignore[attr-defined]
            for connection, _, data in reader.messages([c for c in reader.connections if c.topic == "/tire/force"])
        ]
    assert Counter(read) == Counter((f"/{topic}", stamp, data) for topic, stamp, data in encoded)
    assert len(loads) == 50
    assert all(len(load) == 10 for load in loads)


def test_mcap_with_its_own_decoder_reads_every_message_in_order(record: Record, encoded: Encoded) -> None:
    bag = record()
    with (bag / "ride_0.mcap").open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        read = list(reader.iter_decoded_messages(log_time_order=False))
    assert [(item.channel.topic, item.message.log_time, item.message.data) for item in read] == [
        (f"/{topic}", stamp, data) for topic, stamp, data in encoded
    ]
    patches = [item.decoded_message for item in read if item.channel.topic == "/road/patch"]
    assert [patch.block for patch in patches] == list(range(50))
    numbers = [item.message.sequence for item in read if item.channel.topic == "/tire/wrench"]
    assert numbers == list(range(50))


def test_rosbags_reads_the_metadata_file(record: Record) -> None:
    with Reader(record()) as reader:
        assert reader.message_count == 201
        assert (reader.start_time, reader.end_time) == (0, 490_000_001)
        assert reader.ros_distro == "jazzy"
        assert reader.storage.metadata.custom == {
            "scene": "rig: tire\n",
            "numpy": "2.2.6",
            "kernel_fingerprint": "0f" * 8,
        }
        connections = {connection.topic: connection for connection in reader.connections}
    scene = connections["/bench/scene"]
    assert scene.ext.offered_qos_profiles[0].durability == QosDurability.TRANSIENT_LOCAL  # type: ignore[union-attr]
    assert connections["/tire/patch"].digest == type_hash("contact_msgs_defs/msg/ContactPatch")
    assert connections["/tire/patch"].msgcount == 50


def test_the_file_alone_has_profile_quality_of_service_hash_and_scene(record: Record) -> None:
    with (record() / "ride_0.mcap").open("rb") as file:
        reader = make_reader(file)
        assert reader.get_header().profile == "ros2"
        summary = reader.get_summary()
        records = {entry.name: entry.metadata for entry in reader.iter_metadata()}
    assert summary is not None
    channel = next(entry for entry in summary.channels.values() if entry.topic == "/tire/force")
    assert channel.metadata["topic_type_hash"] == type_hash("contact_msgs_defs/msg/ContactForce")
    assert "reliability: reliable" in channel.metadata["offered_qos_profiles"]
    assert summary.schemas[channel.schema_id].encoding == "ros2msg"
    assert records["contact_bench"]["scene"] == "rig: tire\n"
    information = YAML(typ="safe").load(records["rosbag2"]["serialized_metadata"])
    assert information["message_count"] == 201


def test_a_namespace_is_in_front_of_recorded_names(record: Record) -> None:
    with Reader(record(shown=lambda name: full_name(name, "rig2"))) as reader:
        assert "/rig2/tire/force" in reader.topics


@pytest.mark.fault("G6")
def test_a_bag_has_nothing_about_the_machine(record: Record) -> None:
    bag = record()
    content = b"".join(file.read_bytes() for file in bag.iterdir())
    for secret in (str(bag.parent), str(Path.home()), os.environ.get("HOSTNAME", "\0no such text")):
        assert secret == "/" or secret.encode() not in content


def test_two_recordings_of_the_same_messages_are_equal(record: Record) -> None:
    contents = []
    for name in ("first", "second"):
        bag = record(name)
        with (bag / f"{name}_0.mcap").open("rb") as file:
            found = make_reader(file).iter_messages(log_time_order=False)
            contents.append([(c.topic, s.name, m.log_time, m.publish_time, m.sequence, m.data) for s, c, m in found])
    assert contents[0] == contents[1]
    assert len(contents[0]) == 201


def test_a_chunk_is_closed_a_tenth_of_a_second_after_its_first_message(record: Record) -> None:
    chunks = chunks_of(record())
    assert len(chunks) == 10
    assert max(chunk.message_end_time - chunk.message_start_time for chunk in chunks) <= 60_000_000


def test_a_chunk_is_closed_by_size_however_fast_messages_come(tmp_path: Path) -> None:
    writer = BagWriter(tmp_path / "big", clock=lambda: 0.0, free_bytes=lambda: 10**12, background=False)
    for stamp in range(100):
        writer.write("tire/patch", stamp, bytes(300_000))
    assert writer.close().complete
    sizes = [chunk.uncompressed_size for chunk in chunks_of(tmp_path / "big")]
    assert len(sizes) >= 7
    assert max(sizes) <= CHUNK_BYTES + 301_000


def test_the_writers_own_thread_closes_the_chunk_of_a_caller_that_is_busy(tmp_path: Path) -> None:
    written = threading.Event()
    with BagWriter(tmp_path / "busy", free_bytes=lambda: 10**12) as writer:
        file = tmp_path / "busy" / "busy_0.mcap"
        before = file.stat().st_size
        writer.write("tire/patch", 0, bytes(100))
        for _ in range(200):
            if file.stat().st_size > before:
                written.set()
                break
            threading.Event().wait(0.05)
    assert written.is_set()


def test_messages_from_two_threads_are_all_kept(tmp_path: Path) -> None:
    writer = BagWriter(tmp_path / "two", free_bytes=lambda: 10**12)

    def write(topic: str) -> None:
        for stamp in range(500):
            writer.write(topic, stamp, bytes(64))

    threads = [threading.Thread(target=write, args=(topic,)) for topic in ("tire/force", "seat/force")]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    summary = writer.close()
    assert summary.complete
    assert (summary.counts["tire/force"], summary.counts["seat/force"]) == (500, 500)


def test_closing_twice_gives_the_same_summary_and_writing_after_it_is_refused(tmp_path: Path) -> None:
    writer = BagWriter(tmp_path / "once", free_bytes=lambda: 10**12, background=False)
    writer.write("tire/force", 0, bytes(8))
    assert writer.close() == writer.close({"ignored": "now"})
    with pytest.raises(BagError, match="is closed"):
        writer.write("tire/force", 1, bytes(8))


def test_a_topic_that_is_not_recorded_is_refused_by_name(tmp_path: Path) -> None:
    topics = recorded_topics(["tire/force"])
    with (
        BagWriter(tmp_path / "few", topics, free_bytes=lambda: 10**12) as writer,
        pytest.raises(BagError, match=r"'bench/progress' is not recorded in .*recorded are tire/force"),
    ):
        writer.write("bench/progress", 0, bytes(8))


def test_a_bag_without_messages_is_whole_and_readable(tmp_path: Path) -> None:
    summary = BagWriter(tmp_path / "empty", free_bytes=lambda: 10**12).close({"ended": "stopped by the user"})
    assert summary.complete
    assert summary.messages == 0
    with Reader(tmp_path / "empty") as reader:
        assert reader.message_count == 0
        assert reader.storage.metadata.custom == {"ended": "stopped by the user"}


@given(texts=st.dictionaries(st.text(min_size=1), st.text(st.characters(exclude_categories=("Cs",))), max_size=4))
def test_any_attached_text_reads_back_from_the_metadata_file(texts: dict[str, str]) -> None:
    topics = recorded_topics(RECORDED[:2])
    text = metadata_text("a_0.mcap", topics, {topic.key: 0 for topic in topics}, Extent(0, 0), texts)
    assert (YAML(typ="safe").load(text)["rosbag2_bagfile_information"]["custom_data"] or {}) == texts
