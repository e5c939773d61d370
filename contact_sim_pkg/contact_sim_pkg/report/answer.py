"""What the page says first: the verdict on a run in a word and one sentence, and the tiles behind it."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from itertools import zip_longest
from typing import NamedTuple

from contact_sim_pkg.records.metric import GOOD, MET, OUTSIDE, REQUIRED, SELF_CHECK, UNDECIDED, USUAL, Metric
from contact_sim_pkg.records.report import ContactReport
from contact_sim_pkg.report import facts
from contact_sim_pkg.report.metrics.regimes import expected, line_of
from contact_sim_pkg.report.metrics.views import value_text
from contact_sim_pkg.report.rig_reports import ANSWER_KEY, answered, reports_of
from contact_sim_pkg.report.series import Recording

__all__ = ["MOST_TILES", "Answer", "answer_of", "first_metrics"]

MOST_TILES = 8


class Answer(NamedTuple):
    """The first line of the page."""

    tone: str
    """class of its colour: good, usual, doubt or outside"""
    word: str
    text: str


def answer_of(recording: Recording, metrics: Sequence[Metric]) -> Answer:
    """The worst that holds of a run, then what its rigs have to say."""
    found = {metric.key: metric for metric in metrics}
    phrases = [
        text for report in reports_of(recording) for phrase in report.answer if (text := _filled(phrase, report, found))
    ]
    tone, word, reason = _verdict(recording, metrics)
    return Answer(tone, word, "; ".join([*([reason] if reason else []), *phrases]) + ".")


def first_metrics(recording: Recording, metrics: Sequence[Metric]) -> list[Metric]:
    """At most `MOST_TILES` metrics in their order: limits of one's own and what lies outside, then those that the
    answer names, then the first ones of each contact in turn.
    """
    named = answered(recording)
    own = [
        each for each in metrics if each.verdict in (OUTSIDE, UNDECIDED) or (each.band and each.band.kind == REQUIRED)
    ]
    by_contact: dict[str, list[Metric]] = {}
    for metric in metrics:
        if metric.basis == SELF_CHECK and metric.key not in named:
            continue  # the run beside itself stands under Trust
        by_contact.setdefault(metric.key.partition(".")[0], []).append(metric)
    ranked = [
        metric for rank in zip_longest(*(sorted(each, key=lambda one: one.key not in named) for each in by_contact.values()))
        for metric in rank if metric is not None
    ]  # fmt: skip
    chosen = [*dict.fromkeys(metric.key for metric in (*own, *ranked))][:MOST_TILES]
    first = {metric.key for metric in own}
    return sorted((metric for metric in metrics if metric.key in chosen), key=lambda metric: metric.key not in first)[
        :MOST_TILES
    ]


def _verdict(recording: Recording, metrics: Sequence[Metric]) -> tuple[str, str, str]:
    """Tone, word and reason of the worst that holds."""
    if ended := facts.ended_early(recording):
        return "outside", "Not finished", ended[0].rstrip(".")
    outside = [f"{each.name} {value_text(each)} ({each.band.text if each.band else ''})"
               for each in metrics if each.verdict == OUTSIDE]  # fmt: skip
    regime = expected(recording)
    missed = [line_of(regime)] if regime is not None and regime.verdict == OUTSIDE else []
    if outside or missed:
        return "outside", "Outside" if outside else "Not as expected", ", ".join([*outside, *missed])
    undecided = [f"{each.name} {value_text(each)}" for each in metrics if each.verdict == UNDECIDED]
    if undecided:
        return "doubt", "Undecided", ", ".join(undecided)
    if doubts := dict.fromkeys(text for each in metrics for text in each.broken):
        return "doubt", "Doubtful", ", ".join(doubts)
    judged = [each.verdict for each in metrics if each.verdict in (GOOD, USUAL, MET)]
    if GOOD in judged:
        return "good", "Good", "nothing outside its band"
    return ("usual", "As usual", "nothing outside its band") if judged else ("usual", "Measured", "no band applies")


def _filled(phrase: str, report: ContactReport, metrics: dict[str, Metric]) -> str:
    """The phrase with the values of its metrics; empty where one is absent."""
    keys = [f"{report.contact}.{key}" for key, _ in ANSWER_KEY.findall(phrase)]
    if any(key not in metrics for key in keys):
        return ""

    def text(found: re.Match[str]) -> str:
        metric = metrics[f"{report.contact}.{found[1]}"]
        # the tiles have what it is uncertain by
        return metric.remark.partition(";")[0] if found[2] else value_text(metric._replace(spread=math.nan))

    return ANSWER_KEY.sub(text, phrase).rstrip(", :")
