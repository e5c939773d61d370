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
    """One row a metric, one column a run, and how far each moved from the first."""
    letters = [name.partition(":")[0] for name in names[1:]]
    moved = [("Δ", "Δ %", "B is")] if len(letters) == 1 else [(f"Δ % of {each}", f"{each} is") for each in letters]
    header = ("metric", *names, *(text for each in moved for text in each), "rests on", "verdict")
    caption = "What moved most first."
    broken = dict.fromkeys(text for side in sides for text in side.broken)
    if broken:
        caption += f" Doubtful: {'; '.join(broken)}."
    return Table(caption, header, [row_of(side) for side in sides])


def row_of(side: ComparedMetric) -> tuple[str, ...]:
    """Texts of one metric."""
    label = f"{side.name}, {side.unit}" if side.unit else side.name
    spreads = side.spreads or (math.nan,) * len(side.values)
    values = tuple(with_spread(number(value), spread) for value, spread in zip(side.values, spreads, strict=True))
    pairs = [side.against_first(place) for place in range(1, len(side.values))]
    moved = [(signed(100.0 * each.relative), each.comparison) for each in pairs]
    change = (signed(side.change),) if len(pairs) == 1 else ()
    return (label, *values, *change, *(text for each in moved for text in each), _rests_on(side), side.verdict)


def _rests_on(side: ComparedMetric) -> str:
    """What it is a number of, and the largest numerical error of the runs."""
    known = [each for each in side.errors if math.isfinite(each)]
    return ", ".join(filter(None, (side.basis, f"error {number(max(known))}" if known else "")))


def with_spread(text: str, spread: float) -> str:
    """`57.3 ± 2.1`, or the text alone where the spread is not known."""
    return f"{text} ± {number(spread)}" if math.isfinite(spread) else text


def signed(value: float) -> str:
    """`+5.3`, `-2`; `new` for a change from nothing."""
    if math.isinf(value):
        return "new"
    return NONE if math.isnan(value) else f"{'+' if value > 0.0 else ''}{number(value)}"
