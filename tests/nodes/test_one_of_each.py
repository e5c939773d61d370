"""Each node is started once, for real: its process, its parameters, its messages, its end. What `colcon test` runs of
the nodes; the other files of this folder have the details.
"""

import signal

import pytest
from tests.bench_process import Nodes, needs_ros, resolved

from contact_sim_pkg.bag.reader import open_bag

pytestmark = needs_ros
SECONDS = 0.1  # of simulated time


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """A bag of the seat, recorded by vibration, simulator and logger in processes of their own."""
    nodes = Nodes(resolved("seat_ride", f"duration={SECONDS}", "pace=max"), tmp_path_factory.mktemp("recorded"))
    try:
        for node in ("bag_logger", "vibration", "contact_simulator"):
            nodes.start(node)
        assert nodes.wait() == {"bag_logger": 0, "vibration": 0, "contact_simulator": 0}
    finally:
        nodes.end()
    return open_bag(nodes.bag)


def test_vibration_simulator_and_logger_record_a_whole_run(recorded):
    assert recorded.complete
    blocks = round(SECONDS / 0.01)
    assert recorded.count("platform/vibration") == recorded.count("seat/force") == blocks
    assert recorded.end == pytest.approx(SECONDS * 1e9, abs=0.02e9)


def test_the_replay_sends_every_message_of_the_bag(recorded, tmp_path):
    nodes = Nodes(resolved("seat_ride"), tmp_path)
    try:
        nodes.start("bag_replay", bag=recorded.path.parent, rate=10.0)
        assert nodes.wait() == {"bag_replay": 0}
    finally:
        nodes.end()
    assert f"{recorded.count()} of {recorded.count()} messages went out" in nodes.printed[-1]


def test_the_view_shows_the_recorded_load_while_somebody_reads(recorded, tmp_path):
    from std_msgs.msg import Float64
    from tests.nodes.stand_in import StandIn

    heard: list[Float64] = []
    nodes = Nodes(resolved("seat_ride"), tmp_path)
    try:
        with StandIn("listener", "road/patch") as listener:
            view = nodes.start("bench_view")
            nodes.start("bag_replay", bag=recorded.path.parent, loop="true")
            listener.node.create_subscription(Float64, "view/seat/load", heard.append, 10)
            listener.spin_until(lambda: nodes.ended() or view.status is not None or len(heard) > 3)
            assert view.status is None
            view.process.send_signal(signal.SIGINT)
            assert nodes.wait("bench_view") == {"bench_view": 0}
    finally:
        nodes.end()
    loads = recorded.columns("seat/force")["normal"]
    assert heard
    assert {message.data for message in heard} <= set(loads.ravel().tolist())


def test_the_road_is_offered_until_the_node_is_interrupted(tmp_path):
    from tests.nodes.stand_in import StandIn

    nodes = Nodes(resolved("tire_bump"), tmp_path)
    try:
        with StandIn("listener") as listener:
            road = nodes.start("road_profile")
            listener.spin_until(lambda: nodes.ended() or listener.node.count_publishers("road/patch") == 1)
            assert not nodes.ended()
            road.process.send_signal(signal.SIGINT)
            assert nodes.wait() == {"road_profile": 0}
    finally:
        nodes.end()
