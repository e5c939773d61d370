"""Reports while kernels are compiled: the first start of a scene, or of an effect, takes its time."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from contact_sim_pkg.compiled.jit import compiled_kernels
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["reported_compilation"]

PERIOD = 1.0  # [s] between two looks


@contextmanager
def reported_compilation(scene: ResolvedScene, report: Callable[[str], None]) -> Iterator[None]:
    """While the block of code lasts, ``report`` gets a sentence each second in which kernels were
    compiled, from a thread of its own: their number, what the richest scene of the rig compiles,
    seconds so far. Silent where all kernels come from the cache.
    """
    over, began, before = threading.Event(), time.monotonic(), compiled_kernels()
    expected = rigs()[scene.data["rig"]].kernels

    def repeat() -> None:
        reported = 0
        while not over.wait(PERIOD):
            number = compiled_kernels() - before
            if number > reported:
                reported = number
                of = f" of about {expected}" if expected >= number else ""
                report(f"compiling kernels, once: {number}{of}, {time.monotonic() - began:.0f} s")

    thread = threading.Thread(target=repeat, name="reported compilation", daemon=True)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()
