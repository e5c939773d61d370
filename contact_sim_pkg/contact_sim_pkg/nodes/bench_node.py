"""The base of the nodes with an expensive or failing set-up: lifecycle states, driven by the node
itself unless `autostart` is false.
"""

from __future__ import annotations

import time
from typing import Any

from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.publisher import Publisher
from rclpy.subscription import Subscription

from contact_sim_pkg.files import RefusedError
from contact_sim_pkg.nodes.parameters import declare
from contact_sim_pkg.nodes.processes.process import end_unexpectedly
from contact_sim_pkg.nodes.protocol.states import DONE, FAULT, REFUSED, NodeError
from contact_sim_pkg.run.errors import RunError

NAMES = {1: "configure", 2: "cleanup", 3: "activate", 4: "deactivate", 5: "shutdown", 6: "shutdown", 7: "shutdown"}
"""Transitions of `lifecycle_msgs/Transition` by number; shutdown has one for each state that it begins in."""
ANSWER_SECONDS = 0.3  # for the answer to a request to arrive: of a service the middleware does not tell
SUPERVISOR_TEXT = "Process number of the supervisor that started this node; the node ends when it is gone. 0: none."


class LifecycleBenchNode(LifecycleNode):
    """A lifecycle node for `process.run`. A derived class writes `configure`, `tick`, `stop` and
    `close`.

    Configure reads, loads, compiles and creates publishers; activate lets the run begin. With
    `autostart` both follow the start of the process. A refusal is a log line and a FAILURE of the
    transition; a transition that does not exist now, or that `refusal` forbids, is a log line too, and
    its request is answered with false. Shutdown ends the node as a signal does.
    """

    exit_status: int | None = None
    scene_name = ""
    gather = 0.0
    computes = False

    def __init__(self, name: str) -> None:
        """Declare the parameters of all of these nodes."""
        super().__init__(name)
        self.supervisor = declare(self, "supervisor", 0, SUPERVISOR_TEXT)
        self._autostart = declare(self, "autostart", True, "Configure and activate at the start of the process.")
        self.active = False
        self._answered = float("-inf")  # steady clock, [s]
        self._endpoints_before: list[Publisher | Subscription] = []
        self._change_state = self._service_change_state.callback
        self._service_change_state.callback = self._on_change_state  # that of rclpy raises for what does not exist now

    def configure(self) -> None:
        """Set up; a refusal raises."""
        raise NotImplementedError

    def close(self) -> None:
        """Release what `configure` opened; may be called more than once."""

    def stop(self) -> None:
        """The user wants the end: begin to end cleanly."""
        self.exit_status = DONE

    def refusal(self, transition: str) -> str:
        """Why this transition, which exists now, is not possible, with the cure; empty where it is."""
        return ""

    def _on_change_state(self, request: Any, response: Any) -> Any:
        """Answer a request for a transition, by its label or else its number."""
        self._answered = time.monotonic()
        possible = {label: number for number, label, *_ in self._state_machine.available_transitions}
        names = {number: label for label, number in possible.items()}
        wanted = request.transition.label or names.get(request.transition.id, "")
        if wanted in possible:
            reason = self.refusal(wanted)
        else:
            wanted = wanted or NAMES.get(request.transition.id, f"transition {request.transition.id}")
            now = ", ".join(f"{label} ({number})" for label, number in possible.items()) or "none"
            reason = f"the node is {self._state_machine.current_state[1]}; possible are {now}"
        if reason:
            self.get_logger().warning(f"{wanted[:40]!r} is refused: {reason}")
            response.success = False
            return response
        return self._change_state(request, response)

    def start(self) -> None:
        """Go through the transitions, unless a manager does."""
        if self._autostart and self.trigger_configure() == TransitionCallbackReturn.SUCCESS:
            self.trigger_activate()

    def announce(self, sentence: str) -> None:
        """Log the progress of the run for a node started alone or by `ros2 launch`; a supervisor
        shows it itself.
        """
        if not self.supervisor:
            self.get_logger().info(sentence)

    def fault(self, sentence: str, exit_status: int) -> None:
        """Log the failure, close, and end the process with this status."""
        self.get_logger().error(sentence)
        self.close()
        self.exit_status = exit_status

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Set up; FAILURE with the reason in the log where that is refused."""
        self._endpoints_before = [*self.publishers, *self.subscriptions]
        try:
            self.configure()
        except (NodeError, RunError, RefusedError) as error:
            refusal = getattr(error, "exit_status", FAULT if isinstance(error, RunError) else REFUSED)
            self.get_logger().error(str(error))
            self._release()
            self.exit_status = refusal if self._autostart else None
            return TransitionCallbackReturn.FAILURE
        except Exception as error:  # noqa: BLE001  # the lifecycle would swallow it without a word
            end_unexpectedly(self, error)
            return TransitionCallbackReturn.FAILURE
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Let the run begin."""
        self.active = True
        return super().on_activate(state)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Pause the run."""
        self.active = False
        return super().on_deactivate(state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Release what `configure` opened."""
        self._release()
        return TransitionCallbackReturn.SUCCESS

    def _release(self) -> None:
        """Close, and destroy what `configure` has created in the graph, the last one first: it may
        be called again.
        """
        self.close()
        for subscription in reversed(list(self.subscriptions)):
            if subscription not in self._endpoints_before:
                self.destroy_subscription(subscription)
        for publisher in reversed(list(self.publishers)):
            if publisher not in self._endpoints_before:
                self.destroy_publisher(publisher)

    def destroy_node(self) -> None:
        """Destroy the node and the state machine, which rclpy leaves to the garbage collector.

        It would hold the middleware until the libraries are taken down at the end of the process,
        while threads of the middleware are still at work: a segmentation fault, rarely. Whoever asked for the end first
        gets an answer: a process that leaves at once takes it along.
        """
        time.sleep(max(0.0, self._answered + ANSWER_SECONDS - time.monotonic()))
        super().destroy_node()
        self._state_machine.destroy_when_not_in_use()

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """End as at a signal."""
        self.stop()
        return TransitionCallbackReturn.SUCCESS
