"""The table of topics against the rules of ROS names, and its quality of service as rosbags reads it."""

import pytest
from rosbags.interfaces import QosDurability, QosHistory, QosReliability
from rosbags.rosbag2.metadata import parse_qos

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.topics import RECORDED, TOPICS, full_name, offered_qos, topic_of
from contact_sim_pkg.bag.typestore import installed_types
from contact_sim_pkg.records import registry
from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.topic import FORCE, PATCH, ContactTopic


def test_names_are_relative_except_the_two_that_ros_shares() -> None:
    assert {name for name in TOPICS if name.startswith("/")} == {"/clock", "/diagnostics"}
    assert all(name == name.lower() and " " not in name for name in TOPICS)


def test_ranks_are_the_positions_and_the_scene_comes_first() -> None:
    assert [topic.rank for topic in TOPICS.values()] == list(range(len(TOPICS)))
    assert RECORDED[0] == "bench/scene"
    assert topic_of("road/patch").rank < topic_of("tire/force").rank


def test_a_further_contact_leaves_the_order_of_the_other_topics(monkeypatch: pytest.MonkeyPatch) -> None:
    before, contacts = [topic.name for topic in registry.contact_topics()], registry.contacts()
    added = (FORCE, PATCH, ContactTopic("momentum", "contact_msgs_defs/msg/BodyMotion"))
    punch = Contact(name="punch", help="", section="", section_help="", effects=(), topics=added)
    monkeypatch.setattr(registry, "contacts", lambda: {**contacts, "punch": punch})
    names = [topic.name for topic in registry.contact_topics()]
    assert [name for name in names if not name.startswith("punch/")] == before
    assert names.index("roller/force") < names.index("punch/force") < names.index("tire/wrench")
    assert names[-1] == "punch/momentum"


def test_every_type_is_known() -> None:
    assert {topic.type for topic in TOPICS.values()} <= set(installed_types().fielddefs)


def test_of_what_is_recorded_only_the_cost_reports_wall_time() -> None:
    assert [name for name in RECORDED if TOPICS[name].wall_time] == ["bench/cost"]


@pytest.mark.parametrize("name", TOPICS)
def test_quality_of_service_is_read_by_rosbags_as_in_the_table(name: str) -> None:
    (profile,) = parse_qos(offered_qos(TOPICS[name]))
    assert profile.history == QosHistory.KEEP_LAST
    assert profile.depth == TOPICS[name].depth
    assert profile.reliability == QosReliability[TOPICS[name].reliability.upper()]
    assert profile.durability == QosDurability[TOPICS[name].durability.upper()]


def test_a_namespace_goes_in_front_of_relative_names_only() -> None:
    assert full_name("tire/force") == "/tire/force"
    assert full_name("tire/force", "/left/rig/") == "/left/rig/tire/force"
    assert full_name("/clock", "rig") == "/clock"


def test_an_unknown_topic_is_named() -> None:
    with pytest.raises(BagError, match=r"no topic is called 'tyre/force'"):
        topic_of("tyre/force")
