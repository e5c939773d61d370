"""Everything that the simulator publishes: progress, scene, results, clock, diagnostics."""

from __future__ import annotations

import time
from collections.abc import Iterable
from contextlib import AbstractContextManager
from functools import partial

from rclpy.node import Node

from contact_sim_pkg.bag.block_encoder import Message
from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.nodes.clock import SimulatedClock
from contact_sim_pkg.nodes.diagnostics import Diagnostics
from contact_sim_pkg.nodes.processes.scene_file import queue_depth
from contact_sim_pkg.nodes.protocol.endpoints import publisher
from contact_sim_pkg.nodes.protocol.progress_report import ProgressReport
from contact_sim_pkg.nodes.protocol.states import RunState
from contact_sim_pkg.records.messages import String
from contact_sim_pkg.run.bag_content import result_names
from contact_sim_pkg.run.block_simulation import BlockResult
from contact_sim_pkg.run.compilation import reported_compilation
from contact_sim_pkg.scene.resolved_scene import ResolvedScene


class SimulatorPublishers:
    """Publishers of one run."""

    def __init__(
        self,
        node: Node,
        scene: ResolvedScene,
        excitation: Iterable[str] = (),
        *,
        clock: bool,
        report: ProgressReport | None = None,
    ) -> None:
        """Report STARTING and publish the scene.

        Args:
            node: has the publishers.
            scene: the scene.
            excitation: topics of the excitation that the simulator makes itself, and of what steers it.
            clock: publish `/clock` too.
            report: of a run that has none yet, where it is not that of a first one.
        """
        self.progress = report or ProgressReport(publisher(node, "bench/progress"), scene)
        self.progress.send(RunState.STARTING, "compiling")
        self.results = {name: publisher(node, name, queue_depth(scene)) for name in (*excitation, *result_names(scene))}
        self.clock = SimulatedClock(node, wanted=clock)
        self.diagnostics = Diagnostics(node)
        self._scene = publisher(node, "bench/scene")
        self._scene.publish(encode(String(data=scene.to_yaml())))
        self._block_length_ns, self._compiled = scene.block_length_ns, scene

    def compiling(self) -> AbstractContextManager[None]:
        """While the block of code lasts, `bench/progress` reports the kernels that it compiles."""
        return reported_compilation(self._compiled, partial(self.progress.send, RunState.STARTING))

    def publish(self, number: int, result: BlockResult, excitation: Iterable[Message] = ()) -> None:
        """Send the messages of a block, after the excitation that the simulator has made, and the simulated time of its end."""
        for topic, _, data in (*excitation, *result.messages):
            self.results[topic].publish(data)
        self.clock.publish(time.monotonic(), (number + 1) * self._block_length_ns)

    def settle(self) -> None:
        """Wait shortly until the last reports have arrived."""
        self.progress.settle()
        self.diagnostics.settle()
