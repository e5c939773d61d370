"""Who sends the blocks: one publisher a topic for the whole run, another one is found and named (FAULTS B8)."""

import pytest

from contact_sim_pkg.nodes.protocol.single_source import NAME_SECONDS, SILENT_SECONDS, SingleSource, SourceWatch
from contact_sim_pkg.nodes.protocol.states import NodeError

TOPIC = "platform/vibration"


def heard(source: SingleSource, numbers, publishers: int = 1) -> list[bool]:
    return [source.accept(number, lambda: publishers) for number in numbers]


def test_the_messages_of_one_publisher_are_its_own_from_whatever_number_on():
    assert all(heard(SingleSource(), [7, 8, 9, 10]))


def test_messages_that_one_publisher_lost_by_overrunning_a_queue_leave_it_the_source():
    assert all(heard(SingleSource(), [1, 2, 13, 14]))


@pytest.mark.parametrize("numbers", [[1], [3], [4], [90], [1, 2, 3]])
def test_a_second_publisher_is_distinguished_whatever_it_has_sent_before(numbers):
    source = SingleSource()
    assert all(heard(source, [1, 2, 3, 4]))
    assert not any(heard(source, numbers, publishers=2))
    assert all(heard(source, [5, 6], publishers=2))


def test_a_second_publisher_that_has_left_is_recognised_by_its_numbers_alone():
    source = SingleSource()
    assert all(heard(source, range(1, 40)))
    assert not any(heard(source, [1, 2, 3]))


def test_the_first_message_of_two_publishers_is_nobodys():
    assert heard(SingleSource(), [1, 1], publishers=2) == [False, False]


def test_a_middleware_that_does_not_number_leaves_it_to_the_graph():
    source = SingleSource()
    assert heard(source, [None, None]) == [True, True]
    assert heard(source, [None], publishers=2) == [False]


class Graph:
    """The publishers that the graph shows: name of the middleware -> name of the node."""

    def __init__(self):
        self.shown = {b"own": "/vibration"}
        self.watch = SourceWatch({TOPIC: "/platform/vibration"}, lambda _: len(self.shown), lambda _: self.shown)
        self.watch.store_own()


@pytest.fixture
def graph():
    return Graph()


@pytest.mark.fault("B8")
def test_a_message_of_a_second_publisher_ends_the_run_by_its_name(graph):
    assert graph.watch.accept(TOPIC, 1, 0.0)
    graph.shown[b"other"] = "/rig2/intruder"
    assert not graph.watch.accept(TOPIC, 1, 0.1)
    with pytest.raises(NodeError, match=r"/rig2/intruder publishes /platform/vibration beside") as fault:
        graph.watch.alone(0.1)
    assert fault.value.exit_status == 1


def test_no_block_counts_while_the_name_of_a_second_publisher_is_still_unknown(graph):
    assert graph.watch.accept(TOPIC, 1, 0.0)
    graph.shown[b"other"] = ""
    assert not graph.watch.accept(TOPIC, 1, 0.1)
    assert not graph.watch.alone(0.1)
    with pytest.raises(NodeError, match="a node whose name is not known publishes"):
        graph.watch.alone(0.2 + NAME_SECONDS)


def test_a_second_publisher_that_sent_and_left_is_named_as_well(graph):
    assert graph.watch.accept(TOPIC, 1, 0.0)
    graph.shown[b"other"] = "/intruder"
    assert not graph.watch.alone(0.1)
    del graph.shown[b"other"]
    assert not graph.watch.accept(TOPIC, 1, 0.2)
    with pytest.raises(NodeError, match="/intruder publishes /platform/vibration"):
        graph.watch.alone(0.2)


def test_a_second_publisher_without_messages_delays_the_run_and_ends_it_if_it_stays(graph):
    graph.shown[b"other"] = "/intruder"
    assert not graph.watch.alone(0.0)
    del graph.shown[b"other"]
    assert graph.watch.alone(1.0)
    graph.shown[b"other"] = "/intruder"
    assert not graph.watch.alone(2.0)
    assert not graph.watch.alone(2.0 + SILENT_SECONDS)
    with pytest.raises(NodeError, match="/intruder"):
        graph.watch.alone(2.1 + SILENT_SECONDS)


def test_a_source_that_has_left_after_its_last_block_is_no_fault(graph):
    graph.shown.clear()
    assert graph.watch.accept(TOPIC, 1, 0.0)
    assert graph.watch.alone(0.0)
