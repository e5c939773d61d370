"""One case: its scene, the name that says all it follows from, its run, and what it gave."""

from __future__ import annotations

import functools
import hashlib
import json
import platform
import shutil
import tempfile
import time
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from contact_sim_pkg.compiled.jit import closed
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.files import RefusedError, new_file
from contact_sim_pkg.report.export.table import has_columns, table_of_records
from contact_sim_pkg.report.metrics.curve_bands import CurveBand
from contact_sim_pkg.report.metrics.of_bag import metrics_of_bags
from contact_sim_pkg.report.metrics.views import rows_of
from contact_sim_pkg.report.reading import MOTION_COLUMNS, motion_series
from contact_sim_pkg.rigs.vehicle.seat.report.response import transmissibility_curve
from contact_sim_pkg.rigs.vehicle.seat.report.ride import ride_signals
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.offline import NANOSECONDS, run_offline
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.run.tables_between import KeyRange, tables_between
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import resolve
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = [
    "FAILED",
    "FINISHED",
    "REFUSED",
    "Numbered",
    "Row",
    "Task",
    "case_name",
    "failed",
    "kept_row",
    "machine",
    "run_case",
    "scene_of",
    "sources_hash",
]

FINISHED, FAILED, REFUSED = "finished", "failed", "refused"
NOT_PHYSICS = ("name", "description", "pace")
"""Keys of a scene that no number follows from."""

Row = dict[str, Any]
"""Of a case: `case`, `outcome`, `sentence`, `metrics`, `wall`, `cpu`, `machine`."""


class Numbered(Protocol):
    """What a worker is given: a `Task`, or the case of a test procedure."""

    @property
    def number(self) -> int:
        """Of the case, from 0."""


class Task(NamedTuple):
    """What a worker is given of a sweep."""

    number: int
    """of the case, from 0"""
    scene: str
    values: tuple[str, ...]
    """`key=value` as `--set` takes them"""
    folder: str
    """of the sweep"""
    keeps_bag: bool
    sources: str
    """hash of the bench's sources, see `sources_hash`"""
    series: str = ""
    """`topic.column` that the row is to have in place of metrics, as `time` and `values`; empty: none"""
    is_response: bool = False
    """whether the row is to have `seat.transmissibility` in place of metrics, as `x`, `y` and `spread`"""
    tables: KeyRange | None = None
    """key of a cushion between whose tables the run takes its own; None: it has its own"""
    bands: tuple[CurveBand, ...] = ()
    """round curves, how far beyond which the run is among its metrics"""


def scene_of(scene: str, values: tuple[str, ...]) -> ResolvedScene:
    """The resolved scene of a case. Raises SceneError."""
    return resolve(load_scene(scene, [set_value(each, "--vary ") for each in values]))


@functools.cache
def sources_hash() -> str:
    """Hash of all sources of the bench: numbers of other physics are not those of this one."""
    root = Path(__file__).parents[1]
    digest = hashlib.sha256()
    for path in sorted(root.rglob("*.py")):
        digest.update(f"{path.relative_to(root)}\0".encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def case_name(scene: ResolvedScene, sources: str) -> str:
    """Name of a case: the hash of its resolved scene, with the checksums of its files and the versions of its plug-ins,
    and of the ``sources`` that it runs with.
    """
    data = {key: value for key, value in scene.data.items() if key not in NOT_PHYSICS}
    text = json.dumps([data, sources], sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:20]


def run_case(task: Task) -> Row:
    """Run a case and keep what it gave in the folder of the sweep; one that is there already does not run again."""
    try:
        scene = scene_of(task.scene, task.values)
    except SceneError as error:
        return failed(task, str(error), REFUSED)
    name = case_name(scene, task.sources)
    ending = f"-{task.series.replace('/', '_')}" if task.series else ""
    ending += "-transmissibility" if task.is_response else ""
    ending += "-between" + hashlib.sha256(repr(task.tables).encode()).hexdigest()[:8] if task.tables else ""
    ending += f"-{hashlib.sha256(json.dumps(task.bands).encode()).hexdigest()[:8]}" if task.bands else ""
    kept, bag = Path(task.folder) / "cases" / f"{name}{ending}.json", Path(task.folder) / "bags" / name
    found = kept_row(kept)
    if found is not None and (bag.is_dir() or not task.keeps_bag):
        return {**found, "number": task.number, "again": True}
    with tables_between(task.tables):
        given = _run(scene, bag if task.keeps_bag else None, task)
    row = {"number": task.number, "case": name, "machine": machine(), **given}
    if row["outcome"] == FINISHED:
        with new_file(kept, overwrite=True) as file:
            file.write(json.dumps(row).encode())
    return row


def kept_row(path: Path) -> Row | None:
    """The row in a file; None where there is none, or a damaged one."""
    try:
        found: Row = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return found


def failed(task: Numbered, sentence: str, outcome: str = FAILED) -> Row:
    """The row of a case that gave nothing."""
    return {"number": task.number, "case": "", "outcome": outcome, "sentence": sentence, "metrics": []}


def _run(scene: ResolvedScene, bag: Path | None, task: Task) -> Row:
    """Run and measure; the bag goes where it is not to be kept."""
    folder = Path(tempfile.mkdtemp(prefix="contact_bench_"))
    wall, cpu = time.perf_counter(), time.process_time()
    try:
        if bag is not None:
            shutil.rmtree(bag, ignore_errors=True)  # of a run that was interrupted
            bag.parent.mkdir(exist_ok=True)
        if task.series:
            found = _series_of(scene, task.series)
        elif task.is_response:
            found = _transmissibility_of(scene)
        else:
            path = folder / "bag" if bag is None else bag
            outcome = run_offline(scene, path)
            if outcome.failure or outcome.loss:
                raise RunError(outcome.failure or outcome.loss)
            found = {"metrics": rows_of(metrics_of_bags([path], bands=task.bands).metrics)}
    except (RunError, ExcitationError, RefusedError, OSError, MemoryError) as error:
        return {"outcome": FAILED, "sentence": str(error) or "memory ran out", "metrics": []}
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    spent = {"wall": time.perf_counter() - wall, "cpu": time.process_time() - cpu}
    return {"outcome": FINISHED, "sentence": "", "metrics": [], **found, **spent}


def _series_of(scene: ResolvedScene, series: str) -> Row:
    """The column of a run, of the records of its blocks: to write a bag and to read it costs more than a short run.

    Raises RunError where there is none, or the run fails.
    """
    topic, _, column = series.rpartition(".")
    times, records = _records_of(scene, topic)
    time, *columns = table_of_records(topic, times, records).columns
    for each in columns:
        if each.name == column:
            return {"time": [*map(float, time.values)], "values": [*map(float, each.values)], "unit": each.unit}
    raise RunError(f"{topic} has no column {column!r}; it has {', '.join(each.name for each in columns)}")


def _transmissibility_of(scene: ResolvedScene) -> Row:
    """T(f) of a run as `bench metrics` and the report take it, without a bag. Raises RunError where there is none."""
    times, records = _records_of(scene, "bench/motion")
    columns = {
        name: [getattr(each, name) for each in records] for name in MOTION_COLUMNS if name not in ("time", "samples")
    }
    samples = [each.acceleration.size // len(each.bodies) for each in records]
    signals = ride_signals(motion_series({**columns, "time": times, "samples": samples}))
    curve = None if signals is None else transmissibility_curve(signals)
    if curve is None or curve.spread is None:
        what = "the run has no floor with a seat on it" if signals is None else "its floor does not move"
        raise RunError(f"no seat.transmissibility: {what}")
    return {"x": [*map(float, curve.x)], "y": [*map(float, curve.y)], "spread": [*map(float, curve.spread)]}


def _records_of(scene: ResolvedScene, topic: str) -> tuple[list[float], list[Any]]:
    """Times [s] and records of a topic. Raises RunError where a run has no such table."""
    sources, simulation = make_sources(scene), make_simulation(scene)
    simulation.prepare()
    times, records, seen = [], [], set()
    with closed():
        for block in range(simulation.blocks):
            inputs = {name: source.block(block) for name, source in sources.items()}
            for output in simulation.advance(block, inputs).outputs:
                seen.add(output.topic)
                if output.topic == topic:
                    times.append(output.stamp / NANOSECONDS)
                    records.append(output.record)
    if not records or not has_columns(records[0]):
        raise RunError(f"the run has no table {topic}; it has {', '.join(sorted(seen))}")
    return times, records


def machine() -> str:
    """What the bits of a number hang on beside the case."""
    versions = ", ".join(f"{name} {version(name)}" for name in ("numpy", "numba"))
    return f"{platform.machine()} {_processor()}, Python {platform.python_version()}, {versions}"


@functools.cache
def _processor() -> str:
    import llvmlite.binding

    return str(llvmlite.binding.get_host_cpu_name())
