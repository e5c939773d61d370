"""What the simulator of a run on nodes does and waits for, over a part of a second, drawn:

    python -m contact_sim_lab.nodes.trace SCENE PICTURE

The scene runs as fast as it can. Of each block: when its last excitation was sent, when it was done,
when the logger had it, by the middleware's time stamps; of the simulator's thread: its time on a
core, and in the queue for one, by the kernel's schedule (`/proc/*/schedstat`, Linux).
"""

from __future__ import annotations

import json
import sys
import threading
import time
from pathlib import Path
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.nodes.outside import follow_run
from contact_sim_pkg.bag.messages import decode, stamp_of
from contact_sim_pkg.nodes.protocol.window import AHEAD
from contact_sim_pkg.records.messages import BenchProgress, BenchRecorded
from contact_sim_pkg.run.bag_content import input_names
from contact_sim_pkg.scene.resolve import load_resolved

__all__ = ["Events", "Schedule", "draw", "shares", "trace"]

SAMPLE_SECONDS = 2e-3  # between two looks at the schedule
SIMULATED = 20.0  # [s] of the run
DRAWN, BIN_SECONDS = 0.5, 0.01  # [s] of the picture

Values = NDArray[numpy.float64]


class Events:
    """When each block was sent, done and recorded: [ns] of the system clock, by block."""

    def __init__(self, block_length_ns: int) -> None:
        """No message."""
        self._block_length_ns = block_length_ns
        self.sent: dict[int, int] = {}
        self.done: dict[int, int] = {}
        self.recorded: dict[int, int] = {}

    def on_input(self, data: bytes, info: dict[str, Any]) -> None:
        """A block of excitation."""
        block = stamp_of(data) // self._block_length_ns
        self.sent[block] = max(self.sent.get(block, 0), info["source_timestamp"])

    def on_progress(self, data: bytes, info: dict[str, Any]) -> None:
        """A report of the simulator."""
        self.done.setdefault(decode(BenchProgress, data).block, info["source_timestamp"])

    def on_recorded(self, data: bytes, info: dict[str, Any]) -> None:
        """An answer of the logger: every block up to its own."""
        self.recorded.setdefault(decode(BenchRecorded, data).block, info["source_timestamp"])

    def steps(self, events: dict[int, int]) -> tuple[Values, Values]:
        """Times [s] of the system clock, in order, and the last block at each."""
        blocks = numpy.array(sorted(events), dtype=numpy.float64)
        return numpy.array([1e-9 * events[int(block)] for block in blocks]), blocks


class Schedule(NamedTuple):
    """What the kernel says of one thread, at samples: all [s]."""

    at: Values  # of the system clock
    on_core: Values
    in_queue: Values


class _Sampler(threading.Thread):
    """Samples the schedule of the simulator's main thread until its process has ended."""

    def __init__(self, supervisor: int) -> None:
        super().__init__(daemon=True)
        self._supervisor, self._rows = supervisor, list[tuple[float, float, float]]()

    def run(self) -> None:
        path = Path(f"/proc/{_simulator_of(self._supervisor)}/schedstat")
        while True:
            try:
                on_core, in_queue, _count = path.read_text(encoding="ascii").split()
            except OSError:
                return
            self._rows.append((time.time(), 1e-9 * int(on_core), 1e-9 * int(in_queue)))
            time.sleep(SAMPLE_SECONDS)

    def schedule(self) -> Schedule:
        return Schedule(*numpy.array(self._rows).reshape(-1, 3).T)


def _simulator_of(supervisor: int) -> int:
    """Number of the simulator's process; 0 where there is none."""
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            status = (entry / "stat").read_text(encoding="utf-8").rpartition(")")[2].split()
            command = (entry / "cmdline").read_bytes()
        except OSError:  # ended meanwhile
            continue
        if int(status[1]) == supervisor and b"contact_simulator" in command:
            return int(entry.name)
    return 0


def trace(name: str) -> tuple[Events, Schedule]:
    """Events and schedule of a run of a scene at full speed; ValueError where it fails, or ends within a
    second.
    """
    scene = load_resolved(name)
    events = Events(scene.block_length_ns)
    callbacks = dict.fromkeys(input_names(scene), events.on_input)
    callbacks |= {"bench/progress": events.on_progress, "bench/recorded": events.on_recorded}
    samplers = list[_Sampler]()

    def join(supervisor: int) -> None:
        samplers.append(_Sampler(supervisor))
        samplers[0].start()

    follow_run(name, scene, ("--duration", str(SIMULATED), "--pace", "max"), callbacks, join)
    samplers[0].join()
    schedule = samplers[0].schedule()
    if not set(events.sent) & set(events.done) or len(schedule.at) < 2:
        raise ValueError(f"{name} ended before it could be followed; trace a scene that takes longer to compute")
    return events, schedule


def shares(events: Events, schedule: Schedule) -> dict[str, float]:
    """Shares of the time of a trace in which the simulator's thread was on a core, in the queue for
    one, and waited for a message; and of that wait, in which the window was closed by the logger, or
    the block due was not sent. Blocks a second.
    """
    blocks = sorted(set(events.sent) & set(events.done))
    begin, end = 1e-9 * events.done[blocks[0]], 1e-9 * events.done[blocks[-1]]
    inside = (schedule.at >= begin) & (schedule.at <= end)
    at, on_core, in_queue = (column[inside] for column in schedule)
    whole = at[-1] - at[0]
    core, queue = (on_core[-1] - on_core[0]) / whole, (in_queue[-1] - in_queue[0]) / whole
    # At each moment: the block due, whether it was sent, and whether the logger let it be sent
    places = numpy.linspace(at[0], at[-1], 20_000)
    done, sent, recorded = (
        _last_at(places, *events.steps(each)) for each in (events.done, events.sent, events.recorded)
    )
    lacking = sent < done + 1
    closed = lacking & (done + 1 > recorded + AHEAD)
    return {
        "on_core": core, "in_queue": queue, "waiting": 1.0 - core - queue,
        "block_not_sent": float(lacking.mean()), "window_closed_by_logger": float(closed.mean()),
        "blocks_per_second": (blocks[-1] - blocks[0]) / (end - begin),
    }  # fmt: skip


def _last_at(places: Values, times: Values, blocks: Values) -> Values:
    """The last block at each of the `places`, all [s]; -1 before the first."""
    return numpy.concatenate(([-1.0], blocks))[numpy.searchsorted(times, places, side="right")]


def draw(events: Events, schedule: Schedule, picture: Path) -> None:
    """Draw a part of the middle of a trace."""
    from matplotlib.figure import Figure

    middle = 0.5 * (schedule.at[0] + schedule.at[-1])
    figure = Figure(figsize=(11.0, 6.0), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1))
    for label, each in (("excitation sent", events.sent), ("done", events.done), ("recorded", events.recorded)):
        at, blocks = events.steps(each)
        above.step(1e3 * (at - middle), blocks, where="post", label=label)
    # The kernel counts now and then: only over several of its ticks is that a share
    edges = numpy.arange(0.0, DRAWN + 0.5 * BIN_SECONDS, BIN_SECONDS)
    for label, column in (("on a core", schedule.on_core), ("in the queue for one", schedule.in_queue)):
        spent = numpy.diff(numpy.interp(middle + edges, schedule.at, column)) / BIN_SECONDS
        below.stairs(spent, 1e3 * edges, fill=True, alpha=0.6, label=label)
    times, blocks = events.steps(events.done)
    seen = blocks[(times >= middle) & (times <= middle + DRAWN)]
    if len(seen):
        above.set_ylim(seen[0] - AHEAD, seen[-1] + 2 * AHEAD)
    above.set_xlim(0.0, 1e3 * DRAWN)
    above.set_ylabel("block")
    below.set_ylabel("simulator's thread")
    below.set_xlabel("time [ms]")
    for axes in (above, below):
        axes.legend(loc="upper left")
        axes.grid(alpha=0.3)
    figure.savefig(picture, dpi=110)


def main() -> int:
    """Trace, print the shares, draw; returns the exit status."""
    try:
        events, schedule = trace(sys.argv[1])
        picture = Path(sys.argv[2])
    except (ValueError, IndexError) as error:
        sys.stderr.write(f"{error}\n")
        return 1
    sys.stdout.write(json.dumps(shares(events, schedule)) + "\n")
    draw(events, schedule, picture)
    return 0


if __name__ == "__main__":
    sys.exit(main())
