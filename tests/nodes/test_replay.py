"""A replay over the real middleware: nothing of its beginning is lost; it can be paused, remapped and begun anywhere."""

import dataclasses
import fcntl
import os
import pty
import signal
import subprocess
import termios

import pytest
from tests.bag.hand_made import seat_ride, write
from tests.bench_process import ENVIRONMENT, LONGEST, Nodes, bench, needs_ros, resolved
from tests.nodes.services import connect

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.python_process import python_command
from contact_sim_pkg.run.offline import run_offline

pytestmark = needs_ros


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    path = tmp_path_factory.mktemp("replayed") / "bag"
    run_offline(resolved("seat_ride", "duration=0.5", "pace=max"), path)
    return path


@pytest.fixture
def replay(bag, tmp_path):
    """Starts the node of the replay; the processes end with the test."""
    nodes = Nodes(resolved("seat_ride"), tmp_path)
    yield lambda **parameters: (nodes.start("bag_replay", bag=bag, **parameters), nodes)[1]
    nodes.end()


@pytest.fixture
def listener():
    """A node that was there before the replay; `hear` gives a list that fills as it spins."""
    from tests.nodes.stand_in import StandIn

    from contact_sim_pkg.bag.topics import topic_of
    from contact_sim_pkg.nodes.protocol.endpoints import message_type, profile_of

    with StandIn("listener", topic="road/patch") as node:

        def hear(name, topic=None):
            row, heard = topic_of(name), []
            kept.append(
                node.node.create_subscription(
                    message_type(row.type), topic or name, heard.append, profile_of(row, 1000), raw=True
                )
            )
            return heard

        kept: list = []
        node.hear = hear
        yield node


def recorded(bag, *names):
    return [message.data for name in names for message in open_bag(bag).messages(name)]


@pytest.mark.parametrize("delay", [0.0, 0.5])
def test_a_subscriber_that_is_there_gets_every_byte_from_the_first_on(bag, replay, listener, delay):
    """Latched topics too; the node says how many messages went out and ends by itself with status 0."""
    forces, scene = listener.hear("seat/force"), listener.hear("bench/scene")
    nodes = replay(delay=delay)
    listener.spin_until(nodes.ended)
    listener.spin_until(lambda: len(forces) == 50)
    assert nodes.wait() == {"bag_replay": 0}
    assert (forces, scene) == (recorded(bag, "seat/force"), recorded(bag, "bench/scene"))
    count = open_bag(bag).count()
    assert f"{count} of {count} messages went out" in nodes.printed[-1]
    assert any("2 subscriptions on 2 of 8 topics" in line for line in nodes.printed)


@pytest.mark.fault("C7")
def test_a_bag_whose_log_times_are_wall_time_is_sent_at_once_and_shows_its_own_length(tmp_path):
    """As `ros2 bag record` writes it: log times of now, and no text of ours."""
    ride = seat_ride()
    late = [(topic, time + 1_800_000_000_000_000_000, data) for topic, time, data in ride.messages]
    write(tmp_path / "bag", dataclasses.replace(ride, messages=late, texts={}, seal=False))
    ended = bench("replay", tmp_path / "bag", "--delay", "0", "--start-offset", "0.005")
    assert ended.returncode == 0, ended.stderr
    assert "2 of 2 messages went out" in ended.stderr  # the latched scene from before the offset, and the second block
    assert "of 0.01 s" in ended.stderr


def test_a_subscriber_that_cannot_be_served_is_named_and_not_waited_for(bag, replay, listener):
    from rclpy.qos import DurabilityPolicy, QoSProfile
    from std_msgs.msg import String

    from contact_sim_pkg.nodes.protocol.endpoints import message_type

    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    kind = message_type("contact_msgs_defs/msg/ContactForce")
    kept = [
        listener.node.create_subscription(kind, "seat/force", lambda _: None, latched),
        listener.node.create_subscription(String, "bench/scene", lambda _: None, latched),
    ]
    nodes = replay()
    listener.spin_until(nodes.ended)
    assert len(kept) == 2
    assert not [line for line in nodes.printed if "begins without" in line]
    assert [line.split(": ", 1)[1] for line in nodes.printed if "gets nothing" in line] == [
        "/listener gets nothing of /seat/force: it asks for a transient-local topic, the topic was recorded as volatile"
    ]
    assert any("1 subscriptions on 1 of 8 topics" in line for line in nodes.printed)


def test_a_service_pauses_and_resumes_at_the_same_message(bag, replay, listener):
    from std_srvs.srv import SetBool

    forces = listener.hear("seat/force")
    client = listener.node.create_client(SetBool, "bag_replay/pause")
    nodes = replay(rate=0.25)
    listener.spin_until(lambda: len(forces) >= 5)
    connect(listener.spin_until, client, SetBool.Request(data=True))
    answers = [client.call_async(SetBool.Request(data=True))]
    listener.spin_until(answers[0].done)
    assert listener.spin_until_quiet(forces) < 50
    answers.append(client.call_async(SetBool.Request(data=False)))
    listener.spin_until(nodes.ended)
    listener.spin_until(lambda: len(forces) == 50)
    assert [(answer.result().success, answer.result().message) for answer in answers] == [
        (True, "paused"),
        (True, "going on"),
    ]
    assert forces == recorded(bag, "seat/force")


def test_the_command_remaps_begins_at_a_message_shows_progress_and_pauses_by_the_space_key(bag, listener):
    forces = listener.hear("seat/force", "pan/load")
    first, second = pty.openpty()
    command = python_command("contact_sim_pkg.cli.main", "replay", str(bag), "--topics", "seat/force")
    options = ["--remap", "seat/force:=pan/load", "--start-message", "10", "--rate", "0.2", "--loop"]
    process = subprocess.Popen(
        [*map(str, command), *options], env=ENVIRONMENT, stdin=second, stderr=subprocess.PIPE, text=True,
        preexec_fn=take_terminal,
    )  # fmt: skip
    try:
        listener.spin_until(lambda: len(forces) >= 3)
        os.write(first, b" ")
        standing = listener.spin_until_quiet(forces)
        os.write(first, b" ")
        listener.spin_until(lambda: len(forces) > standing + 45)  # 40 a pass
        process.send_signal(signal.SIGINT)
        _, printed = process.communicate(timeout=LONGEST)
    finally:
        process.kill()
        os.close(first)
        os.close(second)
    assert process.returncode == 0, printed
    expected = recorded(bag, "seat/force")[10:]
    assert forces == (expected * (1 + len(forces) // 40))[: len(forces)]
    assert "space: pause" in printed
    assert "of 40 messages went out in pass 2" in printed


def take_terminal() -> None:
    """Make the standard input the controlling terminal of a new session."""
    os.setsid()
    fcntl.ioctl(0, termios.TIOCSCTTY, 0)
