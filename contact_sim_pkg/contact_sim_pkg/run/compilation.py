"""Compilation before a run: the first start of a scene, or of an effect, takes its time. It is
reported, and shared with a second process.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager

from contact_sim_pkg.compiled.companion import accompanied
from contact_sim_pkg.compiled.jit import compiled_kernels
from contact_sim_pkg.compiled.kernel_cache import cache_directory
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["compile_other_half", "note_computation", "reported_compilation"]

PERIOD = 1.0  # [s] between two looks
_computation: list[str] = [""]  # beside compiling: what takes its time now


def note_computation(sentence: str) -> None:
    """What is computed before the run, for the reports of `reported_compilation`; empty: nothing."""
    _computation[0] = sentence


@contextmanager
def reported_compilation(scene: ResolvedScene, report: Callable[[str], None]) -> Iterator[None]:
    """While the block of code lasts, a second process compiles what the rig lets it, and ``report``
    gets a sentence each second in which kernels were compiled, from a thread of its own: their
    number in both, what the richest scene of the rig compiles, seconds so far; or what was noted as
    computed. Silent where all comes from the cache.
    """
    over, began, before = threading.Event(), time.monotonic(), _kernels()
    expected = rigs()[scene.data["rig"]].kernels

    def repeat() -> None:
        reported = 0
        while not over.wait(PERIOD):
            number = _kernels() - before
            if number > reported:
                reported = number
                of = f" of about {expected}" if expected >= number else ""
                report(f"compiling kernels, once: {number}{of}, {time.monotonic() - began:.0f} s")
            elif _computation[0]:
                report(f"{_computation[0]}, {time.monotonic() - began:.0f} s")

    thread = threading.Thread(target=repeat, name="reported compilation", daemon=True)
    thread.start()
    try:
        with ExitStack() as stack:
            if rigs()[scene.rig].other_half and cache_directory() is not None:
                stack.enter_context(accompanied(f"{__name__}:{compile_other_half.__name__}", scene.to_yaml()))
            yield
    finally:
        over.set()
        thread.join()


def _kernels() -> int:
    directory = cache_directory()
    if directory is None:
        return compiled_kernels()
    try:
        return sum(1 for _ in directory.iterdir())
    except OSError:  # somebody has emptied the cache; what comes next makes the directory anew
        return 0


def compile_other_half(text: str) -> None:
    """In the second process: what the rig of a resolved scene, as YAML, lets it compile."""
    scene = ResolvedScene.from_own_yaml(text, {})
    load(rigs()[scene.rig].other_half)(scene)
