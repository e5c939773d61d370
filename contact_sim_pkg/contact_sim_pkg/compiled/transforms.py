"""The fast Fourier transforms of compiled code: `rocket_fft`, imported without what it does for
SciPy.

Where SciPy is installed, `rocket_fft` imports `scipy.fft` to serve it too. The bench calls its own
functions only, and that import takes 0.1 s. numba imports every extension that is installed at the
first compilation, so this comes before, for whatever scene (`compiled/jit.py`).
"""

from __future__ import annotations

import importlib
import sys
from types import ModuleType

__all__ = ["good_size", "rocket_fft"]

_SERVED = "scipy.fft"


def _import_alone() -> ModuleType:
    if _SERVED in sys.modules:
        return importlib.import_module("rocket_fft")
    sys.modules[_SERVED] = None  # type: ignore[assignment]  # the documented way to make an import fail
    try:
        return importlib.import_module("rocket_fft")
    finally:
        del sys.modules[_SERVED]


rocket_fft = _import_alone()


def good_size(count: int) -> int:
    """The least length of a fast real transform from ``count`` on: a product of 2, 3 and 5."""
    size = max(count, 1)
    while _without(size, 2, 3, 5) != 1:
        size += 1
    return size


def _without(number: int, *factors: int) -> int:
    for factor in factors:
        while number % factor == 0:
            number //= factor
    return number
