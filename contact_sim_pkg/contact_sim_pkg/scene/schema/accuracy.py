"""What a requested accuracy stands for: fidelity levels of pressure fields, tolerances of the time
integration.

The figures behind the levels are those of `bench accuracy`, which measures each of them against a
reference on the user's machine. The grids of a contact lie with its keys.
"""

from __future__ import annotations

from typing import NamedTuple

FASTEST = 0.1
"""What `accuracy: realtime` stands for: the least expensive level."""
INTEGRATION_SHARE = 1e-2
"""The time integration may make this part of the requested error."""


class Level(NamedTuple):
    """One fidelity level of the pressure fields."""

    name: str
    accuracy: float  # smallest requested error that this level is taken for


LEVELS: tuple[Level, ...] = (Level("force", 1e-2), Level("field", 1e-3), Level("reference", 0.0))
"""Least expensive first."""


def requested(accuracy: float | str) -> float:
    """The requested relative accuracy as a number [1]."""
    return FASTEST if isinstance(accuracy, str) else accuracy


def level_of(accuracy: float | str) -> int:
    """Place in `LEVELS` of the least expensive level that reaches the requested relative accuracy
    [1]."""
    return next(place for place, level in enumerate(LEVELS) if requested(accuracy) >= level.accuracy)


def integration_tolerance(accuracy: float | str, loosest: float) -> float:
    """Relative tolerance [1] of a time step, at most ``loosest`` [1]."""
    return min(loosest, INTEGRATION_SHARE * requested(accuracy))
