"""What is left beside a bag whose recorder was killed, and the words that say how to make it whole."""

import shutil

import pytest
from ruamel.yaml import YAML
from tests.nodes.blocks import LENGTH, vibration

from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.recover import recover
from contact_sim_pkg.bag.unfinished import leave_metadata
from contact_sim_pkg.bag.writer import BagWriter

TOPIC = "platform/vibration"
OUTCOME = {"ended": "failed", "failure": "bag_logger was ended by SIGKILL"}


@pytest.fixture
def cut(tmp_path):
    """A bag of 40 blocks from 30 ms on, in chunks of 10, that was never closed."""
    now = [0.0]
    writer = BagWriter(tmp_path / "bag", recorded_topics([TOPIC]), clock=lambda: now[0], background=False)
    for block in range(40):
        now[0] += 0.01
        writer.write(TOPIC, (3 + block) * LENGTH, vibration(block))
    return shutil.copytree(tmp_path / "bag", tmp_path / "cut" / "bag")  # which nobody records


def test_a_bag_without_its_end_gets_the_metadata_of_what_can_be_read(cut):
    content = next(cut.glob("*.mcap")).read_bytes()
    hint = leave_metadata(cut, OUTCOME)
    assert hint.endswith(f"make it whole: bench recover {cut} {cut}_recovered")
    assert next(cut.glob("*.mcap")).read_bytes() == content
    bag = open_bag(cut)
    kept = YAML(typ="safe").load((cut / "metadata.yaml").read_text())["rosbag2_bagfile_information"]
    assert kept["message_count"] == bag.count(TOPIC) > 0
    assert kept["starting_time"]["nanoseconds_since_epoch"] == 3 * LENGTH
    assert kept["duration"]["nanoseconds"] == bag.end - 3 * LENGTH > 0
    assert kept["custom_data"]["failure"] == OUTCOME["failure"]
    assert not bag.complete
    assert recover(cut, cut.with_name("whole")).messages == bag.count(TOPIC)


def test_a_bag_that_was_closed_is_left_as_it_is(tmp_path):
    with BagWriter(tmp_path / "bag", recorded_topics([TOPIC])) as writer:
        writer.write(TOPIC, 0, vibration(0))
    before = (tmp_path / "bag" / "metadata.yaml").read_bytes()
    assert leave_metadata(tmp_path / "bag", OUTCOME) == ""
    assert (tmp_path / "bag" / "metadata.yaml").read_bytes() == before


def test_a_file_that_is_no_bag_gets_no_metadata(tmp_path):
    assert leave_metadata(tmp_path, OUTCOME) == ""
    assert list(tmp_path.iterdir()) == []


def test_a_bag_whose_blocks_never_came_whole_is_not_complete(tmp_path):
    with BagWriter(tmp_path / "bag", recorded_topics([TOPIC])) as writer:
        writer.write(TOPIC, 0, vibration(0))
        writer.close({"lacking": "3 messages of the blocks done never came"})
    bag = open_bag(tmp_path / "bag")
    assert not bag.complete
    assert "3 messages of the blocks done never came" in bag.notes[0]
