"""Latency of a recorded run at real time: from the moment at which the last excitation of a block is
sent until the last force of that block has arrived, at a subscriber of its own process.

    python -m contact_sim_lab.nodes.latency SCENE SECONDS

It runs the scene as a user does, on nodes, and prints one JSON object. Both moments are time stamps
of the middleware on this machine; the waiting of the subscriber's own Python does not count.
"""

from __future__ import annotations

import json
import statistics
import sys
from typing import Any

import numpy

from contact_sim_lab.nodes.outside import follow_run
from contact_sim_pkg.bag.messages import decode, stamp_of
from contact_sim_pkg.records.messages import SolverCost
from contact_sim_pkg.run.bag_content import input_names, result_names
from contact_sim_pkg.scene.resolve import load_resolved

COST = "bench/cost"


class Latencies:
    """Times of the blocks of one run, [ns] of the system clock, from messages in any order."""

    def __init__(self, block_length_ns: int, forces: int) -> None:
        """No message; `forces`: force topics of the scene."""
        self._block_length_ns, self._forces = block_length_ns, forces
        self._sent: dict[int, int] = {}
        self._arrived: dict[int, list[int]] = {}
        self._cost: dict[int, SolverCost] = {}

    def on_cost(self, data: bytes, info: dict[str, Any]) -> None:
        """What a block cost."""
        cost = decode(SolverCost, data)
        self._cost[cost.block] = cost

    def on_input(self, data: bytes, info: dict[str, Any]) -> None:
        """A block of excitation."""
        block = stamp_of(data) // self._block_length_ns
        self._sent[block] = max(self._sent.get(block, 0), info["source_timestamp"])

    def on_force(self, data: bytes, info: dict[str, Any]) -> None:
        """The force of a block."""
        block = stamp_of(data) // self._block_length_ns
        self._arrived.setdefault(block, []).append(info["received_timestamp"])

    def figures(self) -> dict[str, Any]:
        """Number of blocks; median, 99th percentile and maximum of their latency, [s]; the block of the maximum with its cause;
        number of overruns: blocks whose forces arrived later behind their excitation than a block lasts.

        ValueError where no block is there whole.
        """
        whole = [block for block, times in self._arrived.items() if len(times) == self._forces and block in self._sent]
        if not whole:
            raise ValueError("no block came with its excitation and its forces")
        found = numpy.array([max(self._arrived[block]) - self._sent[block] for block in whole]) * 1e-9
        p50, p99 = numpy.percentile(found, (50.0, 99.0))
        cause = self._cause(whole[int(found.argmax())], float(found.max()))
        return {
            "blocks": len(whole), "p50": float(p50), "p99": float(p99), "largest": float(found.max()), "cause": cause,
            "overruns": int((found > 1e-9 * self._block_length_ns).sum()),
        }  # fmt: skip

    def _cause(self, block: int, latency: float) -> str:
        """What the block of the longest latency, [s], spent it on; empty where its cost has not come."""
        cost = self._cost.get(block)
        if cost is None:
            return ""
        steps = statistics.median(each.coupling_steps for each in self._cost.values())
        where = "computed" if cost.wall_time > 0.5 * latency else "waited for a processor, a message or the logger"
        physics = f"{1e3 * cost.wall_time:.3g} ms of physics, {cost.coupling_steps} coupling steps"
        return f"block {block}: {where}; {physics} (median {steps:g})"


def measure(name: str, seconds: float) -> dict[str, Any]:
    """Figures of a run of the scene over this simulated time, [s]; ValueError where it fails."""
    scene = load_resolved(name)
    forces = [topic for topic in result_names(scene) if topic.endswith("/force")]
    latencies = Latencies(scene.block_length_ns, len(forces))
    callbacks = dict.fromkeys(input_names(scene), latencies.on_input) | dict.fromkeys(forces, latencies.on_force)
    callbacks[COST] = latencies.on_cost
    follow_run(name, scene, ("--duration", str(seconds), "--pace", "realtime"), callbacks)
    return latencies.figures()


def main() -> int:
    """Measure; returns the exit status."""
    try:
        figures = measure(sys.argv[1], float(sys.argv[2]))
    except (ValueError, IndexError) as error:
        sys.stderr.write(f"{error}\n")
        return 1
    sys.stdout.write(json.dumps(figures) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
