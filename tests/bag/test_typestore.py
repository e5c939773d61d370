"""Definitions and hashes against those of ROS itself and an independent parser."""

import json
import os
from pathlib import Path

import pytest
from mcap.records import Schema
from mcap_ros2.decoder import DecoderFactory
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.bag.typestore import definition, store_of_definition, type_hash
from contact_sim_pkg.records.definitions import STANDARD

OURS = sorted({topic.type for topic in TOPICS.values() if topic.type.startswith("contact_msgs_defs")})


def test_hashes_of_standard_types_are_those_of_ros_jazzy() -> None:
    assert type_hash("std_msgs/msg/String") == "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
    assert (
        type_hash("geometry_msgs/msg/WrenchStamped")
        == "RIHS01_8dc3deaf06b2ab281f9f9a742a8961c328ca7cec16e3fd6586d3a5c83fa78f77"
    )


@pytest.mark.parametrize("name", OURS)
def test_hashes_of_our_types_are_those_of_the_built_interfaces(name: str) -> None:
    shares = [Path(prefix, "share/contact_msgs_defs") for prefix in os.environ.get("AMENT_PREFIX_PATH", "").split(":")]
    built = [share / "msg" / f"{name.split('/')[-1]}.json" for share in shares]
    found = next((file for file in built if file.is_file()), None)
    if found is None:
        pytest.skip("contact_msgs_defs is not built and sourced here")
    hashes = {entry["type_name"]: entry["hash_string"] for entry in json.loads(found.read_text())["type_hashes"]}
    assert type_hash(name) == hashes[name]


@pytest.mark.parametrize("name", sorted({topic.type for topic in TOPICS.values()}))
def test_definitions_are_complete_for_an_independent_parser(name: str) -> None:
    schema = Schema(id=1, name=name, encoding="ros2msg", data=definition(name).encode())
    assert DecoderFactory().decoder_for("cdr", schema) is not None


@pytest.mark.parametrize("name", OURS)
def test_definitions_keep_the_comments_with_the_units(name: str) -> None:
    assert "stamp: simulated time" in definition(name)


def test_types_come_from_the_given_definitions_and_not_from_the_installed_ones() -> None:
    name = "contact_msgs_defs/msg/EnergyLedger"
    store = store_of_definition(name, "uint8 only_this\n")
    assert [field for field, _ in store.fielddefs[name][1]] == ["only_this"]


def test_a_hash_changes_with_the_definition() -> None:
    store = get_typestore(Stores.ROS2_JAZZY)
    store.register(get_types_from_msg("std_msgs/Header header\nuint64 block\n", "contact_msgs_defs/msg/SolverCost"))
    assert store.hash_rihs01("contact_msgs_defs/msg/SolverCost") != type_hash("contact_msgs_defs/msg/SolverCost")


@pytest.mark.parametrize("text", ["float64[ x\n", "b_pkg/Missing part\n"])
def test_a_definition_that_is_broken_or_lacks_a_part_is_refused_by_name(text: str) -> None:
    with pytest.raises(BagError, match=r"definition of 'a_pkg/msg/Bad' cannot be used"):
        store_of_definition("a_pkg/msg/Bad", text)


@pytest.mark.parametrize("name", sorted(STANDARD))
def test_a_standard_type_is_the_one_of_jazzy(name):
    assert type_hash(name) == get_typestore(Stores.ROS2_JAZZY).hash_rihs01(name)
