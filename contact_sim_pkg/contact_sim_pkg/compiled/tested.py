"""Whether numba's inside is one that this package was tested with.

With another version nothing leans on it: functions are compiled in numba's own way, one number at a
time instead of eight, and held tuples are taken apart at each call. Slower, same numbers.
"""

from __future__ import annotations

import numba

__all__ = ["IS_TESTED", "TESTED"]

TESTED = ("0.66.", "0.67.", "0.68.")
"""Versions of numba whose inside is known to fit."""

IS_TESTED = numba.__version__.startswith(TESTED)
