"""What the page says first: the verdict on a run in a word and one sentence, and the tiles behind it."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from itertools import zip_longest
from typing import NamedTuple

from contact_sim_pkg.compare.estimated import Above, above_request, accuracy_numbers
from contact_sim_pkg.records.metric import GOOD, MET, OUTSIDE, REQUIRED, SELF_CHECK, UNDECIDED, USUAL, Metric
from contact_sim_pkg.records.report import ContactReport
from contact_sim_pkg.report import facts
from contact_sim_pkg.report.metrics.regimes import expected, line_of
from contact_sim_pkg.report.metrics.views import value_text
from contact_sim_pkg.report.rig_reports import ANSWER_KEY, answered, reports_of
from contact_sim_pkg.report.series import Recording

__all__ = ["MOST_TILES", "Answer", "answer_of", "first_metrics"]

LEAST_TILES, MOST_TILES = 6, 8
MOST_PHRASES = 2
"""of the rigs, that are not folded"""


class Answer(NamedTuple):
    """The first line of the page."""

    tone: str
    """class of its colour: good, usual, doubtful or outside"""
    word: str
    text: str
    more: tuple[str, ...] = ()
    """what is folded behind it, a phrase each"""
    runs: tuple[Answer, ...] = ()
    """of several runs one line each"""


def answer_of(recording: Recording, metrics: Sequence[Metric]) -> Answer:
    """The worst that holds of a run with `MOST_PHRASES` of what its rigs have to say, the first of each in turn; the
    others, and what no request makes more accurate, are `more`.
    """
    found = {metric.key: metric for metric in metrics}
    by_rig = [
        [text for phrase in report.answer if (text := _filled(phrase, report, found))]
        for report in reports_of(recording)
    ]
    in_turn = [text for rank in zip_longest(*by_rig) for text in rank if text is not None]
    first = in_turn[:MOST_PHRASES]
    above = above_request(accuracy_numbers(recording))
    tone, word, reason = _verdict(recording, metrics, above)
    said = [text for texts in by_rig for text in texts]
    more = [*(text for text in said if text not in first), above.text if above.text not in reason else ""]
    shown = [reason, *(text for text in said if text in first)]
    return Answer(tone, word, "; ".join(filter(None, shown)) + ".", tuple(filter(None, more)))


def first_metrics(recording: Recording, metrics: Sequence[Metric]) -> list[Metric]:
    """At most `MOST_TILES` metrics: limits of one's own and what lies outside, then in their order what the answer
    names and the first ones of each contact in turn; self-checks only where there are fewer than `LEAST_TILES`.
    """
    named = answered(recording)
    own = {
        each.key for each in metrics
        if each.verdict in (OUTSIDE, UNDECIDED) or (each.band is not None and each.band.kind == REQUIRED)
    }  # fmt: skip
    checks = {each.key for each in metrics if each.basis == SELF_CHECK} - named - own
    by_contact: dict[str, list[str]] = {}
    for metric in metrics:
        by_contact.setdefault(metric.key.partition(".")[0], []).append(metric.key)
    ranks = zip_longest(*(sorted(keys, key=lambda key: key not in named) for keys in by_contact.values()))
    ranked = sorted((key for rank in ranks for key in rank if key is not None), key=lambda key: key not in own)
    most = max(LEAST_TILES, min(MOST_TILES, len(ranked) - len(checks)))
    chosen = sorted(ranked, key=lambda key: key in checks)[:most]
    return sorted((each for each in metrics if each.key in chosen), key=lambda each: each.key not in own)


def _verdict(recording: Recording, metrics: Sequence[Metric], above: Above) -> tuple[str, str, str]:
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
        return "doubtful", "Undecided", ", ".join(undecided)
    if broken := dict.fromkeys(text for each in metrics for text in each.broken):
        return "doubtful", "Doubtful", ", ".join(broken)
    if above.is_doubtful:
        return "doubtful", "Doubtful", above.text
    judged = [each.verdict for each in metrics]
    if GOOD in judged:
        return "good", "Good", "nothing outside its band"
    if USUAL in judged:
        return "usual", "As usual", "nothing outside its band"
    met = judged.count(MET)  # a run that agrees with a closed form is computed well, and may be good or bad
    return "usual", "Measured", "no band applies" + (f", {met} self-checks met" if met else "")


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
