"""A whole run without ROS: the same generators, simulation and bag as the nodes, in one loop."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any, NamedTuple

from contact_sim_pkg.bag.block_encoder import encode_block
from contact_sim_pkg.bag.errors import BagWriteError, RecordingStoppedError
from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.bag.writer import BagSummary, BagWriter
from contact_sim_pkg.compiled.jit import closed
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.records.messages import String
from contact_sim_pkg.run.bag_content import attachments, recorded_names
from contact_sim_pkg.run.block_simulation import BlockSimulation, cautions_of
from contact_sim_pkg.run.compilation import reported_compilation
from contact_sim_pkg.run.computing import Computing
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.live_parameters import STEERING, Change, ParameterError, by_block, refuse_changes
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.run.sources import Source
from contact_sim_pkg.run.steered_run import SteeredRun
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

NANOSECONDS = 1_000_000_000


class RunProgress(NamedTuple):
    """Progress of a run."""

    block: int  # blocks done
    blocks: int
    simulated: float  # [s]
    real_time_factor: float
    load: float  # [N] largest of the last block
    peak_pressure: float  # [Pa] largest of the last block
    message: str = ""


class RunOutcome(NamedTuple):
    """How a run ended."""

    blocks: int  # done
    startup: float  # [s] from the call to the first block: building, compiling or loading kernels
    wall: float  # [s] from the first block to the last message recorded
    bag: BagSummary | None
    stopped: bool  # ended by the user before the last block
    failure: str  # sentence of the fault that ended it; empty where there is none
    excitation: dict[str, dict[str, Any]]  # by topic, findings in it and their treatment
    loss: str = ""  # sentence of the write that ended the recording, and the run with it


def run_offline(
    scene: ResolvedScene,
    directory: Path | None,
    on_progress: Callable[[RunProgress], None] | None = None,
    stop: Callable[[], bool] | None = None,
    sources: dict[str, Source] | None = None,
    computing: Computing[RunOutcome] | None = None,
    on_set_up: Callable[[str], None] = lambda _sentence: None,
    on_caution: Callable[[str], None] = lambda _sentence: None,
    changes: Sequence[Change] = (),
) -> RunOutcome:
    """Run ``scene`` and record it in ``directory``, which must not exist (None: no recording).

    ``sources`` replaces the scene's own excitation (a bag's, for one). ``stop`` is called once all
    is compiled, where nothing has been created yet, and before each block. A fault of the
    physics or of the excitation ends the run, as does a write that fails: the bag is closed and the
    outcome names it. Raises what a bad scene, file or directory raises, before anything is created.
    ``computing`` lets another thread end it within a block. ``on_set_up`` gets a sentence each
    second in which kernels are compiled, from a thread of its own; ``on_caution`` what is to be
    said once before the run. ``changes`` are made before their blocks, and recorded.
    """
    refuse_changes(scene, changes)
    began, computing = time.perf_counter(), computing or Computing()
    simulation = _prepared(scene, on_set_up, on_caution)
    run, due = SteeredRun(scene, simulation, sources), dict(by_block(changes))
    descriptions = {topic: source.describe() for topic, source in run.sources.items()}
    if stop is not None and stop():
        return RunOutcome(0, time.perf_counter() - began, 0.0, None, True, "", descriptions)
    writer = None
    if directory is not None:
        names = [*recorded_names(scene), *([STEERING] if due else [])]
        writer = BagWriter(directory, recorded_topics(names), attachments(scene, descriptions))
    startup = time.perf_counter() - began
    first = time.perf_counter()
    done, failure, stopped, loss = 0, "", False, ""

    def ended() -> RunOutcome:
        summary = None if writer is None else writer.close(_outcome(done, simulation.blocks, failure, stopped, first))
        return RunOutcome(
            blocks=done, startup=startup, wall=time.perf_counter() - first, bag=summary, stopped=stopped, failure=failure,
            excitation=descriptions, loss=loss,
        )  # fmt: skip

    compilation = ExitStack()  # closed while the blocks run; open again behind a thread that does not return

    def abandoned() -> RunOutcome:
        nonlocal stopped
        stopped = True
        compilation.close()
        return ended()

    computing.end = abandoned
    try:
        if writer is not None:
            writer.write("bench/scene", 0, encode(String(data=scene.to_yaml())))
        with compilation:
            compilation.enter_context(closed())
            for block in range(simulation.blocks):
                if stop is not None and stop():
                    stopped = True
                    break
                progress = _one_block(run, due.get(block, {}), block, writer, first, computing)
                done = block + 1
                if on_progress is not None:
                    on_progress(progress)
    except (RunError, ExcitationError, ParameterError) as error:
        failure = str(error)
    except (BagWriteError, RecordingStoppedError) as error:
        loss = str(error)
    except BaseException as error:
        failure = _unexpected(error, done)
        ended()
        raise
    return ended()


def _prepared(
    scene: ResolvedScene, on_set_up: Callable[[str], None], on_caution: Callable[[str], None]
) -> BlockSimulation:
    """The simulation, all that it needs compiled."""
    with reported_compilation(scene, on_set_up):
        simulation = make_simulation(scene)
        simulation.prepare()
    for sentence in cautions_of(simulation):
        on_caution(sentence)
    return simulation


def _unexpected(error: BaseException, block: int) -> str:
    if isinstance(error, MemoryError):
        return f"out of memory in block {block}: {error}; take a smaller grid, or let the run have more"
    return f"unexpected {type(error).__name__}: {error}" if isinstance(error, Exception) else ""


def _outcome(done: int, blocks: int, failure: str, stopped: bool, first: float) -> dict[str, str]:
    ended = "failed" if failure else "stopped" if stopped or done < blocks else "finished"
    return {"ended": ended, "blocks_done": str(done), "failure": failure, "wall_s": repr(time.perf_counter() - first)}


def _one_block(
    run: SteeredRun,
    changes: Mapping[str, float],
    block: int,
    writer: BagWriter | None,
    first: float,
    computing: Computing[RunOutcome],
) -> RunProgress:
    length = run.scene.block_length
    stamp = block * round(length * NANOSECONDS)
    changed = computing.call(run.change, block, changes) if changes else []
    # the inputs are recorded too, before the results of the block
    inputs = {topic: source.block(block) for topic, source in run.sources.items()}
    result = computing.call(run.simulation.advance, block, inputs)
    if writer is not None:
        ranked = sorted(inputs, key=lambda name: TOPICS[name].rank)
        given = [(topic, stamp, encode(inputs[topic], stamp)) for topic in ranked]
        writer.write_all([*given, *encode_block(changed), *result.messages])
    simulated = (block + 1) * length
    elapsed = time.perf_counter() - first
    blocks = run.simulation.blocks
    return RunProgress(block + 1, blocks, simulated, simulated / elapsed, result.load, result.peak_pressure)
