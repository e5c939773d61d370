"""What several benches show on the topics that ROS shares between all nodes: one clock, diagnostics of each."""

from types import SimpleNamespace

import pytest
from tests.bench_process import Nodes, messages, needs_ros, resolved, wait_until

from contact_sim_pkg.run.offline import run_offline

pytestmark = needs_ros


@pytest.fixture
def listen():
    """Hears a topic by its type; gives a list that fills as `spin` is called, and `spin`."""
    import rclpy
    from rclpy.executors import SingleThreadedExecutor
    from rclpy.node import Node
    from rclpy.signals import SignalHandlerOptions

    context = rclpy.Context()
    rclpy.init(context=context, signal_handler_options=SignalHandlerOptions.NO)
    node = Node("listener", context=context, start_parameter_services=False, enable_rosout=False)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)

    def hear(kind, topic, profile):
        heard: list = []
        node.create_subscription(kind, topic, heard.append, profile)
        return heard

    yield hear, lambda: executor.spin_once(timeout_sec=0.02)
    executor.shutdown()
    node.destroy_node()
    context.try_shutdown()


def test_two_benches_in_two_namespaces_have_one_clock_and_diagnostics_of_their_own(listen, tmp_path):
    from diagnostic_msgs.msg import DiagnosticArray
    from rclpy.qos import qos_profile_sensor_data
    from rosgraph_msgs.msg import Clock

    hear, spin = listen
    ticks = hear(Clock, "/clock", qos_profile_sensor_data)
    reports = hear(DiagnosticArray, "/diagnostics", 10)
    scene = resolved("seat_ride", "duration=2")
    rigs = [Nodes(scene, tmp_path / name, f"__ns:=/{name}") for name in ("rig1", "rig2")]
    try:
        for nodes in rigs:
            for node in ("vibration", "contact_simulator"):
                nodes.start(node, record="false")
        wait_until(lambda: (spin(), all(nodes.ended() for nodes in rigs))[1])
        assert [nodes.wait() for nodes in rigs] == [{"vibration": 0, "contact_simulator": 0}] * 2
    finally:
        for nodes in rigs:
            nodes.end()
    wait_until(lambda: (spin(), sum(report.status[0].message == "finished" for report in reports) == 2)[1])
    stamps = [tick.clock.sec * 10**9 + tick.clock.nanosec for tick in ticks]
    assert len(stamps) > 10  # a busy listener loses most of them
    assert stamps == sorted(set(stamps))
    printed = [line for nodes in rigs for line in nodes.printed if "this run publishes none" in line]
    assert len(printed) == 1
    assert "/clock comes from /rig" in printed[0]
    found = {(report.status[0].name, report.status[0].message): report.status[0] for report in reports}
    for name in ("rig1", "rig2"):
        running, done = (found[f"{name}/contact_simulator: run", state] for state in ("running", "finished"))
        assert {running.level, done.level} <= {b"\0", b"\1"}  # a run that is late on a busy machine warns
        assert done.hardware_id == "seat_ride"
        assert {value.key: value.value for value in done.values}["block"] == "199"


def test_a_clock_of_another_node_is_left_alone(listen, tmp_path):
    from rclpy.qos import qos_profile_sensor_data
    from rosgraph_msgs.msg import Clock
    from tests.nodes.stand_in import StandIn

    hear, spin = listen
    ticks = hear(Clock, "/clock", qos_profile_sensor_data)
    nodes = Nodes(resolved("seat_ride", "duration=0.3"), tmp_path)
    with StandIn("gazebo", "/clock"):
        try:
            for node in ("vibration", "contact_simulator"):
                nodes.start(node, record="false")
            wait_until(lambda: (spin(), nodes.ended())[1])
        finally:
            nodes.end()
    assert ticks == []
    assert sum("/clock comes from /gazebo; this run publishes none" in line for line in nodes.printed) == 1


@pytest.mark.fault("C3")
def test_a_run_that_cannot_keep_its_pace_says_so_and_loses_no_simulated_time(listen, tmp_path):
    """At a thousand times real time a block of 10 ms is due every 10 us: none is done in time."""
    from diagnostic_msgs.msg import DiagnosticArray

    hear, spin = listen
    reports = hear(DiagnosticArray, "/diagnostics", 10)
    scene = resolved("seat_ride", "duration=2", "pace=1000")
    nodes = Nodes(scene, tmp_path)
    try:
        for node in ("bag_logger", "vibration", "contact_simulator"):
            nodes.start(node)
        nodes.wait_until(lambda: (spin(), nodes.ended())[1])
        assert set(nodes.wait().values()) == {0}
    finally:
        nodes.end()
    wait_until(lambda: (spin(), reports and reports[-1].status[0].message == "finished")[1])
    pace = {each.key: each.value for each in reports[-1].status[0].values}["pace"]
    assert pace.startswith("slower than its pace: ")
    assert "behind after block 199 (200 blocks late)" in pace
    run_offline(scene, tmp_path / "offline")
    assert messages(nodes.bag) == messages(tmp_path / "offline")


def test_diagnostics_are_sent_once_a_second_and_at_each_change_and_show_a_warning_for_five_seconds(monkeypatch):
    from builtin_interfaces.msg import Time

    from contact_sim_pkg.nodes import diagnostics
    from contact_sim_pkg.nodes.protocol.states import RunState
    from contact_sim_pkg.records.messages import BenchProgress

    sent: list = []
    monkeypatch.setattr(diagnostics, "publisher", lambda node, name: SimpleNamespace(publish=sent.append))
    clock = SimpleNamespace(now=lambda: SimpleNamespace(to_msg=lambda: Time(sec=7)))
    node = SimpleNamespace(get_fully_qualified_name=lambda: "/rig1/contact_simulator", get_clock=lambda: clock)
    reports = diagnostics.Diagnostics(node)

    def levels(state, *times, message=""):
        sent.clear()
        for now in times:
            report = BenchProgress(
                state=int(state), run=0, block=41, blocks=100, messages_sent=9, real_time_factor=1.25, load=520.0,
                peak_pressure=0.0, scene="seat_ride", message=message,
            )  # fmt: skip
            reports.report(now, report)
        return [int.from_bytes(array.status[0].level, "little") for array in sent]

    assert levels(RunState.READY, 0.0, 0.5, 0.99, 1.0, 1.5) == [0, 0]
    assert levels(RunState.RUNNING, 1.6, 1.7) == [0]  # a change of state is not waited with
    reports.warn(2.0, "platform/vibration: late")
    assert levels(RunState.RUNNING, 3.0, 6.9, 8.0) == [1, 1, 0]
    assert levels(RunState.FAILED, 8.1, message="no block 3") == [2]
    assert (sent[0].status[0].message, sent[0].header.stamp.sec) == ("failed: no block 3", 7)
    assert sent[0].status[0].name == "rig1/contact_simulator: run"
    values = {value.key: value.value for value in sent[0].status[0].values}
    assert (values["block"], values["real-time factor"]) == ("41", "1.25")
    assert values["last warning"] == "platform/vibration: late"
