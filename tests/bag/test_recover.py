"""A recovered bag is whole, holds what was readable, and says what was lost."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy
import pytest
from mcap.reader import make_reader
from rosbags.rosbag2 import Reader
from tests.bag import hand_made
from tests.bag.conftest import encoded_block

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.recover import recover
from contact_sim_pkg.bag.writer import BagWriter

Record = Callable[..., Path]


def test_a_cut_bag_becomes_a_whole_one_with_everything_readable(record: Record, tmp_path: Path) -> None:
    source = record(close=False)
    readable = list(open_bag(source).messages())
    outcome = recover(source, tmp_path / "whole")
    assert not outcome.lossless
    assert outcome.messages == len(readable) > 0
    assert "was not finished" in outcome.sentence
    whole = open_bag(tmp_path / "whole")
    assert whole.complete
    assert list(whole.messages()) == readable
    assert whole.scene == "rig: tire\n"
    with Reader(tmp_path / "whole") as reader:
        assert reader.message_count == len(readable)
        qos = {connection.topic: connection.ext.offered_qos_profiles[0] for connection in reader.connections}  # type: ignore[union-attr]
    assert qos["/tire/force"].depth == 10


def test_a_finished_bag_is_copied_without_loss(record: Record, tmp_path: Path) -> None:
    source = record()
    outcome = recover(source, tmp_path / "copy")
    assert outcome.lossless
    assert outcome.sentence == ""
    assert list(open_bag(tmp_path / "copy").messages()) == list(open_bag(source).messages())


def test_a_bag_without_its_metadata_file_is_brought_back_whole(record: Record, tmp_path: Path) -> None:
    source = record()
    expected = (source / "metadata.yaml").read_text().count("- topic_metadata:")
    (source / "metadata.yaml").unlink()
    assert recover(source, tmp_path / "again").lossless
    assert (tmp_path / "again" / "metadata.yaml").read_text().count("- topic_metadata:") == expected == 5


def test_a_bag_that_is_being_recorded_is_left_alone(record: Record, tmp_path: Path) -> None:
    record(close=False)
    with pytest.raises(BagError, match="is being recorded at this moment"):
        recover(tmp_path / "live" / "ride", tmp_path / "early")
    assert not (tmp_path / "early").exists()


def test_the_target_is_never_overwritten(record: Record) -> None:
    source = record()
    with pytest.raises(BagError, match="exists already"):
        recover(source, source)


QUALITY = (
    "[{history: keep_last, depth: 7, reliability: best_effort, durability: volatile, deadline: {sec: 9223372036, nsec: 854775807}, "
    "lifespan: {sec: 9223372036, nsec: 854775807}, liveliness: automatic, "
    "liveliness_lease_duration: {sec: 9223372036, nsec: 854775807}, avoid_ros_namespace_conventions: false}]"
)


@pytest.fixture
def uneven(tmp_path: Path) -> Path:
    """Two topics of other quality; every message is published before it is logged, numbers begin anywhere, and of
    each topic in a chunk neither the first nor the last time is that of the chunk.
    """
    rows = [
        recorded_topics((name,))[0]._replace(offered_qos=quality)
        for name, quality in (("tire/force", QUALITY), ("road/patch", ""))
    ]
    with BagWriter(tmp_path / "uneven", rows, {"scene": "rig: tire\n"}, reserve_bytes=0, background=False) as writer:
        times = numpy.random.default_rng(2).permutation(40) * 3_000_000 + 1_790_000_000
        blocks = [
            message
            for block in range(20)
            for message in encoded_block(block)
            if message[0] in ("tire/force", "road/patch")
        ]
        for number, (time, (topic, _, data)) in enumerate(zip(times.tolist(), blocks, strict=True)):
            writer.write(topic, time, data, publish_time=time - 1000 - 7 * number, sequence=500 + 3 * number)
    return tmp_path / "uneven"


def by_mcap(bag: Path) -> dict[str, Any]:
    """What the reader of the `mcap` package finds in the file of a bag."""
    with next(bag.glob("*.mcap")).open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        summary = reader.get_summary()
        assert summary is not None
        assert summary.statistics is not None
        messages = [
            (channel.topic, each.log_time, each.publish_time, each.sequence, each.data)
            for _, channel, each in reader.iter_messages(log_time_order=False)
        ]
        late = [each.log_time for _, _, each in reader.iter_messages(starting_at=1_850_000_000)]
        texts = {record.name: dict(record.metadata) for record in reader.iter_metadata()}
        counts = summary.statistics.channel_message_counts
        return {
            "messages": messages, "late": late, "texts": texts["contact_bench"]["scene"],
            "extent": (summary.statistics.message_start_time, summary.statistics.message_end_time),
            "counts": {summary.channels[number].topic: count for number, count in counts.items()},
            "channels": [(each.topic, each.message_encoding, dict(each.metadata)) for each in summary.channels.values()],
            "types": [(each.name, each.data) for each in summary.schemas.values()],
        }  # fmt: skip


def test_times_numbers_quality_and_texts_are_brought_over_as_the_mcap_package_reads_them(
    uneven: Path, tmp_path: Path
) -> None:
    outcome = recover(uneven, tmp_path / "copy")
    assert (outcome.lossless, outcome.messages) == (True, 40)
    source, copy = by_mcap(uneven), by_mcap(tmp_path / "copy")
    assert copy == source
    times = [time for _, time, _, _, _ in copy["messages"]]
    assert copy["extent"] == (min(times), max(times)) == (1_790_000_000, 1_907_000_000)
    assert times[0] not in copy["extent"]
    assert times[-1] not in copy["extent"]
    assert copy["late"] == sorted(time for time in times if time >= 1_850_000_000)
    assert all(log != publish for _, log, publish, _, _ in copy["messages"])
    with Reader(tmp_path / "copy") as reader:
        assert (reader.start_time, reader.end_time) == (1_790_000_000, 1_907_000_001)
        depths = {
            each.topic: [profile.depth for profile in each.ext.offered_qos_profiles] for each in reader.connections
        }  # type: ignore[union-attr]
    assert depths == {"/tire/force": [7], "/road/patch": []}


def test_what_a_recovery_leaves_out_is_said(tmp_path: Path) -> None:
    content = hand_made.seat_ride()
    content.attachments = {"photo.txt": b"a seat"}
    outcome = recover(hand_made.write(tmp_path / "with", content), tmp_path / "copy")
    assert not outcome.lossless
    assert outcome.sentence == "1 MCAP attachment(s) are not brought over"
