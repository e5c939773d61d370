"""Latency of a recorded run at real time: from the moment at which the last excitation of a block is
sent until the last force of that block has arrived, at a subscriber of its own process.

    python -m contact_sim_lab.nodes.latency SCENE SECONDS

It runs the scene as a user does, on nodes, and prints one JSON object. Both moments are time stamps
of the middleware on this machine; the waiting of the subscriber's own Python does not count.
"""

from __future__ import annotations

import json
import sys
from typing import Any

import numpy

from contact_sim_lab.nodes.outside import follow_run
from contact_sim_pkg.bag.messages import stamp_of
from contact_sim_pkg.run.bag_content import input_names, result_names
from contact_sim_pkg.scene.resolve import load_resolved


class Latencies:
    """Times of the blocks of one run, [ns] of the system clock, from messages in any order."""

    def __init__(self, block_length_ns: int, forces: int) -> None:
        """No message; `forces`: force topics of the scene."""
        self._block_length_ns, self._forces = block_length_ns, forces
        self._sent: dict[int, int] = {}
        self._arrived: dict[int, list[int]] = {}

    def on_input(self, data: bytes, info: dict[str, Any]) -> None:
        """A block of excitation."""
        block = stamp_of(data) // self._block_length_ns
        self._sent[block] = max(self._sent.get(block, 0), info["source_timestamp"])

    def on_force(self, data: bytes, info: dict[str, Any]) -> None:
        """The force of a block."""
        block = stamp_of(data) // self._block_length_ns
        self._arrived.setdefault(block, []).append(info["received_timestamp"])

    def figures(self) -> dict[str, float]:
        """Number of blocks; median, 99th percentile and maximum of their latency, [s].

        ValueError where no block is there whole.
        """
        whole = [block for block, times in self._arrived.items() if len(times) == self._forces and block in self._sent]
        if not whole:
            raise ValueError("no block came with its excitation and its forces")
        found = numpy.array([max(self._arrived[block]) - self._sent[block] for block in whole]) * 1e-9
        p50, p99 = numpy.percentile(found, (50.0, 99.0))
        return {"blocks": len(whole), "p50": float(p50), "p99": float(p99), "largest": float(found.max())}


def measure(name: str, seconds: float) -> dict[str, float]:
    """Figures of a run of the scene over this simulated time, [s]; ValueError where it fails."""
    scene = load_resolved(name)
    forces = [topic for topic in result_names(scene) if topic.endswith("/force")]
    latencies = Latencies(scene.block_length_ns, len(forces))
    callbacks = dict.fromkeys(input_names(scene), latencies.on_input) | dict.fromkeys(forces, latencies.on_force)
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
