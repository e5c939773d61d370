"""Metrics of bags: one run, repeated runs, or a bag of anybody."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.metadata import IMPORTED_FROM
from contact_sim_pkg.bag.reader import Bag, open_bag
from contact_sim_pkg.compare.estimated import Above, above_request, accuracy_numbers
from contact_sim_pkg.records.metric import Metric
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.report.facts import warnings_of
from contact_sim_pkg.report.metrics.curve_bands import CurveBand, beyond_bands
from contact_sim_pkg.report.metrics.foreign import ForeignOptions, axes_of, foreign_metrics
from contact_sim_pkg.report.metrics.listing import all_metrics, metrics_of
from contact_sim_pkg.report.metrics.repeated import repeated
from contact_sim_pkg.report.reading import PATCH, SERIES_TYPES, read_recording, scenes_fit
from contact_sim_pkg.report.rig_reports import reports_of
from contact_sim_pkg.report.series import Recording

__all__ = ["FoundMetrics", "metrics_of_bags", "suite_name"]


class FoundMetrics(NamedTuple):
    """Metrics, and what is to be said of their bags."""

    metrics: list[Metric]
    notes: list[str]
    warnings: list[str]
    """runs that failed or were stopped, and excitation that no node of the bench published"""
    above: Above = Above()
    """what errs by more than its scene requested"""


def metrics_of_bags(
    paths: Sequence[Path],
    *,
    whole: bool = False,
    loaded: float | None = None,
    chosen: ForeignOptions | None = None,
    skip_bad: bool = False,
    bands: Sequence[CurveBand] = (),
) -> FoundMetrics:
    """Metrics of one bag, or mean and spread of repeated runs.

    Args:
        paths: of the bags, at least one.
        whole: whole lists of all contacts, and mats.
        loaded: [Pa] above which a cell of a mat counts; implies `whole`.
        chosen: what is known of a bag of anybody; None: taken so where the bag is none of ours.
        skip_bad: go on after damaged chunks.
        bands: round curves; how far a run is beyond each is a metric of it.

    Raises:
        BagError: a bag cannot be read, holds nothing to measure, or two of them are one run.
    """
    bags = [open_bag(path, skip_bad=skip_bad) for path in paths]
    notes = [note for bag in bags for note in bag.notes]
    warnings: list[str] = []
    lists: list[list[Metric]] = []
    scenes: list[dict[str, Any]] = []
    above: list[Above] = []
    for bag in bags:
        if is_foreign(bag, chosen):
            if whole or loaded is not None:
                option = "--all" if loaded is None else "--loaded"
                raise BagError(f"{option} is for maps and contacts of the bench, {bag.path} has none: leave it out")
            found, said = foreign_metrics(bag, chosen or ForeignOptions())
            lists.append(found)
            notes += said
            scenes.append({})
        else:
            recording = recording_of(bag)
            if loaded is not None and not recording.fields:
                raise BagError(f"--loaded is for pressure maps, {bag.path} has none: leave it out")
            if chosen is not None:
                if whole or loaded is not None:
                    raise BagError(
                        f"{'--all' if loaded is None else '--loaded'} beside --axis: its list is whole already"
                    )
                lists.append(weighted_metrics(recording, chosen))
            else:
                lists.append(all_metrics(recording, loaded) if whole or loaded is not None else metrics_of(recording))
            lists[-1].extend(beyond_bands(recording, bands))
            notes += [f"{bag.path.name}: {bag.metadata['imported_as']}"] if IMPORTED_FROM in bag.metadata else []
            warnings += [f"{suite_name([bag.path])}: {said}" for said in warnings_of(recording)]
            scenes.append(recording.scene)
            above.append(above_request(accuracy_numbers(recording)))
    names = [suite_name([path]) for path in paths]
    if len(bags) == 1:
        return FoundMetrics(lists[0], notes, warnings, *above)
    texts = "; ".join(dict.fromkeys(each.text for each in above if each.text))
    of_all = Above(texts, any(each.is_doubtful for each in above))
    return FoundMetrics(repeated(names, scenes, lists), notes, warnings, of_all)


def recording_of(bag: Bag) -> Recording:
    """The recording of a bag. Raises BagError also where its scene is none that this version knows."""
    with scenes_fit([bag]):
        recording = read_recording(bag)
    if not recording.contacts and not recording.fields and recording.motion is None:
        raise BagError(f"{bag.path} holds no force and no motion of the bench: there is nothing to measure")
    return recording


def weighted_metrics(recording: Recording, chosen: ForeignOptions) -> list[Metric]:
    """The metrics of what of a run of the bench shakes a person, by another weighting. Raises BagError for what it does
    not take, or has not.
    """
    given = [f"--{name}" for name in ("topic", "unit", "up") if getattr(chosen, name) is not None]
    if given:
        raise BagError(f"{', '.join(given)}: for a bag of anybody; a run of the bench has m/s², z upwards")
    (way,) = axes_of(chosen.axis)
    if way.axis != "z":
        raise BagError(
            f"--axis {chosen.axis}: a run of the bench has the vertical axis; write --axis {way.weighting.name}"
        )
    found = [
        metric
        for each in reports_of(recording)
        if each.weighted
        for metric in load(each.weighted)(recording, way.weighting)
    ]
    if not found:
        raise BagError(f"--axis {chosen.axis}: the run {recording.name} shakes no seat that could be weighted")
    return found


def is_foreign(bag: Bag, chosen: ForeignOptions | None) -> bool:
    """Whether a bag is taken as one of anybody: it holds nothing of the bench, or a topic of it that is no part of
    the bench is chosen.
    """
    return not is_ours(bag) or (chosen is not None and chosen.topic is not None)


def is_ours(bag: Bag) -> bool:
    """Whether a bag holds series or pressure fields of the bench."""
    return any(row.type in (*SERIES_TYPES, PATCH) for row in bag.topics.values())


def suite_name(paths: Sequence[Path]) -> str:
    """Names of the bags: their directories."""
    return ", ".join((path.parent.name if path.suffix == ".mcap" else path.name) or str(path) for path in paths)
