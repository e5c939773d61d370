"""Reading bags: columns, names, damaged ends, bags of others."""

from collections.abc import Callable
from pathlib import Path

import numpy
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.recover import recover
from contact_sim_pkg.bag.topics import full_name
from contact_sim_pkg.bag.versions import installed_versions, version_differences, versions_of
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.records.messages import ContactForce

Record = Callable[..., Path]
Encoded = list[tuple[str, int, bytes]]


def test_messages_come_in_file_order_with_all_they_had(record: Record, encoded: Encoded) -> None:
    bag = open_bag(record())
    assert bag.complete
    assert bag.notes == []
    read = [(message.topic, message.log_time, message.data) for message in bag.messages()]
    assert read == [(f"/{topic}", stamp, data) for topic, stamp, data in encoded]


def test_one_topic_alone_and_its_count(record: Record, encoded: Encoded) -> None:
    bag = open_bag(record())
    wanted = [data for topic, _, data in encoded if topic == "tire/wrench"]
    assert [message.data for message in bag.messages("tire/wrench")] == wanted
    assert bag.count("tire/wrench") == len(wanted) == 50
    assert bag.count() == len(encoded)
    assert bag.count("seat/force") == 0


def test_scene_texts_and_end_come_from_the_bag(record: Record) -> None:
    bag = open_bag(record())
    assert bag.scene == "rig: tire\n"
    assert bag.metadata["numpy"] == "2.2.6"
    assert bag.end == 490_000_000


def test_columns_are_the_values_that_were_written(record: Record, encoded: Encoded) -> None:
    bag = open_bag(record())
    forces = [decode(ContactForce, data) for topic, _, data in encoded if topic == "tire/force"]
    columns = bag.columns("tire/force")
    assert columns["normal"].shape == (50, 10)
    assert numpy.array_equal(columns["normal"], numpy.array([force.normal for force in forces]))
    assert columns["block"].tolist() == list(range(50))
    assert columns["stamp"].dtype == numpy.int64
    assert columns["stamp"].tolist() == columns["log_time"].tolist() == [10_000_000 * block for block in range(50)]
    assert columns["time"] == pytest.approx(numpy.arange(50) * 0.01, rel=1e-15)
    assert set(columns["frame_id"]) == {"tire_contact"}


def test_nested_fields_have_names_with_dots_and_fields_can_be_chosen(record: Record) -> None:
    columns = open_bag(record()).columns("tire/wrench", ("time", "wrench.force.x"))
    assert set(columns) == {"time", "wrench.force.x"}
    assert columns["wrench.force.x"].tolist() == list(map(float, range(50)))
    with pytest.raises(BagError, match=r"WrenchStamped has no field wrench.force.w; it has"):
        open_bag(record("again")).columns("tire/wrench", ("wrench.force.w",))


def test_a_namespace_may_be_left_out_where_it_is_clear(record: Record) -> None:
    bag = open_bag(record(shown=lambda name: full_name(name, "rig2")))
    assert bag.topic("tire/force").name == "/rig2/tire/force"
    assert bag.count("tire/force") == bag.count("/rig2/tire/force") == 50
    assert bag.scene == "rig: tire\n"
    with pytest.raises(BagError, match=r"no topic called 'seat/force'; it has /rig2/bench/scene"):
        bag.topic("seat/force")


def test_a_remapped_topic_is_found_by_its_name_in_the_table_also_after_a_recovery(
    record: Record, tmp_path: Path
) -> None:
    first = record(shown=lambda name: "/rig2/left/f" if name == "tire/force" else full_name(name, "rig2"))
    recover(first, tmp_path / "recovered")
    for directory in (first, tmp_path / "recovered"):
        bag = open_bag(directory)
        assert bag.topic("tire/force").name == "/rig2/left/f"
        assert bag.count("tire/force") == 50


def test_a_remapped_topic_of_another_recorder_is_found_by_a_type_that_no_other_topic_has(record: Record) -> None:
    shown = {"road/patch": "/surface", "tire/force": "/f"}
    bag = open_bag(record(shown=lambda name: shown.get(name, full_name(name))))
    bare = {name: topic._replace(relative_name="") for name, topic in bag.topics.items()}
    bag.topics = bare  # as `ros2 bag record` leaves it
    assert bag.topic("road/patch").name == "/surface"
    assert "tire/force" not in bag  # its type is also that of the seat's


def test_names_without_a_namespace_add_nothing_to_the_bag(record: Record) -> None:
    assert b"relative_name" not in (record() / "ride_0.mcap").read_bytes()
    assert b"relative_name" in (record("again", shown=lambda name: f"/rig2/{name}") / "again_0.mcap").read_bytes()


def test_an_unfinished_bag_is_read_with_a_note_and_never_changed(record: Record, encoded: Encoded) -> None:
    directory = record(close=False)
    file = directory / "ride_0.mcap"
    before = file.read_bytes()
    bag = open_bag(directory)
    read = [(message.topic, message.log_time, message.data) for message in bag.messages()]
    assert 180 <= len(read) < len(encoded)
    assert read == [(f"/{topic}", stamp, data) for topic, stamp, data in encoded[: len(read)]]
    assert bag.count() == len(read)
    assert bag.scene == "rig: tire\n"
    assert not bag.complete
    assert f"holds {len(read)} messages up to" in bag.notes[0]
    assert file.read_bytes() == before
    assert [entry.name for entry in directory.iterdir()] == ["ride_0.mcap"]


def test_a_bag_that_is_being_recorded_is_named_as_such(record: Record, tmp_path: Path) -> None:
    left_behind = record(close=False)
    assert not any("at this moment" in note for note in open_bag(left_behind).notes)
    assert any("at this moment" in note for note in open_bag(tmp_path / "live" / "ride").notes)


def test_the_lone_file_is_enough(record: Record, tmp_path: Path, encoded: Encoded) -> None:
    lone = tmp_path / "lone.mcap"
    (record() / "ride_0.mcap").rename(lone)
    assert len(list(open_bag(lone).messages())) == len(encoded)


def test_types_come_from_the_bag_and_differences_are_reported(tmp_path: Path) -> None:
    """A bag of another version, with one field more, written by rosbags."""
    store = get_typestore(Stores.ROS2_JAZZY)
    name = "contact_msgs_defs/msg/EnergyLedger"
    store.register(get_types_from_msg("std_msgs/Header header\nuint64 block\nfloat64 heat\n", name))
    header = store.types["std_msgs/msg/Header"](store.types["builtin_interfaces/msg/Time"](3, 5), "bench")
    ledger = store.types[name]
    with Writer(tmp_path / "old", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection("/bench/energy", name, typestore=store)
        for block in range(3):
            writer.write(connection, block, store.serialize_cdr(ledger(header, block, 0.5 * block), name))
    bag = open_bag(tmp_path / "old")
    columns = bag.columns("bench/energy")
    assert columns["heat"].tolist() == [0.0, 0.5, 1.0]
    assert columns["stamp"].tolist() == [3_000_000_005] * 3
    (difference,) = version_differences(versions_of(bag), installed_versions("")).items()
    assert difference[0] == name
    with pytest.raises(BagError, match="/bench/energy was recorded with another definition"):
        bag.refuse_other_definition("bench/energy")


def test_other_versions_of_the_software_are_reported(record: Record) -> None:
    own = versions_of(open_bag(record()))
    assert version_differences(own, {"numpy": "2.2.6", "kernel_fingerprint": "0f" * 8, "python": "3.12"}) == {}
    assert version_differences(own, {"numpy": "9.9"}) == {"numpy": "2.2.6 and 9.9"}


def test_a_topic_without_messages_has_empty_columns(tmp_path: Path) -> None:
    BagWriter(tmp_path / "empty", free_bytes=lambda: 10**12).close()
    columns = open_bag(tmp_path / "empty").columns("bench/energy")
    assert "residual" in columns
    assert all(len(column) == 0 for column in columns.values())


@pytest.mark.parametrize("content", [b"", b"\x89MCAP", bytes(64)])
def test_a_file_that_is_no_bag_is_refused_with_its_content(tmp_path: Path, content: bytes) -> None:
    file = tmp_path / "x.mcap"
    file.write_bytes(content)
    with pytest.raises(BagError, match=r"x.mcap is no bag: it begins with"):
        open_bag(file)


def test_places_without_one_bag_are_refused(tmp_path: Path) -> None:
    with pytest.raises(BagError, match="cannot be opened: No such file"):
        open_bag(tmp_path / "nothing")
    with pytest.raises(BagError, match="holds no bag files"):
        open_bag(tmp_path)
    (tmp_path / "metadata.yaml").write_text("just: text\n")
    with pytest.raises(BagError, match="is no metadata of a bag"):
        open_bag(tmp_path)


def test_metadata_cannot_point_out_of_its_directory(record: Record, tmp_path: Path) -> None:
    directory = record()
    metadata = directory / "metadata.yaml"
    metadata.write_text(metadata.read_text().replace("- ride_0.mcap", "- ../../etc/other.mcap"))
    with pytest.raises(BagError, match=r"ride cannot be opened"):
        open_bag(directory)
