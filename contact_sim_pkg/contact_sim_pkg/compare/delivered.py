"""What accuracy a recorded run delivered: its companion run, one level finer, beside it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.compare.columns import Column, Key, columns_of, not_judged
from contact_sim_pkg.compare.companion import Companion, companion_of, factor_of
from contact_sim_pkg.compare.excitation_check import foreign_topics, other_road
from contact_sim_pkg.compare.judgement import Judgement, Scale, cell_of, judged, scales_of, standing_of
from contact_sim_pkg.compare.parting import Parting, parting_of, until
from contact_sim_pkg.compare.recorded import costs_of_bag, outputs_of_bag, scene_of_bag
from contact_sim_pkg.compare.span import Notify, Span, begins_later, prepared, run_span
from contact_sim_pkg.compare.windows import CheckWindow, from_the_start, windows_of
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.records.messages import SolverCost
from contact_sim_pkg.run.block_simulation import BlockSimulation
from contact_sim_pkg.run.from_bag import refuse_steered, sources_from_bag
from contact_sim_pkg.run.rigs import result_topics
from contact_sim_pkg.run.sources import Source, make_sources, make_surface, road_lattice
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.accuracy import requested

__all__ = ["Check", "CheckedWindow", "check_bag"]

FINER_GRID, FINER_STEPS = 10.0, 3.0
"""About how many times as long a companion run takes, with finer grids and without."""
LOOKS, ROAD_LOOKS = 20, 3
"""Blocks of the excitation that are made again and compared, and of a road for a finer lattice, at
most.
"""

Columns = dict[Key, Column]


class CheckedWindow(NamedTuple):
    """A part of the run that was checked."""

    start: float  # [s]
    end: float  # [s]
    reasons: tuple[str, ...]


class Check(NamedTuple):
    """Delivered accuracy of a run."""

    scene: str
    requested: float
    judgements: tuple[Judgement, ...]  # delivered errors by place and kind
    windows: tuple[CheckedWindow, ...]
    dials: tuple[str, ...]  # keys that the companion run has finer
    limited: str  # why it has no finer grid; empty where it has, or has no grid
    parting: Parting | None
    not_judged: tuple[str, ...]
    cpu: float  # [s] of the check
    is_whole: bool  # whether the windows are the whole run


class _Companions(NamedTuple):
    """A scene and its companion, ready to run."""

    scene: ResolvedScene
    companion: Companion
    sources: dict[str, Source]
    finer_sources: dict[str, Source]
    limited: str


def check_bag(path: Path, notify: Notify, *, scene: ResolvedScene | None = None, whole: bool = False) -> Check:
    """Check the run that a bag holds, in windows, or over its ``whole`` length.

    Raises BagError where the bag cannot be read, parameters changed in it, or it holds no scene, no judged topic or no block,
    RunError where the companion run fails.
    """
    scene = scene or scene_of_bag(path)
    refuse_steered(path, "a finer run beside it has one scene for the whole")
    outputs, costs = outputs_of_bag(path, scene), costs_of_bag(path)
    if not outputs or not costs:
        raise BagError(f"{path} holds nothing that accuracy bounds: no contact force, motion or pressure")
    columns, blocks = columns_of(outputs), len(costs)
    scales = scales_of(columns, standing_of(scene), cell_of(outputs))
    pair = _companions(path, scene, blocks)
    windows = _windows(pair, columns, costs, whole=whole)
    notify(_announced(pair, windows, costs))
    compiled = [prepared(pair.companion.scene, notify, first=True)]
    judgements, parting, cpu = [], None, 0.0
    for window in windows:
        notify(f"  {_described(scene, window)}")
        finer = compiled.pop() if compiled else prepared(pair.companion.scene, notify)
        run, other, seconds = _runs(pair, window.span, columns, finer, notify)
        cpu += seconds
        parting = parting or parting_of(run, other, scales, requested(scene.accuracy))
        if parting is not None:
            run = until(run, parting.time)
        judgements += _delivered(run, other, scales, pair.companion)
    return Check(
        scene.name, requested(scene.accuracy), tuple(_largest(judgements)),
        tuple(_checked(scene, window) for window in windows), pair.companion.dials, pair.limited, parting,
        tuple(not_judged(result_topics(scene))), cpu,
        [(each.span.first, each.span.end) for each in windows] == [(0, blocks)],
    )  # fmt: skip


def _companions(path: Path, scene: ResolvedScene, blocks: int) -> _Companions:
    """The scene and its companion, on the excitation that the scene makes, or that of the bag where
    that is another.
    """
    looked = range(0, blocks, max(1, blocks // LOOKS))
    recorded = sources_from_bag(path, _as_long_as(scene, blocks))
    made, limited = _made(lambda: make_sources(scene))
    if not limited and (foreign := foreign_topics(recorded, made, looked)):
        limited = f"{' and '.join(foreign)} of the bag {'is' if len(foreign) == 1 else 'are'} not what its scene makes"
    companion, limited = _companion(scene, limited)
    if limited or not companion.grid or "road/patch" not in recorded:
        return _Companions(scene, companion, recorded, recorded, limited)
    finer, limited = _made(lambda: make_sources(companion.scene))
    if not limited:
        surface = make_surface(companion.scene, road_lattice(companion.scene).cell_x)
        if difference := other_road(recorded["road/patch"], surface, list(looked)[:ROAD_LOOKS]):
            limited = f"the road made for the finer lattice differs by {difference:.2g} m at common nodes"
    if limited:
        return _Companions(scene, companion_of(scene, grid=False), recorded, recorded, limited)
    return _Companions(scene, companion, recorded, finer, "")


def _companion(scene: ResolvedScene, limited: str) -> tuple[Companion, str]:
    """The companion, without finer grids where there is a reason, or where the scene does not take
    them.
    """
    if not limited:
        try:
            return companion_of(scene), ""
        except SceneError as error:
            limited = f"the finer grid is refused: {error}"
    return companion_of(scene, grid=False), limited


def _made(make: Callable[[], dict[str, Source]]) -> tuple[dict[str, Source], str]:
    """Sources, or why they cannot be made."""
    try:
        return make(), ""
    except (SceneError, ExcitationError) as error:
        return {}, f"the excitation cannot be made again: {error}"


def _as_long_as(scene: ResolvedScene, blocks: int) -> ResolvedScene:
    """The scene with so many blocks: those of a run that was stopped."""
    return ResolvedScene({**scene.data, "duration": round(blocks * scene.block_length, 9)}, scene.files)


def _windows(pair: _Companions, columns: Columns, costs: Sequence[SolverCost], *, whole: bool) -> list[CheckWindow]:
    blocks = len(costs)
    if whole:
        return [CheckWindow(Span(0, 0, blocks), ("the whole run",))]
    windows = windows_of(pair.scene, columns, costs, pair.sources, blocks)
    return windows if begins_later(pair.scene) else from_the_start(windows)


def _runs(
    pair: _Companions, span: Span, columns: Columns, finer: BlockSimulation, notify: Notify
) -> tuple[Columns, Columns, float]:
    """Columns of the run and of the finer one in a span, and the CPU time [s] of both.

    From the start of the scene it is the recorded run; behind it both begin at rest.
    """
    other = run_span(pair.companion.scene, span, notify, simulation=finer, sources=pair.finer_sources)
    if span.first == 0:
        return columns, other.columns, other.cpu
    run = run_span(pair.scene, span, notify, sources=pair.sources)
    return run.columns, other.columns, run.cpu + other.cpu


def _delivered(run: Columns, other: Columns, scales: dict[Key, Scale], companion: Companion) -> list[Judgement]:
    found = []
    for kind in dict.fromkeys(column.kind for column in run.values()):
        of_kind = {key: column for key, column in run.items() if column.kind == kind}
        found += judged(of_kind, other, scales, factor_of(kind, companion))
    return found


def _largest(judgements: Iterable[Judgement]) -> list[Judgement]:
    """Of each place and kind the largest over the windows; components that are not resolved in any
    of them.
    """
    found: dict[tuple[str, str], Judgement] = {}
    for each in judgements:
        name = each.place, each.kind
        other = found.setdefault(name, each)
        worst = max(other, each, key=lambda judgement: judgement.error)
        shares = {lost.column: lost for lost in sorted((*other.unresolved, *each.unresolved), key=lambda it: it.share)}
        found[name] = worst._replace(unresolved=tuple(shares.values()))
    return list(found.values())


def _announced(pair: _Companions, windows: Sequence[CheckWindow], costs: Sequence[SolverCost]) -> str:
    """What the check is about to do, and what it costs."""
    factor = FINER_GRID if pair.companion.grid else FINER_STEPS
    seconds = 0.0
    for window in windows:
        blocks = costs[window.span.first : window.span.end]
        again = 1.0 if window.span.first else 0.0
        seconds += (factor + again) * sum(cost.wall_time for cost in blocks)
    length = sum(window.span.end - window.span.shown for window in windows) * pair.scene.block_length
    return f"companion run of {pair.scene.name}: {length:.3g} s simulated, about {max(1.0, seconds):.2g} s of computing"


def _checked(scene: ResolvedScene, window: CheckWindow) -> CheckedWindow:
    start, end = (round(block * scene.block_length, 9) for block in (window.span.shown, window.span.end))
    return CheckedWindow(start, end, window.reasons)


def _described(scene: ResolvedScene, window: CheckWindow) -> str:
    found = _checked(scene, window)
    return f"{found.start:g} to {found.end:g} s: {', '.join(found.reasons)}"
