"""`bench_view` over the real middleware: nothing is subscribed or made that nobody reads; what is read is right."""

import re
import time

import numpy
import pytest
from tests.bench_process import Nodes, needs_ros, resolved
from tests.nodes.services import connect

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.run.offline import run_offline

pytestmark = needs_ros

G = 9.81  # [m/s^2]
NO_TRANSITION = 99  # refused in every state
VIEW = "bench_view"
STAMP = 10_000_000  # [ns]
OFFERED = {"/tf", "/view/markers", "/view/imu/seat", "/view/imu/floor", "/view/joints", "/view/seat/load"}


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    path = tmp_path_factory.mktemp("viewed") / "bag"
    run_offline(resolved("seat_ride", "duration=0.5", "pace=max"), path)
    return path


@pytest.fixture
def nodes(bag, tmp_path):
    """A view and a replay without end; both end with the test."""
    started = Nodes(resolved("seat_ride"), tmp_path)
    started.view = started.start(VIEW)
    started.start("bag_replay", bag=bag, loop="true")
    yield started
    started.end()


class Reader:
    """A node of another tool."""

    def __init__(self):
        import rclpy
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.node import Node
        from rclpy.signals import SignalHandlerOptions

        self._context = rclpy.Context()
        rclpy.init(context=self._context, signal_handler_options=SignalHandlerOptions.NO)
        self.node = Node("rviz", context=self._context, start_parameter_services=False, enable_rosout=False)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)

    def read(self, topic, type_name):
        """A list that fills as this node spins, and the subscription."""
        from contact_sim_pkg.nodes.protocol.endpoints import message_type

        heard: list = []
        return heard, self.node.create_subscription(message_type(type_name), topic, heard.append, 100)

    def spin_until(self, condition, seconds=60.0):
        limit = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < limit, "timed out"
            self._executor.spin_once(timeout_sec=0.02)

    def spin(self, seconds):
        limit = time.monotonic() + seconds
        self.spin_until(lambda: time.monotonic() > limit)

    def topics_of_view(self, direction):
        """Names that the view publishes or subscribes to; none before it is in the graph."""
        try:
            names = getattr(self.node, f"get_{direction}_names_and_types_by_node")(VIEW, "/")
        except Exception:  # noqa: BLE001  # of rclpy: no such node yet
            return set()
        return {name for name, _types in names if not name.startswith(("/parameter_events", "/rosout", f"/{VIEW}"))}

    def wait_for_view(self):
        self.spin_until(lambda: self.topics_of_view("publisher") >= OFFERED)

    def close(self):
        self._executor.shutdown()
        self.node.destroy_node()
        self._context.try_shutdown()


@pytest.fixture
def reader():
    one = Reader()
    yield one
    one.close()


def test_nothing_is_subscribed_while_nobody_reads_and_what_is_read_alone(nodes, reader):
    reader.wait_for_view()
    assert not [name for name in reader.topics_of_view("publisher") if "tire" in name or "axle" in name]
    reader.spin(2.0)
    assert reader.topics_of_view("subscriber") == set()

    heard, one = reader.read("view/seat/load", "std_msgs/msg/Float64")
    reader.spin_until(lambda: len(heard) > 3)
    assert reader.topics_of_view("subscriber") == {"/seat/force"}
    _, other = reader.read("/tf", "tf2_msgs/msg/TFMessage")
    reader.spin_until(lambda: reader.topics_of_view("subscriber") == {"/seat/force", "/bench/motion", "/bench/scene"})
    for subscription in (one, other):
        reader.node.destroy_subscription(subscription)
    reader.spin_until(lambda: reader.topics_of_view("subscriber") == set())
    assert reader.node.count_subscribers("seat/force") == 0


def test_what_is_read_is_the_recorded_run(bag, nodes, reader):
    reader.wait_for_view()
    imu, _ = reader.read("view/imu/seat", "sensor_msgs/msg/Imu")
    tree, _ = reader.read("/tf", "tf2_msgs/msg/TFMessage")
    reader.spin_until(lambda: len(imu) > 20 and len(tree) > 20)
    acceleration, position = {}, {}
    for time_ns, motion in open_bag(bag).decoded("bench/motion"):
        row = motion.bodies.index("seat_frame_z")
        acceleration[time_ns] = numpy.reshape(motion.acceleration, (-1, motion.samples))[row, 0]
        position[time_ns] = numpy.reshape(motion.position, (-1, motion.samples))[row, 0]
    for message in imu:
        stamp = message.header.stamp.sec * 10**9 + message.header.stamp.nanosec
        assert message.linear_acceleration.z == acceleration[stamp] + G
        assert message.orientation_covariance[0] == -1.0
    heights = {}
    for message in tree:
        (seat,) = [each for each in message.transforms if each.child_frame_id == "seat_frame"]
        stamp = seat.header.stamp.sec * 10**9 + seat.header.stamp.nanosec
        heights[stamp] = seat.transform.translation.z - position[stamp]
    assert max(heights.values()) - min(heights.values()) < 1e-12  # one rest place


@pytest.mark.fault("B2")
def test_a_malformed_message_of_a_stranger_is_dropped_named_and_counted_and_the_next_one_is_shown(tmp_path):
    from sensor_msgs.msg import JointState
    from std_msgs.msg import Float64
    from tests.nodes.stand_in import StandIn
    from tests.standard.records import motion_of

    from contact_sim_pkg.bag.messages import encode
    from contact_sim_pkg.nodes.protocol.endpoints import publisher
    from contact_sim_pkg.records.messages import ContactForce

    def force(samples):
        values = numpy.full(samples, 512.0)
        return ContactForce(
            block=1, sample_period=1e-3, normal=values, tangential=values, approach=values, effective_height=values
        )

    motion = motion_of(("floor_z", "seat_frame_z"))
    good = {"seat/force": encode(force(10), STAMP), "bench/motion": encode(motion, STAMP)}
    bad = {
        "seat/force": (good["seat/force"][:4], good["seat/force"][:40], encode(force(0), STAMP)),
        "bench/motion": (bytes(8), encode(motion._replace(sample_period=numpy.nan), STAMP)),
    }
    heard: dict[str, list] = {topic: [] for topic in good}
    nodes = Nodes(resolved("seat_ride"), tmp_path)
    try:
        with StandIn("stranger", "seat/force") as stranger:
            nodes.start(VIEW, rate=100.0)
            sent = {"seat/force": stranger.entry, "bench/motion": publisher(stranger.node, "bench/motion")}
            stranger.node.create_subscription(Float64, "view/seat/load", heard["seat/force"].append, 10)
            stranger.node.create_subscription(JointState, "view/joints", heard["bench/motion"].append, 10)

            def send_until(topic, data, condition):
                """The view takes a message now and then, and names at most one a second."""
                stranger.spin_until(lambda: sent[topic].publish(data) or nodes.ended() or condition())
                assert not nodes.ended()

            for topic in good:
                for data in bad[topic]:
                    before = dropped(topic, nodes.printed)
                    send_until(topic, data, lambda topic=topic, before=before: dropped(topic, nodes.printed) > before)
                    heard[topic].clear()
                    send_until(topic, good[topic], lambda topic=topic: heard[topic])
    finally:
        nodes.end()
    assert heard["seat/force"][0].data == 512.0
    assert list(heard["bench/motion"][0].name) == ["floor_z", "seat_frame_z"]
    assert not [line for line in nodes.printed if "Traceback" in line]


def dropped(topic, printed):
    """How many messages of a topic the view says to have dropped."""
    return max(
        (int(count) for line in printed for count in re.findall(rf"{topic}: .*; dropped \((\d+) so far", line)),
        default=0,
    )


def test_a_signal_ends_it_with_status_0(nodes, reader):
    reader.wait_for_view()
    nodes.view.request_end()
    assert nodes.wait(VIEW) == {VIEW: 0}


def test_it_pauses_and_goes_on_as_a_lifecycle_node(nodes, reader):
    from lifecycle_msgs.msg import Transition
    from lifecycle_msgs.srv import ChangeState

    reader.wait_for_view()
    heard, _ = reader.read("view/seat/load", "std_msgs/msg/Float64")
    reader.spin_until(lambda: len(heard) > 3)
    client = reader.node.create_client(ChangeState, f"{VIEW}/change_state")
    connect(reader.spin_until, client, ChangeState.Request(transition=Transition(id=NO_TRANSITION)))

    def change(transition):
        answer = client.call_async(ChangeState.Request(transition=Transition(id=transition)))
        reader.spin_until(answer.done)
        return answer.result().success

    assert change(Transition.TRANSITION_DEACTIVATE)
    reader.spin(0.5)
    count = len(heard)
    reader.spin(1.0)
    assert len(heard) == count
    assert change(Transition.TRANSITION_ACTIVATE)
    reader.spin_until(lambda: len(heard) > count)


def test_a_run_is_recorded_whole_beside_a_view_that_was_there_before(tmp_path, reader):
    nodes = Nodes(resolved("seat_ride", "duration=4", "pace=realtime"), tmp_path / "run")
    try:
        view = nodes.start(VIEW)
        heard, _ = reader.read("view/seat/load", "std_msgs/msg/Float64")
        for node in ("bag_logger", "vibration", "contact_simulator"):
            nodes.start(node)
        reader.spin_until(lambda: (nodes.bag / "metadata.yaml").exists(), 120.0)
        reader.spin_until(lambda: len(heard) > 0)
        assert nodes.wait("bag_logger", "vibration", "contact_simulator") == dict.fromkeys(
            ("bag_logger", "vibration", "contact_simulator"), 0
        )
        assert view.status is None  # it outlives the run
        recorded = open_bag(nodes.bag)
        assert recorded.complete
        assert recorded.count("seat/force") == 400
    finally:
        nodes.end()
