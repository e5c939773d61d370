"""`bench hard --regimes`: what each shipped scene is there to show, as its run measures it.

Columns: `scene`, `regime`, `figure` (what the value is), `value`, `unit`, `low`, `high` (ends of the band, None where
open), `residual` (of the energy), `remark`, `verdict` (`met`, `MISSED`, or `none` where a scene expects nothing).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import takewhile
from pathlib import Path
from typing import Any

from contact_sim_pkg.compare.estimated import above
from contact_sim_pkg.records.metric import OUTSIDE, Metric
from contact_sim_pkg.records.registry import shipped_scenes
from contact_sim_pkg.report.metrics.maker import energy_residual
from contact_sim_pkg.report.metrics.regimes import expected
from contact_sim_pkg.report.metrics.views import row_of, value_text
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.summary import summarise_recording
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.scene.load import find_scene
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.studies.whole_run import whole_run

__all__ = ["MET", "MISSED", "failed", "row_of_scene", "study"]

MET, MISSED, NONE = "met", "MISSED", "none"


def study(
    progress: Callable[[str], None], scenes: Iterable[str] | None = None,
    values: Mapping[str, tuple[str, ...]] | None = None,
) -> Iterator[list[dict[str, Any]]]:  # fmt: skip
    """A row for each scene as it comes: all that are shipped, or those of ``scenes``; run whole, or with the
    ``values`` of `--set` that are given by scene.
    """
    names = list(shipped_scenes() if scenes is None else scenes)
    for number, name in enumerate(names, 1):
        progress(f"{number} of {len(names)}: {name}")
        yield [row_of_scene(name, (values or {}).get(name, ()))]


def row_of_scene(name: str, values: Iterable[str] = ()) -> dict[str, Any]:
    """The row of a scene by its name or path; a run that ends early has missed, with its sentence as the remark."""
    scene, whole = load_resolved(name, *values), not [*values]
    given = scene.data.get("expect") or {}
    row = {"scene": name, "regime": given.get("regime"), "figure": "", "value": None, "unit": "", "low": None, "high": None,
           "residual": None, "remark": "", "verdict": MISSED if given else NONE}  # fmt: skip
    try:
        recording = whole_run(scene, lambda _line: None).recording
    except RunError as error:
        return row | {"remark": str(error)}
    row |= _energy(recording)
    broken = unsaid(summarise_recording(recording), first_comment(find_scene(name))) if whole else []
    if broken and not row["remark"]:
        row |= {"remark": f"its first comment does not say that it ends {', '.join(broken)}", "verdict": MISSED}
    metric: Metric | None = expected(recording)
    if metric is None or row["remark"]:
        return row
    found = row_of(metric)
    kept = {key: found[key] for key in ("value", "unit", "low", "high", "remark")}
    return row | kept | {
        "figure": metric.name, "verdict": MISSED if metric.verdict == OUTSIDE else MET, "shown": value_text(metric),
        "band": "" if metric.band is None else metric.band.text,
    }  # fmt: skip


def first_comment(path: Path) -> str:
    """The comment that a scene's file begins with, as one line."""
    lines = takewhile(lambda line: line.startswith("#"), path.read_text(encoding="utf-8").splitlines())
    return " ".join(line.removeprefix("#").strip() for line in lines)


def unsaid(summary: Mapping[str, Any], comment: str) -> list[str]:
    """How a run ends that its scene's first ``comment`` does not say: with a metric outside its band, with one that is
    doubtful, or with an error estimated above its request.
    """
    metrics, numbers = summary["metrics"], summary.get("accuracy")
    ends = {
        "outside": any(each["verdict"] == OUTSIDE for each in metrics),
        "doubtful": any(each["broken"] for each in metrics),
        "above its request": bool(numbers and above(numbers)),
    }
    return [words for words, holds in ends.items() if holds and words not in comment]


def _energy(recording: Recording) -> dict[str, Any]:
    """The energy residual of a run, and a remark where it is above its bound."""
    assert recording.ledger is not None
    energy = energy_residual(recording.ledger, recording.duration, recording.scene)
    remark = f"{energy.name} {value_text(energy)}" if energy.verdict == OUTSIDE else ""
    return {"residual": energy.value, "remark": remark}


def failed(rows: Iterable[dict[str, Any]]) -> bool:
    """Whether a scene does not show its regime."""
    return any(row["verdict"] == MISSED for row in rows)


def unjudged(rows: Iterable[dict[str, Any]]) -> bool:
    """Whether a scene states no regime."""
    return any(row["verdict"] not in (MET, MISSED) for row in rows)


def cells(rows: Sequence[dict[str, Any]]) -> dict[str, str]:
    """The row of one scene as a line."""
    (row,) = rows
    return {
        "scene": row["scene"], "regime": row["regime"] or "-", "value": row.get("shown", "–"), "band": row.get("band", ""),
        "met": row["verdict"], "what it is": "; ".join(filter(None, (row["figure"], row["remark"]))),
    }  # fmt: skip


def summary(rows: Sequence[dict[str, Any]]) -> str:
    """The count."""
    return f"{sum(row['verdict'] == MET for row in rows)} of {len(rows)} scenes show what they are there for"
