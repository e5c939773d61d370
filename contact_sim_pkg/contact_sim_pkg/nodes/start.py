"""The programs that start one node each, by name: a package that is missing is a sentence, and
no traceback of the node's imports.
"""

from __future__ import annotations

import sys
from functools import partial
from importlib import import_module

from contact_sim_pkg.python_process import disregard_current_folder
from contact_sim_pkg.requirements import package_sentence

__all__ = ["bag_logger", "bag_replay", "bench_view", "contact_simulator", "road_profile", "vibration"]


def _start(node: str) -> int:
    """Run the node of this name; returns the exit status, 2 where a package is missing."""
    disregard_current_folder()
    try:
        status: int = import_module(f"contact_sim_pkg.nodes.{node}").main()
    except Exception as error:
        sentence = package_sentence(error)
        if not sentence:
            raise
        sys.stderr.write(f"{node}: {sentence}\n")
        return 2
    return status


bag_logger = partial(_start, "bag_logger")
bag_replay = partial(_start, "bag_replay")
bench_view = partial(_start, "bench_view")
contact_simulator = partial(_start, "contact_simulator")
road_profile = partial(_start, "road_profile")
vibration = partial(_start, "vibration")
