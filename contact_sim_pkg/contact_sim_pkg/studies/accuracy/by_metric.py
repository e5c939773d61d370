"""Dials for an accuracy that is requested of metrics: as loose as each of them allows.

Two dials rule two families of numbers. The *steps* (how often a field is solved, how long a time step is) rule loads, their
spread and what a person feels; the *cells* rule peaks, areas and maps. What the steps do hardly depends on the cells, so they
are chosen by short runs on half the cells, and the cells by one more run at the loosest steps:

* error of the steps at a request: 3/2 of the difference from the next finer request, which is about a third: first order;
* error of the cells: that of half the cells is twice the difference between half and usual cells, that of others in proportion
  to the side of a cell: first order, as at an edge.

Each may make half of what is requested. What no dial delivers is named.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.compare.companion import cells_of, halved, with_values
from contact_sim_pkg.compare.span import Notify
from contact_sim_pkg.records.metric import SELF_CHECK, Metric
from contact_sim_pkg.records.table import Section, number_of
from contact_sim_pkg.report.metrics.listing import all_metrics
from contact_sim_pkg.report.metrics.requirements import places_of
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.studies.whole_run import whole_run

__all__ = ["Choice", "Delivery", "choose", "lines_of", "parsed", "rows_of", "sections"]

REQUESTS = (0.1, 0.03, 0.01, 0.003, 0.001)
"""That the steps are tried at, the loosest first."""
PILOT = 4.0
"""[s] of a short run"""
PAYS = 5.0
"""A run that is no longer than so many short ones is made at the smallest request itself."""
SHARE = 0.5
"""Of a request, for the steps and for the cells each."""
FADES = 0.1
"""What a difference between two requests is at least, of the one before: one that vanishes by chance means nothing."""
ALIKE = {"road": ("flat", "iso8608", "self_affine"), "vibration": ("noise", "sine")}
"""Excitation that is alike in every part of a run."""
FINEST = 1e-4
LEVELS = (("half", None), ("usual", 0.1), ("fine", 1e-3), ("finest", FINEST))
"""Cells by name, and the request whose cells they are."""
NOT_ALIKE = "the excitation is not alike over the run, so that short runs say nothing of it"


class Delivery(NamedTuple):
    """A metric with its request; relative errors, nan where the request was taken as it is."""

    key: str
    name: str
    requested: float
    steps: float
    cells: float
    note: str

    @property
    def estimated(self) -> float:
        """Of the run with the dials that were chosen."""
        return self.steps + self.cells


class Choice(NamedTuple):
    """A scene with its dials, and why."""

    scene: ResolvedScene
    steps: float
    """request that the steps are those of"""
    cells: str
    deliveries: tuple[Delivery, ...]
    pilots: float
    """[s] of CPU of the short runs"""
    cost: float
    """[ms] of CPU per simulated second, of the short run whose steps were chosen, on half the cells; nan without"""
    why: str
    """why no short run was made; empty where some were"""


class _Pilot(NamedTuple):
    metrics: dict[str, Metric]
    cost: float


def parsed(texts: tuple[str, ...]) -> dict[str, float]:
    """Requests written as `seat.SEAT=0.5%` or `DLC=0.01`: relative errors by key or name. BagError for what is none."""
    found = {}
    for text in texts:
        name, equals, value = (part.strip() for part in text.rpartition("="))
        percent = value.endswith("%")
        try:
            number = float(value.removesuffix("%")) * (0.01 if percent else 1.0)
        except ValueError:
            number = math.nan
        if not equals or not name or not 1e-8 <= number <= 1.0:
            raise BagError(f"{text!r:.80} is no request: write METRIC=0.5% or METRIC=0.005, from 1e-8 to 1")
        found[name] = number
    return found


def choose(made: Callable[[float], ResolvedScene], wanted: Mapping[str, float], notify: Notify) -> Choice:
    """The scene whose metrics have the ``wanted`` relative errors, as loose as they allow.

    Args:
        made: the scene at an accuracy.
        wanted: relative error by key or name of a metric.
        notify: hears of each short run.

    Raises:
        BagError: the scene has no such metric. RunError: a short run ends early.
    """
    smallest = min(0.1, *wanted.values())
    uniform = made(smallest)
    why = _why_uniform(uniform)
    if why:
        rows = tuple(Delivery(key, key, value, math.nan, math.nan, "") for key, value in wanted.items())
        return Choice(uniform, smallest, "usual", rows, 0.0, math.nan, why)
    began = time.process_time()
    usual = made(REQUESTS[0])
    half = halved(usual)
    loosest = _pilot(half, notify, "half the cells, loosest steps")
    requests = _by_key(loosest, wanted)
    on_usual = _pilot(usual, notify, "usual cells")
    levels = _levels(made, usual)
    cells = {key: _errors_of_cells(key, loosest, on_usual, levels) for key in requests}
    level = max((_first_within(cells[key], requests[key]) or 0 for key in requests), default=0)
    pilots, steps = _step_pilots(made, half, loosest, requests, notify)
    rung = max((_first_within(steps[key], requests[key]) or 0 for key in requests), default=0)
    name, values, _ = levels[level]
    scene = with_values(made(REQUESTS[rung]), values)
    rows = tuple(
        Delivery(
            key, loosest.metrics[key].name, requests[key], steps[key][min(rung, len(steps[key]) - 1)], cells[key][level],
            _note(loosest.metrics[key], requests[key], usual.duration, cells[key], steps[key]),
        )
        for key in requests
    )  # fmt: skip
    return Choice(scene, REQUESTS[rung], name, rows, time.process_time() - began, pilots[rung].cost, "")


def _why_uniform(scene: ResolvedScene) -> str:
    """Why the smallest request is taken as it is; empty where short runs may find better."""
    data = scene.data
    if not cells_of(scene):
        return "no contact of the scene has cells: nothing to choose"
    if scene.duration <= PAYS * PILOT:
        return f"short runs would cost more than they save in {scene.duration:g} s"
    for section, alike in ALIKE.items():
        if data.get(section) is not None and data[section]["kind"] not in alike:
            return NOT_ALIKE
    programmes = data.get("slip"), (data.get("travel") or {}).get("points")
    return NOT_ALIKE if any(each is not None for each in programmes) else ""


def _pilot(scene: ResolvedScene, notify: Notify, said: str) -> _Pilot:
    notify(f"{scene.name}: {PILOT:g} s, {said}")
    run = whole_run(with_values(scene, {"duration": PILOT}), notify)
    return _Pilot({each.key: each for each in all_metrics(run.recording) if each.basis != SELF_CHECK}, run.cost)


def _by_key(pilot: _Pilot, wanted: Mapping[str, float]) -> dict[str, float]:
    """The requests by key of the metric; of several for one the smallest."""
    metrics, found = [*pilot.metrics.values()], dict[str, float]()
    for name, value in wanted.items():
        for place in places_of(metrics, name, "--within"):
            key = metrics[place].key
            found[key] = min(value, found.get(key, math.inf))
    return found


def _step_pilots(
    made: Callable[[float], ResolvedScene], half: ResolvedScene, loosest: _Pilot, requests: Mapping[str, float], notify: Notify,
) -> tuple[list[_Pilot], dict[str, list[float]]]:  # fmt: skip
    """Short runs at finer steps until every metric has a request of the steps that is fine enough, or there is none finer;
    and the errors of each metric, by request.
    """
    pilots, errors = [loosest], dict[str, list[float]]((key, []) for key in requests)
    for finer in REQUESTS[1:]:
        pilots.append(_pilot(with_values(made(finer), cells_of(half)), notify, f"half the cells, steps of {finer:g}"))
        for key, found in errors.items():
            difference = 1.5 * _difference(key, *pilots[-2:])
            found.append(max(difference, FADES * found[-1]) if found else difference)
        if all(_first_within(errors[key], requests[key]) is not None for key in requests):
            break
    return pilots, errors


def _levels(
    made: Callable[[float], ResolvedScene], usual: ResolvedScene
) -> list[tuple[str, dict[str, Any], dict[str, float]]]:
    """Name, values and, by contact, side of a cell over the usual one, for each of LEVELS; cells that a scene gives itself are
    the same at each request, and stay.
    """
    present, finest = cells_of(usual), cells_of(made(FINEST))
    given = {key: value for key, value in present.items() if finest[key] == value}
    if given == present:
        return [("given", present, dict.fromkeys((key.split(".")[1] for key in present), 1.0))]
    found = []
    for name, request in LEVELS:
        values = cells_of(halved(usual) if request is None else made(request)) | given
        sides: dict[str, float] = {}
        for key, before in present.items():
            contact = key.split(".")[1]
            side = values[key] / before if key.endswith(".cell") else before / values[key]
            sides[contact] = max(side, sides.get(contact, 0.0))
        found.append((name, values, sides))
    return found


def _errors_of_cells(
    key: str, half: _Pilot, usual: _Pilot, levels: list[tuple[str, dict[str, Any], dict[str, float]]]
) -> list[float]:
    """By level. What half the cells change is the error of the usual ones."""
    difference, contact = _difference(key, half, usual), key.partition(".")[0]
    return [difference * sides.get(contact, max(sides.values())) for _, _, sides in levels]


def _difference(key: str, coarse: _Pilot, fine: _Pilot) -> float:
    """Of a metric between two runs, over its value; infinite where one does not have it."""
    if key not in coarse.metrics or key not in fine.metrics:
        return math.inf
    one, other = coarse.metrics[key].value, fine.metrics[key].value
    scale = max(abs(one), abs(other))
    found = abs(one - other) / scale if scale > 0.0 else 0.0
    return found if math.isfinite(found) else math.inf


def _first_within(errors: list[float], requested: float) -> int | None:
    """Place of the first that is small enough."""
    return next((place for place, error in enumerate(errors) if error <= SHARE * requested), None)


def _note(metric: Metric, requested: float, duration: float, cells: list[float], steps: list[float]) -> str:
    """What no dial delivers, and what chance does beside it."""
    said = [
        f"no {kind} deliver{'s' if kind == 'request of the steps' else ''} it"
        for kind, errors in (("request of the steps", steps), ("cells", cells)) if _first_within(errors, requested) is None
    ]  # fmt: skip
    chance = metric.spread / abs(metric.value) * math.sqrt(PILOT / duration) if metric.value else math.nan
    if chance > requested:
        said.append(
            f"chance alone moves it by {number_of(chance)}: {duration * (chance / requested) ** 2:.2g} s would be needed"
        )
    return "; ".join(said)


def sections(choice: Choice) -> list[Section]:
    """The choice as a table."""
    return [Section("accuracy by metric", [_shown(row) for row in rows_of(choice)], _summary(choice))]


def rows_of(choice: Choice) -> list[dict[str, Any]]:
    """A row a metric; errors None where no short run estimated them."""
    return [
        {
            "key": each.key, "metric": each.name, "requested": each.requested, "by steps": _known(each.steps),
            "by cells": _known(each.cells), "estimated": _known(each.estimated), "note": each.note,
        }
        for each in choice.deliveries
    ]  # fmt: skip


def _shown(row: dict[str, Any]) -> dict[str, Any]:
    return {
        key: number_of(value) if isinstance(value, float) else "-" if value is None else value
        for key, value in row.items()
    }


def lines_of(choice: Choice) -> list[str]:
    """The choice in sentences."""
    said = [
        f"{each.name}: {number_of(each.estimated)} estimated, {number_of(each.requested)} requested"
        + (f"; {each.note}" if each.note else "")
        for each in choice.deliveries
        if math.isfinite(each.estimated)
    ]
    return [*said, _summary(choice)]


def _summary(choice: Choice) -> str:
    said = choice.why or f"short runs took {choice.pilots:.1f} s of CPU"
    return f"accuracy {choice.steps:g} for the steps, {choice.cells} cells; {said}"


def _known(error: float) -> float | None:
    return error if math.isfinite(error) else None
