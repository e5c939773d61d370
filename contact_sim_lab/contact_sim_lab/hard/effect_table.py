"""`bench hard --effects`: verdicts of effects beside what was expected before.

A row is *right* where the verdict is the expected one; else *needless*, where an effect that is not
needed is called so, *missed*, where one that is needed is not, or *other*, of which the numbers
decide for example. Columns: `case`, `effect`, `expected`, `verdict`, `mark`, `change`, `since`,
`cpu_s`.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from contact_sim_lab.hard.effect_cases import CASES, FIGURE, EffectCase
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.studies.effects import verdicts
from contact_sim_pkg.studies.effects.effects_study import EffectRow, study_of

__all__ = ["cells", "failed", "mark_of", "study", "summary"]

Row = dict[str, Any]
ASKED = (verdicts.NEEDED, verdicts.OFF_NEEDED)
MOST_WRONG = 0.15
"""Of the cases."""


def study(progress: Callable[[str], None], cases: Sequence[EffectCase] = CASES) -> Iterator[list[Row]]:
    """A row for each case as it comes."""
    for number, case in enumerate(cases, 1):
        progress(f"{number} of {len(cases)}: {case.name}: {case.effect} is expected to be {case.expected}")
        began = time.process_time()
        (found,) = study_of(load_resolved(case.scene, *case.values), lambda _line: None, case.effect).rows
        yield [_row(case, found) | {"cpu_s": time.process_time() - began}]


def mark_of(expected: str, verdict: str) -> str:
    """`right`, `needless`, `missed` or `other`."""
    if verdict == expected:
        return "right"
    if verdict in ASKED:
        return "needless"
    return "missed" if expected in ASKED else "other"


def failed(rows: Sequence[Row]) -> bool:
    """Whether too many are wrong."""
    return sum(1 for row in rows if row["mark"] != "right") > MOST_WRONG * len(rows)


def unjudged(_rows: Sequence[Row]) -> bool:
    """Whether a case has no verdict: each has one."""
    return False


def cells(rows: Sequence[Row]) -> dict[str, str]:
    """The row of one case as a line."""
    (row,) = rows
    return {
        "case": row["case"], "effect": row["effect"], "expected": row["expected"], "mark": row["mark"], "verdict": row["said"],
        "largest change": row["change"],
    }  # fmt: skip


def summary(rows: Sequence[Row]) -> str:
    """The counts."""
    counts = ", ".join(
        f"{mark} {sum(row['mark'] == mark for row in rows)}" for mark in ("right", "needless", "missed", "other")
    )
    return f"{counts} of {len(rows)}; {sum(row['cpu_s'] for row in rows):.0f} CPU s"


def _row(case: EffectCase, found: EffectRow) -> Row:
    verdict = FIGURE if found.verdict.startswith("would change") else found.verdict
    return {
        "case": case.name, "effect": case.effect, "expected": case.expected, "verdict": verdict, "said": found.verdict,
        "mark": mark_of(case.expected, verdict), "since": case.since,
        "change": "-" if found.largest is None else f"{verdicts.shown(found.largest)}, {found.largest.column}",
    }  # fmt: skip
