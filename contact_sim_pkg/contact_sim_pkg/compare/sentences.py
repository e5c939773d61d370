"""Delivered accuracy in words: a line for each contact or body and kind."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from contact_sim_pkg.compare.delivered import Check
from contact_sim_pkg.compare.judgement import Judgement
from contact_sim_pkg.compare.parting import Parting
from contact_sim_pkg.records.table import number_of

__all__ = ["facts_of", "lines_of"]

SAME_BITS = "the finer run has the same bits: what it has finer does not act here"
DRIFT = "what builds up over a run, as a drift of positions, is seen by `bench accuracy BAG --whole` only"
MODEL = "numerical error only; the error of the model is on the validation page"


def lines_of(check: Check) -> Iterator[str]:
    """Lines of a check: delivered errors, what is not resolved, what is not judged."""
    for judgement in check.judgements:
        yield _line(judgement, check.requested, parted=check.parting is not None)
    if not any(judgement.error for judgement in check.judgements):
        yield SAME_BITS
    if check.parting is not None:
        yield from _parting_lines(check.parting)
    if check.limited:
        yield f"coupling and integration only: {check.limited}"
    windows = "; ".join(f"{each.start:g} to {each.end:g} s ({', '.join(each.reasons)})" for each in check.windows)
    yield f"checked: {windows}; finer: {', '.join(check.dials) or 'nothing'}"
    if not check.is_whole:
        yield DRIFT
    yield f"not judged: {'; '.join(check.not_judged)}"
    yield MODEL


def facts_of(check: Check) -> dict[str, Any]:
    """The check as plain values, for scripts."""
    rows = [
        {
            **{name: getattr(each, name) for name in ("place", "kind", "error", "column", "time")},
            "held": each.error <= check.requested or check.parting is not None,
            "not_resolved": {lost.column: lost.share for lost in each.unresolved},
        }
        for each in check.judgements
    ]
    parting = check.parting
    return {
        "scene": check.scene,
        "requested": check.requested,
        "delivered": rows,
        "windows": [each._asdict() for each in check.windows],
        "finer": check.dials,
        "limited": check.limited or None,
        "agrees_until_s": None if parting is None else parting.time,
        "beyond": [] if parting is None else [each._asdict() for each in parting.statistics],
        "not_judged": check.not_judged,
        "cpu_s": check.cpu,
    }


def _line(judgement: Judgement, request: float, *, parted: bool) -> str:
    held = "" if judgement.error <= request else " (until the runs part)" if parted else " (not held)"
    parts = [
        f"{judgement.place} {judgement.kind}: requested {number_of(request)}, delivered {number_of(judgement.error)}{held}"
        + (f" ({judgement.column} at {judgement.time:.4g} s)" if judgement.error > 0.0 else "")
    ]
    parts += [f"{each.column} not resolved ({100.0 * each.share:.0f} % of its own)" for each in judgement.unresolved]
    return "; ".join(parts)


def _parting_lines(parting: Parting) -> Iterator[str]:
    worst = max(parting.statistics, key=lambda each: max(each.mean, each.rms, each.quantiles))
    yield (
        f"the runs agree until {parting.time:.4g} s and part there; beyond it means differ by "
        f"{number_of(max(each.mean for each in parting.statistics))}, rms by "
        f"{number_of(max(each.rms for each in parting.statistics))}, quantiles by "
        f"{number_of(max(each.quantiles for each in parting.statistics))} of the scale at most "
        f"({worst.place} {worst.column})"
    )
