"""When the processes of a run are requested to end, and killed, by an injected steady clock (FAULTS F1)."""

import pytest

from contact_sim_pkg.nodes.processes.stop_requests import StopRequests


class Requested:
    """In place of `Children`: the names that each request is for; none: all."""

    def __init__(self):
        self.requests = []

    def request_end(self, *names):
        self.requests.append(names)


@pytest.mark.fault("F1")
def test_what_does_not_end_at_one_interrupt_is_killed_within_two_seconds():
    stops, children = StopRequests(), Requested()
    stops.hand_on(children, 99.0, under_way=True)
    assert not stops.any
    stops.add()
    handed_on = []
    for hundredth in range(200):
        stops.hand_on(children, 100.0 + 0.01 * hundredth, under_way=True)
        handed_on.append(len(children.requests))
    assert children.requests == [("contact_simulator",), ()]  # first the simulator, so that the bag is whole
    assert 0.5 < 0.01 * handed_on.index(2) < 1.0
    over = next(0.01 * hundredth for hundredth in range(200) if stops.expired(100.0 + 0.01 * hundredth))
    assert over + stops.grace(100.0 + over) <= 2.0


def test_a_second_interrupt_is_for_every_process_at_once():
    stops, children = StopRequests(), Requested()
    for now in (100.0, 100.1):
        stops.add()
        stops.hand_on(children, now, under_way=True)
    assert children.requests == [("contact_simulator",), ()]


def test_before_a_run_every_process_is_requested_at_once():
    stops, children = StopRequests(), Requested()
    stops.add()
    stops.hand_on(children, 100.0, under_way=False)
    assert children.requests == [()]
