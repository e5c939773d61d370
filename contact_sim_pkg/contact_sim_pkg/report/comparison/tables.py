"""Tables of a comparison: in which values of their scenes the runs differ, and their metrics side by side."""

from __future__ import annotations

import math
from collections.abc import Sequence

from contact_sim_pkg.compare.side_by_side import ComparedMetric
from contact_sim_pkg.report.comparison.scene_differences import Difference
from contact_sim_pkg.report.rows import number
from contact_sim_pkg.report.tables import Table

NONE = "–"


def difference_table(names: Sequence[str], found: Sequence[Difference]) -> Table:
    """One row a key that is not the same in all scenes, one column a run."""
    rows = [(each.key, *each.values) for each in found]
    caption = "Keys in which the scenes differ." if found else "The scenes are the same."
    return Table(caption, ("key", *names), rows)


def metric_table(names: Sequence[str], sides: Sequence[ComparedMetric]) -> Table:
    """One row a metric, one column a run; of two runs their difference too."""
    header = ("", *names, *(("Δ", "Δ %", "B is") if len(names) == 2 else ("range, %",)), "rests on", "verdict")
    caption = "What moved most first."
    broken = dict.fromkeys(text for side in sides for text in side.broken)
    if broken:
        caption += f" Doubtful: {'; '.join(broken)}."
    return Table(caption, header, [row_of(side) for side in sides])


def row_of(side: ComparedMetric) -> tuple[str, ...]:
    """Texts of one metric."""
    label = f"{side.name}, {side.unit}" if side.unit else side.name
    spreads = side.spreads or (math.nan,) * len(side.values)
    values = tuple(
        _text(value) + (f" ± {number(spread)}" if math.isfinite(spread) else "")
        for value, spread in zip(side.values, spreads, strict=True)
    )
    if len(side.values) == 2:
        moved: tuple[str, ...] = (_signed(side.change), _signed(100.0 * side.relative), side.comparison)
    else:
        moved = (NONE if side.moved < 0.0 else number(100.0 * side.moved),)
    return (label, *values, *moved, _rests_on(side), side.verdict)


def _rests_on(side: ComparedMetric) -> str:
    """What it is a number of, and the largest numerical error of the runs."""
    known = [each for each in side.errors if math.isfinite(each)]
    return ", ".join(filter(None, (side.basis, f"error {number(max(known))}" if known else "")))


def _text(value: float) -> str:
    return number(value) if math.isfinite(value) else NONE


def _signed(value: float) -> str:
    if math.isinf(value):
        return "new"
    return NONE if math.isnan(value) else f"{'+' if value > 0.0 else ''}{number(value)}"
