"""A recovered bag is whole, holds what was readable, and says what was lost."""

from collections.abc import Callable
from pathlib import Path

import pytest
from rosbags.rosbag2 import Reader

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.recover import recover

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
