"""State and end of a supervised run, as the supervisor reports them. Without ROS."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

from contact_sim_pkg.nodes.protocol.states import RunState
from contact_sim_pkg.records.messages import BenchProgress


class Report(NamedTuple):
    """State of a supervised run, for the display."""

    state: str
    block: int  # blocks done
    blocks: int
    simulated: float  # [s]
    real_time_factor: float
    load: float  # [N]
    peak_pressure: float  # [Pa]
    message: str  # before the first block and in a pause: what the simulator is doing


class SupervisedRun(NamedTuple):
    """How a supervised run ended."""

    blocks: int  # done
    startup: float  # [s] from the call to ready
    wall: float  # [s] from ready to the last message recorded
    bag: Path | None  # None where nothing was recorded
    stopped: bool  # ended by the user before the last block
    failure: str  # sentence of the fault that ended it; empty where there is none
    exit_status: int
    excitation: dict[str, dict[str, Any]]  # by topic, findings in it and their treatment


def report_of(progress: BenchProgress, block_length: float) -> Report:
    """The report of a progress message; ``block_length``: simulated time of a block in [s]."""
    return Report(
        state=RunState(progress.state).name.lower(),
        block=progress.block + 1,
        blocks=progress.blocks,
        simulated=(progress.block + 1) * block_length,
        real_time_factor=progress.real_time_factor,
        load=progress.load,
        peak_pressure=progress.peak_pressure,
        message="" if RunState(progress.state).ended else progress.message,
    )
