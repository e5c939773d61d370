"""What the page of a comparison says first: which run is better and by which number, and the tiles behind it."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from typing import NamedTuple

from contact_sim_pkg.compare.side_by_side import ComparedMetric
from contact_sim_pkg.records.metric import SELF_CHECK
from contact_sim_pkg.report.answer import MOST_TILES, Answer
from contact_sim_pkg.report.comparison.tables import signed, with_spread
from contact_sim_pkg.report.metrics.tiles import printed_unit
from contact_sim_pkg.report.rows import number

__all__ = ["MovedTile", "answer_of_runs", "moved_tiles"]

BETTER, WORSE, UNKNOWN = "better", "worse", "spread not known"
TONES = {BETTER: "good", WORSE: "outside", UNKNOWN: "doubtful", "higher": "no-band", "lower": "no-band"}

WORST_FIRST = ("outside", "doubtful", "good", "usual", "no-band")


class Moved(NamedTuple):
    """One run beside the first."""

    letter: str
    value: str
    instant: str
    """of an event, `at 0.990 s`"""
    change: str
    """with its uncertainty where that is known"""
    share: str
    """of the first run's value, `+5 %`"""
    word: str
    """better or worse by a limit; higher or lower where no limit says which is better"""
    tone: str
    """class of its colour"""


class MovedTile(NamedTuple):
    """One metric of all runs as texts."""

    label: str
    unit: str
    letter: str
    value: str
    """of the first run"""
    instant: str
    moved: list[Moved]

    @property
    def tone(self) -> str:
        """Class of its colour: the worst of the runs."""
        tones = {each.tone for each in self.moved}
        return next((each for each in WORST_FIRST if each in tones), "usual")


class _Said(NamedTuple):
    """What is said of one run beside the first."""

    tone: str
    word: str
    first: str
    """the number that decides"""
    rest: str
    before: str = ""
    """words before the first"""

    def whole(self) -> Answer:
        return Answer(self.tone, self.word, f"{self.before}{self.first}{self.rest}.")


def moved_tiles(names: Sequence[str], sides: Sequence[ComparedMetric], leading: Collection[str]) -> list[MovedTile]:
    """At most `MOST_TILES`, what moved most first, those of the ``leading`` keys among them, no self-check, and no number
    of a leading one again: the largest force is also the largest load.
    """
    said = {(each.unit, *each.values) for each in sides if each.key in leading and any(each.values)}
    defined = [
        each
        for each in sides
        if each.basis != SELF_CHECK
        and math.isfinite(each.values[0])
        and (each.key in leading or (each.unit, *each.values) not in said)
    ]
    chosen = {each.key for each in sorted(defined, key=lambda each: each.key not in leading)[:MOST_TILES]}
    return [_tile(letters_of(names), each) for each in defined if each.key in chosen]


def answer_of_runs(
    names: Sequence[str], sides: Sequence[ComparedMetric], named: Collection[str], unfinished: Sequence[str] = ()
) -> Answer:
    """The word and the sentence on all runs.

    Args:
        names: of the runs.
        sides: their metrics, what moved most first.
        named: keys of the metrics that the answer of a run names: they speak first.
        unfinished: why runs ended early, a sentence each.
    """
    if unfinished:
        return Answer("outside", "Not finished", "; ".join(each.rstrip(".") for each in unfinished) + ".")
    letters = letters_of(names)
    ranked = sorted((each for each in sides if each.basis != SELF_CHECK), key=lambda each: each.key not in named)
    found = [
        _answer([each.against_first(place) for each in ranked], named, letters[0], letter)
        for place, letter in enumerate(letters[1:], start=1)
    ]
    if len(found) == 1:
        return found[0].whole()
    tones = [each.tone for each in found]
    tone = next((each for each in ("doubtful", "good") if each in tones), "usual")
    lines = [
        each._replace(word=each.word if each.word.startswith(letter) else f"{letter}: {each.word}")
        for letter, each in zip(letters[1:], found, strict=True)
    ]
    return Answer(
        tone, f"Against {letters[0]}", "", tuple(f"{each.word}: {each.whole().text}" for each in lines),
        tuple(Answer(each.tone, each.word, each.first) for each in lines),
    )  # fmt: skip


def letters_of(names: Sequence[str]) -> list[str]:
    """`A` of `A: seat_soft`."""
    return [name.partition(":")[0] for name in names]


def _answer(pairs: Sequence[ComparedMetric], named: Collection[str], first: str, letter: str) -> _Said:
    """Of two runs: what the metrics say that are ``named``, have a limit and moved, else what all do."""
    speaking = [each for each in pairs if each.key in named and each.limit and each.comparison and each.change] or pairs
    better, worse, unknown = (
        [each for each in speaking if each.comparison == word] for word in (BETTER, WORSE, UNKNOWN)
    )
    if better or worse:
        return _judged(better, worse, unknown, first, letter)
    rest = "".join(
        f"; {word} by {_names(found)}"
        for word in (BETTER, WORSE)
        if (found := [each for each in pairs if each.comparison == word])
    )
    if unknown:
        rest = f"{_more(unknown, 'nor of')}{rest}{_reservation(unknown[0], first, letter)}"
        return _Said("doubtful", f"{letter} undecided", _change(unknown[0]), rest, "the spread is not known of ")
    known = [each for each in speaking if math.isfinite(each.change)]
    moved = max((each for each in known if not each.comparison), key=_moved, default=None)
    if moved is not None:
        rest = "; no limit says which run is better"
        return _Said("usual", f"{letter} differs", _change(moved), rest, "most moved ")
    within = max(known, key=_moved, default=None)
    if within is None or within.change == 0.0:
        return _Said("usual", f"{letter} is the same", f"no metric differs from {first}", rest)
    others = [within, *(each for each in known if each is not within)]
    return _Said(
        "usual", f"{letter}: no difference beyond ±", _change(within), f"{_more(others, 'nor of')}{rest}"
    )  # fmt: skip


def _judged(
    better: Sequence[ComparedMetric],
    worse: Sequence[ComparedMetric],
    unknown: Sequence[ComparedMetric],
    first: str,
    letter: str,
) -> _Said:
    """Where limits tell the runs apart."""
    reservation = next(filter(None, (_reservation(each, first, letter) for each in (*better, *worse))), "")
    rest = f"; the spread is not known of {_names(unknown)}" if unknown else ""
    tone = "doubtful" if reservation else "usual" if better and worse else "good"
    if better and worse:
        rest = f"{_more(better)}; worse by {_change(worse[0])}{_more(worse)}{rest}{reservation}"
        return _Said(tone, f"{letter} better and worse", _change(better[0]), rest, "better by ")
    judging = better or worse
    word = f"{letter if better else first} is better"
    return _Said(tone, word, _change(judging[0]), f"{_more(judging)}{rest}{reservation}")


def _more(sides: Sequence[ComparedMetric], joined: str = "also by") -> str:
    return f", {joined} {_names(sides[1:])}" if len(sides) > 1 else ""


def _names(sides: Sequence[ComparedMetric]) -> str:
    return ", ".join(each.name for each in sides)


def _reservation(side: ComparedMetric, first: str, letter: str) -> str:
    """What does not hold in both runs, and what in one, with its letter."""
    if not side.broken:
        return ""
    one, other = side.broken_of
    found = [text for text in one if text in other]
    found += [f"{first}: {text}" for text in one if text not in other]
    found += [f"{letter}: {text}" for text in other if text not in one]
    return f" ({'; '.join(found)})"


def _change(side: ComparedMetric) -> str:
    """`SEAT 54.2 → 48.1 % (-6.1 ± 2)`."""
    one, other = map(number, side.values)
    return f"{side.name} {one} → {other} {printed_unit(side.unit)}".rstrip() + f" ({_with_uncertainty(side)})"


def _with_uncertainty(side: ComparedMetric) -> str:
    return with_spread(signed(side.change), side.uncertainty)


def _moved(side: ComparedMetric) -> float:
    return side.moved


def _tile(letters: Sequence[str], side: ComparedMetric) -> MovedTile:
    pairs = [side.against_first(place) for place in range(1, len(letters))]
    moved, (first, *others) = [], side.instants or ("",) * len(letters)
    for letter, each, instant in zip(letters[1:], pairs, others, strict=True):
        word = each.comparison or ("absent" if math.isnan(each.change) else "higher" if each.change > 0.0 else "lower")
        change = _with_uncertainty(each) if math.isfinite(each.change) and each.change else ""
        share = f"{signed(100.0 * each.relative)} %" if math.isfinite(each.relative) and each.change else ""
        moved.append(Moved(letter, number(each.values[1]), instant, change, share, word, TONES.get(word, "usual")))
    return MovedTile(side.name, printed_unit(side.unit), letters[0], number(side.values[0]), first, moved)
