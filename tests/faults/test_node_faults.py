"""Nodes in this process: set-up that fails half-way, callbacks that raise, parameters set while running (FAULTS B, C, F)."""

import ast
import signal
from types import SimpleNamespace

import pytest
from tests.bench_process import PACKAGE, Nodes, messages, needs_ros, resolved

pytestmark = needs_ros

NODES = ("bag_logger", "bag_replay", "contact_simulator", "road_profile", "vibration")
OF_RCLPY = {"use_sim_time", "start_type_description_service"}


@pytest.fixture
def ros():
    """Starts rclpy with ROS arguments; signals and rclpy are as before afterwards."""
    import rclpy
    from rclpy.signals import SignalHandlerOptions

    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}

    def start(**parameters: object) -> None:
        arguments = [text for name, value in parameters.items() for text in ("-p", f"{name}:={value}")]
        rclpy.init(args=["--ros-args", *arguments], signal_handler_options=SignalHandlerOptions.NO)

    yield start
    rclpy.try_shutdown()
    for number, handler in before.items():
        signal.signal(number, handler)


def class_of(node: str):
    module = __import__(f"contact_sim_pkg.nodes.{node}", fromlist=["main"])
    name = {"bag_logger": "BagLogger", "bag_replay": "BagReplay", "contact_simulator": "ContactSimulator"}.get(node)
    return getattr(module, f"{name or node.title().replace('_', '')}Node")


class Failing:
    """Raises at the n-th creation of a publisher or subscription of a node."""

    def __init__(self, node, point: int):
        self.created, self._point = 0, point
        for name in ("create_publisher", "create_subscription"):
            setattr(node, name, self._counted(getattr(node, name)))

    def _counted(self, create):
        def counted(*arguments, **options):
            from contact_sim_pkg.nodes.protocol.states import NodeError

            self.created += 1
            if self.created == self._point:
                raise NodeError(f"injected at {self._point}", 2)
            return create(*arguments, **options)

        return counted


def endpoints(node) -> int:
    return len([*node.publishers, *node.subscriptions])


@pytest.mark.fault("F5")
@pytest.mark.parametrize("name", ["contact_simulator", "bag_logger"])
def test_a_set_up_that_fails_at_any_point_gives_everything_back_and_can_be_tried_again(
    ros, name, monkeypatch, tmp_path
):
    from rclpy.lifecycle import TransitionCallbackReturn

    from contact_sim_pkg.nodes import contact_simulator

    simulation = SimpleNamespace(inputs=("platform/vibration",), blocks=3, prepare=lambda: None)
    monkeypatch.setattr(contact_simulator, "make_simulation", lambda scene: simulation)
    bag = {"bag": tmp_path / "bag"} if name == "bag_logger" else {}
    ros(scene="seat_ride", autostart="false", **bag)
    node = class_of(name)()
    try:
        before = endpoints(node)
        create = node.create_publisher, node.create_subscription
        for point in range(1, 100):
            node.create_publisher, node.create_subscription = create
            failing = Failing(node, point)
            if node.on_configure(None) == TransitionCallbackReturn.SUCCESS:
                break
            assert endpoints(node) == before
            assert node.exit_status is None
        assert point == failing.created + 1 > 8
        assert endpoints(node) == before + failing.created
        assert node.on_cleanup(None) == TransitionCallbackReturn.SUCCESS
        assert endpoints(node) == before
        assert not (tmp_path / "bag").exists()
    finally:
        node.destroy_node()


@pytest.mark.fault("B11")
def test_an_unexpected_exception_of_a_callback_is_said_once_and_ends_the_node(ros, capfd):
    """The bag is closed by `fault`, and nothing is done after it."""
    from contact_sim_pkg.nodes.bench_node import LifecycleBenchNode
    from contact_sim_pkg.nodes.clock import clock_message
    from contact_sim_pkg.nodes.processes.process import run
    from contact_sim_pkg.nodes.protocol.endpoints import publisher, subscription

    done: list[str] = []

    class Raising(LifecycleBenchNode):
        def __init__(self):
            super().__init__("raising")

        def configure(self):
            self.entries = publisher(self, "/clock"), subscription(self, "/clock", self.raises)

        def raises(self, data):
            done.append("raised")
            raise ValueError("injected")

        def tick(self, now):
            assert "closed" not in done
            self.entries[0].publish(clock_message(0))
            return 0.01

        def close(self):
            done.append("closed")

    assert run(Raising, args=[]) == 1
    said = capfd.readouterr().err
    assert said.count("Traceback") == 1
    assert "unexpected ValueError: injected" in said
    assert done[-1] == "closed"


@pytest.mark.fault("B12")
@pytest.mark.parametrize("name", NODES)
def test_no_parameter_can_be_set_while_a_node_lives(ros, name):
    """In any state: all are read at the start, and their descriptions say read-only."""
    from rclpy.parameter import Parameter

    scene = {} if name == "bag_replay" else {"scene": "tire_bump" if name == "road_profile" else "seat_ride"}
    ros(**scene, **({"autostart": "false"} if name in NODES[:3] else {}))
    node = class_of(name)()
    try:
        parameters = [each for each in node._parameters.values() if each.name not in OF_RCLPY]
        assert len(parameters) >= 4
        for result in node.set_parameters([Parameter(each.name, value=each.value) for each in parameters]):
            assert not result.successful
            assert "read-only" in result.reason
    finally:
        node.destroy_node()


@pytest.mark.fault("C2")
def test_a_clock_that_jumps_and_stops_changes_no_bit(tmp_path):
    """No node waits for `/clock`; with `use_sim_time` it is heard, and jumps back by 10 s again and again, then stops."""
    from tests.nodes.stand_in import StandIn

    from contact_sim_pkg.nodes.clock import clock_message
    from contact_sim_pkg.run.offline import run_offline

    scene = resolved("seat_ride", "duration=0.3", "pace=max")
    nodes = Nodes(scene, tmp_path)
    try:
        with StandIn("clock", topic="/clock") as clock:
            for node in ("bag_logger", "vibration"):
                nodes.start(node, use_sim_time="true")
            nodes.start("contact_simulator", use_sim_time="true", publish_clock="false")
            clock.spin_until(lambda: clock.entry.get_subscription_count() >= 3)
            for number in range(100):
                clock.entry.publish(clock_message((20 - 10 * (number % 2)) * 1_000_000_000 + number))
            assert nodes.wait() == {"bag_logger": 0, "vibration": 0, "contact_simulator": 0}
    finally:
        nodes.end()
    run_offline(scene, tmp_path / "offline")
    assert messages(nodes.bag) == messages(tmp_path / "offline")


@pytest.mark.fault("C2")
def test_no_node_has_a_timer_that_a_clock_could_stop():
    for file in (PACKAGE / "contact_sim_pkg" / "nodes").rglob("*.py"):
        names = {node.attr for node in ast.walk(ast.parse(file.read_text())) if isinstance(node, ast.Attribute)}
        assert not names & {"create_timer", "create_rate", "sleep_for", "sleep_until"}, file


@pytest.mark.fault("F6")
def test_a_hundred_starts_and_ends_under_messages_say_nothing(ros, capfd):
    """Nodes are destroyed after their executor has returned, so no callback runs meanwhile."""
    from contact_sim_pkg.nodes.bench_node import LifecycleBenchNode
    from contact_sim_pkg.nodes.clock import clock_message
    from contact_sim_pkg.nodes.processes.process import run
    from contact_sim_pkg.nodes.protocol.endpoints import publisher, subscription

    heard: list[int] = []

    class Short(LifecycleBenchNode):
        def __init__(self):
            super().__init__("short")
            self.ticks = 0

        def configure(self):
            self.entries = (
                publisher(self, "/clock"),
                subscription(self, "/clock", lambda data: heard.append(self.ticks)),
            )

        def tick(self, now):
            for _ in range(5):
                self.entries[0].publish(clock_message(0))
            self.ticks += 1
            self.exit_status = 0 if self.ticks == 3 else None
            return 0.002

    for _ in range(100):
        assert run(Short, args=[]) == 0
    assert len(heard) > 100
    assert capfd.readouterr().err == ""
