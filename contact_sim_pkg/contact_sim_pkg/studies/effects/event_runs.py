"""Runs of the events of a scene: as requested, for what they cost, and one level finer, for what is
compared.

A rig that begins later stands at the start of each span. Forces and positions count from there:
where another model stands by a different height, or how much of the weight lies between the road and
the axle, is no change of what happens.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.compare.columns import NANOSECONDS, Column, Key
from contact_sim_pkg.compare.companion import Companion, companion_of, factor_of
from contact_sim_pkg.compare.events import EventSpan, event_spans, whole_run
from contact_sim_pkg.compare.judgement import Judgement, Scale, cell_of, judged, larger_scales, scales_of, standing_of
from contact_sim_pkg.compare.parting import parting_of, until
from contact_sim_pkg.compare.span import Notify, begins_later, prepared, run_span
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.accuracy import requested
from contact_sim_pkg.studies.effects.verdicts import Change, changes_of

__all__ = ["Base", "EventRun", "Price", "base_of", "changed", "finer_run"]

FROM_STANDSTILL = ("N", "m", "rad")
SHORT, REPEATS = 1.0, 3
"""[s] of CPU of a run below which it is made so many times, of which the least costly counts."""


class EventRun(NamedTuple):
    """All events of a scene, run once or several times."""

    outputs: list[Output]
    columns: dict[Key, Column]
    moved: dict[Key, Column]  # forces and positions from standstill
    cost: float  # [ms] of CPU per simulated second


class Price:
    """Cost of a scene: the least of repeated runs, for other work only ever adds to it.

    The base runs again beside each other scene, so that no phase of the machine is that of one.
    """

    def __init__(self, scene: ResolvedScene, spans: Sequence[EventSpan], notify: Notify) -> None:
        """Run the scene once. Raises RunError where it ends."""
        self._scene, self._spans, self._notify = scene, spans, notify
        self.run = _run(scene, spans, notify, first=True)
        self.least = self.run.cost  # [ms] of CPU per simulated second

    def of(self, scene: ResolvedScene) -> float:
        """Cost [ms] of CPU per simulated second of another scene. Raises RunError where it ends."""
        cost = _run(scene, self._spans, self._notify).cost
        repeats = REPEATS - 1 if cost * _simulated(scene, self._spans) < 1e3 * SHORT else 0
        for _ in range(repeats):
            self.least = min(self.least, _run(self._scene, self._spans, self._notify).cost)
            cost = min(cost, _run(scene, self._spans, self._notify).cost)
        return cost


class Base(NamedTuple):
    """The scene that others are compared with."""

    scene: ResolvedScene
    spans: list[EventSpan]
    price: Price
    finer: dict[Key, Column]  # from standstill
    scales: dict[Key, Scale]
    errors: dict[tuple[str, str], float]  # of a change, by place and kind
    agrees_until: float | None  # [s] from where on a finer run parts from the requested one

    @property
    def request(self) -> float:
        """Requested accuracy."""
        return requested(self.scene.accuracy)

    @property
    def cost(self) -> float:
        """CPU time [ms] per simulated second of the scene."""
        return self.price.least

    def measured(
        self, scene: ResolvedScene, notify: Notify, not_below: Mapping[str, float] | None = None
    ) -> tuple[tuple[Change, ...], float]:
        """What is different in another scene, and its cost [ms] per simulated second; ``not_below``: by kind the
        error that what is different has at every accuracy. Raises RunError where a run ends.
        """
        cost = self.price.of(scene)
        return changes_of(changed(self, finer_run(scene, self.spans, notify)), self.errors, not_below or {}), cost

    @property
    def compared(self) -> str:
        """What of the scene is compared, in words."""
        length = self.scene.block_length
        spans = "; ".join(
            f"{each.span.shown * length:g} to {each.span.end * length:g} s ({each.reason})" for each in self.spans
        )
        until = "" if self.agrees_until is None else (
            f"; compared until {self.agrees_until:.4g} s, where a finer run parts from the scene"
        )  # fmt: skip
        return f"{spans}; changes one level finer than requested, over the scales of the accuracy{until}"

    def facts(self) -> dict[str, Any]:
        """The same as plain values."""
        length = self.scene.block_length
        return {
            "spans": [
                {"start_s": each.span.shown * length, "end_s": each.span.end * length, "event": each.reason,
                 "blocks": [each.span.first, each.span.shown, each.span.end]}
                for each in self.spans
            ],
            "agrees_until_s": self.agrees_until,
        }  # fmt: skip


def base_of(scene: ResolvedScene, notify: Notify) -> Base:
    """Run a scene as requested and finer. Raises RunError where it ends."""
    spans = event_spans(scene, make_sources(scene))
    price, (finer, companion) = Price(scene, spans, notify), _finer(scene, spans, notify)
    run = price.run
    scales = _scales(scene, finer)
    whole = whole_run(scene)
    if begins_later(scene) and [each.span for each in spans] != [whole.span]:
        notify(f"{scene.name}: the whole run, for the scales of changes")
        scales = larger_scales(scales, _scales(scene, _run(scene, [whole], notify)))
    if begins_later(scene):
        scales = {key: _noticed(key, each, finer.columns, scene.block_length) for key, each in scales.items()}
    parting = parting_of(run.moved, finer.moved, scales, requested(scene.accuracy))
    compared = run.moved if parting is None else until(run.moved, parting.time)
    errors = {
        (each.place, each.kind): 2.0 * (factor_of(each.kind, companion) - 1.0) * each.error
        for each in judged(compared, finer.moved, scales)
    }
    return Base(scene, spans, price, finer.moved, scales, errors, None if parting is None else parting.time)


def _scales(scene: ResolvedScene, run: EventRun) -> dict[Key, Scale]:
    return scales_of(run.columns, standing_of(scene), cell_of(run.outputs))


def _noticed(key: Key, scale: Scale, columns: Mapping[Key, Column], length: float) -> Scale:
    """The scale of a position is at least a free fall during a block of so many [s]: a body that
    stands sinks by the error of the force under it.
    """
    column = columns.get(key)
    if column is None or column.kind != "motion" or column.unit not in FROM_STANDSTILL:
        return scale
    return scale._replace(scale=max(scale.scale, 0.5 * GRAVITY * length**2))


def changed(base: Base, other: EventRun) -> list[Judgement]:
    """Differences of a finer run of another scene from that of the base, over its scales.

    A force that only one of the two has is none in the other: that of bristles, for one.
    """
    scales = {**scales_of(other.columns, standing_of(base.scene)), **base.scales}
    columns = {**base.finer, **_no_forces(other.moved, base.finer)}
    others = {**other.moved, **_no_forces(base.finer, other.moved)}
    if base.agrees_until is not None:
        columns = until(columns, base.agrees_until)
    return judged(columns, others, scales)


def _no_forces(present: Mapping[Key, Column], run: Mapping[Key, Column]) -> dict[Key, Column]:
    """Zeros for the forces that are ``present`` and that a run does not have."""
    return {
        key: column._replace(values=numpy.zeros_like(column.values))
        for key, column in present.items()
        if column.kind == "force" and key not in run
    }


def finer_run(scene: ResolvedScene, spans: Sequence[EventSpan], notify: Notify) -> EventRun:
    """The events of a scene one level finer. Raises RunError where a run ends."""
    return _finer(scene, spans, notify)[0]


def _finer(scene: ResolvedScene, spans: Sequence[EventSpan], notify: Notify) -> tuple[EventRun, Companion]:
    """With finer grids where the scene takes them."""
    try:
        companion = companion_of(scene)
    except SceneError:
        companion = companion_of(scene, grid=False)
    return _run(companion.scene, spans, notify), companion


def _run(scene: ResolvedScene, spans: Sequence[EventSpan], notify: Notify, *, first: bool = False) -> EventRun:
    sources, stands = make_sources(scene), begins_later(scene)
    outputs, parts, moved, cpu = [], [], [], 0.0
    for each in spans:
        span = each.span._replace(shown=each.span.first)
        run = run_span(scene, span, notify, simulation=prepared(scene, notify, first=first), sources=sources)
        start = round(each.span.shown * scene.block_length * NANOSECONDS)
        outputs += run.outputs
        parts.append({key: _since(column, start) for key, column in run.columns.items()})
        moved.append(
            {
                key: _since(_from_standstill(column), start) if stands else parts[-1][key]
                for key, column in run.columns.items()
            }
        )
        cpu += run.cpu
    return EventRun(outputs, _joined(parts), _joined(moved), 1e3 * cpu / _simulated(scene, spans))


def _since(column: Column, start: int) -> Column:
    kept = column.instants >= start
    return column._replace(instants=column.instants[kept], values=column.values[kept])


def _from_standstill(column: Column) -> Column:
    """Forces and positions less their first value."""
    if column.unit not in FROM_STANDSTILL or not len(column.values):
        return column
    return column._replace(values=column.values - column.values[0])


def _joined(parts: Sequence[dict[Key, Column]]) -> dict[Key, Column]:
    found: dict[Key, Column] = {}
    for part in parts:
        for key, column in part.items():
            before = found.get(key)
            found[key] = (
                column
                if before is None
                else column._replace(
                    instants=numpy.concatenate([before.instants, column.instants]),
                    values=numpy.concatenate([before.values, column.values]),
                )
            )
    return found


def _simulated(scene: ResolvedScene, spans: Sequence[EventSpan]) -> float:
    """Simulated time [s] of all spans, their lead-ins included."""
    return sum(each.span.end - each.span.first for each in spans) * scene.block_length
