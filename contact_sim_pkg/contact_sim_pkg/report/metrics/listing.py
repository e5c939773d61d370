"""The metrics of a recording: the lists of its rigs, or that of a bag without a rig."""

from __future__ import annotations

import logging
from itertools import zip_longest

from contact_sim_pkg.bag.metadata import WARNINGS
from contact_sim_pkg.files import printable
from contact_sim_pkg.records.metric import EVENT, Metric
from contact_sim_pkg.records.registry import announced
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.report.energy import throughput
from contact_sim_pkg.report.metrics.maker import ENERGY, Maker, energy_residual
from contact_sim_pkg.report.metrics.mat import LOADED, mat_metrics
from contact_sim_pkg.report.rig_reports import answered, reports_of
from contact_sim_pkg.report.series import ContactSeries, Recording
from contact_sim_pkg.report.signal.confidence import spread_of_mean

__all__ = ["MOST", "all_metrics", "metrics_of", "of_field"]

_log = logging.getLogger(__name__)
MOST = 14
"""Metrics in the list of a run."""


def metrics_of(recording: Recording) -> list[Metric]:
    """The list of a run, the most important first; where several contacts share it, of each in turn what
    its answer names, then the first ones. Of fields alone, as of a mat, their whole lists. Those of plug-ins come last,
    and take no place of ours.
    """
    if not recording.contacts and recording.motion is None:
        return all_metrics(recording)
    lists, others = _named(_lists(recording)), _of_plugins(recording)
    if sum(map(len, lists)) <= MOST:
        return [metric for each in (*lists, others) for metric in each]
    named = answered(recording)
    ranked = (sorted(each, key=lambda metric: metric.key not in named) for each in lists)
    chosen = [metric for rank in zip_longest(*ranked) for metric in rank if metric is not None][:MOST]
    return [*(metric for each in lists for metric in each if metric in chosen), *others]


def all_metrics(recording: Recording, loaded: float | None = None) -> list[Metric]:
    """The whole lists of all contacts, and the mat metrics of each pressure map, of cells above ``loaded`` [Pa]; None:
    above what the scene says, else 1 Pa.
    """
    if loaded is None:
        loaded = float((recording.scene.get("outputs") or {}).get("loaded_pressure", LOADED))
    mats = [of_field(recording, name, loaded) for name in recording.fields]
    return [metric for each in (*_named([*_lists(recording), *mats]), _of_plugins(recording)) for metric in each]


def of_field(recording: Recording, contact: str, loaded: float) -> list[Metric]:
    """The mat metrics of the field of a contact, with the warnings about a mat that was imported."""
    warnings = tuple(filter(None, recording.metadata.get(WARNINGS, "").splitlines()))
    metrics = mat_metrics(contact, recording.fields[contact], recording.duration, loaded)
    return [_with_warning(each._replace(broken=(*each.broken, *warnings)), recording) for each in metrics]


def _named(lists: list[list[Metric]]) -> list[list[Metric]]:
    """The lists, with the contact before each name where there are several."""
    contacts = {metric.key.partition(".")[0] for each in lists for metric in each} - {ENERGY}
    if len(contacts) < 2:
        return lists
    return [[_with_contact(each) for each in metrics] for metrics in lists]


def _with_contact(metric: Metric) -> Metric:
    contact = metric.key.partition(".")[0]
    return metric if contact == ENERGY else metric._replace(name=f"{contact}: {metric.name}")


def _lists(recording: Recording) -> list[list[Metric]]:
    found: list[list[Metric]] = [load(each.metrics)(recording) for each in reports_of(recording) if each.metrics]
    listed = {metric.topic.partition("/")[0] for each in found for metric in each}
    rest = [load_metrics(name, contact) for name, contact in recording.contacts.items() if name not in listed]
    ledger = recording.ledger
    exchanged = ledger is not None and throughput(ledger) != 0.0  # where nothing is, nothing is judged
    energy = [] if ledger is None or not exchanged else [energy_residual(ledger, recording.duration, recording.scene)]
    return [[_with_warning(metric, recording) for metric in each] for each in (*found, *rest, energy) if each]


def _of_plugins(recording: Recording) -> list[Metric]:
    """What the entry points `contact_sim_pkg.metrics` add, each a function of a recording; one that fails is a line on
    standard error, and left out.
    """
    found: list[Metric] = []
    for name, place in announced("metrics").items():
        try:
            made = [*load(place)(recording)]
            wrong = next((each for each in made if not isinstance(each, Metric)), None)
            if wrong is not None:
                raise TypeError(f"{wrong!r:.60} is no Metric")
        except Exception as error:  # noqa: BLE001 - whatever a stranger's function raises
            _log.warning("%s", printable(f"the metrics {name} of a plug-in, {place}, are left out: {error}", 1000))
            continue
        found += [_with_warning(each, recording) for each in made]
    return found


def _with_warning(metric: Metric, recording: Recording) -> Metric:
    """The metric, marked where its topic holds what is no number."""
    unknown = recording.unknown.get(metric.topic)
    return metric if unknown is None else metric._replace(broken=(*metric.broken, f"{metric.topic}: {unknown}"))


def load_metrics(name: str, contact: ContactSeries) -> list[Metric]:
    """Loads of a contact of which no rig knows more."""
    window = float(contact.time[0]), float(contact.time[-1]) + contact.sample_period
    make = Maker(name, f"{name}/force", window).make
    normal = contact.normal
    spread = spread_of_mean(normal, 1.0 / contact.sample_period)
    return [
        make("load", "load, mean", normal.mean(), "N", spread=spread, count=normal.size),
        make("load_largest", "load, largest", normal.max(), "N", count=normal.size, basis=EVENT),
        make("lift_off", "time without load", 100.0 * (normal <= 0.0).mean(), "%", count=normal.size),
    ]
