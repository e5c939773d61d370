"""Published formulas for the Hunt-Crossley damping that delivers a requested restitution: `d =
damping v0` from e, each as printed.

None is exact; what each really gives is in `bench accuracy seat`, part "restitution from B". The
exact relation is `d (1 + e) = ln[(1 + d)/(1 - d e)]` (`laws/restitution.py`).
"""

from __future__ import annotations

from collections.abc import Callable

__all__ = ["FORMULAS"]


def hunt_crossley(e: float) -> float:
    """d = `3/2 (1 - e)` [1]: Hunt and Crossley 1975, for e near 1; the usual one beside Driver and
    Seat's eq 8."""
    return 1.5 * (1.0 - e)


def lankarani_nikravesh(e: float) -> float:
    """d = `3/4 (1 - e^2)` [1]: Lankarani and Nikravesh 1990, for e near 1."""
    return 0.75 * (1.0 - e * e)


def flores(e: float) -> float:
    """d = `8 (1 - e)/(5 e)` [1]: Flores, Machado, Silva and Martins 2011."""
    return 1.6 * (1.0 - e) / e


def gonthier(e: float) -> float:
    """d = `(1 - e^2)/e` [1]: Gonthier, McPhee, Lange and Piedboeuf 2004, first term; right for e
    towards 0."""
    return (1.0 - e * e) / e


def hu_guo(e: float) -> float:
    """d = `3 (1 - e)/(2 e)` [1]: Hu and Guo 2015."""
    return 1.5 * (1.0 - e) / e


FORMULAS: dict[str, Callable[[float], float]] = {
    "3/2 (1-e)": hunt_crossley,
    "3/4 (1-e²)": lankarani_nikravesh,
    "8 (1-e)/(5e)": flores,
    "(1-e²)/e": gonthier,
    "3 (1-e)/(2e)": hu_guo,
}
"""Printed form -> d of e."""
