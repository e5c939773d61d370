"""Who counts as the recorder of a result before a run is ready: the logger, and no viewer that was there before."""

from types import SimpleNamespace

import pytest
from tests.bench_process import needs_ros

pytestmark = needs_ros


@pytest.fixture
def peers():
    """The simulator's view of a graph in which the readers of `seat/force` are given; what it lacks."""
    from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

    from contact_sim_pkg.nodes.protocol.peers import Peers

    reliable = QoSProfile(depth=10)
    profiles = {
        "reliable": reliable,
        "best effort": QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT),
        "latched": QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL),
    }

    def info(name, profile="reliable"):
        return SimpleNamespace(
            node_name=name, node_namespace="/", qos_profile=profiles[profile], topic_type_hash="same", endpoint_gid=[1]
        )

    def lacking(*readers, matched):
        infos = {
            "bench/recorded": [info("bag_logger")], "bench/progress": [info("contact_simulator")],
            "seat/force": [info("contact_simulator")],
        }  # fmt: skip
        node = SimpleNamespace(
            get_name=lambda: "contact_simulator",
            get_publishers_info_by_topic=lambda name: infos[name],
            get_subscriptions_info_by_topic=lambda name: (
                [info(*reader) for reader in readers] if "seat" in name else []
            ),
            count_publishers=lambda name: len(infos[name]),
        )
        entry = SimpleNamespace(topic_name="seat/force", qos_profile=reliable, get_subscription_count=lambda: matched)
        progress = SimpleNamespace(get_subscription_count=lambda: 1)
        recorded = SimpleNamespace(topic_name="bench/recorded")
        looking = Peers(node, {}, {"seat/force": entry}, progress, recorded, supervised=False)
        return looking._missing(unnamed=False)

    return lacking


RECORDER = ["a recorder of seat/force"]


def test_the_logger_is_waited_for_where_a_viewer_is_matched(peers):
    assert peers(("bench_view", "best effort"), matched=1) == RECORDER
    assert (
        peers(("bench_view", "best effort"), ("bag_logger",), matched=1) == RECORDER
    )  # one of two: which is not known
    assert peers(("bench_view", "best effort"), ("bag_logger",), matched=2) == []


def test_a_logger_alone_is_enough_once_it_is_matched(peers):
    assert peers(("bag_logger",), matched=0) == RECORDER
    assert peers(("bag_logger",), matched=1) == []


def test_a_reader_that_cannot_be_served_is_not_waited_for(peers):
    assert peers(("bag_logger",), ("rviz", "latched"), matched=1) == []
