"""The instant of a bag in wall time is read as data: what is no instant is refused."""

import pytest

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.metadata import WALL_TIME, recorded_topics, wall_time_of
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.recover import recover
from contact_sim_pkg.bag.writer import BagWriter

BEGAN = 1_777_890_600_000_000_000


def test_a_bag_without_the_text_is_in_simulated_time():
    assert wall_time_of({}) == 0
    assert wall_time_of({WALL_TIME: str(BEGAN)}) == BEGAN


@pytest.mark.parametrize("text", ["", "-5", "1.5", "now", "9223372036854775808", "²"])
def test_what_is_no_instant_is_refused_and_no_bag_is_left(tmp_path, text):
    with pytest.raises(BagError, match=f"give {WALL_TIME} as"):
        BagWriter(tmp_path / "bag", attachments={WALL_TIME: text}, reserve_bytes=0)
    assert not (tmp_path / "bag").exists()


def test_a_recovered_bag_stays_in_wall_time(tmp_path):
    with BagWriter(
        tmp_path / "bag", recorded_topics(["tire/force"]), {WALL_TIME: str(BEGAN)}, reserve_bytes=0
    ) as writer:
        writer.write("tire/force", 10, b"\0\1\0\0abcd", publish_time=20)
    assert recover(tmp_path / "bag", tmp_path / "again").lossless
    for path in ("bag", "again"):
        (message,) = open_bag(tmp_path / path).messages()
        assert (message.log_time, message.publish_time) == (10, 20)
        assert f"nanoseconds_since_epoch: {BEGAN + 10}" in (tmp_path / path / "metadata.yaml").read_text()
