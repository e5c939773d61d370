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

__all__ = ["rocket_fft"]

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
