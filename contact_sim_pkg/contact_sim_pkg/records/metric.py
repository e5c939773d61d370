"""A number of a run as everything prints it: value and unit, its band, the verdict, what of its assumptions
does not hold, how sure it is, where and when it was taken; and a figure that somebody published.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

__all__ = [
    "CLOSED_FORM", "EVENT", "GOOD", "LIMIT", "MET", "NO_BAND", "OUTSIDE", "REQUIRED", "SELF_CHECK", "STATE", "STATIONARY",
    "UNDECIDED", "USUAL", "Band", "Metric", "Published", "exit_status", "judged",
]  # fmt: skip

GOOD, USUAL, MET, OUTSIDE, UNDECIDED, NO_BAND = "good", "usual", "met", "outside", "undecided", "no band"
LIMIT, USUAL_RANGE, CLOSED_FORM, REQUIRED = "limit", "usual", "closed form", "yours"
EVENT, STATIONARY, STATE, SELF_CHECK = "event", "stationary", "state", "self-check"
"""What a metric is a number of: what happens once in its window (largest, smallest, duration); what all of the window
shows alike, and a longer one more surely; how something stands; the run beside a closed form.
"""
INSTANT = re.compile(r"at \d+(\.\d+)? s\b")
ROUNDING = 1e-9
"""of an end of a band: forty cells of 3.75 mm are 150 mm"""


class Band(NamedTuple):
    """Values that a metric may have, in its unit."""

    low: float
    high: float
    """-inf or inf where it is open"""
    kind: str
    """limit, usual, closed form, or yours: required of the run by who judges it"""
    source: str
    conditions: str = ""
    """in words; empty where it holds always"""

    def holds(self, value: float) -> bool:
        """Whether a value lies in the band, its ends included, and what rounding adds to them."""
        low, high = (
            end if math.isinf(end) else end + sign * ROUNDING * abs(end)
            for end, sign in ((self.low, -1.0), (self.high, 1.0))
        )
        return low <= value <= high

    @property
    def text(self) -> str:
        """`0.45 to 0.9`, `at most 100`, `at least 1`."""
        if math.isinf(self.low):
            return f"at most {self.high:.4g}"
        if math.isinf(self.high):
            return f"at least {self.low:.4g}"
        return f"{self.low:.4g} to {self.high:.4g}"


class Metric(NamedTuple):
    """One number of a run."""

    key: str
    """stable name, `seat.a_w`"""
    name: str
    value: float
    """in `unit`; nan where it is not defined"""
    unit: str
    verdict: str
    """good (inside a limit that one can miss), usual, met (equal to a closed form: the run checks itself), outside,
    undecided (a limit of one's own lies within the spread) or no band"""
    band: Band | None
    remark: str = ""
    """what the verdict means in words, or why there is no band"""
    broken: tuple[str, ...] = ()
    """assumptions of the number that do not hold"""
    spread: float = math.nan
    """half the 95 % interval of what chance does to it, in `unit`; nan where it is not known"""
    size: int = 0
    """segments, samples or events that it is taken from; 0: not counted"""
    topic: str = ""
    window: tuple[float, float] = (0.0, 0.0)
    """[s] of the run"""
    basis: str = ""
    """event, stationary, state or self-check; empty where who made it does not say"""
    error: float = math.nan
    """numerical error as the run estimates it, in `unit`; nan where nothing is estimated"""

    @property
    def instant(self) -> str:
        """`at 0.990 s`, where the remark says when an event was, else empty."""
        found = INSTANT.search(self.remark)
        return found[0] if found else ""


def judged(value: float, band: Band | None) -> str:
    """The verdict on a value: a limit, of a standard or of one's own, that holds is good, a usual range usual, and a
    closed form met.
    """
    if band is None or not math.isfinite(value):
        return NO_BAND
    if not band.holds(value):
        return OUTSIDE
    return {USUAL_RANGE: USUAL, CLOSED_FORM: MET}.get(band.kind, GOOD)


def exit_status(*, missed: bool, unjudged: bool) -> int:
    """How every command that judges ends: 1 on a miss, 3 where something could not be judged, 0 where all holds."""
    return 1 if missed else 3 if unjudged else 0


@dataclass(frozen=True, kw_only=True)
class Published:
    """A quantity that somebody measured or computed, with its band. All values in ``unit``.

    Attributes:
        machine: what it is a quantity of: the heading that it stands under.
        quantity: with its conditions (load, excitation, grid), so that it can be measured again.
        unit: as printed.
        value: as published, with its scatter.
        band: lowest and highest value that agree with it.
        source: author, title or standard, year; whether the figure is quoted from another source.
        ours: computes the bench's value; some seconds at most.
        fitted: whether a constant of the bench was chosen by it.
        note: reason, where the bench leaves the band, and other remarks.
    """

    machine: str
    quantity: str
    unit: str
    value: str
    band: tuple[float, float]
    source: str
    ours: Callable[[], float]
    fitted: bool = False
    note: str = ""
