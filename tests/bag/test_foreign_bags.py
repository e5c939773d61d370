"""The one door: bags of every format and setting give the messages of the plain one; cut ones lose what was cut."""

import subprocess
import sys
from io import BytesIO
from pathlib import Path

import pytest
import zstandard
from tests.bag import foreign

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.recover import recover

CUTS = 20


def content(bag):
    return [(message.topic, message.log_time, message.data) for message in bag.messages()]


@pytest.mark.parametrize("make", foreign.FOREIGN, ids=lambda make: make.__name__)
def test_a_foreign_bag_gives_the_messages_of_the_plain_one(make, tmp_path):
    bag = open_bag(make(tmp_path))
    assert bag.notes == []
    assert {name: row.type for name, row in bag.topics.items()} == foreign.TYPES
    assert content(bag) == foreign.ROWS
    assert (bag.count(), bag.count("/note")) == (len(foreign.ROWS), foreign.SAMPLES // 40)
    assert bag.end == foreign.ROWS[-1][1]
    columns = bag.columns("/imu")
    assert columns["linear_acceleration.y"] == pytest.approx([1e-4 * n for n in range(foreign.SAMPLES)], rel=1e-15)


def test_a_bag_of_ros_1_becomes_one_of_ros_2(tmp_path):
    bag = open_bag(foreign.ros1(tmp_path))
    assert [row[:2] for row in content(bag)] == [row[:2] for row in foreign.ROWS]
    assert [row[2] for row in content(bag)] == [row[2] for row in foreign.ROWS]
    made = recover(tmp_path / "ride.bag", tmp_path / "made")
    assert made.lossless
    assert content(open_bag(tmp_path / "made")) == foreign.ROWS


def test_messages_of_ros_1_in_an_mcap_become_those_of_ros_2(tmp_path):
    from mcap.writer import Writer

    store = foreign.get_typestore(foreign.Stores.ROS1_NOETIC)
    with open(tmp_path / "ros1.mcap", "wb") as stream:
        writer = Writer(stream)
        writer.start(profile="ros1", library="mcap convert")
        text = store.generate_msgdef(foreign.IMU, ros_version=1)[0]
        schema = writer.register_schema("sensor_msgs/Imu", "ros1msg", text.encode())
        channel = writer.register_channel("/imu", "ros1", schema)
        for number in range(20):
            data = bytes(store.serialize_ros1(foreign.imu(number, store, seq=number), foreign.IMU))
            writer.add_message(channel, number, data, number, number)
        writer.finish()
    expected = [row[2] for row in foreign.ROWS if row[0] == "/imu"][:20]
    assert [message.data for message in open_bag(tmp_path / "ros1.mcap").messages()] == expected


def whole_messages(raw: bytes) -> list[foreign.Row]:
    """Those whose bytes are all there."""
    return [row for row in foreign.ROWS if row[2] in raw]


def expected_after_cut(make, cut: bytes) -> list[foreign.Row]:
    """The messages that were not cut, by looking for their bytes: each differs from all others."""
    if make is foreign.packed_file:
        plain = BytesIO()
        stream = zstandard.ZstdDecompressor().stream_reader(BytesIO(cut))
        while block := stream.read(1 << 16):
            plain.write(block)
        return whole_messages(plain.getvalue())
    if make is foreign.sqlite_file:
        cut = cut[: len(cut) // 4096 * 4096]
    return whole_messages(cut)


@pytest.mark.parametrize(
    "make", [foreign.bare, foreign.bare_terse, foreign.sqlite_file], ids=lambda make: make.__name__
)
def test_a_cut_bag_loses_only_what_was_cut(make, tmp_path):
    source = make(tmp_path)
    raw = source.read_bytes()
    for number in range(1, CUTS + 1):
        cut = raw[: len(raw) * number // (CUTS + 1)]
        file = tmp_path / f"cut_{number}{source.suffix}"
        file.write_bytes(cut)
        target = tmp_path / f"recovered_{number}"
        made = recover(file, target)
        assert not made.lossless
        assert "cut" in made.sentence or "not finished" in made.sentence
        assert content(open_bag(target)) == expected_after_cut(make, cut), number


@pytest.mark.parametrize("make", [foreign.terse, foreign.chunked, foreign.packed_file], ids=lambda make: make.__name__)
def test_a_cut_bag_loses_at_most_the_chunk_of_the_cut(make, tmp_path):
    source = make(tmp_path)
    raw = source.read_bytes()
    for number in range(1, CUTS + 1):
        file = tmp_path / f"cut_{number}{source.suffix}"
        file.write_bytes(raw[: len(raw) * number // (CUTS + 1)])
        try:
            made = recover(file, tmp_path / f"recovered_{number}")
        except BagError:  # a first block of a packed file that cannot be unpacked
            if make is foreign.packed_file:
                continue
            raise
        found = content(open_bag(made.path))
        assert found == foreign.ROWS[: len(found)]
        # zstd packs blocks of 128 KiB; chunks hold 20 kB, some 50 messages
        slack = 128 * 1024 // 300 if make is foreign.packed_file else 70
        assert len(found) >= len(foreign.ROWS) * number // (CUTS + 1) - slack


def test_files_of_two_bags_in_one_directory_are_refused_by_name(tmp_path):
    for name in ("first.mcap", "second.mcap"):
        (tmp_path / name).write_bytes(foreign.mcap(foreign.ROWS[:5]))
    with pytest.raises(
        BagError, match=r"holds 2 bag files and no metadata.yaml \(first.mcap, second.mcap\); give the one"
    ):
        open_bag(tmp_path)


def test_a_missing_part_is_refused_and_passed_over_on_demand(tmp_path):
    directory = foreign.split(tmp_path)
    (directory / "a.mcap").unlink()
    with pytest.raises(BagError, match=r"cannot be opened: a.mcap: No such file"):
        open_bag(directory)
    bag = open_bag(directory, skip_bad=True)
    assert content(bag) == foreign.ROWS[:500] + foreign.ROWS[1100:]
    assert "a.mcap: No such file" in bag.notes[0]


def test_a_journal_beside_an_sqlite_file_is_named(tmp_path):
    file = foreign.sqlite_file(tmp_path)
    file.with_name("old.db3-wal").write_bytes(b"some pages")
    assert "old.db3-wal beside old.db3 holds messages that are not read" in open_bag(file).notes[0]


MEMORY = """
import re, sys
from pathlib import Path
from contact_sim_pkg.bag.reader import open_bag
count = sum(1 for _ in open_bag(sys.argv[1]).messages())
print(count, int(re.search(r"VmHWM:\\s+(\\d+) kB", Path("/proc/self/status").read_text()).group(1)) // 1024)
"""  # what the process itself held at most: ru_maxrss begins with that of its parent


@pytest.mark.parametrize("make", [foreign.bare, foreign.sqlite_file], ids=lambda make: make.__name__)
def test_a_large_bag_is_read_without_holding_it(make, tmp_path, monkeypatch):
    large = [("/note", foreign.BEGIN + n, b"\0\1\0\0" + bytes(1_000_000)) for n in range(300)]
    monkeypatch.setattr(foreign, "ROWS", large)
    ran = subprocess.run(
        [sys.executable, "-c", MEMORY, str(make(tmp_path))], capture_output=True, text=True, check=True
    )
    count, megabytes = map(int, ran.stdout.split())
    assert count == 300
    assert megabytes < 200


def test_bytes_spoilt_anywhere_end_in_a_sentence_or_in_messages(tmp_path):
    import random

    for make in (foreign.bare, foreign.terse, foreign.sqlite_file, foreign.packed_file, foreign.ros1):
        source = make(tmp_path)
        raw = source.read_bytes()
        for seed in range(12):
            draw = random.Random(seed)
            spoilt = bytearray(raw)
            for _ in range(draw.choice([1, 5, 50])):
                spoilt[draw.randrange(len(spoilt) if seed % 2 else 3000)] = draw.randrange(256)
            file = tmp_path / f"spoilt{source.suffix}"
            file.write_bytes(spoilt)
            try:
                bag = open_bag(Path(file), skip_bad=True)
                for message in bag.messages():
                    bag.topics[message.topic]
            except BagError:
                pass  # any other error fails the test
