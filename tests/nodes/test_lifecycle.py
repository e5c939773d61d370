"""Transitions by the real services, in any order: what does not exist or cannot be done is refused by name, a pause goes on
at the pace, and shutdown ends the run as an interrupt does.
"""

import time

import pytest
from tests.bench_process import LONGEST, Nodes, end, messages, needs_ros, resolved, start_bench
from tests.nodes.services import connect

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.nodes.protocol.states import RunState
from contact_sim_pkg.run.offline import run_offline

pytestmark = needs_ros

SIMULATOR, LOGGER = "contact_simulator", "bag_logger"
NUMBERS = {
    "configure": 1,
    "cleanup": 2,
    "activate": 3,
    "deactivate": 4,
    "shutdown": 7,
    "destroy": 8,
    "on_configure_success": 10,
}
NO_TRANSITION = 99  # refused in every state
BLOCK = 0.01  # [s]


@pytest.fixture
def manager():
    """Asks for transitions, and hears what the run says of itself."""
    from lifecycle_msgs.msg import Transition
    from lifecycle_msgs.srv import ChangeState
    from tests.nodes.stand_in import StandIn

    with StandIn("manager", "road/patch") as one:
        clients = {}

        def change(node: str, transition: str, *, by_name: bool = False) -> bool:
            if node not in clients:
                clients[node] = one.node.create_client(ChangeState, f"{node}/change_state")
                connect(one.spin_until, clients[node], ChangeState.Request(transition=Transition(id=NO_TRANSITION)))
            asked = Transition(label=transition) if by_name else Transition(id=NUMBERS[transition])
            answer = clients[node].call_async(ChangeState.Request(transition=asked))
            one.spin_until(answer.done)
            return answer.result().success

        one.change = change
        one.state = lambda: RunState.IDLE if one.progress is None else RunState(one.progress.state)
        one.wait_for = lambda state, block=-1: one.spin_until(
            lambda: one.state() is state and one.progress.block >= block
        )
        yield one


REFUSED_WHILE_ACTIVE = {
    SIMULATOR: ("activate", "configure", "cleanup", "destroy", "on_configure_success"),
    LOGGER: ("activate", "configure", "cleanup", "deactivate"),
}
ENDS = {  # the last orders of a run; all but the shutdown leave it under way
    "simulator": (SIMULATOR, ()),
    "paused simulator": (SIMULATOR, ("deactivate",)),
    "simulator paused twice": (SIMULATOR, ("deactivate", "activate", "deactivate", "activate")),
    "logger": (LOGGER, ()),
    "logger of a paused simulator": (LOGGER, ("deactivate",)),
}


@pytest.mark.fault("B13")
@pytest.mark.parametrize("name", ENDS)
def test_in_any_order_of_transitions_a_run_goes_on_until_its_shutdown_and_its_bag_is_whole(manager, tmp_path, name):
    """By `bench run`, which ends as a launch does: once all nodes have ended, and with their status."""
    last, before = ENDS[name]
    bag = tmp_path / "bag"
    process = start_bench("run", "seat_ride", "--pace", "realtime", "--duration", "60", "--out", bag)
    try:
        manager.wait_for(RunState.RUNNING, 20)
        for node, transitions in REFUSED_WHILE_ACTIVE.items():
            for transition in transitions:
                assert not manager.change(node, transition), (node, transition)
                assert not manager.change(node, transition, by_name=True), (node, transition)
        for transition in before:
            assert manager.change(SIMULATOR, transition, by_name=True)
            manager.wait_for(RunState.PAUSED if transition == "deactivate" else RunState.RUNNING)
        if before[-1:] == ("deactivate",):
            for transition in ("deactivate", "configure", "cleanup"):
                assert not manager.change(SIMULATOR, transition)
        else:
            block = manager.progress.block
            manager.wait_for(RunState.RUNNING, block + 5)
        assert manager.change(last, "shutdown", by_name=True)
        printed, said = process.communicate(timeout=LONGEST)
    finally:
        end(process)
    assert process.returncode == 0, said
    assert "Traceback" not in said
    assert "'configure' is refused: the node is active; possible are deactivate (4), shutdown (7)" in said
    assert "'deactivate' is refused: the run waits for its recording" in said
    assert "ERROR" not in said
    assert "stopped after" in printed
    closed = open_bag(bag)
    assert closed.complete
    assert (closed.metadata["ended"], closed.metadata["failure"]) == ("stopped", "")
    assert (
        int(closed.metadata["blocks_done"]) == closed.count("platform/vibration") == closed.count("bench/energy") > 20
    )


@pytest.mark.fault("B13")
def test_a_managed_run_that_pauses_goes_on_at_its_pace_and_has_the_bits_of_any_other(manager, tmp_path):
    """Three seconds of pause are three hundred blocks, which would be made up for at hundreds of blocks a second."""
    scene = resolved("seat_ride", "duration=3", "pace=realtime")
    nodes = Nodes(scene, tmp_path)
    try:
        for node in (LOGGER, "vibration"):
            nodes.start(node)
        nodes.start(SIMULATOR, autostart="false")
        for transition in ("activate", "deactivate", "cleanup", "shutdown"):  # the number is that of an active node
            assert not manager.change(SIMULATOR, transition)
        for transition in ("configure", "cleanup", "configure"):
            assert manager.change(SIMULATOR, transition)
        assert not manager.change(SIMULATOR, "configure")
        assert manager.change(SIMULATOR, "activate")
        manager.wait_for(RunState.RUNNING, 10)
        assert manager.change(SIMULATOR, "deactivate")
        manager.wait_for(RunState.PAUSED)
        paused, since = manager.progress.block, time.monotonic()
        manager.spin_until(lambda: time.monotonic() - since > 3.0)
        assert manager.progress.block == paused
        since = time.monotonic()
        assert manager.change(SIMULATOR, "activate")
        manager.wait_for(RunState.RUNNING, paused + 100)
        assert (
            time.monotonic() - since > 100 * BLOCK - 30 * BLOCK
        )  # what was on its way, a window at most, is done at once
        assert nodes.wait() == {LOGGER: 0, "vibration": 0, SIMULATOR: 0}
    finally:
        nodes.end()
    assert not [line for line in nodes.printed if "Traceback" in line or "ERROR" in line]
    run_offline(scene, tmp_path / "offline")
    assert messages(nodes.bag) == messages(tmp_path / "offline")


@pytest.mark.fault("B13")
@pytest.mark.parametrize("node", [SIMULATOR, LOGGER])
def test_a_shutdown_before_the_run_has_begun_ends_all_of_its_nodes(manager, tmp_path, node):
    nodes = Nodes(resolved("seat_ride"), tmp_path)
    try:
        for each in (LOGGER, SIMULATOR):  # without a source it never gets ready
            nodes.start(each)
        manager.wait_for(RunState.STARTING)
        manager.spin_until(lambda: manager.node.count_subscribers("bench/recorded") == 2)
        for transition in ("deactivate", "activate"):  # once it answers, it is set up
            assert manager.change(SIMULATOR, transition)
        assert manager.change(node, "shutdown")
        assert nodes.wait() == {LOGGER: 0, SIMULATOR: 0}
    finally:
        nodes.end()
    assert not nodes.bag.exists()
    assert not [line for line in nodes.printed if "Traceback" in line or "ERROR" in line]
