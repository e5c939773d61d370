"""The base of the nodes with an expensive or failing set-up: lifecycle states, driven by the node
itself unless `autostart` is false.
"""

from __future__ import annotations

from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.publisher import Publisher
from rclpy.subscription import Subscription

from contact_sim_pkg.files import RefusedError
from contact_sim_pkg.nodes.parameters import declare
from contact_sim_pkg.nodes.processes.process import end_unexpectedly
from contact_sim_pkg.nodes.protocol.states import FAULT, REFUSED, NodeError
from contact_sim_pkg.run.errors import RunError

SUPERVISOR_TEXT = "Process number of the supervisor that started this node; the node ends when it is gone. 0: none."


class LifecycleBenchNode(LifecycleNode):
    """A lifecycle node for `process.run`. A derived class writes `configure`, `tick`, `stop` and
    `close`.

    Configure reads, loads, compiles and creates publishers; activate lets the run begin. With
    `autostart` both follow the start of the process. A refusal is a log line and a FAILURE of the
    transition.
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
        self._endpoints_before: list[Publisher | Subscription] = []

    def configure(self) -> None:
        """Set up; a refusal raises."""
        raise NotImplementedError

    def close(self) -> None:
        """Release what `configure` opened; may be called more than once."""

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
        while threads of the middleware are still at work: a segmentation fault, rarely.
        """
        super().destroy_node()
        self._state_machine.destroy_when_not_in_use()

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Release everything and end the process."""
        self.close()
        self.exit_status = 0 if self.exit_status is None else self.exit_status
        return TransitionCallbackReturn.SUCCESS
