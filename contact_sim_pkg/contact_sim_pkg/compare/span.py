"""A span of a scene: some of its blocks, run without a bag, for comparison."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import NamedTuple, Protocol, runtime_checkable

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.compare.columns import Column, Key, columns_of, judged_topics
from contact_sim_pkg.records.messages import SolverCost
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.run.block_simulation import BlockSimulation
from contact_sim_pkg.run.compilation import reported_compilation
from contact_sim_pkg.run.rigs import make_simulation, result_topics
from contact_sim_pkg.run.sources import Source, make_sources
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["Notify", "Span", "SpanRun", "begins_later", "prepared", "run_span"]

Notify = Callable[[str], None]
PERIOD = 2.0  # [s] between two lines of progress


class Span(NamedTuple):
    """Blocks of a scene."""

    first: int  # the run begins here
    shown: int  # first block that counts; those before lead in
    end: int  # first block behind it

    @property
    def lead(self) -> int:
        """Blocks that lead in."""
        return self.shown - self.first


class SpanRun(NamedTuple):
    """What a span of a scene came to."""

    columns: dict[Key, Column]  # judged ones, without those of the lead-in
    outputs: list[Output]  # the same blocks, of topics with judged columns
    costs: list[SolverCost]  # of all blocks
    cpu: float  # [s] of this process in all blocks
    blocks: int  # that were run


@runtime_checkable
class LaterStart(Protocol):
    """A simulation that can begin with a later block."""

    def begin_at(self, block: int) -> None:
        """Begin at rest with a later block. After `prepare`."""


def begins_later(scene: ResolvedScene) -> bool:
    """Whether the simulation of a scene can begin with a later block."""
    return hasattr(load(rigs()[scene.rig].simulation), "begin_at")


def prepared(scene: ResolvedScene, notify: Notify, *, first: bool = False) -> BlockSimulation:
    """The simulation of a scene with its kernels; the ``first`` of a process reports compilation."""
    with _reported(scene, notify, first=first):
        simulation = make_simulation(scene)
        simulation.prepare()
    return simulation


@contextmanager
def _reported(scene: ResolvedScene, notify: Notify, *, first: bool) -> Iterator[None]:
    if not first:
        yield
        return
    with reported_compilation(scene, notify):
        yield


def run_span(
    scene: ResolvedScene,
    span: Span,
    notify: Notify,
    *,
    simulation: BlockSimulation | None = None,
    sources: Mapping[str, Source] | None = None,
    most_cpu: float = float("inf"),
) -> SpanRun:
    """Run the blocks of a span, fewer where they take more than ``most_cpu`` [s].

    Raises RunError where the physics ends in a named failure.
    """
    simulation = simulation or prepared(scene, notify)
    sources = make_sources(scene) if sources is None else sources
    if isinstance(simulation, LaterStart):
        simulation.begin_at(span.first)
    kept, costs = set(judged_topics(result_topics(scene))), []
    outputs: list[Output] = []
    cpu, said = 0.0, time.monotonic()
    for block in range(span.first, span.end):
        inputs = {topic: source.block(block) for topic, source in sources.items()}
        began = time.process_time()
        result = simulation.advance(block, inputs)
        cpu += time.process_time() - began
        costs += [each.record for each in result.outputs if isinstance(each.record, SolverCost)]
        if block >= span.shown:
            outputs += [each for each in result.outputs if each.topic in kept]
        if time.monotonic() - said > PERIOD:
            said = time.monotonic()
            notify(f"  block {block + 1 - span.first} of {span.end - span.first}, {cpu:.0f} CPU s")
        if cpu > most_cpu and block >= span.shown:
            break
    done = block + 1 - span.first
    return SpanRun(columns_of(outputs), outputs, costs, cpu, done)
