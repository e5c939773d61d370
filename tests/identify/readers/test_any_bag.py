"""Bags of other people's tools: whole, without metadata, cut, damaged, empty."""

import contextlib
import random

import numpy
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from tests.identify import foreign_bag

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.identify.readers.body_states import read_body_states

SAMPLES = 3000
TIME = 1e-3 * numpy.arange(SAMPLES)
STATES = (
    TIME, numpy.stack([TIME, 2.0 * TIME, 1.0 - TIME], axis=1), numpy.repeat(numpy.eye(3)[None], SAMPLES, axis=0),
    numpy.tile([1.0, 2.0, -1.0], (SAMPLES, 1)), numpy.zeros((SAMPLES, 3)),
)  # fmt: skip


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """An MCAP bag of Odometry, in several chunks."""
    path = tmp_path_factory.mktemp("bags") / "whole"
    foreign_bag.write_odometry(path, STATES)
    return path


def changed(whole, tmp_path, change):
    """A copy of the bag with other bytes in its file."""
    copy = tmp_path / "copy"
    copy.mkdir()
    for file in whole.iterdir():
        data = file.read_bytes()
        (copy / file.name).write_bytes(change(data) if file.suffix == ".mcap" else data)
    return copy


def test_a_whole_bag_is_read_without_a_note(whole):
    recorded = read_body_states(whole)
    assert recorded.notes == ()
    assert recorded.states.position == pytest.approx(STATES[1], abs=1e-12)


def test_a_directory_without_metadata_is_read_by_its_only_file(whole, tmp_path):
    copy = changed(whole, tmp_path, lambda data: data)
    (copy / "metadata.yaml").unlink()
    assert len(read_body_states(copy).states.time) == SAMPLES


def test_a_cut_bag_is_read_up_to_the_cut_and_says_so(whole, tmp_path):
    recorded = read_body_states(changed(whole, tmp_path, lambda data: data[: 6 * len(data) // 10]))
    count = len(recorded.states.time)
    assert 0.3 * SAMPLES < count < 0.7 * SAMPLES
    assert recorded.states.velocity == pytest.approx(STATES[3][:count], abs=1e-12)
    assert "it was not finished" in recorded.notes[0]


def test_a_bag_of_which_nothing_is_left_is_refused(whole, tmp_path):
    with pytest.raises(BagError, match=r"nothing can be read|cannot be read"):
        read_body_states(changed(whole, tmp_path, lambda data: data[:200]))


@pytest.mark.parametrize("seed", range(25))
def test_damaged_bytes_end_in_a_sentence_or_in_states(whole, tmp_path, seed):
    draw = random.Random(seed)

    def spoil(data):
        spoiled = bytearray(data)
        for _ in range(draw.choice([1, 5, 50])):
            spoiled[draw.randrange(len(spoiled) if seed % 2 else 3000)] = draw.randrange(256)
        return bytes(spoiled)

    with contextlib.suppress(BagError):  # any other error fails the test
        assert len(read_body_states(changed(whole, tmp_path, spoil)).states.time) > 0


def test_poses_whose_twists_were_never_sent_are_refused(tmp_path):
    kind, store = "geometry_msgs/msg/PoseStamped", foreign_bag.STORE
    with Writer(tmp_path / "bag", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        row = writer.add_connection("/pose", kind, typestore=store)
        writer.add_connection("/twist", "geometry_msgs/msg/TwistStamped", typestore=store)
        pose = foreign_bag._pose([0.0, 0.0, 1.0], numpy.eye(3))
        message = store.types[kind](foreign_bag._header(0.0, "map"), pose)
        writer.write(row, foreign_bag.ORIGIN, store.serialize_cdr(message, kind))
    with pytest.raises(BagError, match=r"/twist of .* holds no message"):
        read_body_states(tmp_path / "bag")
