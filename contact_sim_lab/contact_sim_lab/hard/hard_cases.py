"""`bench hard`: the hard cases of the models that are built, each with value, expectation, margin,
guard and verdict.

A case computes a value with the bench's own kernels and compares it with an expectation that shares
no code with them: a closed form, multiple precision, scipy, or a plain count. The margin is the
part of the allowance that is left: 1 where value and expectation agree, 0 at the limit, negative
where the case fails. The guard shows that the run was hard: its figure, and the bound that the figure
must keep; a case whose run is not hard fails, whatever value it found.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from contact_sim_lab import cases
from contact_sim_lab.records.guard import Guard
from contact_sim_lab.records.hard_case import Finding, HardCase
from contact_sim_pkg.records.table import Section

__all__ = [
    "all_cases",
    "evaluate",
    "failed",
    "sections",
    "study",
]


PASSED, FAILED, NOT_HARD = "pass", "fail", "not hard"


def all_cases() -> list[HardCase]:
    """Every case: those of no rig, then those of the rigs."""
    return cases.objects((*cases.HARD_CASES, *cases.modules_of_rigs("hard_cases")), "CASES")


def evaluate(case: HardCase) -> dict[str, Any]:
    """One row of the table; a case that raises fails with its error as the expectation that was not
    met.
    """
    try:
        finding = case.find()
    except Exception as error:  # noqa: BLE001 - a table of cases goes on past a broken one, and says so
        finding = Finding(math.nan, f"an answer, not {type(error).__name__}: {error}", -math.inf, math.nan)
    verdict = FAILED if not finding.margin >= 0.0 else PASSED if case.is_hard.met(finding.hard) else NOT_HARD
    return {
        "model": case.model, "case": case.case, "value": float(finding.value), "expectation": finding.expectation,
        "margin": float(finding.margin), "guard": case.is_hard.what, "figure": float(finding.hard),
        "relation": case.is_hard.relation, "bound": case.is_hard.bound, "verdict": verdict,
    }  # fmt: skip


def study(model: str | None = None, progress: Callable[[str], None] | None = None) -> list[dict[str, Any]]:
    """Rows of all cases, or of those of one `model`: model, case, value, expectation, margin; guard (in
    words), figure, relation and bound of it; verdict (`pass`, `fail` or `not hard`).
    """
    rows = []
    for case in all_cases():
        if model is not None and case.model != model:
            continue
        if progress is not None:
            progress(f"{case.model}: {case.case}")
        rows.append(evaluate(case))
    return rows


def sections(rows: list[dict[str, Any]]) -> list[Section]:
    """The same rows as a person reads them: a section a model."""
    found = []
    for model in dict.fromkeys(row["model"] for row in rows):
        lines = [
            {
                "case": row["case"], "value": _value(row), "expectation": row["expectation"],
                "margin": f"{row['margin']:.3f}", "verdict": row["verdict"],
                "hard because": Guard(row["guard"], row["relation"], row["bound"]).says(row["figure"]),
            }
            for row in rows
            if row["model"] == model
        ]  # fmt: skip
        found.append(Section(model, lines))
    return found


def _value(row: dict[str, Any]) -> str:
    """As many digits as the expectation has."""
    return f"{row['value']:.10g}" if "±" in row["expectation"] else f"{row['value']:.4g}"


def failed(rows: list[dict[str, Any]]) -> bool:
    """Whether a row fails."""
    return any(row["verdict"] == FAILED for row in rows)


def unjudged(rows: list[dict[str, Any]]) -> bool:
    """Whether the run of a row is not hard, so that it shows nothing."""
    return any(row["verdict"] == NOT_HARD for row in rows)
