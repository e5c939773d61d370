"""The simulator's report on `/diagnostics`, once a second and at every change of state."""

from __future__ import annotations

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.duration import Duration
from rclpy.node import Node

from contact_sim_pkg.nodes.protocol.endpoints import publisher
from contact_sim_pkg.nodes.protocol.states import RunState
from contact_sim_pkg.records.messages import BenchProgress

PERIOD_SECONDS = 1.0
WARN_SECONDS = 5.0  # that a warning shows for
SETTLE_SECONDS = 0.5
NOTHING = "none"


class Diagnostics:
    """One status: OK, WARN for 5 s after a warning and after a stop with loss, ERROR once the run
    has failed.
    """

    def __init__(self, node: Node) -> None:
        """Nothing sent yet."""
        self._node = node
        self._publisher = publisher(node, "/diagnostics")
        self.late = ""  # how far the run is behind its pace; empty where it is not
        self._warning, self._warned_at = NOTHING, float("-inf")
        self._sent_at, self._sent_state = float("-inf"), RunState.IDLE

    def warn(self, now: float, sentence: str) -> None:
        """Keep a warning; `now` is the steady clock, [s]."""
        self._warning, self._warned_at = sentence, now

    def report(self, now: float, progress: BenchProgress) -> None:
        """Send the state of the run, if that is due."""
        state = RunState(progress.state)
        if now - self._sent_at < PERIOD_SECONDS and state is self._sent_state:
            return
        self._sent_at, self._sent_state = now, state
        self._publisher.publish(self._array(now, progress))

    def settle(self) -> None:
        """Give the last report time to arrive."""
        self._publisher.wait_for_all_acked(Duration(seconds=SETTLE_SECONDS))

    def _array(self, now: float, progress: BenchProgress) -> DiagnosticArray:
        state = RunState(progress.state)
        # a failed run overrides the level of a warning
        level = DiagnosticStatus.WARN if now - self._warned_at < WARN_SECONDS else DiagnosticStatus.OK
        values = {
            "block": progress.block,
            "blocks": progress.blocks,
            "real-time factor": f"{progress.real_time_factor:.3g}",
            "load [N]": f"{progress.load:.6g}",
            "pace": self.late or "held",
            "last warning": self._warning,
        }
        status = DiagnosticStatus(
            level=DiagnosticStatus.ERROR if state is RunState.FAILED else level,
            name=f"{self._node.get_fully_qualified_name().lstrip('/')}: run",
            message=": ".join(text for text in (state.name.lower(), progress.message) if text),
            hardware_id=progress.scene,
            values=[KeyValue(key=key, value=str(value)) for key, value in values.items()],
        )
        array = DiagnosticArray(status=[status])
        array.header.stamp = self._node.get_clock().now().to_msg()
        return array
