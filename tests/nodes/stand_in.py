"""A vibration node of the tests' own: sends what a test wants to send, through the real middleware."""

import time

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from tests.bench_process import LONGEST

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.nodes.protocol.endpoints import publisher, subscription
from contact_sim_pkg.nodes.protocol.states import RunState
from contact_sim_pkg.nodes.protocol.window import AHEAD
from contact_sim_pkg.records.messages import BenchProgress, BenchRecorded


class StandIn:
    """A node in the process of the test; a context manager."""

    def __init__(self, name: str = "stand_in", topic: str = "platform/vibration") -> None:
        self._context = rclpy.Context()
        rclpy.init(context=self._context, signal_handler_options=SignalHandlerOptions.NO)
        self.node = Node(name, context=self._context, start_parameter_services=False, enable_rosout=False)
        self.progress: BenchProgress | None = None
        self.recorded = -1  # last block that the logger has answered for
        self.entry = publisher(self.node, topic, 2 * AHEAD)  # the logger may be a window behind
        self._kept = [
            subscription(self.node, "bench/progress", self._on_progress),
            subscription(self.node, "bench/recorded", self._on_recorded),
        ]
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)

    def _on_progress(self, data: bytes) -> None:
        self.progress = decode(BenchProgress, data)

    def _on_recorded(self, data: bytes) -> None:
        self.recorded = decode(BenchRecorded, data).block

    def spin_until(self, condition, seconds: float = LONGEST) -> None:
        """Hear what comes until the condition holds; fails after the time."""
        limit = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < limit, f"timed out; last heard {self.progress}"
            self._executor.spin_once(timeout_sec=0.02)

    def spin_until_quiet(self, heard: list[bytes]) -> int:
        """Hear what comes until nothing has been heard for a second; returns how many were."""
        count, since = -1, time.monotonic()

        def is_quiet() -> bool:
            nonlocal count, since
            if len(heard) != count:
                count, since = len(heard), time.monotonic()
            return time.monotonic() - since > 1.0

        self.spin_until(is_quiet)
        return count

    def wait_ready(self, listeners: int) -> None:
        """Until the run is ready and so many subscribers are matched."""
        self.spin_until(lambda: self.progress is not None and self.progress.state >= RunState.READY)
        self.spin_until(lambda: self.entry.get_subscription_count() >= listeners)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._executor.shutdown()
        self.node.destroy_node()
        self._context.try_shutdown()
