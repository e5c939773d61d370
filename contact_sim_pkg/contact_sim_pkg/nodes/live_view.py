"""The node behind `bench view`: the newest of the bench's topics into the scope of the live page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from queue import SimpleQueue
from typing import Any

from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rclpy.client import Client
from rclpy.subscription import Subscription
from std_srvs.srv import SetBool

from contact_sim_pkg.bag.messages import decode, stamp_of
from contact_sim_pkg.nodes.bench_node import LifecycleBenchNode
from contact_sim_pkg.nodes.processes.process import run
from contact_sim_pkg.nodes.protocol.endpoints import viewing_subscription
from contact_sim_pkg.nodes.protocol.states import MALFORMED, RunState
from contact_sim_pkg.standard.convert import record_type
from contact_sim_pkg.view.scope import SHOWN, Scope

LOOK_SECONDS = 1.0  # between two looks at the graph
GATHER = 0.03  # [s]
DEPTH = 50  # blocks that may come between two looks; the page loses no peak of a series
PROGRESS = "bench/progress"


class LiveViewNode(LifecycleBenchNode):
    """Subscribes as best effort, so that no publisher keeps or repeats a message for a page; pauses what can be paused."""

    def __init__(self, scope: Scope, wishes: SimpleQueue[dict[str, Any]]) -> None:
        """Follow the graph into ``scope``; ``wishes``: what pages ask for."""
        super().__init__("live_view")
        self.gather = GATHER
        self._scope, self._wishes = scope, wishes
        self._followed: dict[str, Subscription] = {}
        self._looked = float("-inf")
        self._replay = self.create_client(SetBool, "bag_replay/pause")
        self._simulator = self.create_client(ChangeState, "contact_simulator/change_state")

    def configure(self) -> None:
        """Begin without a topic."""
        self._followed = {}

    def tick(self, now: float) -> float:
        """Follow topics that have come; pass on what pages ask for."""
        if now - self._looked > LOOK_SECONDS:
            self._looked = now
            for name in SHOWN:
                if name not in self._followed and self.count_publishers(name):
                    depth = 1 if name.endswith("/patch") else DEPTH
                    self._followed[name] = viewing_subscription(self, name, partial(self._on_message, name), depth)
            can = any(each.service_is_ready() for each in (self._replay, self._simulator))
            self._scope.say(can=["pause"] if can else [])
        while not self._wishes.empty():
            self._steer(self._wishes.get())
        return GATHER

    def _steer(self, wish: Mapping[str, Any]) -> None:
        """Pause a replay or a run, or let it go on."""
        if wish.get("do") not in ("pause", "go"):
            return
        pause = wish["do"] == "pause"
        number = Transition.TRANSITION_DEACTIVATE if pause else Transition.TRANSITION_ACTIVATE
        self._ask(self._replay, SetBool.Request(data=pause))
        self._ask(self._simulator, ChangeState.Request(transition=Transition(id=number)))
        if self._replay.service_is_ready():
            self._scope.say(paused=pause)

    def _ask(self, client: Client, request: Any) -> None:
        if client.service_is_ready():
            client.call_async(request)

    def _on_message(self, name: str, data: bytes) -> None:
        """Show one message; a malformed one is dropped."""
        try:
            record = decode(record_type(name), data)
            self._scope.take(name, stamp_of(data), record)
        except MALFORMED as error:
            self.get_logger().warning(f"{name}: {error}; dropped", throttle_duration_sec=1.0)
            return
        if name == PROGRESS:
            self._scope.say(paused=record.state == RunState.PAUSED)


def main(scope: Scope, wishes: SimpleQueue[dict[str, Any]], args: Sequence[str]) -> int:
    """Run the node until a signal comes; returns the exit status."""
    return run(lambda: LiveViewNode(scope, wishes), args=args)
