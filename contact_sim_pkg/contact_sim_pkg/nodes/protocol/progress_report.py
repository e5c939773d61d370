"""The simulator's reports on `bench/progress`."""

from __future__ import annotations

import time

from rclpy.duration import Duration
from rclpy.publisher import Publisher

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.nodes.protocol.states import RunState
from contact_sim_pkg.records.messages import BenchProgress
from contact_sim_pkg.run.block_simulation import BlockResult
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

SETTLE_SECONDS = 1.0  # for the last report to be acknowledged


class ProgressReport:
    """State of the run, block by block; the one place that counts the messages sent."""

    def __init__(self, publisher: Publisher, scene: ResolvedScene) -> None:
        """Nothing sent; state IDLE; of the first run."""
        self.publisher = publisher
        self.state = RunState.IDLE
        self._scene = scene.name
        self._blocks, self._period_ns = scene.blocks, scene.block_length_ns
        self.number = 0  # of the run
        self.last: BenchProgress | None = None
        self._begin()

    def _begin(self) -> None:
        self._block, self._sent = -1, 0
        self._load = self._peak = 0.0
        self._began: float | None = None  # later by each pause
        self._paused: float | None = None

    def begin_anew(self) -> None:
        """The next run, of which nothing is done."""
        self.number += 1
        self._begin()

    def send(self, state: RunState, message: str = "") -> None:
        """Report a state, with one sentence for a person."""
        now = time.monotonic()
        if state is RunState.READY:
            self._began = now
        if self._began is not None and self._paused is not None:
            self._began += now - self._paused
        self._paused = now if state is RunState.PAUSED else None
        self.state = state
        elapsed = 0.0 if self._began is None else now - self._began
        # the stamp is the end of the last block done; the speed counts from block 0
        simulated_ns = (self._block + 1) * self._period_ns
        factor = simulated_ns * 1e-9 / elapsed if elapsed > 0.0 else 0.0
        self.last = BenchProgress(
            state=int(state),
            run=self.number,
            block=self._block,
            blocks=self._blocks,
            messages_sent=self._sent,
            real_time_factor=factor,
            load=self._load,
            peak_pressure=self._peak,
            scene=self._scene,
            message=message,
        )
        self.publisher.publish(encode(self.last, simulated_ns))

    def block_done(self, block: int, result: BlockResult) -> None:
        """Report a block after its messages; FINISHED with the last one of the scene."""
        self._block, self._sent = block, self._sent + len(result.messages)
        self._load, self._peak = result.load, result.peak_pressure
        is_last = block == self._blocks - 1
        self.send(RunState.FINISHED if is_last else self.state if self.state is RunState.PAUSED else RunState.RUNNING)

    @property
    def real_time_factor(self) -> float:
        """Simulated time over wall time since block 0, as it was last reported."""
        return 0.0 if self.last is None else self.last.real_time_factor

    def describe(self) -> str:
        """State, simulated time and speed, for a person."""
        simulated = (self._block + 1) * self._period_ns * 1e-9
        return f"{self._scene}: {self.state.name.lower()} after {simulated:g} s, {self.real_time_factor:.3g}x real time"

    def settle(self) -> None:
        """Wait until everybody has the last report, for one second at most."""
        self.publisher.wait_for_all_acked(Duration(seconds=SETTLE_SECONDS))
