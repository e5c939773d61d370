"""What makes a case hard: a figure that is measured from its run or its input, and the bound that it must keep.

A case whose figure misses the bound is not hard, and says so, whatever value it finds.
"""

from __future__ import annotations

import operator
from typing import NamedTuple

__all__ = [
    "Guard", "at_least", "at_most", "below", "condition", "contact_lost", "denominator_below_0", "grid_left", "impacts",
    "rank_lost", "scales", "slip_changes", "touches", "zero",
]  # fmt: skip

_RELATIONS = {"≥": operator.ge, "≤": operator.le, "<": operator.lt, ">": operator.gt, "=": operator.eq}


class Guard(NamedTuple):
    """The figure in words, and its bound."""

    what: str
    """with its unit; none where it is dimensionless"""
    relation: str
    """`≥`, `≤`, `<`, `>` or `=`"""
    bound: float

    def met(self, figure: float) -> bool:
        """Whether a figure keeps the bound; NaN never does."""
        return bool(_RELATIONS[self.relation](figure, self.bound))

    def says(self, figure: float) -> str:
        """Figure and bound as one text, `not` before a bound that is missed."""
        missed = "" if self.met(figure) else "not "
        return f"{self.what}: {figure:.3g}, {missed}{self.relation} {self.bound:.3g}"


def at_least(what: str, bound: float) -> Guard:
    """The figure reaches a bound."""
    return Guard(what, "≥", bound)


def at_most(what: str, bound: float) -> Guard:
    """The figure stays at or under a bound."""
    return Guard(what, "≤", bound)


def above(what: str, bound: float) -> Guard:
    """The figure is above a bound."""
    return Guard(what, ">", bound)


def below(what: str, bound: float) -> Guard:
    """The figure is below a bound."""
    return Guard(what, "<", bound)


def zero(what: str) -> Guard:
    """The figure is 0 to the last bit."""
    return Guard(what, "=", 0.0)


def scales(what: str, least: float) -> Guard:
    """Two sizes of one problem, or the ends of a range, lie far apart: larger over smaller."""
    return Guard(f"ratio of scales, {what}", "≥", least)


def condition(least: float) -> Guard:
    """The matrix of the problem is badly conditioned."""
    return Guard("condition number", "≥", least)


def rank_lost(least: int) -> Guard:
    """Equations that depend on others."""
    return Guard("rows beyond the rank", "≥", least)


def contact_lost(least: int = 1) -> Guard:
    """The bodies part during the run."""
    return Guard("samples without contact", "≥", least)


def touches(least: int) -> Guard:
    """Contact is made again and again."""
    return Guard("touches", "≥", least)


def impacts(least: int) -> Guard:
    """Impulses in the run."""
    return Guard("impacts", "≥", least)


def events(least: int) -> Guard:
    """Instants that the integrator must locate: touching, parting, a stop of slip."""
    return Guard("events located", "≥", least)


def slip_changes(least: int) -> Guard:
    """Slip starts, stops or turns round."""
    return Guard("starts and stops of slip", "≥", least)


def denominator_below_0() -> Guard:
    """Sliding on has no solution (Painleve): ``A_nn - mu |A_nt|`` of a contact is negative."""
    return Guard("denominator of the sliding mode [1/kg]", "<", 0.0)


def grid_left(least: int = 1) -> Guard:
    """The contact reaches the rim of its grid."""
    return Guard("loaded cells at the rim of the grid", "≥", least)
