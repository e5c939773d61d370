"""What accuracy costs: a scene at several requests beside one finer run of the same span.

The finer run is the scene at a tenth of the smallest request. What it would share with the run at
that request is one level finer still: keys that the scene gives itself, the last level of a grid,
and the time integration, which is tight at every request. Scales are those of the whole run, at the coarsest request.
The span is 0.2 s round the event of the excitation where the rig can begin there, else the run
from its start, shorter where the finer run would take long.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from contact_sim_pkg.compare.columns import Column, Key, kind_of
from contact_sim_pkg.compare.companion import dials_of, finer_than
from contact_sim_pkg.compare.judgement import (
    Judgement,
    Scale,
    cell_of,
    judged,
    larger_scales,
    largest_by_kind,
    scales_of,
    standing_of,
)
from contact_sim_pkg.compare.parting import parting_of, until
from contact_sim_pkg.compare.span import Notify, Span, SpanRun, begins_later, prepared, run_span
from contact_sim_pkg.compare.windows import LEAD, LENGTH, event_block, span_round
from contact_sim_pkg.records.messages import SolverCost
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.accuracy import requested

__all__ = ["DEEP", "MOVED", "REQUESTS", "Effort", "FirstLook", "Request", "cheapest_for", "estimated_of", "first_look"]

REQUESTS = (1e-1, 1e-2, 1e-3)
REFERENCE, FINER = 1e-4, 0.3
"""Request of the finer run, and its largest part of the smallest request that is judged."""
DEEP, DEEP_REFERENCE = 1e-4, 3e-5
FINEST = 1e-8  # that a scene may request
SHORT = 0.5  # [s] of CPU below which a run is repeated
CHEAPER = 0.9
"""Of the cost of a coarser run, from which on a finer one counts as cheaper."""
MOVED = ("force", "motion")  # kinds that decide what holds


class Effort(NamedTuple):
    """What a first look may take."""

    event: float = 30.0  # [s] of CPU of the finer run round an event
    start: float = 8.0  # [s] of one from the start, which costs about as much at every request
    scales: float = 5.0  # [s] of the run for the scales
    repeats: int = 3  # of a short run, of whose costs the least counts
    length: float = LENGTH  # [s] of the span round an event
    lead: float = LEAD  # [s] from standstill to it


USUAL = Effort()


class Request(NamedTuple):
    """A scene at one requested accuracy."""

    requested: float
    errors: dict[str, float]  # largest over the scale, by kind
    judgements: tuple[Judgement, ...]
    estimated: dict[str, float]  # by the run itself, by kind
    cost: float  # [CPU s] per simulated s
    agrees_until: float | None  # [s] where it parts from the finer run for good
    own: bool  # what the scene itself requests

    def holds(self, request: float) -> bool:
        """Whether force and motion are within a request."""
        return all(self.errors.get(kind, 0.0) <= request for kind in MOVED)


class FirstLook(NamedTuple):
    """A scene at several requests."""

    scene: str
    requests: tuple[Request, ...]  # coarsest first
    start: float  # [s]
    end: float
    reference: float  # request of the finer run
    reference_cost: float  # [CPU s] per simulated s
    same: tuple[str, ...]  # dials that no request moves
    ended: tuple[tuple[float, str], ...] = ()  # requests at which the run ended, and its sentence


def first_look(
    scene_name: str, notify: Notify, *, deep: bool = False, values: Sequence[str] = (), effort: Effort = USUAL
) -> FirstLook:
    """Run a scene, by name or path, with ``values`` as of `--set`, at each request.

    Raises SceneError where the scene is wrong, RunError where the finer run fails.
    """
    scene = load_resolved(scene_name, *values)
    own = requested(scene.accuracy)
    requests = sorted({*REQUESTS, *((DEEP,) if deep else ()), own}, reverse=True)
    finest = max(FINEST, min(DEEP_REFERENCE if deep else REFERENCE, FINER * requests[-1]))
    notify(f"{scene.name}: {', '.join(f'{each:g}' for each in requests)} beside {finest:g}")
    scenes = {each: scene if each == own else _at(scene_name, values, each) for each in requests}
    finer, span = _finer(_at(scene_name, values, finest), scenes[requests[-1]], notify), _span_of(scene, effort)
    notify("kernels: compiled, or from the disk")
    simulation = prepared(finer, notify, first=True)
    notify(f"{scene.name} at {finest:g}: {_times(scene, span)}")
    most_cpu = effort.event if begins_later(scene) else effort.start
    reference = run_span(finer, span, notify, simulation=simulation, most_cpu=most_cpu)
    span = span._replace(end=span.first + reference.blocks)
    scales = _scales(scene, reference)
    whole = Span(0, 0, scene.blocks)
    if span != whole and begins_later(scene):
        notify(f"{scene.name} at {requests[0]:g}: the whole run, for the scales of its errors")
        scales = larger_scales(
            scales, _scales(scene, run_span(scenes[requests[0]], whole, notify, most_cpu=effort.scales))
        )
    rows, ended = [], []
    for each in requests:
        notify(f"{scene.name} at {each:g}: {_times(scene, span)}")
        try:
            run = _cheapest_run(scenes[each], span, notify, effort.repeats)
        except RunError as error:
            notify(f"  it ends: {error}")
            ended.append((each, str(error)))
            continue
        rows.append(_request(each, run, reference.columns, scales, own=each == own, length=scene.block_length))
    return FirstLook(
        scene.name, tuple(rows), span.shown * scene.block_length, span.end * scene.block_length, finest,
        _cost(reference, scene.block_length), _same([*scenes.values()]), tuple(ended),
    )  # fmt: skip


def cheapest_for(rows: Sequence[Request], request: float) -> Request | None:
    """The least expensive run whose force and motion are within a request; None where none is."""
    found: Request | None = None
    for row in rows:
        if row.holds(request) and (found is None or row.cost < CHEAPER * found.cost):
            found = row
    return found


def _at(scene_name: str, values: Sequence[str], accuracy: float) -> ResolvedScene:
    return load_resolved(scene_name, *values, f"accuracy={accuracy:g}")


def _finer(scene: ResolvedScene, judged_scene: ResolvedScene, notify: Notify) -> ResolvedScene:
    """The scene of the finer run, as it is where it does not take what would be finer still."""
    try:
        return finer_than(scene, judged_scene)
    except SceneError as error:
        notify(f"the finer run shares what it cannot have finer: {error}")
        return scene


def _span_of(scene: ResolvedScene, effort: Effort) -> Span:
    """What is run: round the event where the rig can begin there, else from the start."""
    blocks = scene.blocks
    sources = make_sources(scene)
    if begins_later(scene) and sources:
        return span_round(scene, event_block(sources, blocks), blocks, effort.length, effort.lead)
    return Span(0, 0, blocks)


def _scales(scene: ResolvedScene, run: SpanRun) -> dict[Key, Scale]:
    return scales_of(run.columns, standing_of(scene), cell_of(run.outputs))


def _times(scene: ResolvedScene, span: Span) -> str:
    return f"{span.shown * scene.block_length:g} to {span.end * scene.block_length:g} s"


def _cheapest_run(scene: ResolvedScene, span: Span, notify: Notify, repeats: int) -> SpanRun:
    """A run, repeated where it is so short that its cost is uncertain.

    Raises RunError where it ends in a named failure.
    """
    run = run_span(scene, span, notify)
    more = repeats - 1 if run.cpu < SHORT else 0
    cpu = min([run.cpu, *(run_span(scene, span, notify).cpu for _ in range(more))])
    return run._replace(cpu=cpu)


def _request(
    requested: float,
    run: SpanRun,
    finer: Mapping[Key, Column],
    scales: Mapping[Key, Scale],
    *,
    own: bool,
    length: float,
) -> Request:
    parting = parting_of(run.columns, finer, scales, requested)
    columns = run.columns if parting is None else until(run.columns, parting.time)
    judgements = judged(columns, finer, scales)
    return Request(
        requested, largest_by_kind(judgements), tuple(judgements), estimated_of(run.costs, scales), _cost(run, length),
        None if parting is None else parting.time, own,
    )  # fmt: skip


def _cost(run: SpanRun, length: float) -> float:
    return run.cpu / (run.blocks * length)


def estimated_of(costs: Iterable[SolverCost], scales: Mapping[Key, Scale]) -> dict[str, float]:
    """Largest error of each kind that a run estimates itself, over the scales of its columns."""
    found: dict[str, float] = {}
    for cost in costs:
        for name, error in zip(cost.estimated, cost.estimated_error, strict=True):
            topic, _dot, field = name.partition(".")
            column, _of, body = field.partition(" of ")
            key = Key(topic, column, body)
            if key in scales and scales[key].scale > 0.0:
                kind = kind_of(key)
                found[kind] = max(found.get(kind, 0.0), float(error) / scales[key].scale)
    return found


def _same(scenes: Sequence[ResolvedScene]) -> tuple[str, ...]:
    """Dials with one value at all requests, rates of outputs left out."""
    found = [dials_of(scene.data) for scene in scenes]
    return tuple(
        key
        for key, value in found[0].items()
        if not key.startswith("outputs.") and all(each.get(key) == value for each in found)
    )
