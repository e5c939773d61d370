"""A whole run of a scene for its metrics: recorded, read and thrown away."""

from __future__ import annotations

import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.compare.span import Notify
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.offline import RunProgress, run_offline
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["WholeRun", "whole_run"]


class WholeRun(NamedTuple):
    """What a run recorded, and what it took."""

    recording: Recording
    cost: float
    """[ms] of CPU per simulated second, from the end of the first block to that of the last"""


def whole_run(scene: ResolvedScene, notify: Notify) -> WholeRun:
    """Run a scene to its end. Raises RunError where it ends before."""
    cpu: list[float] = []

    def on_progress(_progress: RunProgress) -> None:
        cpu.append(time.process_time())

    with tempfile.TemporaryDirectory(prefix="contact_bench_") as folder:
        path = Path(folder) / "bag"
        outcome = run_offline(scene, path, on_progress, on_set_up=notify)
        if outcome.failure or outcome.loss:
            raise RunError(outcome.failure or outcome.loss)
        seconds = (scene.blocks - 1) * scene.block_length
        cost = 1e3 * (cpu[-1] - cpu[0]) / seconds if seconds > 0.0 else 0.0
        return WholeRun(read_recording(open_bag(path)), cost)
