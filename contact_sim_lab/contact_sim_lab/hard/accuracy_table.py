"""`bench hard --accuracy`: hard scenes at four requests; what is held, and what the run names itself.

A row is *held* where force and motion err by no more than requested, beside a run at 3e-5; *named*
where each of the two that errs by more is estimated above the request by the run, cannot be below it
by the record of an effect, or where the run ends with a sentence; else *missed*. A scene whose guard
is not met is *not hard*, whatever its errors.

Columns of a row: `scene`, `hard` (what is hard about it), `guard` (in words), `figure`, `relation` and
`bound` of it, `requested`, `force`, `motion` (largest error over the scale of its kind), `estimated`
by the run, by kind, `mark`, `names` (what names it), `cpu_s` of the run, `scene_cpu_s` of all runs of
the scene, `start_s`, `end_s`.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from contact_sim_lab.hard.accuracy_cases import CASES, AccuracyCase
from contact_sim_lab.records.guard import Guard
from contact_sim_pkg.compare.first_look import DEEP, MOVED, REQUESTS, Effort, FirstLook, Request, first_look
from contact_sim_pkg.compare.least_errors import LeastError, least_errors
from contact_sim_pkg.records.table import number_of
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.run.scene_outputs import outputs_with
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.resolve import load_resolved

__all__ = ["cells", "failed", "mark_of", "rows_of", "study", "summary"]

Row = dict[str, Any]
HELD, NAMED, MISSED, NOT_HARD = "held", "named", "missed", "not hard"
ASKED = (*REQUESTS, DEEP)
REFERENCE_CPU, SCALES_CPU = 30.0, 2.0  # [s], at most, of the finer run and of that for the scales


def study(progress: Callable[[str], None], cases: Sequence[AccuracyCase] = CASES) -> Iterator[list[Row]]:
    """Rows of each case as they come, four requests, coarsest first."""
    for number, case in enumerate(cases, 1):
        progress(f"{number} of {len(cases)}: {case.name}: {case.hard}")
        yield _rows(case, progress)


def rows_of(case: AccuracyCase, look: FirstLook, least: Mapping[str, LeastError]) -> list[Row]:
    """Rows of a case that was looked at, with the ``least`` errors by kind of its effects."""
    length = look.end - look.start
    found, ended = {each.requested: each for each in look.requests}, dict(look.ended)
    rows = []
    for asked in ASKED:
        run = found.get(asked)
        if run is None:
            rows.append(_unjudged(case, asked, NAMED, ended[asked]))
            continue
        mark, names = mark_of(run, least)
        rows.append(
            {
                **_unjudged(case, asked, mark, names), **{kind: run.errors.get(kind) for kind in MOVED},
                "estimated": run.estimated, "cpu_s": run.cost * length,
            }
        )  # fmt: skip
    return [{**row, "start_s": look.start, "end_s": look.end} for row in rows]


def mark_of(run: Request, least: Mapping[str, LeastError]) -> tuple[str, str]:
    """Mark of a run, and what names the errors above its request: empty where none is, or nothing
    does.
    """
    above = [kind for kind in MOVED if run.errors.get(kind, 0.0) > run.requested]
    if not above:
        return HELD, ""
    names = [_name(kind, run, least) for kind in above]
    return (NAMED, "; ".join(names)) if all(names) else (MISSED, "")


def cells(rows: Sequence[Row]) -> dict[str, str]:
    """The rows of one scene as a line: larger error of force and motion by request, and what makes it hard."""
    first, requests = rows[0], {number_of(row["requested"]): f"{_error(row)} {row['mark']}".strip() for row in rows}
    guard = Guard(first["guard"], first["relation"], first["bound"]).says(first["figure"])
    return {"scene": first["scene"], **requests, "CPU s": f"{first['scene_cpu_s']:.2g}", "hard because": guard}


def failed(rows: Sequence[Row]) -> bool:
    """Whether an error above its request is named by nothing."""
    return _count(rows, MISSED) > 0


def unjudged(rows: Sequence[Row]) -> bool:
    """Whether a scene is not hard, so that it shows nothing."""
    return _count(rows, NOT_HARD) > 0


def _rows(case: AccuracyCase, progress: Callable[[str], None]) -> list[Row]:
    began = time.process_time()
    effort = Effort(REFERENCE_CPU, REFERENCE_CPU, SCALES_CPU, repeats=1, length=case.span, lead=0.0)
    try:
        kinds = least_errors(load_resolved(case.scene, *case.values).data).values()
        least = {kind: max(each[kind] for each in kinds if kind in each) for each in kinds for kind in each}
    except SceneError as error:
        rows = [_unjudged(case, asked, NAMED, str(error)) for asked in ASKED]  # refused before the start
    else:
        try:
            look = first_look(case.scene, progress, deep=True, values=case.values, effort=effort)
            rows = rows_of(case, look, least)
        except (SceneError, RunError) as error:
            progress(f"  no finer run: {error}")
            rows = [_unjudged(case, asked, MISSED, "") for asked in ASKED]
    spent, figure = time.process_time() - began, _figure(case, progress)
    guarded = {
        "guard": case.is_hard.what, "figure": figure, "relation": case.is_hard.relation, "bound": case.is_hard.bound,
        "scene_cpu_s": spent, **({} if case.is_hard.met(figure) else {"mark": NOT_HARD}),
    }  # fmt: skip
    return [{**row, **guarded} for row in rows]


def _figure(case: AccuracyCase, progress: Callable[[str], None]) -> float:
    """Figure of the guard from a run of the whole scene; NaN where that fails."""
    try:
        scene = load_resolved(case.scene, *case.values)
        return case.measure(scene, outputs_with(scene, make_simulation(scene)))
    except (SceneError, RunError) as error:
        progress(f"  no figure of the guard: {error}")
        return math.nan


def _unjudged(case: AccuracyCase, asked: float, mark: str, names: str) -> Row:
    return {
        "scene": case.name, "hard": case.hard, "requested": asked, **dict.fromkeys(MOVED), "estimated": {},
        "mark": mark, "names": names, "cpu_s": 0.0, "start_s": None, "end_s": None,
    }  # fmt: skip


def _name(kind: str, run: Request, least: Mapping[str, LeastError]) -> str:
    """What names an error of a kind above the request; bodies move by the forces on them."""
    moved_by = MOVED if kind == "motion" else (kind,)
    estimated = max((run.estimated.get(each, 0.0) for each in moved_by), default=0.0)
    if estimated > run.requested:
        return f"{kind} estimated {number_of(estimated)}"
    bound = least.get(kind, LeastError(0.0, ""))
    return f"{kind} not below {number_of(bound.error)} with {bound.effect}" if bound.error > run.requested else ""


def _error(row: Row) -> str:
    errors = [row[kind] for kind in MOVED if row[kind] is not None]
    return number_of(max(errors)) if errors else ""


def _count(rows: Sequence[Row], mark: str) -> int:
    return sum(row["mark"] == mark for row in rows)


def summary(rows: Sequence[Row]) -> str:
    """The sum of the marks."""
    spent = sum({row["scene"]: row["scene_cpu_s"] for row in rows}.values())
    return (
        f"held {_count(rows, HELD)} of {len(rows)}; named {_count(rows, NAMED)}; missed {_count(rows, MISSED)}; "
        f"not hard {_count(rows, NOT_HARD)}; "
        f"{spent:.0f} CPU s"
    )
