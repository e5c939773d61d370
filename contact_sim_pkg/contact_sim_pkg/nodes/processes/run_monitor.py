"""The supervisor's view of a run: `bench/progress` and `bench/recorded`, with the steady clock."""

from __future__ import annotations

import time
from collections.abc import Sequence
from types import TracebackType
from typing import Any

import rclpy
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.nodes.processes.process import handle_messages, make_executor, use_batch_policy
from contact_sim_pkg.nodes.protocol.endpoints import informed_subscription, raise_kept
from contact_sim_pkg.nodes.protocol.states import Follower, RecordedFollower, RunState
from contact_sim_pkg.records.messages import BenchProgress, BenchRecorded

GATHER_SECONDS = 0.05  # that reports gather for: at full speed each of them would wake this process


class RunMonitor:
    """Follows one run; a context manager that starts and ends rclpy."""

    def __init__(self, arguments: Sequence[str] = ()) -> None:
        """Join the graph; `arguments` are those of ROS (`--ros-args …`)."""
        use_batch_policy()
        rclpy.init(args=list(arguments), signal_handler_options=SignalHandlerOptions.NO)
        self._node = Node("bench_run", start_parameter_services=False, enable_rosout=False)
        self._executor = make_executor()
        self._executor.add_node(self._node)
        self.run, self.recorded = Follower(answers=False), RecordedFollower()
        self.ready_at = self.done_at = self.recorded_at = 0.0  # steady clock, [s]; 0 before
        self._kept = [
            informed_subscription(self._node, "bench/progress", self._on_progress),
            informed_subscription(self._node, "bench/recorded", self._on_recorded),
        ]

    def spin(self, seconds: float) -> None:
        """Handle messages for at most this long, [s]; NodeError where another bench publishes."""
        limit = time.monotonic() + seconds
        left = seconds
        while left >= 0.0:
            handle_messages(self._executor, left, GATHER_SECONDS)
            raise_kept(self._node)
            left = limit - time.monotonic()

    def _on_progress(self, data: bytes, info: dict[str, Any]) -> None:
        if self.run.accept(decode(BenchProgress, data)):
            now = _arrival(info)
            if self.run.state >= RunState.READY and not self.ready_at:
                self.ready_at = now
            self.done_at = now

    def _on_recorded(self, data: bytes, info: dict[str, Any]) -> None:
        recorded = decode(BenchRecorded, data)
        if recorded.block > self.recorded.block:
            self.recorded_at = _arrival(info)
        self.recorded.accept(recorded)

    def __enter__(self) -> RunMonitor:
        """The monitor itself."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Leave the graph."""
        self._node.destroy_node()
        rclpy.try_shutdown()


def _arrival(info: dict[str, Any]) -> float:
    """When a message arrived, [s] of the steady clock: the middleware knows it by the system clock."""
    waited = 1e-9 * (time.time_ns() - int(info["received_timestamp"]))
    return time.monotonic() - min(max(waited, 0.0), GATHER_SECONDS)
