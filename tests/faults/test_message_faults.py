"""Bad, missing and foreign messages over the real middleware (FAULTS part B)."""

import json
import time

import numpy
import pytest
from tests.bench_process import LONGEST, Nodes, messages, needs_ros, resolved

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.run.sources import make_vibration

pytestmark = needs_ros

BLOCK = 10_000_000  # [ns]
BLOCKS = 20


@pytest.fixture
def scene():
    return resolved("seat_ride", f"duration={BLOCKS * 0.01}", "pace=max")


@pytest.fixture
def nodes(scene, tmp_path):
    started = Nodes(scene, tmp_path)
    yield started
    started.end()


@pytest.fixture
def stand_in():
    from tests.nodes.stand_in import StandIn

    with StandIn() as node:
        yield node


def block_of(source, number: int, stamp: int | None = None) -> bytes:
    return encode(source.block(number), number * BLOCK if stamp is None else stamp)


def spoilt(source, number: int) -> bytes:
    block = source.block(number)
    values = numpy.array(block.acceleration_z)
    values[3] = numpy.nan
    return encode(block._replace(acceleration_z=values), number * BLOCK)


def send(stand_in, source, numbers, *, before=lambda number: ()) -> None:
    """Send each block when the one before is done; `before` gives what to send in front of it."""
    for number in numbers:
        stand_in.spin_until(lambda number=number: stand_in.progress.block >= number - 1)
        for data in before(number):
            stand_in.entry.publish(data)
        stand_in.entry.publish(block_of(source, number))


def seven_blocks_done(scene, nodes, stand_in):
    """A recorded run under way, with its source; it waits for as long as the test takes to go on.

    The logger has the blocks too: one that is behind cannot separate them from an intruder's.
    """
    nodes.start("bag_logger")
    nodes.start("contact_simulator", input_timeout=LONGEST)
    source = make_vibration(scene)
    stand_in.wait_ready(2)
    send(stand_in, source, range(7))
    stand_in.spin_until(lambda: stand_in.progress.block == stand_in.recorded == 6)
    return source


@pytest.mark.fault("B5")
def test_a_missing_block_ends_the_run_by_name_with_its_bag_closed(scene, nodes, stand_in):
    """B5 for numbered blocks: named after the input timeout, never invented; status 1."""
    nodes.start("bag_logger")
    nodes.start("contact_simulator", input_timeout=4.0)
    source = make_vibration(scene)
    stand_in.wait_ready(2)
    send(stand_in, source, range(7))
    for number in (8, 9):
        stand_in.entry.publish(block_of(source, number))
    stand_in.spin_until(lambda: stand_in.progress.message != "")
    assert "block 7 of platform/vibration is missing (the last good one was block 9)" in stand_in.progress.message
    assert nodes.wait() == {"bag_logger": 0, "contact_simulator": 1}
    bag = open_bag(nodes.bag)
    assert bag.complete
    assert bag.count("platform/vibration") == bag.count("seat/force") == 7
    assert (bag.metadata["ended"], bag.metadata["blocks_done"]) == ("failed", "7")
    assert "block 7 of platform/vibration is missing" in bag.metadata["failure"]


@pytest.mark.fault("B2", "E8")
@pytest.mark.fault("B1", "B2", "B4")
def test_bad_blocks_are_dropped_and_named_and_leave_the_bits_alone(scene, nodes, stand_in, tmp_path):
    """B1, B2, B4: NaN, a wrong length, a wrong stamp, a repetition, in front of the good block."""
    nodes.start("bag_logger")
    nodes.start("contact_simulator", input_timeout=LONGEST)
    source = make_vibration(scene)

    def bad(number):
        # One at every fifth block: the queue of the stand-in holds them and the blocks that the logger may be behind
        if number % 5:
            return []
        block = source.block(number)
        short = block._replace(acceleration_x=block.acceleration_x[:-1], acceleration_z=block.acceleration_z[:-1])
        kinds = [
            spoilt(source, number),
            encode(short, number * BLOCK),
            block_of(source, number, stamp=number * BLOCK + 1),
            block_of(source, max(number - 1, 0)),
        ]
        return [kinds[number // 5]]

    stand_in.wait_ready(2)
    send(stand_in, source, range(BLOCKS), before=bad)
    assert nodes.wait() == {"bag_logger": 0, "contact_simulator": 0}
    assert any("NaN or infinite" in line and "dropped" in line for line in nodes.printed)
    assert open_bag(nodes.bag).metadata["dropped platform/vibration"] == "4"
    run_offline(scene, tmp_path / "offline")
    assert messages(nodes.bag) == messages(tmp_path / "offline")
    # The stand-in is no node of the bench, so what the scene says of the vibration is not recorded as its description
    described = json.loads(open_bag(nodes.bag).metadata["excitation"])["platform/vibration"]
    assert described["published by"] == "/stand_in"
    assert "/stand_in, which is no node of the bench" in described["notes"][0]


def test_a_run_that_gets_nothing_but_nan_ends_by_name(scene, nodes, stand_in):
    """B1: the state is never touched by it."""
    nodes.start("bag_logger")
    nodes.start("contact_simulator", input_timeout=4.0)
    stand_in.wait_ready(2)
    stand_in.entry.publish(spoilt(make_vibration(scene), 0))
    stand_in.spin_until(lambda: stand_in.progress.message != "")
    expected = "block 0 of platform/vibration is missing (no good block came at all, 1 were dropped)"
    assert expected in stand_in.progress.message
    assert nodes.wait() == {"bag_logger": 0, "contact_simulator": 1}
    assert open_bag(nodes.bag).count("seat/force") == 0


@pytest.mark.fault("B8")
def test_a_second_publisher_of_an_input_is_refused_before_ready(nodes, stand_in):
    """B8: both nodes named, the cure given, status 2, nothing created."""
    nodes.start("vibration")
    nodes.start("contact_simulator")
    assert nodes.wait("contact_simulator") == {"contact_simulator": 2}
    refusal = next(line for line in nodes.printed if "publishers" in line)
    assert "platform/vibration has 2 publishers (/stand_in, /vibration)" in refusal
    assert "ROS_DOMAIN_ID" in refusal
    assert not nodes.bag.exists()


@pytest.mark.fault("B1", "B6", "B8")
@pytest.mark.parametrize("kind", ["other values and blocks to come", "nan"])
def test_a_second_publisher_during_a_run_ends_it_by_name_before_its_data_count(scene, nodes, stand_in, tmp_path, kind):
    """Status 1; the bag holds the blocks done until then, with the bits that they have without it."""
    from tests.nodes.stand_in import StandIn

    source = seven_blocks_done(scene, nodes, stand_in)
    with StandIn("intruder") as intruder:
        intruder.wait_ready(2)
        for number in range(7, 7 + 600):
            block = source.block(min(number, BLOCKS - 1))._replace(block=min(number, BLOCKS - 1))
            worse = block._replace(acceleration_z=block.acceleration_z * 3.0)
            data = spoilt(source, 7) if kind == "nan" else encode(worse, worse.block * BLOCK)
            intruder.entry.publish(data)
            if number == 60:
                stand_in.entry.publish(block_of(source, 7))
            time.sleep(0.001)
        stand_in.spin_until(lambda: stand_in.progress.message != "")
        assert nodes.wait()["contact_simulator"] == 1
    assert "/intruder publishes /platform/vibration beside the source of this run" in stand_in.progress.message
    run_offline(scene, tmp_path / "offline")
    held, whole = messages(nodes.bag), messages(tmp_path / "offline")
    assert held == whole[: len(held)]
    bag = open_bag(nodes.bag)
    assert bag.complete
    assert bag.count("seat/force") == bag.count("platform/vibration") in (7, 8)
    assert bag.metadata["ended"] == "failed"
    assert "/intruder" in bag.metadata["failure"]


@pytest.mark.fault("B8")
def test_a_second_publisher_of_a_result_ends_the_run_by_name_and_is_not_recorded(scene, nodes, stand_in, tmp_path):
    """Messages of the simulator's own type, for the blocks to come: the bag has the bits that it has without them."""
    from tests.nodes.stand_in import StandIn

    source = seven_blocks_done(scene, nodes, stand_in)
    run_offline(scene, tmp_path / "offline")
    foreign = [each.data for each in open_bag(tmp_path / "offline").messages("seat/force")]
    with StandIn("intruder", "seat/force") as intruder:
        intruder.wait_ready(1)
        for data in foreign[7:13]:  # six: its eighth would bear the number that the run's next one bears
            intruder.entry.publish(data)
        stand_in.entry.publish(block_of(source, 7))
        stand_in.spin_until(lambda: stand_in.progress.message != "")
        assert nodes.wait()["contact_simulator"] == 1
    assert "/intruder publishes /seat/force beside" in stand_in.progress.message
    held, whole = messages(nodes.bag), messages(tmp_path / "offline")
    assert held == whole[: len(held)]
    bag = open_bag(nodes.bag)
    assert bag.complete
    assert bag.count("seat/force") in (7, 8)
    assert "/intruder" in bag.metadata["failure"]
    assert int(bag.metadata["foreign seat/force"]) > 0


@pytest.mark.fault("B8")
def test_a_second_publisher_of_a_result_is_refused_before_ready(nodes, stand_in):
    from tests.nodes.stand_in import StandIn

    with StandIn("intruder", "seat/force"):
        nodes.start("contact_simulator", record=False)
        assert nodes.wait("contact_simulator") == {"contact_simulator": 2}
    assert any("seat/force has 2 publishers" in line and "intruder" in line for line in nodes.printed)


@pytest.mark.fault("B9")
def test_an_input_of_another_message_definition_is_refused(nodes):
    """B9: the wire would take another type for ours; here a publisher of another type on our topic's name."""
    from tests.nodes.stand_in import StandIn

    with StandIn("vibration") as other:
        other.node.destroy_publisher(other.entry)
        message = pytest.importorskip("std_msgs.msg").String
        other.entry = other.node.create_publisher(message, "platform/vibration", 10)
        nodes.start("contact_simulator")
        assert nodes.wait("contact_simulator") == {"contact_simulator": 2}
    assert any("another definition" in line for line in nodes.printed)
