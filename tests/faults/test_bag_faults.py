"""Part E of docs/faults.md, recording and disk: one test or more per row, with its number in the name."""

import errno
import itertools
import os
import random
import shutil
import signal
import struct
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import pytest
from mcap.records import Chunk
from mcap.stream_reader import StreamReader

from contact_sim_pkg.bag.errors import BagError, BagWriteError, CorruptChunkError, RecordingStoppedError
from contact_sim_pkg.bag.mcap import append_file
from contact_sim_pkg.bag.mcap.append_file import AppendFile
from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.recover import recover
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.records.messages import EnergyLedger

PLENTY = 10**12
ENERGY = ("bench/energy",)
PACKAGE_ROOT = Path(append_file.__file__).parents[3]


class Clock:
    """A steady clock that the test moves."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


def new_writer(directory: Path, clock: Callable[[], float], free: Callable[[], int] = lambda: PLENTY) -> BagWriter:
    return BagWriter(
        directory, recorded_topics(ENERGY), {"scene": "rig: seat\n"}, clock=clock, free_bytes=free, background=False
    )


def energy(block: int) -> bytes:
    rng = random.Random(block)  # incompressible values, so that files grow as they would in a run
    return encode(
        EnergyLedger(**{name: rng.random() for name in EnergyLedger._fields} | {"block": block}), block * 10_000_000
    )


def fill(writer: BagWriter, clock: Clock, blocks: range) -> None:
    """One message a block; ten blocks a chunk."""
    for block in blocks:
        clock.now = block * 0.01
        writer.write("bench/energy", block * 10_000_000, energy(block))
        writer.maintain()


@pytest.fixture
def whole(tmp_path: Path) -> Path:
    """A finished bag of 200 messages in some twenty chunks."""
    clock = Clock()
    writer = new_writer(tmp_path / "whole", clock)
    fill(writer, clock, range(200))
    assert writer.close().complete
    return tmp_path / "whole" / "whole_0.mcap"


def chunk_spans(file: Path) -> list[tuple[int, int]]:
    """Offset and length of the data of each chunk, by the mcap package."""
    with file.open("rb") as stream:
        chunks = [record for record in StreamReader(stream, emit_chunks=True).records if isinstance(record, Chunk)]
    content, spans, position = file.read_bytes(), [], 0
    for chunk in chunks:
        position = content.index(chunk.data, position)
        spans.append((position, len(chunk.data)))
        position += len(chunk.data)
    return spans


CHILD = """
import sys, time
from pathlib import Path
from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.records.messages import EnergyLedger

ledger = EnergyLedger(**dict.fromkeys(EnergyLedger._fields, 0.0) | {"block": 0})
writer = BagWriter(Path(sys.argv[1]), recorded_topics(("bench/energy",)), reserve_bytes=0)
start = time.monotonic_ns()
while True:
    now = time.monotonic_ns()
    data = encode(ledger, now - start)
    writer.write("bench/energy", now - start, data)
    sys.stdout.buffer.write((now - start).to_bytes(8, "little"))
    sys.stdout.buffer.flush()
    time.sleep(0.002)
"""


@pytest.mark.parametrize("seed", range(4))
def test_e1_a_killed_recording_loses_at_most_its_last_fifth_of_a_second(tmp_path: Path, seed: int) -> None:
    wait = random.Random(seed).uniform(0.3, 0.9)
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(PACKAGE_ROOT), os.environ.get("PYTHONPATH", "")])}
    command = [sys.executable, "-c", CHILD, str(tmp_path / "ride")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, env=environment) as child:
        assert child.stdout is not None
        first = child.stdout.read(8)
        time.sleep(wait)
        child.send_signal(signal.SIGKILL)
        told = first + child.stdout.read()
    written = [stamp for (stamp,) in struct.iter_unpack("<Q", told[: len(told) // 8 * 8])]
    bag = open_bag(tmp_path / "ride")
    read = [message.log_time for message in bag.messages()]
    assert read == written[: len(read)] or read[: len(written)] == written
    stood_still = max(later - earlier for earlier, later in itertools.pairwise(written))  # by a busy machine
    assert written[-1] - read[-1] <= 200_000_000 + 2 * stood_still
    assert f"holds {len(read)} messages up to {read[-1] / 1e9:.3f} s" in bag.notes[0]


def test_e2_after_a_power_loss_everything_older_than_a_second_is_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The file is cut at the size that it had at each sync, as a disk that kept nothing else would leave it."""
    clock, synced = Clock(), []
    real = os.fdatasync

    def note_and_sync(descriptor: int) -> None:
        synced.append((clock.now, os.fstat(descriptor).st_size))
        real(descriptor)

    monkeypatch.setattr(os, "fdatasync", note_and_sync)
    writer = new_writer(tmp_path / "ride", clock)
    fill(writer, clock, range(500))
    content = (tmp_path / "ride" / "ride_0.mcap").read_bytes()
    assert len(synced) == 4
    assert all(later - earlier >= 1.0 for (earlier, _), (later, _) in pairwise(synced))
    for moment, size in synced:
        cut = tmp_path / "cut.mcap"
        cut.write_bytes(content[:size])
        bag = open_bag(cut)
        assert list(bag.messages())[-1].log_time / 1e9 >= moment - 0.11
        assert bag.scene == "rig: seat\n"


def test_e2_a_file_that_ends_in_zeros_is_read_up_to_them(whole: Path, tmp_path: Path) -> None:
    cut = tmp_path / "zeros.mcap"
    content = whole.read_bytes()
    inside = chunk_spans(whole)[7][0] + 20
    for size in (content_of_record(whole, 7), inside):
        cut.write_bytes(content[:size] + bytes(5000))
        bag = open_bag(cut)
        blocks = [message.log_time // 10_000_000 for message in bag.messages()]
        assert blocks == list(range(len(blocks)))
        assert len(blocks) >= 60
        assert "it was not finished" in bag.notes[0]


def test_e3_a_bag_cut_anywhere_opens_with_a_whole_beginning_or_is_refused_in_one_sentence(
    whole: Path, tmp_path: Path
) -> None:
    content = whole.read_bytes()
    offsets = sorted({*range(0, 64, 7), *random.Random(3).sample(range(len(content)), 150), len(content) - 1})
    before, held = -1, 0
    for offset in offsets:
        cut = tmp_path / "cut.mcap"
        cut.write_bytes(content[:offset])
        if offset < 8:
            with pytest.raises(BagError, match="is no bag"):
                open_bag(cut)
            continue
        bag = open_bag(cut)
        blocks = [message.log_time // 10_000_000 for message in bag.messages()]
        assert blocks == list(range(len(blocks)))
        assert len(blocks) == bag.count() >= held
        assert len(bag.notes) == 1
        assert cut.read_bytes() == content[:offset]
        held, before = len(blocks), offset
    assert held == 200
    assert before == len(content) - 1


def test_e3_a_cut_bag_is_made_whole_in_a_new_file(whole: Path, tmp_path: Path) -> None:
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(whole.read_bytes()[: whole.stat().st_size // 2])
    outcome = recover(cut, tmp_path / "new")
    assert not outcome.lossless
    assert outcome.messages == open_bag(cut).count() == open_bag(tmp_path / "new").count() > 0
    assert open_bag(tmp_path / "new").complete


def test_e4_recording_is_refused_before_it_starts_when_the_disk_is_nearly_full(tmp_path: Path) -> None:
    with pytest.raises(BagError, match=r"499 MB are free for .*ride, below the reserve of 500 MB; free some space"):
        new_writer(tmp_path / "ride", Clock(), lambda: 499_000_000)
    assert list(tmp_path.iterdir()) == []


def test_e4_below_the_reserve_the_bag_is_closed_properly_and_says_so(tmp_path: Path) -> None:
    clock, free = Clock(), [PLENTY]
    writer = new_writer(tmp_path / "ride", clock, lambda: free[0])
    fill(writer, clock, range(150))
    free[0] = 400_000_000
    with pytest.raises(RecordingStoppedError, match=r"recording stopped: disk: 400 MB are free"):
        fill(writer, clock, range(150, 400))
    summary = writer.close()
    assert not summary.complete
    assert summary.sentence.startswith("recording stopped: disk")
    bag = open_bag(tmp_path / "ride")
    assert bag.complete
    assert bag.count() == summary.messages >= 150
    assert bag.metadata["stopped"] == summary.sentence


def test_e4_a_device_that_is_full_gives_one_typed_sentence() -> None:
    file = AppendFile(os.open("/dev/full", os.O_RDWR), "ride_0.mcap")
    with pytest.raises(BagWriteError, match=r"ride_0.mcap cannot grow beyond 0 bytes: No space left on device"):
        file.write(b"x")
    file.close()


LIMITED = """
import resource, signal, sys
from pathlib import Path
sys.path.insert(0, {here!r})
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
from test_bag_faults import Clock, fill, new_writer
from contact_sim_pkg.bag.errors import BagWriteError
clock = Clock()
writer = new_writer(Path(sys.argv[1]), clock)
resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))
try:
    fill(writer, clock, range(1000))
except BagWriteError as error:
    print(error)
    try:
        fill(writer, clock, range(1000, 1001))
    except BagWriteError as again:
        print(again)
summary = writer.close()
print(summary.complete, summary.messages)
print(summary.sentence)
"""


def test_e5_a_write_that_fails_is_told_at_once_and_the_verdict_says_incomplete(tmp_path: Path) -> None:
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(PACKAGE_ROOT), os.environ.get("PYTHONPATH", "")])}
    script = LIMITED.format(here=str(Path(__file__).parent))
    command = [sys.executable, "-c", script, str(tmp_path / "ride")]
    run = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=60, check=False)
    error, again, verdict, sentence = run.stdout.splitlines()
    assert run.stderr == ""
    assert "ride_0.mcap cannot grow beyond" in error
    assert os.strerror(errno.EFBIG) in error
    assert again == error
    complete, held = verdict.split()
    assert complete == "False"
    assert f"the bag holds {held} of" in sentence
    bag = open_bag(tmp_path / "ride")
    assert len(list(bag.messages())) == int(held) > 100


def test_e5_a_file_that_lost_a_part_behind_our_back_is_found_at_close(tmp_path: Path) -> None:
    clock = Clock()
    writer = new_writer(tmp_path / "ride", clock)
    fill(writer, clock, range(100))
    os.truncate(tmp_path / "ride" / "ride_0.mcap", 2000)
    summary = writer.close()
    assert not summary.complete
    assert "is not whole" in summary.sentence


def test_e6_what_exists_is_never_overwritten(tmp_path: Path, whole: Path) -> None:
    before = {file.name: file.read_bytes() for file in whole.parent.iterdir()}
    with pytest.raises(BagError, match=r"whole exists already and is never overwritten; choose another name"):
        new_writer(whole.parent, Clock())
    assert {file.name: file.read_bytes() for file in whole.parent.iterdir()} == before
    (tmp_path / "file").write_text("mine")
    with pytest.raises(BagError, match="exists already"):
        new_writer(tmp_path / "file", Clock())
    assert (tmp_path / "file").read_text() == "mine"


def test_e7_a_link_in_place_of_the_bag_is_not_followed(tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    for name, goal in (("link", tmp_path / "elsewhere"), ("dangling", tmp_path / "not_there")):
        (tmp_path / name).symlink_to(goal)
        with pytest.raises(BagError, match="exists already"):
            new_writer(tmp_path / name, Clock())
    assert list((tmp_path / "elsewhere").iterdir()) == []
    assert not (tmp_path / "not_there").exists()


def test_e7_a_file_is_created_without_following_a_link(tmp_path: Path) -> None:
    (tmp_path / "a_0.mcap").symlink_to(tmp_path / "victim")
    with pytest.raises(BagError, match="cannot be created"):
        append_file.create_file(tmp_path, "a_0.mcap")
    assert not (tmp_path / "victim").exists()


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("x" * 300, "has 300 bytes in one name, 255 are possible"),
        ("nul\0byte", "another control character in its name"),
    ],
)
def test_e7_an_impossible_directory_is_refused_in_one_sentence(tmp_path: Path, name: str, reason: str) -> None:
    with pytest.raises(BagError, match=reason) as caught:
        new_writer(tmp_path / name, Clock())
    assert "\n" not in str(caught.value)


def test_e8_a_disk_that_is_slow_to_sync_holds_up_no_message(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    clock, syncing, done = Clock(), threading.Event(), threading.Event()
    writer = new_writer(tmp_path / "ride", clock)

    def stuck(descriptor: int) -> None:
        syncing.set()
        assert done.wait(30)

    monkeypatch.setattr(os, "fdatasync", stuck)
    fill(writer, clock, range(50))
    clock.now = 2.0
    thread = threading.Thread(target=writer.maintain)
    thread.start()
    assert syncing.wait(30)
    for block in range(50, 150):  # would never return if the sync held the lock
        clock.now = 2.0 + 0.01 * block
        writer.write("bench/energy", block * 10_000_000, energy(block))
    assert thread.is_alive()
    done.set()
    thread.join()
    assert writer.close().complete
    assert open_bag(tmp_path / "ride").count() == 150


def test_e8_a_slow_disk_keeps_one_chunk_in_memory_and_loses_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each chunk takes 0.2 s to write; who records waits for it, so no queue grows and nothing is dropped."""
    clock, slow, real = Clock(), [], os.pwrite

    def delayed(descriptor: int, data: bytes, offset: int) -> int:
        if len(data) > 500:  # a chunk
            slow.append(len(data))
            time.sleep(0.2)
        return real(descriptor, data, offset)

    writer = new_writer(tmp_path / "ride", clock)
    monkeypatch.setattr(os, "pwrite", delayed)
    file = tmp_path / "ride" / "ride_0.mcap"
    for first in range(0, 48, 12):
        before = file.stat().st_size
        fill(writer, clock, range(first, first + 12))
        assert file.stat().st_size > before
    assert len(slow) >= 3
    monkeypatch.undo()
    summary = writer.close({"dropped platform/vibration": "3"})
    assert summary.complete
    bag = open_bag(tmp_path / "ride")
    assert [message.log_time for message in bag.messages()] == [block * 10_000_000 for block in range(48)]
    assert recover(bag.path, tmp_path / "again").lossless
    for path in (tmp_path / "ride", tmp_path / "again"):
        assert open_bag(path).metadata["dropped platform/vibration"] == "3"
        assert '"dropped platform/vibration": "3"' in (path / "metadata.yaml").read_text()


def test_e9_a_second_recorder_is_refused_while_the_first_goes_on(tmp_path: Path) -> None:
    clock = Clock()
    first = new_writer(tmp_path / "ride", clock)
    fill(first, clock, range(20))
    with pytest.raises(BagError, match="exists already"):
        new_writer(tmp_path / "ride", clock)
    assert append_file.is_being_written(tmp_path / "ride" / "ride_0.mcap")
    fill(first, clock, range(20, 40))
    assert first.close().complete
    assert not append_file.is_being_written(tmp_path / "ride" / "ride_0.mcap")
    assert open_bag(tmp_path / "ride").count() == 40


def test_e10_reading_stops_at_a_damaged_chunk_with_its_time_range_and_goes_on_when_told(whole: Path) -> None:
    content = whole.read_bytes()
    spans = chunk_spans(whole)
    assert len(spans) >= 15
    damaged = whole.parent / "damaged.mcap"
    for number, (offset, length) in enumerate(spans):
        flipped = bytearray(content)
        flipped[offset + length // 2] ^= 0x10
        damaged.write_bytes(flipped)
        read = []
        with pytest.raises(CorruptChunkError, match=r"messages of \d\.\d{3} s to \d\.\d{3} s, is damaged") as caught:
            read.extend(message.log_time for message in open_bag(damaged).messages())
        assert read == [10_000_000 * block for block in range(len(read))]
        assert caught.value.start == 10_000_000 * len(read)
        bag = open_bag(damaged, skip_bad=True)
        others = {message.log_time for message in bag.messages()}
        lost = {10_000_000 * block for block in range(200)} - others
        assert lost == set(range(caught.value.start, caught.value.end + 1, 10_000_000)), number
        assert not bag.complete
        assert "it was skipped" in bag.notes[0]


def test_e10_recovery_brings_over_what_is_around_a_damaged_chunk(whole: Path, tmp_path: Path) -> None:
    offset, length = chunk_spans(whole)[3]
    content = bytearray(whole.read_bytes())
    content[offset + length // 2] ^= 1
    whole.write_bytes(content)
    outcome = recover(whole, tmp_path / "rest")
    assert not outcome.lossless
    assert "is damaged" in outcome.sentence
    assert 150 < outcome.messages < 200
    assert open_bag(tmp_path / "rest").complete


@pytest.mark.parametrize("length", [2**60, 2**40, 2**63 + 5])
def test_e11_a_length_that_cannot_be_is_refused_before_anything_is_allocated(
    whole: Path, tmp_path: Path, length: int
) -> None:
    offset = content_of_record(whole, 5)
    content = bytearray(whole.read_bytes())
    content[offset + 1 : offset + 9] = length.to_bytes(8, "little")
    bombs = {"finished.mcap": bytes(content), "cut.mcap": bytes(content[:-40])}
    for name, bytes_on_disk in bombs.items():
        (tmp_path / name).write_bytes(bytes_on_disk)
    with pytest.raises(CorruptChunkError, match="is damaged"):
        list(open_bag(tmp_path / "finished.mcap").messages())
    cut = open_bag(tmp_path / "cut.mcap")
    assert f"claims {length} bytes, limit" in cut.notes[0]
    assert 0 < len(list(cut.messages())) < 200


def test_e10_messages_whose_topic_was_in_the_damaged_part_are_counted(whole: Path, tmp_path: Path) -> None:
    offset, length = chunk_spans(whole)[0]
    content = bytearray(whole.read_bytes()[: chunk_spans(whole)[9][0]])
    content[offset + length // 2] ^= 1
    (tmp_path / "cut.mcap").write_bytes(content)
    bag = open_bag(tmp_path / "cut.mcap", skip_bad=True)
    assert list(bag.messages()) == []
    assert any("messages of cut.mcap cannot be read" in note for note in bag.notes)


def content_of_record(file: Path, number: int) -> int:
    """Offset of the head of a chunk record: 9 bytes of head and 44 of fields (compression zstd) before its data."""
    start = chunk_spans(file)[number][0] - 9 - 44
    assert file.read_bytes()[start] == 6
    return start


def test_e11_a_chunk_that_claims_to_unpack_to_a_bomb_is_refused(whole: Path, tmp_path: Path) -> None:
    start = content_of_record(whole, 2)
    for size in (2**60, 2**28 + 1, 100):
        content = bytearray(whole.read_bytes())
        content[start + 25 : start + 33] = size.to_bytes(8, "little")
        bomb = tmp_path / "bomb.mcap"
        bomb.write_bytes(content)
        with pytest.raises(CorruptChunkError, match="is damaged"):
            list(open_bag(bomb).messages())


def test_e11_any_flipped_byte_gives_a_bag_or_a_bag_error_and_nothing_else(whole: Path, tmp_path: Path) -> None:
    content = whole.read_bytes()
    rng = random.Random(11)
    for position in rng.sample(range(len(content)), 300):
        flipped = bytearray(content)
        flipped[position] ^= 1 << rng.randrange(8)
        file = tmp_path / "flipped.mcap"
        file.write_bytes(flipped)
        try:
            blocks = [message.log_time // 10_000_000 for message in open_bag(file, skip_bad=True).messages()]
        except BagError:
            continue
        assert set(blocks) <= set(range(200))


def test_e12_the_bag_carries_what_is_needed_to_tell_versions_apart(whole: Path) -> None:
    shutil.move(whole, whole.with_name("alone.mcap"))
    bag = open_bag(whole.with_name("alone.mcap"))
    row = bag.topic("bench/energy")
    assert row.type_hash.startswith("RIHS01_")
    assert "supplied = kinetic + potential + stored + dissipated + residual" in row.definition
    assert bag.scene == "rig: seat\n"
